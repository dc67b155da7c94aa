#include "blend.h"
#include "displays/compile/rows.h"
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

/// The distance of a view's pixels from where its light must have faded: the part of its edge beyond which another view's
/// light continues. A view does not fade towards an edge beyond which nothing is lit, as a wall's or a dome's rim.
struct Field {
    const CompiledView* view;
    std::shared_ptr<const DirectionMap> map;
    std::shared_ptr<const ConeHierarchy> cones;
    std::vector<float> to_fade; ///< from each pixel's centre, radians of an average pixel; with a border of one row of zeros
    float pixel = 0; ///< average pixel angle

    bool shows(glm::ivec2 p) const
    {
        return p.x >= 0 && p.y >= 0 && p.x < map->size.x && p.y < map->size.y && map->at(p.x, p.y).w > 0;
    }
    std::size_t index(int x, int y) const { return std::size_t(y + 1) * (map->size.x + 2) + x + 1; }
    float at(int x, int y) const { return to_fade[index(x, y)]; }
    /// The distance along a direction, interpolated between pixels; 0 if the direction is not shown.
    float along(const glm::dvec3& direction) const
    {
        const auto p = find_pixel(*map, *cones, direction);
        if (!p)
            return 0;
        const glm::dvec2 from = *p - 0.5, low = glm::floor(from);
        const glm::vec2 f = from - low;
        const int x = int(low.x), y = int(low.y);
        return glm::mix(glm::mix(at(x, y), at(x + 1, y), f.x), glm::mix(at(x, y + 1), at(x + 1, y + 1), f.x), f.y);
    }
};

/// True if two views are drawn on the same pixels, so that one covers the other. Views side by side may belong to two
/// projectors on one desktop.
bool share_pixels(const View& a, const View& b)
{
    return a.output == b.output && a.canvas == b.canvas && glm::all(glm::lessThan(a.corner, b.corner + b.size))
        && glm::all(glm::lessThan(b.corner, a.corner + a.size));
}

/// True if `upper` hides all that `lower` shows wherever `upper` shows something.
bool covers(const Layout& layout, const CompiledView& upper, const CompiledView& lower)
{
    const auto order = [&](const View& view) { return layout.outputs[view.output].viewports[view.viewport].order; };
    return share_pixels(upper.view, lower.view) && order(upper.view) > order(lower.view) && !has_mask(layout, upper);
}

/// A map without the pixels that other views of its output hide; the map itself where there are none.
std::shared_ptr<const DirectionMap> uncovered(const Layout& layout, const CompiledView& view,
    std::shared_ptr<const DirectionMap> map, std::span<const CompiledView> views)
{
    std::shared_ptr<DirectionMap> rest;
    for (const CompiledView& upper : views) {
        if (!covers(layout, upper, view))
            continue;
        if (!rest)
            rest = std::make_shared<DirectionMap>(*map);
        const glm::ivec2 from = glm::max(upper.view.corner, view.view.corner),
                         to = glm::min(upper.view.corner + upper.view.size, view.view.corner + view.view.size);
        for (int y = from.y; y < to.y; ++y)
            for (int x = from.x; x < to.x; ++x) {
                const glm::ivec2 above = glm::ivec2(x, y) - upper.view.corner, p = glm::ivec2(x, y) - view.view.corner;
                if (upper.matrix || upper.map->at(above.x, above.y).w > 0)
                    for (int channel = 0; channel < rest->channels; ++channel)
                        rest->texels[(std::size_t(channel) * rest->size.y + p.y) * rest->size.x + p.x] = glm::vec4(0);
            }
    }
    return rest ? rest : map;
}

Field field_of(const Layout& layout, const CompiledView& view, std::span<const CompiledView> views)
{
    Field field;
    field.view = &view;
    const auto whole = view.map ? view.map : std::make_shared<DirectionMap>(compile_direction_map(view.view));
    field.map = uncovered(layout, view, whole, views);
    field.cones = field.map == view.map ? view.cones : std::make_shared<ConeHierarchy>(*field.map);
    double sum = 0;
    long shown = 0;
    for (const glm::vec4& texel : std::span(field.map->texels).first(std::size_t(field.map->size.x) * field.map->size.y))
        if (texel.w > 0)
            sum += texel.w, ++shown;
    field.pixel = shown > 0 ? float(sum / double(shown)) : 0;
    return field;
}

/// Coinciding edges count as one, although a calibration has them some pixels apart.
constexpr double beyond_px = 4;

/// The unit direction, in pixels, in which the light of the shown pixel p ends towards the unshown neighbour at p + out.
/// It is perpendicular to the picture's own edge; at other edges the surrounding pixels give it.
glm::dvec2 outwards(const Field& field, glm::ivec2 p, glm::ivec2 out)
{
    const glm::ivec2 beside = p + out;
    if (beside.x < 0 || beside.y < 0 || beside.x >= field.map->size.x || beside.y >= field.map->size.y)
        return out;
    glm::dvec2 sum(0);
    constexpr int around = 4;
    for (int y = -around; y <= around; ++y)
        for (int x = -around; x <= around; ++x)
            if (x * x + y * y <= around * around && field.shows(p + glm::ivec2(x, y)))
                sum -= glm::dvec2(x, y);
    const double length = glm::length(sum);
    return length > 0 ? sum / length : glm::dvec2(out);
}

