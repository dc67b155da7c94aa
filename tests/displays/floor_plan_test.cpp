#include "displays/check/floor_plan.h"
#include "displays/check/floor_plan_table.h"
#include "displays/check/lint.h"
#include "displays/projections/picture.h"
#include "tests/support/sphere.h"
#include <cstring>
#include <pugixml.hpp>

namespace floor_plan_test {

using namespace starbow;
using namespace sphere;

namespace {

Output output(
    const std::string& name, glm::ivec2 size, const Projection& projection, const glm::dvec3& eye_m = glm::dvec3(0))
{
    Output output;
    output.name = name;
    output.size = size;
    output.viewports.resize(1);
    output.viewports[0].projection = projection;
    output.viewports[0].eye_m = eye_m;
    return output;
}

Layout layout_of(const std::vector<Output>& outputs)
{
    Layout layout;
    layout.name = "test";
    layout.outputs = outputs;
    return layout;
}

Layout cave()
{
    const glm::dvec3 eye(0.2, 1.7, 0.1);
    return layout_of({
        output("front", {1400, 1050}, Wall{{-1.5, 0, -1.5}, {1.5, 0, -1.5}, {-1.5, 2.25, -1.5}}, eye),
        output("left", {1400, 1050}, Wall{{-1.5, 0, 1.5}, {-1.5, 0, -1.5}, {-1.5, 2.25, 1.5}}, eye),
        output("right", {1400, 1050}, Wall{{1.5, 0, -1.5}, {1.5, 0, 1.5}, {1.5, 2.25, -1.5}}, eye),
        output("floor", {1400, 1400}, Wall{{-1.5, 0, 1.5}, {1.5, 0, 1.5}, {-1.5, 0, -1.5}}, eye),
    });
}

Layout projectors()
{
    Layout layout = layout_of({
        output("left", {1920, 1080}, Planar{50, {}, {-70, 20, 3}}),
        output("front", {1920, 1080}, Planar{50, {}, {0, 20, 0}}),
        output("right", {1920, 1080}, Planar{50, {}, {70, 20, -3}}),
        output("back-with-quite-a-long-name-for-a-projector", {1920, 1080}, Planar{60, {}, {180, 25, 0}}),
        output("zenith", {1024, 768}, Planar{70, {}, {0, 90, 0}}),
    });
    layout.outputs.emplace_back().name = "preview";
    layout.outputs.back().preview = true;
    return layout;
}

Layout headset()
{
    Layout layout = layout_of({output("headset", {2160, 1200}, Lens{})});
    Viewport& left = layout.outputs[0].viewports[0];
    left.rect = {0, 0, 0.5, 1};
    left.eye = Eye::left;
    layout.outputs[0].viewports.push_back(left);
    layout.outputs[0].viewports[1].rect.x = 0.5;
    layout.outputs[0].viewports[1].eye = Eye::right;
    layout.outputs.push_back(output("desk", {800, 600}, Planar{60}));
    return layout;
}

Layout mirror_dome()
{
    SphericalMirror mirror;
    mirror.projector_m = {0, -0.6, -1.2};
    mirror.projector = Planar{40, Sides{-24, 24, -4, 24}, {0, 8, 0}};
    mirror.mirror_m = {0, -0.3, -2.4};
    return layout_of({output("mirror", {1920, 1080}, mirror, {0, -0.3, 0.6})});
}

pugi::xml_document parsed(const Layout& layout)
{
    pugi::xml_document document;
    const std::string text = draw_floor_plan(layout, coverages(layout));
    const pugi::xml_parse_result result = document.load_string(text.c_str());
    EXPECT_TRUE(result) << result.description() << " at " << result.offset;
    return document;
}

template <typename Visitor> void each(pugi::xml_node node, const char* name, Visitor what)
{
    for (pugi::xml_node child : node.children()) {
        if (std::strcmp(child.name(), name) == 0)
            what(child);
        each(child, name, what);
    }
}

int count(const pugi::xml_document& document, const char* name, const std::string& class_name)
{
    int found = 0;
    each(document, name, [&](pugi::xml_node node) { found += node.attribute("class").value() == class_name; });
    return found;
}

} // namespace

TEST(CoverageTest, AWindowHasItsSolidAngleAndOutline)
{
    const std::vector<Coverage> all = coverages(layout_of({output("desk", {800, 600}, Planar{60})}));
    ASSERT_EQ(all.size(), 1u);
    const Coverage& desk = all[0];
    const double h = std::tan(pi / 6), w = h * 4 / 3;
    // The lattice has some 20000 cells; about the root of the 400 at the edge is miscounted.
    EXPECT_NEAR(desk.share / (std::asin(w * h / std::sqrt((1 + w * w) * (1 + h * h))) / pi), 1, 2e-3);
    ASSERT_TRUE(desk.azimuths);
    EXPECT_NEAR(desk.azimuths->x, -std::atan(w) * 180 / pi, 0.01);
    EXPECT_NEAR(desk.azimuths->y, std::atan(w) * 180 / pi, 0.01);
    EXPECT_NEAR(desk.elevations.x, -30, 0.01);
    EXPECT_NEAR(desk.elevations.y, 30, 0.01);
    // 300 pixels are tan(30 degrees). A corner's pixel is (1 + w² + h²)^(3/4) times as narrow.
    EXPECT_NEAR(desk.middle, 300 / h * pi / 180, 1e-3);
    EXPECT_NEAR(desk.least, desk.middle, 1e-3);
    EXPECT_NEAR(desk.most, desk.middle * std::pow(1 + w * w + h * h, 0.75), 0.1); // half a pixel from it
    // Every point of the outline is on an edge: |x| = w or |y| = h one unit ahead. Corners are cut off by half a cell.
    ASSERT_EQ(desk.outlines.size(), 1u);
    int on_edge = 0;
    for (const glm::dvec2& point : desk.outlines[0]) {
        const glm::dvec3 d = towards(point.x, point.y);
        on_edge += std::min(std::abs(std::abs(d.x / d.z) - w), std::abs(std::abs(d.y / d.z) - h)) < 2e-4;
    }
    EXPECT_EQ(on_edge, int(desk.outlines[0].size()));
}

TEST(CoverageTest, ADomeCoversHalfTheSphereUpToItsRim)
{
    const Coverage dome = coverages(layout_of({output("dome", {512, 512}, Fisheye{180, 30})})).at(0);
    EXPECT_NEAR(dome.share, 0.5, 1e-3);
    EXPECT_FALSE(dome.azimuths);
    EXPECT_NEAR(dome.elevations.x, -30, 0.01);
    EXPECT_NEAR(dome.elevations.y, 90, 1e-9);
    const glm::dvec3 zenith = towards(0, 60);
    int on_rim = 0;
    for (const auto& outline : dome.outlines)
        for (const glm::dvec2& point : outline)
            if (std::abs(point.x) < 179.99 && point.y < 89.99) { // the map's edge closes the outline
                EXPECT_NEAR(angle(towards(point.x, point.y), zenith) * 180 / pi, 90, 0.01);
                ++on_rim;
            }
    EXPECT_GT(on_rim, 50);
}

TEST(CoverageTest, CoverageWorksAcrossTheBackAndThePole)
{
    const std::vector<Coverage> all = coverages(projectors());
    ASSERT_EQ(all.size(), 5u); // a preview covers nothing of its own
    const double w = std::tan(pi / 6) * 16 / 9;
    // Turned up by 25 degrees, an upper corner has the azimuth with the tangent w / (cos 25 - tan 30 sin 25).
    const double c = std::cos(25 * pi / 180), s = std::sin(25 * pi / 180),
                 corner = std::atan(w / (c - s / std::sqrt(3.))) * 180 / pi;
    ASSERT_TRUE(all[3].azimuths);
    EXPECT_NEAR(all[3].azimuths->x, 180 - corner, 0.3); // the lattice rounds corners off
    EXPECT_NEAR(all[3].azimuths->y, 180 + corner, 0.3);
    EXPECT_FALSE(all[4].azimuths);
    EXPECT_NEAR(all[4].elevations.y, 90, 1e-9);
    const double h = std::tan(35 * pi / 180);
    EXPECT_NEAR(all[4].elevations.x, 90 - std::atan(h * 5 / 3) * 180 / pi, 0.3); // its diagonal
    EXPECT_NEAR(all[1].share, all[0].share, 2e-3 * all[1].share); // a turn does not change the covered part
}

TEST(CoverageTest, WhatAHigherViewportHidesDoesNotCount)
{
    Layout layout = layout_of({output("panorama", {800, 400}, Equirectangular{{-80, 80, -40, 40}})});
    std::vector<Viewport>& viewports = layout.outputs[0].viewports;
    const double whole = coverages(layout)[0].share;
    viewports.push_back({.rect = {0.5, 0, 0.5, 1}, .projection = Equirectangular{{100, 120, -40, 40}}, .order = 1});
    std::vector<Coverage> all = coverages(layout);
    EXPECT_NEAR(all[0].share, whole / 2, 1e-12); // edges lie between cells, so that the count is exact
    ASSERT_TRUE(all[0].azimuths);
    EXPECT_NEAR(all[0].azimuths->y, 0, 0.1);
    EXPECT_NEAR(all[1].share, whole / 8, 1e-12);
    viewports[1].rect = {0, 0, 1, 1};
    all = coverages(layout);
    EXPECT_EQ(all[0].share, 0);
    const std::vector<std::string> lines = lint(layout, all);
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(),
        [](const std::string& line) { return line == "panorama/0: viewports of a higher \"order\" hide all of it"; }));
}

