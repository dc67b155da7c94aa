#include "calibration.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

using Rest = AxisMeasure::Rest;

constexpr double least_way = 0.2; // of the declared range
constexpr double still = 0.1; // of the declared range
constexpr double near_end = 0.15; // of the way between the ends
// A spring returns a stick to within a hundredth or two of its range, a worn one less accurately.
constexpr double least_dead_zone = 0.03, least_idle_zone = 0.02;
constexpr double most_dead_zone = 0.4; // noisier axes are broken; at 0.5 a throttle would have no way left
constexpr double beyond_noise = 1.5;
// The range of a profile's raw values.
constexpr double least_raw = -2147483648.0, most_raw = 4294967295.0;
constexpr int most_nth = 32;
constexpr std::size_t most_axes = 64;

std::optional<std::int64_t> raw_of(const DeviceState& state, const SeenAxis& axis)
{
    return axis.field < state.raw.size() ? state.raw[axis.field] : std::nullopt;
}

double median(std::vector<std::int64_t> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 ? double(values[half]) : (double(values[half - 1]) + double(values[half])) / 2;
}

double furthest(const std::vector<std::int64_t>& values, double from)
{
    double most = 0;
    for (const std::int64_t value : values)
        most = std::max(most, std::abs(double(value) - from));
    return most;
}

/// True for axes that stay in their place (HID Usage Tables 1.4): slider, dial, throttle.
bool slides(const SeenAxis& axis)
{
    return (axis.page == 1 && (axis.usage == 0x36 || axis.usage == 0x37)) || (axis.page == 2 && axis.usage == 0xbb);
}

double dead_zone_of(double noise, double way, double least)
{
    // Rounded up to thousandths, so that it is readable and never less than the noise.
    return std::clamp(std::ceil(1000 * beyond_noise * noise / way) / 1000, least, most_dead_zone);
}

/// The use with the measurements of its axis.
AxisUse tuned(AxisUse use, const AxisMeasure& axis)
{
    if (!axis.moved)
        return use;
    double low = axis.low, middle = (axis.low + axis.high) / 2, high = axis.high;
    bool inverted = use.inverted != (use.range && use.range->front() > use.range->back());
    if (one_sided(use.role)) {
        if (use.role != AxisRole::throttle) { // released, it must be neutral
            if (axis.rests == Rest::low_end)
                low = axis.middle, inverted = false;
            else if (axis.rests == Rest::high_end)
                high = axis.middle, inverted = true;
            else if (axis.rests == Rest::middle) // one half of an axis of two triggers
                (inverted ? high : low) = axis.middle;
            middle = (low + high) / 2;
        }
        use.dead_zone = dead_zone_of(axis.noise, high - low, least_idle_zone);
    } else {
        double way = (high - low) / 2;
        if (axis.rests == Rest::middle) {
            middle = axis.middle;
            way = std::min(middle - low, high - middle);
        } else if (axis.rests != Rest::anywhere) {
            // The axis works to one side alone and never reaches its other end.
            middle = axis.middle;
            way = axis.rests == Rest::low_end ? high - middle : middle - low;
            (axis.rests == Rest::low_end ? low : high) = axis.rests == Rest::low_end ? middle - way : middle + way;
            if (low < least_raw || high > most_raw)
                return use;
        }
        use.dead_zone = dead_zone_of(axis.noise, way, least_dead_zone);
    }
    use.inverted = inverted;
    use.range = {low, middle, high};
    return use;
}

} // namespace

std::vector<SeenAxis> axes_of(const Descriptor& descriptor)
{
    std::vector<SeenAxis> axes;
    for (std::size_t i = 0; i < descriptor.fields.size(); ++i) {
        const Field& field = descriptor.fields[i];
        if (!is_axis(field))
            continue;
        const int nth = int(std::count_if(axes.begin(), axes.end(),
            [&](const SeenAxis& axis) { return axis.page == field.usage.page && axis.usage == field.usage.id; }));
        axes.push_back({i, field.usage.page, field.usage.id, nth});
    }
    return axes;
}

std::string describe(const SeenAxis& axis)
{
    static const std::vector<std::pair<Usage, std::string>> names{{{1, 0x30}, "X axis"}, {{1, 0x31}, "Y axis"},
        {{1, 0x32}, "Z axis"}, {{1, 0x33}, "Rx axis"}, {{1, 0x34}, "Ry axis"}, {{1, 0x35}, "twist (Rz)"},
        {{1, 0x36}, "slider"}, {{1, 0x37}, "dial"}, {{2, 0xb0}, "aileron"}, {{2, 0xb8}, "elevator"}, {{2, 0xba}, "rudder"},
        {{2, 0xbb}, "throttle"}, {{2, 0xc4}, "accelerator"}, {{2, 0xc5}, "brake"}, {{2, 0xc6}, "clutch"},
        {{2, 0xc8}, "steering"}};
    std::string text = "axis " + std::to_string(axis.page) + "/" + std::to_string(axis.usage);
    for (const auto& [usage, name] : names)
        if (usage.page == axis.page && usage.id == axis.usage)
            text = name;
    return axis.nth ? text + " " + std::to_string(axis.nth + 1) : text;
}

void take_rest(const DeviceState& state, std::size_t when, std::vector<SeenAxis>& axes)
{
    for (SeenAxis& axis : axes)
        if (const auto raw = raw_of(state, axis))
            axis.rest.at(when).push_back(*raw);
}

