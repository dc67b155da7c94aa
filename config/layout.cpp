#include "layout.h"
#include "reader.h"
#include <algorithm>
#include <cctype>

namespace starbow {
namespace {

constexpr int most_pixels_across = 16384;
static_assert(most_pixels_across <= (1 << 28) / most_pixels_across, "an output's pixels are counted in an int");

/// Fractions such as 0.3333 and 0.6667 meet well enough: this is 1/60 of the widest output's pixel.
constexpr double slack = 1e-6;

Projection read_projection(const Place& place)
{
    only(place, {"type", "fov_y_deg", "aperture_deg", "tilt_deg"});
    if (one_of(member(place, "type"), {"planar", "fisheye"}) == "planar") {
        only(place, {"type", "fov_y_deg"});
        Planar planar;
        if (auto p = find(place, "fov_y_deg"))
            planar.fov_y_deg = number(*p, {0.1, 179});
        return planar;
    }
    only(place, {"type", "aperture_deg", "tilt_deg"});
    Fisheye fisheye;
    if (auto p = find(place, "aperture_deg"))
        fisheye.aperture_deg = number(*p, {1, 360});
    if (auto p = find(place, "tilt_deg"))
        fisheye.tilt_deg = number(*p, {-180, 180});
    return fisheye;
}

Viewport read_viewport(const Place& place, glm::ivec2 size)
{
    only(place, {"rect", "projection", "eye_m"});
    Viewport viewport;
    if (auto p = find(place, "rect")) {
        viewport.rect = vec4(*p, {0, 1});
        const glm::dvec4& r = viewport.rect;
        if (r.z <= 0 || r.w <= 0)
            complain(*p, "is empty; x, y, width and height in fractions of the output, the last two above 0, is right");
        if (r.x + r.z > 1 + slack || r.y + r.w > 1 + slack)
            complain(*p, "reaches beyond the output; x + width and y + height up to 1 is right");
        const glm::ivec4 pixels = pixel_rect(viewport, size);
        if (pixels.z < 1 || pixels.w < 1)
            complain(*p,
                "is smaller than a pixel of the " + std::to_string(size.x) + " x " + std::to_string(size.y)
                    + " output; at least one pixel each way is right");
    }
    viewport.projection = read_projection(member(place, "projection"));
    if (auto p = find(place, "eye_m"))
        viewport.eye_m = vec3(*p, {-1e3, 1e3});
    return viewport;
}

bool overlap(const glm::dvec4& a, const glm::dvec4& b)
{
    return std::min(a.x + a.z, b.x + b.z) - std::max(a.x, b.x) > slack
        && std::min(a.y + a.w, b.y + b.w) - std::max(a.y, b.y) > slack;
}

std::string read_name(const Place& place)
{
    const std::string name = text(place);
    const bool usable = std::all_of(name.begin(), name.end(),
        [](char c) { return c == '_' || c == '-' || (static_cast<unsigned char>(c) < 0x80 && std::isalnum(c)); });
    if (!usable || name.size() > 64)
        complain(place, "can't be part of a file's name; up to 64 of the letters A-Z a-z 0-9 _ - is right");
    return name;
}

Output read_output(const Place& place)
{
    only(place, {"name", "size", "resizable", "viewports"});
    Output output;
    output.name = read_name(member(place, "name"));
    if (auto p = find(place, "size")) {
        const std::vector<Place> at = items(*p, 2, 2, "whole numbers");
        output.size = {integer(at[0], 1, most_pixels_across), integer(at[1], 1, most_pixels_across)};
    }
    if (auto p = find(place, "resizable"))
        output.resizable = boolean(*p);
    for (const Place& at : items(member(place, "viewports"), 1, 64, "viewports")) {
        const Viewport viewport = read_viewport(at, output.size);
        for (std::size_t i = 0; i < output.viewports.size(); ++i)
            if (overlap(viewport.rect, output.viewports[i].rect))
                complain(find(at, "rect").value_or(at),
                    "overlaps viewport " + std::to_string(i) + " of this output; rectangles that do not overlap is right");
        output.viewports.push_back(viewport);
    }
    return output;
}

HudPlacement read_hud(const Place& place)
{
    only(place, {"azimuth_deg", "elevation_deg", "width_deg"});
    HudPlacement hud;
    if (auto p = find(place, "azimuth_deg"))
        hud.azimuth_deg = number(*p, {-180, 180});
    if (auto p = find(place, "elevation_deg"))
        hud.elevation_deg = number(*p, {-90, 90});
    if (auto p = find(place, "width_deg"))
        hud.width_deg = number(*p, {1, 120});
    return hud;
}

} // namespace

glm::ivec4 pixel_rect(const Viewport& viewport, glm::ivec2 size)
{
    const glm::dvec4& r = viewport.rect;
    const glm::ivec2 from = glm::round(glm::dvec2(r.x, r.y) * glm::dvec2(size));
    const glm::ivec2 to = glm::min(glm::ivec2(glm::round(glm::dvec2(r.x + r.z, r.y + r.w) * glm::dvec2(size))), size);
    return {from, to - from};
}

Layout load_layout(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    const Place top = root(document);
    only(top, {"hyper_stereo", "hud", "outputs"});
    Layout layout;
    layout.name = file.stem().string();
    if (auto p = find(top, "hyper_stereo"))
        layout.stereo.hyper_stereo = number(*p, {0, 1e12, true});
    if (auto p = find(top, "hud"))
        layout.hud = read_hud(*p);
    for (const Place& at : items(member(top, "outputs"), 1, 64, "outputs")) {
        const Output output = read_output(at);
        for (std::size_t i = 0; i < layout.outputs.size(); ++i)
            if (output.name == layout.outputs[i].name)
                complain(
                    member(at, "name"), "is the name of output " + std::to_string(i) + " too; a name of its own is right");
        layout.outputs.push_back(output);
    }
    return layout;
}

} // namespace starbow
