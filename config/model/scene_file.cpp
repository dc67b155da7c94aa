#include "scene_file.h"
#include "config/json/file_name.h"
#include "goal_reader.h"
#include "shot_reader.h"
#include <algorithm>
#include <chrono>
#include <cstdio>

namespace starbow {
namespace {

/// From far below a nucleus to far beyond the universe's horizon; ratios of two such numbers fit a double.
constexpr Range measure{1e-30, 1e30};

glm::dvec3 read_colour(const Place& place) { return vec3(place, {0, 1e6}); }

SpectralTable read_table(const Place& place)
{
    SpectralTable table;
    for (const Place& at : items(place, least_points, most_points, "pairs [wavelength in nm, value]")) {
        const std::vector<Place> pair = items(at, 2, 2, "numbers (wavelength in nm, value)");
        const double nm = number(pair[0], {shortest_nm, longest_nm});
        if (!table.points.empty() && !(nm > table.points.back().first))
            complain(pair[0],
                "does not rise; a wavelength above the one before, " + shown(table.points.back().first) + ", is right");
        table.points.emplace_back(nm, number(pair[1], {0, 1e30}));
    }
    if (std::all_of(table.points.begin(), table.points.end(), [](const auto& point) { return point.second == 0; }))
        complain(place, "is dark everywhere; a table with a value above 0 is right");
    return table;
}

/// A light's spectrum, where it isn't sunlight.
std::optional<Emission> read_emission(const Place& light)
{
    const auto kelvin = find_member(light, "temperature_K"), line = find_member(light, "line_nm"),
               table = find_member(light, "spectrum");
    if (kelvin.has_value() + line.has_value() + table.has_value() > 1)
        complain(
            light, "has more than one spectrum; at most one of \"temperature_K\", \"line_nm\" and \"spectrum\" is right");
    if (kelvin)
        return BlackBody{number(*kelvin, {coldest_K, hottest_K})};
    if (line)
        return SpectralLine{number(*line, {shortest_nm, longest_nm})};
    if (table)
        return read_table(*table);
    return {};
}

Sky read_sky(const Place& place)
{
    reject_unknown_members(place, {"zenith", "horizon", "nadir", "temperature_K"});
    Sky sky;
    if (auto p = find_member(place, "zenith"))
        sky.zenith = read_colour(*p);
    if (auto p = find_member(place, "horizon"))
        sky.horizon = read_colour(*p);
    if (auto p = find_member(place, "nadir"))
        sky.nadir = read_colour(*p);
    if (auto p = find_member(place, "temperature_K")) {
        sky.temperature_K = number(*p, {0, hottest_K});
        if (sky.temperature_K > 0 && sky.temperature_K < coldest_K)
            complain(*p,
                "is too small; 0 for none, or a number from " + shown(coldest_K) + " to " + shown(hottest_K) + ", is right");
    }
    return sky;
}

StarSky read_stars(const Place& place, const std::filesystem::path& folder)
{
    reject_unknown_members(place, {"catalogue", "in_depth", "brightness_arcmin2", "ahead_deg", "sun_deg", "milky_way"});
    StarSky stars;
    stars.catalogue = folder / text(member(place, "catalogue"));
    take(place, "brightness_arcmin2", stars.brightness_arcmin2, {0, 1e9, true});
    const auto direction = [](const Place& member) {
        const auto angles = items(member, 2, 2, "angles (right ascension, declination)");
        return glm::dvec2(number(angles[0], {0, 360}), number(angles[1], {-90, 90}));
    };
    if (auto p = find_member(place, "ahead_deg"))
        stars.ahead_deg = direction(*p);
    if (auto p = find_member(place, "sun_deg"))
        stars.sun_deg = direction(*p);
    if (auto p = find_member(place, "milky_way")) {
        reject_unknown_members(*p, {"panorama", "peak_arcmin2"});
        stars.milky_way
            = MilkyWay{folder / text(member(*p, "panorama")), number(member(*p, "peak_arcmin2"), {0, 1e9, true})};
    }
    if (auto p = find_member(place, "in_depth")) {
        stars.in_depth = std::size_t(integer(*p, 0, 4'000'000));
        if (!stars.milky_way)
            complain(*p,
                "leaves no place for the other stars, which are painted onto the Milky Way; beside a \"milky_way\" it is "
                "right");
    }
    return stars;
}

/// Days since 2000 January 1, 12 h UTC.
double read_date(const Place& place)
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
    complain(place, "is not a date; one from 1800 to 2049 as \"2026-08-12T17:46Z\" (UTC) is right");
}

GlobeSky read_globes(const Place& place, const std::filesystem::path& folder)
{
    reject_unknown_members(place, {"file", "date", "origin"});
    return {folder / text(member(place, "file")), read_date(member(place, "date")), text(member(place, "origin"))};
}

LightCone read_cone(const Place& place)
{
    reject_unknown_members(place, {"axis", "inner_deg", "outer_deg"});
    LightCone cone{
        unit_direction(member(place, "axis")), 0, glm::radians(number(member(place, "outer_deg"), {0, 90, true}))};
    if (auto inner = find_member(place, "inner_deg"))
        cone.inner_rad = glm::radians(number(*inner, {0, 90}));
    if (!(cone.inner_rad < cone.outer_rad))
        complain(place, "ends inside \"inner_deg\"; a larger \"outer_deg\" is right");
    return cone;
}

Light read_light(const Place& place, const std::vector<Body>& bodies)
{
    reject_unknown_members(place,
        {"type", "towards", "position", "distance", "radiance", "temperature_K", "line_nm", "spectrum", "body", "cone"});
    if (one_of(member(place, "type"), {"directional", "point"}) == "directional") {
        reject_unknown_members(place, {"type", "towards", "radiance", "temperature_K", "line_nm", "spectrum"});
        return DirectionalLight{
            unit_direction(member(place, "towards")), read_colour(member(place, "radiance")), read_emission(place)};
    }
    const glm::dvec3 position = vec3(member(place, "position"), {-farthest, farthest});
    const double distance = number(member(place, "distance"), {0, farthest, true});
    const auto body = find_member(place, "body");
    if (body && std::none_of(bodies.begin(), bodies.end(), [&](const Body& b) { return b.name == text(*body); }))
        complain(*body, "is not a body of this scene; a \"name\" of one of its \"bodies\" is right");
    const auto cone = find_member(place, "cone");
    return PointLight{position, distance, read_colour(member(place, "radiance")), read_emission(place),
        body ? text(*body) : "", cone ? std::optional(read_cone(*cone)) : std::nullopt};
}

} // namespace

