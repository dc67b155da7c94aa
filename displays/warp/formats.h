#pragma once
#include "mesh.h"
#include <array>
#include <span>
#include <string_view>

namespace starbow {

/// A file's bytes and its name in messages.
struct WarpFile {
    std::string name;
    std::string_view content;
};

/// A layout's members about the content of a calibration file.
struct WarpReading {
    std::string region{}; ///< of MPCDI; empty: the only one
    FloatMapForm form{};
    std::optional<double> aspect{}; ///< the x of a Bourke mesh's right edge; none: the file's own
};

/// The beginning of a file, by which a format is recognised.
struct WarpStart {
    std::string_view bytes;
    std::string_view text; ///< from the first character on
    std::string_view line; ///< the first one of the text
};

/// A calibration format. Its reader is a pure function of a file's bytes; it throws InputError "NAME: PLACE: ..." and
/// allocates no more than the bytes warrant. README.md describes how each format is read.
struct WarpFormat {
    const char* name; ///< the beginning of WarpMesh::format
    std::array<std::string_view, 2> endings; ///< of files' names; empty: fewer
    bool (*begins)(const WarpStart&) = nullptr; ///< true if the first bytes say that it is this format; null: never
    WarpMesh (*read)(const WarpFile&, const WarpReading&);
    bool (*seems)(const WarpStart&) = nullptr; ///< the same, less surely, where neither bytes nor a name say a format
    bool has_regions = false, has_form = false, has_aspect = false; ///< what a layout may say about it
};
/// All of them, in the order of messages.
std::span<const WarpFormat* const> warp_formats();

/// A float map as a format's own file, or as a part of another's.
WarpMesh read_pfm(const WarpFile& file, const FloatMapForm& form);

/// Reads any of the formats, recognised by its first bytes, then by its name.
WarpMesh read_warp(const WarpFile& file, const WarpReading& reading);

/// domeprojection's second file.
struct WarpFrustum {
    Planar planar;
    glm::dvec3 eye_m{0};
};
WarpFrustum read_frustum(const WarpFile& file);
std::filesystem::path frustum_beside(const std::filesystem::path& mesh); ///< the place where it is looked for, and written

/// The mesh as a file's text. `aspect`: width over height of the picture that the mesh covers. Both functions need
/// Kind::picture and a grid, and throw InputError with `name`, the mesh's, otherwise. Their files read back as the same
/// mesh.
std::string write_bourke(const WarpMesh& mesh, const std::string& name, double aspect);
std::string write_domeprojection(const WarpMesh& mesh, const std::string& name);
std::string write_frustum(const WarpFrustum& frustum);

/// One value per cell of a mesh that resampled() or read_pfm() made; little-endian, the first row is the bottom one.
std::string write_pfm(const WarpMesh& mesh, const std::string& name);
bool is_centred(const WarpMesh& mesh); ///< true for such a mesh

/// The mesh's samples at the centres of a grid of cells over the viewport.
WarpMesh resampled(const WarpMesh& mesh, glm::ivec2 cells);

/// The mesh's samples at the vertices of a grid over the part of the viewport that it reaches into. Vertices beside the
/// mesh move to its outline, so that the grid ends where the mesh does.
WarpMesh gridded(const WarpMesh& mesh, glm::ivec2 vertices);

/// The part of the viewport that only one of two meshes covers, over the first mesh's part.
double differs(const WarpMesh& mesh, const WarpMesh& other);

/// A picture of a mesh for people, RGBA8 in sRGB, rows from the top. Colours stand for its samples, lines are the mesh's,
/// holes are black, and the viewport has a frame.
std::vector<std::uint8_t> portrait(const WarpMesh& mesh, glm::ivec2 size);

} // namespace starbow
