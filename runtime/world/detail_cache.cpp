#include "detail_cache.h"
#include "config/json/error.h"
#include "config/json/hash.h"
#include "config/json/kept_file.h"
#include "config/json/whole_file.h"
#include "detail.h"
#include "pieces.h"
#include <meshoptimizer.h>
#include <span>
#include <type_traits>

namespace starbow {
namespace {

/// Another way of making levels has another number.
constexpr std::uint64_t version = 4;

struct Header {
    char magic[8] = {'S', 't', 'a', 'r', 'b', 'o', 'w', 'D'};
    std::uint64_t key = 0; ///< of the world without its levels
    std::uint64_t primitives = 0, pieces = 0, levels = 0, clusters = 0, indices = 0;
    std::uint64_t content = 0; ///< hash of everything that follows; a damaged file is not read
};

/// The detail levels, pieces and clusters of a primitive, in the file's form. The records are plain numbers without gaps.
struct KeptPrimitive {
    std::uint32_t levels, first_cluster, clusters, first_piece, pieces;
};
struct KeptGroup {
    double low[3], high[3], error, shading, apart;
};
struct KeptPiece {
    double low[3], high[3];
    std::uint32_t first_index, indices, first_cluster, clusters;
    KeptGroup own, coarser;
};
struct KeptLevel {
    double error, shading, apart;
    std::uint32_t first_index, indices, first_cluster, clusters;
};
static_assert(
    std::has_unique_object_representations_v<KeptPrimitive> && sizeof(KeptLevel) == 40 && sizeof(KeptPiece) == 208);
static_assert(std::is_trivially_copyable_v<Cluster> && sizeof(Cluster) == 40);

template <class T> std::span<const unsigned char> bytes_of(const std::vector<T>& values)
{
    return {reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(T)};
}

std::uint64_t key_of(const World& world)
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

/// The content of a cache file behind its header.
struct Kept {
    std::vector<KeptPrimitive> primitives;
    std::vector<KeptPiece> pieces;
    std::vector<KeptLevel> levels;
    std::vector<Cluster> clusters;
    std::vector<std::uint32_t> indices;

    std::uint64_t content() const
    {
        ContentHash hash;
        for (const std::span<const unsigned char> part :
            {bytes_of(primitives), bytes_of(pieces), bytes_of(levels), bytes_of(clusters), bytes_of(indices)})
            hash.add(part.data(), part.size());
        return hash.value();
    }
};

bool read_kept(const std::filesystem::path& path, std::uint64_t key, const World& world, Kept& kept)
{
    RegularFile file(path);
    Header header;
    const Header right;
    const auto read = [&](void* to, std::size_t bytes) { return file.read({static_cast<char*>(to), bytes}) == bytes; };
    if (!read(&header, sizeof header) || std::memcmp(header.magic, right.magic, sizeof right.magic) != 0 || header.key != key
        || header.primitives != world.primitives.size())
        return false;
    // Each count is bounded before the product of any is taken.
    for (const std::uint64_t count : {header.pieces, header.levels, header.clusters, header.indices})
        if (count > file.size())
            return false;
    if (file.size()
        != sizeof header + header.primitives * sizeof(KeptPrimitive) + header.pieces * sizeof(KeptPiece)
            + header.levels * sizeof(KeptLevel) + header.clusters * sizeof(Cluster) + header.indices * sizeof(std::uint32_t))
        return false;
    kept.primitives.resize(header.primitives), kept.pieces.resize(header.pieces), kept.levels.resize(header.levels);
    kept.clusters.resize(header.clusters), kept.indices.resize(header.indices);
    const auto fill = [&](auto& values) { return read(values.data(), bytes_of(values).size()); };
    if (!fill(kept.primitives) || !fill(kept.pieces) || !fill(kept.levels) || !fill(kept.clusters) || !fill(kept.indices)
        || kept.content() != header.content)
        return false;
    std::uint64_t levels = 0, pieces = 0;
    for (const KeptPrimitive& primitive : kept.primitives)
        levels += primitive.levels, pieces += primitive.pieces;
    return levels == header.levels && pieces == header.pieces;
}

void take(Kept&& kept, World& world)
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
    const auto group = [&](const KeptGroup& g) { return PieceGroup{vec(g.low), vec(g.high), g.error, g.shading, g.apart}; };
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
        return KeptGroup{{g.low.x, g.low.y, g.low.z}, {g.high.x, g.high.y, g.high.z}, g.error, g.shading, g.apart};
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

bool add_kept_detail_levels(World& world, const std::filesystem::path& folder, const std::function<void(double)>& progress,
    std::size_t worth_keeping)
{
    if (folder.empty() || world.indices.size() < worth_keeping) {
        add_detail_levels(world, progress);
        return false;
    }
    Header header;
    header.key = key_of(world);
    const std::filesystem::path file = folder / kept_name(header.key, ".detail");
    Kept kept;
    if (read_kept(file, header.key, world, kept)) {
        take(std::move(kept), world);
        mark_as_read(file);
        return false;
    }
    add_detail_levels(world, progress);
    kept = kept_of(world);
    header.primitives = kept.primitives.size(), header.pieces = kept.pieces.size(), header.levels = kept.levels.size();
    header.clusters = kept.clusters.size(), header.indices = kept.indices.size();
    header.content = kept.content();
    try {
        write_own(file,
            {{reinterpret_cast<const unsigned char*>(&header), sizeof header}, bytes_of(kept.primitives),
                bytes_of(kept.pieces), bytes_of(kept.levels), bytes_of(kept.clusters), bytes_of(kept.indices)});
    } catch (const InputError&) {
        return false;
    }
    return true;
}

} // namespace starbow
