#include "adjust.h"
#include "describe_layout.h"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace starbow {
namespace {

using described::Turnable;

/// The numbers of a layout that the keys change: in a viewport, or of the layout itself.
std::vector<Turnable> numbers_of(Layout& layout, const Adjustable::Spot& where)
{
    std::vector<Turnable> all;
    if (where.pointer.starts_with("/outputs")) {
        Viewport& viewport = layout.outputs[where.output].viewports[where.viewport];
        const std::string at = viewport_pointer(where.output, where.viewport);
        if (viewport.projection_given) // otherwise it is the calibration's own frustum
            described::add_turnables(all, at + "/projection", viewport.projection);
        if (viewport.quad)
            described::add_turnables(all, at + "/quad", *viewport.quad);
        if (viewport.grid)
            described::add_turnables(all, at + "/grid", *viewport.grid);
        return all;
    }
    if (layout.blend.ramps)
        described::add_turnables(all, "/blend", layout.blend);
    if (layout.hud)
        described::add_turnables(all, "/hud", *layout.hud);
    return all;
}

/// A spot for each viewport, and one for the layout itself.
std::vector<Adjustable::Spot> spots_of(const Layout& layout)
{
    std::vector<Adjustable::Spot> all;
    for (std::size_t output = 0; output < layout.outputs.size(); ++output)
        for (std::size_t viewport = 0; viewport < layout.outputs[output].viewports.size(); ++viewport)
            all.push_back({viewport_pointer(output, viewport), output, viewport});
    all.push_back({});
    return all;
}

/// The places of a layout's numbers, by pointer. The layout must outlive it, and keep its numbers of handles.
std::map<std::string, double*> places_of(Layout& layout)
{
    std::map<std::string, double*> all;
    for (const Adjustable::Spot& where : spots_of(layout))
        for (const Turnable& one : numbers_of(layout, where))
            all[one.pointer] = one.number;
    return all;
}

/// Their values.
std::map<std::string, double> values_of(Layout layout)
{
    std::map<std::string, double> all;
    for (const auto& [pointer, number] : places_of(layout))
        all[pointer] = *number;
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
                + ", " + one.name + (*one.way ? ", " : "") + one.way,
            {{one.pointer, where.output, where.viewport}}, one.name, one.way, one.unmoved, one.range.low, one.range.high,
            one.step});
}

/// Numbers that several projectors on one dome share. Changed one by one, their pictures would separate.
std::vector<Adjustable> of_whole_domes(const Layout& layout, const std::vector<Adjustable>& each)
{
    std::vector<Adjustable> all;
    const std::map<std::string, double> values = values_of(layout);
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
        const bool agree = std::all_of(whole.spots.begin(), whole.spots.end(),
            [&](const Adjustable::Spot& spot) { return values.at(spot.pointer) == values.at(whole.spots[0].pointer); });
        if (agree)
            all.push_back(std::move(whole));
    }
    return all;
}

/// The change of a file for a number. One of a list is set with its list, which the file may lack.
Change change_of(const std::map<std::string, double>& values, const std::string& pointer)
{
    const std::size_t end = pointer.rfind('/');
    if (!std::isdigit(static_cast<unsigned char>(pointer[end + 1])))
        return {pointer, values.at(pointer)};
    const std::string list = pointer.substr(0, end);
    Change change{list, nlohmann::json::array()};
    for (auto one = values.find(list + "/0"); one != values.end();
         one = values.find(list + "/" + std::to_string(change.value.size())))
        change.value.push_back(one->second);
    return change;
}

} // namespace

std::vector<Adjustable> adjustables(const Layout& layout)
{
    Layout copy = layout; // numbers are found in a layout that may change
    std::vector<Adjustable> each;
    for (const Adjustable::Spot& where : spots_of(layout)) {
        if (where.pointer.empty())
            continue;
        std::string name = layout.outputs[where.output].name;
        if (layout.outputs[where.output].viewports.size() > 1)
            name.append(" ").append(std::to_string(where.viewport));
        add_own(each, copy, where, name);
    }
    std::vector<Adjustable> all = of_whole_domes(layout, each);
    all.insert(all.end(), each.begin(), each.end());
    add_own(all, copy, {}, "");
    return all;
}

std::vector<Grip> grips(const Layout& layout)
{
    std::vector<Grip> all;
    std::map<std::string, std::size_t> places;
    for (Adjustable& one : adjustables(layout)) {
        if (one.way.empty()) {
            all.push_back({one.name, {std::move(one)}});
            continue;
        }
        const std::string name = one.name.substr(0, one.name.size() - one.way.size() - 2);
        const auto [place, is_new] = places.try_emplace(name, all.size());
        if (is_new)
            all.push_back({name, {}});
        all[place->second].numbers.push_back(std::move(one));
    }
    return all;
}

Layout moved(Layout layout, const Grip& grip, double right, double down)
{
    if (grip.numbers.size() == 1)
        return adjusted(std::move(layout), grip.numbers[0], right - down);
    return adjusted(adjusted(std::move(layout), grip.numbers[0], right), grip.numbers[1], down);
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
    const std::map<std::string, double> before = values_of(saved), after = values_of(now);
    for (const auto& [pointer, value] : after)
        if (const auto had = before.find(pointer); had != before.end() && had->second != value)
            if (Change change = change_of(after, pointer); all.empty() || all.back().pointer != change.pointer)
                all.push_back(std::move(change)); // a list's numbers follow one another, and are one change
    return all;
}

std::vector<TurnedNumber> turned_numbers(const Layout& kept, const Layout& now)
{
    std::vector<TurnedNumber> numbers;
    const std::vector<Adjustable> all = adjustables(kept);
    const std::map<std::string, double> before = values_of(kept), after = values_of(now);
    for (std::size_t place = 0; place < all.size(); ++place) {
        const std::string& pointer = all[place].spots[0].pointer;
        if (all[place].spots.size() == 1 && after.at(pointer) != before.at(pointer))
            numbers.push_back({std::uint16_t(place), after.at(pointer)});
    }
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
    const std::map<std::string, double> before = values_of(kept), after = values_of(turned);
    for (const auto& [pointer, number] : places_of(fresh)) {
        const auto had = before.find(pointer), has = after.find(pointer);
        if (had != before.end() && has != after.end() && had->second != has->second && *number == had->second)
            *number = has->second;
    }
    return fresh;
}

} // namespace starbow
