// A JSON reader reads the trace back; it shares no code with the writer.
#include "runtime/operation/log.h"
#include "runtime/operation/trace.h"
#include "tests/support/files.h"
#include <chrono>
#include <cmath>
#include <csignal>
#include <limits>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

namespace trace_test {

using namespace starbow;
using namespace starbow::testing;
using nlohmann::json;

namespace {

std::vector<json> all_of(const json& events, const std::string& phase)
{
    std::vector<json> all;
    for (const json& event : events)
        if (event.at("ph") == phase)
            all.push_back(event);
    return all;
}

json one_named(const json& events, const std::string& name)
{
    json found;
    for (const json& event : events)
        if (event.at("name") == name) {
            EXPECT_TRUE(found.is_null()) << name << " twice";
            found = event;
        }
    EXPECT_FALSE(found.is_null()) << name;
    return found;
}

std::string track_of(const json& events, const json& event)
{
    std::string name;
    for (const json& meta : all_of(events, "M"))
        if (meta["name"] == "thread_name" && meta["pid"] == event["pid"] && meta["tid"] == event["tid"])
            name = meta["args"]["name"];
    return name;
}

void spend(double ms)
{
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double, std::milli>(ms);
    while (std::chrono::steady_clock::now() < until) { }
}

} // namespace

TEST(Trace, SpansNestAndLastAsLongAsTheirScopes)
{
    const auto file = scratch("nested.json");
    {
        Trace trace(file);
        trace.name_thread("frame loop");
        const Trace::Span frame(&trace, "frame");
        {
            const Trace::Span plan(&trace, "plan");
            spend(3);
        }
        {
            const Trace::Span record(&trace, "record");
            spend(5);
        }
    }
    const json events = json::parse(read_text(file));
    const json frame = one_named(events, "frame"), plan = one_named(events, "plan"), record = one_named(events, "record");
    const auto begin = [](const json& event) { return event["ts"].get<double>(); };
    const auto end = [](const json& event) { return event["ts"].get<double>() + event["dur"].get<double>(); };
    for (const json& inner : {plan, record}) {
        EXPECT_EQ(inner["ph"], "X");
        EXPECT_EQ(inner["tid"], frame["tid"]);
        EXPECT_GE(begin(inner), begin(frame));
        EXPECT_LE(end(inner), end(frame) + 0.001); // begin and duration are each printed to 1 ns
    }
    EXPECT_LE(end(plan), begin(record) + 0.001);
    EXPECT_GE(plan["dur"].get<double>(), 3000); // microseconds
    EXPECT_GE(record["dur"].get<double>(), 5000);
    EXPECT_EQ(track_of(events, frame), "frame loop");
}

TEST(Trace, TheGpuHasATrackOfItsOwnOnTheSameClock)
{
    const auto file = scratch("gpu.json");
    std::int64_t began = 0;
    {
        Trace trace(file);
        const Trace::Span submit(&trace, "submit");
        began = Trace::now_ns();
        trace.gpu("cube pass", began + 1'000'000, 2'345'678);
        trace.gpu("warp", began + 3'345'678, 1'000);
    }
    const json events = json::parse(read_text(file));
    const json submit = one_named(events, "submit"), cube = one_named(events, "cube pass"), warp = one_named(events, "warp");
    EXPECT_EQ(cube["pid"], warp["pid"]);
    EXPECT_NE(cube["pid"], submit["pid"]);
    EXPECT_EQ(track_of(events, cube), "queue");
    EXPECT_DOUBLE_EQ(cube["dur"].get<double>(), 2345.678);
    EXPECT_NEAR(warp["ts"].get<double>() - cube["ts"].get<double>(), 2345.678, 1e-6);
    EXPECT_GE(cube["ts"].get<double>() - submit["ts"].get<double>(), 1000);
    std::map<int, std::string> processes;
    for (const json& meta : all_of(events, "M"))
        if (meta["name"] == "process_name")
            processes[meta["pid"]] = meta["args"]["name"];
    EXPECT_EQ(processes.at(submit["pid"]), "processor");
    EXPECT_EQ(processes.at(cube["pid"]), "GPU");
}

TEST(Trace, CountersAndInstantsAreEvents)
{
    const auto file = scratch("counters.json");
    {
        Trace trace(file);
        trace.counter("frame ms", 16.25);
        trace.counter("frame ms", std::numeric_limits<double>::quiet_NaN()); // JSON can't express it
        trace.counter("frame ms", std::numeric_limits<double>::infinity());
        trace.instant("late frame");
    }
    const json events = json::parse(read_text(file));
    ASSERT_EQ(all_of(events, "C").size(), 1u);
    EXPECT_EQ(all_of(events, "C")[0]["args"]["value"], 16.25);
    ASSERT_EQ(all_of(events, "i").size(), 1u);
    EXPECT_EQ(all_of(events, "i")[0]["name"], "late frame");
}

TEST(Trace, NamesAreEscaped)
{
    const std::vector<std::string> names{"a \"quoted\" one", "back\\slash", "line\nend\ttab", "γ = 4", "\x01"};
    const auto file = scratch("escaped.json");
    {
        Trace trace(file);
        for (const std::string& name : names)
            trace.instant(name);
        trace.instant("no UTF-8: \xff");
    }
    const json events = json::parse(read_text(file));
    for (const std::string& name : names)
        one_named(events, name);
    one_named(events, "no UTF-8: \xef\xbf\xbd");
}

TEST(Trace, EachThreadHasItsTrack)
{
    const auto file = scratch("threads.json");
    {
        Trace trace(file);
        trace.name_thread("frame loop");
        std::vector<std::thread> all;
        for (int t = 0; t < 4; ++t)
            all.emplace_back([&, t] {
                for (int i = 0; i < 1000; ++i)
                    trace.cpu("t" + std::to_string(t), Trace::now_ns(), 10);
            });
        for (std::thread& one : all)
            one.join();
    }
    const json events = json::parse(read_text(file));
    EXPECT_EQ(all_of(events, "X").size(), 4000u);
    std::map<std::string, int> track;
    for (const json& event : all_of(events, "X")) {
        const auto [at, fresh] = track.try_emplace(event["name"], event["tid"]);
        EXPECT_EQ(at->second, event["tid"]);
        EXPECT_TRUE(track_of(events, event).starts_with("thread ")) << track_of(events, event);
    }
    EXPECT_EQ(track.size(), 4u);
}

TEST(Trace, ASpanWithoutATraceDoesNothing)
{
    const Trace::Span span(nullptr, "plan"); // this needs neither a file nor a clock
}

TEST(Trace, ACrashLosesOnlyTheLastBracket)
{
    const auto file = scratch("crash.json");
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        static std::int64_t now_ns = 0;
        Trace trace(file, 1 << 20, [] { return now_ns; });
        for (; now_ns < 600'000'000; now_ns += 30'000'000)
            trace.cpu("frame", now_ns, 1000);
        raise(SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    const std::string text = read_text(file);
    EXPECT_FALSE(text.ends_with("]"));
    const json events = json::parse(text + "]"); // viewers close the list too
    EXPECT_GE(all_of(events, "X").size(), 11u); // of 20 frames, 30 ms apart, all but those of the last 250 ms
}

TEST(Trace, AFileThatCantBeWrittenIsRefusedAtOnce)
{
    std::filesystem::create_directories(scratch("folder.json"));
    const std::string folder = complaint([] { Trace trace(scratch("folder.json")); });
    EXPECT_TRUE(folder.starts_with(scratch("folder.json").string() + ": is a folder; ")) << folder;
    EXPECT_TRUE(folder.ends_with("is right")) << folder;
    const std::string below = complaint([] { Trace trace(write_text("plain", "x") / "trace.json"); });
    EXPECT_NE(below.find("can't be written"), std::string::npos) << below;
    const std::string full = complaint([] { Trace trace("/dev/full"); });
    EXPECT_NE(full.find("on a disk with space is right"), std::string::npos) << full;
}

TEST(Trace, MakesItsFolderAndReplacesAnOlderTrace)
{
    const auto file = scratch("deep") / "er" / "trace.json";
    for (const char* name : {"first, with a longer name", "second"}) {
        Trace trace(file);
        trace.instant(name);
    }
    const json events = json::parse(read_text(file));
    ASSERT_EQ(all_of(events, "i").size(), 1u);
    EXPECT_EQ(all_of(events, "i")[0]["name"], "second");
}

TEST(Trace, EndsAtItsLimitOfBytes)
{
    const auto file = scratch("large.json");
    std::FILE* log = std::fopen(scratch("large.log").c_str(), "w");
    open_log({.stream = log});
    {
        Trace trace(file, 10'000);
        for (int i = 0; i < 1000; ++i)
            trace.cpu("frame", Trace::now_ns(), 1000);
    }
    open_log({});
    std::fclose(log);
    EXPECT_LE(std::filesystem::file_size(file), 10'000u);
    EXPECT_GE(std::filesystem::file_size(file), 9'000u);
    EXPECT_GE(all_of(json::parse(read_text(file)), "X").size(), 50u);
    const std::string messages = read_text(scratch("large.log"));
    EXPECT_NE(messages.find("the trace ends here, the flight goes on"), std::string::npos);
    EXPECT_EQ(std::count(messages.begin(), messages.end(), '\n'), 1);
}

} // namespace trace_test
