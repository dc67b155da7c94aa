// Records: lines are read back to the bit, a replayed flight is the same to the bit, and wrong files are refused.
#include "config/model/shipped.h"
#include "runtime/flight/history.h"
#include "runtime/flight/record_replay.h"
#include "runtime/flight/recorder.h"
#include "runtime/flight/replay.h"
#include "runtime/operation/record_files.h"
#include "runtime/visit/shown_record.h"
#include "tests/support/controls.h"
#include "tests/support/files.h"
#include "tests/support/waiting.h"
#include <atomic>
#include <bit>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

namespace record_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

/// The clock of a record's writing thread: it stands until the test turns it.
class TurnedClock {
public:
    TimedWait wait()
    {
        return [this](std::condition_variable& changed, std::unique_lock<std::mutex>& lock, std::chrono::nanoseconds longest,
                   const std::function<bool()>& over) {
            const std::int64_t due_ns = now_ns_ + longest.count();
            waits_ = true;
            while (!over() && now_ns_ < due_ns)
                changed.wait_for(lock, std::chrono::milliseconds(1)); // a turn does not notify
            waits_ = false;
        };
    }
    bool waits() const { return waits_; } ///< the thread waits for a time to come
    void turn(std::chrono::nanoseconds by) { now_ns_ += by.count(); }

private:
    std::atomic<std::int64_t> now_ns_{0};
    std::atomic<bool> waits_{false};
};

/// A random double of a range, often -0 or a denormal.
double some_double(std::mt19937_64& random, double low, double high)
{
    switch (random() % 8) {
    case 0:
        return -0.0;
    case 1:
        return 4.9406564584124654e-324;
    case 2:
        return high;
    default:
        return std::uniform_real_distribution<double>(low, high)(random);
    }
}

RecordEntry some_entry(std::mt19937_64& random)
{
    RecordEntry entry;
    entry.dt_ns = std::int64_t(random() % 40'000'000);
    if (random() % 3 > 0)
        entry.exposure_ev = double(random() % 100000) / 3000 - 16;
    entry.skipped_ns = random() % 50 == 0 ? std::int64_t(random() % 1'000'000'000'000) : 0;
    entry.shown = random() % 10 != 0;
    Controls& c = entry.controls;
    const auto maybe = [&](auto& value, auto... range) {
        if (random() % 3 == 0)
            value = some_double(random, range...);
    };
    const auto maybe3 = [&](glm::dvec3& v, double most) {
        for (int i = 0; i < 3; ++i)
            maybe(v[i], -most, most);
    };
    if (random() % 3 == 0)
        c.lever = std::uniform_real_distribution<double>(0, 1)(random);
    maybe(c.throttle_rate, -4, 4);
    maybe3(c.push, 1);
    maybe3(c.turn, 1);
    maybe(c.look_rad.x, -0.1, 0.1);
    maybe(c.look_rad.y, -0.1, 0.1);
    entry.light = random() % 2 == 0 ? 1 : double(random() % 1000) / 1000;
    entry.ranged = random() % 2 == 0;
    if (random() % 5 == 0)
        entry.range_goal = {-31.25, 4.5, double(random() % 80), some_double(random, -9, 2), 0.001, 0.517, 1};
    if (random() % 4 == 0)
        entry.commands = {{.kind = CommandKind::scene, .text = "train"},
            {.kind = CommandKind::effect, .on = random() % 2 == 0, .effect = Effect::doppler},
            {.kind = CommandKind::pointer, .number = -12.25, .second = 4.5},
            {.kind = CommandKind::speed_limit, .number = 1 + std::uniform_real_distribution<double>(0, 9)(random)},
            {.kind = CommandKind::caption, .text = "\"Grüße\" \\ γ"}, {.kind = CommandKind::stop}};
    maybe3(c.head.moved_m, 10);
    if (random() % 3 == 0)
        c.head.turned = glm::angleAxis(some_double(random, -3, 3), glm::normalize(glm::dvec3(1, 2, 3)));
    maybe(c.exposure, -1, 1);
    for (const SwitchEntry& one : all_switches)
        c.set(one.which, random() % 200 == 0);
    c.taken = random() % 200 == 0;
    c.choose = random() % 20 == 0 ? int(random() % 3) - 1 : 0;
    c.turn_by = random() % 20 == 0 ? int(random() % 21) - 10 : 0;
    return entry;
}

