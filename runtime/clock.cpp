#include "clock.h"
#include <cmath>

namespace starbow {
namespace {

/// The part of a turn, 0 to 1: in double, for a float would lose the hands after months.
double turned(double reading_s, double turn_s)
{
    const double part = std::fmod(reading_s, turn_s) / turn_s; // exact but for the last division
    return part < 0 ? part + 1 : part;
}

/// ClockEntry's member: the point needs no place of its own.
glm::vec4 packed(const std::string& figures)
{
    std::uint32_t six[2] = {};
    std::uint32_t count = 0;
    for (char c : figures)
        if (c != '.') {
            six[count / 6] |= std::uint32_t(c == '-' ? 10 : c - '0') << 4 * (count % 6); // 24 bits: a float holds them
            ++count;
        }
    return {six[0], six[1], count, 0};
}

} // namespace

double reading_s(const WorldClock& clock, double time, double distance, double seconds_per_time_unit)
{
    return (time - distance) * seconds_per_time_unit - clock.zero_s;
}

std::string figures(double reading_s)
{
    if (!(std::abs(reading_s) < 1e10 - 0.05))
        return "---.-";
    const long long tenths = std::llround(reading_s * 10), size = std::llabs(tenths);
    std::string out = std::to_string(tenths < 0 ? -(size / 10) : size / 10);
    if (tenths < 0 && size < 10)
        out.insert(out.begin(), '-');
    return out.append(1, '.').append(1, char('0' + size % 10));
}

std::vector<shared::ClockEntry> clock_entries(const World& world, const glm::dvec3& eye, const glm::dmat3& motion_from_world,
    double time, double seconds_per_time_unit)
{
    std::vector<shared::ClockEntry> entries;
    for (const Instance& instance : world.instances) {
        const Primitive& primitive = world.primitives[instance.primitive];
        const auto& clock = world.materials[std::size_t(primitive.material)].clock;
        if (!clock)
            break;
        const glm::dvec3 middle
            = glm::dvec3(instance.world_from_local * glm::dvec4(0.5 * (primitive.low + primitive.high), 1)) - eye;
        const double distance = glm::length(middle);
        const double reading = reading_s(*clock, time, distance, seconds_per_time_unit);
        entries.push_back({glm::vec4(motion_from_world * middle, distance),
            glm::vec4(turned(reading, 60), turned(reading, 10), turned(reading, 3600), seconds_per_time_unit),
            packed(figures(reading))});
    }
    return entries;
}

} // namespace starbow
