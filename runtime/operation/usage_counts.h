#pragma once
#include "machine_health.h"
#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace starbow {

/// Upper ends of the classes of frame times, s; one more class holds all that is longer.
constexpr std::array<double, 12> frame_classes_s{0.004, 0.0085, 0.0125, 0.017, 0.025, 0.034, 0.05, 0.067, 0.1, 0.2, 0.5, 1};

/// Counts of an exhibit over a time. No person is in them: no name, no place, no instant finer than the
/// hour that the counts belong to.
struct UsageCounts {
    std::array<std::uint64_t, frame_classes_s.size() + 1> frames_by_time{};
    double frames_s = 0; ///< sum of the frames' times
    double longest_frame_s = 0;
    std::uint64_t missed_refreshes = 0; ///< frames that took longer than one and a half of the screen's periods
    double worst_skew_s = 0;
    std::uint64_t device_losses = 0, unplugged = 0, layouts = 0, commands = 0, refused_commands = 0;
    std::uint64_t visits = 0, tours_finished = 0;
    double visits_s = 0; ///< sum of the visits' lengths
    std::uint64_t resident_bytes = 0; ///< greatest
    std::map<std::string, double> scenes_s; ///< time for which visitors were in each scene

    std::uint64_t frames() const;
    /// The time that a part of all frames do not exceed, as far as the classes tell; 0 without frames.
    double percentile_s(double part) const;
    void add_frame(double s, bool missed);
    UsageCounts& operator+=(const UsageCounts& other);
};

nlohmann::json json_of(const UsageCounts& counts);
/// Reads what json_of wrote; a member of the wrong kind, or a missing one, counts as nothing.
UsageCounts usage_counts_of(const nlohmann::json& json);

/// The state of an exhibit now, beside its counts.
struct Gauges {
    double uptime_s = 0;
    std::size_t resident_bytes = 0, files = 0, threads = 0, devices = 0, worn_axes = 0, outputs_shown = 0, outputs = 0,
                pipelines = 0;
    std::vector<MachineHealth> machines{}; ///< where several show the exhibit
    std::string version;
};

/// The text of a Prometheus exposition, version 0.0.4: https://prometheus.io/docs/instrumenting/exposition_formats/
std::string exposition_of(const UsageCounts& since_start, const Gauges& now);

} // namespace starbow
