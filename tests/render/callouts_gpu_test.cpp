// Callouts over the views: an inset shows its own shot pixel for pixel, a sign's arrow ends at the thing, and
// nothing else changes.
#include "config/model/inset_view.h"
#include "runtime/hud/highlights.h"
#include "runtime/hud/signs.h"
#include "tests/support/gpu_environment.h"

namespace starbow::gpu_test::callouts_gpu_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr ivec2 size(160, 120);

Shot in_flight() { return shot_at({0, 0, -20}, {0, 0, -u_of_gamma(2.5)}); }

/// The pixels that differ between two pictures.
std::vector<ivec2> changed(const Bytes& a, const Bytes& b, ivec2 of)
{
    std::vector<ivec2> pixels;
    for (int y = 0; y < of.y; ++y)
        for (int x = 0; x < of.x; ++x) {
            const std::size_t at = 4 * (std::size_t(y) * of.x + x);
            if (!std::equal(
                    a.begin() + std::ptrdiff_t(at), a.begin() + std::ptrdiff_t(at) + 3, b.begin() + std::ptrdiff_t(at)))
                pixels.emplace_back(x, y);
        }
    return pixels;
}

} // namespace

TEST(Callouts, TheSmallPictureIsShownAsItIs)
{
    // Over the whole view, so that its pixels are the view's.
    const double half = std::tan(glm::radians(0.5 * inset_fov_deg));
    OffscreenRenderer whole = renderer(avenue().world, one_view(Planar{inset_fov_deg}, size), false);
    const Shot moving = in_flight();
    const Bytes bare = whole.picture(moving)[0];
    const Shot resting = starbow::inset_shot(moving, InsetView::at_rest, moving.exposure_ev);
    const Bytes wanted = whole.picture(resting)[0];
    whole.frame().show_inset(resting, size.x);
    const Callout callout{.picture = &whole.frame().inset_picture(),
        .place = {glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, -1), dvec2(half / Inset::aspect, half)}};
    whole.frame().place({&callout, 1});
    const Bytes shown = whole.picture(moving)[0];
    double mean = 0;
    for (int y = 6; y < size.y - 6; ++y) // within its frame
        for (int x = 6; x < size.x - 6; ++x)
            for (int c = 0; c < 3; ++c) {
                const std::size_t at = 4 * (std::size_t(y) * size.x + x) + std::size_t(c);
                mean += std::abs(int(shown[at]) - int(wanted[at])) / (3.0 * (size.x - 12) * (size.y - 12));
            }
    EXPECT_LT(mean, 1); // texels lie elsewhere
    EXPECT_GT(changed(bare, shown, size).size(), size.x * size.y / 20u);
    whole.frame().place({});
    whole.frame().drop_insets();
    whole.frame().repeatable(true);
    const Bytes alone = whole.picture(moving)[0];
    OffscreenRenderer fresh = renderer(avenue().world, one_view(Planar{inset_fov_deg}, size), false);
    fresh.frame().repeatable(true);
    EXPECT_EQ(alone, fresh.picture(moving)[0]);
}

/// A menu's picture has its own colours, whatever the exposure of the world behind it, and its upper row above.
TEST(Callouts, AChoicesPictureHasItsColours)
{
    SmallPicture picture{{64, 36}, {}};
    const auto colour = [](int x, int y) { return std::array{x < 32 ? 200 : 30, y < 18 ? 90 : 250, 60}; };
    for (int y = 0; y < picture.size.y; ++y)
        for (int x = 0; x < picture.size.x; ++x)
            for (const int code : colour(x, y))
                picture.rgb.push_back(std::uint8_t(code));
    const dvec2 half(0.2, 0.2 * 36 / 64);
    for (const auto& [projection, of] :
        {std::pair<Projection, ivec2>{Planar{60}, {160, 120}}, {Fisheye{180, 0}, {384, 384}}}) {
        OffscreenRenderer whole = renderer(avenue().world, one_view(projection, of), false);
        const Callout callout{.small = &picture, .place = {glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, -1), half}};
        for (const double ev : {-6.0, 12.0}) {
            Shot shot = in_flight();
            shot.exposure_ev = ev;
            whole.frame().place({&callout, 1});
            const Bytes shown = whole.picture(shot)[0];
            int seen = 0;
            for (int y = 0; y < of.y; ++y)
                for (int x = 0; x < of.x; ++x) {
                    const auto direction = whole.frame().views().direction(0, dvec2(x, y) + 0.5);
                    if (!direction || direction->z > -0.1)
                        continue;
                    const dvec2 at = dvec2(*direction) / -direction->z / half; // -1 to 1
                    if (glm::any(glm::greaterThan(glm::abs(at), dvec2(0.8)))
                        || glm::any(glm::lessThan(glm::abs(at), dvec2(0.2))))
                        continue; // its frame, and where the colours meet
                    const auto wanted = colour(at.x < 0 ? 0 : 63, at.y > 0 ? 0 : 35);
                    for (std::size_t c = 0; c < 3; ++c)
                        EXPECT_NEAR(shown[4 * std::size_t(y * of.x + x) + c], wanted[c], 1) << x << " " << y << " " << c;
                    ++seen;
                }
            EXPECT_GT(seen, 200);
        }
    }
}

