// Blend ramps where projectors overlap: the light on each place of the screen is summed by hand. This file computes the
// pixel of a direction in each projector independently, from config/layout.h.
#include "displays/finish/blend.h"
#include "displays/finish/shade.h"
#include "tests/support/files.h"
#include "tests/support/sphere.h"
#include <functional>
#include <optional>

namespace blend_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;

/// The place that a projector of `size` pixels lights a direction from; nothing behind it.
using Lit = std::function<std::optional<dvec2>(const dvec3&, ivec2 size)>;

Lit planar_light(const Planar& planar)
{
    const double yaw = glm::radians(planar.turn.yaw_deg), roll = glm::radians(planar.turn.roll_deg);
    const dvec3 ahead = sphere::towards(planar.turn.yaw_deg, planar.turn.pitch_deg);
    const dvec3 level(std::cos(yaw), 0, std::sin(yaw)), above = glm::cross(level, ahead);
    const dvec3 up = above * std::cos(roll) + level * std::sin(roll), right = glm::cross(ahead, up);
    const double half = std::tan(glm::radians(planar.fov_y_deg) / 2);
    return [=](const dvec3& d, ivec2 size) -> std::optional<dvec2> {
        const double away = glm::dot(d, ahead);
        if (away <= 0)
            return {};
        return 0.5 * dvec2(size) + dvec2(glm::dot(d, right), -glm::dot(d, up)) / away * (0.5 * size.y / half);
    };
}

Lit wall_light(const Wall& wall)
{
    return [wall](const dvec3& d, ivec2 size) -> std::optional<dvec2> {
        // All walls here are parallel to the xy plane.
        if (d.z >= 0)
            return {};
        const dvec3 at = d * (wall.lower_left_m.z / d.z);
        return dvec2((at.x - wall.lower_left_m.x) / (wall.lower_right_m.x - wall.lower_left_m.x) * size.x,
            (wall.upper_left_m.y - at.y) / (wall.upper_left_m.y - wall.lower_left_m.y) * size.y);
    };
}

/// An equidistant fisheye that looks straight up, with the largest circle that the picture holds.
Lit fisheye_light(double aperture_deg)
{
    return [=](const dvec3& d, ivec2 size) -> std::optional<dvec2> {
        const double angle = std::acos(glm::clamp(d.y, -1.0, 1.0)), flat = std::hypot(d.x, d.z);
        const double radius = angle / glm::radians(aperture_deg / 2) * 0.5 * std::min(size.x, size.y);
        if (flat == 0)
            return 0.5 * dvec2(size);
        return 0.5 * dvec2(size) + dvec2(d.x, -d.z) * (radius / flat);
    };
}

/// The angle between the rim of dome2 in front and the flight's direction, radians.
const double dome2_tilt = glm::radians(30.0);

/// The projectors of dome2: make.py's lenses at the rim of a dome of 4 m radius.
Lit dome2_light(bool left)
{
    return [=](const dvec3& d, ivec2 size) -> std::optional<dvec2> {
        const double tilt = dome2_tilt, inwards = left ? 1 : -1;
        const dvec3 place
            = 4.0 * dvec3(d.x, d.y * std::cos(tilt) - d.z * std::sin(tilt), d.y * std::sin(tilt) + d.z * std::cos(tilt));
        const dvec3 ray = place - dvec3(left ? -3.9 : 3.9, -0.1, 0);
        const double depth = ray.x * inwards;
        if (depth <= 0)
            return {};
        return dvec2((ray.z * inwards / depth / 1.2 + 1) / 2 * size.x, (1 - (ray.y / depth + 0.0875) / 1.5) * size.y);
    };
}

struct Rig {
    Layout layout;
    std::vector<Lit> lights; ///< one for each output
    std::function<bool(const dvec3&)> screen
        = [](const dvec3&) { return true; }; ///< the part of the sphere that is a screen

    void add(ivec2 size, const Projection& projection, Lit light)
    {
        Output output;
        output.name = std::to_string(layout.outputs.size());
        output.size = size;
        output.viewports = {{.projection = projection}};
        layout.outputs.push_back(output);
        lights.push_back(std::move(light));
    }
    void add(ivec2 size, const Planar& planar) { add(size, planar, planar_light(planar)); }
    void add(ivec2 size, const Wall& wall) { add(size, wall, wall_light(wall)); }
};

