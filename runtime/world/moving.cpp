#include "moving.h"
#include "config/json/error.h"
#include "config/model/angles.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

namespace starbow {
namespace {

constexpr double tiny = 2.2e-16;

/// A joint's pose at its own time.
glm::dmat4 pose(const World& world, int index, double own_s)
{
    const Joint& joint = world.joints[std::size_t(index)];
    glm::dmat4 m = joint.above_from_parent;
    if (joint.above >= 0)
        m = pose(world, joint.above, own_s) * m;
    auto value = [&](int track) { return value_at(world.tracks[std::size_t(track)], own_s); };
    const glm::dvec3 translation = joint.translations < 0 ? joint.translation : glm::dvec3(value(joint.translations));
    const glm::dvec3 scale = joint.scales < 0 ? joint.scale : glm::dvec3(value(joint.scales));
    glm::dquat rotation = joint.rotation;
    if (joint.rotations >= 0) {
        const glm::dvec4 q = value(joint.rotations);
        rotation = glm::dquat(q.w, q.x, q.y, q.z);
    }
    glm::dmat4 local = glm::mat4_cast(rotation);
    for (int i = 0; i < 3; ++i)
        local[i] *= scale[i];
    local[3] = glm::dvec4(translation, 1);
    m = m * local;
    if (joint.spin) {
        const glm::dmat3 turn(m);
        const double turns = joint.spin->turns_per_s * own_s, sign = glm::determinant(turn) < 0 ? -1 : 1;
        const glm::dvec3 axis = turn * joint.spin->axis;
        if (glm::length(axis) > 0) {
            const glm::dmat3 turned
                = glm::dmat3(glm::rotate(glm::dmat4(1), sign * 2 * pi * (turns - std::floor(turns)), axis)) * turn;
            for (int i = 0; i < 3; ++i)
                m[i] = glm::dvec4(turned[i], 0);
        }
    }
    return m;
}

double zero_of(const World& world, const Instance& instance)
{
    return instance.existence < 0 ? 0 : world.existence_intervals[std::size_t(instance.existence)].zero;
}

/// The greatest distance of a box's corners from its middle.
double around(const Primitive& primitive, const glm::dmat4& m)
{
    const glm::dvec3 half = 0.5 * (primitive.high - primitive.low);
    double most = 0;
    for (int i = 0; i < 4; ++i)
        most = std::max(
            most, glm::length(glm::dmat3(m) * glm::dvec3(half.x, i & 1 ? -half.y : half.y, i & 2 ? -half.z : half.z)));
    return most;
}

} // namespace

glm::dmat4 pose_of(const World& world, const Motion& motion, double own_s)
{
    glm::dmat4 m = pose(world, motion.joint, own_s) * motion.joint_from_local;
    m[3] += glm::dvec4(motion.place, 0);
    return m;
}

double longest(const World& world, int index)
{
    double longest_s = 0;
    for (; index >= 0; index = world.joints[std::size_t(index)].above) {
        const Joint& joint = world.joints[std::size_t(index)];
        for (int track : {joint.translations, joint.rotations, joint.scales})
            if (track >= 0)
                longest_s = std::max(longest_s, world.tracks[std::size_t(track)].length_s);
        if (joint.spin && joint.spin->turns_per_s != 0)
            longest_s = std::max(longest_s, 1 / std::abs(joint.spin->turns_per_s));
    }
    return longest_s;
}

glm::dmat4 pose_at(const World& world, const Instance& instance, double time)
{
    return pose_of(
        world, world.motions[std::size_t(instance.motion)], (time - zero_of(world, instance)) * world.seconds_per_time_unit);
}

SeenPose seen_pose(const World& world, const Instance& instance, const EyeEvent& eye_event)
{
    const Primitive& primitive = world.primitives[instance.primitive];
    const glm::dvec4 middle(0.5 * (primitive.low + primitive.high), 1);
    // The middle's retarded time is a fixed point of a map that contracts by 0.2. Secants find it, and bisection where a
    // jump leaves no such time or two.
    auto sent = [&](double time) {
        return retarded_time(
            eye_event, eye_event.cube_from_frame * (glm::dvec3(pose_at(world, instance, time) * middle) - eye_event.place));
    };
    double low = -1e300, high = 1e300; // too early, too late
    double time = sent(eye_event.time), before = eye_event.time, off_before = time - eye_event.time;
    for (int round = 0; round < 100; ++round) {
        const double off = sent(time) - time;
        if (std::abs(off) <= 1e-12 * (1 + std::abs(eye_event.time - time)) + 4 * tiny * std::abs(time))
            break;
        (off > 0 ? low : high) = time;
        const double slope = (off - off_before) / (time - before);
        double next = slope < -0.5 && slope > -2 ? time - off / slope : time + off;
        if (next <= low || next >= high)
            next = low > -1e300 && high < 1e300 ? 0.5 * (low + high) : time + off;
        if (next == time || high - low <= 4 * tiny * std::abs(time))
            break;
        before = time, off_before = off, time = next;
    }
    SeenPose seen{time, pose_at(world, instance, time), 0};
    // A point at distance `around` is seen at most that far away, plus its motion in the difference of the retarded
    // times.
    seen.window = around(primitive, seen.frame_from_local) / (1 - most_own_speed);
    return seen;
}

std::array<double, POSES> pose_times(const World& world, const Instance& instance, const SeenPose& seen)
{
    const double zero = zero_of(world, instance), unit_s = world.seconds_per_time_unit;
    const double own_s = (seen.sent - zero) * unit_s;
    double begin = -1e300, end = 1e300, key = 1e300;
    for (int joint = world.motions[std::size_t(instance.motion)].joint; joint >= 0;
         joint = world.joints[std::size_t(joint)].above)
        for (int which : {world.joints[std::size_t(joint)].translations, world.joints[std::size_t(joint)].rotations,
                 world.joints[std::size_t(joint)].scales})
            if (which >= 0) {
                const Track& track = world.tracks[std::size_t(which)];
                const Unbroken own = unbroken(track, own_s);
                begin = std::max(begin, own.begin_s), end = std::min(end, own.end_s);
                const double near = nearest_key(track, own_s);
                key = std::abs(near - own_s) < std::abs(key - own_s) ? near : key;
            }
    // A little inside the interval, so that rounding can't leave it.
    const double inside = 16 * tiny * (std::abs(own_s) + std::abs(zero * unit_s)) + 1e-12;
    auto of_frame = [&](double own) { return own / unit_s + zero; };
    const double first = std::max(seen.sent - seen.window, std::min(of_frame(begin + inside), seen.sent));
    const double last = std::min(seen.sent + seen.window, std::max(of_frame(end - inside), seen.sent));
    const double bend = of_frame(key), middle = bend > first && bend < last ? bend : seen.sent;
    constexpr int half = POSES / 2;
    std::array<double, POSES> times;
    for (int i = 0; i <= half; ++i) {
        times[std::size_t(i)] = first + (middle - first) * i / half;
        times[std::size_t(half + i)] = middle + (last - middle) * i / half;
    }
    return times;
}

namespace {

/// The furthest of many points in each of 26 directions: an approximate hull.
class Hull {
public:
    void add(const glm::dvec3& point)
    {
        std::size_t at = 0;
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z, ++at) {
                    const double reach = glm::dot(point, glm::dvec3(x, y, z));
                    if (empty_ || reach > reach_[at])
                        reach_[at] = reach, points_[at] = point;
                }
        empty_ = false;
    }
    bool empty() const { return empty_; }
    const std::array<glm::dvec3, 27>& points() const { return points_; }

private:
    bool empty_ = true;
    std::array<double, 27> reach_{};
    std::array<glm::dvec3, 27> points_{};
};

Hull hull_of(const World& world, const Primitive& primitive)
{
    Hull hull;
    for (std::uint32_t i = 0; i < primitive.index_count; ++i)
        hull.add(world.vertices[world.indices[primitive.first_index + i] + std::size_t(primitive.vertex_offset)].position);
    return hull;
}

/// A stretch of time without a jump, in which a speed is even or changes little.
struct Stretch {
    double begin_s, end_s;
};

/// The stretches of time to test for a joint's own and its parents' tracks, at most `most`.
std::vector<Stretch> stretches(const World& world, int index, std::size_t most)
{
    std::vector<Stretch> all;
    int tracks = 0;
    for (int j = index; j >= 0; j = world.joints[std::size_t(j)].above) {
        const Joint& joint = world.joints[std::size_t(j)];
        tracks += (joint.translations >= 0) + (joint.rotations >= 0) + (joint.scales >= 0) + joint.spin.has_value();
    }
    const int rounds = tracks > 1 ? 8 : 1; // several periods, because other tracks then have other phases
    for (int j = index; j >= 0; j = world.joints[std::size_t(j)].above) {
        const Joint& joint = world.joints[std::size_t(j)];
        auto split = [&](double begin, double end, int parts) {
            for (int i = 0; i < parts; ++i)
                all.push_back({begin + (end - begin) * i / parts, begin + (end - begin) * (i + 1) / parts});
        };
        for (int which : {joint.translations, joint.rotations, joint.scales})
            if (which >= 0) {
                const Track& track = world.tracks[std::size_t(which)];
                for (int round = 0; round < rounds && track.interpolation != Interpolation::step; ++round)
                    for (std::size_t i = 0; i + 1 < track.times_s.size(); ++i)
                        split(round * track.length_s + track.times_s[i], round * track.length_s + track.times_s[i + 1], 16);
            }
        if (joint.spin && joint.spin->turns_per_s != 0)
            split(0, rounds / std::abs(joint.spin->turns_per_s), 32 * rounds);
    }
    if (all.size() > most) {
        std::vector<Stretch> some;
        for (std::size_t i = 0; i < most; ++i)
            some.push_back(all[i * all.size() / most]);
        return some;
    }
    return all;
}

bool jumps_within(const World& world, int index, const Stretch& stretch)
{
    const double middle = 0.5 * (stretch.begin_s + stretch.end_s), edge = 1e-9 * (stretch.end_s - stretch.begin_s);
    for (int j = index; j >= 0; j = world.joints[std::size_t(j)].above)
        for (int track : {world.joints[std::size_t(j)].translations, world.joints[std::size_t(j)].rotations,
                 world.joints[std::size_t(j)].scales})
            if (track >= 0) {
                const Unbroken own = unbroken(world.tracks[std::size_t(track)], middle);
                if (own.begin_s > stretch.begin_s + edge || own.end_s < stretch.end_s - edge)
                    return true;
            }
    return false;
}

} // namespace

