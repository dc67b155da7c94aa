#include "signs.h"
#include "caption.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

// Angles from the view's axis within which a sign appears, and within which it stays, radians: all shipped views are wider.
constexpr double appears_within = 0.42, stays_within = 0.46;
/// Angular radii as seen: a larger thing needs no sign, a smaller one can't be distinguished.
constexpr double least_radius = 0.012, most_radius = 0.35;
/// cos of the angle from the motion, in the world, beyond which a thing is well behind.
constexpr double behind_cosine = -0.05;
constexpr double least_beta = 0.4; ///< slower ships see nothing ahead that lies behind them by so much
constexpr double old_light_s = 1; ///< a clock's light
constexpr double other_moment_s = 0.01; ///< of two eyes: a dial of tenths differs at every tenth moment
/// A thing's D over that straight ahead: with the headlight effect light goes with D^3, and a darker thing is not seen
/// beside the bright middle.
constexpr double least_D_part = 0.2;

double from_axis(const glm::dvec3& towards) { return std::acos(std::clamp(-towards.z, -1.0, 1.0)); }

/// The share of the way from a to b at which it enters a box, by the slabs of its sides; nothing where it misses it.
std::optional<double> enters(const glm::dvec3& a, const glm::dvec3& b, const AlignedBox& box)
{
    double from = 0, to = 1;
    for (int i = 0; i < 3; ++i) {
        const double way = b[i] - a[i];
        if (way == 0) {
            if (a[i] < box.low[i] || a[i] > box.high[i])
                return {};
            continue;
        }
        const double in = (box.low[i] - a[i]) / way, out = (box.high[i] - a[i]) / way;
        from = std::max(from, std::min(in, out)), to = std::min(to, std::max(in, out));
    }
    return from <= to ? std::optional(from) : std::nullopt;
}

/// True if another thing stands between. A thing that holds either end hides nothing: its box is larger than it.
bool is_hidden(const glm::dvec3& from, const glm::dvec3& at, std::span<const AlignedBox> things)
{
    return std::ranges::any_of(things, [&](const AlignedBox& box) {
        const auto holds = [&](const glm::dvec3& point) {
            return glm::all(glm::greaterThanEqual(point, box.low)) && glm::all(glm::lessThanEqual(point, box.high));
        };
        return !holds(from) && !holds(at) && enters(from, at, box);
    });
}

/// A thing that may have a sign, with the sphere around it, scene units.
struct Thing {
    Sign::Kind kind;
    std::size_t index;
    glm::dvec3 middle;
    double radius;
};

/// A sign with its thing as seen.
struct Apparent {
    Sign sign;
    double radius = 0; ///< as seen, radians
    bool is_true = false;
};

Apparent apparent(const Shot& shot, const Thing& thing, double seconds_per_time_unit, double eyes_apart)
{
    const MeasuringObserver observer = measuring_observer_of(shot);
    const glm::dvec3 way = thing.middle - observer.place;
    const double distance = glm::length(way);
    if (!(distance > thing.radius))
        return {};
    const Ray ray = ray_from_world(observer, way / distance);
    Apparent seen;
    seen.sign = {.kind = thing.kind,
        .thing = thing.index,
        .towards = glm::conjugate(shot.ship_from_cockpit) * ray.ship,
        .light_s = distance * seconds_per_time_unit};
    // A wave's front needs |n' x| of the ship's time from one eye to the other, and its source has emitted D times as long.
    seen.sign.eyes_apart_s = ray.D * std::abs(seen.sign.towards.x) * eyes_apart * seconds_per_time_unit;
    seen.radius = thing.radius / (distance * ray.D); // aberration makes small things smaller by 1 / D
    const double speed = glm::length(shot.u), beta = speed / std::sqrt(1 + speed * speed);
    const bool coloured = shot.effects[Effect::doppler] || shot.effects[Effect::headlight];
    const bool is_lit = !coloured || ray.D > least_D_part * physics::exp_rapidity(speed);
    const bool says_so = thing.kind == Sign::Kind::clock
        ? seen.sign.light_s > old_light_s
        : beta > least_beta && glm::dot(way, shot.u) < behind_cosine * distance * speed;
    seen.is_true = is_lit && says_so;
    return seen;
}

std::optional<Thing> clock_at(const World& world, std::size_t instance)
{
    const Instance& clock = world.instances[instance];
    const Primitive& primitive = world.primitives[clock.primitive];
    if (!world.materials[std::size_t(primitive.material)].clock || clock.motion >= 0 || clock.frame != 0)
        return {};
    const glm::dvec3 middle = clock.frame_from_local * glm::dvec4(0.5 * (primitive.low + primitive.high), 1),
                     corner = clock.frame_from_local * glm::dvec4(primitive.high, 1);
    return Thing{Sign::Kind::clock, instance, middle, glm::distance(middle, corner)};
}

} // namespace