/// Each output's weights as the finish pass applies them, and its lit pixels.
struct Weights {
    struct OutputWeights {
        ivec2 size;
        std::vector<float> values;
        std::vector<int> lit_before; ///< number of lit pixels above and left of each corner
        std::shared_ptr<const DirectionMap> map; ///< null where a direction's pixel is exact
    };
    std::vector<OutputWeights> outputs;

    explicit Weights(const Layout& layout)
    {
        MapStore store{std::filesystem::path()};
        std::vector<CompiledView> views;
        for (std::size_t i = 0; i < layout.outputs.size(); ++i)
            for (const CompiledView& view : compile_output(store, layout, i, layout.outputs[i].size))
                views.push_back(view);
        const auto ramps = blend_ramps(layout, views, layout.blend.power);
        for (std::size_t i = 0; i < layout.outputs.size(); ++i) {
            const ivec2 size = layout.outputs[i].size;
            const Shade shade = shade_of(layout, i, size, views, ramps);
            OutputWeights weights_of_output{size, std::vector<float>(std::size_t(size.x) * size.y, 1.0f),
                std::vector<int>(std::size_t(size.x + 1) * (size.y + 1)), views[i].mesh ? views[i].map : nullptr};
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const std::size_t k = std::size_t(y) * size.x + x, c = std::size_t(y) * (size.x + 1) + x;
                    if (!shade.weight.empty()) {
                        weights_of_output.values[k] = shade.weight[k].r;
                        EXPECT_EQ(shade.weight[k], glm::vec3(weights_of_output.values[k]));
                    }
                    const int lit = !views[i].map || views[i].map->texels[k].w > 0;
                    weights_of_output.lit_before[c + size.x + 2] = lit + weights_of_output.lit_before[c + 1]
                        + weights_of_output.lit_before[c + size.x + 1] - weights_of_output.lit_before[c];
                }
            outputs.push_back(std::move(weights_of_output));
        }
    }

    /// The number of lit pixels within `reach` of a pixel in both axes.
    int lit(std::size_t i, ivec2 pixel, int reach) const
    {
        const OutputWeights& weights_of_output = outputs[i];
        const ivec2 low = glm::clamp(pixel - reach, ivec2(0), weights_of_output.size),
                    high = glm::clamp(pixel + reach + 1, ivec2(0), weights_of_output.size);
        auto before = [&](int x, int y) {
            return weights_of_output.lit_before[std::size_t(y) * (weights_of_output.size.x + 1) + x];
        };
        return before(high.x, high.y) - before(low.x, high.y) - before(high.x, low.y) + before(low.x, low.y);
    }
    bool edge(std::size_t i, const dvec2& place, int reach) const
    {
        const int count = lit(i, glm::floor(place), reach);
        return count > 0 && count < (2 * reach + 1) * (2 * reach + 1);
    }

    /// A calibration is linear between its points, which is a third of a pixel off. This corrects a place by the direction
    /// map.
    dvec2 corrected(std::size_t i, const dvec3& d, dvec2 place) const
    {
        const DirectionMap* map = outputs[i].map.get();
        for (int round = 0; map && round < 3; ++round) {
            const ivec2 p = glm::floor(place);
            if (lit(i, p, 1) < 9)
                break;
            const dvec3 here = map->at(p.x, p.y), x = 0.5 * dvec3(map->at(p.x + 1, p.y) - map->at(p.x - 1, p.y)),
                        y = 0.5 * dvec3(map->at(p.x, p.y + 1) - map->at(p.x, p.y - 1));
            // Solves d = here + s x + t y along the ray.
            const dvec3 s = glm::inverse(glm::dmat3(x, y, -d)) * -here;
            place = dvec2(p) + 0.5 + dvec2(s);
        }
        return place;
    }

    /// Interpolates between the centres of four pixels, and extrapolates to the picture's edge. InsetView a hole it returns
    /// the pixel's own weight, and nothing where no pixel is lit.
    std::optional<double> at(std::size_t i, const dvec2& place) const
    {
        const OutputWeights& weights_of_output = outputs[i];
        const ivec2 pixel = glm::floor(place),
                    low = glm::clamp(ivec2(glm::floor(place - 0.5)), ivec2(0), weights_of_output.size - 2);
        if (lit(i, pixel, 0) == 0)
            return {};
        auto value
            = [&](int x, int y) { return double(weights_of_output.values[std::size_t(y) * weights_of_output.size.x + x]); };
        for (ivec2 corner : {ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1)})
            if (lit(i, low + corner, 0) == 0)
                return value(pixel.x, pixel.y);
        const dvec2 f = place - 0.5 - dvec2(low);
        return glm::mix(glm::mix(value(low.x, low.y), value(low.x + 1, low.y), f.x),
            glm::mix(value(low.x, low.y + 1), value(low.x + 1, low.y + 1), f.x), f.y);
    }
};