std::vector<std::uint64_t> bits(const RecordEntry& e)
{
    const Controls& c = e.controls;
    std::vector<std::uint64_t> all{std::uint64_t(e.dt_ns), std::uint64_t(e.skipped_ns), e.shown, e.ranged,
        e.range_goal.size(), c.lever.has_value(), e.exposure_ev.has_value()};
    for (double v : {c.lever.value_or(0), c.throttle_rate, c.push.x, c.push.y, c.push.z, c.turn.x, c.turn.y, c.turn.z,
             c.look_rad.x, c.look_rad.y, c.head.moved_m.x, c.head.moved_m.y, c.head.moved_m.z, c.head.turned.w,
             c.head.turned.x, c.head.turned.y, c.head.turned.z, c.exposure, e.exposure_ev.value_or(0), e.light})
        all.push_back(std::bit_cast<std::uint64_t>(v));
    for (double v : e.range_goal)
        all.push_back(std::bit_cast<std::uint64_t>(v));
    for (const SwitchEntry& one : all_switches)
        all.push_back(c[one.which]);
    all.push_back(c.taken);
    all.push_back(std::uint64_t(c.choose));
    all.push_back(std::uint64_t(c.turn_by));
    for (const Command& command : e.commands) {
        all.insert(all.end(),
            {std::uint64_t(command.kind), command.on, std::uint64_t(command.effect),
                std::bit_cast<std::uint64_t>(command.number)});
        all.insert(all.end(), command.text.begin(), command.text.end());
    }
    return all;
}

RecordHeader some_header()
{
    RecordHeader header{.scene = "avenue", .layout = "desk", .scene_digest = 1, .layout_digest = ~0ull, .pattern = "none"};
    header.seconds_per_time_unit = 0.1;
    header.start.scene = "avenue";
    header.start.position = {1.0 / 3, -2e8, 0.1};
    header.start.u = {0.3, 1e-17, -1};
    header.start.ship_from_cockpit = orientation({1, 0, -1}, {0, 1, 0.3});
    header.start.effects.on.set(Effect::doppler, false);
    header.start.exposure_ev = -0.7;
    header.rules.mode = FlightMode::newtonian;
    header.rules.max_gamma = 123.456;
    header.rules.boundary = {{0.1, 0, 1.0 / 3}, 1e9};
    header.rules.comfort = {.no_roll = true, .level_horizon = true, .vignette = Vignette{-0.1, 1.0 / 3, 7, 0.7}};
    header.rules.pace = {1.0 / 7, 0.3, {{{-1, -0.1, 0}, {1, 2, 1.0 / 3}}, {{5, 5, 5}, {6, 6, 6}}}};
    header.rules.solids = {{.radius = 0.7, .span = 86400}, {.radius = 1.0 / 3, .span = 5}};
    for (std::size_t k = 0; k < header.rules.solids[1].path.size(); ++k)
        header.rules.solids[1].path[k] = glm::dvec3(1, -0.1, 1.0 / 3) / (1.0 + double(k));
    return header;
}

void ignore_message(LogKind, const std::string&) { }

std::filesystem::path fresh(const std::string& name)
{
    std::filesystem::remove(scratch(name));
    return scratch(name);
}

std::string first_line() { return text_of(some_header()); }

/// Replays all of a record.
Flight replayed(Replay& replay)
{
    const RecordHeader& header = replay.header();
    Flight flight = flight_at(header.start, header.rules);
    History history;
    while (const auto entry = replay.next()) {
        flight = flown(
            flight, history, entry->controls, entry->dt_ns, header.rules, header.seconds_per_time_unit, header.start);
        replay.compare(flight);
    }
    return flight;
}

