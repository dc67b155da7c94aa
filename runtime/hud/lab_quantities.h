#pragma once
#include "config/model/words.h"
#include "overlay.h"
#include "why.h"
#include <array>

namespace starbow {

/// The quantities that students read. The units are the log's: seconds, light-seconds, degrees, nanometres.
enum class LabQuantity {
    wavelength, ///< at which light of 550 nm from the thing at the crosshair is seen
    angle,
    marks_angle,
    clock,
    clock_difference,
    length, ///< apparent
    light,
    world_angle,
    doppler,
    unshifted_angle,
    distance,
    emitted,
    ship_distance,
    contracted_length,
    light_ratio,
    thrust_factor, ///< e to the rapidity
    angle_ratio,
    count
};

/// The properties of a quantity.
struct LabQuantityEntry {
    LabQuantity which;
    std::string_view name; ///< in the log
    Key says; ///< with its unit
    Overlay instrument; ///< over the picture, with which it is read
    /// The theory's value at one instant; nullopt where there is none. Null: it is no quantity of one instant, or a figure
    /// that students calculate.
    std::optional<double> (*theory)(const Measured&);
};
/// Every quantity once, in the order of the enum.
extern const std::array<LabQuantityEntry, std::size_t(LabQuantity::count)> all_lab_quantities;
const LabQuantityEntry& entry_of(LabQuantity which);

/// The quantities whose theory is known at an instant: those that the entry of the laboratory offers.
std::vector<LabQuantity> quantities_at(const Measured& measured);

/// A student's number beside the theory's, in one unit. uncertainty: a standard deviation, above 0.
struct ReadNumber {
    double value = 0, uncertainty = 1, theory = 0;

    /// The deviation from the theory in uncertainties.
    double sigmas() const { return (value - theory) / uncertainty; }
};
/// The same of an instant.
struct WrittenReading : ReadNumber {
    LabQuantity of = LabQuantity::wavelength;
};

} // namespace starbow
