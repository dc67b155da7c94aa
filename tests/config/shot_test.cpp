#include "config/model/shot.h"
#include "tests/support/files.h"
#include <cmath>

namespace shot_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

Shot shot(const std::string& members)
{
    return load_shot(write_text("shot.json", R"({ "scene": "avenue")" + (members.empty() ? "" : ", " + members) + " }"));
}
std::string velocity(const std::string& speed) { return R"("velocity": { "direction": [0, 0, -2], )" + speed + " }"; }
std::string with(const std::string& members) { return R"({ "scene": "avenue", )" + members + " }"; }
std::string flying(const std::string& members) { return with(R"("velocity": { "direction": [1, 0, 0], )" + members + " }"); }

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance)
{
    EXPECT_NEAR(glm::distance(a, b), 0, tolerance) << a.x << " " << a.y << " " << a.z;
}

} // namespace

TEST(ShotTest, MembersHaveTheirDefaults)
{
    const Shot s = shot("");
    EXPECT_EQ(s.scene, "avenue");
    EXPECT_EQ(s.time, 0);
    EXPECT_EQ(s.position, glm::dvec3(0));
    EXPECT_EQ(s.u, glm::dvec3(0));
    expect_near(s.ship_from_cockpit * glm::dvec3(0, 0, -1), {0, 0, -1}, 1e-15);
    expect_near(s.ship_from_cockpit * glm::dvec3(0, 1, 0), {0, 1, 0}, 1e-15);
    EXPECT_TRUE(s.effects[Effect::aberration] && s.effects[Effect::doppler] && s.effects[Effect::headlight]
        && !s.effects[Effect::false_colours]);
    EXPECT_EQ(s.exposure_ev, 0);
}

TEST(ShotTest, EveryMemberIsRead)
{
    const Shot s = shot(R"("time": -5, "position": [1, 2, 3], "look": [2, 0, 0], "up": [5, 1, 0], "exposure_ev": -3.5,
        "effects": { "aberration": false, "doppler": false, "headlight": false, "false_colours": true })");
    EXPECT_EQ(s.time, -5);
    EXPECT_EQ(s.position, glm::dvec3(1, 2, 3));
    expect_near(s.ship_from_cockpit * glm::dvec3(0, 0, -1), {1, 0, 0}, 1e-15);
    expect_near(s.ship_from_cockpit * glm::dvec3(0, 1, 0), {0, 1, 0}, 1e-15);
    expect_near(s.ship_from_cockpit * glm::dvec3(1, 0, 0), {0, 0, 1}, 1e-15);
    EXPECT_FALSE(s.effects[Effect::aberration] || s.effects[Effect::doppler] || s.effects[Effect::headlight]);
    EXPECT_TRUE(s.effects[Effect::false_colours]);
    EXPECT_EQ(s.exposure_ev, -3.5);
}

TEST(ShotTest, SpeedsBecomeProperVelocity)
{
    expect_near(shot(velocity(R"("gamma": 4)")).u, {0, 0, -std::sqrt(15)}, 1e-14);
    expect_near(shot(velocity(R"("gamma": 1)")).u, {0, 0, 0}, 0);
    expect_near(shot(velocity(R"("gamma": 1e9)")).u, {0, 0, -1e9}, 1e-6);
    expect_near(shot(velocity(R"("beta": 0.6)")).u, {0, 0, -0.75}, 1e-15);
    expect_near(shot(velocity(R"("beta": 0)")).u, {0, 0, 0}, 0);
    expect_near(shot(velocity(R"("rapidity": 1)")).u, {0, 0, -1.1752011936438014}, 1e-15);
    // For gamma slightly above 1, sqrt(gamma^2 - 1) would lose half of its digits: u^2 = 2e-12 + 1e-24.
    EXPECT_NEAR(glm::length(shot(velocity(R"("gamma": 1.000000000001)")).u), 1.41421356237e-6, 1e-10);
}

TEST(ShotTest, DirectionsMayHaveAnyLength)
{
    const Shot s = shot(R"("look": [1e-200, 0, -1e-200], "up": [0, 1e299, 0],
        "velocity": { "direction": [3e-290, 4e-290, 0], "beta": 0.6 })");
    expect_near(s.u, {0.45, 0.6, 0}, 1e-15);
    expect_near(s.ship_from_cockpit * glm::dvec3(0, 0, -1), glm::normalize(glm::dvec3(1, 0, -1)), 1e-15);
}

TEST(ShotTest, OrientationIsARotationForEveryLook)
{
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 look(std::sin(i * 1.7), std::cos(i * 0.9) * 2, std::sin(i * 0.3 + 1));
        const glm::dvec3 up(std::cos(i * 0.7), std::sin(i * 1.1), 0.5);
        const glm::dquat q = orientation(look, up);
        EXPECT_NEAR(glm::length(q), 1, 1e-15);
        expect_near(q * glm::dvec3(0, 0, -1), glm::normalize(look), 1e-14);
        const glm::dvec3 cockpit_up = q * glm::dvec3(0, 1, 0);
        EXPECT_NEAR(glm::dot(cockpit_up, glm::cross(look, up)), 0, 1e-14); // in the plane of look and up
        EXPECT_GT(glm::dot(cockpit_up, up), 0);
        expect_near(q * glm::dvec3(1, 0, 0), glm::cross(glm::normalize(look), cockpit_up), 1e-14);
    }
}

