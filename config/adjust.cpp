#include "adjust.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

using What = Adjustable::What;

/// The turn of a viewport's projection, if it has one of its own.
Turn* turn_of(Projection& projection)
{
    if (auto* planar = std::get_if<Planar>(&projection))
        return &planar->turn;
    if (auto* cylinder = std::get_if<Cylinder>(&projection))
        return &cylinder->turn;
    if (auto* equirectangular = std::get_if<Equirectangular>(&projection))
        return &equirectangular->turn;
    if (auto* cube = std::get_if<CubeFaces>(&projection))
        return &cube->turn;
    if (auto* lens = std::get_if<Lens>(&projection))
        return &lens->turn;
    return nullptr;
}

double* place_of(Layout& layout, const Adjustable& a)
{
    if (a.what == What::blend_power)
        return &layout.blend.power;
    if (a.what == What::hud_elevation)
        return &layout.hud.elevation_deg;
    Projection& projection = layout.outputs[a.output].viewports[a.viewport].projection;
    if (auto* dome = std::get_if<Fisheye>(&projection))
        return a.what == What::tilt ? &dome->tilt_deg : &dome->rotation_deg;
    if (auto* mirror = std::get_if<SphericalMirror>(&projection))
        return &mirror->dome_tilt_deg;
    Turn& turn = *turn_of(projection);
    return a.what == What::yaw ? &turn.yaw_deg : a.what == What::pitch ? &turn.pitch_deg : &turn.roll_deg;
}

} // namespace

std::vector<Adjustable> adjustables(const Layout& layout)
{
    std::vector<Adjustable> all;
    for (std::size_t output = 0; output < layout.outputs.size(); ++output)
        for (std::size_t viewport = 0; viewport < layout.outputs[output].viewports.size(); ++viewport) {
            const Viewport& own = layout.outputs[output].viewports[viewport];
            if (!own.projection_given)
                continue; // the calibration's own frustum
            std::string name = layout.outputs[output].name;
            if (layout.outputs[output].viewports.size() > 1)
                name.append(" ").append(std::to_string(viewport));
            const std::string at = "/outputs/" + std::to_string(output) + "/viewports/" + std::to_string(viewport) + "/projection/";
            auto add = [&](const char* what, const char* member, What which) {
                all.push_back({name + ", " + what, at + member, output, viewport, which, 0.1});
            };
            Projection projection = own.projection;
            if (std::holds_alternative<Fisheye>(projection)) {
                add("tilt", "tilt_deg", What::tilt);
                add("rotation", "rotation_deg", What::rotation);
            } else if (std::holds_alternative<SphericalMirror>(projection)) {
                add("tilt", "dome_tilt_deg", What::tilt);
            } else if (turn_of(projection)) {
                add("yaw", "turn_deg/yaw", What::yaw);
                add("pitch", "turn_deg/pitch", What::pitch);
                add("roll", "turn_deg/roll", What::roll);
            }
        }
    if (layout.blend.ramps)
        all.push_back({"blend, power", "/blend/power", 0, 0, What::blend_power, 0.05});
    all.push_back({"head-up display, height", "/hud/elevation_deg", 0, 0, What::hud_elevation, 0.5});
    return all;
}

double value_of(const Layout& layout, const Adjustable& adjustable)
{
    Layout copy = layout;
    return *place_of(copy, adjustable);
}

Layout adjusted(Layout layout, const Adjustable& adjustable, double steps)
{
    double& value = *place_of(layout, adjustable);
    // On whole steps, so that the file reads 30.1 and not 30.099999.
    const bool dome = adjustable.what == What::tilt, display = adjustable.what == What::hud_elevation;
    const double high = adjustable.what == What::blend_power ? 10 : display ? 90 : dome ? 180 : 360;
    const double low = adjustable.what == What::blend_power ? 0.1 : -high;
    value = std::clamp(std::round((value / adjustable.step + steps) * 1e6) * 1e-6 * adjustable.step, low, high);
    value = std::round(value * 1e6) / 1e6;
    return layout;
}

std::vector<Change> changes(const Layout& saved, const Layout& now)
{
    std::vector<Change> all;
    for (const Adjustable& adjustable : adjustables(now))
        if (const double value = value_of(now, adjustable); value != value_of(saved, adjustable))
            all.push_back({adjustable.pointer, value});
    return all;
}

} // namespace starbow