void read_all(const std::filesystem::path& file)
{
    Replay replay(file);
    while (replay.next())
        replay.compare(flight_at(replay.header().start, replay.header().rules));
}

} // namespace

TEST(Record, ControlsAreReadBackToTheBit)
{
    std::mt19937_64 random(1);
    for (int i = 0; i < 20'000; ++i) {
        const RecordEntry entry = some_entry(random);
        std::string text = text_of(entry);
        ASSERT_EQ(text.find('\n'), text.size() - 1);
        text.pop_back();
        const auto read = std::get<RecordEntry>(parse_record_line("f", 2, text));
        ASSERT_EQ(bits(read), bits(entry)) << text;
        ASSERT_EQ(read.controls.time_ns, entry.dt_ns + entry.skipped_ns);
    }
    EXPECT_EQ(text_of(RecordEntry{.dt_ns = 16666667}), "{\"dt_ns\":16666667}\n"); // the size of an idle frame
}

TEST(Record, ThePageNamesEveryMemberOfAFrame)
{
    const std::string page = read_text(source_dir() / "docs/records.md");
    std::mt19937_64 random(2);
    std::set<std::string> names;
    for (int i = 0; i < 1000; ++i) {
        const auto line = nlohmann::json::parse(text_of(some_entry(random)));
        for (const auto& [name, value] : line.items())
            names.insert(name);
    }
    EXPECT_GT(names.size(), all_switches.size() + 10);
    for (const std::string& name : names)
        EXPECT_TRUE(page.find("`" + name + "`") != std::string::npos) << name;
}

TEST(Record, TheHeaderIsReadBackToTheBit)
{
    const RecordHeader header = some_header();
    std::string text = text_of(header);
    text.pop_back();
    const RecordHeader read = parse_record_header("f", text);
    EXPECT_EQ(read.scene, header.scene);
    EXPECT_EQ(read.layout, header.layout);
    EXPECT_EQ(read.scene_digest, header.scene_digest);
    EXPECT_EQ(read.layout_digest, header.layout_digest);
    EXPECT_EQ(read.seconds_per_time_unit, header.seconds_per_time_unit);
    EXPECT_EQ(digest(flight_at(read.start, read.rules)), digest(flight_at(header.start, header.rules)));
    EXPECT_EQ(read.start.position, header.start.position);
    EXPECT_EQ(read.rules.max_gamma, header.rules.max_gamma);
    EXPECT_TRUE(read.rules.comfort.no_roll);
    EXPECT_TRUE(read.rules.comfort.level_horizon);
    ASSERT_TRUE(read.rules.comfort.vignette);
    EXPECT_EQ(read.rules.comfort.vignette->elevation_deg, -0.1);
    EXPECT_EQ(read.rules.comfort.vignette->clear_deg, header.rules.comfort.vignette->clear_deg);
    EXPECT_EQ(read.rules.comfort.vignette->soft_deg, 7);
    EXPECT_EQ(read.rules.comfort.vignette->darkness, 0.7);
    RecordHeader in_steps = header;
    in_steps.rules.comfort = {.turn_steps_deg = 50.0 / 3};
    EXPECT_EQ(parse_record_header("f", text_of(in_steps)).rules.comfort.turn_steps_deg, 50.0 / 3);
    ASSERT_TRUE(read.rules.pace);
    EXPECT_EQ(read.rules.pace->per_s2, header.rules.pace->per_s2);
    EXPECT_EQ(read.rules.pace->least, header.rules.pace->least);
    ASSERT_EQ(read.rules.pace->things.size(), 2u);
    EXPECT_EQ(read.rules.pace->things[0].high, header.rules.pace->things[0].high);
    EXPECT_EQ(read.rules.pace->things[1].low, header.rules.pace->things[1].low);
    ASSERT_EQ(read.rules.solids.size(), 2u);
    EXPECT_EQ(read.rules.solids[1].radius, header.rules.solids[1].radius);
    EXPECT_EQ(read.rules.solids[1].span, header.rules.solids[1].span);
    EXPECT_EQ(read.rules.solids[1].path, header.rules.solids[1].path);
    ASSERT_TRUE(read.rules.boundary);
    EXPECT_EQ(read.rules.boundary->centre, header.rules.boundary->centre);
    EXPECT_EQ(read.rules.boundary->radius, header.rules.boundary->radius);
    EXPECT_EQ(text_of(read), text_of(header));
    RecordHeader calm = header;
    calm.exposing.calm = true;
    calm.exposing.mode = ExposureMode::range;
    EXPECT_EQ(parse_record_header("f", text_of(calm)).exposing.mode, ExposureMode::range);
    EXPECT_EQ(read.exposing.mode, ExposureMode::eye);
    EXPECT_TRUE(parse_record_header("f", text_of(calm)).exposing.calm);
    EXPECT_FALSE(read.exposing.calm);
}

