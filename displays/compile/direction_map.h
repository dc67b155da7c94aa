#pragma once
#include "displays/projections/views.h"
#include "displays/warp/mesh.h"
#include <span>
#include <vector>

namespace starbow {

/// A view as a map of directions for the device, rows from the top. xyz: unit direction of the pixel's centre in the
/// cockpit's frame; w: pixel angle in radians. All are 0 where nothing is shown.
struct DirectionMap {
    glm::ivec2 size{0};
    int channels = 1; ///< 3 where red, green and blue have directions of their own: one whole picture after the other
    std::vector<glm::vec4> texels;
    std::vector<float> intensity; ///< by pixel, from a calibration; empty: 1 everywhere

    const glm::vec4& at(int x, int y, int channel = 0) const
    {
        return texels[(std::size_t(channel) * size.y + y) * size.x + x];
    }
};

/// Compiles a view in double, on all cores. mesh: the calibration's warp mesh, or null. The pixel angle is the root of
/// the pixel's solid angle, but at least half the distance to the farther neighbour. Where a projection stretches a point
/// into a line, the solid angle of its sliver-shaped pixels goes to 0 while their length stays.
DirectionMap compile_direction_map(const View& view, const WarpMesh* mesh = nullptr);

/// Writes rows of one channel as the device reads them, 8 bytes a texel. The direction is on an octahedron's unfolded net
/// (Meyer et al., On floating-point normal vectors, 2010), 24 bits a coordinate, 2.6e-7 radians at worst. Below each
/// coordinate are 8 bits of the pixel angle's float, 0.4 % at worst. view.glsl's unpacked is the inverse. All bits are 0
/// where nothing is shown.
void pack_rows(const DirectionMap& map, int channel, int first_row, int rows, std::span<glm::uvec2> to);

/// The picture that a calibration warps: the file's own frustum, if it has one and the layout gives no projection; for a
/// fisheye the square around it.
Picture warped_picture(const View& view, const WarpMesh& mesh, bool projection_given);

/// The unit direction in the cockpit that a calibration shows at one of its samples; nullopt if it shows none. source:
/// warped_picture; rays: of source; turn: from the axes of a calibration that holds directions.
std::optional<glm::dvec3> warped_direction(const WarpMesh& mesh, const Picture& source, const PictureRays& rays,
    const glm::dmat3& turn, const WarpSample& sample, int channel);

/// M for unwarped views whose direction is linear in the pixel; nullopt for other views. The direction is along M (x, y, 1),
/// x and y in pixels from the view's corner.
std::optional<glm::dmat3> view_matrix(const View& view);

} // namespace starbow
