#include "body.h"
#include "shot_reader.h"

namespace starbow {
namespace {

constexpr std::size_t most_bodies = 1024, most_events = 64, most_nodes = 256;

Event read_event(const Place& place)
{
    reject_unknown_members(place, {"time", "position"});
    Event event;
    take(place, "time", event.time, {-farthest, farthest});
    take(place, "position", event.position, {-farthest, farthest});
    return event;
}

std::vector<Event> read_worldline(const Place& place)
{
    std::vector<Event> events;
    for (const Place& at : items(place, 2, most_events, "events")) {
        const Event event = read_event(at);
        if (!events.empty()) {
            const double passed = event.time - events.back().time;
            const double way = glm::distance(event.position, events.back().position);
            if (!(passed > 0))
                complain(member(at, "time"),
                    "is not after the event before it; a time above " + shown(events.back().time) + " is right");
            if (!(way < passed))
                complain(at,
                    "can't be reached at less than the speed of light, " + shown(way) + " in a time of " + shown(passed)
                        + "; a time above " + shown(events.back().time + way) + " is right");
        }
        events.push_back(event);
    }
    return events;
}

Body read_body(const Place& place)
{
    reject_unknown_members(place, {"name", "nodes", "at", "velocity", "worldline"});
    Body body;
    body.name = text(member(place, "name"));
    for (const Place& node : items(member(place, "nodes"), 1, most_nodes, "names of nodes"))
        body.nodes.push_back(text(node));
    if (auto worldline = find_member(place, "worldline")) {
        for (const char* other : {"at", "velocity"})
            if (auto p = find_member(place, other))
                complain(*p, "stands beside a \"worldline\", which has it already; one of the two is right");
        body.worldline = read_worldline(*worldline);
        return body;
    }
    body.u = read_velocity(member(place, "velocity"));
    if (auto at = find_member(place, "at"))
        body.at = read_event(*at);
    return body;
}

} // namespace

std::vector<Body> read_bodies(const Place& place)
{
    std::vector<Body> bodies;
    for (const Place& at : items(place, 0, most_bodies, "bodies")) {
        bodies.push_back(read_body(at));
        for (std::size_t i = 0; i + 1 < bodies.size(); ++i)
            if (bodies[i].name == bodies.back().name)
                complain(member(at, "name"), "is the name of another body as well; one of its own is right");
    }
    return bodies;
}

} // namespace starbow
