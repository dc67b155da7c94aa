#include "config/model/angles.h"
#include "parts.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

using Rgb = glm::dvec3; // sRGB, 0 to 255

constexpr int fine = 2; // drawn so many times larger, then averaged

/// The sample as a place in a flat chart, for colours, and the coordinates whose whole numbers have lines.
struct Seen {
    glm::dvec2 place, lines;
};

Seen seen(const WarpMesh& mesh, const std::array<glm::dvec3, 3>& sees)
{
    switch (mesh.kind) {
    case WarpMesh::Kind::picture:
        return {glm::dvec2(sees[0]), glm::dvec2(sees[0]) * 10.0};
    case WarpMesh::Kind::points: {
        const glm::dvec3 way = sees[0] - mesh.eye_m.value_or(glm::dvec3(0));
        const glm::dvec2 angles(std::atan2(way.x, -way.z), std::atan2(way.y, std::hypot(way.x, way.z)));
        return {{angles.x / (2 * pi) + 0.5, 0.5 - angles.y / pi}, angles * (18 / pi)}; // each 10 degrees
    }
    case WarpMesh::Kind::colours:
        break;
    }
    const glm::dvec2 tangents = glm::dvec2(sees[1]) / std::max(-sees[1].z, 1e-3);
    return {glm::dvec2(0.5) + glm::dvec2(tangents.x, -tangents.y) / 3.0, tangents * 5.0};
}

/// Four corners' colours mixed.
Rgb colour(glm::dvec2 place)
{
    const glm::dvec2 p = glm::clamp(place, 0.0, 1.0);
    const Rgb top = glm::mix(Rgb(52, 88, 160), Rgb(196, 84, 92), p.x),
              bottom = glm::mix(Rgb(44, 140, 128), Rgb(232, 184, 92), p.x);
    return glm::mix(top, bottom, p.y);
}

struct Canvas {
    glm::ivec2 size;
    std::vector<glm::vec3> pixels;

    void mix(glm::ivec2 p, const Rgb& with, double share)
    {
        if (p.x >= 0 && p.y >= 0 && p.x < size.x && p.y < size.y) {
            glm::vec3& pixel = pixels[std::size_t(p.y) * std::size_t(size.x) + std::size_t(p.x)];
            pixel = glm::mix(pixel, glm::vec3(with), float(share));
        }
    }

    void line(glm::dvec2 a, glm::dvec2 b, const Rgb& with, double share)
    {
        const double far = 4.0 * std::max(size.x, size.y);
        if (!(std::max(glm::length(a), glm::length(b)) < far))
            return; // lies mostly elsewhere
        const int steps = 1 + int(std::ceil(std::max(std::abs(b.x - a.x), std::abs(b.y - a.y))));
        for (int i = 0; i < steps; ++i)
            mix(glm::ivec2(glm::floor(glm::mix(a, b, (i + 0.5) / steps))), with, share);
    }
};

/// A part of a white line. It is drawn late, so that the mesh's lines do not dim it where both run.
struct Dot {
    glm::ivec2 at;
    double share;
};

/// The part of the canvas that the viewport covers.
struct Inset {
    glm::ivec2 margin, size;
};

/// Draws the colours of the samples. Returns the dots of the chart's lines.
std::vector<Dot> draw_samples(Canvas& canvas, const WarpMesh& mesh, const Inset& inner)
{
    const WarpRaster raster(mesh, inner.size);
    const std::size_t width = std::size_t(inner.size.x);
    std::vector<WarpSample> samples(width);
    // This row and the one above: their difference is the measure of a line's width.
    std::vector<std::optional<Seen>> above(width), here(width);
    std::vector<Dot> chart;
    for (int y = 0; y < inner.size.y; ++y) {
        raster.row(y, samples);
        std::swap(above, here);
        for (std::size_t x = 0; x < width; ++x) {
            here[x].reset();
            if (samples[x].shown)
                here[x] = seen(mesh, samples[x].sees);
        }
        for (std::size_t x = 0; x < width; ++x) {
            const glm::ivec2 at = inner.margin + glm::ivec2(int(x), y);
            canvas.mix(at, Rgb(0), 1);
            if (!here[x])
                continue;
            canvas.mix(at, colour(here[x]->place) * std::sqrt(std::clamp(samples[x].intensity, 0.0, 1.0)), 1);
            // A line's distance is the sample's difference from a whole number, in steps from one pixel to the next.
            for (int axis = 0; axis < 2; ++axis) {
                const double value = here[x]->lines[axis], off = value - std::round(value);
                const double dx = x > 0 && here[x - 1] ? value - here[x - 1]->lines[axis] : 0;
                const double dy = above[x] ? value - above[x]->lines[axis] : 0;
                const double step = std::hypot(dx, dy);
                if (step > 0 && step < 0.25)
                    chart.push_back({at, 0.85 * std::clamp(1.6 - std::abs(off) / step, 0.0, 1.0)});
            }
        }
    }
    return chart;
}

