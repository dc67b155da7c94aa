#include "eye_fields.h"
#include "displays/compile/compiled_view.h"
#include "displays/finish/shade.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// Pixels with less of the light than this are black, as masks mean them.
constexpr double least_factor = 0.05;

/// The compiled views of all outputs, with maps.
std::vector<std::vector<CompiledView>> compiled(const Layout& layout)
{
    MapStore store{std::filesystem::path()};
    store.matrices(false);
    std::vector<std::vector<CompiledView>> views;
    for (std::size_t output = 0; output < layout.outputs.size(); ++output) {
        views.push_back(compile_output(store, layout, output, layout.outputs[output].size));
        reject_empty(layout, views.back());
    }
    return views;
}

/// Green's direction, where colours have directions of their own.
const glm::vec4& texel(const DirectionMap& map, int x, int y) { return map.at(x, y, map.channels == 3 ? 1 : 0); }

/// The step from a shown pixel to its neighbours along x or y, half of that between both of them where both are shown.
glm::dvec3 step(const DirectionMap& map, int x, int y, glm::ivec2 way)
{
    glm::dvec3 sum(0);
    int count = 0;
    for (const int sign : {-1, 1}) {
        const glm::ivec2 p = glm::ivec2(x, y) + sign * way;
        if (p.x < 0 || p.y < 0 || p.x >= map.size.x || p.y >= map.size.y || !(texel(map, p.x, p.y).w > 0))
            continue;
        sum += double(sign) * (glm::dvec3(texel(map, p.x, p.y)) - glm::dvec3(texel(map, x, y)));
        ++count;
    }
    return count > 0 ? sum / double(count) : sum;
}

/// From the directions around, whatever the projection.
double solid_angle_sr(const DirectionMap& map, int x, int y)
{
    return glm::length(glm::cross(step(map, x, y, {1, 0}), step(map, x, y, {0, 1})));
}

/// The angle that nearly all pixels of an output's views stay below, radians; 0 where nothing is shown.
double pixel_angle(const std::vector<CompiledView>& views)
{
    constexpr double nearly_all = 0.98;
    std::vector<double> angles;
    for (const CompiledView& view : views)
        for (int y = 0; y < view.map->size.y; ++y)
            for (int x = 0; x < view.map->size.x; ++x)
                if (texel(*view.map, x, y).w > 0)
                    angles.push_back(std::sqrt(solid_angle_sr(*view.map, x, y)));
    if (angles.empty())
        return 0;
    const auto at = angles.begin() + std::ptrdiff_t(nearly_all * double(angles.size() - 1));
    std::nth_element(angles.begin(), at, angles.end());
    return *at;
}

/// The size with the greater side `longest` and the same shape.
glm::ivec2 scaled(glm::ivec2 size, double longest)
{
    const double by = longest / std::max(size.x, size.y);
    return glm::max(glm::ivec2(glm::round(glm::dvec2(size) * by)), 1);
}

/// One view's place in its output, the higher ones last.
struct Placed {
    const CompiledView* view;
    int order;
};

bool of_eye(const View& view, Eye eye) { return view.eye == eye || view.eye == Eye::middle; }

/// The number of other pictures that show an eye the same direction: projectors that overlap.
int others_that_show(const std::vector<Placed>& views, const CompiledView& own, Eye eye, const glm::dvec3& direction)
{
    return int(std::count_if(views.begin(), views.end(), [&](const Placed& other) {
        const View &a = own.view, &b = other.view->view;
        const bool same_pixels = a.output == b.output && glm::all(glm::lessThan(a.corner, b.corner + b.size))
            && glm::all(glm::lessThan(b.corner, a.corner + a.size));
        return other.view != &own && !same_pixels && of_eye(b, eye) && a.observer == b.observer
            && find_pixel(*other.view->map, *other.view->cones, direction);
    }));
}

struct Fields {
    const Layout& layout;
    std::vector<Placed> all{};
    std::vector<Shade> shades{};
    double room = 1; ///< headroom
    std::vector<EyeField> fields{};

