// The shipped scenes with moving bodies: their programs write the committed files, the scenes load, and clocks and doors
// follow closed forms. The readings are those in the shots' comments, from light cones solved for each clock independently.
#include "runtime/world/clock.h"
#include "runtime/world/eye_event.h"
#include "runtime/world/instances.h"
#include "runtime/world/worldline.h"
#include "tests/support/dial.h"
#include "tests/support/files.h"
#include <array>
#include <cmath>
#include <map>

namespace moving_scenes_test {

using namespace starbow;
using namespace starbow::testing;
using glm::dvec3;

namespace {

const std::vector<std::string> scenes = {"train", "twins", "light-clock", "alice-and-bob", "gamow"};

SceneFile scene_of(const std::string& name) { return load_scene_file(source_dir() / "config/scenes" / (name + ".json")); }
Shot shipped_shot(const std::string& name) { return load_shot(source_dir() / "config/shots" / (name + ".json")); }

const World& world_of(std::string_view name)
{
    static std::map<std::string, World> worlds;
    auto [at, made] = worlds.try_emplace(std::string(name));
    if (made) {
        const SceneFile scene = scene_of(at->first);
        at->second = load_world(scene);
        place_bodies(at->second, scene);
        sort_instances(at->second);
    }
    return at->second;
}

/// An object with a time entry.
struct TimedObject {
    dvec3 place; ///< from the eye, in the object's rest frame, along the world's axes
    bool there; ///< the object existed when the light of its middle left
    std::string figures;
};

/// All objects of a material that face `way`, or any way if that is 0, sorted by x from left to right.
std::vector<TimedObject> seen(const Shot& shot, const std::string& material, const dvec3& way)
{
    const World& world = world_of(shot.scene);
    const double spt = scene_of(shot.scene).seconds_per_time_unit();
    std::vector<TimedObject> out;
    for (int frame = 0; frame < int(world.frames.size()); ++frame) {
        const Shot eye = in_frame(world.frames[std::size_t(frame)], shot);
        const auto entries = time_entries(world, {frame, eye.position, eye.time}, spt);
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const Instance& instance = world.instances[instances_of(world, frame).first + i];
            const int index = world.primitives[instance.primitive].material;
            const dvec3 facing(instance.frame_from_local[2]);
            if (world.materials[std::size_t(index)].name == material
                && (way == dvec3(0) || glm::dot(facing, way) > 0.9 * glm::length(facing)))
                out.push_back(
                    {dvec3(entries[i].middle), entries[i].there.x <= 0 && entries[i].there.y > 0, dial_text(entries[i])});
        }
    }
    std::sort(out.begin(), out.end(), [](const TimedObject& a, const TimedObject& b) { return a.place.x < b.place.x; });
    return out;
}

std::vector<std::string> figures_of(const std::string& shot, const std::string& material, const dvec3& way = {0, 0, 1})
{
    std::vector<std::string> out;
    for (const TimedObject& s : seen(shipped_shot(shot), material, way))
        if (s.there)
            out.push_back(s.figures);
    return out;
}

using Figures = std::vector<std::string>;

/// True for the western and for the eastern door, if its lamp or its planks of that material are seen.
std::array<bool, 2> seen_at_doors(const std::string& shot, const std::string& material)
{
    std::array<bool, 2> out{};
    const double x = shipped_shot(shot).position.x;
    for (const TimedObject& s : seen(shipped_shot(shot), material, {}))
        out[s.place.x + x > 0] |= s.there;
    return out;
}

Event on(const Event& from, const dvec3& velocity, double time)
{
    return {time, from.position + velocity * (time - from.time)};
}

} // namespace

TEST(MovingScenesTest, ProgramsWriteTheCommittedBytes)
{
    for (const std::string& name : scenes)
        expect_made_by_its_program(name, 1'050'000);
    for (const std::string name : {"light-clock", "gamow"})
        EXPECT_TRUE(read_text(scratch(name + ".json")) == read_text(source_dir() / "config/scenes" / (name + ".json")))
            << "run scenes/" << name << "/make.py and commit what it writes";
}

TEST(MovingScenesTest, WorldsLoadWithoutAWarningAndEqualVelocitiesShareAFrame)
{
    const std::map<std::string, std::size_t> frames
        = {{"train", 2}, {"twins", 3}, {"light-clock", 2}, {"alice-and-bob", 2}, {"gamow", 3}};
    for (const auto& [name, count] : frames) {
        EXPECT_EQ(world_of(name).notes, std::vector<std::string>{}) << name;
        EXPECT_EQ(world_of(name).frames.size(), count) << name;
        const SceneFile scene = scene_of(name);
        EXPECT_TRUE(std::filesystem::equivalent(scene.gltf, source_dir() / "scenes" / name / (name + ".glb")));
    }
    EXPECT_EQ(scene_of("gamow").seconds_per_time_unit(), 0.2);
}

