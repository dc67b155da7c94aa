#include "remote_control.h"
#include "runtime/operation/log.h"
#include "thumbnails.h"

namespace starbow {
namespace {

void describe(const Session& session, Snapshot& out)
{
    describe(session, static_cast<ExhibitState&>(out));
    out.layout = command_name_of(session.layout.file);
    out.quality = session.qualities.name();
    out.pattern = pattern_names[std::size_t(session.alignment.pattern())];
    out.grip = session.alignment.grip();
    out.grip_says = session.alignment.grip_says();
    const Attendance& attendance = session.attendance;
    const VisitPhase phase
        = attendance.attends() || attendance.knows_visitor() ? attendance.visit().phase : VisitPhase::attract;
    out.visit = visit_phase_names[std::size_t(phase)];
    out.frame_ms = 1e3 * session.frame_s;
    out.frames_per_s = session.frame_s > 0 ? 1 / session.frame_s : 0;
    out.error = session.refused.empty() ? session.docent.refusal : session.refused;
    out.machines = line_of(session.machines);
    if (out.error.empty())
        out.error = session.lacks.empty() ? steps_of(session) : session.lacks;
    out.uptime_s = seconds(Session::Clock::now() - session.began);
}

} // namespace

RemoteControl::RemoteControl(const ExhibitOptions& options)
{
    if (options.remote.port == 0)
        return;
    RemoteOptions remote{.settings = options.remote, .version = options.version};
    remote.patterns.assign(pattern_names.begin(), pattern_names.end());
    remote.programme = options.programme;
    // A wrong file is reported where it is shown.
    for (const Thumbnail& one : thumbnails(options.cache, options.words, [](const std::string&) {}))
        remote.thumbnails[one.kind + "/" + one.name] = one.file;
    remote_ = std::make_unique<Remote>(std::move(remote));
}

void RemoteControl::read(std::vector<Command>& commands)
{
    if (!remote_)
        return;
    for (NumberedCommand arrived; remote_->take(arrived);) {
        pending_.push_back({arrived.number, {}});
        commands.push_back(std::move(arrived.command));
    }
}

void RemoteControl::note(const std::string& refusal)
{
    if (noted_ < pending_.size())
        pending_[noted_++].refusal = refusal;
}

void RemoteControl::defer(std::size_t index)
{
    resume("another world was asked for meanwhile");
    if (noted_ + index >= pending_.size())
        return; // a visitor's
    const auto at = pending_.begin() + std::ptrdiff_t(noted_ + index);
    deferred_ = at->number;
    pending_.erase(at);
}

void RemoteControl::resume(const std::string& refusal)
{
    if (!deferred_)
        return;
    if (refusal.empty())
        pending_.push_back({*deferred_, {}});
    else
        remote_->answer(*deferred_, refusal);
    deferred_.reset();
}

void RemoteControl::shown(const Session& session)
{
    if (!remote_)
        return;
    const Clock::time_point now = Clock::now();
    if (!pending_.empty() || now - published_ > std::chrono::milliseconds(50)) {
        describe(session, remote_->next_snapshot());
        remote_->publish_snapshot(); // before the answers, so that an answered command is in the state
        published_ = now;
    }
    for (const Pending& command : pending_)
        remote_->answer(command.number, command.refusal);
    pending_.clear(), noted_ = 0;
}

void RemoteControl::publish_condition(const Session& session)
{
    if (!remote_)
        return;
    Condition& condition = remote_->next_condition();
    condition.metrics = session.usage.exposition();
    condition.log = last_lines();
    condition.grips.clear();
    for (Grip& grip : grips(session.layout))
        condition.grips.push_back(std::move(grip.name));
    condition.unkept = changes(session.kept, session.layout).size();
    remote_->publish_condition();
}

bool RemoteControl::wants_picture()
{
    const Clock::time_point now = Clock::now();
    if (!remote_ || !remote_->picture_wanted() || now - pictured_ < std::chrono::milliseconds(950))
        return false;
    pictured_ = now;
    return true;
}

std::string RemoteControl::drawn_pins() const
{
    if (!remote_)
        return "";
    std::string line;
    const Pins& pins = remote_->drawn_pins();
    for (std::size_t role = 0; role < pins.size(); ++role)
        if (!pins[role].empty())
            line += (line.empty() ? "PINs: " : ", ") + std::string(role_names[role]) + " " + pins[role];
    return line;
}

} // namespace starbow
