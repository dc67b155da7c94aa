#include "master.h"
#include "config/json/error.h"
#include "machine_files.h"
#include "runtime/operation/log.h"
#include <algorithm>

namespace starbow {
namespace {

std::set<std::string> others_of(const ExhibitOptions& options)
{
    std::set<std::string> others;
    for (const std::string& node : nodes_of(options.layout))
        if (node != options.node)
            others.insert(node);
    return others;
}

std::int64_t now_ns()
{
    using namespace std::chrono;
    return duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
}

} // namespace

Master::Master(const ExhibitOptions& options)
    : bus_(options.machines.value().interface, options.machines->domain)
    , config_(config_of(options))
    , gate_(others_of(options))
    , log_(options.frame_log)
    , frame_(now_ns()) // above the frames of a master before it
{
    warn_of_routes(*options.machines);
    bus_.send(config_);
}

std::vector<ViewSamples> Master::samples() const
{
    std::vector<ViewSamples> all;
    for (const auto& [name, node] : gate_.nodes())
        if (const auto found = samples_.find(name); node.in && found != samples_.end())
            all.insert(all.end(), found->second.begin(), found->second.end());
    return all;
}

const std::string& Master::name_of(const std::filesystem::path& scene)
{
    const auto [known, is_new] = names_.try_emplace(scene);
    if (is_new)
        known->second = shared_name_of_scene(scene);
    return known->second;
}

std::size_t Master::nodes_in_step() const
{
    return std::size_t(std::ranges::count_if(gate_.nodes(), [](const auto& node) { return node.second.in; }));
}

std::string Master::missing() const
{
    std::string names;
    for (const auto& [name, node] : gate_.nodes())
        if (!node.in)
            names += (names.empty() ? "" : ", ") + name;
    return names;
}

void Master::send(const SharedInstant& shared)
{
    StateMessage state{++frame_, {}};
    try {
        state.instant = bytes_of(shared);
    } catch (const InputError& error) { // without its texts it is short
        if (std::exchange(too_long_, one_line(error.what())) != one_line(error.what()))
            write_log(LogKind::state_unread, too_long_ + "; the other machines show no text meanwhile");
        SharedInstant shorter = shared;
        shorter.instant.hud.reset(), shorter.instant.sign.reset(), shorter.instant.small_picture.reset();
        state.instant = bytes_of(shorter);
    }
    digest_ = digest_of_instant(state.instant);
    gate_.begin(frame_, digest_);
    begun_ = Clock::now();
    bus_.send(state);
}

void Master::go()
{
    const double drawn_ms = 1e3 * std::chrono::duration<double>(Clock::now() - begun_).count();
    const auto until = begun_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(gate_.bound_s()));
    for (;;) {
        hear();
        const auto left = until - Clock::now();
        if (gate_.complete() || left.count() <= 0)
            break;
        bus_.wait(left);
    }
    bus_.send(gate_.go());
    log_.add(frame_, digest_, drawn_ms);
    report();
}

void Master::hear()
{
    for (const ConfigMessage& config : bus_.configs()) {
        if (config.node == config_.node)
            continue;
        const std::string why = difference(config, config_);
        gate_.refuse(config.node, !why.empty());
        if (std::string& logged = refusals_[config.node]; logged != why && !why.empty())
            write_log(LogKind::node_refused, why);
        refusals_[config.node] = why;
    }
    for (ReadyMessage& ready : bus_.readies()) {
        gate_.hear(ready);
        if (gate_.nodes().contains(ready.node))
            samples_[ready.node] = std::move(ready.samples);
    }
    bus_.state(), bus_.go(); // its own
}

void Master::report()
{
    for (const NodeEvent& event : gate_.take_events()) {
        const std::string node = "node '" + one_line(event.node) + "'";
        switch (event.kind) {
        case NodeEvent::Kind::joins:
            write_log(LogKind::node_joins, node + " is in step");
            break;
        case NodeEvent::Kind::leaves:
            write_log(LogKind::node_leaves,
                node + " was silent for " + std::to_string(Gate::silent_frames) + " frames; the others go on without it");
            break;
        case NodeEvent::Kind::differs:
            write_log(LogKind::node_differs, node + " has drawn another state than the master's");
            break;
        }
    }
}

} // namespace starbow
