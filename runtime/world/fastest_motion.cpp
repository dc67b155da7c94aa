#include "fastest_motion.h"
#include "config/json/error.h"
#include "moving.h"
#include "shape.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

namespace starbow {
namespace {

/// The furthest of many points in each of 26 directions: an approximate hull.
class Hull {
public:
    void add(const glm::dvec3& point, std::uint32_t vertex = 0)
    {
        std::size_t at = 0;
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z, ++at) {
                    const double reach = glm::dot(point, glm::dvec3(x, y, z));
                    if (empty_ || reach > reach_[at])
                        reach_[at] = reach, points_[at] = point, vertices_[at] = vertex;
                }
        empty_ = false;
    }
    const std::array<glm::dvec3, 27>& points() const { return points_; }
    const std::array<std::uint32_t, 27>& vertices() const { return vertices_; }

private:
    bool empty_ = true;
    std::array<double, 27> reach_{};
    std::array<glm::dvec3, 27> points_{};
    std::array<std::uint32_t, 27> vertices_{};
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

/// The tracks and spins that move one thing.
struct Movers {
    std::vector<int> joints; ///< their tracks and spins
    std::vector<int> weights; ///< tracks of morph targets
};

Movers chain(const World& world, int index)
{
    Movers movers;
    for (; index >= 0; index = world.joints[std::size_t(index)].above)
        movers.joints.push_back(index);
    return movers;
}

template <class Visit> void each_track_of(const World& world, const Movers& movers, Visit visit)
{
    for (int joint : movers.joints)
        each_track(world.joints[std::size_t(joint)], [&](int track) { visit(world.tracks[std::size_t(track)]); });
    for (int track : movers.weights)
        visit(world.tracks[std::size_t(track)]);
}

/// The stretches of time to test, at most `most`.
std::vector<Stretch> stretches(const World& world, const Movers& movers, std::size_t most)
{
    std::vector<Stretch> all;
    std::set<double> periods;
    std::set<std::pair<double, std::vector<double>>> grids; // periods and key times: many tracks have the same
    each_track_of(world, movers, [&](const Track& track) {
        periods.insert(track.length_s);
        if (track.interpolation != Interpolation::step)
            grids.emplace(track.length_s, track.times_s);
    });
    for (int index : movers.joints)
        if (const auto& spin = world.joints[std::size_t(index)].spin; spin && spin->turns_per_s != 0)
            periods.insert(1 / std::abs(spin->turns_per_s));
    const int rounds = periods.size() > 1 ? 8 : 1; // several periods, because other tracks then have other phases
    auto split = [&](double begin, double end, int parts) {
        for (int i = 0; i < parts; ++i)
            all.push_back({begin + (end - begin) * i / parts, begin + (end - begin) * (i + 1) / parts});
    };
    for (const auto& [length_s, times_s] : grids)
        for (int round = 0; round < rounds; ++round)
            for (std::size_t i = 0; i + 1 < times_s.size(); ++i)
                split(round * length_s + times_s[i], round * length_s + times_s[i + 1], 16);
    for (int index : movers.joints)
        if (const auto& spin = world.joints[std::size_t(index)].spin; spin && spin->turns_per_s != 0)
            split(0, rounds / std::abs(spin->turns_per_s), 32 * rounds);
    if (all.size() > most) {
        std::vector<Stretch> some;
        for (std::size_t i = 0; i < most; ++i)
            some.push_back(all[i * all.size() / most]);
        return some;
    }
    return all;
}

bool jumps_within(const World& world, const Movers& movers, const Stretch& stretch)
{
    const double middle = 0.5 * (stretch.begin_s + stretch.end_s), edge = 1e-9 * (stretch.end_s - stretch.begin_s);
    bool jumps = false;
    each_track_of(world, movers, [&](const Track& track) {
        const Unbroken own = unbroken(track, middle);
        jumps = jumps || own.begin_s > stretch.begin_s + edge || own.end_s < stretch.end_s - edge;
    });
    return jumps;
}

/// Some vertices of a deforming primitive: on each of its bones the furthest in 26 directions.
std::vector<std::uint32_t> outer_vertices(const World& world, const Primitive& primitive)
{
    std::map<int, Hull> hulls;
    for (std::uint32_t i = 0; i < primitive.index_count; ++i) {
        const std::uint32_t own = world.indices[primitive.first_index + i];
        const glm::vec4* row = &world.deforming[std::size_t(primitive.deforming) + DEFORMING_VERTEX_ROWS * std::size_t(own)];
        for (int k = 0; k < BONES_PER_VERTEX; ++k)
            if (row[WEIGHTS_ROW + k / 4][k % 4] > 0)
                hulls[int(row[BONES_ROW + k / 4][k % 4])].add(
                    glm::dvec3(row[0]), own + std::uint32_t(primitive.vertex_offset));
    }
    std::set<std::uint32_t> outer;
    for (const auto& [bone, hull] : hulls)
        outer.insert(hull.vertices().begin(), hull.vertices().end());
    return {outer.begin(), outer.end()};
}

/// Collects the fastest of all motions.
class Fastest {
public:
    /// Tests a moving thing. places: of points of it at its own time, always the same ones in the same order.
    template <class Places>
    void test(const World& world, const Movers& movers, int node, std::size_t most_stretches, Places places)
    {
        for (Stretch stretch : stretches(world, movers, most_stretches)) {
            if (jumps_within(world, movers, stretch))
                continue;
            // The ends, moved inwards, belong to this stretch, whatever precedes and follows.
            const double edge = 1e-6 * (stretch.end_s - stretch.begin_s);
            stretch = {stretch.begin_s + edge, stretch.end_s - edge};
            const std::vector<glm::dvec3> before = places(stretch.begin_s), after = places(stretch.end_s);
            for (std::size_t i = 0; i < before.size(); ++i) {
                const double speed = glm::distance(before[i], after[i]) / (stretch.end_s - stretch.begin_s);
                if (!found_ || speed > found_->per_s)
                    found_ = {speed, node, stretch.begin_s};
            }
        }
    }
    const std::optional<FastestMotion>& found() const { return found_; }

private:
    std::optional<FastestMotion> found_;
};

} // namespace

std::optional<FastestMotion> fastest_motion(const World& world)
{
    std::map<std::uint32_t, Hull> of_primitive;
    std::map<int, Hull> of_joint;
    std::map<std::uint32_t, const Instance*> deforming;
    for (const Instance& instance : world.instances) {
        if (instance.motion < 0)
            continue;
        if (instance.deformation >= 0) {
            deforming.emplace(instance.primitive, &instance);
            continue;
        }
        auto [known, is_new] = of_primitive.try_emplace(instance.primitive);
        if (is_new)
            known->second = hull_of(world, world.primitives[instance.primitive]);
        const Motion& motion = world.motions[std::size_t(instance.motion)];
        for (const glm::dvec3& point : known->second.points())
            of_joint[motion.joint].add(glm::dvec3(motion.joint_from_local * glm::dvec4(point, 1)));
    }
    const auto share = [](std::size_t all, std::size_t things, std::size_t least) {
        return std::clamp<std::size_t>(all / std::max<std::size_t>(things, 1), least, 8192);
    };
    Fastest fastest;
    for (const auto& [joint, hull] : of_joint)
        fastest.test(world, chain(world, joint), world.joints[std::size_t(joint)].node,
            share(1'000'000, of_joint.size(), 256), [&world, joint = joint, &points = hull.points()](double own_s) {
                const glm::dmat4 pose = pose_of(world, {joint}, own_s);
                std::vector<glm::dvec3> places;
                for (const glm::dvec3& point : points)
                    places.emplace_back(pose * glm::dvec4(point, 1));
                return places;
            });
    for (const auto& [index, instance] : deforming) {
        const Deformation& deformation = world.deformations[std::size_t(instance->deformation)];
        const std::vector<std::uint32_t> outer = outer_vertices(world, world.primitives[index]);
        fastest.test(world, {deformation.joints, deformation.weights}, instance->node,
            share(500'000 / (outer.size() + 1), deforming.size(), 32), [&world, &outer, &of = *instance](double own_s) {
                Shape shape(world, of, own_s / world.seconds_per_time_unit + zero_of(world, of));
                std::vector<glm::dvec3> places;
                for (std::uint32_t vertex : outer)
                    places.push_back(shape.vertex(vertex).place);
                return places;
            });
    }
    return fastest.found();
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
