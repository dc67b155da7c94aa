#include "exhibit.h"
#include "alignment_mode.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/shipped.h"
#include "input/head_tracker.h"
#include "input/hid.h"
#include "input/keyboard.h"
#include "lab.h"
#include "runtime/flight/flight.h"
#include "runtime/flight/history.h"
#include "runtime/flight/record_files.h"
#include "runtime/flight/record_replay.h"
#include "runtime/flight/tutorial.h"
#include "runtime/light/exposure.h"
#include "runtime/operation/file_watch.h"
#include "runtime/operation/governor.h"
#include "runtime/operation/guide.h"
#include "runtime/render/frame.h"
#include "runtime/render/frame_timer.h"
#include "runtime/render/render_context.h"
#include "screens.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <array>
#include <cstdio>
#include <memory>
#include <thread>

namespace starbow {
namespace {

using Clock = std::chrono::steady_clock;
using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

/// A GPU that is lost, as after a hang of its driver, is opened anew and the flight goes on; but not for ever: so often
/// without a minute's flight between.
constexpr int most_losses = 5;

std::int64_t steady_ns(Clock::time_point t) { return std::chrono::nanoseconds(t.time_since_epoch()).count(); }
double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

void present_barrier(vk::CommandBuffer commands, const Target& target, bool before)
{
    constexpr auto drawn = Stage::eColorAttachmentOutput;
    vk::ImageMemoryBarrier2 barrier = before ? vk::ImageMemoryBarrier2(drawn, {}, drawn, Access::eColorAttachmentWrite,
                                          vk::ImageLayout::eUndefined, vk::ImageLayout::eColorAttachmentOptimal)
                                             : vk::ImageMemoryBarrier2(drawn, Access::eColorAttachmentWrite, drawn, {},
                                                 vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::ePresentSrcKHR);
    barrier.image = target.image;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.subresourceRange = {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1};
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
}

/// Some drivers' FIFO does not wait for the screen: no frame starts before its turn. The turn is a hundredth shorter than
/// the screen's, so that where the driver does wait, it alone does: what is asked of a clock that runs ahead never delays.
struct Pace {
    Clock::time_point next = Clock::now();
    void wait(double refresh_hz)
    {
        const auto turn = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(0.99 / refresh_hz));
        std::this_thread::sleep_until(next);
        next = std::max(next + turn, Clock::now() - turn);
    }
};

/// Frames per second over the last half second or so, and the head-up display's panel, redrawn ten times a second.
struct Dashboard {
    Typesetter typesetter;
    Panel panel;
    Clock::time_point drawn{}, since = Clock::now();
    int frames = 0;
    double rate = 0;

