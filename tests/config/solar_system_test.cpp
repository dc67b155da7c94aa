#include "config/model/scene_file.h"
#include "config/model/solar_system.h"
#include "tests/support/files.h"

namespace solar_system_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

const std::filesystem::path folder = source_dir() / "scenes/solar-system";

/// Writes the small files that a file of globes names, with the shipped bodies.
void write_companions()
{
    write_text("bodies.json", read_text(folder / "bodies.json"));
    write_text("spectra.json",
        R"({ "kinds": { "soil": { "reflectance": [[300, 0.1], [2500, 0.4]] }, "water": { "reflectance": [[300, 0], [2500, 0]] } },
        "lights": { "glow": { "relative_power": [[500, 1], [600, 1]] } }, "sun_limb_darkening": { "rows": [[400, 1, 0, 0, 0, 0, 0]], "infrared_u": [] } })");
}

std::string globes(const std::string& list)
{
    return R"({ "bodies": "bodies.json", "spectra": "spectra.json", "globes": [)" + list + "] }";
}
std::string beside_sun(const std::string& globe)
{
    return globes(R"({ "body": "Sun", "scattering": "sun" }, { )" + globe + " }");
}

void load(const std::filesystem::path& file) { (void)load_solar_system(file); }

} // namespace

TEST(SolarSystemTest, TheShippedFileIsWhole)
{
    const SolarSystem system = load_solar_system(folder / "globes.json");
    ASSERT_EQ(system.globes.size(), 10u);
    EXPECT_EQ(system.globes.front().scattering, Scattering::sun);
    EXPECT_TRUE(system.globes[3].air.has_value()) << "the Earth";
    EXPECT_TRUE(system.globes[7].ring.has_value()) << "Saturn";
    EXPECT_EQ(system.globes[7].ring->profile.size(), 512u);
    for (const NamedTable& kind : system.kinds)
        EXPECT_TRUE(kind.points.front().first <= 300 && kind.points.back().first >= 2500) << kind.name;
}

TEST(SolarSystemTest, NeptunesLibrationHasTheWorkingGroupsRate)
{
    const SolarSystem system = load_solar_system(folder / "globes.json");
    const auto neptune = std::ranges::find(system.globes, "Neptune", &Globe::name);
    ASSERT_NE(neptune, system.globes.end());
    ASSERT_EQ(neptune->rotation.librations.size(), 1u);
    const Rotation::Libration& one = neptune->rotation.librations[0];
    EXPECT_EQ(one.angle_deg, 357.85);
    EXPECT_NEAR(one.deg_per_day * 36525, 52.316, 1e-9) << "a Julian century";
    EXPECT_EQ(one.ascension, 0.7);
    EXPECT_EQ(one.declination, -0.51);
    EXPECT_EQ(one.meridian, -0.48);
}

TEST(SolarSystemTest, WrongFilesAreRefused)
{
    write_companions();
    expect_wrong(load,
        {{beside_sun(R"("body": "Vulcan", "scattering": "dusty", "kinds": [null, null, null, "soil"])"), "/globes/1/body",
             "\"Vulcan\"", "has no size"},
            {beside_sun(R"("body": "Sun", "scattering": "sun")"), "/globes/1/body", "\"Sun\"", "each globe once"},
            {beside_sun(R"("body": "Mars", "scattering": "shiny", "kinds": [null, null, null, "soil"])"),
                "/globes/1/scattering", "\"shiny\"", "dusty"},
            {beside_sun(R"("body": "Mars", "scattering": "dusty", "kinds": [null, null, null, "rust"])"),
                "/globes/1/kinds/3", "\"rust\"", "is not a kind"},
            {beside_sun(
                 R"("body": "Earth", "scattering": "cloudy", "map": "e.png", "kinds": ["soil", null, null, "water"], "air": { "scale_height_km": 8, "clouds": "c.jpg", "water": "w.png", "lamps": "l.png", "brightest_lamps": 0 })"),
                "/globes/1/air", "{", "needs the kind \"cloud\""},
            {beside_sun(
                 R"("body": "Earth", "scattering": "cloudy", "map": "e.png", "kinds": ["soil", null, null, "water"], "air": { "scale_height_km": 8, "clouds": "c.jpg", "water": "w.png", "lamps": "l.png", "brightest_lamps": 0, "lamp": "gas" })"),
                "/globes/1/air/lamp", "\"gas\"", "is not a light"},
            {beside_sun(
                 R"("body": "Earth", "scattering": "cloudy", "map": "e.png", "kinds": ["soil", null, null, "water"], "air": { "scale_height_km": 8, "clouds": "c.jpg", "water": "w.png", "lamps": "l.png", "brightest_lamps": 0, "glows": [{ "light": "glow", "from_km": 100, "to_km": 90, "zenith": 1e-9 }] })"),
                "/globes/1/air/glows/0/to_km", "90", "is not above"},
            {beside_sun(
                 R"("body": "Earth", "scattering": "cloudy", "map": "e.png", "kinds": ["soil", null, null, "water"], "air": { "scale_height_km": 8, "clouds": "c.jpg", "water": "w.png", "lamps": "l.png", "brightest_lamps": 0, "glows": [{ "light": "gas", "from_km": 90, "to_km": 100, "zenith": 1e-9 }] })"),
                "/globes/1/air/glows/0/light", "\"gas\"", "is not a light"},
            {beside_sun(
                 R"("body": "Earth", "scattering": "cloudy", "map": "e.png", "kinds": ["soil", null, null, "water"], "air": { "scale_height_km": 8, "clouds": "c.jpg", "water": "w.png", "lamps": "l.png", "brightest_lamps": 0, "glows": [{ "light": "glow", "from_km": 90, "to_km": 100, "zenith": 2 }] })"),
                "/globes/1/air/glows/0/zenith", "2", "from 0 to 1"},
            {beside_sun(
                 R"("body": "Saturn", "scattering": "cloudy", "kinds": [null, null, null, "soil"], "ring": "ring.json")"),
                "/globes/1/ring", "\"ring.json\"", "needs the kind \"rings\""}});
}

