#include "world_sheet.h"
#include "config/json/digits.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/markup/html.h"
#include "config/markup/svg.h"
#include "config/model/file_kind.h"
#include "config/model/one_view.h"
#include "config/model/shipped.h"
#include "runtime/commands/median.h"
#include "runtime/images/capture.h"
#include "runtime/operation/progress.h"
#include "runtime/render/offscreen.h"
#include "runtime/render/pass_timer.h"
#include "runtime/render/render_context.h"
#include "runtime/shadow/still_things.h"
#include "runtime/world/blended.h"
#include "runtime/world/boxes.h"
#include "runtime/world/open_scene.h"
#include "runtime/world/outline.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace starbow {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr glm::ivec2 still_size{800, 600}, page_still{640, 480};
constexpr int timed_frames = 7;

/// One line of the page's table and of what is printed.
struct Fact {
    std::string name, value;
};

struct Still {
    std::string title;
    Shot shot;
};

std::string length(const SceneFile& scene, double units)
{
    const double m = units * scene.unit_m;
    return m >= 1e9 ? digits(m / 299792458) + " light-seconds" : m >= 1e4 ? digits(m / 1000) + " km" : digits(m) + " m";
}

std::vector<Fact> facts_of(const RenderContext& context, const AlignedBox& all, const Middle& middle)
{
    const World& world = context.world.world;
    const SceneFile& scene = context.world.scene;
    std::size_t triangles = 0, drawn = 0;
    for (const Primitive& primitive : world.primitives)
        triangles += primitive.index_count / 3;
    for (const Instance& instance : world.instances)
        drawn += world.primitives[instance.primitive].index_count / 3;
    double bytes = 0;
    for (const Image& image : context.world.textures)
        bytes += double(image.bytes);
    const glm::dvec3 size = all.high - all.low;
    return {
        {"size", length(scene, size.x) + " wide, " + length(scene, size.y) + " high, " + length(scene, size.z) + " deep"},
        {"from, to",
            "[" + digits(all.low.x) + ", " + digits(all.low.y) + ", " + digits(all.low.z) + "] to [" + digits(all.high.x)
                + ", " + digits(all.high.y) + ", " + digits(all.high.z) + "], in units of " + digits(scene.unit_m) + " m"},
        {"speed of light",
            digits(scene.light_speed_m_s) + " m/s; it crosses the world's middle, " + length(scene, middle.across())
                + ", in " + digits(middle.across() * scene.seconds_per_time_unit()) + " s"},
        {"triangles",
            std::to_string(triangles) + " in " + std::to_string(world.primitives.size()) + " surfaces; "
                + std::to_string(drawn) + " in " + std::to_string(world.instances.size()) + " instances"},
        {"materials", std::to_string(world.materials.size())},
        {"textures", std::to_string(world.textures.size()) + ", " + digits(bytes / (1 << 20)) + " MiB on this device"},
        {"light", describe(needed_level(world, scene))}};
}

/// The still from the right of whoever looks from the start, a little above.
Shot from_the_side(const Shot& start, const Middle& middle)
{
    const glm::dmat3 axes = glm::mat3_cast(start.ship_from_cockpit);
    const glm::dvec3 level(axes[0].x, 0, axes[0].z);
    const glm::dvec3 right = glm::length(level) > 1e-3 ? glm::normalize(level) : glm::dvec3(1, 0, 0);
    Shot shot = start;
    const Shot seen = overview(middle.box, middle.floor, right + glm::dvec3(0, 0.5, 0));
    shot.position = seen.position, shot.ship_from_cockpit = seen.ship_from_cockpit;
    return shot;
}

/// The plan, seen from above, with the start: x to the right and z down, in units of the scene.
std::string plan_of(const SceneFile& scene, const std::vector<AlignedBox>& things, AlignedBox all)
{
    constexpr double side = 560, margin = 30;
    const glm::dvec3 eye = scene.start.position;
    all = {glm::min(all.low, eye), glm::max(all.high, eye)};
    const double extent = std::max({all.high.x - all.low.x, all.high.z - all.low.z, 1e-9}),
                 scale = (side - 2 * margin) / extent;
    const auto x = [&](double at) { return margin + (at - all.low.x) * scale; };
    const auto y = [&](double at) { return margin + (at - all.low.z) * scale; };
    const double height = (all.high.z - all.low.z) * scale + 2 * margin + 24;
    Svg svg;
    for (const AlignedBox& box : things) {
        const glm::dvec2 corner(x(box.low.x), y(box.low.z));
        svg.rect(corner, corner + glm::max(glm::dvec2(box.high.x - box.low.x, box.high.z - box.low.z) * scale, 1.0),
            "fill=\"#0b5fa5\" fill-opacity=\"0.12\" stroke=\"#0b5fa5\" stroke-width=\"1\"");
    }
    const glm::dmat3 axes = glm::mat3_cast(scene.start.ship_from_cockpit);
    const glm::dvec2 at(x(eye.x), y(eye.z));
    const auto ray = [&](double angle_deg) {
        const double a = glm::radians(angle_deg);
        const glm::dvec3 way = std::cos(a) * -axes[2] + std::sin(a) * axes[0];
        return at + 60.0 * glm::dvec2(way.x, way.z);
    };
    svg.polygon(std::array{at, ray(-38), ray(38)}, "fill=\"#c2410c\" fill-opacity=\"0.35\" stroke=\"#c2410c\"");
    svg.circle(at, 4, "fill=\"#c2410c\"");
    // A rule of a round length, at most a third of the plan.
    double rule = std::pow(10, std::floor(std::log10(extent / 3)));
    for (const double step : {5.0, 2.0})
        if (step * rule <= extent / 3) {
            rule *= step;
            break;
        }
    svg.line({margin, height - 18}, {margin + rule * scale, height - 18}, "stroke=\"#1a1a1a\" stroke-width=\"2\"");
    svg.text({margin + rule * scale + 8, height - 14}, length(scene, rule) + "; the start in orange");
    return svg.drawn({side, height}, "role=\"img\" aria-label=\"Plan, seen from above\"");
}

