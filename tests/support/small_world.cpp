#include "small_world.h"
#include "runtime/world/detail.h"

namespace starbow::gpu_test {

int unlit(Doc& doc, const dvec3& colour)
{
    doc.json["extensionsUsed"] = {"KHR_materials_unlit"};
    return doc.put("materials",
        {{"pbrMetallicRoughness", {{"baseColorFactor", {colour.r, colour.g, colour.b, 1}}}},
            {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
}

void quad(Doc& doc, const dvec3& centre, const dvec3& right, const dvec3& up, int material, Json node)
{
    std::vector<float> positions;
    for (const dvec3& corner : {centre - right - up, centre + right - up, centre + right + up, centre - right + up})
        positions.insert(positions.end(), {float(corner.x), float(corner.y), float(corner.z)});
    const std::vector<float> uv = {0, 1, 1, 1, 1, 0, 0, 0};
    const std::vector<std::uint16_t> indices = {0, 1, 2, 0, 2, 3};
    Json primitive
        = {{"attributes", {{"POSITION", doc.accessor(positions, "VEC3")}, {"TEXCOORD_0", doc.accessor(uv, "VEC2")}}},
            {"indices", doc.accessor(indices, "SCALAR")}, {"material", material}};
    node["mesh"] = doc.put("meshes", {{"primitives", {primitive}}});
    doc.json["scenes"][0]["nodes"].push_back(doc.put("nodes", node));
}

GpuWorld open_world(const std::string& name, const Doc& doc, Json scene)
{
    testing::write_text(name + ".gltf", doc.text());
    scene["gltf"] = name + ".gltf";
    scene["unit_m"] = 1;
    const SceneFile file = load_scene_file(testing::write_text(name + ".json", scene.dump()));
    World world = load_world(file);
    add_detail_levels(world);
    return upload(
        device(), pipelines(), std::move(world), file, file.stars ? stars_in_depth(*file.stars) : std::vector<Star>());
}

const Json smooth_sky = {{"zenith", {0.25, 0.45, 0.80}}, {"horizon", {0.70, 0.60, 0.40}}, {"nadir", {0.30, 0.20, 0.55}}};

dvec3 sky_colour(const dvec3& n, const Json& sky)
{
    auto colour = [&](const char* at) {
        const Json& c = sky.at(at);
        return dvec3(c.at(0), c.at(1), c.at(2));
    };
    const double h = std::min(std::abs(n.y), 1.0), blend = h * h * (3 - 2 * h);
    return glm::mix(colour("horizon"), colour(n.y > 0 ? "zenith" : "nadir"), blend);
}

} // namespace starbow::gpu_test
