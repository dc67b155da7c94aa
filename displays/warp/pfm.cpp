#include "parts.h"
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

namespace starbow {
namespace {

float value_at(std::string_view bytes, bool little)
{
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
        word |= std::uint32_t(std::uint8_t(bytes[i])) << 8 * (little ? i : 3 - i);
    return std::bit_cast<float>(word);
}

/// The area of all cells together.
double area(glm::ivec2 size, const std::vector<glm::dvec2>& places)
{
    double sum = 0;
    for (int y = 0; y + 1 < size.y; ++y)
        for (int x = 0; x + 1 < size.x; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(size.x) + std::size_t(x);
            const glm::dvec2 across = places[i + 1] - places[i], down = places[i + std::size_t(size.x)] - places[i];
            sum += across.x * down.y - across.y * down.x;
        }
    return std::abs(sum);
}

} // namespace

FloatMap read_float_map(const WarpFile& file, const FloatMapForm& form)
{
    std::string_view rest = file.content;
    std::size_t line = 0;
    const auto word = [&](const std::string& what) {
        const std::size_t start = rest.find_first_not_of(" \t\r\n");
        const std::size_t end
            = std::min(start == rest.npos ? rest.size() : rest.find_first_of(" \t\r\n", start), rest.size());
        ++line;
        if (start == rest.npos || end == rest.size() || end - start > 40)
            refuse(file, "PFM header", what + " is missing; PF, width, height and scale, each ended by a blank, is right");
        const std::string_view found = rest.substr(start, end - start);
        rest.remove_prefix(end);
        return found;
    };
    const std::string_view magic = word("PF");
    if (magic == "Pf")
        refuse(file, "byte 0", "\"Pf\" is a PFM of one channel; PF, three channels, is right");
    if (magic != "PF")
        refuse(file, "byte 0", in_quotes(magic) + " begins no PFM; PF is right");
    FloatMap map;
    map.form = form;
    for (int* side : {&map.size.x, &map.size.y}) {
        const std::string_view text = word(side == &map.size.x ? "the width" : "the height");
        const std::optional<double> value = parsed(text);
        if (!value || *value != std::floor(*value) || *value < 1 || *value > most_grid)
            refuse(file, "PFM header",
                in_quotes(text) + " is not a size; a whole number from 1 to " + std::to_string(most_grid) + " is right");
        *side = int(*value);
    }
    const std::string_view text = word("the scale");
    const std::optional<double> scale = parsed(text);
    if (!scale || *scale == 0)
        refuse(file, "PFM header",
            in_quotes(text)
                + " is not a scale; a number below 0 for little-endian values, above for big-endian ones, is right");
    rest.remove_prefix(rest.starts_with("\r\n") ? 2 : 1);
    const std::size_t count = std::size_t(map.size.x) * std::size_t(map.size.y);
    if (rest.size() / 12 != count || rest.size() % 12 != 0)
        refuse(file, "byte " + std::to_string(file.content.size() - rest.size()),
            "has " + std::to_string(rest.size()) + " bytes of values for " + std::to_string(map.size.x) + " x "
                + std::to_string(map.size.y) + " pixels; " + std::to_string(12 * count) + " are right");
    map.values.reserve(count);
    for (int y = 0; y < map.size.y; ++y) {
        const std::size_t row = std::size_t(form.first_row_on_top ? y : map.size.y - 1 - y);
        for (std::size_t x = 0; x < std::size_t(map.size.x); ++x) {
            const std::string_view at = rest.substr(12 * (row * std::size_t(map.size.x) + x), 12);
            map.values.emplace_back(
                value_at(at, *scale < 0), value_at(at.substr(4), *scale < 0), value_at(at.substr(8), *scale < 0));
        }
    }
    return map;
}

namespace {

constexpr std::string_view offsets_cure = "--offsets, and in a layout \"values\": \"offsets\"";

std::string cell_name(const FloatMap& map, std::size_t index)
{
    const std::size_t width = std::size_t(map.size.x);
    return "column " + std::to_string(index % width) + ", row " + std::to_string(index / width) + " from the top";
}

bool is_hole(const glm::vec3& value) { return !std::isfinite(value.x) || !std::isfinite(value.y); }

/// A mesh whose vertices span the viewport from edge to edge. Holes have neither place nor light.
WarpMesh edge_to_edge_mesh(const FloatMap& map, const WarpFile& file)
{
    if (map.size.x < 2 || map.size.y < 2)
        refuse(file, "PFM header",
            std::to_string(map.size.x) + " x " + std::to_string(map.size.y)
                + " samples reach from no edge to the other; at least 2 x 2 are right");
    WarpMesh mesh;
    mesh.grid = map.size;
    mesh.vertices.reserve(map.values.size());
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        const std::size_t width = std::size_t(map.size.x);
        const glm::dvec2 place(double(i % width) / (map.size.x - 1), double(i / width) / (map.size.y - 1));
        mesh.vertices.push_back({place, is_hole(map.values[i]) ? 0.0 : 1.0, {}});
    }
    return mesh;
}

std::vector<char> holes_of(const FloatMap& map)
{
    std::vector<char> holes;
    holes.reserve(map.values.size());
    for (const glm::vec3& value : map.values)
        holes.push_back(is_hole(value));
    return holes;
}

WarpMesh offset_mesh(const FloatMap& map, const WarpFile& file, const std::vector<char>& holes)
{
    WarpMesh mesh = edge_to_edge_mesh(map, file);
    std::vector<glm::dvec2> warped, turned;
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        const glm::vec3& value = map.values[i];
        WarpVertex& vertex = mesh.vertices[i];
        if (!holes[i] && !(std::abs(value.x) < 1 && std::abs(value.y) < 1))
            refuse(file, cell_name(map, i),
                shown(value.x) + ", " + shown(value.y)
                    + " is not an offset from a regular grid; numbers between -1 and 1, or NaN for a hole, are right");
        const glm::dvec2 offset = holes[i] ? glm::dvec2(0) : glm::dvec2(value.x, -value.y);
        vertex.sees[0] = glm::dvec3(vertex.at, 0);
        turned.push_back(vertex.at + glm::dvec2(offset.x, -offset.y));
        vertex.at += offset;
        warped.push_back(vertex.at);
    }
    mesh.notes.push_back("the values are read as offsets from a regular grid, to the right and up");
    if (area(map.size, turned) > 1.25 * area(map.size, warped))
        mesh.warnings.push_back(map.form.first_row_on_top
                ? "with its rows in the other order the mesh would cover much more: try it without --first-row-on-top, and "
                  "a "
                  "layout without \"first_row\""
                : "with its rows in the other order the mesh would cover much more: try it with --first-row-on-top, and "
                  "\"first_row\": \"top\" in a layout");
    join_grid(mesh, holes);
    return mesh;
}