/// The light over the screen: the largest |sum - 1|.
struct Sum {
    double worst = 0; ///< except where two pictures' edges cross
    double crossing = 0; ///< where edges cross
    double alone = 0; ///< where one picture lights alone, at least a few pixels from any edge
    int all = 0, by[6] = {}, of_alone = 0, over = 0; ///< numbers of directions; over: those above 1 %
};

/// Both ramps go from 1 to 0 around the point in which two edges cross, and pixels can't resolve it. At r pixels from it the
/// ramps are r pixels long, and linear interpolation cuts a kink by up to 1 / (4 r).
constexpr int crossing_reach = 32;

Sum light_of(const Rig& rig, int count = all_cases() ? 200000 : 60000)
{
    const Weights weights(rig.layout);
    std::mt19937 random(1977);
    std::normal_distribution<double> normal;
    Sum sum;
    for (int k = 0; k < count; ++k) {
        const dvec3 d = glm::normalize(dvec3(normal(random), normal(random), normal(random)));
        if (!rig.screen(d))
            continue;
        double light = 0;
        int by = 0, whole = 0, edges = 0, near = 0;
        for (std::size_t i = 0; i < rig.lights.size(); ++i) {
            const auto light_at = rig.lights[i](d, weights.outputs[i].size);
            if (!light_at || glm::any(glm::greaterThan(glm::abs(*light_at), dvec2(1e6))))
                continue; // behind the projector, or nearly beside it
            const dvec2 place = weights.corrected(i, d, *light_at);
            if (const auto weight = weights.at(i, place))
                light += *weight, ++by;
            whole += weights.lit(i, glm::floor(place), 1) == 9;
            near += weights.edge(i, place, 4);
            edges += weights.edge(i, place, crossing_reach);
        }
        if (whole == 0)
            continue; // dark, or an outermost pixel, where the light ends
        ++sum.all;
        ++sum.by[std::min(by, 5)];
        const double off = std::abs(light - 1);
        sum.over += off > 0.01;
        double& worst = edges >= 2 ? sum.crossing : by == 1 && near == 0 ? sum.alone : sum.worst;
        worst = std::max(worst, off);
        sum.of_alone += by == 1 && near == 0 && edges < 2;
    }
    return sum;
}

void check(const std::string& name, const Rig& rig)
{
    SCOPED_TRACE(name);
    const Sum sum = light_of(rig);
    std::printf("  %s: worst %.2f %%, where edges cross %.1f %%; above 1 %% at %.3f %% of the lit part; lit once %d, twice "
                "%d, more %d\n",
        name.c_str(), 100 * sum.worst, 100 * sum.crossing, 100.0 * sum.over / sum.all, sum.by[1], sum.by[2],
        sum.by[3] + sum.by[4] + sum.by[5]);
    EXPECT_LE(sum.worst, 0.01);
    EXPECT_EQ(sum.alone, 0);
    EXPECT_LT(sum.over, sum.all / 1000);
    EXPECT_LT(sum.crossing, 0.15); // 1 / (4 r) at two pixels
    EXPECT_GT(sum.of_alone, 1000);
    EXPECT_GT(sum.by[2], 1000);
}

Rig dome2()
{
    Rig rig;
    rig.layout = load_layout(source_dir() / "config/layouts/dome2.json");
    for (const Output& output : rig.layout.outputs)
        rig.lights.push_back(dome2_light(output.name == "left"));
    rig.screen = [](const dvec3& d) { return d.y * std::cos(dome2_tilt) - d.z * std::sin(dome2_tilt) > 1e-3; };
    return rig;
}

} // namespace