TEST(MovingScenesTest, ClocksShowTheReadingsInTheShotsComments)
{
    EXPECT_EQ(figures_of("train-tunnel", "train dial"), (Figures{"6.8", "-4.9"}));
    EXPECT_EQ(figures_of("train-tunnel", "tunnel dial"), (Figures{"-1.0", "-1.0"}));
    EXPECT_EQ(figures_of("train-far", "train dial"), (Figures{"6.5", "-4.9"}));
    EXPECT_EQ(figures_of("train-far", "tunnel dial"), (Figures{"-0.6", "-0.6"}));
    EXPECT_EQ(figures_of("train-aboard-first", "train dial"), (Figures{"-6.4", "-6.4"}));
    EXPECT_EQ(figures_of("train-aboard-first", "tunnel dial"), (Figures{"-9.9", "0.1"}));
    EXPECT_EQ(figures_of("train-aboard-long", "train dial"), (Figures{"0.1", "0.1"}));
    EXPECT_EQ(figures_of("train-aboard-long", "tunnel dial"), (Figures{"-6.3", "6.1"}));
    EXPECT_EQ(figures_of("train-aboard-second", "train dial"), (Figures{"13.6", "13.6"}));
    EXPECT_EQ(figures_of("train-aboard-second", "tunnel dial"), (Figures{"-0.3", "14.0"}));

    const std::string away = "traveller's dial", home = "home dial";
    for (auto [shot, traveller, stayed, way] :
        {std::tuple("twins-departure", "2.0", "5.9", 1), {"twins-turn", "6.0", "17.5", 1},
            {"twins-meeting", "12.5", "20.5", 1}, {"twins-out", "3.0", "1.0", -1}, {"twins-back", "9.5", "13.1", -1}}) {
        EXPECT_EQ(figures_of(shot, away, {0, 0, way}), Figures{traveller}) << shot;
        EXPECT_EQ(figures_of(shot, home, {0, 0, way}), Figures{stayed}) << shot;
    }

    EXPECT_EQ(figures_of("light-clock", "resting dial"), Figures{"13.5"});
    EXPECT_EQ(figures_of("light-clock", "moving dial"), Figures{"8.1"});
    EXPECT_EQ(figures_of("light-clock-flying", "resting dial"), Figures{"7.8"});
    EXPECT_EQ(figures_of("light-clock-flying", "moving dial"), Figures{"10.1"});

    for (const std::string shot : {"alice", "bob"}) {
        EXPECT_EQ(figures_of(shot, "Alice's dial"), (Figures{"-1.5", "-0.3", "0.1", "-0.3", "-1.5"})) << shot;
        EXPECT_EQ(figures_of(shot, "Bob's dial"), (Figures{"2.8", "1.7", "0.0", "-2.2", "-4.9"})) << shot;
    }
    EXPECT_EQ(shipped_shot("alice").time, shipped_shot("bob").time);
    EXPECT_EQ(shipped_shot("alice").position, shipped_shot("bob").position);

    EXPECT_EQ(figures_of("gamow-rest", "church dial"), Figures{"-12.0"});
    Figures street = figures_of("gamow-rest", "street dial");
    std::sort(street.begin(), street.end());
    EXPECT_EQ(street, (Figures{"-5.0", "0.3"}));
    const Figures tram = figures_of("gamow-pavement", "tram dial", {1, 0, 0});
    EXPECT_NE(std::find(tram.begin(), tram.end(), "27.8"), tram.end());
}

TEST(MovingScenesTest, TwinsMeetAtTwentyAndTwelve)
{
    Shot shot;
    shot.scene = "twins";
    const double deep = 0.08 * 0.62; // the dials' distance in front of the ships' origins
    shot.position = {0, 0, deep + 3};
    shot.time = 20.02 + std::hypot(1.3, 3); // equally far from both, a moment after both came to rest
    for (auto [dial, figures] : {std::pair("home dial", "20.0"), {"traveller's dial", "12.0"}}) {
        int there = 0; // two at the bend: the arriving and the resting segment
        for (const TimedObject& s : seen(shot, dial, {0, 0, 1}))
            if (s.there) {
                EXPECT_EQ(s.figures, figures) << dial;
                ++there;
            }
        EXPECT_GE(there, 1) << dial;
    }
}

