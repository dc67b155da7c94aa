// The visit: what an exhibit does by itself between one visitor and the next.
#include "config/json/error.h"
#include "config/json/reader.h"
#include "frame_loop.h"
#include "runtime/operation/log.h"
#include "runtime/operation/messages.h"
#include "session_commands.h"

namespace starbow {
namespace {

VisitSigns signs_of(const Session& session)
{
    const FlightSource& source = *session.source;
    return {.somebody = session.hands.somebody(),
        .watches = session.docent.holds() || (source.tour() && !source.over() && !source.paused()),
        .attraction_over = source.over()};
}

/// True where the flight begins at rest, and is the visitor's own.
bool begins_at_rest(const Session& session) { return !session.tour() && session.content.start.u == glm::dvec3(0); }

/// Somebody else attends: only what tells a visitor where to begin begins again.
void wait_for_visitor(Session& session)
{
    if (TourPlayer* tour = session.source->tour())
        tour->again();
    forget_hands(session);
    session.tutorial = tutorial_at(session.flight());
    session.attendance.begin();
}

} // namespace

/// Shows an attraction. One whose files have become wrong is logged, and the flight's start is shown in its place.
void FrameLoop::show_attraction(std::size_t number)
{
    try {
        show_content(attraction_of(session_.options, session_.words, number), false);
    } catch (const InputError& error) {
        write_log(LogKind::attraction_refused, one_line(error.what()) + "; the start of the flight is shown in its place");
        show_content(session_.options.content, false);
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

Requests FrameLoop::attend(const Controls& hands, std::int64_t dt_ns)
{
    Requests requests;
    if (session_.record_replay.replays())
        return requests;
    Attendance& attendance = session_.attendance;
    const VisitEvents events = attendance.advance(signs_of(session_), dt_ns);
    const Visit& visit = attendance.visit();
    if (visit.phase == VisitPhase::entering && visit.phase_ns == 0
        && session_.options.content.scene != session_.content.scene)
        worlds_.open(session_.options.content.scene); // while the picture fades
    if (events.ends && (attendance.attends() || events.length_s > 0))
        count_visit(session_, events.length_s);
    if (!attendance.attends()) {
        if (events.ends)
            wait_for_visitor(session_);
        return requests;
    }
    change_visitors(events);
    requests = attendance.lead_home(*session_.source, hands, begins_at_rest(session_), 1e-9 * double(dt_ns));
    if (events.begins)
        Attendance::wait_for_throttle(hands, begins_at_rest(session_), requests);
    return requests;
}

/// Carries out what the visit asks for where the exhibit itself attends to its visitors.
void FrameLoop::change_visitors(const VisitEvents& events)
{
    if (events.ends) {
        forget_coming();
        session_.record_replay.end(session_.flight(), print_message);
        session_.record_replay.close();
        forget_visitor(session_);
        session_.lab.reset();
        session_.alignment.show_first();
    }
    if (events.shows_attraction)
        show_attraction(session_.attendance.visit().attraction);
    if (events.begins) {
        show_content(session_.options.content);
        record_visit();
    }
    if (events.ends && session_.options.visit_over)
        session_.options.visit_over(digest(session_));
}

} // namespace starbow
