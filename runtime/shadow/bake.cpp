#include "bake.h"
#include "config/json/error.h"
#include "config/json/hash.h"
#include "config/json/whole_file.h"
#include "occluders.h"
#include "runtime/world/boxes.h"
#include "runtime/world/outline.h"
#include "runtime/world/worldline.h"
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <mutex>
#include <numbers>
#include <thread>

namespace starbow {
namespace {

constexpr int most_point_lamps = 3; // six maps each
constexpr int most_cells = 1'000'000, cells_along = 160; // of the grid; along its longest side
constexpr int sky_rays = 64; // from a cell's middle
constexpr std::size_t most_triangles = 12'000'000; // some 150 bytes each

/// Calls work(i) for 0 to count - 1 in all processors; shows the done part from `from` to `to`.
void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work,
    const std::function<void(double)>& progress, double from, double to)
{
    std::atomic<std::size_t> next = 0;
    const auto run = [&](bool shows) {
        for (std::size_t i = next++; i < count; i = next++) {
            work(i);
            if (shows && progress)
                progress(from + (to - from) * double(i) / double(count));
        }
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < std::max(std::thread::hardware_concurrency(), 1u); ++i)
        threads.emplace_back([&] { run(false); });
    run(true);
}

/// The boxes of a world's still things: around all but backdrops; and around most of them, where visitors look closely:
/// without the few that are farthest from the others, such as clouds and hills.
struct Boxes {
    AlignedBox all, middle;
};

Boxes boxes_of(const World& world)
{
    std::vector<AlignedBox> things;
    for (const Instance& instance : world.instances)
        if (hides_light(world, instance)) {
            const Primitive& primitive = world.primitives[instance.primitive];
            things.push_back(transformed({primitive.low, primitive.high}, instance.frame_from_local));
        }
    Boxes boxes;
    boxes.all = boxes.middle = middle_of(things).box;
    glm::dvec3 centre;
    for (int k = 0; k < 3; ++k) {
        const auto half = things.begin() + std::ptrdiff_t(things.size() / 2);
        const auto middle = [k](const AlignedBox& box) { return 0.5 * (box.low[k] + box.high[k]); };
        std::nth_element(things.begin(), half, things.end(),
            [&](const AlignedBox& a, const AlignedBox& b) { return middle(a) < middle(b); });
        centre[k] = middle(*half);
    }
    const auto reach = [&](const AlignedBox& box) {
        return glm::length(glm::max(glm::abs(box.low - centre), glm::abs(box.high - centre)));
    };
    std::sort(things.begin(), things.end(), [&](const AlignedBox& a, const AlignedBox& b) { return reach(a) < reach(b); });
    const std::size_t most = std::size_t(std::ceil(0.97 * double(things.size())));
    if (most < things.size()) {
        AlignedBox middle = things.front();
        for (std::size_t i = 1; i < most; ++i)
            middle = around(middle, things[i]);
        boxes.middle = {glm::max(middle.low, boxes.all.low), glm::min(middle.high, boxes.all.high)};
    }
    return boxes;
}

/// The lowest and the highest place of a box along an axis.
glm::dvec2 extent_along(const AlignedBox& box, const glm::dvec3& axis)
{
    const glm::dvec3 a = axis * box.low, b = axis * box.high;
    const glm::dvec3 low = glm::min(a, b), high = glm::max(a, b);
    return {low.x + low.y + low.z, high.x + high.y + high.z};
}

ShadowMap across(const glm::dvec3& towards, const Boxes& boxes, int size, double extent)
{
    ShadowMap map;
    // The first axis goes with the longest side of the world, so that the texels of a street are shorter across it.
    const glm::dvec3 sides = boxes.middle.high - boxes.middle.low;
    glm::dvec3 along(0);
    double longest = -1;
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 axis(0);
        axis[k] = 1;
        axis -= towards * glm::dot(towards, axis);
        if (sides[k] * glm::length(axis) > longest && glm::length(axis) > 0.1)
            longest = sides[k] * glm::length(axis), along = glm::normalize(axis);
    }
    map.axes = {along, glm::cross(towards, along), towards};
    for (int level = 0; level < 2; ++level)
        for (int k = 0; k < 2; ++k) {
            const glm::dvec2 range = extent_along(level == 0 ? boxes.middle : boxes.all, map.axes[std::size_t(k)]);
            // A margin of two texels: look-ups read the texels around.
            map.texel[level][k] = std::max(range.y - range.x, 1e-6 * (1 + extent)) / (size - 4);
            map.low[level][k] = 0.5 * (range.x + range.y) - 0.5 * size * map.texel[level][k];
        }
    const glm::dvec2 depth = extent_along(boxes.all, towards);
    const double margin = 0.01 * (depth.y - depth.x) + 1e-6 * (1 + extent);
    map.nothing = depth.x - margin, map.nearest = depth.y + margin;
    return map;
}

