// The vignette: each pixel loses the part of its light that this file's own formula says, and without it none.
#include "config/model/angles.h"
#include "config/model/shipped.h"
#include "tests/support/gpu_environment.h"
#include <functional>

namespace starbow::gpu_test::vignette_gpu_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

const Vignette edge{.elevation_deg = 0, .clear_deg = 15, .soft_deg = 20, .darkness = 0.9};

Bytes picture(OffscreenRenderer& offscreen, const Vignette& vignette, double part)
{
    offscreen.frame().vignette(vignette, part);
    return offscreen.picture(shot_at({0, 0, 0}, {0, 0, -1}, {0.1, 0.1, -1}))[0];
}

// IEC 61966-2-1.
double decoded(int code)
{
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
double encoded(double light)
{
    return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

/// The part of the light that is lost at an angle from the middle of the clear part: a cubic without slope at its ends.
double lost(double off_deg, const Vignette& vignette, double part)
{
    const double x = std::clamp((off_deg - vignette.clear_deg) / vignette.soft_deg, 0.0, 1.0);
    return part * vignette.darkness * (3 * x * x - 2 * x * x * x);
}

/// Compares all pixels of a layout's picture. direction: of a pixel's centre, any length; none where nothing is shown.
void expect_darkened(const Layout& layout, const Vignette& vignette, double part, double codes,
    const std::function<std::optional<dvec3>(dvec2)>& direction)
{
    OffscreenRenderer offscreen = renderer(avenue().world, layout, false);
    const Bytes usual = picture(offscreen, vignette, 0), dark = picture(offscreen, vignette, part);
    const ivec2 size = layout.outputs[0].size;
    const double up = vignette.elevation_deg * degree;
    int darker = 0, same = 0;
    double worst = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const auto n = direction(dvec2(x + 0.5, y + 0.5));
            const std::size_t at = 4 * (std::size_t(y) * std::size_t(size.x) + std::size_t(x));
            if (!n)
                continue;
            const double part_lost = lost(between(*n, dvec3(0, std::sin(up), -std::cos(up))) / degree, vignette, part);
            for (std::size_t k = at; k < at + 3; ++k)
                worst = std::max(worst, std::abs(encoded(decoded(usual[k]) * (1 - part_lost)) - dark[k]));
            darker += part_lost > 0.5 * part * vignette.darkness;
            same += part_lost == 0;
        }
    EXPECT_LE(worst, codes);
    EXPECT_GT(darker, size.x * size.y / 50);
    EXPECT_GT(same, size.x * size.y / 50);
}

} // namespace

TEST(Vignette, AFlatViewDarkensFromItsMiddle)
{
    const ivec2 size(160, 120);
    const Layout layout = one_view(Planar{.fov_y_deg = 90}, size);
    for (const double part : {0.3, 1.0})
        expect_darkened(layout, edge, part, 1.1, [&](dvec2 p) {
            const dvec2 off = (p - 0.5 * dvec2(size)) / (0.5 * size.y);
            return dvec3(off.x, -off.y, -1);
        });
}

TEST(Vignette, ADomeDarkensFromItsFront)
{
    const ivec2 size(160, 160);
    const Vignette high{.elevation_deg = 30, .clear_deg = 40, .soft_deg = 30, .darkness = 0.7};
    // The zenith in the middle, the front at the bottom of the picture.
    expect_darkened(one_view(Fisheye{}, size), high, 1, 2.1, [&](dvec2 p) -> std::optional<dvec3> {
        const dvec2 off = (p - 0.5 * dvec2(size)) / (0.5 * size.x);
        const double from_zenith = glm::length(off) * 90 * degree;
        if (glm::length(off) > 0.97)
            return {};
        const dvec2 way = glm::length(off) > 0 ? glm::normalize(off) : dvec2(0, 1);
        return dvec3(std::sin(from_zenith) * way.x, std::cos(from_zenith), -std::sin(from_zenith) * way.y);
    });
}

TEST(Vignette, EachEyeDarkensAroundItsOwnAxis)
{
    Layout layout = load_layout(shipped_file("layouts", "headset"));
    layout.outputs[0].size = {216, 120};
    OffscreenRenderer measuring = renderer(avenue().world, layout);
    const Shot shot = shot_at({0, 0, 0}, {0, 0, -1}, {0.1, 0.1, -1});
    const Numbers numbers(measuring, shot);
    // One lens colour counts for all three. The numbers are in the ship frame, and the edge is the cockpit's.
    expect_darkened(layout, edge, 1, 6, [&](dvec2 p) -> std::optional<dvec3> {
        const int i = int(p.y) * numbers.size.x + int(p.x);
        return numbers.shown(i) ? std::optional(glm::inverse(shot.ship_from_cockpit) * numbers.camera(i)) : std::nullopt;
    });
}

TEST(Vignette, WithoutATurnThePictureIsTheSameToTheByte)
{
    const Layout layout = one_view(Planar{.fov_y_deg = 90}, {120, 90});
    OffscreenRenderer never = renderer(avenue().world, layout, false), over = renderer(avenue().world, layout, false);
    const Bytes before = never.picture(shot_at({0, 0, 0}, {0, 0, -1}, {0.1, 0.1, -1}))[0];
    EXPECT_NE(picture(over, edge, 1), before);
    EXPECT_EQ(picture(over, edge, 0), before);
}

TEST(Vignette, ATestPatternStaysAsItIs)
{
    const Layout layout = one_view(Planar{.fov_y_deg = 90}, {120, 90});
    OffscreenRenderer offscreen = renderer(avenue().world, layout, false);
    offscreen.frame().show(Pattern::grid);
    const Bytes plain = picture(offscreen, edge, 0);
    EXPECT_EQ(picture(offscreen, edge, 1), plain);
}

} // namespace starbow::gpu_test::vignette_gpu_test
