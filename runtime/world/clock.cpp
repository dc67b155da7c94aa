#include "clock.h"
#include "instances.h"
#include "moving.h"
#include "shape.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

namespace starbow {
namespace {

/// The part of a turn, 0 to 1. In double, because a float would lose the hands after months.
double turned(double reading_s, double turn_s)
{
    const double part = std::fmod(reading_s, turn_s) / turn_s; // exact but for the last division
    return part < 0 ? part + 1 : part;
}

/// Packs figures for TimeEntry. The decimal point needs no place of its own.
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

/// TimeEntry::deforming.
glm::vec4 deforming_entry(const World& world, const Instance& instance, std::size_t entries_each)
{
    const Primitive& primitive = world.primitives[instance.primitive];
    const int targets = world.deformations[std::size_t(instance.deformation)].targets;
    // The shader counts vertices from the world's first one, in 32 bits that wrap.
    const auto bits = [&](int first, int rows_each) {
        return std::bit_cast<float>(
            std::uint32_t(first) - std::uint32_t(rows_each) * std::uint32_t(primitive.vertex_offset));
    };
    return {entries_each, targets, bits(primitive.deforming, DEFORMING_VERTEX_ROWS),
        bits(primitive.displacements, DISPLACEMENT_ROWS * targets)};
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

std::vector<shared::TimeEntry> time_entries(const World& world, const EyeEvent& eye_event, double seconds_per_time_unit)
{
    std::vector<shared::TimeEntry> entries;
    std::size_t poses = 0; // entries before
    std::map<int, std::size_t> known; // of the instances of a deforming mesh, by their motion
    const InstanceRange range = instances_of(world, eye_event.frame);
    for (std::size_t i = range.first; i < range.last && timed(world, world.instances[i]); ++i) {
        const Instance& instance = world.instances[i];
        const Primitive& primitive = world.primitives[instance.primitive];
        shared::TimeEntry entry{};
        glm::dmat4 frame_from_local = instance.frame_from_local;
        if (instance.motion >= 0) {
            const SeenPose seen = seen_pose(world, instance, eye_event);
            frame_from_local = seen.frame_from_local;
            const auto times = pose_times(world, instance, seen);
            constexpr int half = POSES / 2;
            auto steps = [](double from, double to) { return half / std::max(to - from, 1e-30); };
            const auto entries_each = std::size_t(pose_entries(world, instance));
            std::size_t first = poses;
            if (instance.deformation >= 0) {
                first = known.try_emplace(instance.motion, poses).first->second;
                entry.deforming = deforming_entry(world, instance, entries_each);
            }
            poses += first == poses ? POSES * entries_each : 0;
            entry.poses = glm::vec4(
                first, steps(times.front(), times[half]), steps(times[half], times.back()), times[half] - seen.sent);
        }
        const glm::dvec3 middle = glm::dvec3(frame_from_local * glm::dvec4(middle_of(world, instance), 1)) - eye_event.place;
        const double sent = retarded_time(eye_event, eye_event.cube_from_frame * middle);
        const ExistenceInterval existence = instance.existence < 0
            ? ExistenceInterval{-for_ever, for_ever}
            : world.existence_intervals[std::size_t(instance.existence)];
        entry.middle = glm::vec4(eye_event.cube_from_frame * middle, glm::length(middle));
        const Material& material = world.materials[std::size_t(primitive.material)];
        if (material.clock) {
            const double reading = reading_s(*material.clock, sent - existence.zero, 0, seconds_per_time_unit);
            entry.turns = glm::vec4(turned(reading, 60), turned(reading, 10), turned(reading, 3600), seconds_per_time_unit);
            entry.digits = packed(figures(reading));
        }
        if (const auto& blink = material.blink) {
            const double reading = (sent - existence.zero) * seconds_per_time_unit - blink->zero_s;
            entry.blink = glm::vec4(turned(reading, blink->period_s), seconds_per_time_unit / blink->period_s, blink->on, 0);
        }
        auto bound = [&](double time) { return float(std::clamp(time - sent, -1e30, 1e30)); };
        entry.there = glm::vec4(bound(existence.begin), bound(existence.end), 0, 0);
        entries.push_back(entry);
    }
    return entries;
}

} // namespace starbow