TEST(ShotTest, ShippedShotsLoad)
{
    ASSERT_GE(shipped("config/shots").size(), 7u);
    for (const auto& file : shipped("config/shots")) {
        SCOPED_TRACE(file);
        EXPECT_FALSE(load_shot(file).scene.empty());
    }
    const auto folder = source_dir() / "config/shots";
    const Shot fast = load_shot(folder / "avenue-gamma4.json");
    EXPECT_NEAR(std::sqrt(1 + glm::dot(fast.u, fast.u)), 4, 1e-14);
    EXPECT_FALSE(fast.effects[Effect::doppler] || fast.effects[Effect::headlight]);
    const Shot rainbow = load_shot(folder / "rainbow.json");
    EXPECT_NEAR(glm::dot(rainbow.u, rainbow.ship_from_cockpit * glm::dvec3(0, 0, -1)), 0, 1e-15); // across the motion
    EXPECT_NEAR(glm::length(rainbow.u), 1 / std::sqrt(3), 1e-15);
}

TEST(ShotTest, WrongShotsAreRefused)
{
    expect_wrong(load_shot,
        {
            {R"({ "scene": "" })", "/scene", "\"\"", "is empty"},
            {with(R"("postion": [0, 0, 0])"), "/postion", "[0,0,0]", "unknown name; \"position\""},
            {with(R"("time": 1e999)"), "/time", "1e999", "is too large for a number"},
            {with(R"("position": 5)"), "/position", "5", "is not a list; a list of 3 numbers"},
            {with(R"("position": [0, 0, 0, 0])"), "/position", "[0,0,0,0]", "has length 4; "},
            {with(R"("position": [0, 0, -1e400])"), "/position/2", "-1e400", "is too large for a number"},
            {with(R"("look": [0, 0, 0])"), "/look", "[0,0,0]", "points nowhere"},
            {with(R"("up": [0, 0.0, -0.0])"), "/up", "[0,0.0,-0.0]", "points nowhere"},
            {with(R"("up": [0, 0, 3])"), "/up", "[0,0,3]", "is parallel to \"look\""},
            {with(R"("look": [0, -1, 0])"), "/look", "[0,-1,0]", "is parallel to \"up\""},
            {with(R"("look": [1, 1, 1], "up": [2, 2, 2])"), "/up", "[2,2,2]", "is parallel to \"look\""},
            {with(R"("look": [0, 1])"), "/look", "[0,1]", "has length 2; "},
            {with(R"("velocity": { "direction": [1, 0, 0] })"), "/velocity", "{\"direction\":[1,0,0]}", "has no speed"},
            {with(R"("velocity": { "direction": [0, 0, 0], "gamma": 2 })"), "/velocity/direction", "[0,0,0]",
                "points nowhere"},
            {flying(R"("gamma": 2, "beta": 0.5)"), "/velocity", R"({"beta":0.5,"direction":[1,0,0],"gamma":2})",
                "has more than one speed; exactly one of"},
            {flying(R"("gamma": 0.5)"), "/velocity/gamma", "0.5", "is less than gamma ever is"},
            {flying(R"("gamma": -4)"), "/velocity/gamma", "-4", "is less than gamma ever is"},
            {flying(R"("gamma": 1.1e9)"), "/velocity/gamma", "1100000000.0", "beyond any flight here"},
            {flying(R"("gamma": 1e999)"), "/velocity/gamma", "1e999", "is too large for a number"},
            {flying(R"("beta": 1)"), "/velocity/beta", "1", "nothing reaches the speed of light; a beta from 0 to below 1"},
            {flying(R"("beta": 1.5)"), "/velocity/beta", "1.5", "nothing reaches the speed of light"},
            {flying(R"("beta": 0.99999999999999999999)"), "/velocity/beta", "1.0", "nothing reaches the speed of light"},
            {flying(R"("beta": -0.5)"), "/velocity/beta", "-0.5", "is negative"},
        });
}

TEST(ShotTest, MutatedShotsLoadOrAreRefused)
{
    std::vector<std::string> seeds;
    for (const auto& file : shipped("config/shots"))
        seeds.push_back(read_text(file));
    const auto load = [](const std::filesystem::path& file) {
        const Shot s = load_shot(file);
        ASSERT_TRUE(std::isfinite(glm::dot(s.u, s.u)) && std::isfinite(glm::dot(s.position, s.position)));
        ASSERT_NEAR(glm::length(s.ship_from_cockpit), 1, 1e-12);
    };
    expect_survives(load, seeds);
}

} // namespace shot_test
