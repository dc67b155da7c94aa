#include "lint.h"
#include "displays/projections/wall.h"
#include "floor_plan_table.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// Longer than any screen and any exhibit's room.
constexpr double huge_m = 100;
/// Farther from the cockpit's middle than any visitor, and eyes farther apart than any head has them.
constexpr double far_eye_m = 20, far_apart_m = 0.2;
/// Narrower than any display, in degrees. Half a turn in radians is about as much.
constexpr double narrow_deg = 3.5;

std::string rounded(double number) { return short_number(number); }

std::string odd_size(const Viewport& viewport)
{
    const Projection& projection = viewport.projection;
    if (auto* wall = std::get_if<Wall>(&projection)) {
        const double width = glm::distance(wall->lower_left_m, wall->lower_right_m);
        if (width > huge_m)
            return "its wall is " + rounded(width) + " m wide; lengths are in metres";
    } else if (auto* mirror = std::get_if<SphericalMirror>(&projection)) {
        if (std::max(mirror->dome_radius_m, mirror->mirror_radius_m) > huge_m)
            return "its dome or mirror has a radius of " + rounded(std::max(mirror->dome_radius_m, mirror->mirror_radius_m))
                + " m; lengths are in metres";
    } else if (auto* planar = std::get_if<Planar>(&projection)) {
        if (!planar->sides && planar->fov_y_deg < narrow_deg)
            return "its picture is " + rounded(planar->fov_y_deg) + "° high; angles are in degrees";
    } else if (auto* dome = std::get_if<Fisheye>(&projection)) {
        if (dome->aperture_deg < 2 * narrow_deg)
            return "its dome is " + rounded(dome->aperture_deg) + "° across; angles are in degrees";
    }
    return "";
}

/// Says which way a wall's picture lies if its corners seem exchanged. A floor's upper edge is in front, a ceiling's behind.
std::string odd_corners(const Wall& wall)
{
    const glm::dvec3 right = glm::normalize(wall.lower_right_m - wall.lower_left_m),
                     up = glm::normalize(wall.upper_left_m - wall.lower_left_m), to_room = glm::cross(right, up);
    const bool floor = to_room.y > 0.75, ceiling = to_room.y < -0.75;
    const double upright = floor ? -up.z : ceiling ? up.z : up.y;
    constexpr double sideways = 0.5; // as far as a wall leans or turns
    if (upright > sideways || ((floor || ceiling) && upright > -sideways))
        return "";
    return std::string("its picture ") + (upright < -sideways ? "stands on its head" : "lies on its side")
        + "; corners may be exchanged: lower left, lower right and upper left are those that the visitor sees";
}

/// Says how far each corner lies from the rectangle, or the plane, that is fitted to a wall's corners.
std::string moved_corners(const Wall& wall)
{
    constexpr double shown_m = 0.0005;
    const std::array<double, 4> moved = fitted_corners(wall).moved_m;
    if (*std::ranges::max_element(moved) < shown_m)
        return "";
    std::string text = wall.upper_right_m ? "its corners lie in no plane; the nearest one is shown, at"
                                          : "its corners make no rectangle; the nearest one is shown, at";
    const char* const names[]{"lower left", "lower right", "upper right", "upper left"};
    for (std::size_t i = 0; i < 4; ++i)
        if (wall.upper_right_m || i != 2)
            text += (i == 0 ? " the " : ", the ") + std::string(names[i]) + " " + rounded(1e3 * moved[i]) + " mm off";
    return text;
}

/// The ratio of a wall's pixels' width to their height.
double pixel_shape(const Wall& wall, glm::ivec2 pixels)
{
    const double width = glm::distance(wall.lower_left_m, wall.lower_right_m) / pixels.x;
    return width / (glm::distance(wall.lower_left_m, wall.upper_left_m) / pixels.y);
}

bool masked(const Layout& layout, const Coverage& c)
{
    const Viewport& viewport = layout.outputs[c.output].viewports[c.viewport];
    return !viewport.alpha_mask.empty() || viewport.warp; // a calibration may bring its own
}