TEST(CoverageTest, OverlapsAreCountedForEachPair)
{
    Layout layout = layout_of({
        output("west", {800, 600}, Equirectangular{{-60, 20, -40, 40}}),
        output("east", {1000, 600}, Equirectangular{{0, 100, -40, 40}}),
        output("above", {1000, 600}, Equirectangular{{0, 100, 40, 80}}),
    });
    std::vector<Coverage> all = coverages(layout);
    EXPECT_NEAR(shared_part(all[0], all[1]), 20. / 80, 1e-12); // edges lie between cells, so that the count is exact
    EXPECT_NEAR(shared_part(all[1], all[0]), 20. / 100, 1e-12);
    EXPECT_EQ(shared_part(all[1], all[2]), 0);
    EXPECT_EQ(overlap_lines(layout, all), std::vector<std::string>{"west and east: 25 % of west, 20 % of east"});
    // The two eyes of an output do not overlap each other. Where both eyes see the same, one line says so.
    for (Output& output : layout.outputs)
        output.packing = Packing::side_by_side_half;
    all = coverages(layout);
    ASSERT_EQ(all.size(), 6u);
    EXPECT_EQ(overlap_lines(layout, all), std::vector<std::string>{"west and east, both eyes: 25 % of west, 20 % of east"});
    EXPECT_EQ(floor_plan_rows(layout, all).size(), 3u);
    layout.outputs[0].viewports[0].eye = Eye::left;
    layout.outputs[1].viewports[0].eye = Eye::right;
    EXPECT_TRUE(overlap_lines(layout, coverages(layout)).empty());
}

