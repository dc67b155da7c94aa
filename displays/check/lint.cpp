#include "lint.h"
#include "floor_plan_table.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// Longer than any screen and any exhibit's room.
constexpr double huge_m = 100;
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

/// The ratio of a wall's pixels' width to their height.
double pixel_shape(const Wall& wall, glm::ivec2 pixels)
{
    const double width = glm::distance(wall.lower_left_m, wall.lower_right_m) / pixels.x;
    return width / (glm::distance(wall.lower_left_m, wall.upper_left_m) / pixels.y);
}

bool lit(const std::vector<Coverage>& coverages, const Layout& layout, double azimuth_deg, double elevation_deg)
{
    const int column = int(std::floor((azimuth_deg + 180) * lattice) + 2 * lattice_columns) % lattice_columns;
    const int row = std::clamp(int(std::floor((elevation_deg + 90) * lattice)), 0, lattice_rows - 1);
    return std::any_of(coverages.begin(), coverages.end(), [&](const Coverage& c) {
        return !layout.outputs[c.output].preview && c.cells[std::size_t(row) * lattice_columns + column];
    });
}

/// The approximate share of the panel that some viewport shows, as if the panel lay on a sphere.
double panel_seen(const Layout& layout, const std::vector<Coverage>& coverages)
{
    constexpr int across = 12, high = 4;
    constexpr double aspect = 5; // width to height
    int seen = 0;
    for (int j = 0; j < high; ++j)
        for (int i = 0; i < across; ++i) {
            const double up = ((j + 0.5) / high - 0.5) * layout.hud.width_deg / aspect,
                         right = ((i + 0.5) / across - 0.5) * layout.hud.width_deg;
            const double elevation = layout.hud.elevation_deg + up;
            seen += std::abs(elevation) < 90
                && lit(coverages, layout, layout.hud.azimuth_deg + right / std::max(0.1, std::cos(glm::radians(elevation))),
                    elevation);
        }
    return double(seen) / (across * high);
}

bool masked(const Layout& layout, const Coverage& c)
{
    const Viewport& viewport = layout.outputs[c.output].viewports[c.viewport];
    return !viewport.alpha_mask.empty() || viewport.warp; // a calibration may bring its own
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
        if (auto* wall = std::get_if<Wall>(&viewport.projection); wall && !viewport.warp) {
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
                + " show the same in part, with neither masks nor \"blend\": two projectors would light it twice");
        }
    if (const double seen = panel_seen(layout, coverages); seen < 0.6)
        doubt("the head-up display, at azimuth " + rounded(layout.hud.azimuth_deg) + "° and elevation "
            + rounded(layout.hud.elevation_deg) + "°, is "
            + (seen == 0 ? "seen nowhere" : "seen in part (" + rounded(100 * seen) + " %)") + "; \"hud\" puts it elsewhere");
    for (const Output& output : layout.outputs)
        if (!output.monitor.connector.empty() || !output.monitor.serial.empty() || !output.monitor.model.empty()) {
            doubt("monitors are not looked for here; starbow displays lists those that are there");
            break;
        }
    return all;
}

} // namespace starbow
