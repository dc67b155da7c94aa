#include "describe_scene.h"

namespace starbow {
namespace {

constexpr std::size_t most_events = 64;

} // namespace

std::vector<Event> WorldLine::read(const Place& place, const Folder&) const
{
    std::vector<Event> events;
    for (const Place& at : items(place, 2, most_events, "events")) {
        const Event event = starbow::read<Event>(at);
        if (!events.empty()) {
            const double passed = event.time - events.back().time;
            const double way = glm::distance(event.position, events.back().position);
            if (!(passed > 0))
                fail_at(member(at, "time"),
                    "is not after the event before it; a time above " + shown(events.back().time) + " is right");
            if (!(way < passed))
                fail_at(at,
                    "can't be reached at less than the speed of light, " + shown(way) + " in a time of " + shown(passed)
                        + "; a time above " + shown(events.back().time + way) + " is right");
        }
        events.push_back(event);
    }
    return events;
}

Json WorldLine::schema(Json& definitions) const
{
    return described::list_schema(2, most_events, Object<Event>{}.schema(definitions));
}

void check_members(const Place& place, const Body*)
{
    if (!find_member(place, "worldline")) {
        member(place, "velocity");
        return;
    }
    for (const char* other : {"at", "velocity"})
        if (auto p = find_member(place, other))
            fail_at(*p, "stands beside a \"worldline\", which has it already; one of the two is right");
}

} // namespace starbow
