// The measures for comparing pictures, against known values that do not need their code.
#include "runtime/images/picture_errors.h"
#include <cmath>
#include <gtest/gtest.h>

namespace picture_errors_test {

using namespace starbow;

namespace {

struct Picture {
    glm::ivec2 size;
    std::vector<std::uint8_t> rgba;
    explicit Picture(glm::ivec2 s, glm::ivec3 colour = glm::ivec3(0))
        : size(s)
        , rgba(std::size_t(s.x * s.y) * 4, 255)
    {
        for (int y = 0; y < s.y; ++y)
            for (int x = 0; x < s.x; ++x)
                put(x, y, colour);
    }
    void put(int x, int y, glm::ivec3 colour)
    {
        for (int c = 0; c < 3; ++c)
            rgba[std::size_t(4 * (y * size.x + x) + c)] = std::uint8_t(colour[c]);
    }
    operator Shown8() const { return {size, rgba}; }
};

double mean(const std::vector<double>& values)
{
    double sum = 0;
    for (double v : values)
        sum += v;
    return sum / double(values.size());
}

/// A slanted edge with brightness to its right, placed to any fraction of a pixel. Each pixel has its share of brightness,
/// without sRGB, so that half a share is half a byte.
Picture edge(glm::ivec2 size, double at, double lean)
{
    Picture picture(size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const double share = std::clamp(x + 1 - (at + lean * y), 0.0, 1.0);
            picture.put(x, y, glm::ivec3(int(std::lround(40 + 150 * share))));
        }
    return picture;
}

} // namespace

TEST(PictureErrorsTest, APictureHasNoErrorsAgainstItself)
{
    const Picture picture = edge({64, 48}, 20.3, 0.2);
    const PictureErrors errors = picture_errors(picture, picture);
    EXPECT_TRUE(std::isinf(errors.psnr_dB));
    EXPECT_EQ(errors.flip, 0);
    EXPECT_EQ(errors.ciede2000_mean, 0);
    EXPECT_EQ(errors.edges_95_px, 0);
}

TEST(PictureErrorsTest, PsnrFollowsItsDefinition)
{
    // 20 log10(255) for a difference of 1 in every byte, by definition.
    EXPECT_NEAR(psnr_dB(Picture({8, 8}, {100, 101, 102}), Picture({8, 8}, {101, 102, 101})), 48.1308, 1e-4);
    EXPECT_NEAR(psnr_dB(Picture({8, 8}, {0, 0, 0}), Picture({8, 8}, {255, 255, 255})), 0, 1e-12);
}

TEST(PictureErrorsTest, FlipSpansItsWholeRange)
{
    // The measure normalizes its colour difference by that of green and blue.
    EXPECT_NEAR(mean(flip(Picture({32, 32}, {0, 255, 0}), Picture({32, 32}, {0, 0, 255}))), 1, 1e-9);
    // Black and white, by hand: HyAB is 100. For green and blue it is 203.3, with Hunt's factor on their L*a*b* (87.73,
    // -86.18, 83.18) and (32.30, 79.19, -107.86). To the power 0.7 these are 25.12 and 41.26; 0.4 of the second is 16.50.
    EXPECT_NEAR(mean(flip(Picture({32, 32}, {0, 0, 0}), Picture({32, 32}, {255, 255, 255}))),
        0.95 + 0.05 * (25.12 - 16.50) / (41.26 - 16.50), 2e-3);
    // sRGB 100 and 101 differ by 0.41 in L*: 0.41^0.7 * 0.95 / 16.50.
    EXPECT_NEAR(mean(flip(Picture({32, 32}, {100, 100, 100}), Picture({32, 32}, {101, 101, 101}))), 0.0308, 1e-3);
    double before = 0;
    for (int step : {1, 4, 16, 64}) {
        const double now = mean(flip(Picture({32, 32}, {100, 100, 100}), Picture({32, 32}, glm::ivec3(100 + step))));
        EXPECT_GT(now, before);
        before = now;
    }
}

TEST(PictureErrorsTest, FlipIgnoresBlurredDetailAndWeightsEdges)
{
    // A checkerboard against its mean grey: at 67 pixels in a degree the eye blurs squares of one pixel mostly away, but not
    // squares of 16 pixels.
    const auto board = [](int square, int low, int high) {
        Picture picture({96, 96});
        for (int y = 0; y < 96; ++y)
            for (int x = 0; x < 96; ++x)
                picture.put(x, y, glm::ivec3((x / square + y / square) % 2 ? low : high));
        return picture;
    };
    const Picture grey({96, 96}, glm::ivec3(188)); // as bright as if half of the pixels were white
    EXPECT_LT(mean(flip(board(1, 0, 255), grey)), 0.6 * mean(flip(board(16, 0, 255), grey)));
    // The same small difference counts more at an edge.
    Picture half({96, 96}, glm::ivec3(120));
    for (int y = 0; y < 96; ++y)
        for (int x = 48; x < 96; ++x)
            half.put(x, y, glm::ivec3(135));
    const std::vector<double> errors = flip(half, Picture({96, 96}, glm::ivec3(120)));
    EXPECT_GT(errors[48 * 96 + 48], 1.1 * errors[48 * 96 + 90]);
}

TEST(PictureErrorsTest, Ciede2000OfAKnownPairIsRight)
{
    // Neutral greys differ only in lightness: sRGB 119 and 120 have L* 50.0344 and 50.4316. The result is dL' / SL, where SL
    // is 1 within 1e-4 at L* = 50.
    const PictureErrors errors = picture_errors(Picture({16, 16}, {119, 119, 119}), Picture({16, 16}, {120, 120, 120}));
    EXPECT_NEAR(errors.ciede2000_mean, 0.397, 0.01);
    EXPECT_NEAR(errors.ciede2000_95, errors.ciede2000_mean, 1e-12);
}

TEST(PictureErrorsTest, EdgesAreFoundToATenthOfAPixel)
{
    for (double lean : {0.0, 0.3, -0.7})
        for (double moved : {0.25, -0.5, 0.9}) {
            const std::vector<double> found
                = edge_displacements_px(edge({120, 60}, 60 + moved, lean), edge({120, 60}, 60, lean));
            ASSERT_GT(found.size(), 30u);
            // A slanted edge moves less across itself than along the row. Positive is towards brighter pixels. The tolerance
            // of a tenth covers the steps between pixels.
            EXPECT_NEAR(quantile(found, 0.5), moved / std::hypot(1, lean), 0.1) << lean << " " << moved;
        }
    // Blur alone does not move an edge.
    Picture sharp = edge({120, 60}, 60, 0), soft({120, 60});
    for (int y = 0; y < 60; ++y)
        for (int x = 1; x < 119; ++x)
            for (int c = 0; c < 3; ++c)
                soft.rgba[std::size_t(4 * (y * 120 + x) + c)] = std::uint8_t(
                    (sharp.rgba[std::size_t(4 * (y * 120 + x - 1) + c)] + sharp.rgba[std::size_t(4 * (y * 120 + x + 1) + c)]
                        + 2 * sharp.rgba[std::size_t(4 * (y * 120 + x) + c)])
                    / 4);
    EXPECT_NEAR(quantile(edge_displacements_px(soft, sharp), 0.5), 0, 0.02);
}

TEST(PictureErrorsTest, QuantilesInterpolateBetweenNeighbours)
{
    EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2);
    EXPECT_EQ(quantile({3, 1, 2, 4}, 0.5), 2.5);
    EXPECT_EQ(quantile({3, 1, 2}, 1), 3);
    EXPECT_EQ(quantile({}, 0.5), 0);
}

} // namespace picture_errors_test
