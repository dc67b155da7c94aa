#include "tiles.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double band_edges[SIDE_BANDS + 1] = {-1, -0.5, 0, 1};

Rect rect_of(int tile)
{
    if (tile == TILE_FRONT)
        return {{-1, -1}, {1, 1}};
    if (tile < TILE_REAR) {
        const int band = (tile - TILE_SIDES) % SIDE_BANDS;
        return {{-1, band_edges[band]}, {1, band_edges[band + 1]}};
    }
    const double half = std::exp2(-0.5 * (tile - TILE_REAR));
    return {{-half, -half}, {half, half}};
}

/// Behind, sub-tiles are evenly spaced in the square of the face coordinates, as D is: none lies across a nested square's
/// edge.
double spread_out(bool rear, double at) { return rear ? at * std::abs(at) : at; }
double drawn_in(bool rear, double at) { return rear ? std::copysign(std::sqrt(std::abs(at)), at) : at; }

/// The tables that are the same in each frame.
struct Tiles {
    std::array<Rect, TILE_COUNT> rects;
    std::array<glm::dvec4, TILE_COUNT> sub_tiles_from_face;
    Tiles()
    {
        for (int tile = 0; tile < TILE_COUNT; ++tile) {
            const Rect own = rects[std::size_t(tile)] = rect_of(tile);
            for (int i = 0; i < 2; ++i) {
                const double low = spread_out(tile >= TILE_REAR, own.low[i]),
                             high = spread_out(tile >= TILE_REAR, own.high[i]);
                sub_tiles_from_face[std::size_t(tile)][i] = TILE_SUB_TILES / (high - low);
                sub_tiles_from_face[std::size_t(tile)][2 + i] = -low * TILE_SUB_TILES / (high - low);
            }
        }
    }
};
const Tiles fixed;

} // namespace

const Rect& tile_rect(int tile) { return fixed.rects[std::size_t(tile)]; }
const glm::dvec4& sub_tiles_from_face(int tile) { return fixed.sub_tiles_from_face[std::size_t(tile)]; }

glm::dvec3 face_direction(int face, const glm::dvec2& at)
{
    glm::dvec3 n;
    n[face_axis[face]] = face_sign[face];
    n[face_a[face]] = at.x;
    n[face_b[face]] = at.y;
    return n;
}

int tile_face(int tile) { return tile == TILE_FRONT ? 0 : tile >= TILE_REAR ? 1 : 2 + (tile - TILE_SIDES) / SIDE_BANDS; }

double clip_hole(int tile, int finest_clip_level)
{
    return tile >= TILE_REAR && tile < TILE_REAR + finest_clip_level ? std::exp2(-0.5 * (tile + 1 - TILE_REAR)) : 0;
}

int clip_level(double larger, int finest_clip_level)
{
    // floor(-log2(larger^2)); an exact power of two goes to the coarser image. The shader reads the same from the
    // exponent's bits.
    int exponent;
    std::frexp(larger * larger, &exponent); // = [0.5, 1) 2^exponent
    return larger > 0 ? std::clamp(-exponent, 0, finest_clip_level) : finest_clip_level;
}

TilePlace tile_of(const glm::dvec3& n, int finest_clip_level)
{
    const glm::dvec3 m = glm::abs(n);
    int face;
    if (m.z >= std::max(m.x, m.y))
        face = n.z >= 0 ? 0 : 1;
    else if (m.x >= m.y)
        face = n.x >= 0 ? 2 : 3;
    else
        face = n.y >= 0 ? 4 : 5;
    const glm::dvec2 at = glm::dvec2(n[face_a[face]], n[face_b[face]]) / m[face_axis[face]];
    if (face == 0)
        return {TILE_FRONT, face, at};
    if (face == 1)
        return {TILE_REAR + clip_level(std::max(std::abs(at.x), std::abs(at.y)), finest_clip_level), face, at};
    const int band = (at.y > band_edges[1]) + (at.y > band_edges[2]);
    return {TILE_SIDES + (face - 2) * SIDE_BANDS + band, face, at};
}

Rect sub_tiles_rect(int tile, const SubTiles& sub_tiles)
{
    const bool rear = tile >= TILE_REAR;
    const glm::dvec4& from_face = sub_tiles_from_face(tile);
    Rect rect;
    for (int i = 0; i < 2; ++i) {
        rect.low[i] = drawn_in(rear, (sub_tiles.first[i] - from_face[2 + i]) / from_face[i]);
        rect.high[i] = drawn_in(rear, (sub_tiles.first[i] + sub_tiles.count[i] - from_face[2 + i]) / from_face[i]);
    }
    return rect;
}

SubTiles sub_tiles_in(int tile, const Rect& part)
{
    const bool rear = tile >= TILE_REAR;
    const glm::dvec4& from_face = sub_tiles_from_face(tile);
    SubTiles sub_tiles;
    for (int i = 0; i < 2; ++i) {
        auto sub_tile = [&](double at) { return spread_out(rear, at) * from_face[i] + from_face[2 + i]; };
        sub_tiles.first[i] = std::clamp(int(std::floor(sub_tile(part.low[i]))), 0, TILE_SUB_TILES - 1);
        sub_tiles.count[i] = std::clamp(int(std::ceil(sub_tile(part.high[i]))), sub_tiles.first[i] + 1, TILE_SUB_TILES)
            - sub_tiles.first[i];
    }
    return sub_tiles;
}

const SubTileTable& sub_tile_table(int tile)
{
    static const auto all = [] {
        std::array<SubTileTable, TILE_COUNT> all;
        for (int tile = 0; tile < TILE_COUNT; ++tile)
            for (int i = 0; i < SUB_TILE_COUNT; ++i) {
                SubTileTable& table = all[std::size_t(tile)];
                const std::size_t sub_tile = std::size_t(i);
                const glm::ivec2 at(i % TILE_SUB_TILES, i / TILE_SUB_TILES);
                const Rect rect = table.rects[sub_tile] = sub_tiles_rect(tile, {at, {1, 1}});
                const glm::ivec2 off = glm::abs(2 * at + 1 - TILE_SUB_TILES); // distance from the middle, in half sub-tiles
                table.in_clip_hole[sub_tile] = tile >= TILE_REAR && std::max(off.x, off.y) < TILE_SUB_TILES / 2;
                // The extremes are at corners, because no sub-tile lies across an axis of its face.
                double& least = table.least_cos_half_square[sub_tile] = 1;
                double& most = table.most_cos_half_square[sub_tile] = 0;
                for (const glm::dvec2& corner :
                    {rect.low, rect.high, glm::dvec2(rect.low.x, rect.high.y), glm::dvec2(rect.high.x, rect.low.y)}) {
                    const glm::dvec3 n = face_direction(tile_face(tile), corner);
                    // (1 + cos) / 2, in a form without cancellation behind
                    const double length = glm::length(n), across_square = n.x * n.x + n.y * n.y;
                    const double own = n.z > 0 ? 0.5 * (1 + n.z / length) : 0.5 * across_square / (length * (length - n.z));
                    least = std::min(least, own), most = std::max(most, own);
                }
            }
        return all;
    }();
    return all[std::size_t(tile)];
}

} // namespace starbow
