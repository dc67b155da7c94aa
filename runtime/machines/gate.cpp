#include "gate.h"
#include <algorithm>

namespace starbow {

Gate::Gate(const std::set<std::string>& nodes) { have(nodes); }

void Gate::have(const std::set<std::string>& nodes)
{
    std::erase_if(nodes_, [&](const auto& node) { return !nodes.contains(node.first); });
    for (const std::string& node : nodes)
        nodes_[node];
}

void Gate::begin(std::int64_t frame, std::uint64_t digest, bool leapt)
{
    frame_ = frame, digest_ = digest;
    if (!leapt)
        return;
    leapt_ = frame;
    for (auto& [name, node] : nodes_)
        node.samples.clear();
}

void Gate::hear(ReadyMessage ready)
{
    const auto found = nodes_.find(ready.node);
    if (found == nodes_.end() || found->second.refused || ready.frame > frame_)
        return; // a frame to come is one of an earlier master
    Node& node = found->second;
    node.heard = std::max(node.heard, ready.frame);
    node.frame_ms = ready.frame_ms, node.barrier = ready.barrier;
    if (ready.frame >= leapt_)
        node.samples = std::move(ready.samples);
    if (ready.sender != node.sender) {
        // A program that was started again speaks from then on; of two that run, each speaks again after the other.
        if (ready.sender == node.sender_before && !std::exchange(node.doubled, true))
            events_.push_back({NodeEvent::Kind::doubled, ready.node, frame_});
        node.sender_before = std::exchange(node.sender, ready.sender);
    }
    if (ready.frame == frame_ && ready.digest != digest_)
        events_.push_back({NodeEvent::Kind::differs, ready.node, frame_});
}

void Gate::refuse(const std::string& node, bool refused)
{
    const auto found = nodes_.find(node);
    if (found == nodes_.end())
        return;
    found->second.refused = refused;
    if (refused)
        found->second.in = false;
}

void Gate::let_all_out()
{
    for (auto& [name, node] : nodes_)
        node.in = false, node.silent = 0, node.heard = -1;
}

bool Gate::complete() const
{
    return std::ranges::all_of(nodes_, [&](const auto& node) { return !node.second.in || node.second.heard >= frame_; });
}

double Gate::slowest_ms() const
{
    double slowest = 0;
    for (const auto& [name, node] : nodes_)
        slowest = std::max(slowest, node.in ? node.frame_ms : 0);
    return slowest;
}

std::vector<ViewSamples> Gate::samples() const
{
    std::vector<ViewSamples> all;
    for (const auto& [name, node] : nodes_)
        if (node.in)
            all.insert(all.end(), node.samples.begin(), node.samples.end());
    return all;
}

bool Gate::somebody_in() const
{
    return std::ranges::any_of(nodes_, [](const auto& node) { return node.second.in; });
}

bool Gate::barrier() const
{
    return std::ranges::all_of(nodes_, [](const auto& node) { return !node.second.in || node.second.barrier; });
}

double Gate::bound_s() const { return std::clamp(2e-3 * slowest_ms(), least_wait_s, most_wait_s); }

GoMessage Gate::go()
{
    GoMessage message{frame_, {}};
    for (auto& [name, node] : nodes_) {
        if (node.heard >= frame_) {
            node.silent = 0;
            if (!node.in)
                events_.push_back({NodeEvent::Kind::joins, name, frame_});
            node.in = true;
            message.members.push_back(name);
        } else if (node.in) {
            if (++node.silent >= silent_frames) {
                node.in = node.doubled = false;
                events_.push_back({NodeEvent::Kind::leaves, name, frame_});
            }
        } else if (node.heard >= 0 && !node.refused && frame_ - node.heard < silent_frames) {
            // It draws, but began late: the next frame waits for it.
            node.in = true, node.silent = 0;
            events_.push_back({NodeEvent::Kind::joins, name, frame_});
        }
    }
    return message;
}

} // namespace starbow
