#include "guard.h"
#include <algorithm>
#include <set>

namespace starbow {
namespace {

struct Use {
    const Spot& root;
    const Json& accessors;
    GuardedGltf& out;
    std::size_t& keys_left;

    const Json& accessor(const Spot& spot) const
    {
        return accessors[std::size_t(index_into(spot, "accessor", accessors.size()))];
    }
};

void guard_input(const Spot& spot, const Use& use)
{
    const Json& input = use.accessor(spot);
    if (input["type"] != "SCALAR" || input["componentType"] != float_type)
        spot.fail("names accessor " + spot.json.dump() + " of type " + input["type"].get<std::string>()
            + " and component type " + input["componentType"].dump() + "; times should be SCALAR and 5126");
    const auto count = input["count"].get<std::size_t>();
    if (count > use.keys_left)
        spot.fail("brings the animations above " + std::to_string(GltfLimits::keys) + " keys; use fewer");
    use.keys_left -= count;
}

/// Checks a sampler's output by the specification's table: the type of a property's values and their number.
void guard_output(const Spot& sampler, const std::string& path, const Use& use)
{
    const Spot spot = sampler["output"];
    const Json& output = use.accessor(spot);
    const auto component = output["componentType"].get<int>();
    const bool integer
        = component == byte_type || component == ubyte_type || component == short_type || component == ushort_type;
    const bool rotation = path == "rotation";
    if (output["type"] != (rotation ? "VEC4" : "VEC3")
        || !(component == float_type || (rotation && integer && output.value("normalized", false))))
        spot.fail("names accessor " + spot.json.dump() + " of type " + output["type"].get<std::string>()
            + " and component type " + std::to_string(component) + "; a " + path + " should be "
            + (rotation ? "VEC4 of 5126 or of normalized integers" : "VEC3 and 5126"));
    const bool cubic = sampler.has("interpolation") && sampler.json["interpolation"] == "CUBICSPLINE";
    const auto times = use.accessor(sampler["input"])["count"].get<std::size_t>();
    const auto values = output["count"].get<std::size_t>(), right = cubic ? 3 * times : times;
    if (values != right)
        spot.fail("has " + std::to_string(values) + " values for " + std::to_string(times) + " times; "
            + std::to_string(right) + " is right");
    if (cubic && times < 2)
        spot.fail("has one key; a cubic spline should have two or more");
}

void guard_sampler(const Spot& sampler, Json& written, const Use& use)
{
    guard_input(object(sampler)["input"], use);
    use.accessor(sampler["output"]);
    written = {{"input", sampler.json["input"].get<std::size_t>()}, {"output", sampler.json["output"].get<std::size_t>()}};
    if (!sampler.has("interpolation"))
        return;
    const std::string name = text(sampler["interpolation"]);
    if (name != "STEP" && name != "LINEAR" && name != "CUBICSPLINE")
        sampler["interpolation"].fail("is " + in_quotes(name) + "; should be \"STEP\", \"LINEAR\" or \"CUBICSPLINE\"");
    written["interpolation"] = name;
}

/// Returns false for a channel that Starbow does not read.
bool guard_channel(const Spot& channel, const Spot& samplers, Json& written, const Use& use)
{
    const auto sampler = std::size_t(index_into(object(channel)["sampler"], "sampler", samplers.size()));
    const Spot target = channel["target"];
    const std::string path = text(object(target)["path"]);
    if (path == "weights" || path == "pointer") {
        note_once(use.out.notes,
            "animations of " + std::string(path == "weights" ? "morph targets" : "other things than nodes")
                + " are not supported");
        return false;
    }
    if (path != "translation" && path != "rotation" && path != "scale")
        target["path"].fail("is " + in_quotes(path) + "; should be \"translation\", \"rotation\", \"scale\" or \"weights\"");
    guard_output(samplers[sampler], path, use);
    if (!target.has("node"))
        return false; // required by the specification
    const auto node = std::size_t(index_into(target["node"], "node", count_of(use.root, "nodes")));
    if (use.out.json["nodes"][node].contains("matrix"))
        target["node"].fail("names node " + std::to_string(node)
            + ", which has a matrix; what is animated should have translation, rotation and scale");
    written = {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
    return true;
}

} // namespace

void guard_animations(const Spot& root, GuardedGltf& out)
{
    if (count_of(root, "animations") == 0)
        return;
    const Json none = Json::array();
    std::size_t keys_left = GltfLimits::keys;
    const Use use{root, out.json.contains("accessors") ? out.json["accessors"] : none, out, keys_left};
    Json written = Json::array();
    const Spot all = root["animations"];
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Spot animation = all[i];
        const Spot samplers = object(animation)["samplers"], channels = animation["channels"];
        Json one = {{"samplers", Json::array()}, {"channels", Json::array()}};
        list(samplers), list(channels);
        for (std::size_t k = 0; k < samplers.size(); ++k)
            guard_sampler(samplers[k], one["samplers"].emplace_back(), use);
        std::set<std::pair<std::size_t, std::string>> targets;
        for (std::size_t k = 0; k < channels.size(); ++k) {
            Json channel;
            if (!guard_channel(channels[k], samplers, channel, use))
                continue;
            const Json& target = channel["target"];
            if (!targets.emplace(target["node"].get<std::size_t>(), target["path"].get<std::string>()).second)
                channels[k]["target"].fail("names the " + target["path"].get<std::string>() + " of node "
                    + target["node"].dump() + " again; each should be named once in an animation");
            one["channels"].push_back(std::move(channel));
        }
        if (!one["channels"].empty())
            written.push_back(std::move(one));
    }
    if (!written.empty())
        out.json["animations"] = std::move(written);
}

} // namespace starbow
