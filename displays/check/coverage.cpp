#include "coverage.h"
#include "config/model/angles.h"
#include "displays/projections/picture.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace starbow {
namespace {

using Shows = std::function<bool(const glm::dvec3&)>;

/// The directions of a view at the points of a mesh over the picture: triangles, sorted by the cell of the sphere.
class Patch {
public:
    Patch(const std::function<std::optional<glm::dvec3>(glm::dvec2)>& sight, glm::ivec2 size)
    {
        const glm::ivec2 steps = glm::min(size, glm::ivec2(256));
        std::vector<std::optional<glm::dvec3>> points;
        for (int y = 0; y <= steps.y; ++y)
            for (int x = 0; x <= steps.x; ++x) // slightly inside the edge, where the projection is defined
                points.push_back(sight(glm::clamp(
                    glm::dvec2(x, y) / glm::dvec2(steps) * glm::dvec2(size), glm::dvec2(1e-6), glm::dvec2(size) - 1e-6)));
        const auto at = [&](int x, int y) { return points[y * (steps.x + 1) + x]; };
        for (int y = 0; y < steps.y; ++y)
            for (int x = 0; x < steps.x; ++x) {
                add(at(x, y), at(x + 1, y), at(x + 1, y + 1));
                add(at(x, y), at(x + 1, y + 1), at(x, y + 1));
            }
    }

    bool shows(const glm::dvec3& d) const
    {
        for (int i : bins_[bin(azimuth_elevation_deg(d))]) {
            const auto& [a, b, c] = triangles_[i];
            const double x = glm::dot(glm::cross(a, b), d), y = glm::dot(glm::cross(b, c), d),
                         z = glm::dot(glm::cross(c, a), d);
            if (((x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0)) && glm::dot(a, d) > 0)
                return true;
        }
        return false;
    }

private:
    static constexpr int columns = 180, rows = 90; // bins of two degrees
    static constexpr double widest = 0.35; // radians; a triangle's side that is longer spans a jump

    static int column(double azimuth) { return std::clamp(int((azimuth + 180) / 2), 0, columns - 1); }
    static int row(double elevation) { return std::clamp(int((elevation + 90) / 2), 0, rows - 1); }
    static std::size_t bin(glm::dvec2 at) { return std::size_t(row(at.y)) * columns + column(at.x); }

    void add(const std::optional<glm::dvec3>& a, const std::optional<glm::dvec3>& b, const std::optional<glm::dvec3>& c)
    {
        if (!a || !b || !c)
            return;
        const double side = std::max({glm::distance(*a, *b), glm::distance(*b, *c), glm::distance(*c, *a)});
        if (!(side < widest))
            return;
        // All bins within the cone about the first corner that encloses the others.
        const glm::dvec2 at = azimuth_elevation_deg(*a);
        const double reach = 2 * glm::degrees(std::asin(side / 2)) + 1e-9, top = std::abs(at.y) + reach;
        const double aside = top < 90
            ? glm::degrees(std::asin(std::min(1.0, std::sin(glm::radians(reach)) / std::cos(glm::radians(at.y)))))
            : 180;
        const int index = int(triangles_.size());
        triangles_.push_back({*a, *b, *c});
        const int first = int(std::floor((at.x - aside + 180) / 2)), last = int(std::floor((at.x + aside + 180) / 2));
        for (int r = row(at.y - reach); r <= row(at.y + reach); ++r)
            for (int i = first; i <= std::min(last, first + columns - 1); ++i)
                bins_[std::size_t(r) * columns + (i + 2 * columns) % columns].push_back(index);
    }

    std::vector<std::array<glm::dvec3, 3>> triangles_;
    std::vector<std::vector<int>> bins_ = std::vector<std::vector<int>>(std::size_t(columns) * rows);
};

/// The outlines of the shown cells, by marching squares. Each edge between a shown and an unshown cell is bisected to
/// find the crossing.
class Tracer {
public:
    Tracer(const std::vector<bool>& cells, const Shows& shows)
        : cells_(cells)
        , shows_(shows)
    {
    }

