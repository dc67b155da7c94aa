#include "composition.h"
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stb/stb_image.h>

namespace starbow {
namespace {

WarpMesh::Mask read_mask(const std::filesystem::path& file, double gamma)
{
    WarpMesh::Mask mask;
    mask.gamma = gamma;
    int channels = 0;
    const std::string bytes = read_whole(file, std::size_t(512) << 20, "a PNG file");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    if (!stbi_info_from_memory(data, int(bytes.size()), &mask.size.x, &mask.size.y, &channels))
        throw InputError(file.string(), "", "is not a picture; a PNG file is right");
    constexpr int most = 16384;
    if (mask.size.x > most || mask.size.y > most)
        throw InputError(
            file.string(), "", "is larger than 16384 x 16384 pixels; a picture of the viewport's size is right");
    mask.channels = channels >= 3 ? 3 : 1;
    stbi_us* values
        = stbi_load_16_from_memory(data, int(bytes.size()), &mask.size.x, &mask.size.y, &channels, mask.channels);
    if (!values)
        throw InputError(
            file.string(), "", std::string("can't be read (") + stbi_failure_reason() + "); a whole PNG file is right");
    mask.values.resize(std::size_t(mask.size.x) * mask.size.y * mask.channels);
    for (std::size_t i = 0; i < mask.values.size(); ++i)
        mask.values[i] = values[i] / 65535.0f;
    std::free(values);
    return mask;
}

/// The linear light of a mask at a place, fractions from its top left; interpolated between the pixels' centres.
glm::vec3 light_at(const WarpMesh::Mask& mask, const glm::dvec2& place)
{
    const glm::dvec2 from = glm::clamp(place * glm::dvec2(mask.size) - 0.5, glm::dvec2(0), glm::dvec2(mask.size - 1));
    const glm::ivec2 low = from, high = glm::min(low + 1, mask.size - 1);
    const glm::vec2 f = from - glm::dvec2(low);
    auto value = [&](int x, int y) {
        const float* p = &mask.values[(std::size_t(y) * mask.size.x + x) * mask.channels];
        return mask.channels == 3 ? glm::vec3(p[0], p[1], p[2]) : glm::vec3(p[0]);
    };
    const glm::vec3 v = glm::mix(glm::mix(value(low.x, low.y), value(high.x, low.y), f.x),
        glm::mix(value(low.x, high.y), value(high.x, high.y), f.x), f.y);
    return mask.gamma == 1 ? v : glm::pow(v, glm::vec3(float(mask.gamma)));
}

glm::dvec2 place(const View& view, int x, int y) { return (glm::dvec2(x, y) + 0.5) / glm::dvec2(view.size); }

} // namespace

ViewShade::ViewShade(const Layout& layout, const CompiledView& view, std::span<const float> ramp)
    : view_(&view)
    , ramp_(ramp)
{
    const std::size_t output = view.view.output;
    const Viewport& viewport = layout.outputs[output].viewports[view.view.viewport];
    auto read = [&](const char* member, const std::filesystem::path& file) {
        return on_behalf_of(layout, viewport_pointer(output, view.view.viewport) + member,
            [&] { return read_mask(file, viewport.mask_gamma); });
    };
    if (!viewport.alpha_mask.empty())
        alpha_ = read("/alpha_mask", viewport.alpha_mask);
    else if (view.mesh)
        alpha_ = view.mesh->alpha;
    if (!viewport.black_level.empty())
        black_ = read("/black_level", viewport.black_level);
    else if (view.mesh)
        black_ = view.mesh->beta;
}

bool ViewShade::shows(int x, int y, int channel) const
{
    return view_->matrix || view_->map->at(x, y, view_->channels() == 3 ? channel : 0).w > 0;
}

glm::vec3 ViewShade::mask(int x, int y) const { return alpha_ ? light_at(*alpha_, place(view_->view, x, y)) : glm::vec3(1); }

glm::vec3 ViewShade::lift(int x, int y) const { return black_ ? light_at(*black_, place(view_->view, x, y)) : glm::vec3(0); }

bool ViewShade::dims() const { return alpha_ || !ramp_.empty() || (view_->map && !view_->map->intensity.empty()); }

float ViewShade::brightness(int x, int y) const
{
    const std::size_t at = std::size_t(y) * std::size_t(view_->view.size.x) + std::size_t(x);
    return (view_->map && !view_->map->intensity.empty() ? view_->map->intensity[at] : 1) * (ramp_.empty() ? 1 : ramp_[at]);
}

Shade shade_of(const Layout& layout, std::size_t output, glm::ivec2 size, std::span<const CompiledView> views,
    std::span<const std::vector<float>> ramps)
{
    std::vector<ViewShade> own;
    bool overlapping = false;
    for (std::size_t i = 0; i < views.size(); ++i)
        if (views[i].view.output == output) {
            own.emplace_back(layout, views[i], ramps.empty() ? std::span<const float>() : ramps[i]);
            overlapping |= views[i].view.layer > 0;
        }
    if (overlapping)
        return composed(layout, size, own, false);
    Shade shade;
    shade.size = size;
    auto fill = [&](std::vector<glm::vec3>& values, const View& view, float nothing, auto&& value) {
        if (values.empty())
            values.assign(std::size_t(size.x) * size.y, glm::vec3(nothing));
        for (int y = 0; y < view.size.y; ++y)
            for (int x = 0; x < view.size.x; ++x)
                value(values[std::size_t(y + view.corner.y) * size.x + x + view.corner.x], x, y);
    };
    for (const ViewShade& each : own) {
        const View& view = each.view().view;
        if (view.canvas > 0)
            continue; // the first of two canvases that share pixels represents both
        if (each.dims())
            fill(shade.weight, view, 1, [&](glm::vec3& w, int x, int y) { w *= each.mask(x, y) * each.brightness(x, y); });
        if (each.has_lift())
            fill(shade.black, view, 0, [&](glm::vec3& b, int x, int y) { b += each.lift(x, y); });
    }
    return shade;
}

Shade preview_shade(const Layout& layout, glm::ivec2 size, std::span<const CompiledView> views)
{
    if (std::none_of(views.begin(), views.end(), [](const CompiledView& view) { return view.view.layer > 0; }))
        return {};
    std::vector<ViewShade> own;
    for (const CompiledView& view : views)
        own.emplace_back(layout, view, std::span<const float>());
    return composed(layout, size, own, true);
}

double headroom(std::span<const Shade> shades)
{
    float most = 0;
    for (const Shade& shade : shades)
        for (const glm::vec3& b : shade.black)
            most = std::max({most, b.r, b.g, b.b});
    return 1 - std::min(most, 0.9f);
}

} // namespace starbow
