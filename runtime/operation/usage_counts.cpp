#include "usage_counts.h"
#include "exposition.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace starbow {
namespace {

using Json = nlohmann::json;

std::uint64_t count_in(const Json& json, const char* name)
{
    const auto at = json.find(name);
    return at != json.end() && at->is_number_unsigned() ? at->get<std::uint64_t>() : 0;
}

double number_in(const Json& json, const char* name)
{
    const auto at = json.find(name);
    const double value = at != json.end() && at->is_number() ? at->get<double>() : 0;
    return std::isfinite(value) && value >= 0 ? value : 0;
}

constexpr std::pair<const char*, std::uint64_t UsageCounts::*> events[]
    = {{"missed_refreshes", &UsageCounts::missed_refreshes}, {"device_losses", &UsageCounts::device_losses},
        {"unplugged", &UsageCounts::unplugged}, {"layouts", &UsageCounts::layouts}, {"commands", &UsageCounts::commands},
        {"refused_commands", &UsageCounts::refused_commands}, {"visits", &UsageCounts::visits},
        {"tours_finished", &UsageCounts::tours_finished}};
constexpr std::pair<const char*, double UsageCounts::*> sums[]
    = {{"frames_s", &UsageCounts::frames_s}, {"visits_s", &UsageCounts::visits_s}};
constexpr std::pair<const char*, double UsageCounts::*> greatest[]
    = {{"longest_frame_s", &UsageCounts::longest_frame_s}, {"worst_skew_s", &UsageCounts::worst_skew_s}};

} // namespace

std::uint64_t UsageCounts::frames() const
{
    std::uint64_t all = 0;
    for (const std::uint64_t frames : frames_by_time)
        all += frames;
    return all;
}

double UsageCounts::percentile_s(double part) const
{
    const double rank = part * double(frames());
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < frames_by_time.size(); ++i) {
        below += frames_by_time[i];
        if (below > 0 && double(below) >= rank)
            return i < frame_classes_s.size() ? std::min(frame_classes_s[i], longest_frame_s) : longest_frame_s;
    }
    return 0;
}

void UsageCounts::add_frame(double s, bool missed)
{
    const auto at = std::ranges::lower_bound(frame_classes_s, s);
    ++frames_by_time[std::size_t(at - frame_classes_s.begin())];
    frames_s += s;
    longest_frame_s = std::max(longest_frame_s, s);
    missed_refreshes += missed;
}

UsageCounts& UsageCounts::operator+=(const UsageCounts& other)
{
    for (std::size_t i = 0; i < frames_by_time.size(); ++i)
        frames_by_time[i] += other.frames_by_time[i];
    for (const auto& [name, member] : events)
        this->*member += other.*member;
    for (const auto& [name, member] : sums)
        this->*member += other.*member;
    for (const auto& [name, member] : greatest)
        this->*member = std::max(this->*member, other.*member);
    resident_bytes = std::max(resident_bytes, other.resident_bytes);
    for (const auto& [scene, s] : other.scenes_s)
        scenes_s[scene] += s;
    return *this;
}

Json json_of(const UsageCounts& counts)
{
    Json json{{"frames_by_time", counts.frames_by_time}, {"resident_bytes", counts.resident_bytes}};
    for (const auto& [name, member] : events)
        json[name] = counts.*member;
    for (const auto& [name, member] : sums)
        json[name] = counts.*member;
    for (const auto& [name, member] : greatest)
        json[name] = counts.*member;
    json["scenes_s"] = counts.scenes_s;
    return json;
}

UsageCounts usage_counts_of(const Json& json)
{
    UsageCounts counts;
    if (!json.is_object())
        return counts;
    if (const auto classes = json.find("frames_by_time"); classes != json.end() && classes->is_array())
        for (std::size_t i = 0; i < std::min(classes->size(), counts.frames_by_time.size()); ++i)
            if ((*classes)[i].is_number_unsigned())
                counts.frames_by_time[i] = (*classes)[i].get<std::uint64_t>();
    for (const auto& [name, member] : events)
        counts.*member = count_in(json, name);
    for (const auto& [name, member] : sums)
        counts.*member = number_in(json, name);
    for (const auto& [name, member] : greatest)
        counts.*member = number_in(json, name);
    counts.resident_bytes = count_in(json, "resident_bytes");
    if (const auto scenes = json.find("scenes_s"); scenes != json.end() && scenes->is_object())
        for (const auto& [scene, s] : scenes->items())
            if (s.is_number() && counts.scenes_s.size() < 1000)
                counts.scenes_s[scene] = s.get<double>();
    return counts;
}

