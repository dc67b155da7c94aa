#pragma once
#include "mesh.h"
#include <string_view>

namespace starbow {

/// What a file holds, and its name as messages show it. Each reader below is a pure function of these; it throws InputError
/// "NAME: PLACE: ..." and allocates nothing that the bytes at hand do not warrant. README.md tells how each format is read.
struct WarpFile {
    std::string name;
    std::string_view content;
};

WarpMesh read_bourke(const WarpFile& file);
WarpMesh read_domeprojection(const WarpFile& file);
WarpMesh read_simcad(const WarpFile& file);
WarpMesh read_sciss(const WarpFile& file);
WarpMesh read_scalable(const WarpFile& file);
WarpMesh read_skyskan(const WarpFile& file);
WarpMesh read_obj(const WarpFile& file);
WarpMesh read_pfm(const WarpFile& file, bool first_row_on_top);
WarpMesh read_mpcdi(const WarpFile& file, const std::string& region, bool first_row_on_top);
WarpMesh read_headset(const WarpFile& file);

/// Any of them, told apart by its first bytes, then by its name.
WarpMesh read_warp(const WarpFile& file, const std::string& region, bool first_row_on_top);

/// domeprojection's second file.
struct WarpFrustum {
    Planar planar;
    glm::dvec3 eye_m{0};
};
WarpFrustum read_frustum(const WarpFile& file);
std::filesystem::path frustum_beside(const std::filesystem::path& mesh); ///< where it is looked for, and written

/// The file's text. `aspect`: width over height of the picture that the mesh covers. Both want Kind::picture and a grid, and
/// throw InputError with `name`, which is the mesh's, where it is otherwise. What is written reads back the same.
std::string write_bourke(const WarpMesh& mesh, const std::string& name, double aspect);
std::string write_domeprojection(const WarpMesh& mesh, const std::string& name);
std::string write_frustum(const WarpFrustum& frustum);

/// One value per cell of a mesh that resampled() or read_pfm() made; little-endian, the first row is the bottom one.
std::string write_pfm(const WarpMesh& mesh, const std::string& name);
bool is_centred(const WarpMesh& mesh); ///< such a mesh

/// What the mesh shows at the centres of a grid of cells over the viewport.
WarpMesh resampled(const WarpMesh& mesh, glm::ivec2 cells);

/// What the mesh shows at the vertices of a grid over the part of the viewport that it reaches into. Vertices beside the
/// mesh move to its outline, so that the grid ends where the mesh does.
WarpMesh gridded(const WarpMesh& mesh, glm::ivec2 vertices);

/// How much of the viewport only one of two meshes covers, in what the first covers.
double differs(const WarpMesh& mesh, const WarpMesh& other);

/// A picture of a mesh for people, RGBA8 in sRGB, rows from the top: colours stand for what is seen, lines are the mesh's,
/// holes are black, the viewport has a frame.
std::vector<std::uint8_t> portrait(const WarpMesh& mesh, glm::ivec2 size);

} // namespace starbow
