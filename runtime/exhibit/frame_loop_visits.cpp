// The visit: what an exhibit does by itself between one visitor and the next.
#include "config/json/error.h"
#include "config/json/reader.h"
#include "frame_loop.h"
#include "obey.h"
#include "runtime/operation/log.h"
#include "runtime/operation/messages.h"
#include <utility>

namespace starbow {
namespace {

VisitSigns signs_of(const Session& session)
{
    const std::optional<Guide>& guide = session.guide;
    return {.somebody = session.somebody,
        .watches = session.directions.holds || (guide && !guide->over() && !guide->paused()),
        .attraction_over = guide && guide->over()};
}

/// Somebody else attends: only what tells a visitor where to begin begins anew.
void wait_for_visitor(Session& session)
{
    if (session.guide)
        session.guide->again();
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
        session_.record_replay.record(recorder_of(session_.options));
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
    session_.visited_s += knows_visitor(session_) ? 1e-9 * double(entry.dt_ns) : 0;
    if (events.ends && (session_.options.visiting || events.length_s > 0))
        count_visit(session_, events.length_s);
    if (session_.options.visiting)
        change_visitors(events, entry.controls);
    else if (events.ends)
        wait_for_visitor(session_);
}

/// Carries out what the visit asks for where the exhibit itself attends to its visitors.
void FrameLoop::change_visitors(const VisitEvents& events, Controls& controls)
{
    if (events.ends) {
        session_.record_replay.end(session_.flight, print_message);
        session_.record_replay.close();
        forget_visitor(session_);
        session_.lab.reset();
        session_.alignment.show_first();
        controls.reset = true; // the switches' own states, too
    }
    if (events.shows_attraction)
        show_attraction(session_.visit.attraction);
    if (events.begins) {
        show_programme(session_.options.programme);
        record_visit();
    }
    if (events.ends && session_.options.visit_over)
        session_.options.visit_over(digest(session_));
}

} // namespace starbow
