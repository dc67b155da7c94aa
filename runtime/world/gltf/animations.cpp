#include "accessor.h"
#include "parts.h"
#include "runtime/world/moving.h"
#include <algorithm>

namespace starbow {
namespace {

void read_times(WorldBuild& build, int accessor, std::vector<double>& times)
{
    const Elements from = open(build, accessor);
    auto fail = [&](std::size_t i, double value, const std::string& problem) {
        build.fail("/accessors/" + std::to_string(accessor),
            "element " + std::to_string(i) + " is " + Json(value).dump() + "; " + problem);
    };
    for (std::size_t i = 0; i < from.count; ++i) {
        const double time = from.component(i, 0);
        if (!(time >= 0 && time <= 1e9))
            fail(i, time, "a key's time should be 0 to 1e9 seconds");
        if (!times.empty() && !(time > times.back()))
            fail(i, time, "times should rise");
        times.push_back(time);
    }
}

void read_values(WorldBuild& build, int accessor, Track& track)
{
    const Elements from = open(build, accessor);
    for (std::size_t i = 0; i < from.count; ++i) {
        glm::dvec4 value(0);
        for (int c = 0; c < from.components; ++c)
            value[c] = from.component(i, c);
        auto fail = [&](const char* problem) {
            build.fail("/accessors/" + std::to_string(accessor), "element " + std::to_string(i) + " " + problem);
        };
        if (!(glm::length(value) < too_far))
            fail("is not finite or above 1e30; should be smaller");
        if (track.rotation && (track.interpolation != Interpolation::cubic || i % 3 == 1)) {
            if (std::abs(glm::length(value) - 1) > 0.01)
                fail("is not a rotation; should be a unit quaternion");
            value = glm::normalize(value);
        }
        track.values.push_back(value);
    }
}

/// The greatest value of a track, measured by `size`.
template <class Size> double bound(const Track& track, Size size)
{
    double most = 0, step = 0;
    for (std::size_t i = 1; i < track.times_s.size(); ++i)
        step = std::max(step, track.times_s[i] - track.times_s[i - 1]);
    for (const glm::dvec4& value : track.values)
        most = std::max(most, size(value));
    return track.interpolation == Interpolation::cubic ? most * (2 + step) : most;
}

double far_off(const glm::dvec4& place) { return glm::length(place); }
double largest(const glm::dvec4& scale) { return std::max({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)}); }

/// Adds the tracks of a node's morph targets, four in each.
void add_weights(WorldBuild& build, NodeTracks& to, const Track& times, int accessor)
{
    const Elements from = open(build, accessor);
    const std::size_t values = times.times_s.size() * (times.interpolation == Interpolation::cubic ? 3 : 1);
    const std::size_t targets = from.count / values;
    for (std::size_t first = 0; first < targets; first += 4) {
        Track track = times;
        for (std::size_t i = 0; i < values; ++i) {
            glm::dvec4 value(0);
            for (std::size_t k = first; k < std::min(first + 4, targets); ++k) {
                value[int(k - first)] = from.component(i * targets + k, 0);
                if (!(std::abs(value[int(k - first)]) <= 1e6))
                    build.fail("/accessors/" + std::to_string(accessor),
                        "element " + std::to_string(i * targets + k) + " is not finite or above 1e6; should be smaller");
            }
            track.values.push_back(value);
        }
        for (std::size_t k = first; k < std::min(first + 4, targets); ++k)
            to.greatest_weights.push_back(
                bound(track, [&](const glm::dvec4& value) { return std::abs(value[int(k - first)]); }));
        to.weights.push_back(int(build.world.tracks.size()));
        build.world.tracks.push_back(std::move(track));
    }
}

} // namespace

void add_tracks(WorldBuild& build)
{
    World& world = build.world;
    for (const auto& animation : build.model.animations) {
        double length_s = 0;
        const std::size_t first = world.tracks.size();
        for (const auto& channel : animation.channels) {
            NodeTracks& of_node = build.node_tracks[channel.target_node];
            const bool weights = channel.target_path == "weights";
            int known_weights = of_node.weights.empty() ? -1 : of_node.weights.front();
            int& which = weights                       ? known_weights
                : channel.target_path == "translation" ? of_node.translations
                : channel.target_path == "rotation"    ? of_node.rotations
                                                       : of_node.scales;
            if (which >= 0) {
                note_once(world.notes, "nodes that several animations move: the first counts");
                continue;
            }
            const auto& sampler = animation.samplers[std::size_t(channel.sampler)];
            Track track;
            track.rotation = channel.target_path == "rotation";
            track.interpolation = sampler.interpolation == "STEP" ? Interpolation::step
                : sampler.interpolation == "CUBICSPLINE"          ? Interpolation::cubic
                                                                  : Interpolation::linear;
            read_times(build, sampler.input, track.times_s);
            length_s = std::max(length_s, track.times_s.back());
            if (weights) {
                add_weights(build, of_node, track, sampler.output);
                continue;
            }
            read_values(build, sampler.output, track);
            which = int(world.tracks.size());
            world.tracks.push_back(std::move(track));
        }
        for (std::size_t i = first; i < world.tracks.size(); ++i)
            world.tracks[i].length_s = length_s;
    }
}

int add_joint(WorldBuild& build, int node, int above, const glm::dmat4& above_from_parent)
{
    World& world = build.world;
    const auto& from = build.model.nodes[std::size_t(node)];
    const std::string place = "/nodes/" + std::to_string(node);
    Joint joint{node, above, above_from_parent};
    const auto tracks = build.node_tracks.find(node);
    if (tracks != build.node_tracks.end())
        joint.translations = tracks->second.translations, joint.rotations = tracks->second.rotations,
        joint.scales = tracks->second.scales;
    joint.spin = build.file.spins[std::size_t(node)];
    if (from.matrix.size() == 16)
        joint.above_from_parent = joint.above_from_parent * local_transform(from);
    else {
        for (int i = 0; i < 3; ++i) {
            joint.translation[i] = from.translation.size() == 3 ? from.translation[std::size_t(i)] : 0;
            joint.scale[i] = from.scale.size() == 3 ? from.scale[std::size_t(i)] : 1;
        }
        if (from.rotation.size() == 4)
            joint.rotation = glm::dquat(from.rotation[3], from.rotation[0], from.rotation[1], from.rotation[2]);
    }
    // The greatest stretch and distance at any time, including all joints above.
    const JointBounds up = above < 0 ? JointBounds{} : build.bounds[std::size_t(above)];
    auto bounded = [&](int track, const glm::dvec3& rest, auto size) {
        return track < 0 ? size(glm::dvec4(rest, 0)) : bound(world.tracks[std::size_t(track)], size);
    };
    const double across = greatest_stretch(glm::dmat3(joint.above_from_parent));
    JointBounds own;
    own.scale = up.scale * across * bounded(joint.scales, joint.scale, largest);
    own.place = up.place
        + up.scale
            * (glm::length(joint.above_from_parent[3]) + across * bounded(joint.translations, joint.translation, far_off));
    own.depth = up.depth + 1;
    if (!(own.scale < too_far && own.place < too_far))
        build.fail(place, "with its animation and its parents' transforms may lead beyond 1e30; should stay below");
    if (own.depth > GltfLimits::joints_deep)
        build.fail(place,
            "moves below more than " + std::to_string(GltfLimits::joints_deep)
                + " nodes that move; use fewer, one below another");
    build.bounds.push_back(own);
    world.joints.push_back(joint);
    return int(world.joints.size()) - 1;
}

} // namespace starbow