/// The maps that the scene's resting lamps get, the directional ones first. layers: the number of maps in all.
std::vector<ShadowMap> maps_of(const SceneFile& scene, const Boxes& boxes, int& size, int& layers)
{
    const std::vector<bool> has = lights_with_shadows(scene);
    std::vector<std::size_t> far, near;
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (has[i])
            (std::holds_alternative<DirectionalLight>(scene.lights[i]) ? far : near).push_back(i);
    layers = int(2 * far.size() + 6 * near.size());
    size = layers <= 2 ? 4096 : layers <= 8 ? 2048 : 1024;
    const double extent = glm::length(glm::max(glm::abs(boxes.all.low), glm::abs(boxes.all.high)));
    std::vector<ShadowMap> maps;
    int layer = 0;
    for (const std::size_t i : far) {
        maps.push_back(across(std::get<DirectionalLight>(scene.lights[i]).towards, boxes, size, extent));
        maps.back().light = i, maps.back().layer = layer;
        layer += 2;
    }
    for (const std::size_t i : near) {
        ShadowMap map;
        map.light = i, map.point = true, map.place = std::get<PointLight>(scene.lights[i]).position;
        map.layer = layer;
        map.nothing = -(extent + glm::length(map.place)), map.nearest = 0;
        maps.push_back(map);
        layer += 6;
    }
    return maps;
}

void fill_map(Shadows& shadows, const ShadowMap& map, const Occluders& occluders,
    const std::function<void(double)>& progress, double from, double to)
{
    const int size = shadows.size, layers = map.point ? 6 : 2;
    // Rays begin outside everything. What is nearer to the lamp than the world's middle counts as its border.
    const double beyond = std::max(map.nearest, 2 * occluders.extent());
    const auto number = [&](double place) {
        const double part = std::clamp((place - map.nothing) / (map.nearest - map.nothing), 0.0, 1.0);
        return std::uint16_t(std::lround(65535 * part));
    };
    const auto row = [&](std::size_t line) {
        const int layer = int(line) / size, y = int(line) % size;
        std::uint16_t* texel
            = &shadows.texels[(std::size_t(map.layer + layer) * std::size_t(size) + std::size_t(y)) * std::size_t(size)];
        for (int x = 0; x < size; ++x) {
            const glm::dvec2 at(x + 0.5, y + 0.5);
            std::optional<Occluders::Hit> hit;
            if (map.point) {
                hit = occluders.first(map.place, cube_direction(layer, 2.0 * at / double(size) - 1.0), 1e37);
                texel[x] = hit ? number(-hit->distance) : 0;
                continue;
            }
            const glm::dvec2 place = map.low[layer] + at * map.texel[layer];
            hit = occluders.first(place.x * map.axes[0] + place.y * map.axes[1] + beyond * map.axes[2], -map.axes[2], 1e37);
            texel[x] = hit ? number(beyond - hit->distance) : 0;
        }
    };
    in_parallel(std::size_t(layers) * std::size_t(size), row, progress, from, to);
}

