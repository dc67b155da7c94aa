#include "surroundings.h"
#include "boxes.h"
#include "config/json/error.h"
#include "ephemeris.h"
#include "gltf/parts.h"
#include "stars.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

namespace starbow {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr AlignedBox nothing{glm::dvec3(infinite), glm::dvec3(-infinite)};

bool is_nothing(const AlignedBox& box) { return !(box.low.x <= box.high.x); }

void include(AlignedBox& box, const glm::dvec3& point)
{
    box.low = glm::min(box.low, point);
    box.high = glm::max(box.high, point);
}

/// The box around all positions of a mesh, in its own frame.
AlignedBox box_of(const GuardedGltf& file, const tinygltf::Mesh& mesh)
{
    AlignedBox box = nothing;
    std::size_t sparse_bytes_left = GltfLimits::sparse_bytes;
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end())
            continue;
        Elements elements;
        const char* problem = nullptr;
        if (!open_accessor(file.model, position->second, sparse_bytes_left, elements, problem))
            throw InputError(file.name, "/accessors/" + std::to_string(position->second), problem);
        for (std::size_t i = 0; i < elements.count; ++i)
            include(box, {elements.component(i, 0), elements.component(i, 1), elements.component(i, 2)});
    }
    return box;
}

/// One box for all boxes whose middles lie in the same cell of a grid of 8 x 8 x 8.
std::vector<AlignedBox> merged(const std::vector<AlignedBox>& boxes)
{
    constexpr int cells = 8;
    AlignedBox all = nothing;
    for (const AlignedBox& box : boxes)
        include(all, box.low), include(all, box.high);
    std::map<int, AlignedBox> by_cell;
    for (const AlignedBox& box : boxes) {
        const glm::dvec3 size = glm::max(all.high - all.low, glm::dvec3(1e-300));
        const glm::ivec3 at = glm::min(glm::ivec3((0.5 * (box.low + box.high) - all.low) / size * double(cells)), cells - 1);
        AlignedBox& cell = by_cell.try_emplace((at.x * cells + at.y) * cells + at.z, nothing).first->second;
        include(cell, box.low), include(cell, box.high);
    }
    std::vector<AlignedBox> out;
    for (const auto& [at, box] : by_cell)
        out.push_back(box);
    return out;
}

} // namespace

std::vector<AlignedBox> things_at_rest(const SceneFile& scene)
{
    const GuardedGltf file = guard_gltf(scene.gltf);
    const tinygltf::Model& model = file.model;
    std::set<std::string> moving;
    for (const Body& body : scene.bodies)
        moving.insert(body.nodes.begin(), body.nodes.end());
    std::vector<AlignedBox> meshes, things;
    for (const tinygltf::Mesh& mesh : model.meshes)
        meshes.push_back(box_of(file, mesh));
    struct Open {
        int node;
        glm::dmat4 world_from_parent;
    };
    std::vector<Open> open;
    for (const int root : root_nodes(model))
        open.push_back({root, glm::dmat4(1)});
    while (!open.empty()) {
        const Open at = open.back();
        open.pop_back();
        const tinygltf::Node& node = model.nodes[std::size_t(at.node)];
        if (moving.contains(node.name))
            continue;
        const glm::dmat4 world_from_local = at.world_from_parent * local_transform(node);
        for (const int child : node.children)
            open.push_back({child, world_from_local});
        if (node.mesh >= 0 && !is_nothing(meshes[std::size_t(node.mesh)]))
            things.push_back(transformed(meshes[std::size_t(node.mesh)], world_from_local));
    }
    for (const Solid& globe : solid_globes(scene))
        things.push_back({globe.path[0] - globe.radius, globe.path[0] + globe.radius});
    return things.size() > most_things ? merged(things) : things;
}

std::vector<Solid> solid_globes(const SceneFile& scene)
{
    std::vector<Solid> solids;
    if (!scene.globes)
        return solids;
    // Globes have no hills, and the polynomial's error is smaller than this part of a planet's radius.
    constexpr double above_ground = 1.0005;
    constexpr double days = 2;
    const SolarSystem system = load_solar_system(scene.globes->file);
    const WorldOrigin origin = world_origin(system, *scene.globes);
    const glm::dmat3 turn = world_from_equatorial(scene.stars ? scene.stars->ahead_deg : glm::dvec2(0));
    constexpr std::size_t count = std::tuple_size_v<decltype(Solid::path)>;
    std::array<double, count> at{}; // Chebyshev nodes of 0 to 1
    std::vector<std::array<glm::dvec3, count>> differences(system.globes.size());
    for (std::size_t i = 0; i < count; ++i) {
        at[i] = 0.5 - 0.5 * std::cos(std::numbers::pi * (double(i) + 0.5) / count);
        const std::vector<glm::dvec3> places = globe_places_m(system, origin.days + days * at[i]);
        for (std::size_t globe = 0; globe < places.size(); ++globe)
            differences[globe][i] = turn * ((places[globe] - origin.at(days * 86400 * at[i])) / scene.unit_m);
    }
    for (std::size_t globe = 0; globe < differences.size(); ++globe) {
        auto& newton = differences[globe];
        for (std::size_t order = 1; order < count; ++order)
            for (std::size_t i = count; i-- > order;)
                newton[i] = (newton[i] - newton[i - 1]) / (at[i] - at[i - order]);
        Solid& solid = solids.emplace_back();
        solid.radius = above_ground * system.globes[globe].radius_m / scene.unit_m;
        solid.span = days * 86400 / scene.seconds_per_time_unit();
        // Newton's form into powers, from the innermost bracket outwards.
        for (std::size_t k = count; k-- > 0;) {
            for (std::size_t power = count; power-- > 1;)
                solid.path[power] = solid.path[power - 1] - at[k] * solid.path[power];
            solid.path[0] = newton[k] - at[k] * solid.path[0];
        }
    }
    return solids;
}

} // namespace starbow
