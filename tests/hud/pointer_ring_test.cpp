// The guide's pointer as a picture: its size in degrees, its soft edges, its strength.
#include "runtime/hud/pointer_ring.h"
#include <algorithm>
#include <gtest/gtest.h>

namespace pointer_ring_test {

using namespace starbow;

namespace {

/// The brightness along a line through the middle, from the left.
std::vector<int> across(const Panel& ring)
{
    std::vector<int> row;
    const std::size_t side = std::size_t(ring.size.x), y = side / 2;
    for (std::size_t x = 0; x < side; ++x)
        row.push_back(ring.texels[2 * (y * side + x)]);
    return row;
}

} // namespace

TEST(PointerRing, ItIsThreeDegreesAcrossAndHollow)
{
    for (const double degree_px : {8.0, 20.0, 60.0}) {
        const Panel ring = draw_pointer(1, degree_px);
        EXPECT_EQ(ring.texels.size(), 2 * std::size_t(ring.size.x) * std::size_t(ring.size.y));
        const std::vector<int> row = across(ring);
        const int most = *std::ranges::max_element(row);
        const auto bright = [&](int value) { return value > most / 2; };
        const auto first = std::ranges::find_if(row, bright), last = std::find_if(row.rbegin(), row.rend(), bright).base();
        EXPECT_NEAR(double(last - first) / degree_px, 3, 0.3 + 2 / degree_px); // the half of its soft edge, and a pixel
        EXPECT_EQ(row[row.size() / 2], 0);
        EXPECT_EQ(row.front(), 0);
        EXPECT_GT(most, 200);
    }
}

TEST(PointerRing, ItsEdgesAreSoftAndItsStrengthIsItsBrightness)
{
    const std::vector<int> row = across(draw_pointer(1, 60)), half = across(draw_pointer(0.5, 60));
    int steepest = 0;
    for (std::size_t i = 1; i < row.size(); ++i) {
        steepest = std::max(steepest, std::abs(row[i] - row[i - 1]));
        EXPECT_NEAR(half[i], 0.5 * row[i], 1);
    }
    EXPECT_LT(steepest, 255 / 8); // a quarter of a degree has 15 pixels
    const std::vector<int> gone = across(draw_pointer(0, 60));
    EXPECT_EQ(*std::ranges::max_element(gone), 0);
}

} // namespace pointer_ring_test
