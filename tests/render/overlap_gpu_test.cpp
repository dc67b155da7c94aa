// Viewports over each other: the live picture against each viewport drawn alone, mixed by hand, and against rays; stars,
// glow, overlays, the head-up display, numbers, patterns, the exposure and the preview in the overlap.
#include "config/model/shipped.h"
#include "runtime/hud/hud.h"
#include "runtime/images/picture_errors.h"
#include "runtime/reference/reference.h"
#include "tests/support/small_world.h"
#include "tests/support/warp_fixture.h"

namespace starbow::gpu_test::overlap_gpu_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr ivec2 size(96, 64);

std::filesystem::path grey(const std::string& name, const std::function<double(int x, int y)>& value)
{
    std::vector<unsigned char> values;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            values.push_back((unsigned char)std::lround(255 * value(x, y)));
    return testing::write_text(name, warp_test::png(size.x, size.y, 1, values));
}

double ramp(int x) { return std::lround(255 * std::clamp((x - 30) / 36.0, 0.0, 1.0)) / 255.0; }

/// A Bourke mesh over the middle of its viewport, with a hole at its upper right, half as bright at its lower edge.
std::filesystem::path mesh_in_the_middle()
{
    return testing::write_text("middle.data",
        "2\n3 3\n-0.6 -0.7 0.1 0 0.5\n0 -0.7 0.5 0 0.5\n0.6 -0.7 0.9 0 0.5\n-0.6 0 0 0.5 1\n0 0 0.5 0.5 1\n0.6 0 1 0.5 1\n"
        "-0.6 0.7 0.1 1 1\n0 0.7 0.5 1 1\n0.6 0.7 1 1 -1\naspect 1\n");
}

/// A wide picture, two calibrations over it that share their light by masks, and an inset on top.
Layout four_viewports(Packing packing = Packing::mono)
{
    Layout layout = one_view(Planar{70}, size);
    Output& output = layout.outputs[0];
    output.packing = packing;
    const Warp warp{.file = mesh_in_the_middle()};
    const auto right = grey("right.png", [](int x, int) { return ramp(x); });
    const auto left = grey("left.png", [](int x, int) { return 1 - ramp(x); });
    output.viewports.push_back({.projection = Planar{50, {}, {-10, 0, 0}}, .warp = warp, .alpha_mask = left, .order = 1});
    output.viewports.push_back({.projection = Fisheye{120, 90}, .alpha_mask = right, .order = 1});
    output.viewports.push_back({.rect = {0.625, 0.5, 0.25, 0.25}, .projection = Planar{20, {}, {25, 5, 0}}, .order = 7});
    return layout;
}

/// One viewport alone and without its mask. The others move to outputs of their own, so that the same cube map is planned.
Layout alone(const Layout& layout, std::size_t viewport)
{
    Layout one = layout;
    one.outputs.assign(layout.outputs[0].viewports.size(), layout.outputs[0]);
    std::size_t elsewhere = 1;
    for (std::size_t i = 0; i < one.outputs.size(); ++i) {
        Output& output = one.outputs[i == viewport ? 0 : elsewhere++];
        output.name = std::to_string(i);
        output.viewports = {layout.outputs[0].viewports[i]};
        output.viewports[0].alpha_mask.clear();
    }
    return one;
}

/// The same with the layout's preview, which shows only the first output at its size.
Layout with_alone(const Layout& layout, std::size_t viewport)
{
    Layout one = layout;
    one.outputs[0].viewports = {layout.outputs[0].viewports[viewport]};
    return one;
}

Shot flown() { return load_shot(testing::source_dir() / "config/shots/starbow.json"); }

double psnr(const Bytes& a, const Bytes& b)
{
    const ivec2 pixels(int(a.size() / 4), 1);
    return psnr_dB({pixels, a}, {pixels, b});
}

Bytes picture(
    const Layout& layout, const Shot& shot, const Panel* hud = nullptr,
    const std::function<void(FrameRenderer&)>& with = [](FrameRenderer&) {})
{
    OffscreenRenderer offscreen = renderer(avenue().world, layout, false);
    with(offscreen.frame());
    return offscreen.picture(shot, hud).front();
}

