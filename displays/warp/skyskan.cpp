#include "parts.h"
#include <array>
#include <cmath>

namespace starbow {

static WarpMesh read_skyskan(const WarpFile& file)
{
    Lines lines(file);
    WarpMesh mesh;
    mesh.format = "SkySkan mesh";
    struct Key {
        std::string_view name;
        Range range;
        std::optional<double> value;
    };
    std::array<Key, 8> keys{{{"Dome Azimuth", {-360, 360}, {}}, {"Dome Elevation", {-180, 180}, {}},
        {"Horizontal FOV", {0.1, 179}, {}}, {"Vertical FOV", {-1, 179}, {}}, {"Horizontal Tweak", {-10, 10}, {}},
        {"Vertical Tweak", {-10, 10}, {}}, {"U Tweak", {-10, 10}, {}}, {"V Tweak", {-10, 10}, {}}}};
    const std::string grid = "columns and rows";
    lines.want("Dome Azimuth=");
    while (lines.text().find('=') != std::string_view::npos) {
        const std::size_t equals = lines.text().find('=');
        bool known = false;
        for (Key& key : keys)
            if (lines.text().substr(0, equals) == key.name) {
                const std::string_view value = lines.text().substr(equals + 1);
                key.value = lines.number(value.substr(std::min(value.find_first_not_of(" \t"), value.size())), key.range);
                known = true;
            }
        if (!known)
            mesh.notes.push_back(one_line(std::string(lines.text()), 60) + " is not used");
        lines.want(grid);
    }
    for (std::size_t i : {0, 1, 2})
        if (!keys[i].value)
            lines.refuse(in_quotes(lines.text()) + " comes before " + std::string(keys[i].name) + "=; all of Dome Azimuth, "
                + "Dome Elevation and Horizontal FOV before the grid is right");
    const auto counts = lines.fields(2, grid);
    mesh.grid = {lines.integer(counts[0], 2, most_grid), lines.integer(counts[1], 2, most_grid)};
    const std::size_t count = std::size_t(mesh.grid.x) * std::size_t(mesh.grid.y);
    if (count > lines.bytes_left() / 8 + 1)
        lines.refuse(in_quotes(lines.text()) + " announces " + std::to_string(count) + " vertices, for which the file's "
            + std::to_string(lines.bytes_left()) + " further bytes are too few; the numbers of columns and rows are right");

    const auto tweak = [](const Key& key, double least) { return key.value && *key.value > least ? *key.value : 1; };
    const double horizontal = *keys[2].value * tweak(keys[4], 0);
    double vertical = 0;
    if (keys[3].value && *keys[3].value > 0)
        vertical = *keys[3].value;
    else {
        // The usual angles of such a projector's panel, where the file leaves them out.
        vertical = 2 * glm::degrees(std::atan(1200.0 / 2048.0 * std::tan(glm::radians(*keys[2].value) / 2)));
        mesh.notes.push_back("Vertical FOV is not given: " + shown(vertical) + " from a panel of 2048 x 1200");
    }
    vertical *= tweak(keys[5], 0);
    mesh.frustum = Planar{60, checked_sides(file, "FOV", {-horizontal / 2, horizontal / 2, -vertical / 2, vertical / 2}),
        {*keys[0].value, *keys[1].value, 0}};
    const glm::dvec2 scale(tweak(keys[6], -1), tweak(keys[7], -1));

    std::vector<char> holes(count);
    mesh.vertices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        lines.want("x y u v");
        const auto& f = lines.fields(4, "x y u v");
        const glm::dvec2 at(lines.number(f[0], position_range), lines.number(f[1], position_range));
        const glm::dvec2 place(lines.number(f[2], picture_range), lines.number(f[3], picture_range));
        holes[i] = at.x == -1 || at.y == -1 || place.x == -1 || place.y == -1;
        mesh.vertices.push_back({at, holes[i] ? 0.0 : 1.0, {glm::dvec3(holes[i] ? glm::dvec2(0) : place * scale, 0)}});
    }
    if (lines.next())
        lines.refuse(in_quotes(lines.text()) + " comes after the last of " + std::to_string(count)
            + " vertices; as many rows as the grid has is right");
    join_grid(mesh, holes);
    check_mesh(mesh, file);
    return mesh;
}

extern const WarpFormat skyskan_format{.name = "SkySkan",
    .endings = {".txt"},
    .begins
    = [](const WarpStart& start) { return start.line.starts_with("Dome ") || start.line.starts_with("Horizontal FOV="); },
    .read = [](const WarpFile& file, const WarpReading&) { return read_skyskan(file); }};

} // namespace starbow
