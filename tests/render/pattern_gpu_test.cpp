// Test patterns: lines, letters and fields must be where a builder expects them when lining up projectors. This file
// computes a direction's place on a screen by itself.
#include "config/model/angles.h"
#include "tests/support/small_world.h"
#include <functional>

namespace starbow::gpu_test::pattern_gpu_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Drawn {
    ivec2 size;
    Bytes bytes;

    dvec3 at(ivec2 p) const
    {
        const std::size_t i = 4 * (std::size_t(p.y) * size.x + p.x);
        return dvec3(bytes.at(i), bytes.at(i + 1), bytes.at(i + 2));
    }
    dvec3 at(dvec2 p) const { return at(ivec2(glm::floor(p))); }
    bool inside(dvec2 p) const { return p.x >= 0 && p.y >= 0 && p.x < size.x && p.y < size.y; }
    double peak(dvec2 p) const
    {
        const dvec3 c = at(p);
        return std::max({c.r, c.g, c.b});
    }
    /// True if a pixel within `reach` is at least as bright.
    bool near(dvec2 p, double bright, int reach = 1) const
    {
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x)
                if (inside(p + dvec2(x, y)) && peak(p + dvec2(x, y)) >= bright)
                    return true;
        return false;
    }
};

std::vector<Drawn> draw(const Layout& layout, Pattern pattern)
{
    OffscreenRenderer offscreen = renderer(avenue().world, layout, false);
    offscreen.frame().show(pattern);
    std::vector<Drawn> drawn;
    const auto pictures = offscreen.picture(shot_at({0, 0, 0}, {0, 0, -4}, {0, 0, -1}));
    for (std::size_t i = 0; i < pictures.size(); ++i)
        drawn.push_back({layout.outputs[i].size, pictures[i]});
    return drawn;
}

void expect_colour(const dvec3& seen, const dvec3& linear, double by, const std::string& where)
{
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(seen[k], 255 * srgb(linear[k]), by) << where << " channel " << k;
}