TEST(SolarSystemTest, WrongListsAreRefused)
{
    write_companions();
    const auto says = [](const std::string& text) { return complaint([&] { load(write_text("wrong.json", text)); }); };
    EXPECT_NE(says(globes("")).find("globes"), std::string::npos);
    EXPECT_NE(says(beside_sun(R"("body": "Mars", "scattering": "dusty", "kinds": [null, "soil"])")).find("/globes/1/kinds"),
        std::string::npos);
    EXPECT_NE(says(beside_sun(R"("body": "Moon", "scattering": "dusty", "kinds": [null, null, null, "soil"])"))
                  .find("without the Earth"),
        std::string::npos);
    EXPECT_NE(says(globes(R"({ "body": "Mars", "scattering": "dusty", "kinds": [null, null, null, "soil"] })"))
                  .find("the Sun first"),
        std::string::npos);
}

TEST(SolarSystemTest, MistypedFilesLoadOrAreRefused)
{
    write_companions();
    const std::string good = beside_sun(
        R"("body": "Mars", "scattering": "dusty", "map": "m.png", "map_scale": 1.5, "kinds": ["soil", null, null, "water"], "dimming": [0.016, 0])");
    expect_survives(load, {good, read_text(folder / "globes.json")});
    const auto file = write_text("globes.json",
        globes(
            R"({ "body": "Sun", "scattering": "sun" }, { "body": "Neptune", "scattering": "cloudy", "kinds": [null, null, null, "soil"] })"));
    const std::string bodies = read_text(folder / "bodies.json"), spectra = read_text(scratch("spectra.json"));
    const int count = std::max(fuzz_count() / 50, 20); // the file is large
    expect_survives(
        [&](const std::filesystem::path& mutated) {
            write_text("bodies.json", read_text(mutated));
            (void)load_solar_system(file);
        },
        {bodies}, count);
    write_text("bodies.json", bodies);
    expect_survives(
        [&](const std::filesystem::path& mutated) {
            write_text("spectra.json", read_text(mutated));
            (void)load_solar_system(file);
        },
        {spectra}, std::max(count, 200));
}

TEST(SolarSystemTest, AScenesDateIsReadAndWrongOnesAreRefused)
{
    const auto scene = [](const std::string& date, const std::string& more = "") {
        return R"({ "gltf": "a.glb", "globes": { "file": "g.json", "date": ")" + date + R"(", "origin": "Earth" })" + more
            + " }";
    };
    const SceneFile read = load_scene_file(write_text("date.json", scene("2000-01-02T18:30Z")));
    EXPECT_NEAR(read.globes.value().days, 1.2708333333, 1e-9);
    std::vector<Wrong> wrong;
    for (const char* date : {"2026-02-30T00:00Z", "2026-08-12 17:46Z", "1700-01-01T00:00Z", "2026-08-12T24:00Z", "tomorrow",
             "2026-08-12T17:46Zx"})
        wrong.push_back({scene(date), "/globes/date", '"' + std::string(date) + '"', "is not a date"});
    wrong.push_back(
        {scene("2026-08-12T17:46Z",
             R"(, "bodies": [{ "name": "b", "nodes": ["n"], "at": { "time": 0, "position": [0, 0, 0] }, "velocity": { "direction": [1, 0, 0], "beta": 0.1 } }])"),
            "/globes", "{", "other things move"});
    expect_wrong([](const std::filesystem::path& file) { (void)load_scene_file(file); }, wrong);
}

} // namespace solar_system_test
