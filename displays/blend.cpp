#include "blend.h"
#include "rows.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace starbow {
namespace {

/// Squared distances along one line to the nearest of the parabolas f (Felzenszwalb and Huttenlocher 2012), in place.
void transform(std::vector<double>& f, std::vector<int>& vertex, std::vector<double>& border)
{
    const int n = int(f.size());
    int k = 0;
    vertex[0] = 0;
    border[0] = -std::numeric_limits<double>::infinity();
    border[1] = -border[0];
    for (int q = 1; q < n; ++q) {
        double s;
        for (;; --k) {
            const int v = vertex[k];
            s = ((f[q] + double(q) * q) - (f[v] + double(v) * v)) / (2.0 * (q - v));
            if (s > border[k])
                break;
        }
        vertex[++k] = q;
        border[k] = s;
        border[k + 1] = std::numeric_limits<double>::infinity();
    }
    std::vector<double> out(n);
    for (int q = 0, at = 0; q < n; ++q) {
        while (border[at + 1] < q)
            ++at;
        out[q] = double(q - vertex[at]) * (q - vertex[at]) + f[vertex[at]];
    }
    f = std::move(out);
}

/// A pane's distance from its own edge.
struct Field {
    const CompiledPane* pane;
    std::shared_ptr<const DirectionMap> map;
    std::shared_ptr<const Blocks> blocks;
    std::vector<float> from_edge; ///< of each pixel's centre, radians of an average pixel; 0 where nothing is shown
    float pixel = 0; ///< average pixel angle

    float at(int x, int y) const
    {
        const glm::ivec2 size = map->size;
        return x < 0 || y < 0 || x >= size.x || y >= size.y ? 0 : from_edge[std::size_t(y) * size.x + x];
    }
    /// Between pixels, 0 where the direction is not shown.
    float along(const glm::dvec3& direction) const
    {
        const auto p = find(*map, *blocks, direction);
        if (!p)
            return 0;
        const glm::dvec2 from = *p - 0.5, low = glm::floor(from);
        const glm::vec2 f = from - low;
        const int x = int(low.x), y = int(low.y);
        return glm::mix(glm::mix(at(x, y), at(x + 1, y), f.x), glm::mix(at(x, y + 1), at(x + 1, y + 1), f.x), f.y);
    }
};

Field field_of(const CompiledPane& pane)
{
    Field field;
    field.pane = &pane;
    field.map = pane.map ? pane.map : std::make_shared<DirectionMap>(compile(pane.pane));
    field.blocks = pane.map ? pane.blocks : std::make_shared<Blocks>(*field.map);
    const glm::ivec2 size = field.map->size;
    // One pixel of nothing all round: the picture's own edge counts.
    const int width = size.x + 2, height = size.y + 2;
    constexpr double far = 1e12;
    std::vector<double> square(std::size_t(width) * height, 0.0);
    double sum = 0;
    long shown = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            if (const float angle = field.map->at(x, y).w; angle > 0) {
                square[std::size_t(y + 1) * width + x + 1] = far;
                sum += angle, ++shown;
            }
    field.pixel = shown > 0 ? float(sum / double(shown)) : 0;
    std::vector<double> line, border(std::max(width, height) + 1);
    std::vector<int> vertex(std::max(width, height));
    for (int x = 0; x < width; ++x) {
        line.resize(height);
        for (int y = 0; y < height; ++y)
            line[y] = square[std::size_t(y) * width + x];
        transform(line, vertex, border);
        for (int y = 0; y < height; ++y)
            square[std::size_t(y) * width + x] = line[y];
    }
    for (int y = 0; y < height; ++y) {
        line.assign(square.begin() + std::ptrdiff_t(y) * width, square.begin() + std::ptrdiff_t(y + 1) * width);
        transform(line, vertex, border);
        std::copy(line.begin(), line.end(), square.begin() + std::ptrdiff_t(y) * width);
    }
    field.from_edge.resize(std::size_t(size.x) * size.y);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            // The edge lies half way to the first pixel that shows nothing.
            const double away = std::sqrt(square[std::size_t(y + 1) * width + x + 1]) - 0.5;
            field.from_edge[std::size_t(y) * size.x + x] = float(std::max(away, 0.0)) * field.pixel;
        }
    return field;
}

/// Every so many pixels the others' fields are looked up, between these points they are interpolated.
constexpr int stride = 4;
/// Nearer to an edge than so many pixels each pixel is looked up: there a small error is a large part.
constexpr float sharp = 16;
/// And where the field bends by more than this part of itself from node to node: half way between two edges it has a ridge.
constexpr float bend = 0.01f;

