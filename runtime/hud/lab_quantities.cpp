#include "lab_quantities.h"
#include "config/model/angles.h"

namespace starbow {
namespace {

using Read = std::optional<double> (*)(const Measured&);

std::optional<double> in_degrees(const std::optional<double>& angle_rad)
{
    return angle_rad ? std::optional(*angle_rad / degree) : std::nullopt;
}

constexpr Read of_wavelength = [](const Measured& m) { return std::optional(m.aim.seen_nm); };
constexpr Read of_angle = [](const Measured& m) { return in_degrees(m.aim.from_motion_rad); };
constexpr Read of_marks = [](const Measured& m) { return m.pair ? in_degrees(m.pair->angle_rad) : std::nullopt; };
constexpr Read of_clock = [](const Measured& m) { return m.aim.clock_s; };
constexpr Read of_clocks = [](const Measured& m) { return m.pair ? m.pair->clocks_s : std::nullopt; };
constexpr Read of_length = [](const Measured& m) { return m.pair ? m.pair->apparent_s : std::nullopt; };
constexpr Read of_light = [](const Measured& m) { return m.aim.light; };

} // namespace

const std::array<LabQuantityEntry, std::size_t(LabQuantity::count)> all_lab_quantities{{
    {LabQuantity::wavelength, "wavelength_nm", "lab.read_wavelength", Overlay::spectrum, of_wavelength},
    {LabQuantity::angle, "angle_deg", "lab.read_angle", Overlay::protractor, of_angle},
    {LabQuantity::marks_angle, "marks_angle_deg", "lab.read_marks_angle", Overlay::protractor, of_marks},
    {LabQuantity::clock, "clock_s", "lab.read_clock", Overlay::aim, of_clock},
    {LabQuantity::clock_difference, "clock_2_minus_1_s", "lab.read_clock_difference", Overlay::aim, of_clocks},
    {LabQuantity::length, "length_light_s", "lab.read_length", Overlay::protractor, of_length},
    {LabQuantity::light, "light", "lab.read_light", Overlay::photometer, of_light},
    {LabQuantity::world_angle, "world_angle_deg", "lab.read_world_angle", Overlay::protractor, nullptr},
    {LabQuantity::doppler, "doppler", "lab.read_doppler", Overlay::spectrum, nullptr},
    {LabQuantity::unshifted_angle, "unshifted_angle_deg", "lab.read_unshifted_angle", Overlay::protractor, nullptr},
    {LabQuantity::distance, "distance_light_s", "lab.read_distance", Overlay::distance, nullptr},
    {LabQuantity::emitted, "emitted_s", "lab.read_emitted", Overlay::emission, nullptr},
    {LabQuantity::ship_distance, "ship_distance_light_s", "lab.read_ship_distance", Overlay::distance, nullptr},
    {LabQuantity::contracted_length, "contracted_length_light_s", "lab.read_contracted_length", Overlay::protractor,
        nullptr},
    {LabQuantity::light_ratio, "light_ratio", "lab.read_light_ratio", Overlay::photometer, nullptr},
    {LabQuantity::thrust_factor, "thrust_factor", "lab.read_thrust_factor", Overlay::protractor, nullptr},
    {LabQuantity::angle_ratio, "angle_ratio", "lab.read_angle_ratio", Overlay::protractor, nullptr},
}};

const LabQuantityEntry& entry_of(LabQuantity which) { return all_lab_quantities[std::size_t(which)]; }

std::vector<LabQuantity> quantities_at(const Measured& measured)
{
    std::vector<LabQuantity> known;
    for (const LabQuantityEntry& one : all_lab_quantities)
        if (one.theory && one.theory(measured))
            known.push_back(one.which);
    return known;
}

} // namespace starbow