    std::vector<std::vector<glm::dvec2>> outlines()
    {
        // The corners of a square in turn, and the paths between them. A ring of unshown cells surrounds the map.
        for (int y = -1; y < lattice_rows; ++y)
            for (int x = -1; x < lattice_columns; ++x) {
                const glm::ivec2 corners[]{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}};
                for (int i = 0; i < 4; ++i) {
                    if (!in(corners[i]) || in(corners[(i + 1) % 4]))
                        continue;
                    int j = (i + 1) % 4; // where the path enters the square again
                    while (in(corners[j]) || !in(corners[(j + 1) % 4]))
                        j = (j + 1) % 4;
                    next_[crossing(corners[i], corners[(i + 1) % 4])] = crossing(corners[j], corners[(j + 1) % 4]);
                }
            }
        std::vector<std::vector<glm::dvec2>> loops;
        while (!next_.empty()) {
            std::vector<glm::dvec2> loop;
            for (auto at = next_.begin(); at != next_.end();) {
                loop.push_back(points_[at->first]);
                const int to = at->second;
                next_.erase(at);
                at = next_.find(to);
            }
            loops.push_back(plain(loop));
        }
        return loops;
    }

private:
    bool in(glm::ivec2 cell) const
    {
        return cell.x >= 0 && cell.y >= 0 && cell.x < lattice_columns && cell.y < lattice_rows
            && cells_[std::size_t(cell.y) * lattice_columns + cell.x];
    }

    /// The index of the edge between two neighbours. The first call computes the point where the shown part ends.
    int crossing(glm::ivec2 a, glm::ivec2 b)
    {
        const glm::ivec2 low = glm::min(a, b) + 1;
        const int name = 2 * (low.y * (lattice_columns + 2) + low.x) + (a.x == b.x);
        if (points_.count(name))
            return name;
        if (!in(a))
            std::swap(a, b);
        glm::dvec2 inside = lattice_point(a.x, a.y), outside = lattice_point(b.x, b.y);
        if (b.x < 0 || b.y < 0 || b.x >= lattice_columns || b.y >= lattice_rows)
            inside = outside = (inside + outside) / 2.; // the map's edge
        for (int i = 0; i < 12; ++i) {
            const glm::dvec2 middle = (inside + outside) / 2.;
            (shows_(direction_of(middle)) ? inside : outside) = middle;
        }
        points_[name] = (inside + outside) / 2.;
        return name;
    }

    /// Removes points that lie on the line between their neighbours, to 0.005 degrees.
    static std::vector<glm::dvec2> plain(const std::vector<glm::dvec2>& loop)
    {
        std::vector<glm::dvec2> kept;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            if (!kept.empty()) {
                const glm::dvec2 &from = kept.back(), to = loop[(i + 1) % loop.size()], way = to - from,
                                 off = loop[i] - from;
                const double length = glm::length(way);
                if (length > 0 && length < 10 && std::abs(way.x * off.y - way.y * off.x) < 0.005 * length
                    && glm::dot(off, way) > 0)
                    continue;
            }
            kept.push_back(loop[i]);
        }
        return kept;
    }

    const std::vector<bool>& cells_;
    const Shows& shows_;
    std::unordered_map<int, int> next_; ///< crossings, along the outlines
    std::unordered_map<int, glm::dvec2> points_;
};

/// The smallest arc that contains every column with a shown cell; the outlines give its ends.
std::optional<glm::dvec2> azimuths(const Coverage& coverage)
{
    std::vector<double> all;
    for (int column = 0; column < lattice_columns; ++column)
        for (int row = 0; row < lattice_rows; ++row)
            if (coverage.cells[std::size_t(row) * lattice_columns + column]) {
                all.push_back(lattice_point(column, row).x);
                break;
            }
    for (const auto& outline : coverage.outlines)
        for (const glm::dvec2& point : outline)
            all.push_back(point.x);
    if (all.empty())
        return glm::dvec2(0);
    std::sort(all.begin(), all.end());
    std::size_t after = 0; // the end of the widest gap
    double widest = all.front() + 360 - all.back();
    for (std::size_t i = 1; i < all.size(); ++i)
        if (all[i] - all[i - 1] > widest) {
            widest = all[i] - all[i - 1];
            after = i;
        }
    if (widest < 1.01 / lattice)
        return {};
    return glm::dvec2(all[after], all[after] + 360 - widest);
}

