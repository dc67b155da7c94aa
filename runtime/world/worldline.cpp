#include "worldline.h"
#include "config/json/error.h"
#include "eye_event.h"
#include "shaders/physics/physics.h"
#include "shaders/shared_structs.h"
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

namespace starbow {
namespace {

/// The rest frame of a segment. It is new if no earlier segment has this velocity, up to the rounding of a file's
/// decimals. Segments at rest are in the world's frame.
int frame_of(World& world, const SceneFile& scene, const WorldlineSegment& segment)
{
    const double alike = 1e-13 * physics::gamma_of(segment.u);
    auto at = std::find_if(world.frames.begin(), world.frames.end(),
        [&](const RestFrame& frame) { return glm::length(frame.u - segment.u) <= alike; });
    if (at == world.frames.end()) {
        if (world.frames.size() == MAX_REST_FRAMES)
            throw InputError(scene.file, "/bodies",
                "move with more than " + std::to_string(MAX_REST_FRAMES - 1)
                    + " different velocities; so many at most is right");
        at = world.frames.insert(at, {segment.u, segment.from});
    }
    return int(at - world.frames.begin());
}

/// The place of a segment's origin in its frame, and its existence interval.
struct Standing {
    int frame;
    glm::dvec3 place;
    int existence;
};
Standing standing(World& world, const SceneFile& scene, const WorldlineSegment& segment)
{
    const int frame = frame_of(world, scene, segment);
    const Event from = in_frame(world.frames[std::size_t(frame)], segment.from);
    const double zero = from.time - (std::isinf(segment.begin) ? 0 : segment.begin);
    const ExistenceInterval existence{zero + segment.begin, zero + segment.end, zero};
    auto at = std::find(world.existence_intervals.begin(), world.existence_intervals.end(), existence);
    if (at == world.existence_intervals.end())
        at = world.existence_intervals.insert(at, existence);
    return {frame, from.position, int(at - world.existence_intervals.begin())};
}

/// By node: true if it or a node above it has one of the names.
std::vector<bool> below(const World& world, const SceneFile& scene, const Body& body)
{
    std::vector<bool> own(world.nodes.size(), false);
    for (const std::string& name : body.nodes) {
        bool found = false;
        for (std::size_t i = 0; i < own.size(); ++i)
            if (world.nodes[i].name == name)
                own[i] = found = true;
        if (!found)
            throw InputError(scene.file, "/bodies",
                "\"" + body.name + "\" names the node \"" + name + "\", which " + scene.gltf.filename().string()
                    + " has not; the name of one of its nodes is right");
    }
    std::vector<bool> out(own);
    for (std::size_t i = 0; i < own.size(); ++i)
        for (int up = world.nodes[i].parent; up >= 0 && !out[i]; up = world.nodes[std::size_t(up)].parent)
            out[i] = own[std::size_t(up)];
    return out;
}

} // namespace

std::vector<WorldlineSegment> segments_of(const Body& body)
{
    if (body.worldline.empty())
        return {{body.u, body.at, -for_ever, for_ever}};
    std::vector<WorldlineSegment> segments;
    double own = 0;
    for (std::size_t i = 0; i + 1 < body.worldline.size(); ++i) {
        const Event &from = body.worldline[i], &to = body.worldline[i + 1];
        const double dt = to.time - from.time;
        const glm::dvec3 dx = to.position - from.position;
        const double way = glm::length(dx), passed = std::sqrt((dt - way) * (dt + way));
        segments.push_back({dx / passed, from, own, own + passed});
        own += passed;
    }
    return segments;
}

Event in_frame(const RestFrame& frame, const Event& world)
{
    const double t = world.time - frame.origin.time;
    const glm::dvec3 x = world.position - frame.origin.position;
    return {physics::world_time(-frame.u, t, x), physics::world_place(-frame.u, t, x)};
}

Shot in_frame(const RestFrame& frame, const Shot& shot)
{
    if (frame == RestFrame{})
        return shot;
    Shot moved = shot;
    const Event event = in_frame(frame, Event{shot.time, shot.position});
    moved.time = event.time;
    moved.position = event.position;
    const physics::Relative relative = physics::relative(frame.u, shot.u);
    moved.u = relative.u;
    moved.ship_from_cockpit = quaternion(relative.turn) * shot.ship_from_cockpit;
    return moved;
}

glm::dvec3 aberrated(const glm::dvec3& u, const glm::dvec3& towards, double& D)
{
    const glm::dmat3 turn = motion_from_world(u, glm::dquat(1, 0, 0, 0));
    const double E = physics::exp_rapidity(glm::length(u));
    const physics::AberratedRay sight = physics::camera_from_world(turn * towards, E, 1 / E);
    D = sight.D;
    return glm::transpose(turn) * sight.n;
}

void place_bodies(World& world, const SceneFile& scene)
{
    world.seconds_per_time_unit = scene.seconds_per_time_unit();
    std::vector<Instance> at_rest, moving;
    std::vector<bool> moves(world.instances.size(), false);
    for (const Body& body : scene.bodies) {
        const std::vector<bool> own = below(world, scene, body);
        for (const WorldlineSegment& segment : segments_of(body)) {
            const Standing where = standing(world, scene, segment);
            std::map<int, int> motions; // of the instances of a deforming mesh several have the same
            for (std::size_t i = 0; i < world.instances.size(); ++i) {
                Instance instance = world.instances[i];
                if (instance.node < 0 || !own[std::size_t(instance.node)])
                    continue;
                moves[i] = true;
                instance.frame_from_local = glm::translate(glm::dmat4(1), where.place) * instance.frame_from_local;
                instance.frame = where.frame, instance.existence = where.existence;
                if (instance.motion >= 0) {
                    const auto [own, is_new] = motions.try_emplace(instance.motion, int(world.motions.size()));
                    if (is_new) {
                        Motion motion = world.motions[std::size_t(instance.motion)];
                        motion.place += where.place;
                        world.motions.push_back(motion);
                    }
                    instance.motion = own->second;
                }
                moving.push_back(instance);
            }
        }
    }
    for (std::size_t i = 0; i < moves.size(); ++i)
        if (!moves[i])
            at_rest.push_back(world.instances[i]);
    world.instances = std::move(at_rest);
    world.instances.insert(world.instances.end(), moving.begin(), moving.end());

    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const auto* point = std::get_if<PointLight>(&scene.lights[i]);
        if (!point || point->body.empty()) {
            world.lamps.push_back({i, 0, point ? point->position : glm::dvec3(0)});
            continue;
        }
        const auto body
            = std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& b) { return b.name == point->body; });
        for (const WorldlineSegment& segment : segments_of(*body)) {
            const Standing where = standing(world, scene, segment);
            world.lamps.push_back({i, where.frame, where.place + point->position, where.existence});
        }
    }
    if (world.lamps.size() > MAX_LIGHTS)
        throw InputError(scene.file, "/lights",
            "are " + std::to_string(world.lamps.size()) + ", each leg of a lamp that moves counted; at most "
                + std::to_string(MAX_LIGHTS) + " is right");
}

} // namespace starbow