double seconds_since(Clock::time_point began) { return std::chrono::duration<double>(Clock::now() - began).count(); }

} // namespace

int check_world(const std::string& name, const std::string& page_name, const std::string& write)
{
    const fs::path file = shipped_file("scenes", name);
    const SceneFile scene = open_scene(file);
    const fs::path page = page_name.empty() ? scene.name + "-world.html" : page_name;
    check_ending(page, ".html");
    check_writable(page);
    check_not_read(page, {file, scene.gltf});
    if (!write.empty()) {
        if (kind_of_file(file) != FileKind::gltf)
            throw InputError("--write is for a glTF file without a scene; " + scene.file + " is a scene itself");
        check_ending(write, ".json");
        check_free(write, false);
        check_writable(write);
    }
    Progress progress;
    progress.show("loading " + scene.name, 0);
    const auto began = Clock::now();
    RenderContext context(file, device_options(false));
    const double loaded_s = seconds_since(began);
    const std::vector<AlignedBox> things = read_outline(scene.gltf).things;
    AlignedBox all = things.empty() ? AlignedBox{} : things[0];
    for (const AlignedBox& box : things)
        all = around(all, box);
    const Middle middle = middle_of(things);
    std::vector<Fact> facts = facts_of(context, all, middle);

    const Layout view = one_view(Planar{60}, still_size);
    const Quality quality = default_quality(context.device, false);
    OffscreenRenderer timed(context.device, context.pipelines, context.world, view, quality, false);
    OffscreenRenderer renderer(context.device, context.pipelines, context.world, one_view(Planar{60}, page_still),
        default_quality(context.device, true), false);
    Shot fast = scene.start;
    fast.u = glm::mat3_cast(fast.ship_from_cockpit) * glm::dvec3(0, 0, -0.75); // gamma 1.25
    const std::vector<Still> stills{{"From the start", scene.start}, {"From the side", from_the_side(scene.start, middle)},
        {"From the start at 0.6 of the speed of light", fast}};
    PassTimer timer(context.device, timed);
    std::vector<double> rest_ms, fast_ms;
    for (int i = -1; i < timed_frames; ++i) {
        progress.show("timing " + scene.name, 0.3 + 0.4 * (i + 1) / (timed_frames + 1));
        const double rest = timer.frame(scene.start), flying = timer.frame(fast);
        if (i >= 0)
            rest_ms.push_back(rest), fast_ms.push_back(flying);
    }
    facts.push_back({"until it is shown", digits(loaded_s) + " s from the files to the device"});
    facts.push_back({"a frame of " + std::to_string(still_size.x) + " x " + std::to_string(still_size.y),
        digits(median(rest_ms)) + " ms at rest, " + digits(median(fast_ms)) + " ms at 0.6 c, on "
            + std::string(context.device.properties.deviceName.data())});

    std::ostringstream out;
    out << page_begin("en", scene.name, "img{width:100%;height:auto}td:last-child{text-align:left}") << "<h1>"
        << escaped_html(scene.name) << "</h1>\n<table>\n";
    for (const Fact& fact : facts)
        out << table_row({fact.name, fact.value});
    out << "</table>\n";
    std::vector<std::string> notes = context.world.world.notes;
    note_lacking_shadows(context.world.scene, context.world.world, notes);
    note_crossing_blended(context.world.world, notes);
    if (!notes.empty()) {
        out << "<h2>Notes</h2>\n<ul>\n";
        for (const std::string& note : notes)
            out << "<li>" << escaped_html(one_line(note)) << "</li>\n";
        out << "</ul>\n";
    }
    out << "<h2>Plan</h2>\n" << plan_of(scene, things, all);
    for (std::size_t i = 0; i < stills.size(); ++i) {
        progress.show("drawing " + scene.name, 0.7 + 0.3 * double(i) / double(stills.size()));
        Shot shot = stills[i].shot;
        const Exposing rules;
        shot.exposure_ev = std::clamp(renderer.metered(shot).value_or(0), rules.min_ev, rules.max_ev);
        out << "<h2>" << stills[i].title << "</h2>\n<img alt=\"" << stills[i].title << "\" src=\""
            << png_source(png_of(page_still, renderer.picture(shot)[0])) << "\">\n";
    }
    out << "</body></html>\n";
    if (page.has_parent_path())
        fs::create_directories(page.parent_path());
    write_whole(page, out.str());
    for (const Fact& fact : facts)
        std::printf("%s: %s\n", fact.name.c_str(), fact.value.c_str());
    for (const std::string& note : notes)
        std::printf("note: %s\n", one_line(note).c_str());
    if (!write.empty()) {
        const fs::path to(write);
        if (to.has_parent_path())
            fs::create_directories(to.parent_path());
        write_whole(to, scene_text(scene, to.parent_path()));
        std::printf("%s\n", to.c_str());
    }
    std::printf("%s\n", page.c_str());
    return 0;
}

} // namespace starbow