SceneFile load_scene_file(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    const Place top = root(document);
    reject_unknown_members(top,
        {"gltf", "unit_m", "light_speed_m_s", "sky", "ground", "stars", "globes", "ambient", "shadows", "lights", "bodies",
            "boundary", "flight", "goals", "start"});
    SceneFile scene;
    scene.name = file.stem().string();
    scene.file = document.file;
    scene.gltf = as_stored(file.parent_path() / text(member(top, "gltf")));
    if (auto p = find_member(top, "unit_m"))
        scene.unit_m = number(*p, measure);
    if (auto p = find_member(top, "light_speed_m_s"))
        scene.light_speed_m_s = number(*p, measure);
    if (auto p = find_member(top, "sky"))
        scene.sky = read_sky(*p);
    if (auto p = find_member(top, "ground")) {
        reject_unknown_members(*p, {"middle", "half_width", "colour"});
        Ground& ground = scene.ground.emplace();
        ground.middle = vec3(member(*p, "middle"), {-Ground::most, Ground::most});
        ground.half_width = number(member(*p, "half_width"), {0, Ground::most, true});
        if (auto colour = find_member(*p, "colour"))
            ground.colour = vec3(*colour, {0, 1});
    }
    if (auto p = find_member(top, "stars"))
        scene.stars = read_stars(*p, file.parent_path());
    if (auto p = find_member(top, "ambient"))
        scene.ambient = read_colour(*p);
    if (auto p = find_member(top, "shadows"))
        scene.shadows = boolean(*p);
    if (auto p = find_member(top, "bodies"))
        scene.bodies = read_bodies(*p);
    if (auto p = find_member(top, "lights"))
        for (const Place& at : items(*p, 0, 8, "lights"))
            scene.lights.push_back(read_light(at, scene.bodies));
    if (auto p = find_member(top, "globes")) {
        scene.globes = read_globes(*p, file.parent_path());
        if (!scene.bodies.empty())
            complain(*p, "stand in a world where other things move; a scene without \"bodies\" is right");
    }
    if (auto p = find_member(top, "boundary")) {
        reject_unknown_members(*p, {"centre", "radius"});
        scene.boundary = {vec3(member(*p, "centre"), {-1e9, 1e9}), number(member(*p, "radius"), {0, 1e9, true})};
    }
    if (auto p = find_member(top, "flight")) {
        reject_unknown_members(*p, {"distance", "time_s"});
        scene.planned = {number(member(*p, "distance"), {0, 1e9, true}), number(member(*p, "time_s"), {1, 3600})};
    }
    if (auto p = find_member(top, "goals"))
        scene.goals = read_goals(*p);
    if (auto p = find_member(top, "start"))
        scene.start = read_shot(*p, false);
    scene.start.scene = scene.name;
    if (const std::optional<Boundary>& ball = scene.boundary)
        if (const double away = glm::distance(scene.start.position, ball->centre); away >= ball->radius)
            complain(member(member(top, "boundary"), "radius"),
                "leaves the start outside, " + shown(away) + " from the centre; more than that is right");
    return scene;
}

} // namespace starbow
