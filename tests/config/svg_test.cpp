// The writer of SVG drawings: its elements in another parser's eyes, numbers, and texts with letters that XML keeps for
// itself.
#include "config/markup/svg.h"
#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <pugixml.hpp>
#include <vector>

namespace svg_test {

using namespace starbow;

TEST(Svg, AnXmlParserReadsEveryElement)
{
    Svg svg;
    const std::array<glm::dvec2, 3> corners{glm::dvec2(0, 0), {10.06, 0}, {10, -0.02}};
    svg.text({1, 2.28}, "a < b & \"c\" > d\x01", "class=\"head\"");
    svg.line({0, 1}, {2, 3}, "");
    svg.rect({1, 2}, {11, 22.5}, "fill=\"none\"");
    svg.circle({5, 6}, 4, "class=\"best\"", "50 % & more");
    svg.circle({5, 6}, 4, "");
    svg.polyline(corners, "");
    svg.polygon(corners, "");
    svg.path(path_data(corners, true), "");
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svg.drawn({800, 320.5}, "role=\"img\"").c_str()));
    const pugi::xml_node root = document.first_child();
    EXPECT_STREQ(root.attribute("viewBox").value(), "0 0 800 320.5");
    EXPECT_STREQ(root.attribute("role").value(), "img");
    std::vector<pugi::xml_node> all(root.begin(), root.end());
    ASSERT_EQ(all.size(), 8u);
    EXPECT_STREQ(all[0].text().get(), "a < b & \"c\" > d?");
    EXPECT_STREQ(all[0].attribute("class").value(), "head");
    EXPECT_STREQ(all[0].attribute("y").value(), "2.3");
    EXPECT_EQ(all[1].attribute("y2").as_double(), 3);
    EXPECT_EQ(all[2].attribute("width").as_double(), 10);
    EXPECT_EQ(all[2].attribute("height").as_double(), 20.5);
    EXPECT_STREQ(all[2].attribute("fill").value(), "none");
    EXPECT_STREQ(all[3].child("title").text().get(), "50 % & more");
    EXPECT_TRUE(all[4].first_child().empty());
    EXPECT_STREQ(all[5].attribute("points").value(), "0,0 10.1,0 10,0");
    EXPECT_STREQ(all[6].name(), "polygon");
    EXPECT_STREQ(all[7].attribute("d").value(), "M0 0L10.1 0L10 0Z");
}

TEST(Svg, NumbersAreShort)
{
    EXPECT_EQ(shortest(0), "0");
    EXPECT_EQ(shortest(-0.04), "0");
    EXPECT_EQ(shortest(100), "100");
    EXPECT_EQ(shortest(99.96), "100");
    EXPECT_EQ(shortest(1.25, 3), "1.25");
    EXPECT_EQ(shortest(1500, 0), "1500");
    EXPECT_GT(shortest(std::numeric_limits<double>::max(), 0).size(), 300u);
}

} // namespace svg_test
