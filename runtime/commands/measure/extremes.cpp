#include "extremes.h"
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "config/model/angles.h"
#include "config/model/exhibit_file.h"
#include "config/model/one_view.h"
#include "config/model/shipped.h"
#include "runtime/commands/options/size.h"
#include "runtime/flight/ship.h"
#include "runtime/images/picture_errors.h"
#include "runtime/reference/number_errors.h"
#include "runtime/render/offscreen.h"
#include "runtime/render/render_context.h"
#include "runtime/world/worldline.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <unistd.h>

namespace starbow {
namespace {

/// Directions on board are floats: each of three sums may be rounded by as much.
constexpr double resolved_rad = 1.5e-7;

template <class... Values> std::string text(const char* format, Values... values)
{
    std::array<char, 200> buffer;
    std::snprintf(buffer.data(), buffer.size(), format, values...);
    return buffer.data();
}

/// What was tried, what is stated of it, and what came of it.
class Table {
public:
    void add(const std::string& what, const std::string& stated, const std::string& found, bool holds)
    {
        const char* verdict = holds ? "holds" : "FAILS";
        std::printf("%-52s %-34s %-52s %s\n", what.c_str(), stated.c_str(), found.c_str(), verdict);
        std::fflush(stdout);
        markdown_ += "| " + what + " | " + stated + " | " + found + " | " + verdict + " |\n";
        failures_ += !holds;
    }
    /// A value below its bound.
    void add(const std::string& what, const std::string& stated, double value, double bound)
    {
        add(what, stated + text(" at most %.3g", bound), text("%.3g", value), std::isfinite(value) && value <= bound);
    }
    int failures() const { return failures_; }
    std::string markdown() const { return "| case | stated | found | |\n|---|---|---|---|\n" + markdown_; }

private:
    std::string markdown_;
    int failures_ = 0;
};

void fly_far(Table& table)
{
    // Up to gamma 1e9 and back in steps of a tenth in rapidity: gamma = cosh eta.
    const double top = std::acosh(1e9);
    for (double step : {0.1, 0.005}) {
        Ship ship;
        const int steps = int(std::lround(top / step));
        const double a = top / steps;
        for (int i = 0; i < steps; ++i)
            ship = fly(ship, {0, 0, -a}, {}, 1);
        const double wrong = std::abs(glm::length(ship.u.total()) / std::sinh(top) - 1);
        table.add(text("state: from rest to gamma 1e9 in %d steps", steps), "u, relative:", wrong, 1e-12);
        for (int i = 0; i < steps; ++i)
            ship = fly(ship, {0, 0, a}, {}, 1);
        table.add("state: and back to rest", "u:", glm::length(ship.u.total()), step < 0.01 ? 1e-12 : 1e-16 * 1e9);
    }
    // A turn of the cockpit at gamma 1e6, once round in a minute.
    Ship ship;
    ship.u = Sum3({0, 0, -1e6});
    const glm::dquat before = ship.ship_from_cockpit;
    for (int i = 0; i < 3600; ++i)
        ship = fly(ship, {}, {0, 360 * degree / 3600, 0}, 1);
    table.add("state: a turn of 360 degrees at gamma 1e6",
        "radians:", 2 * std::acos(std::min(1.0, std::abs(glm::dot(before, ship.ship_from_cockpit)))), 1e-7);
    table.add("state: its speed meanwhile", "u, relative:", std::abs(glm::length(ship.u.total()) / 1e6 - 1), 1e-15);
    Ship reversed;
    reversed.u = Sum3({0, 0, -1e6});
    const double eta = 2 * std::asinh(1e6);
    for (int i = 0; i < 4000; ++i)
        reversed = fly(reversed, {0, 0, eta / 4000}, {}, 1);
    table.add(
        "state: reversed at gamma 1e6", "u, relative:", glm::length(reversed.u.total() - glm::dvec3(0, 0, 1e6)) / 1e6, 1e-9);
    // A month of frames.
    Sum time;
    const long frames = 30L * 86400 * 60;
    for (long i = 0; i < frames; ++i)
        time.add(1.0 / 60);
    table.add("state: the clock after 30 days at 60 Hz", "seconds:", std::abs(time.total() - 30.0 * 86400), 1e-6);
    Ship flown;
    flown.u = Sum3({0, 0, -std::sqrt(15.0)});
    const long hour = 3600 * 60;
    for (long i = 0; i < hour; ++i)
        flown = fly(flown, {}, {}, 1.0 / 60);
    table.add("state: the ship's place after an hour at gamma 4",
        "light-seconds:", std::abs(flown.position.total().z + std::sqrt(15.0) * 3600), 1e-8);
}

/// A world that may be changed, and how it is seen.
struct ExtremeCase {
    std::string what;
    SceneFile scene;
    World world;
    Layout layout;
    Shot shot;
    double least_dB = 20; ///< against the reference of four rays a pixel
};

struct ExtremesBench {
    Device device{device_options(false)};
    Pipelines pipelines{device};

