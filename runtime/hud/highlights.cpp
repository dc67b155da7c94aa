#include "highlights.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/angles.h"
#include "config/model/inset_view.h"
#include "instruments.h"
#include "runtime/world/globes.h"
#include "runtime/world/worldline.h"
#include "signs.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double line_deg = 0.22, outline_deg = 0.13; ///< widths of the bright line, and of the dark one at either side

double angular_radius(double radius, double distance) { return distance > radius ? std::asin(radius / distance) : pi / 2; }

/// The direction of light from a place of the observer's own coordinates, and the angle that a small thing there has.
SeenHighlight seen_at(const Shot& shot, const glm::dvec3& place, double radius)
{
    const MeasuringObserver observer = measuring_observer_of(shot);
    const glm::dvec3 way = place - observer.place;
    const double distance = glm::length(way);
    if (!(distance > radius))
        return {.radius = pi / 2};
    const Ray ray = ray_from_world(observer, way / distance);
    // Aberration maps circles to circles, and a small one's radius is divided by D.
    const double D = observer.aberration ? ray.D : 1;
    return {glm::conjugate(shot.ship_from_cockpit) * ray.ship, std::min(angular_radius(radius, distance) / D, pi / 2)};
}

/// The shot by which the picture shows what moves: without aberration as from rest in the world.
Shot seeing_moving(Shot shot)
{
    if (!shot.effects[Effect::aberration])
        shot.u = glm::dvec3(0), shot.effects.on.set(Effect::aberration, true);
    return shot;
}

/// A thing on a body, by the part of its worldline from which light arrives; on a broken worldline there is one at most.
std::optional<SeenHighlight> seen_on(const Body& body, const Highlight& highlight, const Shot& shot)
{
    for (const WorldlineSegment& segment : segments_of(body)) {
        const Shot there = in_frame({segment.u, segment.from}, seeing_moving(shot));
        const double begun = std::isfinite(segment.begin) ? segment.begin : 0,
                     own_time = begun + there.time - glm::distance(there.position, highlight.at);
        if (own_time >= segment.begin && own_time < segment.end)
            return seen_at(there, highlight.at, 0.5 * highlight.across);
    }
    return {};
}

std::optional<SeenHighlight> seen_globe(
    const Globes& globes, const std::string& name, const Shot& shot, const SceneFile& scene)
{
    for (const SeenGlobe& seen : globes_seen(globes, scene, shot))
        if (const Globe& globe = globes.system.globes[seen.globe]; globe.name == name)
            return seen_at(shot, shot.position + seen.from_eye, globe.radius_m / scene.unit_m);
    return {};
}

} // namespace

std::optional<SeenHighlight> seen_highlight(
    const Highlight& highlight, const Shot& shot, const World& world, const SceneFile& scene)
{
    if (shot.effects.comparison != Comparison::none)
        return {};
    if (!highlight.globe.empty())
        return seen_globe(*world.globes, highlight.globe, shot, scene);
    if (highlight.body.empty())
        return seen_at(shot, highlight.at, 0.5 * highlight.across);
    return seen_on(*std::ranges::find(scene.bodies, highlight.body, &Body::name), highlight, shot);
}

void check_highlights(const Tour& tour, const SceneFile& scene)
{
    const auto is_among = [](const auto& all, const std::string& name) {
        return std::ranges::any_of(all, [&](const auto& one) { return one.name == name; });
    };
    std::vector<Globe> globes; // read where a highlight names one
    for (std::size_t i = 0; i < tour.steps.size(); ++i)
        for (std::size_t k = 0; k < tour.steps[i].highlights.size(); ++k) {
            const Highlight& highlight = tour.steps[i].highlights[k];
            const auto refuse = [&](const char* member, const std::string& name) {
                throw InputError(tour.file.string(),
                    "/steps/" + std::to_string(i) + "/highlights/" + std::to_string(k) + "/" + member,
                    "is " + one_line(name, 40) + ", but the scene " + one_line(tour.scene, 60) + " has no such " + member
                        + "; the name of one that it has is right");
            };
            if (!highlight.body.empty() && !is_among(scene.bodies, highlight.body))
                refuse("body", highlight.body);
            if (highlight.globe.empty())
                continue;
            if (globes.empty() && scene.globes)
                globes = load_solar_system(scene.globes->file).globes;
            if (!is_among(globes, highlight.globe))
                refuse("globe", highlight.globe);
        }
}

