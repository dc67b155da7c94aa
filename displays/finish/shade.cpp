#include "shade.h"
#include "config/json/error.h"
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
    if (!stbi_info(file.c_str(), &mask.size.x, &mask.size.y, &channels))
        throw InputError(file.string(), "", "is no picture; a PNG file is right");
    constexpr int most = 16384;
    if (mask.size.x > most || mask.size.y > most)
        throw InputError(
            file.string(), "", "is larger than 16384 x 16384 pixels; a picture of the viewport's size is right");
    mask.channels = channels >= 3 ? 3 : 1;
    stbi_us* values = stbi_load_16(file.c_str(), &mask.size.x, &mask.size.y, &channels, mask.channels);
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

} // namespace

Shade shade_of(const Layout& layout, std::size_t output, glm::ivec2 size, std::span<const CompiledView> views,
    std::span<const std::vector<float>> ramps)
{
    Shade shade;
    shade.size = size;
    auto fill = [&](std::vector<glm::vec3>& values, const View& view, float nothing, auto&& value) {
        if (values.empty())
            values.assign(std::size_t(size.x) * size.y, glm::vec3(nothing));
        for (int y = 0; y < view.size.y; ++y)
            for (int x = 0; x < view.size.x; ++x)
                value(values[std::size_t(y + view.corner.y) * size.x + x + view.corner.x], x, y);
    };
    for (std::size_t i = 0; i < views.size(); ++i) {
        const View& view = views[i].view;
        // The first of two canvases that share pixels represents both; a preview shows pictures without shading.
        if (view.output != output || view.canvas > 0)
            continue;
        const Viewport& viewport = layout.outputs[output].viewports[view.viewport];
        auto read = [&](const char* member, const std::filesystem::path& file) {
            return on_behalf_of(layout, viewport_pointer(output, view.viewport) + member,
                [&] { return read_mask(file, viewport.mask_gamma); });
        };
        auto place = [&](int x, int y) { return (glm::dvec2(x, y) + 0.5) / glm::dvec2(view.size); };
        auto multiply = [&](const WarpMesh::Mask& mask) {
            fill(shade.weight, view, 1, [&](glm::vec3& w, int x, int y) { w *= light_at(mask, place(x, y)); });
        };
        auto add = [&](const WarpMesh::Mask& mask) {
            fill(shade.black, view, 0, [&](glm::vec3& b, int x, int y) { b += light_at(mask, place(x, y)); });
        };
        auto scale = [&](const std::vector<float>& by) {
            if (!by.empty())
                fill(shade.weight, view, 1, [&](glm::vec3& w, int x, int y) { w *= by[std::size_t(y) * view.size.x + x]; });
        };
        if (views[i].map)
            scale(views[i].map->intensity);
        if (!ramps.empty())
            scale(ramps[i]);
        if (!viewport.alpha_mask.empty())
            multiply(read("/alpha_mask", viewport.alpha_mask));
        else if (views[i].mesh && views[i].mesh->alpha)
            multiply(*views[i].mesh->alpha);
        if (!viewport.black_level.empty())
            add(read("/black_level", viewport.black_level));
        else if (views[i].mesh && views[i].mesh->beta)
            add(*views[i].mesh->beta);
    }
    return shade;
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