/// Notes on the layout's eyes: their distance, the depth that they show, and the tracker that moves them.
std::vector<std::string> eye_warnings(const Layout& layout, const std::vector<Coverage>& coverages)
{
    std::vector<std::string> all;
    const bool two_eyes = has_two_eyes(layout);
    if (two_eyes && layout.stereo.separation_m > far_apart_m)
        all.push_back("the eyes are " + rounded(layout.stereo.separation_m) + " m apart; lengths are in metres");
    if (two_eyes && layout.stereo.hyper_stereo == 1 && !layout.stereo.by_light
        && layout.stereo.method != StereoMethod::shared)
        all.push_back("two eyes show no depth in worlds whose unit is a light-second, such as the shipped ones: there "
                      "\"stereo\" needs a \"hyper_stereo\", such as \"by-light\"");
    if (layout.head_tracker) {
        const bool wall = std::any_of(coverages.begin(), coverages.end(), [&](const Coverage& c) {
            return std::holds_alternative<Wall>(
                layout.outputs[std::size_t(c.output)].viewports[std::size_t(c.viewport)].projection);
        });
        all.push_back("a head tracker is expected at UDP port " + std::to_string(layout.head_tracker->port) + " of "
            + layout.head_tracker->address + ", in opentrack's format"
            + (wall ? "" : "; no viewport is a wall, so it moves the eyes and no frame"));
    }
    return all;
}

} // namespace

std::vector<std::string> lint(const Layout& layout, const std::vector<Coverage>& coverages)
{
    std::vector<std::string> all;
    auto doubt = [&](std::string line) {
        if (std::find(all.begin(), all.end(), line) == all.end()) // each eye has a coverage of its own
            all.push_back(std::move(line));
    };
    for (const Coverage& c : coverages) {
        const Viewport& viewport = layout.outputs[c.output].viewports[c.viewport];
        const std::string name = viewport_name(layout, c.output, c.viewport);
        if (const std::string odd = odd_size(viewport); !odd.empty())
            doubt(name + ": " + odd);
        const auto& all_of = layout.outputs[c.output].viewports;
        if (c.share == 0 && std::any_of(all_of.begin(), all_of.end(), [&](const Viewport& other) {
                return other.order > viewport.order && overlap(other, viewport);
            }))
            doubt(name + ": viewports of a higher \"order\" hide all of it");
        if (glm::length(viewport.eye_m) > far_eye_m)
            doubt(name + ": its eye is " + rounded(glm::length(viewport.eye_m))
                + " m from the cockpit's middle; lengths are in metres");
        if (auto* wall = std::get_if<Wall>(&viewport.projection))
            for (const std::string& odd : {odd_corners(*wall), moved_corners(*wall)})
                if (!odd.empty())
                    doubt(name + ": " + odd);
        if (auto* wall = std::get_if<Wall>(&viewport.projection); wall && !viewport.warp && !wall->upper_right_m) {
            // In a squeezed packing too, the eye's picture has the output's shape.
            const glm::ivec2 size = layout.outputs[c.output].size;
            const glm::dvec2 pixels = glm::dvec2(size) * glm::dvec2(viewport.rect.z, viewport.rect.w);
            const Packing packing = layout.outputs[c.output].packing;
            const glm::dvec2 own(pixels.x / (packing == Packing::side_by_side ? 2 : 1),
                pixels.y / (packing == Packing::top_and_bottom ? 2 : 1));
            const double shape = pixel_shape(*wall, glm::max(glm::ivec2(own), 1));
            if (std::abs(std::log(shape)) > 0.02)
                doubt(name + ": its pixels are " + rounded(100 * std::abs(shape > 1 ? shape - 1 : 1 / shape - 1)) + " % "
                    + (shape > 1 ? "wider than high" : "higher than wide")
                    + "; the wall's measures or the output's size may be wrong");
        }
    }
    for (std::size_t i = 0; i < coverages.size() && !layout.blend.ramps; ++i)
        for (std::size_t j = i + 1; j < coverages.size(); ++j) {
            const Coverage &a = coverages[i], &b = coverages[j];
            if (a.eye != b.eye || a.observer != b.observer || a.output == b.output || masked(layout, a) || masked(layout, b)
                || std::max(shared_part(a, b), shared_part(b, a)) < 0.02)
                continue;
            doubt(viewport_name(layout, a.output, a.viewport) + " and " + viewport_name(layout, b.output, b.viewport)
                + " overlap, with neither masks nor \"blend\": where they do, two projectors would light it twice");
        }
    for (const std::string& line : eye_warnings(layout, coverages))
        doubt(line);
    for (const Output& output : layout.outputs)
        if (!output.monitor.connector.empty() || !output.monitor.serial.empty() || !output.monitor.model.empty()) {
            doubt("monitors are not looked for here; starbow displays lists those that are there");
            break;
        }
    return all;
}

} // namespace starbow
