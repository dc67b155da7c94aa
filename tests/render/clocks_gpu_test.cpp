// Clocks in the picture, read as a visitor reads them: from the hands' directions and the lit segments of the figures, by
// pixels alone. A textbook's pinhole and boost give a pixel's direction; plane geometry gives its place on a dial.
#include "config/model/angles.h"
#include "runtime/world/detail.h"
#include "tests/support/quad.h"
#include "tests/support/small_world.h"
#include <algorithm>
#include <complex>
#include <cstdio>
#include <map>

namespace starbow::gpu_test::clocks_gpu_test {
namespace {

/// A flat dial in the world.
struct Dial {
    dvec3 middle, right, up; ///< unit directions
    double radius;
};

/// Transforms a direction from the ship to the world by a boost of the light's 4-momentum, along and across the motion.
dvec3 world_of(const dvec3& camera, const dvec3& u)
{
    const double speed = glm::length(u);
    if (speed == 0)
        return camera;
    const double gamma = std::sqrt(1 + speed * speed);
    const dvec3 way = u / speed, p = -camera;
    const double along = glm::dot(way, p);
    return -(p - way * along + way * (gamma * along + speed)) / (gamma + speed * along);
}

/// A pixel that shows part of a dial.
struct Spot {
    dvec2 at; ///< on the dial, in units of its radius, y up
    double offset; ///< light-travel offset to the dial's middle, in scene time
    double ink; ///< 0 on the face, 1 on a mark
};

/// The event of an eye that stands beside the ship's place by `beside`, simultaneous in the ship.
quad::V4 eye_event(const Shot& shot, const dvec3& beside)
{
    const quad::V4 from = quad::boosted(quad::of(shot.u), {0, quad::of(beside)});
    return {shot.time + from.t, quad::of(shot.position) + from.x};
}

/// Draws a view straight at one dial, from an eye beside the ship's place (ship frame), and returns its spots.
/// half_width: half the view's width, in radii of a dial seen from the front.
std::vector<Spot> look_at(
    const GpuWorld& world, Shot shot, const Dial& dial, int size, const dvec3& beside = {0, 0, 0}, double half_width = 1.15)
{
    const quad::V4 eye = eye_event(shot, beside);
    const dvec3 to = dial.middle - dvec3(double(eye.x.x), double(eye.x.y), double(eye.x.z));
    const auto seen = quad::camera_from_world(quad::of(to), quad::of(shot.u));
    const dvec3 look(double(seen.n.x), double(seen.n.y), double(seen.n.z));
    const dvec3 up = std::abs(look.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(0, 0, 1), right = glm::normalize(glm::cross(look, up));
    const dmat3 ship_from_cockpit(right, glm::cross(right, look), -look);
    shot.ship_from_cockpit = orientation(look, up);
    const double half = half_width * dial.radius / (glm::length(to) * double(seen.D));
    Layout layout = one_view(Planar{2 * std::atan(half) / degree}, {size, size});
    layout.outputs[0].viewports[0].eye_m = glm::transpose(ship_from_cockpit) * beside;
    OffscreenRenderer offscreen = renderer(world, layout);
    const Numbers numbers(offscreen, shot);
    std::vector<Spot> spots;
    std::vector<double> face;
    const dvec3 front = glm::cross(dial.right, dial.up);
    for (int i = 0; i < numbers.count(); ++i) {
        const dvec2 pixel = (2.0 * numbers.centre(i) / double(size) - 1.0) * half;
        const dvec3 way = world_of(glm::normalize(ship_from_cockpit * dvec3(pixel.x, -pixel.y, -1)), shot.u);
        const double distance = glm::dot(front, to) / glm::dot(front, way);
        const dvec3 on = way * distance - to;
        const dvec2 at = dvec2(glm::dot(on, dial.right), glm::dot(on, dial.up)) / dial.radius;
        if (distance < 0 || glm::length(at) > 0.98)
            continue;
        spots.push_back({at, glm::length(to) - distance, numbers.light(i).g});
        face.push_back(spots.back().ink);
    }
    // Most of a dial is its face.
    std::nth_element(face.begin(), face.begin() + std::ptrdiff_t(face.size() / 2), face.end());
    const double white = face[face.size() / 2];
    for (Spot& spot : spots)
        spot.ink = 1 - spot.ink / white;
    return spots;
}

/// Reads a hand around `middle` from its part between two distances: seconds at the dial's middle, from 0 to turn_s.
double read_hand(
    const std::vector<Spot>& spots, const dvec2& middle, double low, double high, double turn_s, double seconds_per_time)
{
    std::complex<double> sum = 0;
    for (const Spot& spot : spots) {
        const dvec2 from = spot.at - middle;
        if (glm::length(from) < low || glm::length(from) > high || spot.ink < 0.03)
            continue;
        // The direction of this part of the hand, corrected to the retarded time of the dial's middle.
        const double turn = std::atan2(from.x, from.y) / (2 * pi) - spot.offset * seconds_per_time / turn_s;
        sum += std::polar(std::min(spot.ink, 1.0), 2 * pi * turn);
    }
    const double turn = std::arg(sum) / (2 * pi);
    return (turn < 0 ? turn + 1 : turn) * turn_s;
}

struct Hands {
    double main_s, fast_s, slow_s;
};
Hands read_hands(const std::vector<Spot>& spots, double seconds_per_time = 1)
{
    return {read_hand(spots, {0, 0}, 0.70, 0.79, 60, seconds_per_time),
        read_hand(spots, {-0.38, 0.06}, 0.08, 0.17, 10, seconds_per_time),
        read_hand(spots, {0.38, 0.06}, 0.08, 0.17, 3600, seconds_per_time)};
}

/// The difference of two readings of a hand.
double apart(double a, double b, double turn_s) { return std::abs(std::remainder(a - b, turn_s)); }

/// Reads seven segments: a figure, '-', or 0 if they are none.
char figure_of(int lit)
{
    const std::map<int, char> known
        = {{0b0111111, '0'}, {0b0000110, '1'}, {0b1011011, '2'}, {0b1001111, '3'}, {0b1100110, '4'}, {0b1101101, '5'},
            {0b1111101, '6'}, {0b0000111, '7'}, {0b1111111, '8'}, {0b1101111, '9'}, {0b1000000, '-'}};
    const auto found = known.find(lit);
    return found == known.end() ? '\0' : found->second;
}

double ink_around(const std::vector<Spot>& spots, const dvec2& at, double half)
{
    double sum = 0;
    int count = 0;
    for (const Spot& spot : spots)
        if (std::abs(spot.at.x - at.x) < half && std::abs(spot.at.y - at.y) < half)
            sum += spot.ink, ++count;
    EXPECT_GT(count, 0);
    return sum / count;
}

/// Reads a number of unknown length: the longest row of cells that all show a figure.
std::string read_figures(const std::vector<Spot>& spots)
{
    for (int count = 12; count > 1; --count) {
        const double cell = std::min(0.17, 0.84 / (count + 0.4)), y = 0.33 * cell, x = 0.27 * cell;
        const std::array<dvec2, 7> segments = {dvec2(0, 2 * y), {x, y}, {x, -y}, {0, -2 * y}, {-x, -y}, {-x, y}, {0, 0}};
        std::string text;
        for (int k = 0; k < count; ++k) {
            const double point = k == count - 1 ? 0.4 : 0;
            const dvec2 middle((k + 0.5 + point - 0.5 * (count + 0.4)) * cell, -0.43);
            int lit = 0;
            for (int i = 0; i < 7; ++i)
                lit |= (ink_around(spots, middle + segments[std::size_t(i)], 0.07 * cell) > 0.5) << i;
            if (const char figure = figure_of(lit))
                text += figure;
        }
        if (int(text.size()) == count) {
            const dvec2 point((0.5 * count - 1) * cell, -0.43 - 2 * y); // halfway between the last two figures
            EXPECT_GT(ink_around(spots, point, 0.07 * cell), 0.5) << "the point";
            return text.insert(text.size() - 1, ".");
        }
    }
    return "";
}

std::string tenths(double reading)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", reading);
    return std::string(text) == "-0.0" ? "0.0" : text;
}

// ---------------------------------------------------------------- the paper's figure

GpuWorld clocks_world()
{
    const SceneFile scene = load_scene_file(testing::source_dir() / "config/scenes/clocks.json");
    World world = load_world(scene);
    add_detail_levels(world);
    return upload(device(), pipelines(), std::move(world), scene, stars_in_depth(*scene.stars));
}

constexpr double gauge_radius = 1.9;
Dial clock_at(double x) { return {{x, 0, 0}, {1, 0, 0}, {0, 1, 0}, gauge_radius}; }
const std::vector<double> row = {-10, -5, 0, 5, 10};

/// The paper's figure, calculated by hand: readings relative to the middle clock's, and angles from the motion in degrees.
struct Figure {
    const char* shot;
    std::vector<double> readings_s, from_motion_deg;
    double middle_s; ///< the middle clock's reading in the shipped shot
};
const std::vector<double> seen_passing = {-5.90909, -2.74403, 0, 2.21961, 3.80547};
const std::vector<Figure> figures = {{"clocks-rest", {31 - 32.57299, 31 - 31.40064, 0, 31 - 31.40064, 31 - 32.57299},
                                         {90 + std::atan2(10, 31) / degree, 90 + std::atan2(5, 31) / degree, 90,
                                             90 - std::atan2(5, 31) / degree, 90 - std::atan2(10, 31) / degree},
                                         0},
    {"clocks-passing", seen_passing, {90 + 14.70466, 90 + 7.69614, 90, 90 - 8.24497, 90 - 16.78385}, 0},
    {"clocks-stopped", seen_passing, {131.985, 126.451, 120, 112.590, 104.293}, 0}};

Shot shipped_shot(const char* name)
{
    return load_shot(testing::source_dir() / "config/shots" / (std::string(name) + ".json"));
}

TEST(Clocks, ReadingsEqualThePapers)
{
    const GpuWorld paper = clocks_world();
    for (const Figure& figure : figures) {
        const Shot shot = shipped_shot(figure.shot);
        std::printf("  %s:", figure.shot);
        for (std::size_t k = 0; k < row.size(); ++k) {
            SCOPED_TRACE(std::string(figure.shot) + ", clock " + std::to_string(k + 1));
            const std::vector<Spot> spots = look_at(paper, shot, clock_at(row[k]), 512);
            const double expected_s = figure.middle_s + figure.readings_s[k];
            const Hands hands = read_hands(spots);
            // A hundredth of a second is 0.06 degrees of the long hand, a sixth of a pixel at its tip; it is 0.36 degrees of
            // the fast one.
            EXPECT_LT(apart(hands.main_s, expected_s, 60), 0.01);
            EXPECT_LT(apart(hands.fast_s, expected_s, 10), 0.01);
            EXPECT_LT(apart(hands.slow_s, expected_s, 3600), 0.01 * 360); // 0.36 degrees, as for the fast hand
            EXPECT_EQ(read_figures(spots), tenths(expected_s));
            std::printf(" %+.4f", expected_s + std::remainder(hands.main_s - expected_s, 60));
            std::printf("/%+.4f", expected_s + std::remainder(hands.fast_s - expected_s, 10));
        }
        std::printf(" s\n");
    }
}

/// Finds the bright pin in a clock's middle, in pixels: the centroid of light in a disc that follows it.
dvec2 pin_near(const Numbers& numbers, dvec2 at, double radius)
{
    for (int round = 0; round < 8; ++round) {
        dvec2 sum(0);
        double weight = 0;
        for (int y = int(at.y - radius) - 1; y <= int(at.y + radius) + 1; ++y)
            for (int x = int(at.x - radius) - 1; x <= int(at.x + radius) + 1; ++x) {
                const dvec2 centre(x + 0.5, y + 0.5);
                const double part = std::clamp(radius - glm::distance(centre, at) + 0.5, 0.0, 1.0);
                const double light = part * numbers.light(y * numbers.size.x + x).g;
                sum += light * centre, weight += light;
            }
        at = sum / weight;
    }
    return at;
}

TEST(Clocks, AnglesAndLengthEqualThePapers)
{
    const GpuWorld paper = clocks_world();
    constexpr ivec2 size(2000, 1000);
    const double tangent = std::tan(30 * degree), pixels_per_unit = 0.5 * size.y / tangent;
    OffscreenRenderer offscreen = renderer(paper, one_view(Planar{60}, size));
    for (const Figure& figure : figures) {
        const Shot shot = shipped_shot(figure.shot);
        const Numbers numbers(offscreen, shot);
        const dmat3 ship_from_cockpit(glm::mat3_cast(shot.ship_from_cockpit));
        std::vector<double> aside; // of the perpendicular to the row, as tangents
        for (std::size_t k = 0; k < row.size(); ++k) {
            SCOPED_TRACE(std::string(figure.shot) + ", clock " + std::to_string(k + 1));
            const double a = figure.from_motion_deg[k] * degree;
            const dvec3 towards(std::cos(a), 0, -std::sin(a)); // the motion is along +x, the row lies at -z
            const dvec3 cockpit = glm::transpose(ship_from_cockpit) * towards;
            const dvec2 expected = 0.5 * dvec2(size) + pixels_per_unit * dvec2(cockpit.x, -cockpit.y) / -cockpit.z;
            // The disc's radius is two pixels: less than the dark ring around the pin, more than the tolerance.
            const dvec2 found = pin_near(numbers, expected + dvec2(0.6, -0.6), 2.0);
            EXPECT_LT(glm::distance(found, expected), 0.5) << found.x << ' ' << found.y;
            const dvec2 tangents = (found - 0.5 * dvec2(size)) / pixels_per_unit;
            const dvec3 camera = ship_from_cockpit * dvec3(tangents.x, -tangents.y, -1);
            aside.push_back(camera.x / -camera.z);
            if (k == 0)
                std::printf("  %s:", figure.shot);
            std::printf(
                " %.3f (%.2f px)", std::acos(camera.x / glm::length(camera)) / degree, glm::distance(found, expected));
        }
        std::printf(" degrees from the motion\n");
        if (figure.shot == std::string("clocks-passing")) {
            const double length = 31 * (aside.back() - aside.front());
            std::printf("  apparent length %.4f of 20\n", length);
            EXPECT_NEAR(length, 17.4853, 31 / pixels_per_unit); // half a pixel at each end
        }
    }
}

// ---------------------------------------------------------------- clocks of our own

/// Adds a square clock with black marks on white as a node of its own.
void clock(Doc& doc, const Dial& dial, double zero_s)
{
    const int material = unlit(doc, {1, 1, 1});
    doc.json["materials"][std::size_t(material)]["extras"]["starbow"]["clock"]["zero_s"] = zero_s;
    quad(doc, dial.middle, dial.radius * dial.right, dial.radius * dial.up, material);
}

/// One unit is a metre, and light flies one metre a second.
GpuWorld slow_world(const std::string& name, const Doc& doc) { return open_world(name, doc, {{"light_speed_m_s", 1}}); }

TEST(Clocks, EachClockRunsFromItsOwnZeroForMonths)
{
    const Dial left{{-2, 0, -6}, {1, 0, 0}, {0, 1, 0}, 1}, right{{2, 0.5, -6}, {1, 0, 0}, {0, 1, 0}, 1};
    Doc doc;
    clock(doc, left, 0);
    clock(doc, right, 1e7 + 10.75);
    const GpuWorld world = slow_world("months", doc);
    for (const dvec3& u : {dvec3(0), dvec3(u_of_gamma(4), 0, 0)}) {
        Shot shot = shot_at({0, 0, 0}, u, {0, 0, -1});
        shot.time = 1e7 + 44.125;
        for (const auto& [dial, zero_s] : {std::pair(left, 0.0), std::pair(right, 1e7 + 10.75)}) {
            const double expected_s = 1e7 + 44.125 - glm::length(dial.middle) - zero_s;
            const std::vector<Spot> spots = look_at(world, shot, dial, 512);
            const Hands hands = read_hands(spots);
            EXPECT_LT(apart(hands.main_s, expected_s, 60), 0.01) << hands.main_s;
            EXPECT_LT(apart(hands.fast_s, expected_s, 10), 0.01) << hands.fast_s;
            EXPECT_EQ(read_figures(spots), tenths(expected_s));
        }
    }
}

// A dial is as large as it is far. Its edges are seen at other times than its middle, by up to a third of the fast hand's
// turn.
TEST(Clocks, EachPartOfALargeDialShowsItsOwnRetardedTime)
{
    const Dial wide{{0, 0, -2}, {std::cos(0.7), 0, -std::sin(0.7)}, {0, 1, 0}, 4};
    Doc doc;
    clock(doc, wide, 0);
    const GpuWorld world = slow_world("wide", doc);
    for (const dvec3& u : {dvec3(0), dvec3(0, u_of_beta(0.5), 0)})
        for (double expected_s : {7.0, 22.0, 37.0, 52.0}) {
            Shot shot = shot_at({0, 0, 3}, u, {0, 0, -1});
            shot.time = expected_s + 5;
            const std::vector<Spot> spots = look_at(world, shot, wide, 800, {0, 0, 0}, 1.8);
            const auto [first, last] = std::minmax_element(
                spots.begin(), spots.end(), [](const Spot& a, const Spot& b) { return a.offset < b.offset; });
            EXPECT_GT(last->offset - first->offset, 3);
            const Hands hands = read_hands(spots);
            EXPECT_LT(apart(hands.main_s, expected_s, 60), 0.01) << hands.main_s;
            if (expected_s != 52) { // at 52 s the long hand covers part of the small dial
                EXPECT_LT(apart(hands.fast_s, expected_s, 10), 0.01) << hands.fast_s;
            }
        }
}

TEST(Clocks, MarksEmitTheMaterialsLight)
{
    const Dial dial{{0, 0, -6}, {1, 0, 0}, {0, 1, 0}, 1};
    Doc doc;
    const int material = doc.put("materials",
        {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorFactor", {0.1, 0.1, 0.1, 1}}}},
            {"emissiveFactor", {0.2, 0.5, 0.1}}, {"extras", {{"starbow", {{"clock", Json::object()}}}}}});
    quad(doc, dial.middle, dial.right, dial.up, material);
    const GpuWorld world = open_world("shining", doc, {{"light_speed_m_s", 1}, {"ambient", {1, 1, 1}}});
    const std::vector<Spot> spots = look_at(world, shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1}), dial, 256);
    // The face has 0.1; a mark has 0.5 and nothing of the face. Filtering between texels mixes the two.
    const auto [mark, face]
        = std::minmax_element(spots.begin(), spots.end(), [](const Spot& a, const Spot& b) { return a.ink < b.ink; });
    EXPECT_NEAR(mark->ink, 1 - 0.5 / 0.1, 0.02);
    EXPECT_NEAR(ink_around(spots, {0, -0.055}, 0.01), 1 - 0.5 / 0.1, 0.02); // the ring around the pin
    EXPECT_LT(face->ink, 1);
}

