#pragma once
#include "direction_map.h"
#include <array>
#include <optional>

namespace starbow {

/// A bounding cone of a block's directions: the centre of each of its pixels lies within `radius` of `centre`.
struct BoundingCone {
    glm::vec3 centre{0}; ///< unit, cockpit's frame
    float radius = -1; ///< radians; below 0 where nothing is shown
    float finest = 0, coarsest = 0; ///< pixel angles in the block, radians
    bool empty() const { return radius < 0; }
};

/// The bounding cones of square blocks of a view's pixels, as a quadtree. The demand of a view then follows without a
/// visit to each pixel. Level 0 is one block; each level halves the side.
class ConeHierarchy {
public:
    /// From a map: the leaves have 8 x 8 pixels and enclose all of them.
    explicit ConeHierarchy(const DirectionMap& map);
    /// From a flat picture, direction = M (x, y, 1): cones go down to single pixels; those of small blocks are computed on
    /// request. M's first two columns are perpendicular.
    ConeHierarchy(const glm::dmat3& direction_from_pixel, glm::ivec2 size);

    glm::ivec2 size() const { return size_; }
    int levels() const { return levels_; }
    int side(int level) const { return leaf_ << (levels_ - 1 - level); } ///< pixels
    glm::ivec2 count(int level) const { return (size_ + side(level) - 1) / side(level); }
    BoundingCone cone(int level, glm::ivec2 block) const;
    bool flat() const { return flat_.has_value(); }

private:
    BoundingCone flat_cone(int level, glm::ivec2 block) const;
    glm::dvec2 nearest_point(glm::dvec2 first, glm::dvec2 last) const;

    glm::ivec2 size_;
    int leaf_, levels_;
    std::vector<std::vector<BoundingCone>> cones_; ///< by level, rows from the top; of a flat picture the coarser levels
    std::optional<glm::dmat3> flat_;
    glm::dvec2 foot_{0}; ///< foot of the perpendicular from the eye, pixels
    /// The dot products a.a, a.b and b.b of M's first two columns a and b; none where the two are perpendicular.
    std::optional<std::array<double, 3>> skew_;
    double unit_ = 0; ///< square root of M's determinant
};

/// The point, in pixels, at which a map (its first channel) shows a direction; nullopt if it does not show it. Directions
/// are treated as linear between pixels: accurate to a hundredth of a pixel for any smooth picture.
std::optional<glm::dvec2> find_pixel(const DirectionMap& map, const ConeHierarchy& cones, const glm::dvec3& direction);

/// A box around all pixels that may look into a pyramid from the eye, and the finest pixel angle among them. The box goes
/// from low to before high; both are 0 where no pixel does. sides: unit normals of its planes, pointing inwards.
struct PixelBox {
    glm::ivec2 low{0}, high{0};
    double finest = 1;
};
PixelBox pixels_in_pyramid(const ConeHierarchy& cones, std::span<const glm::dvec3> sides);

} // namespace starbow