    void show(Table& table, const ExtremeCase& c)
    {
        World placed = c.world;
        place_bodies(placed, c.scene);
        const std::vector<Star> no_stars; // a spot of light for each would hide what is looked for
        const SceneFile& scene = c.scene;
        // A pixel of much of the sky wants more than four rays for its mean.
        const glm::ivec2 size = c.layout.outputs[0].size;
        const int samples = std::max(4, 4096 / (size.x * size.y));
        const Reference truth = reference({placed, scene, no_stars}, c.layout, c.shot, 0, {.samples = samples});
        const GpuWorld world = upload(device, pipelines, c.world, scene);
        Quality quality = default_quality(device, true);
        OffscreenRenderer renderer(device, pipelines, world, c.layout, quality, true);
        const auto picture = renderer.picture(c.shot);
        const auto should = shown(truth);
        const NumberErrors errors = number_errors(truth, renderer.numbers(c.shot, 0), c.shot.u, resolved_rad);
        const double psnr = psnr_dB({truth.size, picture[0]}, {truth.size, should}),
                     direction = quantile(errors.directions_px, 1), D = quantile(errors.doppler, 1);
        table.add(c.what, text("finite, 0.001 px, D 1e-6, %.0f dB", c.least_dB),
            text(
                "%s, %.1e px, D %.1e, %.0f dB", errors.finite ? "finite" : "NOT FINITE", direction, D, std::min(psnr, 99.0)),
            errors.finite && direction <= 0.001 && D <= 1e-6 && psnr >= c.least_dB && device.complaints.empty());
    }
};

Shot flying(Shot shot, double gamma, double look_deg)
{
    const double deficit = gamma - 1; // exact where it is small
    shot.u = {0, 0, -std::sqrt(deficit * (gamma + 1))};
    shot.ship_from_cockpit = glm::angleAxis(look_deg * degree, glm::dvec3(0, 1, 0));
    // As bright as the light is there: within the eyes' range, whatever D^3 does.
    const double E = physics::exp_rapidity(glm::length(shot.u)), s = std::pow(std::sin(0.5 * look_deg * degree), 2);
    const double D = 1 / ((1 - s) / E + s * E);
    shot.exposure_ev = std::clamp(-3 * std::log2(D), -30.0, 30.0);
    shot.effects.on.set(Effect::doppler, false); // light that is shifted out of sight would be dark, and show nothing wrong
    return shot;
}

/// What a reader says of a text; "" where it takes it.
std::string refusal(const std::string& content, const std::function<void(const std::filesystem::path&)>& read)
{
    const std::filesystem::path file
        = std::filesystem::temp_directory_path() / ("starbow-extreme-" + std::to_string(::getpid()) + ".json");
    write_whole(file, content);
    std::string why;
    try {
        read(file);
    } catch (const InputError& error) {
        why = error.what();
        if (const std::size_t at = why.find(".json:"); at != why.npos)
            why = why.substr(at + 6);
    }
    std::filesystem::remove(file);
    return why;
}

void refuse(Table& table)
{
    const auto expect = [&](const std::string& what, const std::string& why) {
        table.add(what, "refused in a sentence", why, !why.empty());
    };
    expect("a shot at gamma 1e10",
        refusal(R"({ "scene": "avenue", "position": [0, 0, 0], "look": [0, 0, -1],
        "velocity": { "direction": [0, 0, -1], "gamma": 1e10 } })",
            [](const auto& file) { load_shot(file); }));
    expect("a view of 0.01 degrees",
        refusal(R"({ "outputs": [{ "name": "a", "size": [8, 8],
        "viewports": [{ "projection": { "type": "planar", "fov_y_deg": 0.01 } }] }] })",
            [](const auto& file) { load_layout(file); }));
    expect("a fisheye of 361 degrees",
        refusal(R"({ "outputs": [{ "name": "a", "size": [8, 8],
        "viewports": [{ "projection": { "type": "fisheye", "aperture_deg": 361 } }] }] })",
            [](const auto& file) { load_layout(file); }));
    expect("an output of 16385 pixels", refusal("", [](const auto&) { parse_size("16385x1"); }));
    expect("an exposure of 61 EV",
        refusal(R"({ "exposure": { "max_ev": 61 } })", [](const auto& file) { load_exhibit(file); }));
}