TEST(CoverageTest, ASightFunctionReplacesAWarpFile)
{
    // The sight function replaces the projection: a picture around the back, a dome with its round rim, a pole.
    for (const Picture& picture : {Picture{Planar{70, {}, {170, 20, 10}}, {640, 480}}, Picture{Fisheye{200, 20}, {512, 512}},
             Picture{CubeFaces{CubeFaces::Arrangement::cross}, {800, 600}}}) {
        Layout layout = layout_of({output("a", picture.size, picture.projection), output("b", picture.size, Planar{60})});
        layout.outputs[1].viewports[0].warp = Warp{"b.csv"};
        int calls = 0;
        const std::vector<Coverage> all = coverages(layout, [&](const Output& output, const Viewport&, glm::dvec2 pixel) {
            EXPECT_EQ(output.name, "b"); // output a has a projection of its own
            ++calls;
            return direction(picture, pixel);
        });
        EXPECT_GT(calls, 1000);
        // A mesh of 256 steps loses up to a step at a rim or between faces.
        EXPECT_NEAR(all[1].share / all[0].share, 1, 0.02);
        EXPECT_GT(shared_part(all[1], all[0]), 0.995);
        EXPECT_GT(shared_part(all[0], all[1]), 0.98);
        EXPECT_NEAR(all[1].middle / all[0].middle, 1, 1e-3);
        EXPECT_NEAR(all[1].most / all[0].most, 1, 0.02);
    }
}

