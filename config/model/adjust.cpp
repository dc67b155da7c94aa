#include "adjust.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

using Kind = Adjustable::Kind;

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

double* place_of(Layout& layout, const Adjustable& a, const Adjustable::Spot& spot)
{
    if (a.kind == Kind::blend_power)
        return &layout.blend.power;
    if (a.kind == Kind::hud_elevation)
        return &layout.hud.value().elevation_deg;
    Projection& projection = layout.outputs[spot.output].viewports[spot.viewport].projection;
    if (auto* dome = std::get_if<Fisheye>(&projection))
        return a.kind == Kind::tilt ? &dome->tilt_deg : &dome->rotation_deg;
    if (auto* mirror = std::get_if<SphericalMirror>(&projection))
        return &mirror->dome_tilt_deg;
    Turn& turn = *turn_of(projection);
    return a.kind == Kind::yaw ? &turn.yaw_deg : a.kind == Kind::pitch ? &turn.pitch_deg : &turn.roll_deg;
}

/// The least and the largest value by the file format.
std::pair<double, double> range_of(Kind kind)
{
    switch (kind) {
    case Kind::blend_power:
        return {0.1, 10};
    case Kind::hud_elevation:
        return {-90, 90};
    case Kind::tilt:
        return {-180, 180};
    default:
        return {-360, 360};
    }
}

/// The numbers of one viewport.
void add_own(std::vector<Adjustable>& all, const Layout& layout, std::size_t output, std::size_t viewport)
{
    const Viewport& own = layout.outputs[output].viewports[viewport];
    if (!own.projection_given)
        return; // the calibration's own frustum
    std::string name = layout.outputs[output].name;
    if (layout.outputs[output].viewports.size() > 1)
        name.append(" ").append(std::to_string(viewport));
    auto add = [&](const char* what, const char* member, Kind kind) {
        all.push_back({name + ", " + what,
            {{viewport_pointer(output, viewport) + "/projection/" + member, output, viewport}}, kind, 0.1});
    };
    Projection projection = own.projection;
    if (std::holds_alternative<Fisheye>(projection)) {
        add("tilt", "tilt_deg", Kind::tilt);
        add("rotation", "rotation_deg", Kind::rotation);
    } else if (std::holds_alternative<SphericalMirror>(projection)) {
        add("tilt", "dome_tilt_deg", Kind::tilt);
    } else if (turn_of(projection)) {
        add("yaw", "turn_deg/yaw", Kind::yaw);
        add("pitch", "turn_deg/pitch", Kind::pitch);
        add("roll", "turn_deg/roll", Kind::roll);
    }
}

/// Numbers that several projectors on one dome share. Changed one by one, their pictures would separate.
std::vector<Adjustable> of_whole_domes(const Layout& layout, const std::vector<Adjustable>& each)
{
    std::vector<Adjustable> all;
    for (const Kind kind : {Kind::tilt, Kind::rotation}) {
        Adjustable whole{kind == Kind::tilt ? "the whole dome, tilt" : "the whole dome, rotation", {}, kind, 0.1};
        for (const Adjustable& one : each)
            if (one.kind == kind)
                whole.spots.push_back(one.spots[0]);
        if (whole.spots.size() < 2)
            continue;
        const bool agree = std::all_of(each.begin(), each.end(),
            [&](const Adjustable& one) { return one.kind != kind || value_of(layout, one) == value_of(layout, whole); });
        if (agree)
            all.push_back(std::move(whole));
    }
    return all;
}

/// The number at a pointer, if it is adjustable.
std::optional<double> value_at(const Layout& layout, const std::string& pointer)
{
    for (const Adjustable& one : adjustables(layout))
        if (one.spots[0].pointer == pointer)
            return value_of(layout, one);
    return {};
}

} // namespace

std::vector<Adjustable> adjustables(const Layout& layout)
{
    std::vector<Adjustable> each;
    for (std::size_t output = 0; output < layout.outputs.size(); ++output)
        for (std::size_t viewport = 0; viewport < layout.outputs[output].viewports.size(); ++viewport)
            add_own(each, layout, output, viewport);
    std::vector<Adjustable> all = of_whole_domes(layout, each);
    all.insert(all.end(), each.begin(), each.end());
    if (layout.blend.ramps)
        all.push_back({"blend, power", {{"/blend/power"}}, Kind::blend_power, 0.05});
    if (layout.hud)
        all.push_back({"head-up display, height", {{"/hud/elevation_deg"}}, Kind::hud_elevation, 0.5});
    return all;
}

double value_of(const Layout& layout, const Adjustable& adjustable)
{
    Layout copy = layout;
    return *place_of(copy, adjustable, adjustable.spots[0]);
}

Layout adjusted(Layout layout, const Adjustable& adjustable, double steps)
{
    double value = value_of(layout, adjustable);
    // Rounded to whole steps, so that the file reads 30.1 and not 30.099999.
    const auto [low, high] = range_of(adjustable.kind);
    value = std::clamp(std::round((value / adjustable.step + steps) * 1e6) * 1e-6 * adjustable.step, low, high);
    for (const Adjustable::Spot& spot : adjustable.spots)
        *place_of(layout, adjustable, spot) = std::round(value * 1e6) / 1e6;
    return layout;
}

std::vector<Change> changes(const Layout& saved, const Layout& now)
{
    std::vector<Change> all;
    for (const Adjustable& one : adjustables(now)) {
        const double value = value_of(now, one);
        const std::optional<double> before = value_at(saved, one.spots[0].pointer);
        if (one.spots.size() == 1 && before && value != *before)
            all.push_back({one.spots[0].pointer, value});
    }
    return all;
}

std::vector<TurnedNumber> turned_numbers(const Layout& kept, const Layout& now)
{
    std::vector<TurnedNumber> numbers;
    const std::vector<Adjustable> all = adjustables(kept);
    for (std::size_t place = 0; place < all.size(); ++place)
        if (const double value = value_of(now, all[place]);
            all[place].spots.size() == 1 && value != value_of(kept, all[place]))
            numbers.push_back({std::uint16_t(place), value});
    return numbers;
}

Layout with_turned(Layout kept, std::span<const TurnedNumber> numbers)
{
    const std::vector<Adjustable> all = adjustables(kept);
    for (const TurnedNumber& number : numbers) {
        if (number.place >= all.size() || all[number.place].spots.size() != 1)
            throw InputError(kept.name + ": the number in place " + std::to_string(number.place)
                + " can't be turned; a place below " + std::to_string(all.size()) + " is right");
        const Adjustable& one = all[number.place];
        const auto [low, high] = range_of(one.kind);
        if (!(number.value >= low && number.value <= high))
            throw InputError(kept.name + ": " + one.name + " can't become " + shown(number.value) + "; a number from "
                + shown(low) + " to " + shown(high) + " is right");
        *place_of(kept, one, one.spots[0]) = number.value;
    }
    return kept;
}

Layout turned_again(Layout fresh, const Layout& kept, const Layout& turned)
{
    for (const Adjustable& one : adjustables(fresh)) {
        const std::optional<double> before = value_at(kept, one.spots[0].pointer),
                                    after = value_at(turned, one.spots[0].pointer);
        if (one.spots.size() == 1 && before && after && *before != *after && value_of(fresh, one) == *before)
            *place_of(fresh, one, one.spots[0]) = *after;
    }
    return fresh;
}

} // namespace starbow
