#include "open_scene.h"
#include "boxes.h"
#include "config/json/digits.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/file_kind.h"
#include "fastest_motion.h"
#include "moving.h"
#include "outline.h"
#include "shadows.h"
#include "world.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <sstream>

namespace starbow {
namespace {

/// 1, 2 or 5 times a power of ten: the nearest by ratio.
double round_number(double x)
{
    const double power = std::pow(10, std::floor(std::log10(x)));
    const std::array steps{1.0, 2.0, 5.0, 10.0};
    return power * *std::ranges::min_element(steps, {}, [&](double step) { return std::abs(std::log(step * power / x)); });
}

constexpr double crossing_s = 10; ///< light's time through a world without a scene file
constexpr double real_light_speed_m_s = 299792458;

/// The start at a camera; nullopt for one whose axes are no directions.
std::optional<Shot> at_camera(const glm::dmat4& world_from_camera)
{
    const glm::dvec3 look(-world_from_camera[2]), up(world_from_camera[1]);
    const double square = glm::length(look) * glm::length(up);
    if (!(square > 1e-60 && glm::length(glm::cross(look, up)) > 1e-6 * square))
        return {};
    Shot start;
    start.position = glm::dvec3(world_from_camera[3]);
    start.ship_from_cockpit = orientation(look, up);
    return start;
}

/// True if a start shows the world well: from inside, or with its middle ahead and large enough.
bool shows_well(const Shot& start, const AlignedBox& box)
{
    constexpr double least_rad = 0.5, most_aside = 0.85; // about half of a picture of 60 degrees; the cosine of 32 degrees
    const glm::dvec3 centre = 0.5 * (box.low + box.high), towards = centre - start.position;
    const double radius = 0.5 * glm::distance(box.low, box.high), distance = glm::length(towards);
    if (!(distance > radius))
        return true;
    const glm::dvec3 look = start.ship_from_cockpit * glm::dvec3(0, 0, -1);
    return 2 * std::asin(radius / distance) >= least_rad && glm::dot(look, towards) >= most_aside * distance;
}

/// The start of a world without a scene file: at its camera, or where that camera shows it too small or not at all, nearer
/// on the same side; without a camera a little to the right and above.
Shot start_of(const Outline& outline, const Middle& middle)
{
    glm::dvec3 away(0.35, 0.28, 1);
    const std::optional<Shot> camera = outline.camera ? at_camera(*outline.camera) : std::nullopt;
    if (camera && shows_well(*camera, middle.box))
        return *camera;
    if (camera) {
        const glm::dvec3 back = camera->position - 0.5 * (middle.box.low + middle.box.high);
        constexpr double steepest = 0.9; // of a way that is not upright
        if (glm::length(back) > 0 && std::abs(back.y) < steepest * glm::length(back))
            away = glm::normalize(back);
    }
    return overview(middle.box, middle.floor, away);
}

/// The ground for a world that has none: below its middle, as wide as makes its edge a horizon. None for points and lines
/// alone, for a world that has a floor or stands in larger things, for one that is seen from inside, and for one that is
/// larger or farther off than a ground may be.
std::optional<Ground> ground_of(const Outline& outline, const Middle& middle, const Shot& start)
{
    constexpr double widths = 30, gap = 2e-3, floor_part = 0.5; // gap: below a floor that is part of the thing
    const glm::dvec3 size = middle.box.high - middle.box.low, centre = 0.5 * (middle.box.low + middle.box.high);
    if (!outline.surfaces || outline.things.empty() || !(middle.across() > 0))
        return {};
    const bool inside = glm::all(glm::greaterThan(start.position, middle.box.low))
        && glm::all(glm::lessThan(start.position, middle.box.high));
    const bool has_floor = std::ranges::any_of(outline.things, [&](const AlignedBox& thing) {
        const glm::dvec3 own = thing.high - thing.low;
        return is_flat(thing) && thing.high.y < centre.y && own.x * own.z > floor_part * size.x * size.z;
    });
    AlignedBox all = outline.things[0];
    for (const AlignedBox& thing : outline.things)
        all = around(all, thing);
    if (inside || has_floor || glm::distance(all.low, all.high) > 1.01 * middle.across())
        return {};
    Ground ground;
    ground.middle = {centre.x, middle.box.low.y - gap * middle.across(), centre.z};
    ground.half_width = widths * middle.across();
    ground.colour = {0.23, 0.24, 0.21};
    const bool too_large = glm::any(glm::greaterThan(glm::abs(ground.middle), glm::dvec3(Ground::most)))
        || ground.half_width > Ground::most;
    return too_large ? std::nullopt : std::optional(ground);
}

/// The least round speed of light at which the file's own animations are slow enough for it.
double least_light_speed(const Outline& outline, const std::filesystem::path& gltf)
{
    const std::optional<FastestMotion> fastest = fastest_motion(outline.world ? *outline.world : load_world(gltf));
    const double least = fastest ? fastest->per_s / most_own_speed : 0;
    double speed = least > 0 ? round_number(least) : 0;
    return speed < least ? round_number(2 * speed) : speed;
}

/// The most lamps of a scene.
constexpr std::size_t most_lamps = 8;

/// The file's own lamps, as bright together at the world's middle as the suggested sun; the brightest there first. In
/// glTF lamps have lux and candela, here a white surface that faces all of them is as bright as the picture's white: all are
/// scaled by one factor. lux_in_all: is set to their illuminance at
/// the middle.
std::vector<Light> lights_of(const Outline& outline, const Middle& middle, double& lux_in_all)
{
    const glm::dvec3 centre = 0.5 * (middle.box.low + middle.box.high);
    struct Lit {
        double lux;
        Light light;
    };
    std::vector<Lit> lit;
    for (const OutlineLamp& lamp : outline.lamps) {
        const glm::dvec3 place(lamp.world_from_lamp[3]), back(lamp.world_from_lamp[2]);
        const double luminance = glm::dot(lamp.colour, glm::dvec3(0.2126, 0.7152, 0.0722));
        const double distance = std::max(glm::distance(place, centre), 1e-3 * middle.across());
        const double lux = luminance * lamp.intensity / (lamp.directional ? 1 : distance * distance);
        if (!(lux > 0) || !(glm::length(back) > 1e-30))
            continue;
        const glm::dvec3 radiance = lamp.colour / luminance * lux;
        std::optional<LightCone> cone = lamp.cone;
        if (cone)
            cone->axis = -glm::normalize(back);
        lit.push_back({lux,
            lamp.directional ? Light(DirectionalLight{glm::normalize(back), radiance, {}})
                             : Light(PointLight{place, distance, radiance, {}, "", cone})});
    }
    std::ranges::sort(lit, std::greater(), &Lit::lux);
    if (lit.size() > most_lamps)
        lit.resize(most_lamps);
    lux_in_all = 0;
    for (const Lit& one : lit)
        lux_in_all += one.lux;
    std::vector<Light> lights;
    for (Lit& one : lit) {
        std::visit([&](auto& light) { light.radiance /= lux_in_all; }, one.light);
        lights.push_back(std::move(one.light));
    }
    return lights;
}

} // namespace

Shot overview(const AlignedBox& box, double floor, const glm::dvec3& away)
{
    const glm::dvec3 centre = 0.5 * (box.low + box.high), size = box.high - box.low;
    const glm::dquat turned = orientation(-away, {0, 1, 0});
    const glm::dmat3 axes = glm::mat3_cast(turned);
    // A corner is in view where its angles from straight ahead are smaller than these: of a picture of 60 degrees by 75.
    const glm::dvec2 most(std::tan(glm::radians(30.0)), std::tan(glm::radians(23.0)));
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at = 0.5 * size * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const glm::dvec3 seen = glm::transpose(axes) * at; // right, up, back
        distance = std::max({distance, seen.z + std::abs(seen.x) / most.x, seen.z + std::abs(seen.y) / most.y});
    }
    Shot shot;
    shot.position = centre + std::max(distance, 1e-9) * axes[2];
    shot.position.y = std::max(shot.position.y, floor + 0.02 * glm::length(size));
    shot.ship_from_cockpit = orientation(centre - shot.position, {0, 1, 0});
    return shot;
}