dvec3 towards(double azimuth_deg, double elevation_deg)
{
    const double a = azimuth_deg * degree, e = elevation_deg * degree;
    return {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
}

/// A display, and the pixel at which it shows a direction.
struct Screen {
    Layout layout;
    std::function<dvec2(const dvec3&)> pixel;
};

Screen dome(int size, double tilt_deg)
{
    const double t = tilt_deg * degree;
    return {one_view(Fisheye{180, tilt_deg}, ivec2(size)), [=](const dvec3& d) {
                const double up = d.y * std::cos(t) - d.z * std::sin(t), front = -d.y * std::sin(t) - d.z * std::cos(t);
                const double flat = std::hypot(d.x, front), angle = std::atan2(flat, up);
                return angle > 90 * degree
                    ? dvec2(-1)
                    : dvec2(size / 2.0) + dvec2(d.x, front) / flat * (angle / (90 * degree) * size / 2);
            }};
}

Screen window(ivec2 size, double fov_y_deg, double yaw_deg)
{
    const double y = yaw_deg * degree, scale = 0.5 * size.y / std::tan(fov_y_deg / 2 * degree);
    return {one_view(Planar{fov_y_deg, {}, {yaw_deg, 0, 0}}, size), [=](const dvec3& d) {
                const double ahead = d.x * std::sin(y) - d.z * std::cos(y), right = d.x * std::cos(y) + d.z * std::sin(y);
                return ahead <= 0 ? dvec2(-1) : 0.5 * dvec2(size) + dvec2(right, -d.y) * (scale / ahead);
            }};
}

// ---------------------------------------------------------------- grid

TEST(Pattern, TheGridReachesEveryEdge)
{
    for (const Screen& screen : {window({640, 480}, 60, 0), dome(512, 20)}) {
        const Drawn drawn = draw(screen.layout, Pattern::grid).front();
        const ivec2 size = drawn.size;
        for (int x = 0; x < size.x; ++x)
            for (int y : {0, 1, size.y - 1, size.y - 2})
                ASSERT_EQ(drawn.at(ivec2(x, y)), dvec3(255)) << "the edge's two pixels are white: " << x << " " << y;
        for (int y = 0; y < size.y; ++y)
            for (int x : {0, 1, size.x - 1, size.x - 2})
                ASSERT_EQ(drawn.at(ivec2(x, y)), dvec3(255)) << x << " " << y;
        const dvec2 middle = 0.5 * dvec2(size);
        for (int i = -3; i <= 3; ++i)
            for (int j = -2; j <= 2; ++j) {
                const dvec2 field = middle + 64.0 * dvec2(i + 0.5, j + 0.5);
                if (std::abs(glm::length(field - middle) - 0.5 * std::min(size.x, size.y)) > 4 && drawn.inside(field)) {
                    EXPECT_EQ(drawn.at(field), dvec3(0)) << field.x << " " << field.y;
                }
                // The middle of a field's upper side.
                const dvec2 line = middle + 64.0 * dvec2(i + 0.5, j);
                if (j != 0 && std::abs(glm::length(line - middle) - 0.5 * std::min(size.x, size.y)) > 4
                    && drawn.inside(line)) {
                    EXPECT_TRUE(drawn.near(line, 60)) << line.x << " " << line.y;
                }
            }
        expect_colour(drawn.at(middle + dvec2(40, 0)), {1, 0.45, 0.1}, 1, "the cross");
        expect_colour(drawn.at(middle + dvec2(0, -40)), {1, 0.45, 0.1}, 1, "the cross");
        const double radius = 0.5 * std::min(size.x, size.y) - 1;
        for (double a : {0.4, 1.1, 2.2, 3.9, 5.5})
            EXPECT_TRUE(drawn.near(middle + radius * dvec2(std::cos(a), std::sin(a)), 200)) << "the circle at " << a;
    }
}

// ---------------------------------------------------------------- rings

TEST(Pattern, RingsLieAtTheirAzimuthAndElevation)
{
    for (const Screen& screen : {dome(1000, 0), dome(1000, 30), window({1000, 700}, 70, 35), window({1000, 700}, 70, 180)}) {
        const Drawn drawn = draw(screen.layout, Pattern::rings).front();
        int lines = 0, fields = 0;
        for (int azimuth = -180; azimuth < 180; azimuth += 15)
            for (int elevation = -60; elevation <= 75; elevation += 15) {
                // Between two crossings, a third of the way, so that no letters are near.
                for (const dvec3& d : {towards(azimuth + 10, elevation), towards(azimuth, elevation + 10)}) {
                    const dvec2 p = screen.pixel(d);
                    if (!drawn.inside(p - 3.0) || !drawn.inside(p + 3.0))
                        continue;
                    ++lines;
                    EXPECT_TRUE(drawn.near(p, 120)) << "a line at " << azimuth << " " << elevation;
                }
                const dvec2 field = screen.pixel(towards(azimuth + 9, elevation + 7));
                if (drawn.inside(field) && drawn.inside(field + 3.0) && drawn.inside(field - 3.0)) {
                    ++fields;
                    EXPECT_EQ(drawn.at(field), dvec3(0)) << "the field at " << azimuth << " " << elevation;
                }
            }
        EXPECT_GT(lines, 20);
        EXPECT_GT(fields, 10);
        // The horizon is orange, the meridian straight ahead green.
        const dvec2 horizon = screen.pixel(towards(20, 0)), ahead = screen.pixel(towards(0, 22));
        if (drawn.inside(horizon - 3.0) && drawn.inside(horizon + 3.0))
            expect_colour(drawn.at(horizon), {1, 0.45, 0.1}, 3, "the horizon");
        if (drawn.inside(ahead))
            expect_colour(drawn.at(ahead), {0.2, 1, 0.3}, 3, "straight ahead");
    }
}

// Every azimuth's number must be readable: upright towards the zenith, not mirrored, and on black alone.
TEST(Pattern, NumbersCanBeRead)
{
    const char* digits[10][5] = {{"###", "# #", "# #", "# #", "###"}, {" # ", "## ", " # ", " # ", "###"},
        {"###", "  #", "###", "#  ", "###"}, {"###", "  #", "###", "  #", "###"}, {"# #", "# #", "###", "  #", "  #"},
        {"###", "#  ", "###", "  #", "###"}, {"###", "#  ", "###", "# #", "###"}, {"###", "  #", "  #", "  #", "  #"},
        {"###", "# #", "###", "# #", "###"}, {"###", "# #", "###", "  #", "###"}};
    int read = 0;
    const double cell = 0.45; // degrees
    for (const Screen& screen : {dome(2000, 0), window({1600, 800}, 40, 30), window({1600, 800}, 40, -120)}) {
        const Drawn drawn = draw(screen.layout, Pattern::rings).front();
        for (int azimuth = 0; azimuth < 360; azimuth += 30)
            for (int ring : {0, 45}) {
                const std::string text = std::to_string(azimuth > 180 ? azimuth - 360 : azimuth);
                bool whole = true;
                std::vector<std::pair<dvec2, bool>> cells;
                for (std::size_t k = 0; k < text.size(); ++k)
                    for (int y = 0; y < 5; ++y)
                        for (int x = 0; x < 3; ++x) {
                            // A digit takes four cells, of which the last is empty. Its lower edge lies one and a half cells
                            // above the ring.
                            const double right = (4.0 * double(k) + x + 0.5 - (4.0 * double(text.size()) - 1) / 2) * cell;
                            const double elevation = ring + (6.5 - y - 0.5) * cell;
                            const double aside = right / std::cos(elevation * degree);
                            const dvec2 p = screen.pixel(towards(azimuth + aside, elevation));
                            whole = whole && drawn.inside(p - 1.0) && drawn.inside(p + 1.0);
                            cells.emplace_back(p, text[k] == '-' ? y == 2 : digits[text[k] - '0'][y][x] == '#');
                        }
                if (!whole)
                    continue;
                ++read;
                for (const auto& [p, ink] : cells)
                    ASSERT_EQ(drawn.at(p), dvec3(ink ? 255 : 0)) << azimuth << " on " << ring << " at " << p.x << " " << p.y;
            }
    }
    EXPECT_GT(read, 20);
}

// ---------------------------------------------------------------- names

TEST(Pattern, NamesAreInTheMiddleAndCornersInEachEyesColour)
{
    Layout layout = one_view(Planar{60}, {640, 240});
    layout.outputs[0].viewports = {{.rect = {0, 0, 0.5, 1}, .projection = Planar{60}, .eye = Eye::left},
        {.rect = {0.5, 0, 0.5, 1}, .projection = Planar{60}, .eye = Eye::right}};
    layout.outputs.push_back(one_view(Fisheye{180, 0}, {400, 300}).outputs[0]);
    layout.outputs[1].name = "dome";
    const auto drawn = draw(layout, Pattern::names);
    expect_colour(drawn[0].at(ivec2(3, 120)), {1, 0.08, 0.05}, 1, "left eye red");
    expect_colour(drawn[0].at(ivec2(323, 120)), {0.05, 0.25, 1}, 1, "right eye blue");
    expect_colour(drawn[1].at(ivec2(3, 150)), {0.5, 0.5, 0.5}, 1, "no eye of its own: grey");
    // Letters are nearly white (a grey frame is 187). Each corner has as many letter pixels as the middle.
    auto letters = [](const Drawn& d, ivec2 low, ivec2 high) {
        int count = 0;
        for (int y = low.y; y < high.y; ++y)
            for (int x = low.x; x < high.x; ++x)
                count += glm::all(glm::greaterThan(d.at(ivec2(x, y)), dvec3(195)));
        return count;
    };
    for (const auto& [picture, low, size] : {std::tuple(&drawn[0], ivec2(0, 0), ivec2(320, 240)),
             std::tuple(&drawn[0], ivec2(320, 0), ivec2(320, 240)), std::tuple(&drawn[1], ivec2(0, 0), ivec2(400, 300))}) {
        const int middle = letters(*picture, low + size / 3, low + size * 2 / 3);
        EXPECT_GT(middle, 100);
        for (ivec2 corner : {ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1)})
            EXPECT_EQ(letters(*picture, low + corner * size * 2 / 3, low + size / 3 + corner * (size - size / 3)), middle);
    }
    // Each output shows its own name.
    layout.outputs[1].name = "another";
    EXPECT_NE(draw(layout, Pattern::names)[1].bytes, drawn[1].bytes);
}