TEST(CoverageTest, EmptyAndTinyViewsAreNamedInTheTable)
{
    Layout layout = layout_of({output("behind", {100, 100}, Wall{{-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}}),
        output("narrow", {100, 100}, Planar{0.1, {}, {40, 20, 0}})});
    const std::vector<Coverage> all = coverages(layout);
    EXPECT_EQ(all[0].share, 0);
    EXPECT_FALSE(all[0].looks);
    EXPECT_EQ(all[0].most, 0);
    EXPECT_TRUE(all[0].outlines.empty());
    EXPECT_EQ(shared_part(all[0], all[1]), 0);
    EXPECT_NEAR(all[1].middle, 1000, 0.01);
    EXPECT_EQ(floor_plan_rows(layout, all)[0].spans, "nothing");
    EXPECT_EQ(floor_plan_rows(layout, all)[1].spans, "too little to measure");
    const pugi::xml_document document = parsed(layout);
    int marks = 0;
    each(document, "circle", [&](pugi::xml_node) { ++marks; });
    EXPECT_EQ(marks, 1);
}

TEST(PlanTableTest, TheTableDescribesEachProjection)
{
    Layout layout = layout_of({
        output("desk", {800, 600}, Planar{60, {}, {30, -15, 0}}),
        output("wall", {800, 600}, Wall{{-2, 0, -1.5}, {2, 0, -1.5}, {-2, 2.25, -1.5}}),
        output("dome", {1024, 1024}, Fisheye{180, 30}),
    });
    const std::vector<FloorPlanRow> rows = floor_plan_rows(layout, coverages(layout));
    EXPECT_EQ(rows[0].projection, "window, 60° high, turned 30° right, 15° down");
    EXPECT_EQ(rows[1].projection, "wall, 4.000 x 2.250 m");
    EXPECT_EQ(rows[1].spans, "azimuth −53.1° to 53.1°, elevation 0° to 56.3°");
    EXPECT_EQ(rows[2].projection, "fisheye (equidistant), 180° across, tilted 30°");
    EXPECT_EQ(rows[2].spans, "all around, elevation −30° to 90°");
    EXPECT_EQ(rows[2].sky, "50 %");
    EXPECT_EQ(rows[2].pixels, "1024 x 1024");
    EXPECT_EQ(rows[2].per_degree, "5.7 in the middle, 5.7 to 7.1"); // 1024 / 180, and sqrt(pi/2) times that at the rim
    EXPECT_EQ(short_number(-0.04), "0");
    EXPECT_EQ(short_number(-12.35), "−12.4");
}

