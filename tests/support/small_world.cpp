#include "small_world.h"
#include "runtime/shadow/add_shadows.h"
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

int blobs(Doc& doc, const std::vector<std::pair<dvec3, dvec3>>& places_and_colours, double radius)
{
    std::vector<float> positions, colours;
    std::vector<std::uint16_t> indices;
    for (const auto& [place, colour] : places_and_colours) {
        const auto first = std::uint16_t(positions.size() / 3);
        for (const dvec3& way :
            {dvec3(1, 0, 0), dvec3(-1, 0, 0), dvec3(0, 1, 0), dvec3(0, -1, 0), dvec3(0, 0, 1), dvec3(0, 0, -1)})
            for (int c = 0; c < 3; ++c)
                positions.push_back(float(place[c] + radius * way[c])), colours.push_back(float(colour[c]));
        for (int x : {0, 1})
            for (int y : {2, 3})
                for (int z : {4, 5})
                    for (int corner : {x, y, z})
                        indices.push_back(std::uint16_t(first + corner));
    }
    const int material = unlit(doc, {1, 1, 1});
    doc.json["materials"][std::size_t(material)]["doubleSided"] = true;
    return doc.put("meshes",
        {{"primitives",
            {{{"attributes", {{"POSITION", doc.accessor(positions, "VEC3")}, {"COLOR_0", doc.accessor(colours, "VEC3")}}},
                {"indices", doc.accessor(indices, "SCALAR")}, {"material", material}}}}});
}

dvec3 direction_of(const Numbers& numbers, int colour)
{
    dvec3 sum(0);
    for (int i = 0; i < numbers.count(); ++i)
        sum += double(numbers.light(i)[colour]) * numbers.camera(i);
    return glm::normalize(sum);
}

Json numbers_of(const dvec3& v) { return {v.x, v.y, v.z}; }

Json velocity_of(const dvec3& u) { return {{"direction", numbers_of(u)}, {"rapidity", std::asinh(glm::length(u))}}; }

GpuWorld open_world(const std::string& name, const Doc& doc, Json scene)
{
    testing::write_text(name + ".gltf", doc.text());
    scene["gltf"] = name + ".gltf";
    scene.emplace("unit_m", 1);
    const SceneFile file = load_scene_file(testing::write_text(name + ".json", scene.dump()));
    World world = load_world(file);
    add_detail_levels(world);
    add_shadows(world, file);
    return upload(
        device(), pipelines(), std::move(world), file, file.stars ? stars_in_depth(*file.stars) : std::vector<Star>());
}

GpuWorld shaded_world(const std::string& name, const Doc& doc, Json scene)
{
    scene["unit_m"] = 299792458;
    scene["shadows"] = true;
    return open_world(name, doc, std::move(scene));
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