/// A large picture and an opaque inset that looks the same way. The gamma makes every picture go through a canvas, so that
/// a pixel of both together has the same bytes as one of either.
Layout inset()
{
    Layout layout = one_view(Planar{90}, size);
    layout.outputs[0].colour.gamma = 2.2;
    layout.hud.emplace(); // at the same place with the inset and without it
    layout.outputs[0].viewports.push_back({.rect = {0.25, 0.25, 0.5, 0.5}, .projection = Planar{40}, .order = 1});
    return layout;
}

bool in_inset(int x, int y) { return x >= 24 && x < 72 && y >= 16 && y < 48; }

void expect_each_in_its_place(const Bytes& both, const Bytes& large, const Bytes& small, const char* what)
{
    int wrong = 0;
    std::size_t differing = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (int c = 0; c < 4; ++c) {
                const std::size_t i = std::size_t(4 * (y * size.x + x) + c);
                wrong += both[i] != (in_inset(x, y) ? small : large)[i];
                differing += small[i] != large[i];
            }
    EXPECT_EQ(wrong, 0) << what;
    EXPECT_GT(differing, 1000u) << what; // otherwise the test could not tell them apart
}

} // namespace

TEST(Overlap, AnOpaqueInsetAndItsSurroundingsArePicturesOfTheirOwn)
{
    const Layout layout = inset(), large = alone(layout, 0), small = alone(layout, 1);
    const Shot shot = flown();
    const Panel panel
        = Typesetter().draw(readings(ship_at(shot), avenue().world.scene, shot.effects), starbow::testing::words(), 320);
    const OverlayScale scale{1, 1e4, 10};
    struct Case {
        const char* name;
        const Panel* hud;
        std::function<void(FrameRenderer&)> with;
    };
    const Case cases[] = {{"stars", nullptr, [](FrameRenderer&) {}}, {"head-up display", &panel, [](FrameRenderer&) {}},
        {"glow", nullptr, [](FrameRenderer& frame) { frame.bloom(0.4, 0); }},
        {"overlay", nullptr,
            [&](FrameRenderer& frame) {
                frame.measure(Measuring{.over = {Overlay::ring, {}, scale}});
            }},
        {"grid", nullptr, [](FrameRenderer& frame) { frame.show(Pattern::grid); }},
        {"rings", nullptr, [](FrameRenderer& frame) { frame.show(Pattern::rings); }}};
    for (const Case& one : cases)
        expect_each_in_its_place(picture(layout, shot, one.hud, one.with), picture(large, shot, one.hud, one.with),
            picture(small, shot, one.hud, one.with), one.name);
}

TEST(Overlap, LightIsMixedByTheRuleInEveryPixel)
{
    Layout layout = four_viewports();
    layout.outputs[0].colour.gamma = 1; // bytes are proportional to light
    const Shot shot = flown();
    const Bytes both = picture(layout, shot);
    std::vector<Bytes> each;
    for (std::size_t i = 0; i < 4; ++i)
        each.push_back(picture(alone(layout, i), shot));
    OffscreenRenderer mesh = renderer(avenue().world, alone(layout, 1)),
                      fisheye = renderer(avenue().world, alone(layout, 2));
    const Numbers meshes(mesh, shot), fisheyes(fisheye, shot);
    double worst = 0;
    int covered[3] = {0, 0, 0};
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const int i = y * size.x + x;
            const bool top = x >= 60 && x < 84 && y >= 32 && y < 48;
            const double of_mesh = meshes.shown(i) ? 1 - ramp(x) : 0, of_fisheye = fisheyes.shown(i) ? ramp(x) : 0;
            covered[0] += of_mesh > 0, covered[1] += of_fisheye > 0, covered[2] += of_mesh > 0 && of_fisheye > 0;
            for (int c = 0; c < 3; ++c) {
                const auto byte = [&](std::size_t k) { return double(each[k][std::size_t(4 * i + c)]); };
                const double under
                    = byte(0) * (1 - std::min(of_mesh + of_fisheye, 1.0)) + byte(1) * of_mesh + byte(2) * of_fisheye;
                worst = std::max(worst, std::abs(both[std::size_t(4 * i + c)] - (top ? byte(3) : under)));
            }
        }
    EXPECT_GT(std::min({covered[0], covered[1], covered[2]}), 200);
    // Rounding and dither of the mixed bytes add up to 1, those of the picture to another; fp16 keeps shares to 2^-11.
    EXPECT_LT(worst, 2.2);
}

