#include "config/json/describe.h"
#include "config/model/layout_reader.h"
#include "tests/support/files.h"

namespace starbow {

namespace describe_test {

struct Inner {
    double angle_deg = 10;
    std::optional<int> count;
};
struct Toy {
    double number = 2;
    glm::dvec3 place{1, 2, 3};
    std::vector<double> list;
    Inner inner;
    std::optional<Inner> other;
    bool low = false, high = false;
    int kept = 7;
};
struct Short {
    double one = 0, two = 0;
};

} // namespace describe_test

template <>
inline constexpr auto description<describe_test::Inner> = describe<describe_test::Inner>("inner", "An object inside.",
    field("angle_deg", Number{{-90, 90}, 0.5, "angle"}, "An angle, degrees.", &describe_test::Inner::angle_deg),
    field("count", Whole{1, 9}, "A count.", &describe_test::Inner::count));
inline const std::vector<std::pair<std::string_view, bool>> off_and_on{{"off", false}, {"on", true}};
template <>
inline constexpr auto description<describe_test::Toy> = describe_file<describe_test::Toy>("toy", "A toy.",
    needed("number", Number{{0, 5, true}}, "A number.", &describe_test::Toy::number),
    field("place", Numbers<3>{{-9, 9}}, "A place.", &describe_test::Toy::place),
    field("list", List{Number{{0, 1}}, 1, 3, "numbers"}, "A list.", &describe_test::Toy::list),
    field("inner", Object<describe_test::Inner>{}, "", &describe_test::Toy::inner),
    field("other", Object<describe_test::Inner>{}, "", &describe_test::Toy::other),
    field("low", Named{&off_and_on}, "A choice.", &describe_test::Toy::low),
    field("high", Flag{}, "A flag.", &describe_test::Toy::high), not_in_file(&describe_test::Toy::kept));
template <>
inline constexpr auto description<describe_test::Short> = describe<describe_test::Short>(
    "short", "", field("one", Number{{0, 1}}, "", &describe_test::Short::one));

namespace describe_test {

using namespace testing;

static_assert(is_complete<Inner>() && is_complete<Toy>());
static_assert(!is_complete<Short>(), "a forgotten member does not compile");

namespace {

Toy toy(const std::string& text)
{
    const Document document = parse_document("toy.json", text);
    return read<Toy>(root(document));
}
std::string key(const Toy& toy)
{
    std::string text;
    described::add_to_key(text, toy);
    return text;
}

const char* const whole = R"({ "$schema": "x", "number": 3, "place": [4, 5, 6], "list": [0.25, 1],
    "inner": { "angle_deg": -3, "count": 2 }, "other": {}, "low": "on", "high": true })";

} // namespace

TEST(DescribeTest, EveryMemberIsReadAndWrittenAgain)
{
    const Toy read = toy(whole);
    EXPECT_EQ(read.number, 3);
    EXPECT_EQ(read.place, glm::dvec3(4, 5, 6));
    EXPECT_EQ(read.list, (std::vector<double>{0.25, 1}));
    EXPECT_EQ(read.inner.angle_deg, -3);
    EXPECT_EQ(read.inner.count, 2);
    ASSERT_TRUE(read.other);
    EXPECT_EQ(read.other->angle_deg, 10);
    EXPECT_TRUE(read.low && read.high);
    EXPECT_EQ(on_one_line(written(read)),
        R"({ "number": 3, "place": [4, 5, 6], "list": [0.25, 1], "inner": { "angle_deg": -3, "count": 2 }, "other": { "angle_deg": 10 }, "low": "on", "high": true })");
    EXPECT_EQ(key(toy(written(read).dump())), key(read));
    EXPECT_EQ(on_one_line(written_briefly(Toy{})), R"({ "number": 2 })") << "what must be there is written";
}

