#include "add_shadows.h"
#include "config/json/kept_file.h"
#include "fill.h"
#include "runtime/world/worldline.h"
#include "shadow_cache.h"

namespace starbow {
namespace {

constexpr std::size_t most_triangles = 12'000'000; // some 150 bytes each

/// Everything of a world but its arrays of vertices, indices and texels, with its bodies in their places.
World placed(const World& world, const SceneFile& scene)
{
    World all;
    all.materials = world.materials, all.primitives = world.primitives, all.instances = world.instances;
    all.nodes = world.nodes, all.motions = world.motions, all.joints = world.joints, all.tracks = world.tracks;
    place_bodies(all, scene);
    return all;
}

} // namespace

bool add_shadows(
    World& world, const SceneFile& scene, const std::filesystem::path& folder, const std::function<void(double)>& progress)
{
    if (!scene.shadows)
        return false;
    const World all = placed(world, scene);
    std::size_t triangles = 0;
    for (const Instance& instance : all.instances)
        if (hides_light(all, instance))
            triangles += world.primitives[instance.primitive].index_count / 3;
    if (triangles == 0)
        return false;
    if (triangles > most_triangles) {
        world.notes.push_back("its still things have " + std::to_string(triangles)
            + " triangles, too many for shadows: at most " + std::to_string(most_triangles) + " are right");
        return false;
    }
    const Boxes boxes = boxes_of(all);
    auto shadows = std::make_shared<Shadows>();
    int layers = 0;
    shadows->maps = maps_of(scene, boxes, shadows->size, layers);
    if (shadows->maps.size() < scene.lights.size())
        world.notes.push_back("of its " + std::to_string(scene.lights.size()) + " lamps "
            + std::to_string(shadows->maps.size())
            + " have shadows: those that rest near its still things, of point lamps the first three");
    const std::uint64_t key = shadows_key(world, all, scene);
    const std::filesystem::path file = folder / cache_key(key, ".shadow");
    const bool known = !folder.empty() && read_kept_shadows(file, key, *shadows);
    if (!known) {
        const Occluders occluders(world, all.instances);
        shadows->texels.resize(std::size_t(layers) * std::size_t(shadows->size) * std::size_t(shadows->size));
        for (const ShadowMap& map : shadows->maps)
            fill_map(*shadows, map, occluders, progress, 0.5 * map.layer / layers,
                0.5 * (map.layer + (map.point ? 6 : 2)) / layers);
        fill_sky(*shadows, boxes, occluders, progress, 0.5);
    }
    const bool written = !known && !folder.empty() && write_kept_shadows(file, key, *shadows);
    world.shadows = std::move(shadows);
    return written;
}

} // namespace starbow