/// Every second ring around a point: their radii double, from the smallest on, and each is regular polygons of 24 corners.
/// axis: at right angles to them.
World rings(const glm::dvec3& place, const glm::dvec3& axis, double smallest, int count)
{
    World world;
    constexpr std::uint32_t corners = 24;
    for (int ring = 0; ring < count; ring += 2)
        for (std::uint32_t k = 0; k < corners; ++k) {
            const auto first = std::uint32_t(world.vertices.size());
            for (const auto& [grown, corner] : {std::pair(ring, k), {ring + 1, k}, {ring + 1, k + 1}, {ring, k + 1}}) {
                const double r = std::ldexp(smallest, grown), a = 2 * pi * corner / corners;
                world.vertices.push_back(
                    {glm::vec3(r * std::cos(a), r * std::sin(a), 0), glm::vec3(0, 0, 1), glm::vec2(0), 0xffffffff});
            }
            world.indices.insert(world.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
        }
    const glm::dvec3 corner(std::ldexp(smallest, count), std::ldexp(smallest, count), 0);
    world.primitives.push_back(
        {0, std::uint32_t(world.indices.size()), 0, 0, -corner, corner, glm::dvec3(0), glm::length(corner), {}});
    world.materials.push_back({.double_sided = true, .unlit = true});
    world.nodes.push_back({"rings", -1});
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), axis));
    world.instances.push_back(
        {glm::dmat4(glm::dvec4(x, 0), glm::dvec4(glm::cross(axis, x), 0), glm::dvec4(axis, 0), glm::dvec4(place, 1)), 0, 0});
    return world;
}

/// Straight behind, in flight oblique to the world's axes, triangles are a millionth as wide as they are far.
void see_small(Table& table, ExtremesBench& stage)
{
    const glm::dvec3 way = glm::normalize(glm::dvec3(1, 2, -3));
    for (double gamma : {1e4, 3e4, 1e5, 3e5, 1e6}) {
        constexpr double far = 7;
        Shot shot;
        shot.u = std::sqrt((gamma - 1) * (gamma + 1)) * way;
        shot.ship_from_cockpit = orientation(-way, {0, 1, 0});
        shot.effects = {.on = {Effect::aberration}};
        stage.show(table,
            {text("picture: rings straight behind, oblique, gamma %g", gamma), SceneFile{},
                rings(-far * way, way, 0.02 * far / (2 * gamma), 6), one_view(Planar{60}, {160, 120}), shot, 25});
    }
}