TEST(DescribeTest, WrongValuesAreRefusedAtTheirPlaces)
{
    for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{
             {"{}", "lacks \"number\""},
             {R"({ "number": 0 })", "/number: 0 is too small; a number above 0 up to 5 is right"},
             {R"({ "number": 1, "numer": 1 })", "/numer: 1 stands under an unknown name; \"number\""},
             {R"({ "number": 1, "inner": { "count": 2.5 } })", "/inner/count: 2.5 is not a whole number"},
             {R"({ "number": 1, "list": [] })", "/list: [] has length 0; a list of 1 to 3 numbers in [ ] is right"},
             {R"({ "number": 1, "low": "no" })", "/low: \"no\" is not known here; \"off\" or \"on\" is right"},
             {R"({ "number": 1, "kept": 1 })", "/kept: 1 stands under an unknown name"},
             {R"({ "number": 1, "$schema": 1 })", "/$schema: 1 is not a text"},
         })
        EXPECT_NE(complaint([&, &text = text] { toy(text); }).find(says), std::string::npos)
            << complaint([&, &text = text] { toy(text); });
}

TEST(DescribeTest, EveryMemberOfTheFileChangesTheKey)
{
    const std::string usual = key(Toy{});
    std::vector<Toy> changed(10);
    changed[0].number = 2 + 1e-15, changed[1].place.z = 3.5, changed[2].list = {1}, changed[3].inner.angle_deg = 11;
    changed[4].inner.count = 0, changed[5].other.emplace(), changed[6].low = true, changed[7].high = true;
    changed[8].list = {1, 1}, changed[9].other = Inner{.angle_deg = 3};
    std::set<std::string> keys{usual};
    for (const Toy& one : changed)
        EXPECT_TRUE(keys.insert(key(one)).second) << key(one);
    EXPECT_EQ(key(Toy{.kept = 8}), usual) << "what the file does not hold";
}

TEST(DescribeTest, TheSchemaHasNamesLimitsAndUsualValues)
{
    const Json schema = file_schema<Toy>();
    const Json& members = schema["properties"];
    EXPECT_EQ(schema["required"], Json::array({"number"}));
    EXPECT_EQ(members["number"]["exclusiveMinimum"], 0);
    EXPECT_FALSE(members["number"].contains("default")) << "it must be there";
    EXPECT_EQ(members["place"]["default"], Json::array({1, 2, 3}));
    EXPECT_FALSE(members["list"].contains("default"));
    EXPECT_EQ(members["low"]["enum"], Json::array({"off", "on"}));
    EXPECT_EQ(members["other"]["$ref"], "#/definitions/inner");
    EXPECT_EQ(schema["definitions"]["inner"]["properties"]["angle_deg"]["default"], 10);
    EXPECT_FALSE(members.contains("kept"));
    EXPECT_EQ(members.size(), 8u);
}

TEST(DescribeTest, NumbersWithAStepAreTurnedInTheObjectsThatAreThere)
{
    Toy one;
    std::vector<described::Turnable> all;
    described::add_turnables(all, "/toy", one);
    ASSERT_EQ(all.size(), 1u) << "there is no other";
    EXPECT_EQ(all[0].pointer, "/toy/inner/angle_deg");
    *all[0].number = 20;
    EXPECT_EQ(one.inner.angle_deg, 20);
    EXPECT_EQ(all[0].range.high, 90);
}

TEST(DescribeTest, ProjectionsWithOtherNumbersHaveOtherKeys)
{
    std::set<std::string> keys;
    const Sides sides{-1, 2, -3, 4};
    Lens lens;
    lens.colours[2].k[3] = 0.125;
    for (const Projection& one : std::vector<Projection>{Planar{}, Planar{.fov_y_deg = 61}, Planar{.sides = sides},
             Planar{.sides = Sides{-1, 2, -3, 5}}, Planar{.turn = {.roll_deg = 1}}, Wall{}, Fisheye{},
             Fisheye{.mapping = FisheyeMapping::equisolid}, Cylinder{}, Equirectangular{}, CubeFaces{}, SphericalMirror{},
             SphericalMirror{.projector = {.turn = {.yaw_deg = 2}}}, Lens{}, lens})
        EXPECT_TRUE(keys.insert(projection_key(one)).second) << projection_key(one);
}

} // namespace describe_test
} // namespace starbow
