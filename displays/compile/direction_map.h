#pragma once
#include "displays/projections/views.h"
#include "displays/warp/mesh.h"
#include <vector>

namespace starbow {

/// A view compiled for the device. Rows from the top; xyz: unit direction of the pixel's centre in the cockpit's frame,
/// w: pixel angle in radians; all 0 where nothing is shown.
struct DirectionMap {
    glm::ivec2 size{0};
    int channels = 1; ///< 3 where red, green and blue look different ways: one whole picture after the other
    std::vector<glm::vec4> texels;
    std::vector<float> intensity; ///< of each pixel, from a calibration; empty: 1 everywhere

    const glm::vec4& at(int x, int y, int channel = 0) const
    {
        return texels[(std::size_t(channel) * size.y + y) * size.x + x];
    }
};

/// Compiles a view in double, on all cores. mesh: the calibration that bends it, or null. The pixel angle is the root of the
/// pixel's solid angle, but no less than half the way to the farther neighbour: where a projection draws a point out to a
/// line, its pixels are slivers whose solid angle goes to nothing while their length stays.
DirectionMap compile_direction_map(const View& view, const WarpMesh* mesh = nullptr);

/// The texels as the device reads them, 8 bytes each: the direction on an octahedron's unfolded net (Meyer et al., On
/// floating-point normal vectors, 2010), 24 bits a coordinate, 2.6e-7 radians at worst; below each coordinate 8 bits of
/// the pixel angle's float, 0.4 % at worst. view.glsl's unpacked undoes it. All 0 where nothing is shown.
std::vector<glm::uvec2> packed(const DirectionMap& map);

/// The picture that a calibration bends: the file's own frustum where it has one and the layout gives no projection; of a
/// fisheye the square around it.
Picture warped_picture(const View& view, const WarpMesh& mesh, bool projection_given);

/// The unit direction in the cockpit that a calibration shows at one of its samples; source: bent_picture, rays: of it;
/// turn: from the axes of a calibration that tells directions. Nothing where none is shown.
std::optional<glm::dvec3> warped_direction(const WarpMesh& mesh, const Picture& source, const PictureRays& rays,
    const glm::dmat3& turn, const WarpSample& sample, int channel);

/// For views whose direction is linear in the pixel and that nothing bends: direction is along M (x, y, 1), x and y in
/// pixels from the view's corner. Nothing for the others.
std::optional<glm::dmat3> view_matrix(const View& view);

} // namespace starbow