SceneFile open_scene(const std::filesystem::path& file)
{
    if (kind_of_file(file) != FileKind::gltf)
        return load_scene_file(file);
    // A program asks for the same scene several times while it starts, and an animated world is read as a whole for it.
    struct Known {
        std::filesystem::path file;
        std::filesystem::file_time_type written;
        std::uintmax_t size;
        SceneFile scene;
    };
    static std::mutex alone;
    static std::optional<Known> last;
    const std::lock_guard lock(alone);
    std::error_code error, none;
    const auto written = std::filesystem::last_write_time(file, error);
    const std::uintmax_t size = std::filesystem::file_size(file, none);
    if (error || none || !last || last->file != file || last->written != written || last->size != size)
        last = Known{file, written, size, scene_around(file)};
    return last->scene;
}

SceneFile scene_around(const std::filesystem::path& gltf)
{
    const Outline outline = read_outline(gltf);
    const Middle middle = middle_of(outline.things);
    SceneFile scene;
    scene.name = gltf.stem().string();
    scene.file = one_line(gltf.string());
    scene.gltf = gltf;
    scene.unit_m = 1;
    const double size = std::max(middle.across(), 1e-3);
    scene.light_speed_m_s = std::min(round_number(size / crossing_s), real_light_speed_m_s);
    const double slowest = outline.moves ? least_light_speed(outline, gltf) : 0;
    if (slowest > scene.light_speed_m_s)
        scene.light_speed_m_s = std::min(slowest, real_light_speed_m_s);
    scene.start = start_of(outline, middle);
    scene.start.scene = scene.name;
    scene.ground = ground_of(outline, middle, scene.start);
    // A sun over the left shoulder of whoever looks from the start, so that forms have a light and a dark side.
    const glm::dmat3 axes = glm::mat3_cast(scene.start.ship_from_cockpit);
    const glm::dvec3 level(axes[2].x, 0, axes[2].z);
    const glm::dvec3 back = glm::length(level) > 1e-3 ? glm::normalize(level) : glm::dvec3(0, 0, 1);
    scene.lights = {
        DirectionalLight{glm::normalize(0.6 * back - 0.6 * glm::cross(glm::dvec3(0, 1, 0), back) + glm::dvec3(0, 0.75, 0)),
            glm::dvec3(0.95, 0.89, 0.79), {}}};
    double lux = 0;
    if (std::vector<Light> own = lights_of(outline, middle, lux); !own.empty()) {
        scene.lights = std::move(own);
        scene.notes.push_back("its lamps are scaled by one factor: the " + digits(lux)
            + " lux at its middle make a white surface as bright as the picture's white");
        if (outline.lamps.size() > scene.lights.size())
            scene.notes.push_back("of its " + std::to_string(outline.lamps.size()) + " lamps "
                + std::to_string(scene.lights.size()) + " shine: the brightest at its middle");
    }
    scene.ambient = {0.24, 0.26, 0.30};
    scene.shadows = true;
    scene.sky = {.zenith = {0.07, 0.14, 0.30}, .horizon = {0.42, 0.48, 0.55}, .nadir = {0.15, 0.14, 0.12}};
    if (!outline.surfaces) // points and lines shine by themselves, and show best before the dark
        scene.sky = {.zenith = {0.002, 0.003, 0.006}, .horizon = {0.004, 0.005, 0.008}, .nadir = {0.002, 0.003, 0.006}};
    scene.notes.push_back("it has no scene file: a unit is taken as 1 m, and light flies " + digits(scene.light_speed_m_s)
        + " m/s and crosses the world's " + digits(size) + " m in " + digits(size / scene.light_speed_m_s)
        + (slowest > 0 && slowest == scene.light_speed_m_s ? " s, because its animations must stay below a fifth of that"
                                                           : " s")
        + "; starbow check " + scene.file + " --write " + scene.name + ".json writes both for you to change");
    if (outline.moves)
        scene.notes.push_back(no_moving_shadows);
    return scene;
}