/// The square root of a pixel's solid angle, from the directions half a pixel to each side.
double sight_angle(const std::function<std::optional<glm::dvec3>(glm::dvec2)>& sight, glm::dvec2 at)
{
    const auto left = sight(at - glm::dvec2(0.5, 0)), right = sight(at + glm::dvec2(0.5, 0));
    const auto above = sight(at - glm::dvec2(0, 0.5)), below = sight(at + glm::dvec2(0, 0.5));
    if (!left || !right || !above || !below)
        return 0;
    return std::sqrt(glm::length(glm::cross(*right - *left, *below - *above)));
}

void measure_pixels(Coverage& coverage, const std::function<double(glm::dvec2)>& pixel_angle)
{
    const auto per_degree = [&](glm::dvec2 fraction) {
        const glm::dvec2 at
            = glm::min(glm::floor(glm::dvec2(coverage.size) * fraction), glm::dvec2(coverage.size) - 1.) + 0.5;
        const double angle = pixel_angle(at);
        return angle > 0 ? 1 / glm::degrees(angle) : 0;
    };
    coverage.middle = per_degree(glm::dvec2(0.5));
    constexpr int steps = 64;
    for (int y = 0; y <= steps; ++y)
        for (int x = 0; x <= steps; ++x) {
            const double here = per_degree(glm::dvec2(x, y) / double(steps));
            if (here > 0) {
                coverage.least = coverage.least > 0 ? std::min(coverage.least, here) : here;
                coverage.most = std::max(coverage.most, here);
            }
        }
}

/// The size of an eye's picture of an output, before the packing squeezes it.
glm::ivec2 eye_picture(const Output& output)
{
    if (output.packing == Packing::side_by_side)
        return {std::max(output.size.x / 2, 1), output.size.y};
    if (output.packing == Packing::top_and_bottom)
        return {output.size.x, std::max(output.size.y / 2, 1)};
    return output.size;
}

Picture picture_of(const Layout& layout, const Viewport& viewport, glm::ivec2 size, Eye eye)
{
    const double side = eye == Eye::left ? -0.5 : eye == Eye::right ? 0.5 : 0;
    return {viewport.projection, size, viewport.eye_m + glm::dvec3(side * layout.stereo.separation_m, 0, 0)};
}

/// True if a viewport of a higher order and without a mask hides a point of an eye's picture; null where none overlaps.
/// A mask of its warp file is not known here.
std::function<bool(glm::dvec2)> hides(
    const Layout& layout, const Output& output, const Viewport& lower, Eye eye, const ViewRegion& given)
{
    std::vector<std::function<bool(glm::dvec2)>> each;
    for (const Viewport& upper : output.viewports) {
        const bool of_eye = upper.eye == Eye::middle || upper.eye == eye;
        if (upper.order <= lower.order || !upper.alpha_mask.empty() || !overlap(upper, lower) || !of_eye)
            continue;
        const glm::ivec4 rect = pixel_rect(upper, eye_picture(output));
        const Picture picture = picture_of(layout, upper, {rect.z, rect.w}, eye);
        each.push_back([&output, &upper, &given, rect, rays = PictureRays(picture)](glm::dvec2 at) {
            const glm::dvec2 own = at - glm::dvec2(rect.x, rect.y);
            if (own.x < 0 || own.y < 0 || own.x >= rect.z || own.y >= rect.w)
                return false;
            return given && upper.warp ? given(output, upper, own).has_value() : rays.direction(own).has_value();
        });
    }
    if (each.empty())
        return {};
    return [each](glm::dvec2 at) { return std::any_of(each.begin(), each.end(), [&](const auto& one) { return one(at); }); };
}