    const Panel* update(const Flight& flight, const SceneFile& scene, const Words& words, double exposure_ev, bool locked,
        int width, const std::string& prompt, const std::optional<Caption>& caption, const std::string& notice)
    {
        Clock::time_point now = Clock::now();
        ++frames;
        if (double passed = seconds(now - since); passed > 0.5) {
            rate = frames / passed;
            frames = 0, since = now;
        }
        if (panel.size.x != width || seconds(now - drawn) > 0.1) {
            Readings told = readings(flight.ship, scene, flight.effects);
            told.frames_per_s = rate;
            told.mode = flight.mode, told.lever = flight.lever;
            if (caption && !caption->flying)
                told.lever.reset();
            told.exposure_ev = exposure_ev, told.exposure_locked = locked;
            told.prompt = prompt, told.caption = caption, told.notice = notice;
            panel = typesetter.draw(told, words, width);
            drawn = now;
        }
        return flight.hud ? &panel : nullptr;
    }
};

std::unique_ptr<HeadTracker> tracker_of(const Layout& layout)
{
    return layout.head_tracker ? std::make_unique<HeadTracker>(*layout.head_tracker) : nullptr;
}

void log_line(const std::string& line) { std::fprintf(stderr, "starbow: %s\n", line.c_str()); }

Tape tape_of(const Opening& opening)
{
    std::unique_ptr<Recorder> recorder;
    if (!opening.record.empty())
        recorder = std::make_unique<Recorder>(opening.record,
            header_of(opening.scene, opening.layout, opening.start, opening.rules, opening.exposure,
                pattern_names[std::size_t(opening.pattern)]),
            log_line);
    return {std::move(recorder), opening.replay.empty() ? nullptr : std::make_unique<Replay>(opening.replay)};
}

std::optional<Governor> governor_of(const Opening& opening)
{
    if (opening.hold_ms <= 0)
        return {};
    return Governor(opening.ladder, opening.hold_ms);
}

std::optional<Guide> guide_of(const Opening& opening)
{
    if (!opening.tour)
        return {};
    return Guide(*opening.tour, opening.rules, load_scene_file(opening.scene).seconds_per_time_unit());
}

/// What outlasts the loss of a device.
struct Visit {
    const Opening& opening;
    Layout layout = opening.layout;
    Layout kept = layout; ///< as its file has it: without what was turned since
    FileWatch watch{files_of(layout)};
    std::string refused; ///< why a change of the layout was not taken up, for the head-up display
    std::optional<Guide> guide = guide_of(opening);
    Flight flight = flight_at(opening.start, opening.rules);
    History history{};
    Exposure exposure{};
    Tutorial tutorial = tutorial_at(flight);
    Tape tape = tape_of(opening);
    Keyboard keyboard{};
    Hid hid{opening.profiles, log_line};
    std::unique_ptr<HeadTracker> tracker = tracker_of(layout);
    Workbench workbench{opening.pattern};
    Lab lab{opening.log, opening.log_every_s, opening.words};
    Skew skew{};
    std::optional<Governor> governor = governor_of(opening);
    Clock::time_point began = Clock::now(), last = began;
    long shown = 0;
    bool complaints = false;
};

/// The device has nothing to do when this goes.
struct Settled {
    Device& device;
    ~Settled() { settle(device); }
};

std::string told(const Skew& skew)
{
    std::array<char, 96> text;
    std::snprintf(text.data(), text.size(), "outputs %s together within %.2f ms, at worst %.2f ms",
        skew.on_screen ? "shown" : "handed over", 1e3 * skew.median_s(), 1e3 * skew.worst_s());
    return text.data();
}

/// What the next frame may spend.
Quality quality_of(const Visit& visit, const Device& device)
{
    if (visit.governor)
        return within(device, visit.governor->ladder()[visit.governor->rung()].quality);
    return visit.opening.quality ? within(device, *visit.opening.quality) : default_quality(device, false);
}

/// What the head-up display says beneath its figures.
std::string notice_of(const Visit& visit)
{
    if (!visit.workbench.says().empty())
        return visit.workbench.says();
    if (!visit.refused.empty())
        return visit.refused;
    if (const std::string trouble = visit.hid.trouble(); !trouble.empty())
        return trouble;
    if (visit.tracker && !visit.tracker->heard(Clock::now()))
        return "no head tracker is heard on port " + std::to_string(visit.tracker->tracking().port);
    if (visit.governor)
        return told(*visit.governor);
    return visit.skew.frames() > 0 ? told(visit.skew) : "";
}

/// Takes up a change of the layout's files: all of it, or, where anything in it is wrong, nothing. The old picture stays
/// until the new one can be drawn.
void take_up_changes(Visit& visit, Theatre& theatre, std::unique_ptr<Frame>& frame, Screens& screens)
{
    if (!visit.watch.changed(Clock::now()))
        return;
    try {
        const Layout fresh = load_layout(visit.layout.file);
        Layout layout = turned_again(fresh, visit.kept, visit.layout);
        FileWatch watch(files_of(layout));
        std::unique_ptr<HeadTracker> tracker;
        const bool same_tracker = visit.layout.head_tracker == layout.head_tracker;
        if (!same_tracker)
            tracker = tracker_of(layout);
        frame = std::make_unique<Frame>(
            theatre.device, theatre.pipelines, theatre.world, layout, quality_of(visit, theatre.device));
        if (!same_tracker)
            visit.tracker = std::move(tracker);
        visit.layout = std::move(layout);
        visit.kept = fresh;
        visit.watch = std::move(watch);
        visit.refused.clear();
        screens.adopt(visit.layout);
        const std::size_t unkept = changes(visit.kept, visit.layout).size();
        std::fprintf(stderr, "starbow: %s: taken up%s\n", visit.layout.file.c_str(),
            unkept > 0 ? "; what was turned by hand stays turned (F5 keeps it)" : "");
    } catch (const InputError& error) {
        const std::string why = one_line(error.what());
        std::fprintf(stderr, "starbow: %s; the exhibit stays as it was\n", why.c_str());
        // On the display the folders would leave no room for the reason.
        const std::string folder = visit.layout.file.parent_path().string() + "/";
        visit.refused = why.starts_with(folder) ? why.substr(folder.size()) : why;
    }
}

/// What a builder turns with the keyboard; what can't be drawn is turned back.
void turn(Visit& visit, Frame& frame, const Controls& controls)
{
    Layout layout = visit.layout;
    if (!visit.workbench.apply(controls, layout))
        return;
    try {
        frame.adopt(layout);
        visit.layout = std::move(layout);
    } catch (const InputError& error) {
        visit.workbench.say(one_line(error.what()));
    }
}

/// What the next picture is exposed with.
double ev_of(const Visit& visit)
{
    const Exposing& rules = visit.opening.exposure;
    return visit.guide ? visit.guide->shown_ev(visit.exposure, rules)
                       : shown_ev(visit.exposure, rules, visit.flight.exposure_ev, visit.opening.start.exposure_ev);
}

bool is_over(const Visit& visit)
{
    const Opening& opening = visit.opening;
    return (opening.frames > 0 && visit.shown >= opening.frames) || (opening.over && opening.over());
}

/// Flies on one device until the visitor leaves. Throws vk::DeviceLostError.
void fly(Visit& visit, Theatre& theatre)
{
    Device& device = theatre.device;
    const SceneFile& scene = theatre.world.scene;
    auto frame = std::make_unique<Frame>(device, theatre.pipelines, theatre.world, visit.layout, quality_of(visit, device));
    FrameTimer timer(device);
    double prepared_ms = 0;
    Screens screens(device, visit.layout);
    Dashboard dashboard;
    Pace pace;
    vk::raii::Fence done = device.device.createFence({vk::FenceCreateFlagBits::eSignaled});
    vk::raii::CommandBuffer commands
        = std::move(device.device.allocateCommandBuffers({*device.pool, vk::CommandBufferLevel::ePrimary, 1}).front());
    const Settled settled{device}; // before any of the above goes

    while (!is_over(visit)) {
        // One frame is in flight: the least delay between a control and its picture.
        pace.wait(screens.refresh_hz());
        (void)device.device.waitForFences(*done, true, UINT64_MAX);
        const std::optional<double> metered = frame->metered(); // of the frame before this one, always
        if (const auto ms = timer.ms(); ms && visit.governor)
            if (visit.governor->drawn(seconds(Clock::now() - visit.began), prepared_ms + *ms))
                frame->adopt(quality_of(visit, device));

        // What has changed around the exhibit, and which pictures to draw into. This waits for the screens.
        take_up_changes(visit, theatre, frame, screens);
        screens.follow();
        const bool any = screens.acquire();

        // What the visitor wants, and where that leads.
        if (any)
            glfwPollEvents();
        else
            glfwWaitEventsTimeout(0.1); // all minimised, or no monitor there
        const Clock::time_point now = Clock::now();
        RecordEntry entry{.shown = any};
        Controls& controls = entry.controls;
        controls = visit.keyboard.read(
            screens.handles(), std::chrono::nanoseconds(now - visit.began).count(), !visit.hid.has_gamepad());
        visit.hid.add(seconds(now - visit.last), controls);
        if (visit.tracker)
            controls.head = visit.tracker->read(now);
        if (controls.quit || screens.closed())
            break;
        if (controls.full_screen)
            screens.switch_full_screen();
        // A stall of the machine must not become a leap of the ship.
        const std::chrono::nanoseconds passed = now - visit.last;
        entry.dt_ns = std::min<std::int64_t>(passed.count(), 100'000'000);
        entry.skipped_ns = passed.count() - entry.dt_ns;
        visit.last = now;
        if (visit.tape.replays() && !any)
            continue; // a replay waits to be seen
        if (!visit.tape.play(entry)) // from here on a replay's controls
            break;
        visit.flight = visit.guide ? visit.guide->flown(controls, entry.dt_ns)
                                   : flown(visit.flight, visit.history, controls, entry.dt_ns, visit.opening.rules,
                                       scene.seconds_per_time_unit(), visit.opening.start);
        visit.exposure.locked ^= controls.lock_exposure;
        if (visit.tape.replays())
            visit.exposure.ev = entry.exposure_ev;
        else
            visit.exposure = adapted(visit.exposure, metered, 1e-9 * double(entry.dt_ns), visit.opening.exposure);
        entry.exposure_ev = visit.exposure.ev;
        visit.tape.keep(entry, visit.flight);
        visit.tutorial = advance(visit.tutorial, controls, visit.flight, 1e-9 * double(entry.dt_ns));
        visit.lab.read(*frame, controls, theatre.world, 1e-9 * double(entry.dt_ns),
            [&](std::string line) { visit.workbench.say(std::move(line)); });
        turn(visit, *frame, controls); // the device has finished the frame before
        frame->show(visit.workbench.pattern());
        if (!any)
            continue;

        // The frame: planned, culled and uploaded here, drawn there.
        const std::vector<Target>& targets = screens.targets();
        for (std::size_t i = 0; i < targets.size(); ++i)
            if (targets[i].view)
                frame->resize(i, {targets[i].extent.width, targets[i].extent.height});
        frame->move_head(controls.head);
        frame->meter(visit.opening.exposure.automatic);
        frame->bloom(visit.opening.exposure.bloom);
        Shot shot = shot_of(visit.flight, visit.opening.start.scene);
        shot.exposure_ev = ev_of(visit);
        visit.lab.ask(*frame, shot, visit.flight, theatre.world, dashboard.typesetter);
        const Means means = visit.hid.means();
        const Words& words = visit.opening.words;
        const std::string prompted = visit.guide ? visit.guide->prompt(words)
            : visit.opening.tutorial             ? prompt(visit.tutorial, means, words)
                                                 : "";
        const Panel* panel = dashboard.update(visit.flight, scene, words, shot.exposure_ev, visit.exposure.locked,
            frame->hud_width(), prompted, visit.guide ? visit.guide->caption(words, means) : std::nullopt, notice_of(visit));
        // A pattern is left alone but for what its builder is being told.
        const bool told = visit.workbench.pattern() == Pattern::none || !visit.workbench.says().empty();
        const Clock::time_point asked = Clock::now();
        frame->prepare(shot, told ? panel : nullptr);
        commands.reset();
        commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        timer.begin(*commands);
        for (const Target& target : targets)
            if (target.view)
                present_barrier(*commands, target, true);
        frame->record(*commands, targets);
        for (const Target& target : targets)
            if (target.view)
                present_barrier(*commands, target, false);
        timer.end(*commands);
        commands.end();
        prepared_ms = 1e3 * seconds(Clock::now() - asked);
        device.device.resetFences(*done);
        screens.submit(*commands, *done);
        const Clock::time_point handed = Clock::now();
        screens.present(visit.skew);
        if (visit.opening.timed)
            visit.opening.timed({controls.told_ns, steady_ns(now), steady_ns(handed), steady_ns(Clock::now())});
        ++visit.shown;
    }
}

/// The closing lines: where the flight has led, and how well the screens kept together.
void tell(const Visit& visit, const SceneFile& scene)
{
    Readings last = readings(visit.flight.ship, scene, visit.flight.effects);
    last.mode = visit.flight.mode;
    last.exposure_ev = ev_of(visit);
    last.exposure_locked = visit.exposure.locked;
    for (const auto& [label, value] : hud_fields(last, words_in("en")))
        std::printf("%s %s  ", label.c_str(), value.c_str());
    std::printf("\n");
    if (visit.skew.frames() > 0)
        std::printf("%s\n", told(visit.skew).c_str());
}

} // namespace