void see_far(Table& table, ExtremesBench& stage)
{
    SceneFile scene = load_scene_file(shipped_file("scenes", "avenue"));
    const World world = load_world(scene);
    Shot start = scene.start;
    start.position.z = -8;
    const glm::ivec2 small(160, 120);
    const auto plain = [&](const std::string& what, const Layout& layout, const Shot& shot, double least_dB = 20) {
        stage.show(table, {what, scene, world, layout, shot, least_dB});
    };
    for (double beyond : {0.0, 1e-12, 1e-6, 1.0, 99.0, 1e4, 1e6})
        for (const auto& [name, look] : {std::pair{"ahead", 0.0}, {"aside", 90.0}, {"behind", 180.0}})
            plain(text("picture: gamma 1 + %g, %s", beyond, name), one_view(Planar{60}, small),
                flying(start, 1 + beyond, look));
    // An odd number of pixels: the middle one looks exactly along the motion.
    for (double look : {0.0, 180.0})
        plain(text("picture: exactly %s at gamma 1e6", look == 0 ? "ahead" : "behind"), one_view(Planar{60}, {161, 121}),
            flying(start, 1e6, look));
    Shot reversed = flying(start, 100, 180);
    reversed.u = -reversed.u, reversed.exposure_ev = -reversed.exposure_ev;
    plain("picture: reversed at gamma 100", one_view(Planar{60}, small), reversed);
    for (double turn : {0.01, 45.0, 135.0, 179.99})
        plain(
            text("picture: turned by %g degrees at gamma 1e6", turn), one_view(Planar{60}, small), flying(start, 1e6, turn));
    plain("picture: 1 x 1 pixels at gamma 4", one_view(Planar{60}, {1, 1}), flying(start, 4, 30),
        10); // four rays for 60 degrees, over which the headlight effect varies a hundredfold
    plain("picture: 16384 x 128 pixels at gamma 4", one_view(Planar{1.55}, {16384, 128}), flying(start, 4, 30));
    plain("picture: 8 x 16384 pixels at gamma 4", one_view(Planar{120}, {8, 16384}), flying(start, 4, 30));
    plain("picture: a view of 0.1 degrees", one_view(Planar{0.1}, small), flying(start, 4, 10));
    plain("picture: a fisheye of 360 degrees", one_view(Fisheye{360, 0}, small), flying(start, 4, 0), 15);
    for (double ev : {-30.0, 30.0}) {
        Shot exposed = start;
        exposed.exposure_ev = ev;
        plain(text("picture: exposed by %+g EV", ev), one_view(Planar{60}, small), exposed);
    }
    for (double strength : {1e-40, 1e30}) {
        ExtremeCase c{text("picture: light of %g", strength), scene, world, one_view(Planar{60}, small), start};
        c.scene.sky.zenith = c.scene.sky.horizon = c.scene.sky.nadir = glm::dvec3(strength);
        for (Material& material : c.world.materials)
            material.emissive = glm::vec3(float(strength));
        stage.show(table, c);
    }
    {
        // Everything a thousandth as large, so that columns stand a thousandth of a light-second away, and 1e9 from the
        // origin.
        ExtremeCase c{"picture: 1e9 light-seconds out, columns at 1e-3", scene, world, one_view(Planar{60}, small), start};
        const glm::dvec3 out(1e9, 0, 0);
        for (Instance& instance : c.world.instances) {
            glm::dmat4& m = instance.frame_from_local;
            const glm::dvec3 place(m[3]);
            m = glm::dmat4(1e-3 * glm::dmat3(m));
            m[3] = glm::dvec4(out + 1e-3 * place, 1);
        }
        for (Light& light : c.scene.lights)
            if (PointLight* point = std::get_if<PointLight>(&light))
                point->position = out + 1e-3 * point->position, point->distance *= 1e-3;
        c.shot = flying(start, 4, 30);
        c.shot.position = out + 1e-3 * start.position;
        stage.show(table, c);
    }
    {
        ExtremeCase c{
            "picture: light of 1 m/s, at gamma 100", scene, world, one_view(Planar{60}, small), flying(start, 100, 20)};
        c.scene.unit_m = c.scene.light_speed_m_s = 1;
        stage.show(table, c);
    }
    {
        const SceneFile clocks = load_scene_file(shipped_file("scenes", "clocks"));
        ExtremeCase c{"picture: clocks after 30 days", clocks, load_world(clocks), one_view(Planar{60}, {320, 240}),
            load_shot(shipped_file("shots", "clocks-passing"))};
        c.shot.time += 30.0 * 86400 / clocks.seconds_per_time_unit();
        stage.show(table, c);
    }
}

} // namespace

int measure_extremes(const std::string& folder)
{
    const std::filesystem::path file = std::filesystem::path(folder) / "extremes.md";
    if (!folder.empty())
        check_writable(file);
    Table table;
    fly_far(table);
    refuse(table);
    ExtremesBench stage;
    see_far(table, stage);
    see_small(table, stage);
    if (!folder.empty()) {
        std::filesystem::create_directories(folder);
        write_whole(file, table.markdown());
        std::printf("%s\n", file.c_str());
    }
    std::printf("%d of these fail\n", table.failures());
    return table.failures() == 0 ? 0 : 1;
}

} // namespace starbow
