#include "mesh.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace starbow {
namespace {

/// Rows that share a list of triangles: fewer lists than rows, and few triangles in vain.
constexpr int band = 8;

/// Twice the signed area that an edge spans with points of one row, as a function of x. The two triangles at an edge must
/// get the very same numbers with opposite signs, else a pixel's centre on it could lie in neither. So the ends are taken in
/// an order that depends on their places alone.
struct Edge {
    double x, constant, slope, sign;
    Edge(glm::dvec2 a, glm::dvec2 b, double y)
    {
        const bool swap = b.y < a.y || (b.y == a.y && b.x < a.x);
        if (swap)
            std::swap(a, b);
        x = a.x;
        constant = (b.x - a.x) * (y - a.y);
        slope = b.y - a.y;
        sign = swap ? -1 : 1;
    }
    double at(double px) const { return sign * (constant - slope * (px - x)); }
};

} // namespace

WarpRaster::WarpRaster(const WarpMesh& mesh, glm::ivec2 size)
    : mesh_(mesh)
    , size_(size)
{
    if (size.x < 1 || size.y < 1)
        throw std::logic_error("WarpRaster: " + std::to_string(size.x) + " x " + std::to_string(size.y) + " pixels");
    // Two passes, count and fill, so that each band's triangles come in the file's order.
    const int bands = (size.y + band - 1) / band;
    first_.assign(std::size_t(bands) + 1, 0);
    for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const auto& t = mesh.triangles[i];
            const double a = mesh.vertices[t[0]].at.y, b = mesh.vertices[t[1]].at.y, c = mesh.vertices[t[2]].at.y;
            // The rows whose centres the triangle may reach; one more on each side does no harm.
            const double from = std::min({a, b, c}) * size.y - 1.5, to = std::max({a, b, c}) * size.y + 0.5;
            if (!(to >= 0 && from <= size.y - 1))
                continue;
            const int last = int(std::min(to, size.y - 1.0)) / band;
            for (int k = int(std::max(from, 0.0)) / band; k <= last; ++k)
                if (pass == 0)
                    ++first_[std::size_t(k) + 1];
                else
                    triangles_[first_[std::size_t(k)]++] = std::uint32_t(i);
        }
        if (pass == 0) {
            for (std::size_t k = 1; k < first_.size(); ++k)
                first_[k] += first_[k - 1];
            triangles_.resize(first_.back());
        }
    }
    // Filling moved each start to the next one's.
    first_.insert(first_.begin(), 0);
    first_.pop_back();
}

std::size_t WarpRaster::row(int y, std::span<WarpSample> samples) const
{
    if (y < 0 || y >= size_.y || samples.size() != std::size_t(size_.x))
        throw std::logic_error("WarpRaster: row " + std::to_string(y) + " of " + std::to_string(size_.y) + ", "
            + std::to_string(samples.size()) + " samples for " + std::to_string(size_.x));
    std::fill(samples.begin(), samples.end(), WarpSample{});
    const glm::dvec2 scale(size_);
    const double centre = y + 0.5;
    const std::size_t colours = mesh_.kind == WarpMesh::Kind::colours ? 3 : 1;
    std::size_t steps = 0;
    for (std::uint32_t k = first_[std::size_t(y / band)]; k < first_[std::size_t(y / band) + 1]; ++k) {
        ++steps;
        const auto& t = mesh_.triangles[triangles_[k]];
        const WarpVertex* v[3] = {&mesh_.vertices[t[0]], &mesh_.vertices[t[1]], &mesh_.vertices[t[2]]};
        const glm::dvec2 p[3] = {v[0]->at * scale, v[1]->at * scale, v[2]->at * scale};
        if (centre < std::min({p[0].y, p[1].y, p[2].y}) || centre > std::max({p[0].y, p[1].y, p[2].y}))
            continue;
        // The row meets the triangle between these, roughly; the edges below decide.
        double left = 1e300, right = -1e300;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec2 a = p[i], b = p[(i + 1) % 3];
            if (std::min(a.y, b.y) > centre || std::max(a.y, b.y) < centre)
                continue;
            const double x = a.y == b.y ? a.x : a.x + (b.x - a.x) * ((centre - a.y) / (b.y - a.y));
            left = std::min({left, x, a.y == b.y ? b.x : x});
            right = std::max({right, x, a.y == b.y ? b.x : x});
        }
        if (!(right >= 0 && left <= size_.x))
            continue;
        const int from = int(std::max(left - 1.5, 0.0)), to = int(std::min(right + 0.5, size_.x - 1.0));
        const Edge e0(p[1], p[2], centre), e1(p[2], p[0], centre), e2(p[0], p[1], centre);
        steps += std::size_t(std::max(to - from + 1, 0));
        for (int x = from; x <= to; ++x) {
            WarpSample& sample = samples[std::size_t(x)];
            if (sample.shown)
                continue;
            const double w0 = e0.at(x + 0.5), w1 = e1.at(x + 0.5), w2 = e2.at(x + 0.5);
            if (!((w0 >= 0 && w1 >= 0 && w2 >= 0) || (w0 <= 0 && w1 <= 0 && w2 <= 0)))
                continue;
            const double sum = w0 + w1 + w2;
            if (sum == 0)
                continue; // without area
            const double a = w0 / sum, b = w1 / sum, c = w2 / sum;
            sample.shown = true;
            sample.intensity = a * v[0]->intensity + b * v[1]->intensity + c * v[2]->intensity;
            for (std::size_t i = 0; i < colours; ++i)
                sample.sees[i] = a * v[0]->sees[i] + b * v[1]->sees[i] + c * v[2]->sees[i];
        }
    }
    return steps;
}

} // namespace starbow