Coverage cover(const Layout& layout, int o, int v, Eye eye, const ViewRegion& given)
{
    const Output& output = layout.outputs[o];
    const Viewport& viewport = output.viewports[v];
    const glm::ivec4 rect = pixel_rect(viewport, eye_picture(output));
    Coverage coverage{o, v, eye, layout.outputs[std::size_t(o)].viewports[std::size_t(v)].observer, {rect.z, rect.w}};
    const Picture picture = picture_of(layout, viewport, coverage.size, eye);
    const auto hidden = hides(layout, output, viewport, eye, given);
    const auto in_output = [corner = glm::dvec2(rect.x, rect.y)](glm::dvec2 pixel) { return corner + pixel; };
    Shows shown;
    if (given && viewport.warp) {
        const auto sight = [&](glm::dvec2 pixel) -> std::optional<glm::dvec3> {
            if (hidden && hidden(in_output(pixel)))
                return {};
            return given(output, viewport, pixel);
        };
        coverage.looks = sight(glm::dvec2(coverage.size) / 2.);
        shown = [patch = Patch(sight, coverage.size)](const glm::dvec3& d) { return patch.shows(d); };
        measure_pixels(coverage, [&](glm::dvec2 at) { return sight_angle(sight, at); });
    } else {
        coverage.looks = direction(picture, glm::dvec2(coverage.size) / 2.);
        shown = [rays = PictureRays(picture), hidden, in_output, size = glm::dvec2(picture.size)](const glm::dvec3& d) {
            const auto at = rays.pixel(d);
            return at && at->x >= 0 && at->y >= 0 && at->x <= size.x && at->y <= size.y
                && !(hidden && hidden(in_output(*at)));
        };
        measure_pixels(coverage, [rays = PictureRays(picture)](glm::dvec2 at) { return rays.pixel_angle(at); });
    }
    coverage.cells.resize(std::size_t(lattice_columns) * lattice_rows);
    double sum = 0, all = 0;
    double lowest = 90, highest = -90;
    for (int row = 0; row < lattice_rows; ++row) {
        const double weight = std::cos(glm::radians(lattice_point(0, row).y));
        int found = 0;
        for (int column = 0; column < lattice_columns; ++column) {
            const bool here = shown(direction_of(lattice_point(column, row)));
            coverage.cells[std::size_t(row) * lattice_columns + column] = here;
            found += here;
        }
        sum += weight * found;
        all += weight * lattice_columns;
    }
    coverage.share = sum / all;
    coverage.outlines = Tracer(coverage.cells, shown).outlines();
    for (const auto& outline : coverage.outlines)
        for (const glm::dvec2& point : outline) {
            lowest = std::min(lowest, point.y);
            highest = std::max(highest, point.y);
        }
    if (lowest <= highest)
        coverage.elevations = {lowest, highest};
    coverage.azimuths = azimuths(coverage);
    return coverage;
}

} // namespace

glm::dvec2 lattice_point(int column, int row)
{
    return glm::dvec2(column + 0.5, row + 0.5) / double(lattice) - glm::dvec2(180, 90);
}

std::vector<Coverage> coverages(const Layout& layout, const ViewRegion& sight)
{
    std::vector<Coverage> all;
    for (Eye eye : has_two_eyes(layout) ? std::vector{Eye::left, Eye::right} : std::vector{Eye::middle})
        for (std::size_t o = 0; o < layout.outputs.size(); ++o)
            for (std::size_t v = 0; v < layout.outputs[o].viewports.size(); ++v)
                if (const Eye of = layout.outputs[o].viewports[v].eye; of == eye || of == Eye::middle)
                    all.push_back(cover(layout, int(o), int(v), eye, sight));
    return all;
}

double shared_part(const Coverage& first, const Coverage& second)
{
    double of_first = 0, of_both = 0;
    for (int row = 0; row < lattice_rows; ++row) {
        const double weight = std::cos(glm::radians(lattice_point(0, row).y));
        for (int column = 0; column < lattice_columns; ++column) {
            const std::size_t at = std::size_t(row) * lattice_columns + column;
            of_first += weight * first.cells[at];
            of_both += weight * (first.cells[at] && second.cells[at]);
        }
    }
    return of_first > 0 ? of_both / of_first : 0;
}

} // namespace starbow