TEST(Overlap, EqualsTheReferenceInEveryPacking)
{
    Doc doc;
    for (int i = 0; i < 40; ++i) // a wall of coloured tiles around
        quad(doc, {12 * std::sin(0.157 * i), std::fmod(1.7 * i, 9.0) - 4, -12 * std::cos(0.157 * i)},
            {1.4 * std::cos(0.157 * i), 0, 1.4 * std::sin(0.157 * i)}, {0, 1.8, 0},
            unlit(doc, {std::fmod(0.31 * i, 0.7), std::fmod(0.17 * i, 0.6), std::fmod(0.23 * i, 0.5)}));
    const GpuWorld world = open_world("tiles", doc, {{"sky", smooth_sky}});
    const ReferenceWorld rays = open_reference_world(testing::scratch("tiles.json"));
    std::vector<Packing> packings = {Packing::rows};
    if (testing::all_cases())
        packings.insert(packings.end(), {Packing::mono, Packing::side_by_side, Packing::anaglyph_dubois});
    for (const Packing packing : packings) {
        Layout layout = four_viewports(packing);
        layout.outputs[0].colour.gamma = 2.2;
        const Shot shot = shot_at({0, 0, 0}, {0, 0, -u_of_beta(0.3)}, {0, 0, -1});
        OffscreenRenderer live = renderer(world, layout);
        const Bytes drawn = live.picture(shot).front();
        const Reference truth = reference(rays.input(), layout, shot, 0, {.samples = 4});
        const Bytes right = shown(truth);
        const double dB = psnr(drawn, right);
        std::printf("packing %d: %.1f dB\n", int(packing), dB);
        EXPECT_GT(dB, 29) << int(packing); // as other layouts: a picture off by one pixel has at most 20
        // Numbers are those of the viewport with the largest part, chosen by both in their own way.
        const Numbers numbers(live, shot);
        int same = 0, all = 0;
        for (int i = 0; i < numbers.count(); ++i) {
            EXPECT_EQ(numbers.shown(i), truth.numbers[std::size_t(i)].shown);
            if (numbers.shown(i))
                ++all, same += between(numbers.camera(i), truth.numbers[std::size_t(i)].camera) < 1e-5;
        }
        EXPECT_EQ(all, numbers.count());
        EXPECT_GE(same, all - all / 500) << int(packing); // where two parts are equal, rounding chooses
    }
}

TEST(Overlap, APixelBelongsToTheViewportWithTheLargestPart)
{
    const Layout layout = inset();
    OffscreenRenderer offscreen = renderer(avenue().world, layout);
    const ViewSet& views = offscreen.frame().views();
    EXPECT_EQ(views.view_at(0, {10.5, 10.5}), 0u);
    EXPECT_EQ(views.view_at(0, {48.5, 32.5}), 1u);
    const Numbers both(offscreen, flown());
    OffscreenRenderer one = renderer(avenue().world, alone(layout, 1));
    const Numbers small(one, flown());
    const int middle = 28 * size.x + 42;
    EXPECT_EQ(both.camera(middle), small.camera(middle));
    EXPECT_LT(between(views.direction(0, {42.5, 28.5}).value(),
                  dvec3((42.5 - 48) / 16, (32 - 28.5) / 16, -1 / std::tan(glm::radians(20.0)))),
        1e-6);
}

