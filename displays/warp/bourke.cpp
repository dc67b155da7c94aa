#include "parts.h"
#include <algorithm>
#include <charconv>
#include <cmath>

namespace starbow {
namespace {

constexpr Range any{-1e30, 1e30};

} // namespace

static WarpMesh read_bourke(const WarpFile& file, std::optional<double> wanted)
{
    Lines lines(file);
    WarpMesh mesh;
    mesh.format = "Bourke mesh";
    lines.want("2, the type of a rectangular grid,");
    if (lines.number(lines.fields(1, "2, the type of a rectangular grid,")[0], any) != 2)
        lines.refuse(in_quotes(lines.text()) + " is a type that is not read; 2, a rectangular grid, is right");
    lines.want("columns and rows");
    const auto counts = lines.fields(2, "columns and rows");
    mesh.grid = {lines.integer(counts[0], 2, most_grid), lines.integer(counts[1], 2, most_grid)};
    const std::size_t count = std::size_t(mesh.grid.x) * std::size_t(mesh.grid.y);
    if (count > lines.bytes_left() / 10 + 1) // "0 0 0 0 0" and the line's end
        lines.refuse(in_quotes(lines.text()) + " announces " + std::to_string(count) + " vertices, for which the file's "
            + std::to_string(lines.bytes_left()) + " further bytes are too few; the numbers of columns and rows are right");

    std::vector<char> holes(count);
    mesh.vertices.reserve(count);
    double aspect = 0;
    for (std::size_t i = 0; i < count; ++i) {
        lines.want("x y u v i");
        const auto& f = lines.fields(5, "x y u v i");
        const double x = lines.number(f[0], position_range), y = lines.number(f[1], position_range);
        const double u = lines.number(f[2], any), v = lines.number(f[3], any), intensity = lines.number(f[4], any);
        holes[i] = intensity < 0 || u < 0 || u > 1 || v < 0 || v > 1;
        if (!holes[i] && intensity > 1000)
            lines.refuse(in_quotes(f[4]) + " is too large; a brightness from 0 to 1000, or below 0 for a hole, is right");
        aspect = std::max(aspect, std::abs(x));
        mesh.vertices.push_back(
            {{x, (1 - y) / 2}, holes[i] ? 0 : intensity, {glm::dvec3(holes[i] ? glm::dvec2(0) : glm::dvec2(u, 1 - v), 0)}});
    }
    std::string from = "the largest x";
    if (lines.next()) {
        const auto& f = lines.fields();
        if (f.size() != 2 || f[0] != "aspect")
            lines.refuse(in_quotes(lines.text()) + " comes after the last of " + std::to_string(count)
                + " vertices; as many rows as the second line says is right");
        aspect = lines.number(f[1], {0.01, 100});
        from = "its last line";
        if (lines.next())
            lines.refuse(in_quotes(lines.text()) + " comes after the end; nothing more is right");
    }
    if (wanted)
        aspect = *wanted, from = "the layout";
    if (!(aspect >= 0.01))
        refuse(file, "", "has no width; x from -aspect to aspect is right");
    for (WarpVertex& vertex : mesh.vertices)
        vertex.at.x = (vertex.at.x / aspect + 1) / 2;
    mesh.notes.push_back("aspect " + shown(aspect) + ", from " + from);
    join_grid(mesh, holes);
    rows_from_top(mesh);
    check_mesh(mesh, file);
    return mesh;
}

extern const WarpFormat bourke_format{.name = "Bourke mesh",
    .endings = {".data", ".map"},
    .read = [](const WarpFile& file, const WarpReading& reading) { return read_bourke(file, reading.aspect); },
    .seems = [](const WarpStart& start) { return start.line == "2"; },
    .has_aspect = true};

} // namespace starbow
