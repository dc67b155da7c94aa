#include "guard.h"
#include <algorithm>
#include <array>

namespace starbow {
namespace {

/// Limit of a member given as text, which some editors write because they keep nothing else with a material.
constexpr std::size_t most_text = std::size_t(1) << 20;

/// Pairs of a wavelength in nm, rising, and a value from 0 to `most`.
std::vector<std::pair<double, double>> points(const JsonSpot& spot, double most)
{
    if (!spot.json.is_array() || spot.size() < least_points || spot.size() > most_points)
        spot.fail((spot.json.is_array() ? "is a list of " + std::to_string(spot.size()) : std::string("is not a list"))
            + "; should be a list of " + std::to_string(least_points) + " to " + std::to_string(most_points)
            + " pairs [wavelength in nm, value]");
    std::vector<std::pair<double, double>> out;
    for (std::size_t i = 0; i < spot.size(); ++i) {
        const JsonSpot pair = spot[i];
        if (!pair.json.is_array() || pair.size() != 2)
            pair.fail("should be a pair [wavelength in nm, value]");
        const double nm = number(pair[0], shortest_nm, longest_nm);
        if (!out.empty() && !(nm > out.back().first))
            pair[0].fail(
                "is " + pair.json[0].dump() + "; should be above the wavelength before, " + Json(out.back().first).dump());
        out.emplace_back(nm, number(pair[1], 0, most));
    }
    return out;
}

Emission read(const JsonSpot& spot, const BlackBody*) { return BlackBody{number(spot, coldest_K, hottest_K)}; }
Emission read(const JsonSpot& spot, const SpectralLine*) { return SpectralLine{number(spot, shortest_nm, longest_nm)}; }
Emission read(const JsonSpot& spot, const SpectralTable*)
{
    SpectralTable table{points(spot, 1e30)};
    if (std::ranges::all_of(table.points, [](const auto& point) { return point.second == 0; }))
        spot.fail("is 0 everywhere; should have a value above 0");
    return table;
}

/// One of the kinds of spectrum, by the name of its one member.
template <class... Kinds> Emission emission(const JsonSpot& spot, const std::variant<Kinds...>*)
{
    reject_unknown_members(spot, {Kinds::gltf_member...});
    if (spot.size() != 1) {
        std::string names;
        for (const char* name : {Kinds::gltf_member...})
            names.append(names.empty() ? "\"" : ", \"").append(name).append("\"");
        spot.fail("has " + std::to_string(spot.size()) + " members; should have one of " + names);
    }
    Emission found;
    const auto try_one = [&]<class Kind>(const Kind* kind) {
        if (spot.has(Kind::gltf_member))
            found = read(spot[Kind::gltf_member], kind);
    };
    (try_one(static_cast<const Kinds*>(nullptr)), ...);
    return found;
}

/// Throws if the material can't emit. material: the accepted members of the surface's material.
void check_emits(const JsonSpot& spot, const tinygltf::Material& material)
{
    if (material.extensions.contains("KHR_materials_unlit"))
        spot.fail("stands beside KHR_materials_unlit, which leaves emission out; should stand without it");
    double most = 0;
    for (double part : material.emissiveFactor)
        most = std::max(most, part);
    const auto strength = material.extensions.find("KHR_materials_emissive_strength");
    if (strength != material.extensions.end())
        most *= strength->second.Get("emissiveStrength").GetNumberAsDouble();
    if (!(most > 0))
        spot.fail("would emit nothing, for the material's emissiveFactor is black; should stand beside one above 0");
}

WorldClock clock(const JsonSpot& spot)
{
    reject_unknown_members(spot, {"zero_s"});
    // A clock's figures have no room for more than 1e10.
    return {spot.has("zero_s") ? number(spot["zero_s"], -1e10, 1e10) : 0};
}

Blink blink(const JsonSpot& spot)
{
    reject_unknown_members(spot, {"period_s", "on", "zero_s"});
    if (!spot.has("period_s"))
        spot.fail("has no \"period_s\"; should say how many seconds a period lasts");
    Blink out{number(spot["period_s"], 1e-9, 1e10)};
    if (spot.has("on"))
        out.on = number(spot["on"], 0, 1);
    if (spot.has("zero_s"))
        out.zero_s = number(spot["zero_s"], -1e10, 1e10);
    return out;
}

void read_surface(const JsonSpot& spot, const tinygltf::Material& material, Material& out)
{
    reject_unknown_members(
        spot, {"ultraviolet", "infrared", "reflectance", "temperature_K", "emissivity", "emission", "clock", "blink"});
    if (spot.has("ultraviolet"))
        out.ultraviolet = number(spot["ultraviolet"], 0, 1);
    if (spot.has("infrared"))
        out.infrared = number(spot["infrared"], 0, 1);
    if (spot.has("reflectance"))
        out.reflectance = points(spot["reflectance"], 1);
    if (spot.has("temperature_K")) {
        out.temperature_K = number(spot["temperature_K"], coldest_K, hottest_K);
        out.emissivity = spot.has("emissivity") ? number(spot["emissivity"], 0, 1) : 0.9;
    } else if (spot.has("emissivity"))
        spot["emissivity"].fail(
            "says how well the surface glows but not how warm it is; should stand beside \"temperature_K\"");
    if (spot.has("emission")) {
        out.emission = emission(spot["emission"], static_cast<const Emission*>(nullptr));
        check_emits(spot["emission"], material);
    }
    if (spot.has("clock"))
        out.clock = clock(spot["clock"]);
    if (spot.has("blink")) {
        out.blink = blink(spot["blink"]);
        check_emits(spot["blink"], material);
    }
}

} // namespace

void read_extras(const JsonSpot& owner, const std::function<void(const JsonSpot&)>& read)
{
    // Other applications' extras may have any content.
    if (!owner.has("extras") || !owner.json["extras"].is_object() || !owner["extras"].has("starbow"))
        return;
    const JsonSpot spot = owner["extras"]["starbow"];
    if (!spot.json.is_string()) {
        read(spot);
        return;
    }
    const std::string& text = spot.json.get_ref<const std::string&>();
    if (text.size() > most_text)
        spot.fail(
            "is a text of " + std::to_string(text.size()) + " bytes; at most " + std::to_string(most_text) + " are allowed");
    const Json parsed = Json::parse(text, nullptr, false);
    if (parsed.is_discarded())
        spot.fail("is " + in_quotes(text) + ", which is not JSON; should be an object in { } or such an object as a text");
    read({parsed, spot.at, spot.file});
}

Material guard_surface(const JsonSpot& material, const tinygltf::Material& written)
{
    Material out;
    read_extras(material, [&](const JsonSpot& spot) { read_surface(spot, written, out); });
    return out;
}

} // namespace starbow
