#include "parts.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace starbow {

static WarpMesh read_domeprojection(const WarpFile& file)
{
    Lines lines(file);
    WarpMesh mesh;
    mesh.format = "domeprojection mesh";
    const std::string header = "x;y;u;v;column;row";
    lines.want(header);
    if (lines.text() != header)
        lines.refuse(in_quotes(lines.text()) + " is not this format's first line; " + header + " is right");

    struct Entry {
        WarpVertex vertex;
        int column, row;
    };
    std::vector<Entry> entries;
    int columns = 0, rows = 0;
    while (lines.next()) {
        const auto& f = lines.fields(6, header, ';');
        Entry e;
        e.vertex.at = {lines.number(f[0], position_range), lines.number(f[1], position_range)};
        e.vertex.sees[0] = {lines.number(f[2], picture_range), lines.number(f[3], picture_range), 0};
        e.column = lines.integer(f[4], 0, most_grid - 1);
        e.row = lines.integer(f[5], 0, most_grid - 1);
        columns = std::max(columns, e.column + 1);
        rows = std::max(rows, e.row + 1);
        entries.push_back(e);
    }
    if (columns < 2 || rows < 2)
        refuse(file, "",
            "has " + std::to_string(columns) + " columns and " + std::to_string(rows)
                + " rows; at least 2 of each are right");
    // Missing vertices are holes, but a number that is merely wrong must not blow the grid up.
    const std::size_t count = std::size_t(columns) * std::size_t(rows);
    if (count > 4 * entries.size())
        refuse(file, "",
            "has " + std::to_string(entries.size()) + " vertices for a grid of " + std::to_string(columns) + " x "
                + std::to_string(rows) + "; at least a quarter of them is right");
    mesh.grid = {columns, rows};
    mesh.vertices.resize(count);
    std::vector<char> holes(count, 1);
    for (const Entry& e : entries) {
        const std::size_t i = std::size_t(e.row) * std::size_t(columns) + std::size_t(e.column);
        if (!holes[i])
            refuse(file, "column " + std::to_string(e.column) + ", row " + std::to_string(e.row),
                "is there twice; each vertex once is right");
        holes[i] = 0;
        mesh.vertices[i] = e.vertex;
    }
    for (std::size_t i = 0; i < count; ++i)
        if (holes[i])
            mesh.vertices[i].intensity = 0;
    join_grid(mesh, holes);
    check_mesh(mesh, file);
    return mesh;
}

WarpFrustum read_frustum(const WarpFile& file)
{
    Lines lines(file);
    lines.want("x;y;z;heading;pitch;bank;left;right;bottom;top;...");
    const std::vector<std::string_view> names = lines.fields(';');
    lines.want("the frustum's numbers");
    const std::vector<std::string_view> values
        = lines.fields(names.size(), "as many values as the first line has names", ';');
    const auto value = [&](std::string_view name, Range range) {
        const auto at = std::find(names.begin(), names.end(), name);
        if (at == names.end())
            refuse(file, "line 1", in_quotes(name) + " is missing; x;y;z;heading;pitch;bank;left;right;bottom;top is right");
        return lines.number(values[std::size_t(at - names.begin())], range);
    };
    WarpFrustum frustum;
    frustum.eye_m = {value("x", metre_range), value("y", metre_range), value("z", metre_range)};
    frustum.planar.turn = {value("heading", {-360, 360}), value("pitch", {-360, 360}), value("bank", {-360, 360})};
    const Range angle{-90, 90};
    // All four count from the axis towards their own side, so that a lower edge above the axis is negative.
    frustum.planar.sides = checked_sides(
        file, "line 2", {-value("left", angle), value("right", angle), -value("bottom", angle), value("top", angle)});
    if (lines.next())
        lines.refuse(in_quotes(lines.text()) + " comes after the frustum; one line of numbers is right");
    return frustum;
}

extern const WarpFormat domeprojection_format{.name = "domeprojection",
    .endings = {".csv"},
    .begins = [](const WarpStart& start) { return start.line.starts_with("x;y;"); },
    .read = [](const WarpFile& file, const WarpReading&) { return read_domeprojection(file); }};

} // namespace starbow