/// Draws the lines of a grid, or the edges of the triangles. A dense mesh shows some of them.
void draw_mesh(Canvas& canvas, const WarpMesh& mesh, const Inset& inner)
{
    const Rgb ink(8, 10, 14);
    const auto line = [&](std::uint32_t from, std::uint32_t to, double share) {
        const auto on_canvas
            = [&](std::uint32_t i) { return glm::dvec2(inner.margin) + mesh.vertices[i].at * glm::dvec2(inner.size); };
        canvas.line(on_canvas(from), on_canvas(to), ink, share);
    };
    if (mesh.grid.x <= 1) {
        const std::size_t step = mesh.triangles.size() / 20000 + 1;
        for (std::size_t i = 0; i < mesh.triangles.size(); i += step)
            for (std::size_t k = 0; k < 3; ++k)
                line(mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3], 0.2);
        return;
    }
    std::vector<char> used(mesh.vertices.size());
    for (const auto& t : mesh.triangles)
        for (std::uint32_t i : t)
            used[i] = 1;
    const auto columns = std::uint32_t(mesh.grid.x), rows = std::uint32_t(mesh.grid.y);
    const std::uint32_t every = std::max(1u, std::max(columns, rows) / 48);
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t i = row * columns + column;
            if (column + 1 < columns && row % every == 0 && used[i] && used[i + 1])
                line(i, i + 1, 0.4);
            if (row + 1 < rows && column % every == 0 && used[i] && used[i + columns])
                line(i, i + columns, 0.4);
        }
}

/// Draws the viewport's edge.
void draw_edge(Canvas& canvas, const Inset& inner)
{
    const glm::dvec2 low(inner.margin), high(inner.margin + inner.size);
    for (int i = 0; i < fine; ++i) {
        const double d = i + 0.5;
        canvas.line({low.x - d, low.y - d}, {high.x + d, low.y - d}, Rgb(220), 1);
        canvas.line({low.x - d, high.y + d}, {high.x + d, high.y + d}, Rgb(220), 1);
        canvas.line({low.x - d, low.y - d}, {low.x - d, high.y + d}, Rgb(220), 1);
        canvas.line({high.x + d, low.y - d}, {high.x + d, high.y + d}, Rgb(220), 1);
    }
}

/// The canvas as RGBA of `size` pixels, each the mean of fine * fine.
std::vector<std::uint8_t> averaged(const Canvas& canvas, glm::ivec2 size)
{
    std::vector<std::uint8_t> rgba;
    rgba.reserve(std::size_t(size.x) * std::size_t(size.y) * 4);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            glm::vec3 sum(0);
            for (int j = 0; j < fine; ++j)
                for (int i = 0; i < fine; ++i)
                    sum += canvas.pixels[std::size_t(y * fine + j) * std::size_t(canvas.size.x) + std::size_t(x * fine + i)];
            for (int k = 0; k < 3; ++k)
                rgba.push_back(std::uint8_t(std::lround(sum[k] / (fine * fine))));
            rgba.push_back(255);
        }
    return rgba;
}

} // namespace

std::vector<std::uint8_t> portrait(const WarpMesh& mesh, glm::ivec2 size)
{
    Canvas canvas{size * fine, {}};
    canvas.pixels.assign(std::size_t(canvas.size.x) * std::size_t(canvas.size.y), glm::vec3(34, 35, 40));
    const glm::ivec2 margin = canvas.size / 16;
    const Inset inner{margin, canvas.size - 2 * margin};
    const std::vector<Dot> chart = draw_samples(canvas, mesh, inner);
    draw_mesh(canvas, mesh, inner);
    for (const Dot& dot : chart)
        canvas.mix(dot.at, Rgb(255), dot.share);
    draw_edge(canvas, inner);
    return averaged(canvas, size);
}

} // namespace starbow