namespace {

/// A direction or a colour as JSON.
std::string list(const glm::dvec3& v) { return nlohmann::json{v.x, v.y, v.z}.dump(); }

std::string cone_text(const LightCone& cone)
{
    return ", \"cone\": { \"axis\": " + list(cone.axis) + ", \"inner_deg\": " + shown(glm::degrees(cone.inner_rad))
        + ", \"outer_deg\": " + shown(glm::degrees(cone.outer_rad)) + " }";
}

} // namespace

std::string scene_text(const SceneFile& scene, const std::filesystem::path& folder)
{
    std::error_code error;
    const std::filesystem::path gltf = std::filesystem::relative(scene.gltf, folder.empty() ? "." : folder, error);
    const glm::dmat3 axes = glm::mat3_cast(scene.start.ship_from_cockpit);
    std::ostringstream out;
    out << "// Suggested from the bounds of the glTF file; docs/scenes.md explains each member.\n{\n"
        << "    \"gltf\": " << nlohmann::json(error ? scene.gltf.string() : gltf.string()).dump() << ",\n"
        << "    \"unit_m\": " << shown(scene.unit_m) << ", // a unit of the file in metres\n"
        << "    \"light_speed_m_s\": " << shown(scene.light_speed_m_s)
        << ", // slower light makes the effects stronger at the same speed\n"
        << "    \"sky\": { \"zenith\": " << list(scene.sky.zenith) << ", \"horizon\": " << list(scene.sky.horizon)
        << ", \"nadir\": " << list(scene.sky.nadir) << " },\n"
        << "    \"ambient\": " << list(scene.ambient) << ",\n    \"shadows\": " << (scene.shadows ? "true" : "false")
        << ",\n    \"lights\": [";
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        out << (i > 0 ? ",\n        " : "\n        ");
        if (const auto* far = std::get_if<DirectionalLight>(&scene.lights[i]))
            out << "{ \"type\": \"directional\", \"towards\": " << list(far->towards)
                << ", \"radiance\": " << list(far->radiance) << " }";
        else if (const auto* near = std::get_if<PointLight>(&scene.lights[i]))
            out << "{ \"type\": \"point\", \"position\": " << list(near->position)
                << ", \"distance\": " << shown(near->distance) << ", \"radiance\": " << list(near->radiance)
                << (near->cone ? cone_text(*near->cone) : "") << " }";
    }
    out << "\n    ],\n";
    if (scene.ground)
        out << "    \"ground\": { \"middle\": " << list(scene.ground->middle)
            << ", \"half_width\": " << shown(scene.ground->half_width) << ", \"colour\": " << list(scene.ground->colour)
            << " },\n";
    out << "    \"start\": { \"position\": " << list(scene.start.position) << ", \"look\": " << list(-axes[2])
        << ", \"up\": " << list(axes[1]) << " }\n}\n";
    return out.str();
}

} // namespace starbow