// ---------------------------------------------------------------- wedges

TEST(Pattern, WedgesAreEvenStepsOfInputWithAnyCurve)
{
    for (double gamma : {0.0, 1.8, 2.2, 2.6}) {
        SCOPED_TRACE(gamma);
        for (const Screen& screen : {window({680, 400}, 60, 0), dome(680, 0)}) {
            Layout layout = screen.layout;
            layout.outputs[0].colour.gamma = gamma;
            const Drawn drawn = draw(layout, Pattern::wedges).front();
            // On a dome the pattern lies within the circle: in the inscribed square.
            const double part = std::holds_alternative<Fisheye>(layout.outputs[0].viewports[0].projection) ? 0.7 : 1;
            auto place = [&](double x, double y) { return dvec2(drawn.size) * (0.5 + part * (dvec2(x, y) - 0.5)); };
            for (int i = 0; i < 17; ++i)
                EXPECT_NEAR(drawn.at(place((i + 0.5) / 17, 0.2)).g, 255 * i / 16.0, 1) << "step " << i;
            for (int i = 0; i < 12; ++i) {
                // The darkest is 2 of 255. A viewer sees it if black level and gamma are right.
                EXPECT_NEAR(drawn.at(place((i + 0.5) / 12, 0.85)).g, 2 * (i + 1), 0.6) << "dark field " << i;
                EXPECT_EQ(drawn.at(place((i + 0.05) / 12, 0.85)).g, 0);
            }
            for (int band = 0; band < 4; ++band) {
                const dvec2 lines = place((band + 0.5) / 4, 0.55), flat = place((band + 0.1) / 4, 0.55);
                for (int k = 0; k < 3; ++k) {
                    const bool on = band == 3 || band == k;
                    const double half = gamma > 0 ? 255 * std::pow(0.5, 1 / gamma) : 255 * srgb(0.5);
                    EXPECT_NEAR(drawn.at(flat)[k], on ? half : 0, 1) << "half the light, band " << band;
                    EXPECT_EQ(drawn.at(lines)[k] + drawn.at(lines + dvec2(0, 1))[k], on ? 255 : 0)
                        << "every other row, band " << band;
                }
            }
        }
    }
}

