#include "star_cull.h"
#include "scratch.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace starbow {
namespace {

constexpr std::size_t most_patches = 2048, least_stars = 16;
constexpr double spot_texels = 128; ///< exceeds a glare's radius in pixels also where pixels are coarser than the image
constexpr std::uint32_t gap = 64; ///< stars: drawing a gap of so many takes less time than another draw

/// An image's pyramid of directions from the eye: unit normals of its four sides, inwards, and a margin outside that
/// still counts.
struct Pyramid {
    std::array<glm::dvec3, 4> sides;
    double margin_rad;
};

Pyramid pyramid_of(int face, const Rect& rect, double texels_per_unit)
{
    const glm::dvec2 &low = rect.low, &high = rect.high;
    const glm::dvec3 corners[] = {face_direction(face, low), face_direction(face, {high.x, low.y}),
        face_direction(face, high), face_direction(face, {low.x, high.y})};
    const glm::dvec3 middle = corners[0] + corners[2];
    Pyramid pyramid{{}, spot_texels / texels_per_unit};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 side = glm::normalize(glm::cross(corners[i], corners[(i + 1) % 4]));
        pyramid.sides[i] = glm::dot(side, middle) < 0 ? -side : side;
    }
    return pyramid;
}

} // namespace

std::vector<StarPatch> star_patches(std::span<const shared::StarEntry> stars, std::vector<StarPatch> before)
{
    std::vector<StarPatch> patches = std::move(before);
    patches.clear();
    const std::size_t each = std::max(least_stars, (stars.size() + most_patches - 1) / most_patches);
    for (std::size_t first = 0; first < stars.size(); first += each) {
        const auto own = stars.subspan(first, std::min(each, stars.size() - first));
        glm::dvec3 sum(0);
        for (const shared::StarEntry& star : own)
            sum += glm::dvec3(star.direction);
        const glm::dvec3 axis = glm::length(sum) > 1e-3 ? glm::normalize(sum) : glm::dvec3(0, 1, 0);
        double farthest = 0; // the square of a chord
        for (const shared::StarEntry& star : own) {
            const glm::dvec3 off = glm::dvec3(star.direction) - axis;
            farthest = std::max(farthest, glm::dot(off, off));
        }
        const double radius = 2 * std::asin(std::min(0.5 * std::sqrt(farthest), 1.0));
        patches.push_back({axis, radius, std::uint32_t(first), std::uint32_t(own.size())});
    }
    return patches;
}

std::vector<StarRun> stars_in(std::span<const PlannedImage> images, std::span<const StarPatch> patches,
    const glm::dmat3& cube_from_world, std::vector<StarRun> before)
{
    std::array<Pyramid, TILE_COUNT> all; // around each tile's images
    std::size_t count = 0;
    for (std::span<const PlannedImage> left = images; !left.empty();) {
        const std::span<const PlannedImage> own = of_first_tile(left);
        left = left.subspan(own.size());
        Rect rect;
        double coarsest = own[0].texels_per_unit;
        for (const PlannedImage& image : own) {
            rect.add({image.low, image.high});
            coarsest = std::min(coarsest, image.texels_per_unit);
        }
        all[count++] = pyramid_of(own[0].face, rect, coarsest);
    }
    const std::span pyramids(all.data(), count);
    std::vector<StarRun> runs = std::move(before);
    runs.clear();
    for (const StarPatch& patch : patches) {
        const glm::dvec3 axis = cube_from_world * patch.axis;
        const bool seen = std::any_of(pyramids.begin(), pyramids.end(), [&](const Pyramid& pyramid) {
            const double reach = patch.radius_rad + pyramid.margin_rad;
            return reach > 1.5
                || std::all_of(pyramid.sides.begin(), pyramid.sides.end(),
                    [least = -std::sin(reach), &axis](const glm::dvec3& side) { return glm::dot(side, axis) >= least; });
        });
        if (!seen)
            continue;
        if (!runs.empty() && patch.first <= runs.back().first + runs.back().count + gap)
            runs.back().count = patch.first + patch.count - runs.back().first;
        else
            runs.push_back({patch.first, patch.count});
    }
    reserve_headroom(runs);
    return runs;
}

} // namespace starbow