TEST(PlanDrawingTest, EveryDrawingParsesAndKeepsToItsPage)
{
    for (const Layout& layout : {cave(), projectors(), headset(), mirror_dome()}) {
        const pugi::xml_document document = parsed(layout);
        const pugi::xml_node svg = document.child("svg");
        const double width = svg.attribute("width").as_double(), height = svg.attribute("height").as_double();
        ASSERT_GT(width, 1000);
        ASSERT_GT(height, 500);
        struct TheTableDescribesEachProjection {
            glm::dvec2 from, to;
            std::string text;
        };
        std::vector<TheTableDescribesEachProjection> all;
        each(document, "text", [&](pugi::xml_node node) {
            const double size = node.attribute("font-size").as_double();
            EXPECT_GE(size, 11); // readable
            // A letter is at least half its height wide: no sans-serif font sets words narrower.
            const std::string text = node.text().get(), anchor = node.attribute("text-anchor").value();
            const double letters
                = double(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
            const double long_ = letters * size * 0.5, x = node.attribute("x").as_double(),
                         y = node.attribute("y").as_double();
            const double from = x - (anchor == "middle" ? long_ / 2 : anchor == "end" ? long_ : 0);
            all.push_back({{from, y - size * 0.75}, {from + long_, y}, text});
        });
        EXPECT_GT(all.size(), 30u);
        for (std::size_t i = 0; i < all.size(); ++i) {
            EXPECT_TRUE(all[i].from.x >= 0 && all[i].from.y >= 0 && all[i].to.x <= width && all[i].to.y <= height)
                << all[i].text;
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_FALSE(all[i].from.x < all[j].to.x && all[j].from.x < all[i].to.x && all[i].from.y < all[j].to.y
                    && all[j].from.y < all[i].to.y)
                    << all[i].text << " lies on " << all[j].text;
        }
        each(document, "rect", [&](pugi::xml_node node) {
            EXPECT_GE(node.attribute("x").as_double(), 0);
            EXPECT_LE(node.attribute("x").as_double() + node.attribute("width").as_double(), width);
            EXPECT_LE(node.attribute("y").as_double() + node.attribute("height").as_double(), height);
        });
    }
}

TEST(PlanDrawingTest, OneRegionForEachViewportAndEye)
{
    EXPECT_EQ(count(parsed(projectors()), "path", "shown"), 5);
    EXPECT_EQ(count(parsed(headset()), "path", "shown"), 4); // a lens and the desk, for each eye
    EXPECT_EQ(count(parsed(cave()), "path", "shown"), 4);
    EXPECT_EQ(count(parsed(cave()), "path", "wall"), 4);
    EXPECT_EQ(count(parsed(projectors()), "path", "wall"), 0);
    std::vector<std::string> in_room;
    const pugi::xml_document document = parsed(mirror_dome());
    each(document, "text", [&](pugi::xml_node node) { in_room.push_back(node.text().get()); });
    EXPECT_EQ(std::count(in_room.begin(), in_room.end(), "projector"), 1);
    EXPECT_EQ(std::count(in_room.begin(), in_room.end(), "eye at height −0.300 m"), 1);
}

TEST(PlanDrawingTest, TheMapPlacesDegreesLinearly)
{
    // The map's width is 360 degrees; its frame is the clip path's rectangle.
    const Layout layout = layout_of({output("part", {800, 600}, Equirectangular{{-90, 45, -30, 60}})});
    const pugi::xml_document document = parsed(layout);
    const pugi::xml_node map = document.child("svg").child("clipPath").child("rect");
    const double left = map.attribute("x").as_double(), top = map.attribute("y").as_double(),
                 across = map.attribute("width").as_double();
    EXPECT_NEAR(map.attribute("height").as_double(), across / 2, 0.1);
    std::string path;
    each(document, "path", [&](pugi::xml_node node) {
        if (std::string(node.attribute("class").value()) == "shown")
            path = node.attribute("d").value();
    });
    for (char& c : path)
        if (std::isalpha((unsigned char)(c)))
            c = ' ';
    double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9, x, y;
    int used = 0;
    for (const char* at = path.c_str(); std::sscanf(at, "%lf %lf%n", &x, &y, &used) == 2; at += used) {
        low_x = std::min(low_x, x), high_x = std::max(high_x, x);
        low_y = std::min(low_y, y), high_y = std::max(high_y, y);
    }
    const double degree
        = across / 360; // the tolerance is a hundredth of a degree for the outline and another for the digits
    EXPECT_NEAR((low_x - left) / degree - 180, -90, 0.02);
    EXPECT_NEAR((high_x - left) / degree - 180, 45, 0.02);
    EXPECT_NEAR(90 - (high_y - top) / degree, -30, 0.02);
    EXPECT_NEAR(90 - (low_y - top) / degree, 60, 0.02);
}

TEST(PlanDrawingTest, NamesAreEscaped)
{
    Layout layout = layout_of({output("desk", {800, 600}, Planar{60})});
    layout.name = "a <b> & \"c\"\x01";
    layout.outputs[0].viewports[0].warp = Warp{"bent<1>&.csv"};
    const pugi::xml_document document = parsed(layout);
    EXPECT_STREQ(document.child("svg").child("text").text().get(), "a <b> & \"c\"?");
    EXPECT_NE(draw_floor_plan(layout, coverages(layout)).find("bent&lt;1&gt;&amp;.csv"), std::string::npos);
    const Layout empty;
    EXPECT_TRUE(parsed(empty).child("svg")); // a layout without outputs gives a page too
}

} // namespace floor_plan_test