std::string exposition_of(const UsageCounts& since_start, const Gauges& now)
{
    Exposition out;
    out.metric("build_info", "gauge", "The program's version; the value is always 1.");
    out.value("build_info{version=\"" + escaped_label(now.version) + "\"}", 1);
    out.one("uptime_seconds", "gauge", "Time since the start.", now.uptime_s);
    out.metric("frame_seconds", "histogram", "Time from one picture to the next.");
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < frame_classes_s.size(); ++i) {
        below += since_start.frames_by_time[i];
        std::array<char, 16> end;
        std::snprintf(end.data(), end.size(), "%g", frame_classes_s[i]);
        out.value(std::string("frame_seconds_bucket{le=\"") + end.data() + "\"}", double(below));
    }
    out.value("frame_seconds_bucket{le=\"+Inf\"}", double(since_start.frames()));
    out.value("frame_seconds_sum", since_start.frames_s);
    out.value("frame_seconds_count", double(since_start.frames()));
    out.one("missed_refreshes_total", "counter", "Frames that took longer than one and a half periods of the screen.",
        double(since_start.missed_refreshes));
    out.one("worst_skew_seconds", "gauge", "Greatest time between the outputs' pictures of one frame since the start.",
        since_start.worst_skew_s);
    out.one("device_losses_total", "counter", "Times that the GPU was lost and opened again.",
        double(since_start.device_losses));
    out.one("unplugged_total", "counter", "Times that a stick or throttle went away.", double(since_start.unplugged));
    out.one("layouts_total", "counter", "Layouts applied in flight.", double(since_start.layouts));
    out.one("commands_total", "counter", "Commands of remotes carried out.", double(since_start.commands));
    out.one("refused_commands_total", "counter", "Commands of remotes refused.", double(since_start.refused_commands));
    out.one("visits_total", "counter", "Visits that have ended.", double(since_start.visits));
    out.one("visit_seconds_total", "counter", "Sum of their lengths.", since_start.visits_s);
    out.one("tours_finished_total", "counter", "Tours shown to their end.", double(since_start.tours_finished));
    out.metric("scene_seconds_total", "counter", "Time for which visitors were in each scene.");
    for (const auto& [scene, s] : since_start.scenes_s)
        out.value("scene_seconds_total{scene=\"" + escaped_label(scene) + "\"}", s);
    out.one("resident_bytes", "gauge", "Memory of the process in the machine.", double(now.resident_bytes));
    out.one("open_files", "gauge", "Open file descriptors.", double(now.files));
    out.one("threads", "gauge", "Threads.", double(now.threads));
    out.one("pipelines", "gauge", "Compiled pipelines.", double(now.pipelines));
    out.one("devices", "gauge", "Sticks, throttles and pads that are read.", double(now.devices));
    out.one("worn_axes", "gauge", "Axes that are stuck or noisy and left out.", double(now.worn_axes));
    out.one("outputs", "gauge", "Outputs of the layout.", double(now.outputs));
    out.one("outputs_shown", "gauge", "Outputs with a picture now.", double(now.outputs_shown));
    out.one("machines", "gauge", "Machines that show the exhibit.", now.machines.empty() ? 1 : double(now.machines.size()));
    out.one(
        "machines_in_step", "gauge", "Machines that show it now.", now.machines.empty() ? 1 : double(in_step(now.machines)));
    if (now.machines.empty())
        return out.text;
    const auto each = [&](const char* name, const auto& value) {
        for (const MachineHealth& machine : now.machines)
            out.value(std::string(name) + "{machine=\"" + escaped_label(machine.name) + "\"}", value(machine));
    };
    out.metric("machine_in_step", "gauge", "1 for a machine that shows the exhibit now, 0 for one that is away.");
    each("machine_in_step", [](const MachineHealth& machine) { return double(machine.in_step); });
    out.metric("machine_frame_seconds", "gauge", "Time that a machine took to draw its last frame.");
    each("machine_frame_seconds", [](const MachineHealth& machine) { return 1e-3 * machine.frame_ms; });
    return out.text;
}

} // namespace starbow
