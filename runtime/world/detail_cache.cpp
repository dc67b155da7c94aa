#include "detail_cache.h"
#include "config/json/error.h"
#include "config/json/hash.h"
#include "config/json/kept_file.h"
#include "detail.h"
#include "pieces.h"
#include <meshoptimizer.h>
#include <type_traits>

namespace starbow {
namespace {

/// Another way of making levels has another number.
constexpr std::uint64_t version = 4;

constexpr const char* levels_kind = "levels2";

/// The detail levels, pieces and clusters of a primitive, in the file's form. The records are plain numbers without gaps.
struct KeptPrimitive {
    std::uint32_t levels, first_cluster, clusters, first_piece, pieces;
};
struct CachedGroup {
    double low[3], high[3], error, shading, apart;
};
struct KeptPiece {
    double low[3], high[3];
    std::uint32_t first_index, indices, first_cluster, clusters;
    CachedGroup own, coarser;
};
struct KeptLevel {
    double error, shading, apart;
    std::uint32_t first_index, indices, first_cluster, clusters;
};
static_assert(
    std::has_unique_object_representations_v<KeptPrimitive> && sizeof(KeptLevel) == 40 && sizeof(KeptPiece) == 208);
static_assert(std::is_trivially_copyable_v<Cluster> && sizeof(Cluster) == 40);

/// The parts of a kept file.
struct Kept {
    std::vector<KeptPrimitive> primitives;
    std::vector<KeptPiece> pieces;
    std::vector<KeptLevel> levels;
    std::vector<Cluster> clusters;
    std::vector<std::uint32_t> indices;
};

bool read_levels(const std::filesystem::path& path, std::uint64_t key, const World& world, Kept& kept)
{
    KeptFile file(path, levels_kind, key);
    std::size_t part = 0;
    const auto make_room = [&](auto& values) { values.resize(file.size(part++) / sizeof values[0]); };
    make_room(kept.primitives), make_room(kept.pieces), make_room(kept.levels), make_room(kept.clusters);
    make_room(kept.indices);
    if (!file.read({bytes_of(kept.primitives), bytes_of(kept.pieces), bytes_of(kept.levels), bytes_of(kept.clusters),
            bytes_of(kept.indices)})
        || kept.primitives.size() != world.primitives.size())
        return false;
    std::uint64_t levels = 0, pieces = 0;
    for (const KeptPrimitive& primitive : kept.primitives)
        levels += primitive.levels, pieces += primitive.pieces;
    return levels == kept.levels.size() && pieces == kept.pieces.size();
}

void adopt(Kept&& kept, World& world)
{
    world.indices = std::move(kept.indices);
    world.clusters = std::move(kept.clusters);
    std::size_t next = 0;
    for (std::size_t i = 0; i < world.primitives.size(); ++i) {
        Primitive& primitive = world.primitives[i];
        const KeptPrimitive& from = kept.primitives[i];
        primitive.clusters = {from.first_cluster, from.clusters};
        primitive.pieces = {from.first_piece, from.pieces};
        for (std::uint32_t k = 0; k < from.levels; ++k) {
            const KeptLevel& level = kept.levels[next++];
            primitive.coarser.push_back({level.first_index, level.indices, level.error, level.shading, level.apart,
                {level.first_cluster, level.clusters}});
        }
    }
    const auto vec = [](const double(&v)[3]) { return glm::dvec3(v[0], v[1], v[2]); };
    const auto group = [&](const CachedGroup& g) {
        return PieceGroup{vec(g.low), vec(g.high), g.error, g.shading, g.apart};
    };
    for (const KeptPiece& from : kept.pieces)
        world.pieces.push_back({vec(from.low), vec(from.high),
            {from.first_index, from.indices, from.own.error, from.own.shading, from.own.apart,
                {from.first_cluster, from.clusters}},
            group(from.own), group(from.coarser)});
}

Kept kept_of(const World& world)
{
    Kept kept;
    const auto group = [](const PieceGroup& g) {
        return CachedGroup{{g.low.x, g.low.y, g.low.z}, {g.high.x, g.high.y, g.high.z}, g.error, g.shading, g.apart};
    };
    for (const Primitive& primitive : world.primitives) {
        kept.primitives.push_back({std::uint32_t(primitive.coarser.size()), primitive.clusters.first,
            primitive.clusters.count, primitive.pieces.first, primitive.pieces.count});
        for (const DetailLevel& level : primitive.coarser)
            kept.levels.push_back({level.error, level.shading, level.apart, level.first_index, level.index_count,
                level.clusters.first, level.clusters.count});
    }
    for (const DetailPiece& piece : world.pieces) {
        const DetailLevel& level = piece.triangles;
        kept.pieces.push_back(
            {{piece.low.x, piece.low.y, piece.low.z}, {piece.high.x, piece.high.y, piece.high.z}, level.first_index,
                level.index_count, level.clusters.first, level.clusters.count, group(piece.own), group(piece.coarser)});
    }
    kept.clusters = world.clusters;
    kept.indices = world.indices;
    return kept;
}

} // namespace

std::uint64_t levels_key(const World& world)
{
    ContentHash hash;
    const std::uint64_t made_by[] = {version, MESHOPTIMIZER_VERSION};
    hash.add(made_by, sizeof made_by);
    hash.add(world.vertices.data(), world.vertices.size() * sizeof(Vertex));
    hash.add(world.indices.data(), world.indices.size() * sizeof(std::uint32_t));
    for (const Primitive& primitive : world.primitives) {
        const std::uint64_t range[] = {primitive.first_index, primitive.index_count,
            std::uint64_t(std::uint32_t(primitive.vertex_offset)), is_divided(world, primitive), primitive.deforming >= 0};
        hash.add(range, sizeof range);
    }
    return hash.value();
}

bool read_kept_levels(const std::filesystem::path& file, std::uint64_t key, World& world)
{
    Kept kept;
    if (!read_levels(file, key, world, kept))
        return false;
    adopt(std::move(kept), world);
    return true;
}

bool add_kept_detail_levels(World& world, const std::filesystem::path& folder, const std::function<void(double)>& progress,
    std::size_t worth_keeping)
{
    if (folder.empty() || world.indices.size() < worth_keeping) {
        add_detail_levels(world, progress);
        return false;
    }
    const std::uint64_t key = levels_key(world);
    const std::filesystem::path file = folder / cache_key(key, ".detail");
    if (read_kept_levels(file, key, world))
        return false;
    add_detail_levels(world, progress);
    const Kept made = kept_of(world);
    try {
        write_kept(file, levels_kind, key,
            {bytes_of(made.primitives), bytes_of(made.pieces), bytes_of(made.levels), bytes_of(made.clusters),
                bytes_of(made.indices)});
    } catch (const InputError&) {
        return false;
    }
    return true;
}

} // namespace starbow