/// A cell of the grid: the visible part of the sky and its first moment; `inside`: the cell is within a body.
struct Cell {
    double part = 0;
    glm::dvec3 moment{0};
    bool inside = false;
};

Cell cell_at(const Occluders& occluders, const glm::dvec3& place)
{
    Cell cell;
    int backs = 0;
    for (int i = 0; i < sky_rays; ++i) {
        // Evenly over the sphere: a Fibonacci lattice.
        const double y = 1 - 2 * (i + 0.5) / sky_rays, turn = 2 * std::numbers::pi * 0.6180339887498949 * i;
        const double level = std::sqrt(1 - y * y);
        const glm::dvec3 way(level * std::cos(turn), y, level * std::sin(turn));
        const auto hit = occluders.first(place, way, 1e37);
        if (!hit)
            cell.part += 1.0 / sky_rays, cell.moment += 3.0 / sky_rays * way;
        else if (hit->back)
            ++backs;
    }
    cell.inside = backs > sky_rays / 5;
    return cell;
}

/// Cells within bodies take the mean of their neighbours, until all have a value.
void spread(std::vector<Cell>& cells, const glm::ivec3& count)
{
    const auto index = [&](const glm::ivec3& at) {
        return (std::size_t(at.z) * std::size_t(count.y) + std::size_t(at.y)) * std::size_t(count.x) + std::size_t(at.x);
    };
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<std::pair<std::size_t, Cell>> found;
        for (int z = 0; z < count.z; ++z)
            for (int y = 0; y < count.y; ++y)
                for (int x = 0; x < count.x; ++x) {
                    if (!cells[index({x, y, z})].inside)
                        continue;
                    Cell sum;
                    int neighbours = 0;
                    for (int side = 0; side < 6; ++side) {
                        glm::ivec3 at(x, y, z);
                        at[side / 2] += side % 2 ? 1 : -1;
                        if (at[side / 2] < 0 || at[side / 2] >= count[side / 2] || cells[index(at)].inside)
                            continue;
                        sum.part += cells[index(at)].part, sum.moment += cells[index(at)].moment;
                        ++neighbours;
                    }
                    if (neighbours > 0)
                        found.push_back({index({x, y, z}), {sum.part / neighbours, sum.moment / double(neighbours), false}});
                }
        for (const auto& [at, cell] : found)
            cells[at] = cell, changed = true;
    }
}

void fill_sky(Shadows& shadows, const AlignedBox& box, const Occluders& occluders,
    const std::function<void(double)>& progress, double from)
{
    const glm::dvec3 size = box.high - box.low;
    shadows.cell = std::max({size.x, size.y, size.z, 1e-6}) / cells_along;
    const auto cells_of = [&] { return glm::max(glm::ivec3(glm::ceil(size / shadows.cell)) + 2, 2); };
    while (std::size_t(cells_of().x) * std::size_t(cells_of().y) * std::size_t(cells_of().z) > most_cells)
        shadows.cell *= 1.1;
    shadows.cells = cells_of();
    shadows.low = 0.5 * (box.low + box.high) - 0.5 * shadows.cell * glm::dvec3(shadows.cells - 1);
    const glm::ivec3& count = shadows.cells;
    std::vector<Cell> cells(std::size_t(count.x) * std::size_t(count.y) * std::size_t(count.z));
    const auto row = [&](std::size_t line) {
        for (int x = 0; x < count.x; ++x) {
            const glm::dvec3 at(x, double(line % std::size_t(count.y)), double(line / std::size_t(count.y)));
            cells[line * std::size_t(count.x) + std::size_t(x)] = cell_at(occluders, shadows.low + shadows.cell * at);
        }
    };
    in_parallel(std::size_t(count.y) * std::size_t(count.z), row, progress, from, 1);
    spread(cells, count);
    const auto byte = [](double value) { return std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0))); };
    for (const Cell& cell : cells) {
        // A surface's cosine-weighted part of visibility a + b . w is a + 2/3 b . n (Ramamoorthi and Hanrahan 2001).
        for (int k = 0; k < 3; ++k)
            shadows.sky.push_back(byte(0.5 + 0.5 * (2.0 / 3) * cell.moment[k]));
        shadows.sky.push_back(byte(cell.part));
    }
}

