#pragma once
#include "mapping.h"
#include <array>
#include <utility>

namespace starbow {

/// An axis of a device, and its values during the calibration.
struct SeenAxis {
    std::size_t field = 0; ///< of the descriptor's
    int page = 1, usage = 0, nth = 0; ///< as profiles name it
    /// Raw values while the axis was not touched: before and after it was moved.
    std::array<std::vector<std::int64_t>, 2> rest;
    std::optional<std::int64_t> low, high; ///< of all raw values while it was moved
};

/// The axes that a profile may name, in the descriptor's order.
std::vector<SeenAxis> axes_of(const Descriptor& descriptor);

/// "X axis", "twist (Rz)", "slider 2"
std::string describe(const SeenAxis& axis);

/// Each adds the device's present state to the axes. when: 0 before the axes were moved, 1 after.
void take_rest(const DeviceState& state, std::size_t when, std::vector<SeenAxis>& axes);
void take_ends(const DeviceState& state, std::vector<SeenAxis>& axes);

/// True for raw values of an axis that nobody touches: within a tenth of its device's declared range.
bool kept_still(const std::vector<std::int64_t>& values, const Field& field);

/// The measurements of an axis' samples, raw values.
struct AxisMeasure {
    /// True if it covered at least a fifth of its device's declared range; less may come from controls moved beside it.
    bool moved = false;
    double low = 0, high = 0;
    enum class Rest {
        middle,
        low_end, ///< a pedal or a trigger
        high_end,
        anywhere ///< it stays in its place, as a throttle does; its middle is halfway between its ends
    } rests
        = Rest::middle;
    double middle = 0; ///< its resting place
    double noise = 0; ///< the greatest distance from there while nobody touched it, including its return from either side
};
AxisMeasure measured(const SeenAxis& axis, const Field& field);

/// An axis that was moved to one of its ends.
struct Push {
    std::size_t axis = 0; ///< of axes_of()
    bool to_high = true;
    double way = 0; ///< the part of the way to that end, from its resting place
};

/// The axes that a person has moved: those that covered at least half of their way between two states, and seven tenths
/// of the largest part, whose axis comes first. One axis is a clear answer; none means that nothing moved.
std::vector<Push> pushed(
    const Descriptor& descriptor, const std::vector<SeenAxis>& axes, const DeviceState& from, const DeviceState& to);

/// The person's choices; a role with an empty choice gets no axis or button. Other roles stay as they were.
struct Chosen {
    std::vector<std::pair<AxisRole, std::optional<Push>>> axes;
    std::vector<std::pair<ButtonRole, std::optional<int>>> buttons;
};

/// The device's profile after the calibration. Moved axes get their range and a dead zone a half larger than their noise;
/// those without a role are kept with the role none. Other axes stay as they were.
Profile calibrated(Profile present, const Descriptor& descriptor, const std::vector<SeenAxis>& axes, const Chosen& chosen);

/// The index of the axis that a profile's use names, if the device has it.
std::optional<std::size_t> axis_of(const AxisUse& use, const std::vector<SeenAxis>& axes);

} // namespace starbow