std::optional<FastestMotion> fastest_motion(const World& world)
{
    std::map<std::uint32_t, Hull> of_primitive;
    std::map<int, Hull> of_joint;
    for (const Instance& instance : world.instances) {
        if (instance.motion < 0)
            continue;
        auto [known, is_new] = of_primitive.try_emplace(instance.primitive);
        if (is_new)
            known->second = hull_of(world, world.primitives[instance.primitive]);
        const Motion& motion = world.motions[std::size_t(instance.motion)];
        for (const glm::dvec3& point : known->second.points())
            of_joint[motion.joint].add(glm::dvec3(motion.joint_from_local * glm::dvec4(point, 1)));
    }
    const std::size_t most = std::clamp<std::size_t>(1'000'000 / std::max<std::size_t>(of_joint.size(), 1), 256, 8192);
    std::optional<FastestMotion> fastest;
    for (const auto& [joint, hull] : of_joint)
        for (Stretch stretch : stretches(world, joint, most)) {
            if (jumps_within(world, joint, stretch))
                continue;
            // The ends, moved inwards, belong to this stretch, whatever precedes and follows.
            const double edge = 1e-6 * (stretch.end_s - stretch.begin_s);
            stretch = {stretch.begin_s + edge, stretch.end_s - edge};
            const glm::dmat4 before = pose(world, joint, stretch.begin_s), after = pose(world, joint, stretch.end_s);
            for (const glm::dvec3& point : hull.points()) {
                const double way = glm::length(glm::dvec3((after - before) * glm::dvec4(point, 1)));
                const double speed = way / (stretch.end_s - stretch.begin_s);
                if (!fastest || speed > fastest->per_s)
                    fastest = {speed, world.joints[std::size_t(joint)].node, stretch.begin_s};
            }
        }
    return fastest;
}

void check_speeds(const World& world, const SceneFile& scene)
{
    const std::optional<FastestMotion> fastest = fastest_motion(world);
    const double speed = fastest ? fastest->per_s * scene.seconds_per_time_unit() : 0;
    if (speed <= most_own_speed * (1 + 1e-6))
        return;
    char text[500];
    std::snprintf(text, sizeof text,
        "(\"%.60s\") moves at %.3g of the scene's speed of light where it is fastest, %.3g s after its own time 0; at most "
        "%.3g "
        "is right, by a slower animation, or by a smaller \"unit_m\" or a larger \"light_speed_m_s\" in the scene",
        world.nodes[std::size_t(fastest->node)].name.c_str(), speed, fastest->own_s, most_own_speed);
    throw InputError(scene.gltf.string(), "/nodes/" + std::to_string(fastest->node), text);
}

} // namespace starbow
