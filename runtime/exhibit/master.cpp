#include "master.h"
#include "config/json/error.h"
#include "machine_files.h"
#include "runtime/machines/page_bytes.h"
#include "runtime/operation/log.h"
#include <algorithm>
#include <random>

namespace starbow {
namespace {

/// A node whose files differ from the master's for so long is named in the log; a layout's change reaches all in less.
constexpr auto longest_change = std::chrono::seconds(2);

std::set<std::string> others_of(const Layout& layout, const std::string& master)
{
    std::set<std::string> others;
    for (const std::string& node : nodes_of(layout))
        if (node != master)
            others.insert(node);
    return others;
}

std::uint64_t random_number()
{
    std::random_device random;
    return std::uint64_t(random()) << 32 | random();
}

std::int64_t now_ns()
{
    using namespace std::chrono;
    return duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
}

} // namespace

Master::Master(const ExhibitOptions& options, const Layout& layout)
    : machines_(options.machines.value())
    , number_(random_number())
    , bus_(place_of(machines_), Bus::Role::master, write_log)
    , config_(config_of(options, digests_of(layout)))
    , gate_(others_of(layout, options.node))
    , layout_digest_(digest_of(config_.layout))
    , log_(options.frame_log)
    , frame_(now_ns()) // above the frames of a master before it
{
    bus_.know(nodes_of(layout));
    bus_.send(config_);
}

std::string Master::lack() const
{
    if (!bus_.lack().empty())
        return bus_.lack();
    return contested_ && !leads_ ? "another master leads this exhibit" : "";
}

bool Master::leads()
{
    const Clock::time_point now = Clock::now();
    if (bus_.follow()) {
        log_routes(machines_);
        leading_.emplace(number_, now);
    }
    if (!leading_)
        return false;
    if (const std::optional<StateMessage> other = bus_.state()) {
        rivals_frame_ = other->frame;
        const bool followed = rival_followed_ && now - *rival_followed_ < std::chrono::seconds(1);
        leading_->hears({other->master, other->led_ms, followed}, gate_.somebody_in(), now);
    }
    const bool leads = leading_->leads(gate_.somebody_in(), now), led = std::exchange(leads_, leads);
    if (leads && !led)
        bus_.send(config_); // nodes of another master have not heard it
    const bool contested = leading_->hears_other(now), was = std::exchange(contested_, contested);
    const std::string other = "another master of this exhibit, '" + machines_.exhibit + "', sends states";
    if (contested && (!was || led != leads))
        write_limited(LogKind::master_second,
            leads ? other + ", too; the nodes of this one go on with it. One master is right"
                  : other + "; this one shows its own outputs alone, and leads once the other is gone");
    else if (was && !contested)
        write_limited(LogKind::master_second, "no other master is heard any more; this one leads");
    return leads;
}

void Master::adopt(const Layout& layout, FileDigests digests)
{
    config_.layout = std::move(digests);
    layout_digest_ = digest_of(config_.layout);
    gate_.have(others_of(layout, config_.node));
    bus_.know(nodes_of(layout));
    bus_.send(config_);
    for (const auto& [node, config] : configs_)
        judge(config); // else the next frames would wait for those that can't draw them yet
}

const std::string& Master::name_of(const std::string& kind, const std::filesystem::path& file)
{
    const auto [known, is_new] = names_.try_emplace(file);
    if (is_new)
        known->second = shared_name(kind, file);
    return known->second;
}

void Master::describe(std::vector<MachineHealth>& machines) const
{
    machines.resize(1 + gate_.nodes().size());
    auto next = machines.begin();
    const auto put = [&](const std::string& name, bool in_step, double frame_ms, bool differs) {
        next->name = name, next->in_step = in_step, next->frame_ms = frame_ms, next->differs = differs;
        ++next;
    };
    put(config_.node, true, drawn_ms_, false);
    for (const auto& [name, node] : gate_.nodes())
        put(name, node.in, node.frame_ms, node.refused);
}

void Master::send(const SharedState& shared, bool leapt)
{
    const bool leads = this->leads();
    const auto& on = shared.picture.instruments;
    if (!leads)
        page_ = 0; // the nodes will lack it
    else if (on && on->panel && std::exchange(page_, on->panel_number) != page_)
        bus_.send(page_of(*on->panel, on->panel_number));
    StateMessage state{++frame_, {}};
    try {
        state.bytes = bytes_of(shared);
    } catch (const InputError& error) { // without its texts it is short
        if (std::exchange(too_long_, one_line(error.what())) != one_line(error.what()))
            write_limited(LogKind::state_unread, too_long_ + "; the other machines show no text meanwhile");
        SharedState shorter = shared;
        shorter.picture.hud.reset(), shorter.picture.sign.reset(), shorter.picture.inset.reset();
        shorter.picture.highlights.clear(), shorter.picture.sky_labels.clear();
        state.bytes = bytes_of(shorter);
    }
    digest_ = digest_of_state(state.bytes);
    gate_.begin(frame_, digest_, leapt);
    begun_ = Clock::now();
    if (!leads)
        return;
    state.master = number_, state.led_ms = leading_->led_ms(begun_);
    bus_.send(state);
}

void Master::go()
{
    drawn_ms_ = 1e3 * std::chrono::duration<double>(Clock::now() - begun_).count();
    if (!leads_) {
        hear();
        gate_.let_all_out();
        log_.add(frame_, digest_, drawn_ms_);
        return report();
    }
    const auto until = begun_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(gate_.bound_s()));
    for (;;) {
        hear();
        const auto left = until - Clock::now();
        if (gate_.complete() || left.count() <= 0)
            break;
        bus_.wait(left);
    }
    bus_.send(gate_.go());
    log_.add(frame_, digest_, drawn_ms_);
    report();
}