/// The map's extrapolated direction at p + way, way in pixels, from the shown pixel p.
glm::dvec3 going_on(const Field& field, glm::ivec2 p, const glm::dvec2& way)
{
    const auto look = [&](glm::ivec2 q) { return glm::dvec3(field.map->at(q.x, q.y)); };
    glm::dvec3 to = look(p);
    for (int axis = 0; axis < 2; ++axis) {
        const glm::ivec2 step(axis == 0, axis == 1), before = p - step, after = p + step;
        if (field.shows(before))
            to += way[axis] * (look(p) - look(before));
        else if (field.shows(after))
            to += way[axis] * (look(after) - look(p));
    }
    return glm::normalize(to);
}

/// Marks the unshown places beside a field's pixels beyond which another view's light continues.
std::vector<char> fades(const Field& own, const std::vector<const Field*>& others)
{
    std::vector<char> ends(std::size_t(own.map->size.x + 2) * (own.map->size.y + 2), 0);
    by_rows(own.map->size.y + 2, [&](int first, int end) {
        for (int y = first - 1; y < end - 1; ++y)
            for (int x = -1; x <= own.map->size.x; ++x) {
                if (own.shows({x, y}))
                    continue;
                char& fade = ends[own.index(x, y)];
                for (glm::ivec2 out : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
                    const glm::ivec2 p = glm::ivec2(x, y) - out;
                    if (fade || !own.shows(p))
                        continue;
                    const glm::dvec3 beyond = going_on(own, p, (0.5 + beyond_px) * outwards(own, p, out));
                    fade = std::any_of(others.begin(), others.end(),
                        [&](const Field* other) { return find_pixel(*other->map, *other->cones, beyond).has_value(); });
                }
            }
    });
    return ends;
}

void measure(Field& field, const std::vector<const Field*>& others)
{
    const int width = field.map->size.x + 2, height = field.map->size.y + 2;
    const std::vector<char> ends = fades(field, others);
    // A picture that covers everything its neighbours light has no such edge; then all its edges count.
    const bool any = std::find(ends.begin(), ends.end(), 1) != ends.end();
    constexpr double far = 1e12;
    std::vector<double> square(ends.size());
    for (int y = -1; y < height - 1; ++y)
        for (int x = -1; x < width - 1; ++x)
            square[field.index(x, y)] = (any ? ends[field.index(x, y)] : !field.shows({x, y})) ? 0 : far;
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
    field.to_fade.resize(square.size());
    // The edge is half way to the first unshown pixel.
    std::transform(square.begin(), square.end(), field.to_fade.begin(),
        [&](double away) { return float(std::max(std::sqrt(away) - 0.5, 0.0)) * field.pixel; });
}

/// Spacing, in pixels, of the points at which the other views' fields are evaluated; between them values are
/// interpolated.
constexpr int stride = 4;
/// Nearer to an edge than this each pixel is evaluated, because small errors matter there.
constexpr float sharp = 16;
/// Each pixel is also evaluated where the field bends by more than this part of itself between nodes: half way between
/// two edges it has a ridge.
constexpr float bend = 0.01f;

/// True if the field is linear enough around the cell with the node (x, y) at its top left.
bool linear_between(const std::vector<float>& nodes, glm::ivec2 count, int x, int y)
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
        std::vector<char> exact(count, 0); // cells whose pixels are all evaluated
        by_rows(nodes.y - 1, [&](int first, int end) {
            for (int y = first; y < end; ++y)
                for (int x = 0; x + 1 < nodes.x; ++x) {
                    const std::size_t at = std::size_t(y) * nodes.x + x;
                    const float least
                        = std::min({coarse[at], coarse[at + 1], coarse[at + nodes.x], coarse[at + nodes.x + 1]});
                    exact[at] = least < near_other || !linear_between(coarse, nodes, x, y);
                }
        });
        by_rows(size.y, [&](int first, int end) {
            for (int y = first; y < end; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const std::size_t at = std::size_t(y) * size.x + x;
                    if (own.map->texels[at].w <= 0)
                        continue;
                    const int i = x / stride, j = y / stride;
                    const float* corner = &coarse[std::size_t(j) * nodes.x + i];
                    const float a = corner[0], b = corner[1], c = corner[nodes.x], d = corner[nodes.x + 1];
                    float value;
                    if (std::max({a, b, c, d}) == 0)
                        value = 0; // -1 marks a corner that this view does not show
                    else if (exact[std::size_t(j) * nodes.x + i] || own.at(x, y) < near_own)
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
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const std::size_t at = std::size_t(y) * size.x + x;
            const double mine = std::pow(own.at(x, y), power);
            if (own.map->texels[at].w > 0 && mine > 0)
                weight[at] = float(mine / (mine + sum[at]));
        }
    return weight;
}

} // namespace

std::vector<std::vector<float>> blend_ramps(const Layout& layout, std::span<const CompiledView> views, double power)
{
    std::vector<Field> fields;
    std::vector<int> field_of_view(views.size(), -1);
    for (std::size_t i = 0; i < views.size(); ++i)
        if (!has_mask(layout, views[i])) {
            field_of_view[i] = int(fields.size());
            fields.push_back(field_of(layout, views[i], views));
        }
    std::vector<std::vector<const Field*>> others(fields.size());
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const View& own = fields[i].view->view;
        for (const Field& other : fields)
            if (other.view->view.eye == own.eye && other.view->view.observer == own.observer
                && !share_pixels(other.view->view, own))
                others[i].push_back(&other);
    }
    for (std::size_t i = 0; i < fields.size(); ++i)
        measure(fields[i], others[i]);
    std::vector<std::vector<float>> ramps(views.size());
    for (std::size_t i = 0; i < views.size(); ++i)
        if (const int own = field_of_view[i]; own >= 0)
            ramps[i] = ramp(fields[own], others[own], power);
    return ramps;
}

} // namespace starbow