// FNV-1a's published test vectors (Fowler, Noll, Vo: test_fnv.c).
TEST(Record, TheDigestIsFnv1a)
{
    EXPECT_EQ(digest(""), 0xcbf29ce484222325u);
    EXPECT_EQ(digest("a"), 0xaf63dc4c8601ec8cu);
    EXPECT_EQ(digest("foobar"), 0x85944171f73967e8u);
}

// Every member of a flight changes its digest, even in its lowest bit.
TEST(Record, TheDigestDependsOnEveryBit)
{
    Flight flight = flight_at(some_header().start);
    flight.homing = Homing{};
    flight.lever_rest = 0.0;
    const std::uint64_t before = digest(flight);
    std::vector<double*> numbers{&flight.lever, &*flight.lever_rest, &flight.throttle_rate, &flight.exposure_ev,
        &flight.look_rad.x, &flight.look_rad.y, &flight.homing->gain, &flight.homing->ramp_s};
    FeltMotion& settling = flight.homing->settling;
    for (glm::dvec3* v : {&flight.thrust, &flight.turn_rad_s, &flight.turn_lead_rad_s, &settling.thrust,
             &settling.turn_rad_s, &settling.turn_gain_rad_s2})
        numbers.insert(numbers.end(), {&v->x, &v->y, &v->z});
    for (Ship* ship : {&flight.ship, &flight.homing->from}) {
        for (Sum3* s : {&ship->position, &ship->u})
            for (Sum* sum : {&s->x, &s->y, &s->z})
                numbers.insert(numbers.end(), {&sum->value, &sum->carry});
        for (Sum* sum : {&ship->time, &ship->proper_time, &ship->distance})
            numbers.insert(numbers.end(), {&sum->value, &sum->carry});
        glm::dquat& q = ship->ship_from_cockpit;
        numbers.insert(numbers.end(), {&q.w, &q.x, &q.y, &q.z});
    }
    EXPECT_EQ(numbers.size(), 8u + 18 + 2 * (12 + 6 + 4));
    for (double* number : numbers) {
        const double kept = *number;
        *number = std::bit_cast<double>(std::bit_cast<std::uint64_t>(kept) ^ 1);
        EXPECT_NE(digest(flight), before) << number - numbers[0];
        *number = kept;
    }
    for (bool* flag : {&flight.thrust_inhibited, &flight.coasting, &flight.lever_waits, &flight.frozen, &flight.hud,
             &flight.homing->arrived}) {
        *flag = !*flag;
        EXPECT_NE(digest(flight), before);
        *flag = !*flag;
    }
    for (const EffectEntry& one : all_effects) {
        flight.effects.on.flip(one.which);
        EXPECT_NE(digest(flight), before) << one.name;
        flight.effects.on.flip(one.which);
    }
    for (std::int64_t* count : {&flight.ticks, &flight.left_ns, &flight.homing->ticks, &flight.homing->elapsed}) {
        ++*count;
        EXPECT_NE(digest(flight), before);
        --*count;
    }
    flight.homing->leg = HomingLeg::launch;
    EXPECT_NE(digest(flight), before);
    flight.homing->leg = HomingLeg::settling;
    EXPECT_EQ(digest(flight), before);
}