TEST(BlendTest, TheShippedDomesLightAddsUp)
{
    for (double power : {1.0, 2.0}) {
        Rig rig = dome2();
        rig.layout.blend.power = power;
        check("dome2, power " + std::to_string(int(power)), rig);
    }
}

TEST(BlendTest, OverlappingPicturesAddUp)
{
    Rig row; // a panorama of three projectors with different pixels, the middle one rolled
    row.add({1280, 800}, Planar{40, {}, {-42, 0, 0}});
    row.add({1024, 768}, Planar{50, {}, {0, 3, 12}});
    row.add({1920, 1080}, Planar{36, {}, {42, -2, -3}});
    check("three in a row", row);

    Rig dome; // a lens for the zenith and four windows around; at their upper corners three pictures overlap
    dome.add({1000, 1000}, Fisheye{110, 0}, fisheye_light(110));
    dome.add({1280, 800}, Planar{60, {}, {0, 25, 0}});
    dome.add({1280, 1024}, Planar{70, {}, {92, 25, 5}});
    dome.add({800, 600}, Planar{60, {}, {180, 28, 0}});
    dome.add({1400, 1050}, Planar{66, {}, {-90, 26, -20}});
    check("lens and four windows", dome);

    Rig stairs; // walls: each pair of edges crosses inside a neighbour's picture
    stairs.add({900, 600}, Wall{{-2, -1, -2}, {0.3, -1, -2}, {-2, 0.53333333333333333, -2}});
    stairs.add({640, 480}, Wall{{-0.2, -0.6, -2}, {1.4, -0.6, -2}, {-0.2, 0.6, -2}});
    stairs.add({1200, 700}, Wall{{-0.8, 0.1, -2}, {1.6, 0.1, -2}, {-0.8, 1.5, -2}});
    check("stairs", stairs);

    Rig stack; // two projectors on the whole of one place
    stack.add({1280, 800}, Planar{50, {}, {}});
    stack.add({640, 400}, Planar{42, {}, {2, 1, 180}});
    stack.add({1280, 800}, Planar{50, {}, {40, 0, 90}});
    check("one inside another", stack);
}

// In the middle of a strip both weights are a half; elsewhere they follow the distances to the edges, to the ramp's power.
TEST(BlendTest, RampsFollowTheirPower)
{
    Layout layout;
    for (double left : {-1.5, -0.5}) {
        Output output;
        output.size = {400, 240};
        output.viewports = {{.projection = Wall{{left, -0.6, -2}, {left + 2, -0.6, -2}, {left, 0.6, -2}}}};
        layout.outputs.push_back(output);
    }
    for (double power : {1.0, 2.0, 3.0}) {
        layout.blend.power = power;
        const Weights weights(layout);
        // The strip is from 200 to 400 in the left picture. Both pictures end at the same height, so that every row is
        // alike.
        for (int y : {0, 1, 2, 50, 120, 237, 239}) {
            for (int x = 200; x < 400; ++x) {
                const double weights_of_output = std::pow(399.5 - x, power), other = std::pow(x + 0.5 - 200, power);
                // Distances are computed at every fourth pixel and interpolated; the interpolation is off by less.
                EXPECT_NEAR(weights.outputs[0].values[y * 400 + x], weights_of_output / (weights_of_output + other), 0.002)
                    << x << " " << y << " power " << power;
            }
            EXPECT_EQ(weights.outputs[0].values[y * 400 + 150], 1);
        }
    }
}

