#include "parts.h"
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

/// True if more than a twentieth of a grid's cells is turned over.
bool folds(glm::ivec2 size, const std::vector<glm::dvec2>& places)
{
    int right = 0, left = 0;
    for (int y = 0; y + 1 < size.y; ++y)
        for (int x = 0; x + 1 < size.x; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(size.x) + std::size_t(x);
            const glm::dvec2 across = places[i + 1] - places[i], down = places[i + std::size_t(size.x)] - places[i];
            (across.x * down.y - across.y * down.x > 0 ? right : left)++;
        }
    return right < 19 * left && left < 19 * right;
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

FloatMap read_float_map(const WarpFile& file, bool first_row_on_top)
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
    map.first_row_on_top = first_row_on_top;
    for (int* side : {&map.size.x, &map.size.y}) {
        const std::string_view text = word(side == &map.size.x ? "the width" : "the height");
        const std::optional<double> value = parsed(text);
        if (!value || *value != std::floor(*value) || *value < 1 || *value > most_grid)
            refuse(file, "PFM header",
                in_quotes(text) + " is no size; a whole number from 1 to " + std::to_string(most_grid) + " is right");
        *side = int(*value);
    }
    const std::string_view text = word("the scale");
    const std::optional<double> scale = parsed(text);
    if (!scale || *scale == 0)
        refuse(file, "PFM header",
            in_quotes(text)
                + " is no scale; a number below 0 for little-endian values, above for big-endian ones, is right");
    rest.remove_prefix(rest.starts_with("\r\n") ? 2 : 1);
    const std::size_t count = std::size_t(map.size.x) * std::size_t(map.size.y);
    if (rest.size() / 12 != count || rest.size() % 12 != 0)
        refuse(file, "byte " + std::to_string(file.content.size() - rest.size()),
            "has " + std::to_string(rest.size()) + " bytes of values for " + std::to_string(map.size.x) + " x "
                + std::to_string(map.size.y) + " pixels; " + std::to_string(12 * count) + " are right");
    map.values.reserve(count);
    for (int y = 0; y < map.size.y; ++y) {
        const std::size_t row = std::size_t(first_row_on_top ? y : map.size.y - 1 - y);
        for (std::size_t x = 0; x < std::size_t(map.size.x); ++x) {
            const std::string_view at = rest.substr(12 * (row * std::size_t(map.size.x) + x), 12);
            map.values.emplace_back(
                value_at(at, *scale < 0), value_at(at.substr(4), *scale < 0), value_at(at.substr(8), *scale < 0));
        }
    }
    return map;
}

WarpMesh place_mesh(const FloatMap& map, const WarpFile& file)
{
    // Places lie in the picture, most of them. Offsets from a regular grid gather around 0 instead, half of them below.
    std::size_t known = 0, inside = 0;
    for (const glm::vec3& value : map.values)
        if (std::isfinite(value.x) && std::isfinite(value.y)) {
            ++known;
            inside += value.x >= 0 && value.x <= 1 && value.y >= 0 && value.y <= 1;
        }
    if (known == 0)
        refuse(file, "",
            "shows nothing: all of its " + std::to_string(map.values.size())
                + " values are holes; places in the picture are right");

    WarpMesh mesh;
    if (2 * inside < known) {
        std::vector<glm::dvec2> warped, turned;
        bool sound = map.size.x > 1 && map.size.y > 1;
        for (std::size_t i = 0; sound && i < map.values.size(); ++i) {
            const glm::vec3& value = map.values[i];
            sound = std::abs(value.x) < 1 && std::abs(value.y) < 1; // false for NaN
            const std::size_t width = std::size_t(map.size.x);
            const glm::dvec2 place(double(i % width) / (map.size.x - 1), double(i / width) / (map.size.y - 1));
            warped.push_back(place + glm::dvec2(value.x, -value.y));
            mesh.vertices.push_back({warped.back(), 1, {glm::dvec3(place, 0)}});
        }
        if (!sound || folds(map.size, warped))
            refuse(file, "",
                "has " + std::to_string(known - inside) + " of " + std::to_string(known)
                    + " places outside the picture, and they make no offsets either; places from 0 to 1 are right");
        mesh.grid = map.size;
        mesh.notes.push_back("the values are offsets from a regular grid, not places in the picture: read as such");
        for (std::size_t i = 0; i < warped.size(); ++i)
            turned.push_back({warped[i].x, warped[i].y + 2.0 * map.values[i].y});
        if (area(map.size, turned) > 1.25 * area(map.size, warped))
            mesh.notes.push_back(map.first_row_on_top
                    ? "with its rows in the other order the mesh would cover much more: try it without --first-row-on-top, "
                      "and a layout without \"first_row\""
                    : "with its rows in the other order the mesh would cover much more: try it with --first-row-on-top, "
                      "and \"first_row\": \"top\" in a layout");
        join_grid(mesh, std::vector<char>(mesh.vertices.size()));
        return mesh;
    }
    std::vector<WarpVertex> values;
    std::vector<char> holes;
    values.reserve(map.values.size());
    holes.reserve(map.values.size());
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        const glm::dvec3 value = map.values[i];
        const bool hole = !std::isfinite(value.x) || !std::isfinite(value.y);
        if (!hole && glm::any(glm::greaterThan(glm::abs(glm::dvec2(value)), glm::dvec2(picture_range.high))))
            refuse(file,
                "column " + std::to_string(i % std::size_t(map.size.x)) + ", row "
                    + std::to_string(i / std::size_t(map.size.x)) + " from the top",
                shown(value.x) + ", " + shown(value.y)
                    + " is no place in the picture; numbers from 0 to 1, or NaN for a hole, are right");
        holes.push_back(hole);
        values.push_back({{}, hole ? 0.0 : 1.0, {hole ? glm::dvec3(0) : glm::dvec3(value.x, value.y, 0)}});
    }
    return centred_mesh(map.size, values, holes);
}

WarpMesh read_pfm(const WarpFile& file, bool first_row_on_top)
{
    WarpMesh mesh = place_mesh(read_float_map(file, first_row_on_top), file);
    mesh.format = std::string("PFM map, first row ") + (first_row_on_top ? "on top" : "at the bottom");
    check_mesh(mesh, file);
    return mesh;
}

} // namespace starbow
