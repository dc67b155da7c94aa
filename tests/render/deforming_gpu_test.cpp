// Skins and morph targets that move, in the picture: beside rigid animations, where light left them, and beside the
// reference.
#include "tests/support/beside_rays.h"
#include "tests/support/quad.h"
#include "tests/support/sphere.h"

namespace starbow::gpu_test::deforming_gpu_test {
namespace {

/// An accessor of matrices.
int matrices(Doc& doc, const std::vector<float>& all)
{
    const int index = doc.accessor(all, "SCALAR");
    doc.json["accessors"][std::size_t(index)]["type"] = "MAT4";
    doc.json["accessors"][std::size_t(index)]["count"] = all.size() / 16;
    return index;
}

/// A tube along y from 0 to `height`, of many rings. extras: adds attributes and targets to its primitive. Returns its mesh.
template <class Extras> int tube(Doc& doc, double radius, double height, int rings, int material, Extras extras)
{
    constexpr int around = 20;
    std::vector<float> positions, normals, uvs;
    std::vector<std::uint16_t> indices;
    for (int i = 0; i <= rings; ++i)
        for (int k = 0; k <= around; ++k) {
            const double angle = 2 * pi * k / around;
            for (double v : {radius * std::cos(angle), height * i / rings, radius * std::sin(angle)})
                positions.push_back(float(v));
            for (double v : {std::cos(angle), 0.0, std::sin(angle)})
                normals.push_back(float(v));
            uvs.push_back(float(k) / around), uvs.push_back(float(i) / float(rings));
            if (i == rings || k == around)
                continue;
            const int a = i * (around + 1) + k, c = a + around + 1;
            for (int corner : {a, c, a + 1, a + 1, c, c + 1})
                indices.push_back(std::uint16_t(corner));
        }
    Json primitive = {{"attributes",
                          {{"POSITION", doc.accessor(positions, "VEC3")}, {"NORMAL", doc.accessor(normals, "VEC3")},
                              {"TEXCOORD_0", doc.accessor(uvs, "VEC2")}}},
        {"indices", doc.accessor(indices, "SCALAR")}, {"material", material}};
    extras(primitive, positions);
    return doc.put("meshes", {{"primitives", {primitive}}});
}

/// Hangs a tube's vertices on joints that are evenly spread over its height.
void hang(Doc& doc, Json& primitive, const std::vector<float>& positions, double height, int joints)
{
    std::vector<std::uint8_t> which;
    std::vector<float> weights;
    for (std::size_t i = 0; i < positions.size(); i += 3) {
        const double at = double(positions[i + 1]) / height * joints - 0.5;
        const int lower = std::clamp(int(std::floor(at)), 0, std::max(joints - 2, 0));
        const float part = joints == 1 ? 0 : float(std::clamp(at - lower, 0.0, 1.0));
        for (int joint : {lower, std::min(lower + 1, joints - 1), 0, 0})
            which.push_back(std::uint8_t(joint));
        for (float weight : {1 - part, part, 0.0f, 0.0f})
            weights.push_back(weight);
    }
    primitive["attributes"]["JOINTS_0"] = doc.accessor(which, "VEC4");
    primitive["attributes"]["WEIGHTS_0"] = doc.accessor(weights, "VEC4");
}

int matt(Doc& doc, const dvec3& colour)
{
    return doc.put("materials",
        {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorFactor", {colour.x, colour.y, colour.z, 1}}}}});
}

/// Rotations about an axis that swing by an angle and back in a period.
std::vector<float> swings(const dvec3& axis, double most, double phase, int keys)
{
    std::vector<float> values;
    for (int i = 0; i < keys; ++i) {
        const double half = 0.5 * most * std::sin(2 * pi * i / (keys - 1) + phase);
        for (double v : {axis.x * std::sin(half), axis.y * std::sin(half), axis.z * std::sin(half), std::cos(half)})
            values.push_back(float(v));
    }
    return values;
}

std::vector<float> even_times(double period, int keys)
{
    std::vector<float> times;
    for (int i = 0; i < keys; ++i)
        times.push_back(float(period * i / (keys - 1)));
    return times;
}

const Json sunny{{"ambient", {0.3, 0.3, 0.35}}, {"sky", smooth_sky},
    {"lights", {{{"type", "directional"}, {"towards", {0.4, 0.8, 0.5}}, {"radiance", {0.8, 0.8, 0.7}}}}}};

/// A tube of 4 on a chain of joints that sway, with a bulge that swells, for c = 1 unit per second. glossy: with a normal
/// map.
Doc plant(bool glossy)
{
    constexpr int joints = 6, keys = 17;
    constexpr double height = 4, period = 120;
    Doc doc;
    int material = matt(doc, {0.2, 0.7, 0.3});
    if (glossy) {
        const int texture = doc.put("textures", {{"source", doc.put("images", {{"uri", gltf_test::png_uri()}})}});
        material = doc.put("materials",
            {{"pbrMetallicRoughness", {{"metallicFactor", 0.3}, {"roughnessFactor", 0.5}}},
                {"normalTexture", {{"index", texture}, {"scale", 0.2}}}});
    }
    const int mesh = tube(doc, 0.3, height, 48, material, [&](Json& primitive, const std::vector<float>& positions) {
        hang(doc, primitive, positions, height, joints);
        std::vector<float> bulge;
        for (std::size_t i = 0; i < positions.size(); i += 3) {
            const float part = float(std::exp(-std::pow((double(positions[i + 1]) - 2.8) / 0.5, 2)));
            for (float v : {2 * positions[i] * part, 0.0f, 2 * positions[i + 2] * part})
                bulge.push_back(v);
        }
        primitive["targets"] = {{{"POSITION", doc.accessor(bulge, "VEC3")}}};
    });
    Json chain = Json::array(), channels = Json::array(), samplers = Json::array();
    std::vector<float> inverse;
    const int times = doc.accessor(even_times(period, keys), "SCALAR");
    const int first = int(doc.json.contains("nodes") ? doc.json["nodes"].size() : 0);
    for (int joint = 0; joint < joints; ++joint) {
        Json node = {{"translation", {0, joint == 0 ? 0 : height / joints, 0}}};
        if (joint + 1 < joints)
            node["children"] = {first + joint + 1};
        chain.push_back(doc.put("nodes", node));
        for (int i = 0; i < 16; ++i)
            inverse.push_back(i == 13 ? float(-height / joints * joint) : i % 5 == 0 ? 1.0f : 0.0f);
        samplers.push_back({{"input", times},
            {"output", doc.accessor(swings(glm::normalize(dvec3(0.3, 0, 1)), 0.35, -0.6 * joint, keys), "VEC4")}});
        channels.push_back({{"sampler", joint}, {"target", {{"node", first + joint}, {"path", "rotation"}}}});
    }
    doc.json["skins"] = {{{"joints", chain}, {"inverseBindMatrices", matrices(doc, inverse)}}};
    const int plant = doc.put("nodes", {{"name", "plant"}, {"mesh", mesh}, {"skin", 0}});
    samplers.push_back({{"input", doc.accessor<float>({0, period / 2, period}, "SCALAR")},
        {"output", doc.accessor<float>({0, 0, 0, 0, 1, 0, 0, 0, 0}, "SCALAR")}, {"interpolation", "CUBICSPLINE"}});
    channels.push_back({{"sampler", joints}, {"target", {{"node", plant}, {"path", "weights"}}}});
    doc.json["animations"] = {{{"samplers", samplers}, {"channels", channels}}};
    quad(doc, {0, 0, 0}, {5, 0, 0}, {0, 0, -5}, matt(doc, {0.6, 0.5, 0.4}));
    doc.json["scenes"][0]["nodes"].push_back(first);
    doc.json["scenes"][0]["nodes"].push_back(plant);
    return doc;
}

TEST(Deforming, ASkinOfOneJointIsARigidNode)
{
    // The same tube hangs on a joint that swings, or is the mesh of that node, which needs no skin.
    const auto drawn = [](bool skin, const Json& scene, const Shot& shot) {
        Doc doc;
        const int mesh
            = tube(doc, 0.4, 3, 24, matt(doc, {0.8, 0.4, 0.2}), [&](Json& primitive, const std::vector<float>& positions) {
                  if (skin)
                      hang(doc, primitive, positions, 3, 1);
              });
        const int swinging = doc.put("nodes", {{"name", "tube"}, {"translation", {0, 1, -6}}});
        doc.json["scenes"][0]["nodes"] = {swinging};
        if (skin) {
            doc.json["skins"] = {{{"joints", {swinging}}}};
            doc.json["nodes"][std::size_t(swinging)]["children"]
                = {doc.put("nodes", {{"mesh", mesh}, {"skin", 0}, {"translation", {5, 5, 5}}})};
        } else
            doc.json["nodes"][std::size_t(swinging)]["mesh"] = mesh;
        doc.json["animations"] = {{{"samplers",
                                       {{{"input", doc.accessor(even_times(40, 17), "SCALAR")},
                                           {"output", doc.accessor(swings({0, 0, 1}, 0.4, 0, 17), "VEC4")}}}},
            {"channels", {{{"sampler", 0}, {"target", {{"node", swinging}, {"path", "rotation"}}}}}}}};
        const GpuWorld world = open_world("one_joint", doc, scene);
        Quality quality = test_quality();
        quality.lod_error_texels = 0; // a rigid tube has levels of detail
        OffscreenRenderer live(device(), pipelines(), world, one_view(Planar{70}, {240, 240}), quality, true);
        return live.picture(shot)[0];
    };
    const dvec3 body(0.2, 0, -0.1);
    for (const bool on_body : {false, true})
        for (const dvec3& u : {dvec3(0), dvec3(0.6, 0.1, -1.2)})
            for (const double time : {0.0, 7.0, 23.0}) {
                Json scene = sunny;
                scene["light_speed_m_s"] = 1;
                if (on_body)
                    scene["bodies"] = {{{"name", "tube"}, {"nodes", {"tube"}}, {"velocity", velocity_of(body)}}};
                const dvec3 along = on_body ? body / std::sqrt(1 + glm::dot(body, body)) * time : dvec3(0);
                Shot shot = shot_at(along + dvec3(0.3, 1.5, 2), u, {0, 0, -1});
                shot.time = time;
                const auto rigid = drawn(false, scene, shot), skinned = drawn(true, scene, shot);
                long different = 0;
                for (std::size_t i = 0; i < rigid.size(); ++i)
                    different += std::abs(int(rigid[i]) - int(skinned[i])) > 1;
                EXPECT_EQ(different, 0) << "on a body: " << on_body << ", u " << u.z << ", time " << time;
                long shown = 0; // of the tube, which is redder than the sky
                for (std::size_t i = 0; i < rigid.size(); i += 4)
                    shown += rigid[i] > rigid[i + 2] + 20;
                EXPECT_GT(shown, 200) << "on a body: " << on_body << ", u " << u.z << ", time " << time;
            }
}

TEST(Deforming, PointsOfATargetAreSeenWhereTheirLightLeft)
{
    // Three blobs of one mesh, 2 to 10 away, that a target moves sideways by 0.15 of light's speed: each is seen where its
    // own light left it.
    constexpr double speed = 0.15, period = 200, far = speed * period / 2;
    Doc doc;
    const dvec3 places[] = {{0, 0.4, -2.5}, {0, 0, -6}, {0, -0.6, -10}};
    const int mesh = blobs(doc, {{places[0], {1, 0, 0}}, {places[1], {0, 1, 0}}, {places[2], {0, 0, 1}}}, 0.06);
    std::vector<float> moved;
    for (int vertex = 0; vertex < 18; ++vertex)
        moved.insert(moved.end(), {float(far), 0, 0});
    doc.json["meshes"][std::size_t(mesh)]["primitives"][0]["targets"] = {{{"POSITION", doc.accessor(moved, "VEC3")}}};
    const int node = doc.put("nodes", {{"name", "blobs"}, {"mesh", mesh}, {"translation", {-1, 0, 0}}});
    doc.json["scenes"][0]["nodes"] = {node};
    doc.json["animations"] = {{{"samplers",
                                   {{{"input", doc.accessor<float>({0, period / 2, period}, "SCALAR")},
                                       {"output", doc.accessor<float>({0, 1, 0}, "SCALAR")}}}},
        {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}}}}}};
    double worst = 0, largest_offset = 0;
    const GpuWorld world = open_world("target", doc, {{"light_speed_m_s", 1}});
    for (double time : {13.0, 17.0, 20.0}) {
        Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
        shot.time = time;
        constexpr int across = 900;
        OffscreenRenderer live = renderer(world, one_view(Planar{75}, {across, across}));
        const Numbers numbers(live, shot);
        const double pixel = 2 * std::tan(37.5 * degree) / across;
        for (int blob = 0; blob < 3; ++blob) {
            // The light cone's equation, (time - sent)^2 = x(sent)^2 + across^2, as a quadratic in the light's delay.
            const auto seen_at = [&](const dvec3& delayed) {
                const double x0 = places[blob].x - 1 + speed * time;
                const double square = delayed.y * delayed.y + delayed.z * delayed.z;
                // delay^2 = (x0 - speed delay)^2 + square
                const double a = 1 - speed * speed, b = 2 * x0 * speed, c = -(x0 * x0 + square);
                return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
            };
            const double delay = seen_at(places[blob]), middle_delay = seen_at(places[1]);
            const auto at = [&](double own) {
                return dvec3(places[blob].x - 1 + speed * (time - own), places[blob].y, places[blob].z);
            };
            const dvec3 expected = glm::normalize(at(delay)), found = direction_of(numbers, blob);
            EXPECT_LT(between(expected, found), 0.5 * pixel) << "time " << time << ", blob " << blob;
            worst = std::max(worst, between(expected, found) / pixel);
            largest_offset = std::max(largest_offset, between(expected, glm::normalize(at(middle_delay))) / pixel);
        }
    }
    std::printf("  targets: at most %.2f px off, light-travel offset up to %.1f px\n", worst, largest_offset);
    EXPECT_GT(largest_offset, 20);
}

TEST(Deforming, EqualsTrueRays)
{
    const dvec3 body(0.3, 0, 0.1);
    for (const bool glossy : {false, true})
        for (const bool on_body : {false, true})
            for (const dvec3& u : {dvec3(0), dvec3(0.4, 0, -1)}) {
                Json scene = sunny;
                if (on_body)
                    scene["bodies"] = {{{"name", "plant"}, {"nodes", {"plant"}}, {"velocity", velocity_of(body)}}};
                const dvec3 along = on_body ? body / std::sqrt(1 + glm::dot(body, body)) * 61.0 : dvec3(0);
                Shot shot = shot_at(along + dvec3(0.2, 2.5, 6.5), u, {0, -0.1, -1});
                shot.time = 61;
                const BesideRays one
                    = beside_rays(plant(glossy), scene, one_view(Planar{65}, {200, 200}), shot, 16, true, 0.05);
                std::printf("  glossy %d, on a body %d, u %.1f: %.1f dB, %zu pixels, middle %.4f\n", glossy, on_body,
                    glm::length(u), one.db, one.light_off.size(), one.light_off[one.light_off.size() / 2]);
                EXPECT_GT(one.light_off.size(), on_body ? 400u : 5000u);
                EXPECT_GT(one.db, 38) << glossy << on_body << u.z;
                EXPECT_LT(one.light_off[one.light_off.size() / 2], glossy ? 0.01 : 0.003) << glossy << on_body << u.z;
            }
}

} // namespace
} // namespace starbow::gpu_test::deforming_gpu_test
