#include "config/json/file_name.h"
#include "describe_scene.h"
#include <algorithm>
#include <chrono>
#include <cstdio>

namespace starbow {
namespace {

void check_spectra(const Place& light)
{
    const auto is_there = [&](const char* name) { return find_member(light, name).has_value(); };
    if (std::ranges::count_if(emission_members, is_there) < 2)
        return;
    std::string names;
    for (std::size_t i = 0; i < emission_members.size(); ++i)
        names.append(i == 0 ? "\"" : i + 1 == emission_members.size() ? "\" and \"" : "\", \"").append(emission_members[i]);
    fail_at(light, "has more than one spectrum; at most one of " + names + "\" is right");
}

} // namespace

std::filesystem::path WorldPath::read(const Place& place, const Folder& folder) const
{
    return as_stored(folder.path / text(place));
}

double GlowTemperature::read(const Place& place, const Folder&) const
{
    const double kelvin = number(place, {0, hottest_K});
    if (kelvin > 0 && kelvin < coldest_K)
        fail_at(place,
            "is too small; 0 for none, or a number from " + shown(coldest_K) + " to " + shown(hottest_K) + ", is right");
    return kelvin;
}

glm::dvec2 SkyDirection::read(const Place& place, const Folder&) const
{
    const auto angles = items(place, 2, 2, "angles (right ascension, declination)");
    return {number(angles[0], {0, 360}), number(angles[1], {-90, 90})};
}

Json SkyDirection::schema(Json& definitions) const
{
    return described::list_schema(2, 2, {Number{{0, 360}}.schema(definitions), Number{{-90, 90}}.schema(definitions)});
}

void check(const Place& place, const StarSky& stars, const Folder&)
{
    if (const auto in_depth = find_member(place, "in_depth"); in_depth && !stars.milky_way)
        fail_at(*in_depth,
            "leaves no place for the other stars, which are painted onto the Milky Way; beside a \"milky_way\" it is "
            "right");
    if (const auto light = find_member(place, "sun_light"); light && !stars.sun_deg)
        fail_at(*light, "has no Sun that could shine; beside a \"sun_deg\" it is right");
}

double DateForm::read(const Place& place, const Folder&) const
{
    const std::string date = text(place);
    int year, month, day, hour, minute, end = 0;
    using namespace std::chrono;
    if (std::sscanf(date.c_str(), "%4d-%2d-%2dT%2d:%2dZ%n", &year, &month, &day, &hour, &minute, &end) == 5
        && date.size() == 17 && end == 17 && hour >= 0 && hour < 24 && minute >= 0 && minute < 60 && year >= 1800
        && year < 2050)
        if (const year_month_day at{
                std::chrono::year(year), std::chrono::month(unsigned(month)), std::chrono::day(unsigned(day))};
            at.ok())
            return (sys_days(at) - sys_days(2000y / January / 1)).count() - 0.5 + (hour + minute / 60.0) / 24;
    fail_at(place, "is not a date; one from 1800 to 2049 as \"2026-08-12T17:46Z\" (UTC) is right");
}

Json DateForm::schema(Json&) const
{
    return {{"type", "string"}, {"pattern", "^(1[89]|20)[0-9]{2}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}Z$"}};
}

void check(const Place& place, const LightCone& cone, const Folder&)
{
    if (!(cone.inner_rad < cone.outer_rad))
        fail_at(place, "ends inside \"inner_deg\"; a larger \"outer_deg\" is right");
}

Emission EmissionForm<SpectralTable>::read(const Place& place, const Folder&) const
{
    SpectralTable table;
    for (const Place& at : items(place, least_points, most_points, "pairs [wavelength in nm, value]")) {
        const std::vector<Place> pair = items(at, 2, 2, "numbers (wavelength in nm, value)");
        const double nm = number(pair[0], {shortest_nm, longest_nm});
        if (!table.points.empty() && !(nm > table.points.back().first))
            fail_at(pair[0],
                "does not rise; a wavelength above the one before, " + shown(table.points.back().first) + ", is right");
        table.points.emplace_back(nm, number(pair[1], {0, 1e30}));
    }
    if (std::all_of(table.points.begin(), table.points.end(), [](const auto& point) { return point.second == 0; }))
        fail_at(place, "is dark everywhere; a table with a value above 0 is right");
    return table;
}

Json EmissionForm<SpectralTable>::schema(Json& definitions) const
{
    return described::list_schema(least_points, most_points,
        described::list_schema(
            2, 2, {Number{{shortest_nm, longest_nm}}.schema(definitions), Number{{0, 1e30}}.schema(definitions)}));
}

void check_members(const Place& place, const DirectionalLight*) { check_spectra(place); }
void check_members(const Place& place, const PointLight*) { check_spectra(place); }

void check(const Place& place, const SceneFile& scene, const Folder&)
{
    if (const auto bodies = find_member(place, "bodies")) {
        const std::vector<Place> each = elements(*bodies);
        for (std::size_t i = 0; i < each.size(); ++i)
            for (std::size_t k = 0; k < i; ++k)
                if (scene.bodies[k].name == scene.bodies[i].name)
                    fail_at(member(each[i], "name"), "is the name of another body as well; one of its own is right");
    }
    if (const auto lights = find_member(place, "lights"))
        for (const Place& light : elements(*lights))
            if (const auto body = find_member(light, "body"))
                if (std::none_of(
                        scene.bodies.begin(), scene.bodies.end(), [&](const Body& one) { return one.name == text(*body); }))
                    fail_at(*body, "is not a body of this scene; a \"name\" of one of its \"bodies\" is right");
    if (const auto globes = find_member(place, "globes"); globes && !scene.bodies.empty())
        fail_at(*globes, "stand in a world where other things move; a scene without \"bodies\" is right");
    if (const std::optional<Boundary>& ball = scene.boundary)
        if (const double away = glm::distance(scene.start.position, ball->centre); away >= ball->radius)
            fail_at(member(member(place, "boundary"), "radius"),
                "leaves the start outside, " + shown(away) + " from the centre; more than that is right");
}

SceneFile load_scene_file(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    SceneFile scene = read<SceneFile>(root(document), file.parent_path());
    scene.name = file.stem().string();
    scene.file = document.file;
    scene.start.scene = scene.name;
    return scene;
}

} // namespace starbow
