// The visit: what an exhibit does by itself between one visitor and the next.
#include "config/json/error.h"
#include "config/json/reader.h"
#include "frame_loop.h"
#include "obey.h"
#include "runtime/operation/log.h"
#include "runtime/operation/messages.h"
#include <algorithm>
#include <utility>

namespace starbow {
namespace {

VisitSigns signs_of(const Session& session)
{
    const std::optional<Guide>& guide = session.guide;
    return {.somebody = session.somebody,
        .watches = session.directions.holds || (guide && !guide->over() && !guide->paused()),
        .attraction_over = (guide && guide->over()) || (session.shown_record && session.shown_record->over())};
}

/// A throttle that is open at the start has no effect before it was at 0.
void wait_for_throttle(const Session& session, Controls& controls)
{
    const bool rests = !session.guide && session.programme.start.u == glm::dvec3(0);
    if (rests && controls.lever.value_or(0) > lever_touched)
        controls.set(Switch::stop);
}

/// The longest way home that is flown, s; a longer one leads through black.
constexpr double longest_way_home_s = 5;

/// True if the ship is back at the start in time.
bool flies_home(const Session& session, double seconds_per_time_unit)
{
    Controls home;
    home.set(Switch::home);
    const Flight later = step(session.flight, home, std::int64_t(1e9 * longest_way_home_s), session.rules,
        seconds_per_time_unit, session.programme.start);
    return !later.homing;
}

/// Brings a visitor home who asks for it, wherever the ship is.
void lead_home(Session& session, Controls& controls, double dt_s, double seconds_per_time_unit)
{
    if (controls[Switch::home] && !session.guide && !session.flight.homing && !flies_home(session, seconds_per_time_unit)) {
        controls.set(Switch::home, false);
        session.goes_home = true;
    }
    // From the world's end the way leads backwards, and nothing is seen: it is left out, once the ship has slowed down.
    const std::optional<Homing>& homing = session.flight.homing;
    session.goes_home |= homing && homing->from_boundary && homing->leg == HomingLeg::way;
    if (!session.goes_home && session.home_black == 1) {
        wait_for_throttle(session, controls);
        if (controls.throttle_rate > 0) // a key that is still held, too
            controls.set(Switch::stop);
    }
    const double half_s = std::max(session.visiting.fade_s / 2, 1e-3);
    session.home_black = std::clamp(session.home_black + (session.goes_home ? dt_s : -dt_s) / half_s, 0.0, 1.0);
    if (session.goes_home && session.home_black == 1) {
        controls.set(Switch::reset);
        session.goes_home = false;
    }
}

/// Somebody else attends: only what tells a visitor where to begin begins anew.
void wait_for_visitor(Session& session)
{
    if (session.guide)
        session.guide->again();
    forget_hands(session);
    session.tutorial = tutorial_at(session.flight);
    session.visit = begun(session.visit);
}

} // namespace

/// Shows an attraction. One whose files have become wrong is logged, and the flight's start is shown in its place.
void FrameLoop::show_attraction(std::size_t number)
{
    try {
        show_programme(attraction_of(session_.options, session_.words, number), false);
    } catch (const InputError& error) {
        write_log(LogKind::attraction_refused, one_line(error.what()) + "; the start of the flight is shown in its place");
        show_programme(session_.options.programme, false);
    }
}

/// Each visitor has a record. Where a disk takes none, the visit goes on without.
void FrameLoop::record_visit()
{
    if (session_.options.record.empty())
        return;
    try {
        session_.record_replay.record(recorder_of(session_.options, session_.rules));
    } catch (const InputError& error) {
        write_log(LogKind::record_ended, one_line(error.what()) + "; this visit is not recorded");
    }
}

void FrameLoop::attend(RecordEntry& entry)
{
    if (session_.record_replay.replays())
        return;
    VisitEvents events;
    session_.visit = advance(session_.visit, session_.visiting, signs_of(session_), entry.dt_ns, events);
    if (session_.visit.phase == VisitPhase::entering && session_.visit.phase_ns == 0
        && session_.options.programme.scene != session_.programme.scene)
        worlds_.open(session_.options.programme.scene); // while the picture fades
    session_.visited_s += knows_visitor(session_) ? 1e-9 * double(entry.dt_ns) : 0;
    if (events.ends && (session_.options.visiting || events.length_s > 0))
        count_visit(session_, events.length_s);
    if (session_.options.visiting) {
        change_visitors(events, entry.controls);
        lead_home(session_, entry.controls, 1e-9 * double(entry.dt_ns), context_.world.scene.seconds_per_time_unit());
    } else if (events.ends)
        wait_for_visitor(session_);
}

/// Carries out what the visit asks for where the exhibit itself attends to its visitors.
void FrameLoop::change_visitors(const VisitEvents& events, Controls& controls)
{
    if (events.ends) {
        forget_coming();
        session_.record_replay.end(session_.flight, print_message);
        session_.record_replay.close();
        forget_visitor(session_);
        session_.goes_home = false;
        session_.lab.reset();
        session_.alignment.show_first();
        controls.set(Switch::reset); // the switches' own states, too
    }
    if (events.shows_attraction)
        show_attraction(session_.visit.attraction);
    if (events.begins) {
        show_programme(session_.options.programme);
        record_visit();
        wait_for_throttle(session_, controls);
    }
    if (events.ends && session_.options.visit_over)
        session_.options.visit_over(digest(session_));
}

} // namespace starbow