// WCAG 2.2, 1.4.3: relative luminances, the lighter and the darker one, each with 0.05 of stray light.
TEST(Callouts, TheFaintestLettersHaveTheirContrastBeforeAnyPicture)
{
    OffscreenRenderer whole = renderer(avenue().world, one_view(Planar{60}, size), false);
    const auto luminance = [](const std::uint8_t* pixel) {
        const auto linear = [](int code) {
            const double c = code / 255.0;
            return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        };
        return 0.2126 * linear(pixel[0]) + 0.7152 * linear(pixel[1]) + 0.0722 * linear(pixel[2]);
    };
    Panel panel = plate({80, 60}, 8);
    for (int y = 15; y < 45; ++y)
        for (int x = 30; x < 50; ++x)
            panel.texels[2 * (std::size_t(y) * 80 + std::size_t(x))] = std::uint8_t(faintest_letters * 255);
    const Callout callout{.letters = &panel, .place = {glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, -1), {0.3, 0.225}}};
    whole.frame().place({&callout, 1});
    for (const double ev : {40.0, 0.0, -40.0}) {
        Shot shot = in_flight();
        shot.exposure_ev = ev;
        const Bytes picture = whole.picture(shot)[0];
        const auto at = [&](int x, int y) { return luminance(&picture[4 * (std::size_t(y) * size.x + std::size_t(x))]); };
        if (ev > 0) {
            EXPECT_EQ(at(4, 4), 1); // it is the brightest picture
        }
        const double letters = at(80, 60), plate_beside = at(80 - 24, 60);
        EXPECT_GE((letters + 0.05) / (plate_beside + 0.05), 4.5) << ev << ": " << letters << " on " << plate_beside;
    }
}

TEST(Callouts, TheArrowEndsAtItsDirection)
{
    const Typesetter typesetter;
    for (const auto& [projection, of] :
        {std::pair<Projection, ivec2>{Planar{60}, {640, 480}}, {Fisheye{180, 30}, {512, 512}}}) {
        const Layout layout = one_view(projection, of);
        OffscreenRenderer whole = renderer(avenue().world, layout, false);
        const Bytes bare = whole.picture(in_flight())[0];
        const double degree_px = 6;
        const Panel panel = draw_sign(typesetter, {"This is behind you:", "its light"}, degree_px);
        for (const dvec3& towards : {dvec3(0, 0, -1), dvec3(0.3, 0.05, -1), dvec3(-0.25, -0.1, -1)}) {
            const Callout callout{.letters = &panel,
                .place
                = whole.frame().views().place_above(glm::normalize(towards), 0.5 * dvec2(panel.size) * 0.0174 / degree_px)};
            whole.frame().place({&callout, 1});
            const std::vector<ivec2> pixels = changed(bare, whole.picture(in_flight())[0], of);
            ASSERT_GT(pixels.size(), 200u);
            double nearest = 1e9, farthest = 0;
            for (const ivec2& pixel : pixels) {
                const auto direction = whole.frame().views().direction(0, dvec2(pixel) + 0.5);
                ASSERT_TRUE(direction);
                nearest = std::min(nearest, glm::degrees(between(*direction, towards)));
                farthest = std::max(farthest, glm::degrees(between(*direction, towards)));
            }
            EXPECT_LT(nearest, 0.7); // a pixel of the dome has 0.35 degrees
            EXPECT_LT(farthest, 14);
            whole.frame().place({});
        }
        EXPECT_TRUE(changed(bare, whole.picture(in_flight())[0], of).empty());
    }
}

