#include "card.h"
#include "avenue.h"
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "config/markup/html.h"
#include "config/markup/svg.h"
#include "config/model/shipped.h"
#include "frame_stages.h"
#include "runtime/commands/median.h"
#include "runtime/hud/hud.h"
#include "runtime/operation/progress.h"
#include "runtime/operation/trace.h"
#include "runtime/render/pass_timer.h"
#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

namespace starbow {
namespace {

using Json = nlohmann::ordered_json;

Layout dome_of(int side)
{
    Layout dome = load_layout(shipped_file("layouts", "dome"));
    dome.outputs.at(0).size = {side, side};
    return dome;
}
/// Four walls of a CAVE, one projector each.
Layout four_walls()
{
    Layout walls = load_layout(shipped_file("layouts", "cave5"));
    walls.outputs.resize(4);
    for (Output& wall : walls.outputs)
        wall.size = {1920, 1200};
    return walls;
}
/// Two eyes of a headset of 2024, side by side.
Layout two_eyes()
{
    Layout eyes = load_layout(shipped_file("layouts", "headset"));
    eyes.outputs.at(0).size = {2 * 2064, 2208};
    return eyes;
}

struct CardDisplay {
    const char* says;
    Layout (*layout)();
};
constexpr std::array<CardDisplay, card_displays.size()> displays = {{
    {"a window of 800 x 600",
        [] {
            return window_of({800, 600});
        }},
    {"a dome of 4096 x 4096", [] { return dome_of(4096); }},
    {"a dome of 8192 x 8192", [] { return dome_of(8192); }},
    {"four walls of 1920 x 1200", four_walls},
    {"two eyes of 2064 x 2208", two_eyes},
}};
constexpr std::array qualities = {"balanced", "fine"};

struct CardCase {
    std::size_t display;
    double gamma;
    const char* quality;
    double whole_ms, slowest_ms, processor_ms, device_ms; ///< medians, but the slowest
    std::map<std::string, double> passes_ms; ///< medians of each pass's sum in a frame
    std::size_t frames;
};

/// The time of each pass in one frame, without the passes inside it.
std::map<std::string, double> own_times(const std::vector<PassTime>& passes)
{
    std::map<std::string, double> own;
    std::vector<const PassTime*> open;
    for (const PassTime& pass : passes) {
        while (!open.empty() && pass.begin_ms >= open.back()->begin_ms + open.back()->duration_ms)
            open.pop_back();
        if (!open.empty())
            own[open.back()->name] -= pass.duration_ms;
        own[pass.name] += pass.duration_ms;
        open.push_back(&pass);
    }
    return own;
}

CardCase time_case(RenderContext& context, OffscreenRenderer& renderer, const Shot& shot, CardCase measured, int rounds,
    const std::filesystem::path& trace_file)
{
    constexpr double most_ms = 2000;
    constexpr int fewest = 3;
    PassTimer timer(context.device, renderer);
    const Panel panel = Typesetter().draw(
        readings(ship_at(shot), context.world.scene, shot.effects), words_in("en"), renderer.frame().views().hud_width());
    for (int warm = 0; warm < 2; ++warm) // room, and pipelines
        timer.timed(shot, &panel);
    std::vector<double> whole, processor, on_device;
    std::map<std::string, std::vector<double>> passes;
    double sum = 0;
    for (int round = 0; round < rounds && (round < fewest || sum < most_ms); ++round) {
        const TimedFrame frame = timer.timed(shot, &panel);
        whole.push_back(frame.whole_ms()), processor.push_back(frame.processor_ms()), on_device.push_back(frame.device_ms);
        for (const auto& [name, ms] : own_times(frame.passes))
            passes[name].push_back(ms);
        sum += frame.whole_ms();
    }
    {
        Trace trace(trace_file);
        trace.name_thread("frame");
        context.device.trace = &trace;
        const TimedFrame frame = timer.timed(shot, &panel);
        context.device.trace = nullptr;
        add_passes(trace, frame.passes, frame.submit_ns);
    }
    measured.whole_ms = median(whole), measured.processor_ms = median(processor), measured.device_ms = median(on_device);
    measured.slowest_ms = std::ranges::max(whole);
    measured.frames = whole.size();
    for (const auto& [name, ms] : passes)
        measured.passes_ms[name] = median(ms);
    return measured;
}

/// Results of Google Test in a folder.
struct TestResults {
    int passed = 0;
    std::vector<std::string> failed;
};
TestResults tests_in(const std::filesystem::path& folder)
{
    TestResults results;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (!entry.path().filename().string().starts_with("tests-") || entry.path().extension() != ".json")
            continue;
        const Json all = Json::parse(read_whole(entry.path(), 100 << 20, "results of Google Test"), nullptr, false);
        for (const Json& suite : all.value("testsuites", Json::array()))
            for (const Json& test : suite.value("testsuite", Json::array()))
                if (!test.contains("failures"))
                    ++results.passed;
                else
                    results.failed.push_back(suite.value("name", "") + "." + test.value("name", ""));
    }
    return results;
}

Json json_of(const GpuListing& gpu, const std::vector<CardCase>& cases)
{
    Json json = {{"device", gpu.name}, {"driver", gpu.driver}};
    for (const CardCase& one : cases) {
        Json passes = Json::object();
        for (const auto& [name, ms] : one.passes_ms)
            passes[name] = ms;
        json["displays"].push_back({{"display", card_displays[one.display]}, {"gamma", one.gamma}, {"quality", one.quality},
            {"frames", one.frames}, {"frame_ms", one.whole_ms}, {"slowest_ms", one.slowest_ms},
            {"processor_ms", one.processor_ms}, {"device_ms", one.device_ms}, {"passes_ms", passes}});
    }
    return json;
}

std::string setting_of(const CardCase& one)
{
    return (one.gamma == 1 ? "at rest" : "gamma " + shortest(one.gamma)) + ", " + one.quality;
}

constexpr std::array colours
    = {"#4e79a7", "#f28e2b", "#59a14f", "#e15759", "#76b7b2", "#edc948", "#b07aa1", "#ff9da7", "#9c755f", "#bab0ac"};

/// The passes of all frames in bars, one below the other; each display has a scale of its own.
std::string bars(const std::vector<CardCase>& cases, const std::vector<std::string>& passes)
{
    constexpr double left = 150, width = 560, row = 20;
    double longest = 0;
    for (const CardCase& one : cases)
        longest = std::max(longest, one.whole_ms);
    Svg svg;
    double y = 4;
    for (const CardCase& one : cases) {
        svg.text({0, y + 13}, setting_of(one));
        double x = left;
        for (std::size_t k = 0; k < passes.size(); ++k) {
            const auto found = one.passes_ms.find(passes[k]);
            const double w = found == one.passes_ms.end() ? 0 : std::max(found->second, 0.) / longest * width;
            if (w > 0)
                svg.rect({x, y}, {x + w, y + row - 6}, attribute("fill", colours[k % colours.size()]));
            x += w;
        }
        const double end = left + one.whole_ms / longest * width;
        svg.line({end, y - 1}, {end, y + row - 5}, R"(stroke="#1a1a1a")");
        svg.text({end + 5, y + 13}, shortest(one.whole_ms, 2) + " ms");
        y += row;
    }
    return svg.drawn({left + width + 90, y + 4});
}

std::string page_of(const GpuListing& gpu, const std::vector<CardCase>& cases, const TestResults& tests, const Json& stages)
{
    std::vector<std::string> passes;
    for (const CardCase& one : cases)
        for (const auto& [name, ms] : one.passes_ms)
            if (std::ranges::find(passes, name) == passes.end())
                passes.push_back(name);
    std::string page = page_begin("en", "Starbow on " + gpu.name, "span{padding:0 .5rem}") + "<h1>Starbow on "
        + escaped_html(gpu.name) + "</h1>\n<p>" + escaped_html(gpu.driver)
        + ". The avenue, all effects on, with head-up display and meter. A bar is the time of a frame's passes by the "
          "device's "
          "clock; the mark behind it is the whole frame, from the beginning of its planning to the device's end.</p>\n<p>";
    for (std::size_t k = 0; k < passes.size(); ++k)
        page += "<span style=\"border-left:1rem solid " + std::string(colours[k % colours.size()]) + "\">"
            + escaped_html(passes[k]) + "</span> ";
    page += "</p>\n";
    for (std::size_t display = 0; display < displays.size(); ++display) {
        std::vector<CardCase> own;
        std::ranges::copy_if(cases, std::back_inserter(own), [&](const CardCase& one) { return one.display == display; });
        if (own.empty())
            continue;
        page += "<h2>" + std::string(displays[display].says) + "</h2>\n" + bars(own, passes) + "<table>\n"
            + table_row({"", "frame, ms", "slowest", "processor", "device", "frames measured"}, "th");
        for (const CardCase& one : own)
            page += table_row({setting_of(one), shortest(one.whole_ms, 2), shortest(one.slowest_ms, 2),
                shortest(one.processor_ms, 2), shortest(one.device_ms, 2), std::to_string(one.frames)});
        page += "</table>\n";
    }
    if (!stages.is_null()) {
        page += "<h2>Ratios, a window of 800 x 600, the default quality</h2>\n<table>\n"
            + table_row({"", "rest", "gamma 4", "gamma 100"}, "th");
        for (const char* key : {"frame_over_plain", "warp_over_lookup"}) {
            const Json& of = stages.at("ratios").at(key);
            page += table_row(
                {key, shortest(of.at("rest"), 2), shortest(of.at("gamma4"), 2), shortest(of.at("gamma100"), 2)});
        }
        page += "</table>\n";
    }
    if (tests.passed > 0 || !tests.failed.empty()) {
        page += "<h2>Tests with Vulkan</h2>\n<p>" + std::to_string(tests.passed) + " passed, "
            + std::to_string(tests.failed.size()) + " failed.</p>\n<ul>\n";
        for (const std::string& name : tests.failed)
            page += "<li>" + escaped_html(name) + "</li>\n";
        page += "</ul>\n";
    }
    return page + "</body></html>\n";
}

GpuListing chosen_gpu()
{
    for (const GpuListing& gpu : list_gpus(device_options(false)))
        if (gpu.chosen)
            return gpu;
    throw InputError("No usable Vulkan device: starbow doctor says what is missing");
}

} // namespace

void bench_card(const std::filesystem::path& folder, const std::string& display, int rounds)
{
    const std::filesystem::path file = folder / "card.json";
    const GpuListing gpu = chosen_gpu();
    make_folder_of(file);
    write_whole(file, json_of(gpu, {}).dump(2) + "\n"); // a folder that can't be made is refused before long work
    const TestResults tests = tests_in(folder);
    std::printf("%s, %s; the avenue, all effects on; milliseconds\n\n%-32s%10s%10s%10s%10s\n", gpu.name.c_str(),
        gpu.driver.c_str(), "", "frame", "slowest", "processor", "device");
    std::vector<CardCase> cases;
    Json json;
    {
        Avenue avenue;
        RenderContext& context = avenue.context;
        Progress progress;
        const double all = double((display.empty() ? displays.size() : 1) * qualities.size() * bench_speeds.size());
        for (std::size_t k = 0; k < displays.size(); ++k) {
            if (!display.empty() && display != card_displays[k])
                continue;
            const Layout layout = displays[k].layout();
            for (const char* quality : qualities) {
                progress.show(std::string("timing ") + displays[k].says + " in " + quality, double(cases.size()) / all);
                OffscreenRenderer renderer(context.device, context.pipelines, context.world, layout,
                    within(context.device, load_quality(shipped_file("qualities", quality))), false);
                renderer.frame().meter(true); // as the exhibit flies
                for (const auto& [name, gamma] : bench_speeds) {
                    const CardCase one = time_case(context, renderer, along_avenue(context.world.scene.start, gamma),
                        {.display = k, .gamma = gamma, .quality = quality}, rounds, folder / "trace.json");
                    std::printf("%-12s%-20s%10.2f%10.2f%10.2f%10.2f\n", card_displays[k], setting_of(one).c_str(),
                        one.whole_ms, one.slowest_ms, one.processor_ms, one.device_ms);
                    std::fflush(stdout);
                    cases.push_back(one);
                    json = json_of(gpu, cases);
                    write_whole(file, json.dump(2) + "\n");
                    progress.show(std::string("timing ") + displays[k].says + " in " + quality, double(cases.size()) / all);
                }
            }
        }
    }
    Json stages;
    if (display.empty()) {
        std::printf("\n");
        stages = bench_frame_stages(rounds, true);
        json["stages"] = stages;
    }
    json["tests"] = {{"passed", tests.passed}, {"failed", tests.failed}};
    write_whole(file, json.dump(2) + "\n");
    write_whole(folder / "card.html", page_of(gpu, cases, tests, stages));
}

} // namespace starbow
