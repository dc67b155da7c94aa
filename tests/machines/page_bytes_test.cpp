// The instruments' page as a message: there and back, and what is refused.
#include "config/json/error.h"
#include "runtime/machines/page_bytes.h"
#include <gtest/gtest.h>
#include <random>

namespace starbow::page_bytes_test {
namespace {

/// Letters on a plate, in effect: long runs of few values.
Panel panel()
{
    Panel made = plate({300, 200}, 20);
    for (std::size_t i = 0; i < made.texels.size() / 2; ++i)
        made.texels[2 * i] = i % 300 / 20 % 2 == 0 && i / 300 % 20 < 12 ? 255 : 0;
    return made;
}

TEST(PageBytesTest, ComesBackAndIsSmall)
{
    const PageMessage page = page_of(panel(), 42);
    EXPECT_EQ(page.number, 42);
    EXPECT_LT(page.texels.size(), panel().texels.size() / 20);
    EXPECT_EQ(panel_of(page).size, panel().size);
    EXPECT_EQ(panel_of(page).texels, panel().texels);
}

std::string complaint(const PageMessage& page)
{
    try {
        panel_of(page);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(PageBytesTest, WhatIsNoPageIsRefused)
{
    PageMessage page = page_of(panel(), 1);
    const auto with_sides = [&](std::int32_t width, std::int32_t height) {
        PageMessage other = page;
        other.width = width, other.height = height;
        return complaint(other);
    };
    EXPECT_EQ(with_sides(0, 200), "a page of the exhibit's machines has 0 x 200 pixels; at most 16777216 are right");
    for (const auto& [width, height] : {std::pair{-300, -200}, {1 << 30, 1 << 30}, {5000, 5000}, {299, 200}, {300, 201}})
        EXPECT_NE(with_sides(width, height), "") << width << " x " << height;
    const std::vector<std::uint8_t> whole = page.texels;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        page.texels.assign(whole.begin(), whole.begin() + std::ptrdiff_t(length));
        EXPECT_EQ(complaint(page), "a page of the exhibit's machines is damaged; the same program on all machines is right");
    }
}

TEST(PageBytesTest, DamagedOnesAreReadOrRefused)
{
    const PageMessage whole = page_of(panel(), 1);
    std::mt19937 random(7);
    int refused = 0;
    for (int i = 0; i < 5000; ++i) {
        PageMessage page = whole;
        for (int k = int(random() % 4) + 1; k > 0; --k)
            page.texels[random() % page.texels.size()] = std::uint8_t(random());
        refused += !complaint(page).empty();
    }
    EXPECT_GT(refused, 4000); // its sum tells nearly all
}

} // namespace
} // namespace starbow::page_bytes_test