TEST(Callouts, TheRingIsAroundItsDirection)
{
    const Typesetter typesetter;
    const double degree_px = 8, ring_deg = 4;
    for (const auto& [projection, of] :
        {std::pair<Projection, ivec2>{Planar{60}, {640, 480}}, {Fisheye{180, 30}, {512, 512}}}) {
        OffscreenRenderer whole = renderer(avenue().world, one_view(projection, of), false);
        const Bytes bare = whole.picture(in_flight())[0];
        const Panel panel = draw_ring(typesetter, "Wega", ring_deg * degree_px, degree_px);
        for (const dvec3& towards : {dvec3(0, 0, -1), dvec3(0.3, 0.05, -1), dvec3(-0.25, -0.1, -1)}) {
            const double scale = std::tan(glm::radians(1.0)) / degree_px;
            const Callout callout{.letters = &panel,
                .place = whole.frame().views().place_above(glm::normalize(towards), 0.5 * dvec2(panel.size) * scale,
                    ring_middle_px(ring_deg * degree_px, degree_px) * scale)};
            whole.frame().place({&callout, 1});
            dvec3 sum(0);
            for (const ivec2& pixel : changed(bare, whole.picture(in_flight())[0], of)) {
                const auto direction = whole.frame().views().direction(0, dvec2(pixel) + 0.5);
                ASSERT_TRUE(direction);
                const double off = glm::degrees(between(*direction, towards));
                EXPECT_GT(off, 3.3) << "the thing stays free";
                if (off < 4.6) // the name begins higher
                    sum += *direction;
            }
            EXPECT_LT(glm::degrees(between(sum, towards)), 0.3); // on a flat screen the ring lies in its plane
            whole.frame().place({});
        }
    }
}

TEST(Callouts, TheLineEndsAtTheRing)
{
    const PanelPass::Place from{glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, -1), {0.1, 0.075}}; // before the eye, facing it
    const Panel line = draw_line(16);
    OffscreenRenderer whole = renderer(avenue().world, one_view(Planar{60}, {640, 480}), false);
    const Bytes bare = whole.picture(in_flight())[0];
    for (const dvec3& towards : {dvec3(0.4, 0.2, -1), dvec3(-0.3, 0.3, -1), dvec3(0.02, -0.4, -1)}) {
        const double end = glm::radians(3.0);
        const auto place = ViewSet::place_line(from, glm::normalize(towards), end, 0.004);
        ASSERT_TRUE(place);
        const Callout callout{.letters = &line, .place = *place};
        whole.frame().place({&callout, 1});
        double nearest = 1e9;
        for (const ivec2& pixel : changed(bare, whole.picture(in_flight())[0], {640, 480})) {
            const dvec3 seen = *whole.frame().views().direction(0, dvec2(pixel) + 0.5);
            const dvec2 at = dvec2(seen) / -seen.z, to = dvec2(towards) / -towards.z;
            EXPECT_LT(std::abs(at.x * to.y - at.y * to.x) / glm::length(to), 0.007) << "on the straight line";
            EXPECT_TRUE(std::abs(at.x) > 0.095 || std::abs(at.y) > 0.07) << "it begins at the panel's edge";
            nearest = std::min(nearest, glm::degrees(between(seen, towards)));
        }
        EXPECT_NEAR(nearest, 3, 0.4);
    }
    EXPECT_FALSE(ViewSet::place_line(from, glm::normalize(dvec3(0.05, 0.02, -1)), 0.01, 0.004)) << "behind the panel";
    EXPECT_FALSE(ViewSet::place_line(from, {0, 0, 1}, 0.01, 0.004)) << "behind the eye";
}

} // namespace starbow::gpu_test::callouts_gpu_test