/// Everything of a world but its arrays of vertices, indices and texels, with its bodies in their places.
World placed(const World& world, const SceneFile& scene)
{
    World all;
    all.materials = world.materials, all.primitives = world.primitives, all.instances = world.instances;
    all.nodes = world.nodes, all.motions = world.motions, all.joints = world.joints, all.tracks = world.tracks;
    place_bodies(all, scene);
    return all;
}

// ---------------------------------------------------------------- kept shadows

constexpr std::uint64_t version = 2; // another computation has another number

struct Header {
    char magic[8] = {'S', 't', 'a', 'r', 'b', 'o', 'w', 'S'};
    std::uint64_t key = 0, texels = 0, sky = 0;
    std::int64_t size = 0, cells[3] = {};
    std::uint64_t content = 0;
};

std::uint64_t key_of(const World& world, const World& placed, const SceneFile& scene)
{
    ContentHash hash;
    const std::uint64_t made_by[] = {version, sky_rays, most_cells, cells_along};
    hash.add(made_by, sizeof made_by);
    hash.add(world.vertices.data(), world.vertices.size() * sizeof(Vertex));
    hash.add(world.indices.data(), world.indices.size() * sizeof(std::uint32_t));
    for (const Instance& instance : placed.instances)
        if (hides_light(placed, instance)) {
            const Primitive& primitive = placed.primitives[instance.primitive];
            const Material& material = placed.materials[std::size_t(primitive.material)];
            const std::uint64_t range[] = {primitive.first_index, primitive.index_count,
                std::uint64_t(std::uint32_t(primitive.vertex_offset)), std::uint64_t(material.double_sided)};
            hash.add(range, sizeof range);
            hash.add(&instance.frame_from_local, sizeof instance.frame_from_local);
            const float mask[] = {material.alpha_cutoff, material.base_colour.a};
            hash.add(mask, sizeof mask);
            if (material.alpha_cutoff > 0 && material.base_texture >= 0) {
                const Texture& texture = world.textures[std::size_t(material.base_texture)];
                hash.add(texture.rgba.data(), texture.rgba.size());
            }
        }
    for (const Light& light : scene.lights) {
        const auto* far = std::get_if<DirectionalLight>(&light);
        const glm::dvec3 at = far ? far->towards : std::get<PointLight>(light).position;
        const std::uint64_t kind = far ? 0 : std::get<PointLight>(light).body.empty() ? 1 : 2;
        hash.add(&kind, sizeof kind);
        hash.add(&at, sizeof at);
    }
    return hash.value();
}

std::uint64_t content_of(const Shadows& shadows)
{
    ContentHash hash;
    hash.add(shadows.texels.data(), shadows.texels.size() * sizeof(std::uint16_t));
    hash.add(shadows.sky.data(), shadows.sky.size());
    hash.add(&shadows.low, sizeof shadows.low);
    hash.add(&shadows.cell, sizeof shadows.cell);
    return hash.value();
}

bool read_kept(const std::filesystem::path& path, std::uint64_t key, Shadows& shadows)
{
    RegularFile file(path);
    Header header;
    const Header right;
    const auto read = [&](void* to, std::size_t bytes) { return file.read({static_cast<char*>(to), bytes}) == bytes; };
    if (!read(&header, sizeof header) || std::memcmp(header.magic, right.magic, sizeof right.magic) != 0 || header.key != key
        || header.texels > file.size() || header.sky > file.size()
        || file.size()
            != sizeof header + header.texels * sizeof(std::uint16_t) + header.sky + sizeof shadows.low + sizeof shadows.cell)
        return false;
    shadows.texels.resize(header.texels), shadows.sky.resize(header.sky);
    if (!read(shadows.texels.data(), header.texels * sizeof(std::uint16_t)) || !read(shadows.sky.data(), header.sky)
        || !read(&shadows.low, sizeof shadows.low) || !read(&shadows.cell, sizeof shadows.cell)
        || content_of(shadows) != header.content || header.size != shadows.size)
        return false;
    shadows.cells = glm::ivec3(int(header.cells[0]), int(header.cells[1]), int(header.cells[2]));
    return true;
}