/// Records a flight of random hands. change: alters each frame, which then is flown from the flight so far.
template <class Change>
Flight record_random(const std::filesystem::path& file, std::mt19937_64& random, int frames, Change change)
{
    const RecordHeader header = some_header();
    Flight flight = flight_at(header.start, header.rules);
    History history;
    Recorder recorder(file, header, ignore_message);
    for (int i = 0; i < frames; ++i) {
        RecordEntry entry = some_entry(random);
        entry.dt_ns /= 10; // 2 ms on the average
        change(entry, flight);
        flight
            = flown(flight, history, entry.controls, entry.dt_ns, header.rules, header.seconds_per_time_unit, header.start);
        recorder.keep(entry, flight);
    }
    recorder.end(flight);
    EXPECT_FALSE(recorder.failed());
    return flight;
}

// Random controls pass through the file, with every case 100,000 frames of them. The flight is the same to the bit, with a
// check every 10 s.
TEST(Record, AReplayIsTheSameToTheBit)
{
    const int length = all_cases() ? 100'000 : 10'000;
    std::mt19937_64 random(2);
    const std::filesystem::path file = fresh("flight.jsonl");
    const Flight flight = record_random(file, random, length, [&](RecordEntry& entry, const Flight& now) {
        entry.controls.set(Switch::reset, random() % 20'000 == 0);
        entry.controls.set(Switch::freeze, now.frozen || random() % 200 == 0); // for one frame
    });
    EXPECT_GT(flight.ticks, 19 * length / 10);
    Replay replay(file), alone(file);
    long frames = 0;
    while (alone.next()) // without a flight
        ++frames;
    EXPECT_EQ(frames, length);
    const Flight again = replayed(replay);
    EXPECT_EQ(digest(again), digest(flight));
    EXPECT_EQ(again.ship.u.total(), flight.ship.u.total());
    EXPECT_EQ(again.ticks, flight.ticks);
    EXPECT_GE(replay.checks(), length / 5'000 - 1);
    EXPECT_EQ(replay.frames(), length);
    EXPECT_FALSE(replay.differs());
    EXPECT_TRUE(replay.verdict().starts_with("the same to the bit")) << replay.verdict();
    EXPECT_EQ(replay.verdict().find("cut"), std::string::npos) << replay.verdict();
}

// Whatever the frames' times are when it is shown, the flight is the one that was flown.
TEST(Record, IsShownAsItWasFlown)
{
    std::mt19937_64 random(4);
    const std::filesystem::path file = fresh("shown.jsonl");
    std::int64_t length_ns = 0;
    const Flight flight = record_random(file, random, 2'000, [&](RecordEntry& entry, const Flight&) {
        entry.commands.clear();
        length_ns += entry.dt_ns;
    });
    const RecordHeader header = some_header();
    for (const std::int64_t dt_ns : {3'000'000, 16'666'667, 100'000'000}) {
        ShownRecord shown(file);
        EXPECT_EQ(digest(shown.flight()), digest(flight_at(header.start, header.rules)));
        std::int64_t passed_ns = 0;
        for (; !shown.over() && passed_ns < 2 * length_ns; passed_ns += dt_ns)
            shown.advance({}, dt_ns);
        EXPECT_NEAR(double(passed_ns), double(length_ns), double(dt_ns));
        EXPECT_EQ(digest(shown.flight()), digest(flight));
    }
    // A damaged one ends where the damage is.
    std::string text = read_text(file);
    text.insert(text.size() / 2, "{");
    ShownRecord damaged(write_text("damaged.jsonl", text));
    for (int i = 0; i < 100'000 && !damaged.over(); ++i)
        damaged.advance({}, 16'666'667);
    EXPECT_TRUE(damaged.over());
    // So does one at a command that an exhibit carries out: what follows belongs to another state.
    int frames = 0;
    const std::filesystem::path led = fresh("led.jsonl");
    const Flight before = record_random(led, random, 10, [&](RecordEntry& entry, const Flight&) {
        entry.dt_ns = 5'000'000;
        entry.commands.clear();
        if (++frames == 6)
            entry.commands = {{.kind = CommandKind::scene, .text = "train"}};
    });
    ShownRecord until_led(led);
    for (int i = 0; i < 1'000 && !until_led.over(); ++i)
        until_led.advance({}, 1'000'000);
    EXPECT_TRUE(until_led.over());
    EXPECT_LT(until_led.flight().ticks, before.ticks);
    EXPECT_LE(until_led.flight().ticks, 25);
}

// One control differs in its last bit; the verdict says so and names the place.
TEST(Record, ADifferentFlightIsReported)
{
    const RecordHeader header = some_header();
    std::string text = first_line();
    Flight flight = flight_at(header.start, header.rules);
    History history;
    for (int i = 0; i < 3000; ++i) {
        RecordEntry entry{.dt_ns = 10'000'000, .controls = controls_with(Steering{.turn = {0.1, 0.2, 0.3}})};
        flight
            = flown(flight, history, entry.controls, entry.dt_ns, header.rules, header.seconds_per_time_unit, header.start);
        if (i == 1500)
            entry.controls.turn.x = std::nextafter(0.1, 1);
        text += text_of(entry);
        if (i % 1000 == 999)
            text += text_of(RecordCheck{flight.ticks, digest(flight), i == 2999});
    }
    const std::filesystem::path file = write_text("other.jsonl", text);
    Replay replay(file);
    replayed(replay);
    EXPECT_TRUE(replay.differs());
    EXPECT_NE(replay.verdict().find("by 20 s of flight (" + file.string() + ":2003)"), std::string::npos)
        << replay.verdict();
}

// After a crash the incomplete last line is left out, and the verdict says so.
TEST(Record, AnIncompleteLastLineIsLeftOut)
{
    std::string text = first_line() + text_of(RecordEntry{.dt_ns = 10}) + text_of(RecordEntry{.dt_ns = 10});
    for (const std::size_t cut : {std::size_t(0), std::size_t(1), std::size_t(8)}) {
        Replay replay(write_text("cut.jsonl", text.substr(0, text.size() - cut)));
        replayed(replay);
        EXPECT_EQ(replay.frames(), cut == 0 ? 2 : 1);
        EXPECT_NE(replay.verdict().find(cut == 0 ? "no last line" : "incomplete"), std::string::npos) << replay.verdict();
    }
}

TEST(Record, WrongFilesAreRefused)
{
    const auto with = [](const std::string& line) { return first_line() + "{\"dt_ns\":1}\n" + line + "\n"; };
    expect_wrong(read_all,
        {{"[]\n", "", "[]", "starbow run --record has written"}, {"{}\n", "", "{}", "starbow run --record has written"},
            {"{\"starbow_record\":2}\n", "/starbow_record", "2", "1 is right"},
            {"{\"starbow_record\":\"one\"}\n", "/starbow_record", "\"one\"", "number"},
            {with("{\"dt_ns\":-1}"), "/dt_ns", "-1", "too small"}, {with("{\"dt_ns\":1.5}"), "/dt_ns", "1.5", "whole"},
            {with("{\"dt_ns\":1e300}"), "/dt_ns", "1e+300", "too large"},
            {with("{\"dt_ns\":\"1\"}"), "/dt_ns", "\"1\"", "not a number"},
            {with("{\"faster\":1}"), "", "{\"faster\":1}", "lacks \"dt_ns\""},
            {with("{\"dt_ns\":1,\"lever\":2}"), "/lever", "2", "from 0 to 1"},
            {with("{\"dt_ns\":1,\"turn\":[0,null,0]}"), "/turn/1", "null", "not a number"},
            {with("{\"dt_ns\":1,\"turn\":[0,0]}"), "/turn", "[0,0]", "3 numbers"},
            {with("{\"dt_ns\":1,\"head_turned\":[0,0,0,0]}"), "/head_turned", "[0,0,0,0]", "not a turn"},
            {with("{\"dt_ns\":1,\"undo\":1}"), "/undo", "1", "true"},
            {with("{\"dt_ns\":1,\"undone\":true}"), "/undone", "true", "undo"},
            {with("{\"ticks\":1,\"digest\":\"12\"}"), "/digest", "\"12\"", "16 hexadecimal"}});
    const auto message_for = [&](const std::string& text) {
        const auto file = write_text("wrong.jsonl", text);
        const std::string message = complaint([&] { read_all(file); });
        EXPECT_TRUE(message.starts_with(file.string() + ":")) << message;
        EXPECT_TRUE(message.ends_with(" is right")) << message;
        return message.substr(file.string().size());
    };
    EXPECT_TRUE(message_for("").starts_with(": is empty"));
    EXPECT_TRUE(message_for("{\"starbow_rec").starts_with(":1: is cut off"));
    EXPECT_TRUE(message_for("P6 800 600\n").starts_with(":1: column"));
    EXPECT_TRUE(message_for(std::string(1 << 20, 'x')).starts_with(":1: is longer than"));
    EXPECT_TRUE(message_for(with("{\"dt_ns\":1,\"faster\":NaN}")).starts_with(":3: column"));
    EXPECT_TRUE(message_for(with("{\"dt_ns\":1,\"faster\":1e999}")).starts_with(":3: /faster"));
    EXPECT_TRUE(message_for(with("{\"dt_ns\":2}\n{\"dt_ns\":-2}")).starts_with(":4: /dt_ns"));
    const std::string last = text_of(RecordCheck{0, 0, true});
    EXPECT_TRUE(message_for(with(last + last)).starts_with(":4: comes after the last line"));
}

TEST(Record, AnyDamageIsReadOrRefused)
{
    std::mt19937_64 random(3);
    std::string text = first_line();
    for (int i = 0; i < 8; ++i)
        text += text_of(some_entry(random)) + (i % 4 == 3 ? text_of(RecordCheck{i, std::uint64_t(i)}) : "");
    expect_survives(read_all, {text, text + text_of(RecordCheck{9, 9, true})});
}

TEST(Record, NeverReplacesAnotherFile)
{
    const std::filesystem::path there = write_text("there.jsonl", "mine");
    EXPECT_NE(
        complaint([&] { Recorder(there, some_header(), ignore_message); }).find("is there already"), std::string::npos);
    EXPECT_EQ(read_text(there), "mine");
    EXPECT_NE(
        complaint([&] { Recorder("/no/such/folder/a.jsonl", some_header(), ignore_message); }).find("can't be written"),
        std::string::npos);
    // In a folder each flight gets a file of its own.
    const std::filesystem::path folder = scratch("flights");
    std::filesystem::create_directories(folder);
    for (int i = 0; i < 3; ++i)
        Recorder(folder, some_header(), ignore_message);
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        ++files;
        EXPECT_EQ(Replay(entry.path()).header().scene, "avenue");
    }
    EXPECT_EQ(files, 3);
}

// A frame is on the disk a second later, even if the program crashes. The test turns the second; the disk may take its time.
TEST(Record, IsOnTheDiskWithinASecond)
{
    const std::filesystem::path file = fresh("soon.jsonl");
    TurnedClock clock;
    Recorder recorder(file, some_header(), ignore_message, clock.wait());
    ASSERT_TRUE(until([&] { return clock.waits(); }));
    recorder.keep({.dt_ns = 10}, flight_at(some_header().start));
    clock.turn(std::chrono::seconds(1));
    EXPECT_TRUE(until([&] { return read_text(file).find("\"dt_ns\":10") != std::string::npos; }));
    ASSERT_TRUE(until([&] { return clock.waits(); }));
    recorder.keep({.dt_ns = 11}, flight_at(some_header().start));
    clock.turn(std::chrono::seconds(1));
    EXPECT_TRUE(until([&] { return read_text(file).find("\"dt_ns\":11") != std::string::npos; }));
}

TEST(Record, AFullDiskEndsTheRecordWithOneMessage)
{
    std::vector<std::string> lines;
    std::mutex mutex;
    {
        Recorder recorder("/dev/full", some_header(), [&](LogKind, const std::string& line) {
            const std::lock_guard lock(mutex);
            lines.push_back(line);
        });
        const Flight flight = flight_at(some_header().start);
        EXPECT_TRUE(until([&] {
            recorder.keep({.dt_ns = 10}, flight);
            return recorder.failed();
        }));
        recorder.keep({.dt_ns = 10}, flight);
        recorder.end(flight);
    }
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("/dev/full: can't be written (No space left on device)"), std::string::npos) << lines[0];
}

// A replay finds the scene and the layout again. A scene with another unit of time is refused; other changes are reported.
TEST(Record, FindsItsSceneAndLayoutAgain)
{
    const std::string scene = R"({ "gltf": "w.glb", "unit_m": 10, "light_speed_m_s": 5 })";
    const std::filesystem::path scene_file = write_text("scene.json", scene);
    write_text("w.glb", "glTF");
    const Layout layout = load_layout(shipped_file("layouts", "desk"));
    const RecordHeader header = header_of(scene_file, layout, {}, {}, {}, "none");
    EXPECT_EQ(header.layout, "desk");
    EXPECT_EQ(header.scene, scene_file.string());
    EXPECT_EQ(header.seconds_per_time_unit, 2);
    std::vector<std::string> lines;
    const auto reopen = [&](const RecordHeader& h, const std::string& other = "") {
        lines.clear();
        return find_flown("a.jsonl", h, other, [&](LogKind, const std::string& line) { lines.push_back(line); });
    };
    EXPECT_EQ(reopen(header).scene, scene_file);
    EXPECT_TRUE(lines.empty());
    EXPECT_EQ(reopen(header, "dome").layout.name, load_layout(shipped_file("layouts", "dome")).name);
    EXPECT_TRUE(lines.empty());
    RecordHeader other = header;
    other.layout_digest ^= 1;
    reopen(other);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("layout desk has changed"), std::string::npos);
    write_text("w.glb", "glTF 2");
    reopen(header);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("has changed since"), std::string::npos);
    write_text("scene.json", R"({ "gltf": "w.glb", "unit_m": 10, "light_speed_m_s": 4 })");
    EXPECT_NE(complaint([&] { reopen(header); }).find("a.jsonl:1: /seconds_per_time_unit: 2 no longer matches"),
        std::string::npos);
}