/// Throws where most places lie beside the picture; warns where all lie near 0. Both look like offsets, which a file can't
/// declare: the form alone decides how it is read.
void check_places(const FloatMap& map, const WarpFile& file, const std::vector<char>& holes, WarpMesh& mesh)
{
    constexpr float far_for_an_offset = 0.25f;
    std::size_t known = 0, inside = 0, small = 0;
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        const glm::vec2 value = map.values[i];
        known += !holes[i];
        inside += value.x >= 0 && value.x <= 1 && value.y >= 0 && value.y <= 1; // false for NaN
        small += std::abs(value.x) < far_for_an_offset && std::abs(value.y) < far_for_an_offset;
    }
    if (2 * inside < known)
        refuse(file, "",
            "has " + std::to_string(known - inside) + " of " + std::to_string(known)
                + " places outside the picture; places from 0 to 1 are right, or for offsets from a regular grid "
                + std::string(offsets_cure));
    if (small == known)
        mesh.warnings.push_back("all of its values lie near 0, as offsets from a regular grid do: if they are offsets, try "
            + std::string(offsets_cure));
}

} // namespace

WarpMesh place_mesh(const FloatMap& map, const WarpFile& file)
{
    const std::vector<char> holes = holes_of(map);
    if (std::find(holes.begin(), holes.end(), 0) == holes.end())
        refuse(file, "",
            "shows nothing: all of its " + std::to_string(map.values.size())
                + " values are holes; places in the picture are right");
    if (map.form.offsets)
        return offset_mesh(map, file, holes);
    WarpMesh about; // the warnings, before a mesh is there
    check_places(map, file, holes, about);
    std::vector<WarpVertex> values;
    values.reserve(map.values.size());
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        const glm::dvec3 value = map.values[i];
        if (!holes[i] && glm::any(glm::greaterThan(glm::abs(glm::dvec2(value)), glm::dvec2(picture_range.high))))
            refuse(file, cell_name(map, i),
                shown(value.x) + ", " + shown(value.y)
                    + " is not a place in the picture; numbers from 0 to 1, or NaN for a hole, are right");
        const glm::dvec3 place(value.x, map.form.v_up ? 1 - value.y : value.y, 0);
        values.push_back({{}, holes[i] ? 0.0 : 1.0, {holes[i] ? glm::dvec3(0) : place}});
    }
    WarpMesh mesh;
    if (map.form.edge_to_edge) {
        mesh = edge_to_edge_mesh(map, file);
        for (std::size_t i = 0; i < values.size(); ++i)
            mesh.vertices[i].sees = values[i].sees;
        join_grid(mesh, holes);
    } else {
        mesh = centred_mesh(map.size, values, holes);
    }
    mesh.warnings = std::move(about.warnings);
    return mesh;
}

WarpMesh read_pfm(const WarpFile& file, const FloatMapForm& form)
{
    WarpMesh mesh = place_mesh(read_float_map(file, form), file);
    mesh.format = std::string("PFM map, first row ") + (form.first_row_on_top ? "on top" : "at the bottom")
        + (form.offsets ? ", offsets" : "") + (form.v_up ? ", v up" : "") + (form.edge_to_edge ? ", from edge to edge" : "");
    check_mesh(mesh, file);
    return mesh;
}

extern const WarpFormat pfm_format{.name = "PFM",
    .endings = {".pfm"},
    .begins =
        [](const WarpStart& start) {
            return start.bytes.starts_with("PF\n") || start.bytes.starts_with("PF ") || start.bytes.starts_with("PF\r")
                || start.bytes.starts_with("Pf\n");
        },
    .read = [](const WarpFile& file, const WarpReading& reading) { return read_pfm(file, reading.form); },
    .has_form = true};

} // namespace starbow