bool write_kept(const std::filesystem::path& file, std::uint64_t key, const Shadows& shadows)
{
    Header header;
    header.key = key, header.texels = shadows.texels.size(), header.sky = shadows.sky.size();
    header.size = shadows.size, header.content = content_of(shadows);
    for (int k = 0; k < 3; ++k)
        header.cells[k] = shadows.cells[k];
    const auto bytes
        = [](const void* from, std::size_t count) { return std::span(static_cast<const unsigned char*>(from), count); };
    try {
        write_own(file,
            {bytes(&header, sizeof header), bytes(shadows.texels.data(), shadows.texels.size() * sizeof(std::uint16_t)),
                bytes(shadows.sky.data(), shadows.sky.size()), bytes(&shadows.low, sizeof shadows.low),
                bytes(&shadows.cell, sizeof shadows.cell)});
    } catch (const InputError&) {
        return false;
    }
    return true;
}

Shadows without_texels(const World& world, const SceneFile& scene, Boxes& boxes, int& layers)
{
    Shadows shadows;
    boxes = boxes_of(world);
    shadows.maps = maps_of(scene, boxes, shadows.size, layers);
    return shadows;
}

void fill(Shadows& shadows, const Boxes& boxes, int layers, const Occluders& occluders,
    const std::function<void(double)>& progress)
{
    shadows.texels.resize(std::size_t(layers) * std::size_t(shadows.size) * std::size_t(shadows.size));
    for (const ShadowMap& map : shadows.maps)
        fill_map(
            shadows, map, occluders, progress, 0.5 * map.layer / layers, 0.5 * (map.layer + (map.point ? 6 : 2)) / layers);
    fill_sky(shadows, boxes.middle, occluders, progress, 0.5);
}

} // namespace

std::vector<bool> lights_with_shadows(const SceneFile& scene)
{
    std::vector<bool> has;
    int points = 0;
    for (const Light& light : scene.lights) {
        const auto* point = std::get_if<PointLight>(&light);
        has.push_back(!point || (point->body.empty() && points++ < most_point_lamps));
    }
    return has;
}

Shadows shadows_of(const World& world, const SceneFile& scene, const std::function<void(double)>& progress)
{
    if (std::none_of(world.instances.begin(), world.instances.end(),
            [&](const Instance& instance) { return hides_light(world, instance); }))
        return {};
    Boxes boxes;
    int layers = 0;
    Shadows shadows = without_texels(world, scene, boxes, layers);
    fill(shadows, boxes, layers, Occluders(world, world.instances), progress);
    return shadows;
}

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
    Boxes boxes;
    int layers = 0;
    auto shadows = std::make_shared<Shadows>(without_texels(all, scene, boxes, layers));
    if (shadows->maps.size() < scene.lights.size())
        world.notes.push_back("of its " + std::to_string(scene.lights.size()) + " lamps "
            + std::to_string(shadows->maps.size()) + " have shadows: those that rest, and of point lamps the first three");
    const std::uint64_t key = key_of(world, all, scene);
    char name[32];
    std::snprintf(name, sizeof name, "%016llx.shadow", (unsigned long long)key);
    bool written = false;
    if (folder.empty() || !read_kept(folder / name, key, *shadows)) {
        fill(*shadows, boxes, layers, Occluders(world, all.instances), progress);
        written = !folder.empty() && write_kept(folder / name, key, *shadows);
    } else {
        std::error_code ignored; // marks the file as just read
        std::filesystem::last_write_time(folder / name, std::filesystem::file_time_type::clock::now(), ignored);
    }
    world.shadows = std::move(shadows);
    return written;
}

} // namespace starbow
