#pragma once
#include "capabilities.h"
#include "config/model/profile.h"
#include "controls.h"
#include "health.h"
#include "lever.h"
#include "report.h"
#include <deque>

namespace starbow {

/// A device's present state: the raw value of each field of its descriptor, nullopt for those without a report yet.
struct DeviceState {
    std::vector<std::optional<std::int64_t>> raw;
    /// The values to which each button and hat was pressed since the last reading, oldest first.
    std::vector<std::vector<std::int64_t>> presses;
    std::vector<AxisHealth> health;
    PressHealth hands;
    std::int64_t pressed_ns = 0; ///< beginning of the last press
    std::int64_t report_ns = 0; ///< arrival of the last report
};

/// The state as it counts for hands that came at a time: without a report since, a device's axes are neutral and its buttons
/// up.
DeviceState known_since(DeviceState state, std::int64_t came_ns);

/// Applies a report as read, with its number first if the device numbers reports. Returns false if the report fits no
/// field.
bool take_report(
    const Descriptor& descriptor, std::span<const std::uint8_t> report, std::int64_t now_ns, DeviceState& state);

/// True for a field that can be a profile's axis: more than one bit, with a usage of an axis.
bool is_axis(const Field& field);

/// True for a role that runs from 0 to full, instead of to two sides of a middle.
bool one_sided(AxisRole role);

/// The profile of an unknown device, from its HID usages alone. Sticks turn the ship, sliders are throttles, and triggers
/// increase and reduce the speed. A hat and a second stick look around.
Profile usual_profile(const Descriptor& descriptor);

/// The profile for a left-handed visitor. On a pad, whose second stick looks around, the sticks change places, and so do the
/// triggers that make faster and slower; the profile's pairs of buttons do so on any device. Ranges and dead zones stay with
/// their axes.
Profile left_handed(Profile profile);

/// The controls of one device. Each reading reports one press of a button or a hat, so that quick taps in one slow frame all
/// count, one frame after another.
class Mapping {
public:
    Mapping(Descriptor descriptor, Profile profile);

    /// Adds the device's controls, except the lever's place. now_ns: steady clock; dt_s: since the last reading, for
    /// looking around. A stuck or noisy axis adds nothing, nor do presses that no hands can have made.
    void add(const DeviceState& state, std::int64_t now_ns, double dt_s, Controls& controls);

    // State as of the last reading:
    const std::vector<Lever>& levers() const { return levers_; } ///< without their devices' names
    /// For people: "axis Rz is stuck and is left out".
    const std::vector<std::string>& troubles() const { return troubles_; }

    /// The kinds of control on this device.
    InputCapabilities capabilities() const;

private:
    struct Axis {
        std::size_t field;
        AxisUse use;
    };
    struct Button {
        std::size_t field;
        ButtonRole role;
        std::size_t waiting = 0; ///< presses that no reading has reported yet
    };
    void point_hat(std::optional<std::int64_t> value, double dt_s, Controls& controls) const;

    Descriptor descriptor_;
    Profile profile_;
    std::vector<Axis> axes_;
    std::vector<Button> buttons_;
    std::optional<std::size_t> hat_;
    std::deque<std::int64_t> hat_waiting_; ///< values of presses that no reading has reported yet, oldest first
    std::vector<Lever> levers_;
    std::vector<std::string> troubles_;
};

/// "X", "Rz", "slider", "rudder": an axis' usual name.
std::string name_of(const Usage& usage);

/// The axis' value after calibration, dead zone and curve: -1 to 1, or 0 to 1 for a throttle.
double shaped(const AxisUse& use, const Field& field, std::int64_t raw);

} // namespace starbow