// The two eyes of a moving ship are simultaneous in the ship, not in the world: the front one sees later readings.
TEST(Clocks, EyesSeeTheTimesOfTheirOwnEvents)
{
    const Dial dial{{0, 0, -6}, {1, 0, 0}, {0, 1, 0}, 1};
    Doc doc;
    clock(doc, dial, 0);
    const GpuWorld world = slow_world("eyes", doc);
    Shot shot = shot_at({0, 0, 0}, {u_of_beta(0.8), 0, 0}, {0, 0, -1});
    shot.time = 22;
    for (const dvec3& beside : {dvec3(0.5, 0, 0), dvec3(-0.5, 0.1, 0), dvec3(0, 0, -0.7)}) {
        const quad::V4 eye = eye_event(shot, beside);
        const double expected_s = double(eye.t - quad::length(quad::of(dial.middle) - eye.x));
        const std::vector<Spot> spots = look_at(world, shot, dial, 512, beside);
        const Hands hands = read_hands(spots);
        EXPECT_LT(apart(hands.main_s, expected_s, 60), 0.01) << hands.main_s;
        EXPECT_LT(apart(hands.fast_s, expected_s, 10), 0.01) << hands.fast_s;
        EXPECT_EQ(read_figures(spots), tenths(expected_s));
    }
}

TEST(Clocks, AWorldWithoutClocksUsesNoClockShaders)
{
    const GpuWorld& without = avenue().world;
    for (std::size_t m = 0; m < without.world.materials.size(); ++m)
        EXPECT_FALSE(without.variant(int(m), StoredLight::coefficients).clock);
    const GpuWorld paper = clocks_world();
    int with = 0;
    for (std::size_t m = 0; m < paper.world.materials.size(); ++m)
        with += paper.variant(int(m), StoredLight::coefficients).clock;
    EXPECT_EQ(with, 1);
}

} // namespace
} // namespace starbow::gpu_test::clocks_gpu_test