// A replay shows each frame at its own time, by a clock that the test turns. It does not wait for time that a stall
// skipped.
TEST(Record, IsReplayedAtItsOwnPace)
{
    std::string text = first_line();
    for (int i = 0; i < 3; ++i)
        text += text_of(RecordEntry{.dt_ns = 30'000'000,
            .skipped_ns = 3'600'000'000'000,
            .commands = {{.kind = CommandKind::move, .number = 1}, {.kind = CommandKind::keep}},
            .controls = controls_with(Switches{Switch::save})});
    using namespace std::chrono_literals;
    ReplayTime::Clock::time_point now(1h);
    const ReplayTime time{
        .now = [&] { return now; }, .sleep_until = [&](ReplayTime::Clock::time_point due) { now = std::max(now, due); }};
    RecordReplay record_replay(nullptr, std::make_unique<Replay>(write_text("pace.jsonl", text)), time);
    EXPECT_TRUE(record_replay.replays());
    RecordEntry entry;
    ASSERT_TRUE(record_replay.play(entry)); // the first comes at once
    EXPECT_EQ(now, ReplayTime::Clock::time_point(1h));
    Flight flight = flight_at(some_header().start);
    int frames = 1;
    for (record_replay.keep(entry, flight); record_replay.play(entry); ++frames) {
        EXPECT_FALSE(entry.controls[Switch::save]); // a replay never saves a layout
        ASSERT_EQ(entry.commands.size(), 1u);
        EXPECT_EQ(entry.commands[0].kind, CommandKind::move);
        EXPECT_EQ(exhibits_command(entry), nullptr);
        record_replay.keep(entry, flight);
    }
    EXPECT_EQ(frames, 3);
    EXPECT_EQ(now - ReplayTime::Clock::time_point(1h), 30ms)
        << "two frames, of which the first follows a frame that is late";
    EXPECT_EQ(entry.controls.time_ns, 3 * 3'600'030'000'000);
}

} // namespace record_test