// ---------------------------------------------------------------- overlap

TEST(Pattern, OverlapMixesTheOutputsColours)
{
    Layout layout;
    for (double left : {-1.5, -0.5}) {
        Layout one = one_view(Wall{{left, -0.6, -2}, {left + 2, -0.6, -2}, {left, 0.6, -2}}, {400, 240});
        one.outputs[0].name = left < -1 ? "left" : "right";
        layout.outputs.push_back(one.outputs[0]);
    }
    layout.blend.ramps = true;
    const auto drawn = draw(layout, Pattern::overlap);
    auto light = [](double byte) {
        return byte / 255 <= 0.04045 ? byte / 255 / 12.92 : std::pow((byte / 255 + 0.055) / 1.055, 2.4);
    };
    // Outside the ramp each output is alone; in the ramp both add up to one.
    const dvec3 left = drawn[0].at(ivec2(20, 60)), right = drawn[1].at(ivec2(380, 60));
    EXPECT_GT(left.r, 200);
    EXPECT_GT(right.g, 180);
    for (int x = 210; x < 390; x += 20) {
        const dvec3 a = drawn[0].at(ivec2(x, 60)), b = drawn[1].at(ivec2(x - 200, 60));
        const double share_a = light(a.r) / light(left.r), share_b = light(b.g) / light(right.g);
        EXPECT_NEAR(share_a + share_b, 1, 0.02) << x; // the dim part of each, and rounding to bytes
    }
    // The middle has the output's name.
    int dark = 0;
    for (int y = 100; y < 140; ++y)
        for (int x = 150; x < 250; ++x)
            dark += drawn[0].at(ivec2(x, y)) == dvec3(0);
    EXPECT_GT(dark, 50);

    // Patterns for aligning lines are drawn without blending.
    for (Pattern plain : {Pattern::grid, Pattern::names}) {
        Layout unblended = layout;
        unblended.blend = {};
        const auto a = draw(layout, plain), b = draw(unblended, plain);
        for (std::size_t i = 0; i < a.size(); ++i) {
            int most = 0; // fp16 on the way may change a byte's rounding
            for (std::size_t k = 0; k < a[i].bytes.size(); ++k)
                most = std::max(most, std::abs(a[i].bytes[k] - b[i].bytes[k]));
            EXPECT_LE(most, 1);
        }
    }
}

} // namespace
} // namespace starbow::gpu_test::pattern_gpu_test