std::optional<Sign> sign_for(const Shot& shot, std::span<const AlignedBox> things, const World& world,
    double seconds_per_time_unit, double eyes_apart, const std::optional<Sign>& before)
{
    if (!shot.effects[Effect::aberration] || shot.effects.comparison != Comparison::none)
        return {};
    std::vector<Thing> all;
    for (std::size_t i = 0; i < things.size(); ++i)
        all.push_back({Sign::Kind::behind, i, 0.5 * (things[i].low + things[i].high),
            0.5 * glm::distance(things[i].low, things[i].high)});
    for (std::size_t i = 0; i < world.instances.size(); ++i)
        if (const auto clock = clock_at(world, i))
            all.push_back(*clock);
    std::optional<Sign> best;
    double best_angle = appears_within;
    for (const Thing& thing : all) {
        const Apparent seen = apparent(shot, thing, seconds_per_time_unit, eyes_apart);
        const bool kept = before && before->kind == thing.kind && before->thing == thing.index;
        const double angle = from_axis(seen.sign.towards);
        const double slack = kept ? 1.5 : 1;
        if (!seen.is_true || angle > (kept ? stays_within : best_angle) || seen.radius < least_radius / slack
            || seen.radius > most_radius * slack || is_hidden(shot.position, thing.middle, things))
            continue;
        if (kept)
            return seen.sign;
        best = seen.sign;
        best_angle = angle;
    }
    return best;
}

std::vector<std::string> lines_of(const Sign& sign, const Words& words)
{
    if (sign.kind == Sign::Kind::behind)
        return {words("sign.behind"), words("sign.behind_light")};
    std::vector<std::string> lines{
        words("sign.clock"), words("sign.clock_light", {{"time", shown_duration(sign.light_s, words)}})};
    if (sign.eyes_apart_s > other_moment_s)
        lines.push_back(words("sign.clock_eyes"));
    return lines;
}

static double widest_of(const std::vector<std::string>& lines, const Typesetter& typesetter, int size)
{
    double widest = 0;
    for (const std::string& line : lines)
        widest = std::max(widest, typesetter.width_of(line, size));
    return widest;
}

/// Writes lines one below another, each in the panel's middle. baseline: the first one's.
static void write_lines(Panel& panel, const std::vector<std::string>& lines, double baseline, double pitch,
    const Typesetter& typesetter, int size)
{
    for (const std::string& line : lines) {
        typesetter.write(panel, line, 0.5 * (panel.size.x - typesetter.width_of(line, size)), baseline, size, 1);
        baseline += pitch;
    }
}

Panel draw_sign(const Typesetter& typesetter, const std::vector<std::string>& lines, double degree_px)
{
    const int size = std::max(8, int(sign_letters_deg * degree_px));
    const double pitch = 1.15 * size, edge = 0.45 * size, arrow = 1.2 * size;
    const int width = int(widest_of(lines, typesetter, size) + 2 * edge) + 1,
              plate_height = int(double(lines.size()) * pitch + 0.9 * edge);
    Panel panel = plate({width, plate_height}, edge);
    panel.size.y = plate_height + int(arrow);
    panel.texels.resize(std::size_t(panel.size.x) * panel.size.y * 2, 0);
    for (int y = plate_height; y < panel.size.y; ++y) { // the arrow, in the plate's colour with a bright core
        const double half = 0.45 * (panel.size.y - y);
        for (int x = 0; x < width; ++x) {
            const double aside = std::abs(x + 0.5 - 0.5 * width);
            std::uint8_t* texel = &panel.texels[2 * (std::size_t(y) * width + x)];
            texel[0] = std::uint8_t(255 * std::clamp(half - 0.12 * size - aside + 0.5, 0.0, 1.0));
            texel[1] = std::uint8_t(255 * std::clamp(half - aside + 0.5, 0.0, 1.0));
        }
    }
    write_lines(panel, lines, 0.45 * edge + 0.86 * size, pitch, typesetter, size);
    return panel;
}

Panel draw_name(const Typesetter& typesetter, const std::string& name, double degree_px)
{
    const int size = std::max(8, int(sign_letters_deg * degree_px));
    const double edge = 0.4 * size;
    Panel panel = plate({int(typesetter.width_of(name, size) + 2 * edge) + 1, int(1.3 * size)}, edge);
    typesetter.write(panel, name, edge, size, size, 1);
    return panel;
}

Panel draw_title(const Typesetter& typesetter, const std::string& title, int width)
{
    int size = std::max(8, int(title_letters * width));
    const double pitch = 1.2 * size, edge = 0.6 * size, most = width - 2 * edge;
    const std::vector<std::string> lines
        = wrapped(title, most, [&](const std::string& line) { return typesetter.width_of(line, size); });
    while (size > 1 && widest_of(lines, typesetter, size) > most)
        --size; // one of its words alone is wider than a line
    const int widest = int(widest_of(lines, typesetter, size) + 2 * edge) + 1;
    Panel panel = plate({widest, int(double(lines.size()) * pitch + edge)}, edge);
    write_lines(panel, lines, 0.5 * edge + 0.9 * size, pitch, typesetter, size);
    return panel;
}

} // namespace starbow
