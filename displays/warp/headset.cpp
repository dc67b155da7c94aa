#include "parts.h"

namespace starbow {

static WarpMesh read_headset(const WarpFile& file)
{
    Lines lines(file);
    WarpMesh mesh;
    mesh.format = "headset mesh";
    mesh.kind = WarpMesh::Kind::colours;
    const std::string header = "starbow headset mesh 1";
    lines.want(header);
    if (lines.text() != header)
        lines.refuse(in_quotes(lines.text()) + " is not this format's first line; " + header + " is right");
    lines.want("columns and rows");
    const auto counts = lines.fields(2, "columns and rows");
    mesh.grid = {lines.integer(counts[0], 2, most_grid), lines.integer(counts[1], 2, most_grid)};
    const std::size_t count = std::size_t(mesh.grid.x) * std::size_t(mesh.grid.y);
    if (count > lines.bytes_left() / 16 + 1)
        lines.refuse(in_quotes(lines.text()) + " announces " + std::to_string(count) + " vertices, for which the file's "
            + std::to_string(lines.bytes_left()) + " further bytes are too few; the numbers of columns and rows are right");
    const Range tangent{-100, 100};
    mesh.vertices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string right = "x y and the tangents rx ry gx gy bx by";
        lines.want(right);
        const auto& f = lines.fields(8, right);
        WarpVertex vertex;
        vertex.at = {lines.number(f[0], position_range), lines.number(f[1], position_range)};
        for (std::size_t c = 0; c < 3; ++c)
            vertex.sees[c]
                = glm::normalize(glm::dvec3(lines.number(f[2 + 2 * c], tangent), lines.number(f[3 + 2 * c], tangent), -1));
        mesh.vertices.push_back(vertex);
    }
    if (lines.next())
        lines.refuse(in_quotes(lines.text()) + " comes after the last of " + std::to_string(count)
            + " vertices; as many rows as the second line says is right");
    join_grid(mesh, std::vector<char>(count));
    check_mesh(mesh, file);
    return mesh;
}

extern const WarpFormat headset_format{.name = "headset mesh",
    .endings = {},
    .begins = [](const WarpStart& start) { return start.line.starts_with("starbow headset"); },
    .read = [](const WarpFile& file, const WarpReading&) { return read_headset(file); }};

} // namespace starbow
