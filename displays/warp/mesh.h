#pragma once
#include "config/model/layout.h"
#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace starbow {

/// One measured point of a calibration.
struct WarpVertex {
    glm::dvec2 at{0}; ///< in the viewport, fractions from its top left; may lie outside
    double intensity = 1; ///< multiplies the light, linear
    std::array<glm::dvec3, 3> sees{}; ///< see WarpMesh::Kind; the second and third only of `colours`
};

/// A calibration as every format is read: triangles over the viewport, each corner of which knows what it shows. Holes have
/// no triangles.
struct WarpMesh {
    enum class Kind {
        picture, ///< sees[0].xy: a place in a picture that is not bent, fractions from its top left
        points, ///< sees[0]: the lit point of the screen, cockpit's frame, metres
        colours ///< sees: unit directions of red, green and blue in the axes of a picture without turn (-z ahead)
    } kind
        = Kind::picture;
    std::vector<WarpVertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    glm::ivec2 grid{0}; ///< columns and rows of the vertices, rows from the top, where they are a grid; else 0
    glm::ivec2 cells{0}; ///< of a map: its columns and rows; its vertices are their centres, and an edge around them
    std::optional<Planar> frustum; ///< what the picture that is not bent shows, where the file says
    std::optional<glm::dvec3> eye_m; ///< from where, where the file says
    std::string format; ///< for people: "Bourke mesh", "MPCDI 2.0, profile 3d, region left" ...
    std::vector<std::string> notes; ///< for people: what was odd and still let pass
    // What an MPCDI file brings besides; empty elsewhere. Rows from the top, values 0 to 1 as the file has them.
    struct Mask {
        glm::ivec2 size{0};
        int channels = 1;
        double gamma = 1; ///< light = value^gamma
        std::vector<float> values;
    };
    std::optional<Mask> alpha, beta; ///< multiplies the light; is added to it
};

/// Reads any supported format, told apart by content and name. Throws InputError with the file, the place in it, what is
/// wrong and what would be right. See displays/warp/README.md for what each format says and how it is read here.
WarpMesh load_warp(const Warp& warp);

/// What a mesh shows at one pixel's centre.
struct WarpSample {
    bool shown = false;
    double intensity = 0;
    std::array<glm::dvec3, 3> sees{}; ///< interpolated
};

/// Reads a mesh pixel by pixel: the mesh over a viewport of `size` pixels.
class WarpRaster {
public:
    WarpRaster(const WarpMesh& mesh, glm::ivec2 size); ///< the mesh must outlive it
    /// All of row y (from the top): samples.size() == size.x. Safe to call from several threads. Where triangles overlap the
    /// first in the file counts; a centre on a shared edge belongs to one of its triangles, never to none.
    void row(int y, std::span<WarpSample> samples) const;

private:
    const WarpMesh& mesh_;
    glm::ivec2 size_;
    std::vector<std::uint32_t> first_, triangles_; ///< of each band of rows: where its triangles begin
};

} // namespace starbow
