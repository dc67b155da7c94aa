#include "lab_rows.h"
#include <cstdio>
#include <cstdlib>

namespace starbow {
namespace {

using Q = LabQuantity;
constexpr std::string_view both_rest = "-17.9deg,0deg; 17.9deg,0deg", both_passing = "-14.7deg,0deg; 16.8deg,0deg",
                           both_stopped = "-12deg,0deg; 15.7deg,0deg", ahead = "0deg,0deg";

/// The formulas are those of docs/lab.md; tests/support/lab_theory.h computes each value from them.
const LabRow rows[] = {
    {"A1", "clocks-rest", {}, {}, both_rest, Q::marks_angle, 35.75739, 0.02, {}},
    {"A2", "clocks-passing", {}, {}, both_passing, Q::marks_angle, 31.48851, 0.02, {}},
    {"A3", "clocks-stopped", {}, {}, both_stopped, Q::marks_angle, 27.69187, 0.02, {}},
    {"A4", "clocks-passing", {}, {}, ahead, Q::angle, 90, 0.15, {}},
    {"A5", "clocks-passing", {}, {}, ahead, Q::world_angle, 120, 0.15, {}},
    {"A6", "clocks-passing", "1", "none", ahead, Q::world_angle, 90, 0.15, {}},
    {"D1", "avenue-gamma4", {}, {}, ahead, Q::doppler, 7.872983, 0.003, {}},
    {"D2", "avenue-gamma4", {}, {}, "90deg,0deg", Q::doppler, 0.25, 0.001, {}},
    {"D3", "avenue-gamma4", {}, {}, "180deg,0deg", Q::doppler, 0.1270167, 0.0001, {}},
    {"D4", "avenue-gamma4", {}, {}, "39.23deg,0deg", Q::doppler, 1, 0.01, {}},
    {"D5", "avenue-gamma4", {}, {}, ahead, Q::unshifted_angle, 39.23152, 0.01, {}},
    {"D6", "rainbow", {}, {}, ahead, Q::unshifted_angle, 74.45773, 0.01, {}},
    {"D7", "clocks-passing", {}, {}, ahead, Q::doppler, 0.8660254, 0.001, {}},
    {"D8", "clocks-passing", {}, {}, ahead, Q::wavelength, 635.0853, 0.8, {}},
    {"C1", "clocks-rest", {}, {}, "0deg,0deg; -17.9deg,0deg", Q::clock_difference, -1.572995, 0.01, {}},
    {"C2", "clocks-rest", {}, {}, "0deg,0deg; 9.2deg,0deg", Q::clock_difference, -0.4006369, 0.01, {}},
    {"C3", "clocks-passing", {}, {}, "0deg,0deg; -14.7deg,0deg", Q::clock_difference, -5.909085, 0.01, {}},
    {"C4", "clocks-passing", {}, {}, "0deg,0deg; -7.7deg,0deg", Q::clock_difference, -2.744028, 0.01, {}},
    {"C5", "clocks-passing", {}, {}, "0deg,0deg; 8.2deg,0deg", Q::clock_difference, 2.219613, 0.01, {}},
    {"C6", "clocks-passing", {}, {}, "0deg,0deg; 16.8deg,0deg", Q::clock_difference, 3.805466, 0.01, {}},
    {"C7", "clocks-stopped", {}, {}, both_stopped, Q::clock_difference, 9.714551, 0.01, {}},
    {"C8", "clocks-passing", {}, {}, both_passing, Q::clock_difference, 9.714551, 0.01, {}},
    {"C9", "clocks-passing", {}, {}, ahead, Q::clock, 0, 0.1, {}},
    {"T1", "clocks-passing", {}, {}, ahead, Q::distance, 35.79572, 0.1, {}},
    {"T2", "clocks-rest", {}, {}, ahead, Q::distance, 31, 0.05, {}},
    {"T3", "clocks-passing", {}, {}, ahead, Q::emitted, 0, 0.1, {}},
    {"T4", "clocks-passing", {}, {}, ahead, Q::ship_distance, 31, 0.1, {}},
    {"L1", "clocks-passing", {}, {}, both_passing, Q::length, 17.48531, 0.01, {}},
    {"L2", "clocks-passing", {}, {}, both_passing, Q::contracted_length, 17.32051, 0.01, {}},
    {"L3", "clocks-rest", {}, {}, both_rest, Q::length, 20, 0.01, {}},
    {"H1", "avenue-gamma4", "3", "aberration,headlight", "60deg,0deg", Q::light_ratio, 0.1138102, 0.002, {}},
    {"H2", "avenue-gamma4", "3", "aberration,headlight", ahead, Q::light_ratio, 487.998, 1, {}},
    {"H3", "avenue-gamma4", "3", "aberration,headlight", "15deg,5deg", Q::light_ratio, 49.02951, 2, {}},
    {"S1", "clocks-rest", {}, {}, {}, Q::thrust_factor, 16.5, 1.5, "lab.when_smallest"},
    {"S2", "clocks-rest", {}, {}, {}, Q::angle_ratio, 0.1142857, 0.002, "lab.when_smallest"},
    {"S3", "clocks-rest", {}, {}, {}, Q::marks_angle, 2.47218, 0.07, "lab.when_four"},
};

} // namespace

std::span<const LabRow> lab_rows() { return rows; }

const LabSection& section_of(const LabRow& row)
{
    static constexpr LabSection sections[] = {{'A', "lab.aberration", "lab.aberration_formula"},
        {'D', "lab.doppler_effect", "lab.doppler_formula"}, {'C', "lab.clocks", "lab.clocks_formula"},
        {'T', "lab.travel_time", "lab.travel_time_formula"}, {'L', "lab.lengths", "lab.lengths_formula"},
        {'H', "lab.headlight", "lab.headlight_formula"}, {'S', "lab.backwards", "lab.backwards_formula"}};
    for (const LabSection& section : sections)
        if (row.no.front() == section.letter)
            return section;
    std::fprintf(stderr, "starbow: the worksheet has no section for %s\n", std::string(row.no).c_str());
    std::abort();
}

bool has_still(const LabRow& row, bool by_eye)
{
    return !row.points.empty() && !(by_eye && row.of == LabQuantity::unshifted_angle);
}

std::string still_command(const LabRow& row, bool by_eye)
{
    std::string command = "starbow render --shot " + std::string(row.shot);
    if (!row.effects.empty())
        command += " --effects " + std::string(row.effects);
    if (by_eye)
        command += " --by-eye --overlay " + std::string(overlay_names[std::size_t(entry_of(row.of).instrument)]);
    return command + " --measure \"" + std::string(row.points) + "\" --out out/" + std::string(row.no);
}

} // namespace starbow
