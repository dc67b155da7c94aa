#include "scene_file.h"
#include "shot_reader.h"
#include <cmath>

namespace starbow {
namespace {

/// From far below a nucleus to far beyond the horizon of the universe, and ratios of two of them are still doubles.
constexpr Range measure{1e-30, 1e30};
constexpr double farthest = 1e15;

glm::dvec3 read_colour(const Place& place) { return vec3(place, {0, 1e6}); }

Sky read_sky(const Place& place)
{
    only(place, {"zenith", "horizon", "nadir"});
    Sky sky;
    if (auto p = find(place, "zenith"))
        sky.zenith = read_colour(*p);
    if (auto p = find(place, "horizon"))
        sky.horizon = read_colour(*p);
    if (auto p = find(place, "nadir"))
        sky.nadir = read_colour(*p);
    return sky;
}

StarSky read_stars(const Place& place, const std::filesystem::path& folder)
{
    only(place, {"catalogue", "brightness_arcmin2", "ahead_deg"});
    StarSky stars;
    stars.catalogue = folder / text(member(place, "catalogue"));
    take(place, "brightness_arcmin2", stars.brightness_arcmin2, {0, 1e9, true});
    if (auto p = find(place, "ahead_deg")) {
        const auto angles = items(*p, 2, 2, "angles (right ascension, declination)");
        stars.ahead_deg = {number(angles[0], {0, 360}), number(angles[1], {-90, 90})};
    }
    return stars;
}

Light read_light(const Place& place)
{
    only(place, {"type", "towards", "position", "distance", "radiance"});
    if (one_of(member(place, "type"), {"directional", "point"}) == "directional") {
        only(place, {"type", "towards", "radiance"});
        const Place towards = member(place, "towards");
        const glm::dvec3 direction = vec3(towards, {-farthest, farthest});
        const double length = glm::length(direction);
        if (!(length > 1e-100))
            complain(towards, "points nowhere; a direction of any length above 0 is right");
        return DirectionalLight{direction / length, read_colour(member(place, "radiance"))};
    }
    only(place, {"type", "position", "distance", "radiance"});
    PointLight light;
    light.position = vec3(member(place, "position"), {-farthest, farthest});
    light.distance = number(member(place, "distance"), {0, farthest, true});
    light.radiance = read_colour(member(place, "radiance"));
    return light;
}

} // namespace

SceneFile load_scene_file(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    const Place top = root(document);
    only(top, {"gltf", "unit_m", "light_speed_m_s", "sky", "stars", "ambient", "lights", "start"});
    SceneFile scene;
    scene.name = file.stem().string();
    scene.gltf = file.parent_path() / text(member(top, "gltf"));
    if (auto p = find(top, "unit_m"))
        scene.unit_m = number(*p, measure);
    if (auto p = find(top, "light_speed_m_s"))
        scene.light_speed_m_s = number(*p, measure);
    if (auto p = find(top, "sky"))
        scene.sky = read_sky(*p);
    if (auto p = find(top, "stars"))
        scene.stars = read_stars(*p, file.parent_path());
    if (auto p = find(top, "ambient"))
        scene.ambient = read_colour(*p);
    if (auto p = find(top, "lights"))
        for (const Place& at : items(*p, 0, 8, "lights"))
            scene.lights.push_back(read_light(at));
    if (auto p = find(top, "start"))
        scene.start = read_shot(*p, false);
    scene.start.scene = scene.name;
    return scene;
}

} // namespace starbow
