#include "adjust.h"
#include "describe_layout.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

using described::Turnable;

/// The numbers of a layout that the keys change: in the projection of a viewport, or of the layout itself.
std::vector<Turnable> numbers_of(Layout& layout, const Adjustable::Spot& where)
{
    std::vector<Turnable> all;
    if (where.pointer.starts_with("/outputs")) {
        Viewport& viewport = layout.outputs[where.output].viewports[where.viewport];
        const std::string at = viewport_pointer(where.output, where.viewport) + "/projection";
        if (viewport.projection_given) // otherwise it is the calibration's own frustum
            described::add_turnables(all, at, viewport.projection);
        return all;
    }
    if (layout.blend.ramps)
        described::add_turnables(all, "/blend", layout.blend);
    if (layout.hud)
        described::add_turnables(all, "/hud", *layout.hud);
    return all;
}

double* place_of(Layout& layout, const Adjustable::Spot& spot)
{
    for (const Turnable& one : numbers_of(layout, spot))
        if (one.pointer == spot.pointer)
            return one.number;
    throw InputError(spot.pointer + " is no number of the layout");
}

/// Adds the numbers in a place, under its name for people.
void add_own(std::vector<Adjustable>& all, Layout& layout, const Adjustable::Spot& where, const std::string& name)
{
    for (const Turnable& one : numbers_of(layout, where))
        all.push_back({(!name.empty()                            ? name
                               : one.pointer.starts_with("/hud") ? "head-up display"
                                                                 : "blend")
                + ", " + one.form.turned,
            {{one.pointer, where.output, where.viewport}}, one.form.turned, one.form.range.low, one.form.range.high,
            one.form.step});
}

/// Numbers that several projectors on one dome share. Changed one by one, their pictures would separate.
std::vector<Adjustable> of_whole_domes(const Layout& layout, const std::vector<Adjustable>& each)
{
    std::vector<Adjustable> all;
    for (const std::string what : {"tilt", "rotation"}) {
        Adjustable whole;
        for (const Adjustable& one : each)
            if (one.what == what) {
                whole.low = one.low, whole.high = one.high, whole.step = one.step;
                whole.spots.push_back(one.spots[0]);
            }
        whole.name = "the whole dome, " + what, whole.what = what;
        if (whole.spots.size() < 2)
            continue;
        const bool agree = std::all_of(each.begin(), each.end(),
            [&](const Adjustable& one) { return one.what != what || value_of(layout, one) == value_of(layout, whole); });
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
    Layout copy = layout; // numbers are found in a layout that may change
    std::vector<Adjustable> each;
    for (std::size_t output = 0; output < layout.outputs.size(); ++output)
        for (std::size_t viewport = 0; viewport < layout.outputs[output].viewports.size(); ++viewport) {
            std::string name = layout.outputs[output].name;
            if (layout.outputs[output].viewports.size() > 1)
                name.append(" ").append(std::to_string(viewport));
            add_own(each, copy, {viewport_pointer(output, viewport), output, viewport}, name);
        }
    std::vector<Adjustable> all = of_whole_domes(layout, each);
    all.insert(all.end(), each.begin(), each.end());
    add_own(all, copy, {}, "");
    return all;
}

double value_of(const Layout& layout, const Adjustable& adjustable)
{
    Layout copy = layout;
    return *place_of(copy, adjustable.spots[0]);
}

Layout adjusted(Layout layout, const Adjustable& adjustable, double steps)
{
    double value = value_of(layout, adjustable);
    // Rounded to whole steps, so that the file reads 30.1 and not 30.099999.
    value = std::clamp(
        std::round((value / adjustable.step + steps) * 1e6) * 1e-6 * adjustable.step, adjustable.low, adjustable.high);
    for (const Adjustable::Spot& spot : adjustable.spots)
        *place_of(layout, spot) = std::round(value * 1e6) / 1e6;
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
        if (!(number.value >= one.low && number.value <= one.high))
            throw InputError(kept.name + ": " + one.name + " can't become " + shown(number.value) + "; a number from "
                + shown(one.low) + " to " + shown(one.high) + " is right");
        *place_of(kept, one.spots[0]) = number.value;
    }
    return kept;
}

Layout turned_again(Layout fresh, const Layout& kept, const Layout& turned)
{
    for (const Adjustable& one : adjustables(fresh)) {
        const std::optional<double> before = value_at(kept, one.spots[0].pointer),
                                    after = value_at(turned, one.spots[0].pointer);
        if (one.spots.size() == 1 && before && after && *before != *after && value_of(fresh, one) == *before)
            *place_of(fresh, one.spots[0]) = *after;
    }
    return fresh;
}

} // namespace starbow