    EyeField& field(Eye eye, const ViewportObserver& observer)
    {
        for (EyeField& one : fields)
            if (one.eye == eye && one.observer == observer)
                return one;
        return fields.emplace_back(EyeField{eye, observer, {}});
    }
    void add(std::size_t output, std::span<const Eye> eyes);
};

void Fields::add(std::size_t output, std::span<const Eye> eyes)
{
    // Of viewports that overlap, the highest that shows something has the pixel.
    const glm::ivec2 size = layout.outputs[output].size;
    std::vector<const Placed*> owners(std::size_t(size.x) * std::size_t(size.y), nullptr);
    for (const Placed& placed : all) {
        const View& view = placed.view->view;
        for (int y = 0; view.output == output && y < view.size.y; ++y)
            for (int x = 0; x < view.size.x; ++x)
                if (texel(*placed.view->map, x, y).w > 0)
                    owners[std::size_t(view.corner.y + y) * std::size_t(size.x) + std::size_t(view.corner.x + x)] = &placed;
    }
    const Shade& shade = shades[output];
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const std::size_t index = std::size_t(y) * std::size_t(size.x) + std::size_t(x);
            if (!owners[index])
                continue;
            const CompiledView& own = *owners[index]->view;
            const glm::ivec2 p = glm::ivec2(x, y) - own.view.corner;
            EyePixel pixel{output, {x, y}, glm::normalize(glm::dvec3(texel(*own.map, p.x, p.y))),
                solid_angle_sr(*own.map, p.x, p.y), glm::dvec3(room), glm::dvec3(0)};
            if (!shade.weight.empty())
                pixel.factor *= glm::dvec3(shade.weight[index]);
            if (!shade.black.empty())
                pixel.addend = glm::dvec3(shade.black[index]);
            if (std::max({pixel.factor.r, pixel.factor.g, pixel.factor.b}) < least_factor)
                continue;
            pixel.factor = glm::max(pixel.factor, least_factor);
            for (const Eye eye : eyes)
                if (of_eye(own.view, eye)) {
                    EyePixel part = pixel;
                    part.solid_angle_sr /= 1 + others_that_show(all, own, eye, pixel.direction);
                    field(eye, own.view.observer).pixels.push_back(part);
                }
        }
}

} // namespace

Layout seen_layout(Layout layout, double pixel_rad)
{
    std::erase_if(layout.outputs, [](const Output& output) { return output.preview; });
    layout.blend.ramps = false;
    for (Output& output : layout.outputs) {
        output.colour = {};
        if (canvas_count(output.packing) == 2) {
            output.packing = Packing::side_by_side;
            output.size.x *= 2;
        }
    }
    constexpr double trial_px = 96;
    Layout trial = layout;
    for (Output& output : trial.outputs)
        output.size = scaled(output.size, std::min<double>(trial_px, std::max(output.size.x, output.size.y)));
    const std::vector<std::vector<CompiledView>> views = compiled(trial);
    for (std::size_t i = 0; i < views.size(); ++i) {
        const glm::ivec2 size = layout.outputs[i].size, tried = trial.outputs[i].size;
        const double wanted = std::max(tried.x, tried.y) * pixel_angle(views[i]) / pixel_rad;
        layout.outputs[i].size = scaled(size, std::clamp<double>(wanted, 1, std::max(size.x, size.y)));
    }
    return layout;
}

std::vector<EyeField> eye_fields(const Layout& seen)
{
    const std::vector<std::vector<CompiledView>> views = compiled(seen);
    Fields fields{seen};
    for (std::size_t output = 0; output < views.size(); ++output) {
        fields.shades.push_back(shade_of(seen, output, seen.outputs[output].size, views[output], {}));
        for (const CompiledView& view : views[output])
            fields.all.push_back({&view, seen.outputs[output].viewports[view.view.viewport].order});
    }
    std::ranges::stable_sort(fields.all, {}, &Placed::order);
    fields.room = headroom(fields.shades);
    const std::vector<Eye> eyes = has_two_eyes(seen) ? std::vector{Eye::left, Eye::right} : std::vector{Eye::middle};
    for (std::size_t output = 0; output < views.size(); ++output)
        fields.add(output, eyes);
    std::ranges::stable_sort(fields.fields, {}, &EyeField::eye);
    return std::move(fields.fields);
}

} // namespace starbow
