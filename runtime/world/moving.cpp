#include "moving.h"
#include "config/model/angles.h"
#include "shape.h"
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace starbow {
namespace {

constexpr double tiny = 2.2e-16;

} // namespace

double zero_of(const World& world, const Instance& instance)
{
    return instance.existence < 0 ? 0 : world.existence_intervals[std::size_t(instance.existence)].zero;
}

glm::dmat4 joint_pose(const World& world, int index, const glm::dmat4& above, double own_s)
{
    const Joint& joint = world.joints[std::size_t(index)];
    glm::dmat4 m = above * joint.above_from_parent;
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

double greatest_stretch(const glm::dmat3& m)
{
    const glm::dvec3 lengths(glm::length(m[0]), glm::length(m[1]), glm::length(m[2]));
    const double longest = std::max({lengths.x, lengths.y, lengths.z});
    const double skew = std::abs(glm::dot(m[0], m[1])) + std::abs(glm::dot(m[1], m[2])) + std::abs(glm::dot(m[2], m[0]));
    return skew < 1e-9 * longest * longest ? longest : glm::length(lengths); // the root of the sum of squares bounds it
}

namespace {

glm::dmat4 pose(const World& world, int joint, double own_s)
{
    const int above = world.joints[std::size_t(joint)].above;
    return joint_pose(world, joint, above < 0 ? glm::dmat4(1) : pose(world, above, own_s), own_s);
}

/// The greatest distance of a deforming instance's vertices from its middle, at a time of its frame.
double around_deforming(const World& world, const Instance& instance, double time)
{
    const Deformation& deformation = world.deformations[std::size_t(instance.deformation)];
    Shape shape(world, instance, time);
    const glm::dvec4 middle(middle_of(world, instance), 1);
    const glm::dvec3 at(shape.bone(std::size_t(deformation.middle)) * middle);
    double most = 0;
    for (std::size_t i = 0; i < deformation.bones.size(); ++i) {
        const Bone& bone = deformation.bones[i];
        const glm::dmat4& m = shape.bone(i);
        most = std::max(most,
            glm::distance(glm::dvec3(m * glm::dvec4(bone.centre, 1)), at) + greatest_stretch(glm::dmat3(m)) * bone.radius);
    }
    return most;
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
    glm::dmat4 m = motion.joint < 0 ? motion.joint_from_local : pose(world, motion.joint, own_s) * motion.joint_from_local;
    m[3] += glm::dvec4(motion.place, 0);
    return m;
}

double longest(const World& world, int index)
{
    double longest_s = 0;
    for (; index >= 0; index = world.joints[std::size_t(index)].above) {
        const Joint& joint = world.joints[std::size_t(index)];
        each_track(joint, [&](int track) { longest_s = std::max(longest_s, world.tracks[std::size_t(track)].length_s); });
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

glm::dvec3 middle_of(const World& world, const Instance& instance)
{
    if (instance.deformation >= 0) {
        const Deformation& deformation = world.deformations[std::size_t(instance.deformation)];
        return deformation.bones[std::size_t(deformation.middle)].centre;
    }
    const Primitive& primitive = world.primitives[instance.primitive];
    return 0.5 * (primitive.low + primitive.high);
}

SeenPose seen_pose(const World& world, const Instance& instance, const EyeEvent& eye_event)
{
    const glm::dvec4 middle(middle_of(world, instance), 1);
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
    const double reach = instance.deformation >= 0 ? around_deforming(world, instance, time)
                                                   : around(world.primitives[instance.primitive], seen.frame_from_local);
    seen.window = reach / (1 - most_own_speed);
    return seen;
}

std::array<double, POSES> pose_times(const World& world, const Instance& instance, const SeenPose& seen)
{
    const double zero = zero_of(world, instance), unit_s = world.seconds_per_time_unit;
    const double own_s = (seen.sent - zero) * unit_s;
    double begin = -1e300, end = 1e300, key = 1e300;
    const auto offer = [&](int which) {
        const Track& track = world.tracks[std::size_t(which)];
        const Unbroken own = unbroken(track, own_s);
        begin = std::max(begin, own.begin_s), end = std::min(end, own.end_s);
        const double near = nearest_key(track, own_s);
        key = std::abs(near - own_s) < std::abs(key - own_s) ? near : key;
    };
    if (instance.deformation >= 0) {
        const Deformation& deformation = world.deformations[std::size_t(instance.deformation)];
        for (int joint : deformation.joints)
            each_track(world.joints[std::size_t(joint)], offer);
        for (int track : deformation.weights)
            offer(track);
    } else
        for (int joint = world.motions[std::size_t(instance.motion)].joint; joint >= 0;
             joint = world.joints[std::size_t(joint)].above)
            each_track(world.joints[std::size_t(joint)], offer);
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
        times[std::size_t(half) + std::size_t(i)] = middle + (last - middle) * i / half;
    }
    return times;
}

} // namespace starbow
