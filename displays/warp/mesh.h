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

/// The common form of all calibrations: triangles over the viewport with a sample at each corner. Holes have no triangles.
struct WarpMesh {
    enum class Kind {
        picture, ///< sees[0].xy: a place in an unwarped picture, fractions from its top left
        points, ///< sees[0]: the lit point of the screen, cockpit's frame, metres
        colours ///< sees: unit directions of red, green and blue in the axes of a picture without turn (-z ahead)
    } kind
        = Kind::picture;
    std::vector<WarpVertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    glm::ivec2 grid{0}; ///< columns and rows of the vertices, rows from the top, where they are a grid; else 0
    glm::ivec2 cells{0}; ///< of a map: its columns and rows; its vertices are their centres, and an edge around them
    bool of_viewport = false; ///< the picture is the viewport's own, of a fisheye, too; else it is a square under a fisheye
    std::optional<Planar> frustum; ///< of the unwarped picture, where the file has one
    std::optional<glm::dvec3> eye_m; ///< the eye, where the file has one
    std::string format; ///< for people: "Bourke mesh", "MPCDI 2.0, profile 3d, region left" ...
    std::vector<std::string> notes; ///< for people: accepted oddities
    std::vector<std::string> warnings; ///< for people: signs that the file is read otherwise than it was written
    // Members of an MPCDI file; empty elsewhere. Rows from the top, values 0 to 1 as the file has them.
    struct Mask {
        glm::ivec2 size{0};
        int channels = 1;
        double gamma = 1; ///< light = value^gamma
        std::vector<float> values;
    };
    std::optional<Mask> alpha, beta; ///< the factor of the light, and the addend
};

/// The bytes of a calibration file, at most 512 MiB. Throws InputError.
std::string read_warp_bytes(const std::filesystem::path& file);

/// Reads any supported format, recognised by content and name. Throws InputError with the file, the place in it, the
/// problem and what would be right. displays/warp/README.md describes each format and its reading.
WarpMesh load_warp(const Warp& warp);

/// A mesh's sample at one pixel's centre.
struct WarpSample {
    bool shown = false;
    double intensity = 0;
    std::array<glm::dvec3, 3> sees{}; ///< interpolated
};

/// Reads a mesh pixel by pixel: the mesh over a viewport of `size` pixels.
class WarpRaster {
public:
    WarpRaster(const WarpMesh& mesh, glm::ivec2 size); ///< the mesh must outlive it
    /// Fills row y (from the top): samples.size() == size.x. Several threads may call it. Where triangles overlap, the
    /// first in the file counts; a centre on a shared edge belongs to exactly one of its triangles. Returns its steps, the
    /// measure of its time: the triangles that it looked at, and for each of them the centres that it compared.
    std::size_t row(int y, std::span<WarpSample> samples) const;

private:
    const WarpMesh& mesh_;
    glm::ivec2 size_;
    std::vector<std::uint32_t> first_, triangles_; ///< by band of rows: where its triangles begin
};

} // namespace starbow