// A bright wall in front, a dim one behind. Whatever is hidden must not count.
TEST(Overlap, TheExposureCountsEachPixelOnce)
{
    Doc doc;
    quad(doc, {0, 0, -10}, {30, 0, 0}, {0, 30, 0}, unlit(doc, {0.9, 0.9, 0.9}));
    quad(doc, {0, 0, 10}, {-30, 0, 0}, {0, 30, 0}, unlit(doc, {0.01, 0.01, 0.01}));
    const GpuWorld world = open_world("two_walls", doc);
    const Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    const Projection ahead = Planar{60}, behind = Planar{60, {}, {180, 0, 0}};
    const auto ev = [&](std::vector<Viewport> viewports) {
        Layout layout = one_view(ahead, size);
        layout.outputs[0].viewports = std::move(viewports);
        return renderer(world, layout, false).metered(shot).value();
    };
    const double bright = ev({{.projection = ahead}}), dim = ev({{.projection = behind}});
    ASSERT_GT(std::abs(bright - dim), 3);
    EXPECT_NEAR(ev({{.projection = ahead}, {.projection = behind, .order = 1}}), dim, 0.01);
    EXPECT_NEAR(ev({{.projection = behind}, {.projection = ahead, .order = 1}}), bright, 0.01);
    // Half of each, beside each other or over each other: the same pixels, of which other samples are taken.
    const double side = glm::degrees(std::atan(std::tan(glm::radians(30.0)) * size.x / size.y));
    const Projection left = Planar{60, Sides{-side, 0, -30, 30}}, right = Planar{60, Sides{0, side, -30, 30}, {180, 0, 0}};
    const double halves
        = ev({{.rect = {0, 0, 0.5, 1}, .projection = left}, {.rect = {0.5, 0, 0.5, 1}, .projection = right}});
    EXPECT_NEAR(ev({{.projection = ahead}, {.rect = {0.5, 0, 0.5, 1}, .projection = right, .order = 1}}), halves, 0.1);
}

// A grey wall behind hides the view of bright stars ahead.
TEST(Overlap, HiddenStarsDoNotCountForTheExposure)
{
    Doc doc;
    quad(doc, {0, 0, 10}, {-30, 0, 0}, {0, 30, 0}, unlit(doc, {0.2, 0.2, 0.2}));
    GpuWorld world = open_world("starry", doc,
        {{"stars",
            {{"catalogue", testing::write_text("one_star.txt", "0 0 0 65 -\n").string()}, {"brightness_arcmin2", 1e4},
                {"ahead_deg", {0, 0}}}}});
    std::vector<Star> stars;
    for (int i = 0; i < 2000; ++i)
        stars.push_back({glm::transpose(world_from_equatorial({0, 0}))
                * glm::normalize(dvec3(std::fmod(0.618 * i, 1.0) - 0.5, std::fmod(0.414 * i, 1.0) - 0.5, -1)),
            -8, 5772});
    put_stars(world, stars);
    const Projection ahead = Planar{50}, behind = Planar{50, {}, {180, 0, 0}};
    const auto ev = [&](std::vector<Viewport> viewports) {
        Layout layout = one_view(ahead, size);
        layout.outputs[0].viewports = std::move(viewports);
        return renderer(world, layout, false).metered(shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1})).value();
    };
    const double wall = ev({{.projection = behind}}), sky = ev({{.projection = ahead}});
    std::printf("wall %.2f, stars %.2f EV\n", wall, sky);
    ASSERT_LT(sky, wall - 1);
    EXPECT_NEAR(ev({{.projection = ahead}, {.projection = behind, .order = 1}}), wall, 0.01);
    EXPECT_NEAR(ev({{.projection = behind}, {.projection = ahead, .order = 1}}), sky, 0.01);
}

TEST(Overlap, APreviewShowsItSmall)
{
    Layout layout = inset();
    layout.outputs[0].name = "a";
    Output preview;
    preview.name = "preview";
    preview.size = size + 8; // a gap of 4 on each side
    preview.preview = true;
    layout.outputs.push_back(preview);
    const auto shown_in = [](const Layout& layout) { return renderer(avenue().world, layout, false).picture(flown()); };
    const Bytes both = shown_in(layout)[1], large = shown_in(with_alone(layout, 0))[1],
                small = shown_in(with_alone(layout, 1))[1];
    // Alone, a viewport's cube map has other texels, so that edges differ a little.
    double right = 0, wrong = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (int c = 0; c < 3; ++c) {
                const std::size_t i = std::size_t(4 * ((y + 4) * preview.size.x + x + 4) + c);
                right += std::abs(both[i] - (in_inset(x, y) ? small : large)[i]);
                wrong += std::abs(both[i] - (in_inset(x, y) ? large : small)[i]);
            }
    EXPECT_LT(right / (3 * size.x * size.y), 1.5); // dither alone makes 0.5
    EXPECT_GT(wrong, 5 * right);
}

} // namespace starbow::gpu_test::overlap_gpu_test