void take_ends(const DeviceState& state, std::vector<SeenAxis>& axes)
{
    for (SeenAxis& axis : axes)
        if (const auto raw = raw_of(state, axis)) {
            axis.low = std::min(axis.low.value_or(*raw), *raw);
            axis.high = std::max(axis.high.value_or(*raw), *raw);
        }
}

bool kept_still(const std::vector<std::int64_t>& values, const Field& field)
{
    if (values.empty())
        return true;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    // A step of one counts as noise, however coarse the axis.
    return double(*high) - double(*low) <= std::max(1.0, still * (double(field.logical_max) - double(field.logical_min)));
}

AxisMeasure measured(const SeenAxis& axis, const Field& field)
{
    AxisMeasure is;
    const auto& [before, after] = axis.rest;
    std::vector<std::int64_t> rest = before;
    rest.insert(rest.end(), after.begin(), after.end());
    is.low = double(axis.low.value_or(field.logical_min)), is.high = double(axis.high.value_or(field.logical_max));
    if (axis.low)
        for (const std::int64_t raw : rest)
            is.low = std::min(is.low, double(raw)), is.high = std::max(is.high, double(raw));
    const double way = is.high - is.low, declared = double(field.logical_max) - double(field.logical_min);
    is.moved = axis.low && way > 0 && way >= least_way * declared;
    is.middle = (is.low + is.high) / 2;
    if (rest.empty())
        return is;
    const bool came_back = before.empty() || after.empty() || std::abs(median(before) - median(after)) <= near_end * way;
    if (slides(axis) || !came_back) {
        is.rests = Rest::anywhere;
        for (const auto& values : axis.rest)
            if (!values.empty())
                is.noise = std::max(is.noise, furthest(values, median(values)));
        return is;
    }
    is.middle = median(rest);
    is.noise = furthest(rest, is.middle);
    if (is.middle - is.low < near_end * way)
        is.rests = Rest::low_end;
    else if (is.high - is.middle < near_end * way)
        is.rests = Rest::high_end;
    return is;
}

std::vector<Push> pushed(
    const Descriptor& descriptor, const std::vector<SeenAxis>& axes, const DeviceState& from, const DeviceState& to)
{
    std::vector<Push> all;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const auto start = raw_of(from, axes[i]), end = raw_of(to, axes[i]);
        if (!start || !end || *start == *end)
            continue;
        const Field& field = descriptor.fields[axes[i].field];
        const AxisMeasure is = measured(axes[i], field);
        const double low = is.moved ? is.low : double(field.logical_min),
                     high = is.moved ? is.high : double(field.logical_max), went = double(*end) - double(*start),
                     left = went > 0 ? high - double(*start) : double(*start) - low;
        // An axis already at its end has nearly no way left, and that way is noise.
        const double way = std::abs(went) / std::max(left, (high - low) / 4);
        if (high > low && way >= 0.5)
            all.push_back({i, went > 0, way});
    }
    std::stable_sort(all.begin(), all.end(), [](const Push& a, const Push& b) { return a.way > b.way; });
    while (!all.empty() && all.back().way < 0.7 * all.front().way)
        all.pop_back();
    return all;
}

std::optional<std::size_t> axis_of(const AxisUse& use, const std::vector<SeenAxis>& axes)
{
    for (std::size_t i = 0; i < axes.size(); ++i)
        if (axes[i].page == use.page && axes[i].usage == use.usage && axes[i].nth == use.nth)
            return i;
    return {};
}

Profile calibrated(Profile present, const Descriptor& descriptor, const std::vector<SeenAxis>& axes, const Chosen& chosen)
{
    std::vector<AxisUse> added;
    for (const auto& [role, push] : chosen.axes)
        if (push) {
            const SeenAxis& axis = axes.at(push->axis);
            AxisUse use{axis.page, axis.usage, axis.nth, role, !push->to_high};
            for (const AxisUse& old : present.axes)
                if (old.role == role && axis_of(old, axes) == push->axis) {
                    use.curve = old.curve;
                    if (old.inverted == use.inverted) // otherwise detents would be at other places
                        use.detents = old.detents;
                }
            if (one_sided(role))
                use.dead_zone = least_idle_zone;
            added.push_back(use);
        }
    std::erase_if(present.axes, [&](const AxisUse& old) {
        return std::any_of(chosen.axes.begin(), chosen.axes.end(), [&](const auto& answer) {
            return answer.first == old.role || (answer.second && axis_of(old, axes) == answer.second->axis);
        });
    });
    present.axes.insert(present.axes.end(), added.begin(), added.end());
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const AxisMeasure is = measured(axes[i], descriptor.fields[axes[i].field]);
        bool used = false;
        for (AxisUse& use : present.axes)
            if (axis_of(use, axes) == i) {
                use = tuned(use, is);
                used = true;
            }
        if (is.moved && !used && axes[i].nth < most_nth && present.axes.size() < most_axes)
            present.axes.push_back(tuned({axes[i].page, axes[i].usage, axes[i].nth}, is));
    }
    std::stable_sort(present.axes.begin(), present.axes.end(), [&](const AxisUse& a, const AxisUse& b) {
        return axis_of(a, axes).value_or(axes.size()) < axis_of(b, axes).value_or(axes.size());
    });

    for (const auto& [role, button] : chosen.buttons) {
        std::erase_if(
            present.buttons, [&](const ButtonUse& old) { return old.role == role || (button && old.button == *button); });
        if (button)
            present.buttons.push_back({*button, role});
    }
    std::stable_sort(present.buttons.begin(), present.buttons.end(),
        [](const ButtonUse& a, const ButtonUse& b) { return a.button < b.button; });
    return present;
}

} // namespace starbow