int fly_exhibit(const Opening& opening)
{
    Visit visit{opening};
    for (int losses = 0;;) {
        const Clock::time_point opened = Clock::now();
        std::unique_ptr<Theatre> theatre;
        std::string lost;
        try {
            theatre = std::make_unique<Theatre>(opening.scene, device_options(true),
                opening.hold_ms > 0   ? opening.ladder[0].quality.spectra
                    : opening.quality ? opening.quality->spectra
                                      : std::nullopt);
            for (const std::string& note : theatre->world.world.notes)
                if (losses == 0)
                    std::fprintf(stderr, "starbow: %s: %s\n", theatre->world.scene.gltf.c_str(), note.c_str());
            if (losses == 0)
                std::printf("%s\n", light_told(*theatre).c_str());
            fly(visit, *theatre);
            tell(visit, theatre->world.scene);
            const bool same = visit.tape.end(visit.flight);
            return !same || visit.complaints || !theatre->device.complaints.empty() ? 1 : 0;
        } catch (const vk::DeviceLostError& error) {
            lost = error.what();
        } catch (const InputError& error) {
            if (losses == 0)
                throw;
            lost = error.what(); // its driver is not back yet
        }
        visit.complaints |= theatre && !theatre->device.complaints.empty();
        theatre.reset();
        if (seconds(Clock::now() - opened) > 60)
            losses = 0;
        if (++losses > most_losses) {
            std::fprintf(stderr, "starbow: the GPU is lost again and again (%s)\n", lost.c_str());
            return 1;
        }
        std::fprintf(stderr, "starbow: the GPU is lost (%s); it is opened anew\n", lost.c_str());
        std::this_thread::sleep_for(std::chrono::seconds(losses - 1));
    }
}

} // namespace starbow