/// Whether the field is straight enough around the cell with the node (x, y) at its top left to be interpolated.
bool straight(const std::vector<float>& nodes, glm::ivec2 count, int x, int y)
{
    auto node = [&](int i, int j) {
        return nodes[std::size_t(std::clamp(j, 0, count.y - 1)) * count.x + std::clamp(i, 0, count.x - 1)];
    };
    const float most = bend * node(x, y);
    for (int j = y; j <= y + 1; ++j)
        for (int i = x; i <= x + 1; ++i)
            if (std::abs(node(i - 1, j) - 2 * node(i, j) + node(i + 1, j)) > most
                || std::abs(node(i, j - 1) - 2 * node(i, j) + node(i, j + 1)) > most)
                return false;
    return std::abs(node(x, y) - node(x + 1, y) - node(x, y + 1) + node(x + 1, y + 1)) <= most;
}

std::vector<float> ramp(const Field& own, const std::vector<const Field*>& others, double power)
{
    const glm::ivec2 size = own.map->size, nodes = (size - 2) / stride + 2;
    const std::size_t pixels = std::size_t(size.x) * size.y, count = std::size_t(nodes.x) * nodes.y;
    auto look = [&](const Field& other, int x, int y) {
        const glm::vec4& texel = own.map->at(std::min(x, size.x - 1), std::min(y, size.y - 1));
        return texel.w > 0 ? other.along(glm::vec3(texel)) : -1.0f;
    };
    std::vector<float> sum(pixels, 0.0f);
    bool any = false;
    for (const Field* other : others) {
        std::vector<float> coarse(count);
        by_rows(nodes.y, [&](int first, int end) {
            for (int y = first; y < end; ++y)
                for (int x = 0; x < nodes.x; ++x)
                    coarse[std::size_t(y) * nodes.x + x] = look(*other, x * stride, y * stride);
        });
        if (std::none_of(coarse.begin(), coarse.end(), [](float a) { return a > 0; }))
            continue;
        any = true;
        const float near_own = sharp * own.pixel, near_other = sharp * other->pixel;
        std::vector<char> exact(count, 0); // cells whose pixels are all looked up
        by_rows(nodes.y - 1, [&](int first, int end) {
            for (int y = first; y < end; ++y)
                for (int x = 0; x + 1 < nodes.x; ++x) {
                    const std::size_t at = std::size_t(y) * nodes.x + x;
                    const float least
                        = std::min({coarse[at], coarse[at + 1], coarse[at + nodes.x], coarse[at + nodes.x + 1]});
                    exact[at] = least < near_other || !straight(coarse, nodes, x, y);
                }
        });
        by_rows(size.y, [&](int first, int end) {
            for (int y = first; y < end; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const std::size_t at = std::size_t(y) * size.x + x;
                    if (own.from_edge[at] <= 0)
                        continue;
                    const int i = x / stride, j = y / stride;
                    const float* corner = &coarse[std::size_t(j) * nodes.x + i];
                    const float a = corner[0], b = corner[1], c = corner[nodes.x], d = corner[nodes.x + 1];
                    float value;
                    if (std::max({a, b, c, d}) == 0)
                        value = 0; // -1, a corner that this pane does not show, is not 0
                    else if (exact[std::size_t(j) * nodes.x + i] || own.from_edge[at] < near_own)
                        value = std::max(0.0f, look(*other, x, y));
                    else {
                        const float u = float(x % stride) / stride, v = float(y % stride) / stride;
                        value = (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v;
                    }
                    sum[at] += float(std::pow(value, power));
                }
        });
    }
    if (!any)
        return {};
    std::vector<float> weight(pixels, 0.0f);
    for (std::size_t at = 0; at < pixels; ++at)
        if (const double mine = std::pow(own.from_edge[at], power); mine > 0)
            weight[at] = float(mine / (mine + sum[at]));
    return weight;
}

bool has_mask(const Layout& layout, const CompiledPane& pane)
{
    return !layout.outputs[pane.pane.output].viewports[pane.pane.viewport].alpha_mask.empty()
        || (pane.mesh && pane.mesh->alpha);
}

/// Whether two panes are drawn on the same pixels: then one covers the other. Beside each other they may well be for two
/// projectors on one desktop.
bool share_pixels(const Pane& a, const Pane& b)
{
    return a.output == b.output && a.layer == b.layer && glm::all(glm::lessThan(a.corner, b.corner + b.size))
        && glm::all(glm::lessThan(b.corner, a.corner + a.size));
}

} // namespace

std::vector<std::vector<float>> blend_ramps(const Layout& layout, std::span<const CompiledPane> panes, double power)
{
    std::vector<Field> fields;
    std::vector<int> field_of_pane(panes.size(), -1);
    for (std::size_t i = 0; i < panes.size(); ++i)
        if (!has_mask(layout, panes[i])) {
            field_of_pane[i] = int(fields.size());
            fields.push_back(field_of(panes[i]));
        }
    std::vector<std::vector<float>> ramps(panes.size());
    for (std::size_t i = 0; i < panes.size(); ++i) {
        if (field_of_pane[i] < 0)
            continue;
        std::vector<const Field*> others;
        for (const Field& other : fields)
            if (other.pane->pane.eye == panes[i].pane.eye && !share_pixels(other.pane->pane, panes[i].pane))
                others.push_back(&other);
        ramps[i] = ramp(fields[field_of_pane[i]], others, power);
    }
    return ramps;
}

} // namespace starbow
