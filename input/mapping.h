#pragma once
#include "config/profile.h"
#include "controls.h"
#include "report.h"

namespace starbow {

/// What a device tells now: the raw value of each field of its descriptor, and nothing for those that it has not told of
/// yet.
struct DeviceState {
    std::vector<std::optional<std::int64_t>> raw;
    std::int64_t told_ns = 0; ///< arrival of the last report
};

/// Takes in a report as it was read, its number first where the device numbers them. False for one that fits no field.
bool take_report(
    const Descriptor& descriptor, std::span<const std::uint8_t> report, std::int64_t now_ns, DeviceState& state);

/// Whether a field is one that a profile's axes may name: more than a bit, of a usage that moves.
bool is_axis(const Field& field);

/// Whether a role runs from nothing to full, instead of to two sides of a middle.
bool one_sided(AxisRole role);

/// How a device that no profile knows is used, from its HID usages alone: sticks turn the ship, sliders are throttles,
/// triggers go faster and slower, a hat and a second stick look around.
Profile usual_profile(const Descriptor& descriptor);

/// What a device asks for. Presses count from one reading to the next.
class Mapping {
public:
    Mapping(Descriptor descriptor, Profile profile);

    /// Adds what the device asks for to the controls. dt_s: since the last reading, for what looks around.
    void add(const DeviceState& state, double dt_s, Controls& controls);

    const Descriptor& descriptor() const { return descriptor_; }
    const Profile& profile() const { return profile_; }

private:
    struct Axis {
        std::size_t field;
        AxisUse use;
    };
    struct Button {
        std::size_t field;
        ButtonRole role;
        bool down = false;
    };
    Descriptor descriptor_;
    Profile profile_;
    std::vector<Axis> axes_;
    std::vector<Button> buttons_;
    std::optional<std::size_t> hat_;
};

/// The axis' value after calibration, dead zone and curve: -1 to 1, of a throttle 0 to 1.
double shaped(const AxisUse& use, const Field& field, std::int64_t raw);

} // namespace starbow
