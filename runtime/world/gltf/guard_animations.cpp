#include "guard.h"
#include <algorithm>
#include <set>

namespace starbow {
namespace {

struct Use {
    const JsonSpot& root;
    GuardedGltf& out;
    std::size_t& keys_left;

    const tinygltf::Accessor& accessor(const JsonSpot& spot) const
    {
        const auto& accessors = out.model.accessors;
        return accessors[std::size_t(index_into(spot, "accessor", accessors.size()))];
    }
};

void guard_input(const JsonSpot& spot, const Use& use)
{
    const tinygltf::Accessor& input = use.accessor(spot);
    if (input.type != TINYGLTF_TYPE_SCALAR || input.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        spot.fail("names accessor " + spot.json.dump() + " of type " + type_name(input) + " and component type "
            + std::to_string(input.componentType) + "; times should be SCALAR and 5126");
    if (input.count > use.keys_left)
        spot.fail("brings the animations above " + std::to_string(GltfLimits::keys) + " keys; use fewer");
    use.keys_left -= input.count;
}

/// The number of values that a key of a node's morph targets has; 0 without targets.
std::size_t targets_of(const tinygltf::Model& model, const tinygltf::Node& node)
{
    std::size_t most = 0;
    if (node.mesh >= 0)
        for (const tinygltf::Primitive& primitive : model.meshes[std::size_t(node.mesh)].primitives)
            most = std::max(most, primitive.targets.size());
    return most;
}

/// Checks the number of a sampler's values. each: values that a key has. counted: the name of keys in a complaint.
void guard_number(const JsonSpot& sampler, std::size_t each, const std::string& counted, const Use& use)
{
    const JsonSpot spot = sampler["output"];
    const bool cubic = sampler.has("interpolation") && sampler.json["interpolation"] == "CUBICSPLINE";
    const std::size_t times = use.accessor(sampler["input"]).count, values = use.accessor(spot).count;
    const std::size_t right = (cubic ? 3 : 1) * times * each;
    if (values != right)
        spot.fail("has " + std::to_string(values) + " values for " + std::to_string(times) + counted + "; "
            + std::to_string(right) + " is right");
    if (cubic && times < 2)
        spot.fail("has one key; a cubic spline should have two or more");
}

/// Checks the weights of a node's morph targets.
void guard_weights(const JsonSpot& sampler, std::size_t targets, const Use& use)
{
    const JsonSpot spot = sampler["output"];
    const tinygltf::Accessor& output = use.accessor(spot);
    if (output.type != TINYGLTF_TYPE_SCALAR || !(output.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT || output.normalized))
        spot.fail("names accessor " + spot.json.dump() + " of type " + type_name(output) + " and component type "
            + std::to_string(output.componentType) + "; weights should be SCALAR of 5126 or of normalized integers");
    guard_number(sampler, targets, " times and " + std::to_string(targets) + " targets", use);
}

/// Checks a sampler's output by the specification's table: the type of a property's values and their number.
void guard_output(const JsonSpot& sampler, const std::string& path, const Use& use)
{
    const JsonSpot spot = sampler["output"];
    const tinygltf::Accessor& output = use.accessor(spot);
    const int component = output.componentType;
    const bool integer = component == TINYGLTF_COMPONENT_TYPE_BYTE || component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE
        || component == TINYGLTF_COMPONENT_TYPE_SHORT || component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    const bool rotation = path == "rotation";
    if (output.type != (rotation ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3)
        || !(component == TINYGLTF_COMPONENT_TYPE_FLOAT || (rotation && integer && output.normalized)))
        spot.fail("names accessor " + spot.json.dump() + " of type " + type_name(output) + " and component type "
            + std::to_string(component) + "; a " + path + " should be "
            + (rotation ? "VEC4 of 5126 or of normalized integers" : "VEC3 and 5126"));
    guard_number(sampler, 1, " times", use);
}

void guard_sampler(const JsonSpot& sampler, tinygltf::AnimationSampler& written, const Use& use)
{
    guard_input(object(sampler)["input"], use);
    use.accessor(sampler["output"]);
    written.input = sampler.json["input"].get<int>();
    written.output = sampler.json["output"].get<int>();
    if (!sampler.has("interpolation"))
        return;
    const std::string name = text(sampler["interpolation"]);
    if (name != "STEP" && name != "LINEAR" && name != "CUBICSPLINE")
        sampler["interpolation"].fail("is " + in_quotes(name) + "; should be \"STEP\", \"LINEAR\" or \"CUBICSPLINE\"");
    written.interpolation = name;
}

/// Returns false for a channel that Starbow does not read.
bool guard_channel(const JsonSpot& channel, const JsonSpot& samplers, tinygltf::AnimationChannel& written, const Use& use)
{
    const auto sampler = std::size_t(index_into(object(channel)["sampler"], "sampler", samplers.size()));
    const JsonSpot target = channel["target"];
    const std::string path = text(object(target)["path"]);
    if (path == "pointer") {
        note_once(use.out.notes, "animations of other things than nodes are not supported");
        return false;
    }
    const bool weights = path == "weights";
    if (path != "translation" && path != "rotation" && path != "scale" && !weights)
        target["path"].fail("is " + in_quotes(path) + "; should be \"translation\", \"rotation\", \"scale\" or \"weights\"");
    if (!weights)
        guard_output(samplers[sampler], path, use);
    if (!target.has("node"))
        return false; // required by the specification
    const auto node = std::size_t(index_into(target["node"], "node", count_of(use.root, "nodes")));
    if (weights) {
        const std::size_t targets = targets_of(use.out.model, use.out.model.nodes[node]);
        if (targets == 0) {
            note_once(use.out.notes, "animated weights of nodes without morph targets change nothing");
            return false;
        }
        guard_weights(samplers[sampler], targets, use);
    } else if (!use.out.model.nodes[node].matrix.empty())
        target["node"].fail("names node " + std::to_string(node)
            + ", which has a matrix; what is animated should have translation, rotation and scale");
    written.sampler = int(sampler);
    written.target_node = int(node);
    written.target_path = path;
    return true;
}

} // namespace

void guard_animations(const JsonSpot& root, GuardedGltf& out)
{
    if (count_of(root, "animations") == 0)
        return;
    std::size_t keys_left = GltfLimits::keys;
    const Use use{root, out, keys_left};
    const JsonSpot all = root["animations"];
    for (std::size_t i = 0; i < all.size(); ++i) {
        const JsonSpot animation = all[i];
        const JsonSpot samplers = object(animation)["samplers"], channels = animation["channels"];
        tinygltf::Animation written;
        list(samplers), list(channels);
        for (std::size_t k = 0; k < samplers.size(); ++k)
            guard_sampler(samplers[k], written.samplers.emplace_back(), use);
        std::set<std::pair<int, std::string>> targets;
        for (std::size_t k = 0; k < channels.size(); ++k) {
            tinygltf::AnimationChannel channel;
            if (!guard_channel(channels[k], samplers, channel, use))
                continue;
            if (!targets.emplace(channel.target_node, channel.target_path).second)
                channels[k]["target"].fail("names the " + channel.target_path + " of node "
                    + std::to_string(channel.target_node) + " again; each should be named once in an animation");
            written.channels.push_back(std::move(channel));
        }
        if (!written.channels.empty())
            out.model.animations.push_back(std::move(written));
    }
}

} // namespace starbow
