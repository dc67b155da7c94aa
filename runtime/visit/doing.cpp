#include "doing.h"
#include "tour_player.h"

namespace starbow {

Doing doing_of(const Attendance& attendance, const FlightSource& source, bool record)
{
    const TourPlayer* tour = source.over() ? nullptr : source.tour();
    if (attendance.attends())
        switch (attendance.visit().phase) {
        case VisitPhase::attract:
            return tour ? Doing::attract_tour : record ? Doing::attract_record : Doing::attract_start;
        case VisitPhase::changing:
        case VisitPhase::leaving:
            return Doing::changes;
        case VisitPhase::entering:
            return Doing::enters;
        case VisitPhase::asking:
            return Doing::asks;
        case VisitPhase::flying:
            break;
        }
    if (tour)
        return tour->by_hand() ? Doing::tour_flies : tour->asks() ? Doing::tour_asks : Doing::tour;
    return attendance.knows_visitor() ? Doing::flies : Doing::waits;
}

} // namespace starbow
