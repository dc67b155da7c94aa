#include "sky_names.h"
#include "config/json/reader.h"
#include "config/model/angles.h"
#include "shaders/shared_structs.h"
#include "stars.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr const char* languages_key = "en";

glm::dvec3 direction(const Place& place)
{
    const glm::dvec2 at = vec2(place, {-90, 360});
    if (at.y > 90)
        fail_at(place, "is beyond the pole; a right ascension from 0 to 360 and a declination from -90 to 90 are right");
    return equatorial(at.x, at.y);
}

/// All members of two letters are names in a language.
NameByLanguage names(const Place& place)
{
    NameByLanguage names;
    for (const auto& [key, value] : place.json->items())
        if (key.size() == 2 && key != "at")
            names[key] = text(member(place, key));
    if (!names.contains(languages_key))
        fail_at(place, "has no name in English; an \"en\" is right");
    return names;
}

Constellation constellation(const Place& place)
{
    Constellation one{names(place), integer(member(place, "rank"), 1, 3), direction(member(place, "at")), {}};
    for (const Place& line : elements(member(place, "lines"))) {
        std::vector<glm::dvec3>& points = one.lines.emplace_back();
        for (const Place& point : items(line, 2, 100, "places"))
            points.push_back(direction(point));
    }
    return one;
}

/// Cosine of the angle from a direction to the arc between two others.
double cosine_to_arc(const glm::dvec3& n, const glm::dvec3& a, const glm::dvec3& b)
{
    const glm::dvec3 axis = glm::normalize(glm::cross(a, b));
    if (glm::dot(glm::cross(axis, a), n) > 0 && glm::dot(glm::cross(b, axis), n) > 0)
        return std::sqrt(std::max(0.0, 1 - std::pow(glm::dot(axis, n), 2)));
    return std::max(glm::dot(a, n), glm::dot(b, n));
}

glm::dvec3 in_cell(double row, double column)
{
    const double polar = pi * row / FIGURE_ROWS, around = 2 * pi * column / FIGURE_COLUMNS - pi;
    return {std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)};
}

} // namespace

SkyNames load_sky_names(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    const Place top = root(document);
    reject_unknown_members(top, {"constellations", "stars", "globes"});
    SkyNames all;
    for (const Place& place : elements(member(top, "constellations")))
        all.constellations.push_back(constellation(place));
    for (const Place& place : elements(member(top, "stars")))
        all.stars.push_back(
            {text(member(place, "name")), direction(member(place, "at")), number(member(place, "magnitude"), {-30, 30})});
    std::ranges::stable_sort(all.stars, {}, &NamedStar::magnitude);
    for (const Place& place : elements(member(top, "globes")))
        all.globes[text(member(place, "id"))] = names(place);
    return all;
}

SkyNames sky_names_of(const SceneFile& scene)
{
    if (!scene.stars)
        return {};
    const std::filesystem::path file = scene.stars->catalogue.parent_path() / "names.json";
    std::error_code ignored;
    return std::filesystem::exists(file, ignored) ? load_sky_names(file) : SkyNames();
}

const std::string& name_in(const NameByLanguage& names, const std::string& language)
{
    const auto own = names.find(language);
    return own != names.end() ? own->second : names.at(languages_key);
}

std::vector<glm::vec4> figure_table(const SkyNames& names, const glm::dmat3& world_from_equatorial)
{
    std::vector<std::pair<glm::dvec3, glm::dvec3>> lines;
    for (const Constellation& one : names.constellations)
        for (const std::vector<glm::dvec3>& points : one.lines)
            for (std::size_t i = 0; i + 1 < points.size(); ++i)
                lines.emplace_back(world_from_equatorial * points[i], world_from_equatorial * points[i + 1]);
    std::vector<glm::vec4> cells, entries;
    for (int row = 0; row < FIGURE_ROWS; ++row)
        for (int column = 0; column < FIGURE_COLUMNS; ++column) {
            const glm::dvec3 middle = in_cell(row + 0.5, column + 0.5);
            // The farthest of a cell's directions is a corner.
            const double reach = FIGURE_REACH
                + std::max(std::acos(glm::dot(middle, in_cell(row, column))),
                    std::acos(glm::dot(middle, in_cell(row + 1, column))));
            const std::size_t first = entries.size();
            for (const auto& [a, b] : lines)
                if (cosine_to_arc(middle, a, b) > std::cos(reach))
                    entries.insert(entries.end(), {glm::vec4(a, 0), glm::vec4(b, 0)});
            cells.emplace_back(FIGURE_ROWS * FIGURE_COLUMNS + first, (entries.size() - first) / 2, 0, 0);
        }
    cells.insert(cells.end(), entries.begin(), entries.end());
    return cells;
}

} // namespace starbow