// One desktop over two projectors is one output with two viewports. A viewport drawn over another one is not blended with
// it.
TEST(BlendTest, ViewportsOfOneOutputAreBlendedUnlessTheyOverlap)
{
    Layout layout;
    layout.outputs.resize(1);
    layout.outputs[0].size = {800, 240};
    const Planar left{40, {}, {-20, 0, 0}}, right{40, {}, {20, 0, 0}};
    layout.outputs[0].viewports
        = {{.rect = {0, 0, 0.5, 1}, .projection = left}, {.rect = {0.5, 0, 0.5, 1}, .projection = right}};
    MapStore store{std::filesystem::path()};
    auto ramps = [&] { return blend_ramps(layout, compile_output(store, layout, 0, layout.outputs[0].size), 1); };
    const auto apart = ramps();
    ASSERT_EQ(apart[0].size(), 400u * 240);
    ASSERT_EQ(apart[1].size(), 400u * 240);
    // Both look 20 degrees aside, so that straight ahead is equally far from both edges.
    const double ahead = 200 + std::tan(glm::radians(20.0)) * 120 / std::tan(glm::radians(20.0));
    EXPECT_NEAR(apart[0][120 * 400 + int(ahead)], 0.5, 0.02);
    EXPECT_EQ(apart[0][120 * 400], 1);
    layout.outputs[0].viewports[1].rect = {0.25, 0.25, 0.5, 0.5};
    layout.outputs[0].viewports[1].order = 1;
    for (const auto& ramp : ramps())
        EXPECT_TRUE(ramp.empty());
}

// A picture lights nothing where an inset hides it. The neighbour that lights the same place keeps all its light there.
TEST(BlendTest, APictureLightsNothingWhereAnInsetHidesIt)
{
    Layout layout;
    for (double left : {-1.5, -0.5}) {
        Output output;
        output.size = {200, 180};
        output.viewports = {{.projection = Wall{{left, -0.9, -2}, {left + 2, -0.9, -2}, {left, 0.9, -2}}}};
        layout.outputs.push_back(output);
    }
    const auto ramps = [&] {
        MapStore store{std::filesystem::path()};
        std::vector<CompiledView> views;
        for (std::size_t i = 0; i < 2; ++i)
            for (const CompiledView& view : compile_output(store, layout, i, layout.outputs[i].size))
                views.push_back(view);
        return blend_ramps(layout, views, 1);
    };
    const std::size_t right_picture_50 = 90 * 200 + 50; // the wall at x = 0, lit by both
    EXPECT_NEAR(ramps().back()[right_picture_50], 0.5, 0.02);
    layout.outputs[0].viewports.push_back(
        {.rect = {0.6, 0.3, 0.3, 0.4}, .projection = Planar{20, {}, {180, 0, 0}}, .order = 1});
    EXPECT_EQ(ramps().back()[right_picture_50], 1);
}

TEST(BlendTest, PicturesThatOnlyTouchAreNotDimmed)
{
    Rig rig;
    rig.add({640, 480}, Wall{{-2, -0.75, -2}, {0, -0.75, -2}, {-2, 0.75, -2}});
    rig.add({640, 480}, Wall{{0, -0.75, -2}, {2, -0.75, -2}, {0, 0.75, -2}});
    const Weights weights(rig.layout);
    float least = 1;
    for (const auto& weights_of_output : weights.outputs)
        least = std::min(least, *std::min_element(weights_of_output.values.begin(), weights_of_output.values.end()));
    EXPECT_GT(least, 0.99f);
}

TEST(BlendTest, EyesAndMasksAreNotBlended)
{
    Layout layout;
    for (Eye eye : {Eye::left, Eye::right}) {
        Output output;
        output.size = {64, 48};
        output.viewports = {{.projection = Planar{60}, .eye = eye}};
        layout.outputs.push_back(output);
    }
    auto all_one = [&] {
        for (const auto& weights_of_output : Weights(layout).outputs)
            if (std::any_of(
                    weights_of_output.values.begin(), weights_of_output.values.end(), [](float w) { return w != 1; }))
                return false;
        return true;
    };
    EXPECT_TRUE(all_one()) << "the pictures overlap, but each is for another eye";
    layout.outputs[1].viewports[0].eye = Eye::left;
    EXPECT_FALSE(all_one());
    layout.outputs[1].viewports[0].alpha_mask = "mask.png"; // a mask replaces the ramps
    MapStore store{std::filesystem::path()};
    std::vector<CompiledView> views;
    for (std::size_t i = 0; i < 2; ++i)
        views.push_back(compile_output(store, layout, i, layout.outputs[i].size).front());
    for (const auto& ramp : blend_ramps(layout, views, 1))
        EXPECT_TRUE(ramp.empty());
}

} // namespace blend_test