double enlarged_fov_deg(const SeenHighlight& seen, double below, double before)
{
    constexpr double part = 0.8; // of the inset's height
    const double across = 2 * seen.radius / degree;
    if (across <= 0 || across >= (before > 0 ? 1.15 : 1) * below)
        return 0;
    return stepped_fov_deg(across / part, before);
}

std::vector<ShownHighlight> shown_highlights(const std::vector<Highlight>& highlights, const Shot& shot, const World& world,
    const SceneFile& scene, std::array<double, 2>& enlarged_deg)
{
    std::vector<ShownHighlight> shown;
    std::array<double, 2> now{};
    const double below
        = std::ranges::count(highlights, true, &Highlight::enlarged) > 1 ? compared_below_deg : enlarged_below_deg;
    for (std::size_t k = 0; k < highlights.size(); ++k)
        if (const auto seen = seen_highlight(highlights[k], shot, world, scene)) {
            if (highlights[k].enlarged)
                now[k] = enlarged_fov_deg(*seen, below, enlarged_deg[k]);
            shown.push_back({highlights[k].name, seen->towards, seen->radius, now[k]});
        }
    enlarged_deg = now;
    return shown;
}

double ring_deg(const ShownHighlight& highlight)
{
    constexpr double least = 1.6, most = 16;
    const double ring = std::max(1.15 * highlight.radius / degree + 0.5, least);
    return ring > most ? 0 : ring;
}

double ring_middle_px(double ring_px, double degree_px) { return ring_px + (0.5 * line_deg + outline_deg) * degree_px + 1; }

/// The panel's two numbers, light and cover, at a distance from the middle of a line.
static void draw_stroke(std::uint8_t* texel, double from_line, double degree_px)
{
    const double half = std::max(0.5 * line_deg * degree_px, 0.75), outline = std::max(outline_deg * degree_px, 1.0);
    const auto cover = [&](double beyond) { return std::uint8_t(255 * std::clamp(beyond - from_line + 0.5, 0.0, 1.0)); };
    texel[0] = std::max(texel[0], cover(half));
    texel[1] = std::max(texel[1], cover(half + outline));
}

Panel draw_ring(const Typesetter& typesetter, const std::string& name, double ring_px, double degree_px)
{
    const Panel plate = draw_name(typesetter, name, degree_px);
    const double middle_up = ring_middle_px(ring_px, degree_px);
    const int ring = int(std::ceil(2 * middle_up)), gap = int(0.3 * degree_px);
    Panel panel{.size = {std::max(plate.size.x, ring), plate.size.y + gap + ring}};
    panel.texels.resize(2 * std::size_t(panel.size.x) * std::size_t(panel.size.y));
    const int left = (panel.size.x - plate.size.x) / 2;
    for (int y = 0; y < plate.size.y; ++y)
        std::copy_n(&plate.texels[2 * std::size_t(y) * plate.size.x], 2 * plate.size.x,
            &panel.texels[2 * (std::size_t(y) * panel.size.x + left)]);
    const glm::dvec2 middle(0.5 * panel.size.x, panel.size.y - middle_up);
    for (int y = plate.size.y + gap; y < panel.size.y; ++y)
        for (int x = 0; x < panel.size.x; ++x)
            draw_stroke(&panel.texels[2 * (std::size_t(y) * panel.size.x + x)],
                std::abs(glm::distance(glm::dvec2(x, y) + 0.5, middle) - ring_px), degree_px);
    return panel;
}

Panel draw_line(double degree_px)
{
    const int width = int(std::ceil((line_deg + 2 * outline_deg) * degree_px)) + 2;
    Panel panel{.size = {width, 2}};
    panel.texels.resize(2 * std::size_t(panel.size.x) * std::size_t(panel.size.y));
    for (int y = 0; y < panel.size.y; ++y)
        for (int x = 0; x < width; ++x)
            draw_stroke(&panel.texels[2 * (std::size_t(y) * width + x)], std::abs(x + 0.5 - 0.5 * width), degree_px);
    return panel;
}

} // namespace starbow