TEST(MovingScenesTest, TheTrainFitsAndSeesTheDoorsShutOneAfterTheOther)
{
    const SceneFile scene = scene_of("train");
    const World& world = world_of("train");
    // At gamma = 5/3 the train's own time is 5/3 (t - 0.8 x).
    for (auto [t, x, own, ahead] :
        {std::tuple(-1.5, 7.5, -12.5, 14.5), {1.5, 7.5, -7.5, 10.5}, {-1.5, -7.5, 7.5, -10.5}, {1.5, -7.5, 12.5, -14.5}}) {
        const Event at = in_frame(world.frames[1], {t, {x, 0, 0}});
        EXPECT_NEAR(at.time, own, 1e-13);
        EXPECT_NEAR(at.position.x, ahead, 1e-13);
        EXPECT_GT(std::abs(ahead), 10); // outside the train
    }
    const Body& shut = scene.bodies[1];
    ASSERT_EQ(shut.name, "shut");
    EXPECT_EQ(shut.worldline, (std::vector<Event>{{-1.5, dvec3(0)}, {1.5, dvec3(0)}}));

    // The train is 20 long, plus the depth of its lamps.
    double low = 0, high = 0;
    const InstanceRange range = instances_of(world, 1);
    for (std::size_t i = range.first; i < range.last; ++i) {
        const Instance& instance = world.instances[i];
        const Primitive& p = world.primitives[instance.primitive];
        for (int corner = 0; corner < 8; ++corner) {
            const dvec3 at(
                corner & 1 ? p.low.x : p.high.x, corner & 2 ? p.low.y : p.high.y, corner & 4 ? p.low.z : p.high.z);
            const double x = (instance.frame_from_local * glm::dvec4(at, 1)).x;
            low = std::min(low, x), high = std::max(high, x);
        }
    }
    EXPECT_NEAR(low, -10, 1e-6);
    EXPECT_NEAR(high, 10, 0.11);

    using Doors = std::array<bool, 2>;
    for (auto [shot, doors] :
        {std::pair("train-tunnel", Doors{true, true}), {"train-far", {true, true}}, {"train-aboard-first", {false, true}},
            {"train-aboard-long", {false, false}}, {"train-aboard-second", {true, false}}, {"train-roof", {false, true}}}) {
        EXPECT_EQ(seen_at_doors(shot, "door's red"), doors) << shot;
        EXPECT_EQ(seen_at_doors(shot, "shut lamp"), doors) << shot;
        EXPECT_EQ(seen_at_doors(shot, "open lamp"), (Doors{!doors[0], !doors[1]})) << shot;
    }
}

TEST(MovingScenesTest, TheLightClocksPulsesMoveAtTheSpeedOfLight)
{
    const SceneFile scene = scene_of("light-clock");
    std::map<std::string, std::vector<Event>> pulses;
    for (const Body& body : scene.bodies) {
        if (body.nodes[0].rfind("flash ", 0) != 0)
            continue;
        Event start = body.worldline[0];
        start.position.y = std::stod(body.nodes[0].substr(6)) / 4;
        pulses[body.name.substr(0, body.name.find(' '))].push_back(start);
    }
    ASSERT_EQ(pulses.size(), 2u);
    for (const auto& [name, flashes] : pulses) {
        double up = 0;
        for (std::size_t i = 1; i < flashes.size(); ++i) {
            const double passed = flashes[i].time - flashes[i - 1].time;
            EXPECT_NEAR(glm::distance(flashes[i].position, flashes[i - 1].position), passed, 1e-13) << name << i;
            up = std::max(up, flashes[i].position.y);
        }
        EXPECT_EQ(up, 2) << name;
        EXPECT_EQ(flashes[16].time - flashes[0].time, name == "moving" ? 5 : 4); // the period, up and down
    }
    // The moving clock is where its flashes are.
    const auto& clock = scene.bodies[0].worldline;
    const dvec3 velocity = (clock[1].position - clock[0].position) / (clock[1].time - clock[0].time);
    for (const Event& flash : pulses["moving"]) {
        const dvec3 at = on(clock[0], velocity, flash.time).position;
        EXPECT_NEAR(at.x, flash.position.x, 1e-9);
        EXPECT_EQ(at.z, flash.position.z);
    }
    // In each shot each pulse appears as one whole flash.
    for (const std::string shot : {"light-clock", "light-clock-flying"}) {
        int flashes = 0;
        for (const TimedObject& s : seen(shipped_shot(shot), "flash", {}))
            flashes += s.there;
        EXPECT_EQ(flashes, 2) << shot;
    }
}

TEST(MovingScenesTest, ATramAndACyclistPassEachOtherInTheGamowStreet)
{
    const Shot shot = shipped_shot("gamow-pavement");
    for (const std::string material : {"tram green", "coat"}) {
        int before = 0;
        for (const TimedObject& s : seen(shot, material, {}))
            before += s.there && s.place.x < 0 && glm::length(s.place) < 12;
        EXPECT_EQ(before, 1) << material;
    }
    // The scene lasts half an hour: 9000 m of light travel.
    double last = 0;
    for (const Body& body : scene_of("gamow").bodies)
        last = std::max(last, body.worldline.back().time);
    EXPECT_GT(last, 9000);
}

} // namespace moving_scenes_test