void Master::hear()
{
    for (ConfigMessage& config : bus_.configs())
        if (config.node != config_.node) { // else it is another master's
            judge(config);
            configs_[config.node] = std::move(config);
        }
    for (ReadyMessage& ready : bus_.readies()) {
        constexpr std::int64_t late = 60; // frames
        if (rivals_frame_ >= 0 && std::abs(ready.frame - rivals_frame_) < late)
            rival_followed_ = Clock::now();
        gate_.hear(std::move(ready));
    }
}

void Master::judge(const ConfigMessage& config)
{
    if (!gate_.nodes().contains(config.node))
        return; // a layout to come may have it
    std::string why = difference(config, config_);
    if (why.empty())
        why = layout_difference(config, config_);
    gate_.refuse(config.node, !why.empty());
    Refusal& refusal = refusals_[config.node];
    if (refusal.why.empty() != why.empty())
        refusal = {.since = Clock::now()};
    refusal.why = why;
}

void Master::report()
{
    for (auto& [node, refusal] : refusals_)
        if (!refusal.why.empty() && !refusal.logged && Clock::now() - refusal.since > longest_change) {
            write_limited(LogKind::node_refused, refusal.why);
            refusal.logged = true;
        }
    for (const NodeEvent& event : gate_.take_events()) {
        const std::string node = "node '" + one_line(event.node) + "'";
        switch (event.kind) {
        case NodeEvent::Kind::joins:
            write_limited(LogKind::node_joins, node + " is in step");
            break;
        case NodeEvent::Kind::leaves:
            write_limited(LogKind::node_leaves,
                node + " was silent for " + std::to_string(Gate::silent_frames) + " frames; the others go on without it");
            break;
        case NodeEvent::Kind::differs:
            write_limited(LogKind::node_differs, node + " has drawn a state other than the master's");
            break;
        case NodeEvent::Kind::doubled:
            write_limited(LogKind::node_doubled, "two programs run as " + node + "; one program for each node is right");
            break;
        }
    }
}

} // namespace starbow
