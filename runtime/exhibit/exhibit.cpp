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
struct HudUpdater {
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

RecordReplay record_replay_of(const ExhibitOptions& options)
{
    std::unique_ptr<Recorder> recorder;
    if (!options.record.empty())
        recorder = std::make_unique<Recorder>(options.record,
            header_of(options.scene, options.layout, options.start, options.rules, options.exposure,
                pattern_names[std::size_t(options.pattern)]),
            log_line);
    return {std::move(recorder), options.replay.empty() ? nullptr : std::make_unique<Replay>(options.replay)};
}

std::optional<Governor> governor_of(const ExhibitOptions& options)
{
    if (options.frame_budget_ms <= 0)
        return {};
    return Governor(options.ladder, options.frame_budget_ms);
}

std::optional<Guide> guide_of(const ExhibitOptions& options)
{
    if (!options.tour)
        return {};
    return Guide(*options.tour, options.rules, load_scene_file(options.scene).seconds_per_time_unit());
}

/// What outlasts the loss of a device.
struct Session {
    const ExhibitOptions& options;
    Layout layout = options.layout;
    Layout kept = layout; ///< as its file has it: without what was turned since
    FileWatch watch{files_of(layout)};
    std::string refused; ///< why a change of the layout was not taken up, for the head-up display
    std::optional<Guide> guide = guide_of(options);
    Flight flight = flight_at(options.start, options.rules);
    History history{};
    Exposure exposure{};
    Tutorial tutorial = tutorial_at(flight);
    RecordReplay record_replay = record_replay_of(options);
    Keyboard keyboard{};
    Hid hid{options.profiles, log_line};
    std::unique_ptr<HeadTracker> tracker = tracker_of(layout);
    AlignmentMode alignment{options.pattern};
    Lab lab{options.log, options.log_every_s, options.words};
    Skew skew{};
    std::optional<Governor> governor = governor_of(options);
    Clock::time_point began = Clock::now(), last = began;
    long shown = 0;
    bool complaints = false;
};

/// The device has nothing to do when this goes.
struct WaitIdleGuard {
    Device& device;
    ~WaitIdleGuard() { settle(device); }
};

std::string describe(const Skew& skew)
{
    std::array<char, 96> text;
    std::snprintf(text.data(), text.size(), "outputs %s together within %.2f ms, at worst %.2f ms",
        skew.on_screen ? "shown" : "handed over", 1e3 * skew.median_s(), 1e3 * skew.worst_s());
    return text.data();
}

/// What the next frame may spend.
Quality quality_of(const Session& session, const Device& device)
{
    if (session.governor)
        return within(device, session.governor->ladder()[session.governor->level()].quality);
    return session.options.quality ? within(device, *session.options.quality) : default_quality(device, false);
}

/// What the head-up display says beneath its figures.
std::string notice_of(const Session& session)
{
    if (!session.alignment.says().empty())
        return session.alignment.says();
    if (!session.refused.empty())
        return session.refused;
    if (const std::string trouble = session.hid.trouble(); !trouble.empty())
        return trouble;
    if (session.tracker && !session.tracker->heard(Clock::now()))
        return "no head tracker is heard on port " + std::to_string(session.tracker->tracking().port);
    if (session.governor)
        return describe(*session.governor);
    return session.skew.frames() > 0 ? describe(session.skew) : "";
}

/// Takes up a change of the layout's files: all of it, or, where anything in it is wrong, nothing. The old picture stays
/// until the new one can be drawn.
void apply_file_changes(Session& session, RenderContext& context, std::unique_ptr<Frame>& frame, Screens& screens)
{
    if (!session.watch.changed(Clock::now()))
        return;
    try {
        const Layout fresh = load_layout(session.layout.file);
        Layout layout = turned_again(fresh, session.kept, session.layout);
        FileWatch watch(files_of(layout));
        std::unique_ptr<HeadTracker> tracker;
        const bool same_tracker = session.layout.head_tracker == layout.head_tracker;
        if (!same_tracker)
            tracker = tracker_of(layout);
        frame = std::make_unique<Frame>(
            context.device, context.pipelines, context.world, layout, quality_of(session, context.device));
        if (!same_tracker)
            session.tracker = std::move(tracker);
        session.layout = std::move(layout);
        session.kept = fresh;
        session.watch = std::move(watch);
        session.refused.clear();
        screens.adopt(session.layout);
        const std::size_t unkept = changes(session.kept, session.layout).size();
        std::fprintf(stderr, "starbow: %s: taken up%s\n", session.layout.file.c_str(),
            unkept > 0 ? "; what was turned by hand stays turned (F5 keeps it)" : "");
    } catch (const InputError& error) {
        const std::string why = one_line(error.what());
        std::fprintf(stderr, "starbow: %s; the exhibit stays as it was\n", why.c_str());
        // On the display the folders would leave no room for the reason.
        const std::string folder = session.layout.file.parent_path().string() + "/";
        session.refused = why.starts_with(folder) ? why.substr(folder.size()) : why;
    }
}

/// What a builder turns with the keyboard; what can't be drawn is turned back.
void turn(Session& session, Frame& frame, const Controls& controls)
{
    Layout layout = session.layout;
    if (!session.alignment.apply(controls, layout))
        return;
    try {
        frame.adopt(layout);
        session.layout = std::move(layout);
    } catch (const InputError& error) {
        session.alignment.say(one_line(error.what()));
    }
}

/// What the next picture is exposed with.
double ev_of(const Session& session)
{
    const Exposing& rules = session.options.exposure;
    return session.guide ? session.guide->shown_ev(session.exposure, rules)
                       : shown_ev(session.exposure, rules, session.flight.exposure_ev, session.options.start.exposure_ev);
}

bool is_over(const Session& session)
{
    const ExhibitOptions& options = session.options;
    return (options.frames > 0 && session.shown >= options.frames) || (options.over && options.over());
}

/// Flies on one device until the visitor leaves. Throws vk::DeviceLostError.
void fly(Session& session, RenderContext& context)
{
    Device& device = context.device;
    const SceneFile& scene = context.world.scene;
    auto frame = std::make_unique<Frame>(device, context.pipelines, context.world, session.layout, quality_of(session, device));
    FrameTimer timer(device);
    double prepared_ms = 0;
    Screens screens(device, session.layout);
    HudUpdater hud_updater;
    Pace pace;
    vk::raii::Fence done = device.device.createFence({vk::FenceCreateFlagBits::eSignaled});
    vk::raii::CommandBuffer commands
        = std::move(device.device.allocateCommandBuffers({*device.pool, vk::CommandBufferLevel::ePrimary, 1}).front());
    const WaitIdleGuard settled{device}; // before any of the above goes

    while (!is_over(session)) {
        // One frame is in flight: the least delay between a control and its picture.
        pace.wait(screens.refresh_hz());
        (void)device.device.waitForFences(*done, true, UINT64_MAX);
        const std::optional<double> metered = frame->metered(); // of the frame before this one, always
        if (const auto ms = timer.ms(); ms && session.governor)
            if (session.governor->drawn(seconds(Clock::now() - session.began), prepared_ms + *ms))
                frame->adopt(quality_of(session, device));

        // What has changed around the exhibit, and which pictures to draw into. This waits for the screens.
        apply_file_changes(session, context, frame, screens);
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
        controls = session.keyboard.read(
            screens.handles(), std::chrono::nanoseconds(now - session.began).count(), !session.hid.has_gamepad());
        session.hid.add(seconds(now - session.last), controls);
        if (session.tracker)
            controls.head = session.tracker->read(now);
        if (controls.quit || screens.closed())
            break;
        if (controls.full_screen)
            screens.switch_full_screen();
        // A stall of the machine must not become a leap of the ship.
        const std::chrono::nanoseconds passed = now - session.last;
        entry.dt_ns = std::min<std::int64_t>(passed.count(), 100'000'000);
        entry.skipped_ns = passed.count() - entry.dt_ns;
        session.last = now;
        if (session.record_replay.replays() && !any)
            continue; // a replay waits to be seen
        if (!session.record_replay.play(entry)) // from here on a replay's controls
            break;
        session.flight = session.guide ? session.guide->flown(controls, entry.dt_ns)
                                   : flown(session.flight, session.history, controls, entry.dt_ns, session.options.rules,
                                       scene.seconds_per_time_unit(), session.options.start);
        session.exposure.locked ^= controls.lock_exposure;
        if (session.record_replay.replays())
            session.exposure.ev = entry.exposure_ev;
        else
            session.exposure = adapted(session.exposure, metered, 1e-9 * double(entry.dt_ns), session.options.exposure);
        entry.exposure_ev = session.exposure.ev;
        session.record_replay.keep(entry, session.flight);
        session.tutorial = advance(session.tutorial, controls, session.flight, 1e-9 * double(entry.dt_ns));
        session.lab.read(*frame, controls, context.world, 1e-9 * double(entry.dt_ns),
            [&](std::string line) { session.alignment.say(std::move(line)); });
        turn(session, *frame, controls); // the device has finished the frame before
        frame->show(session.alignment.pattern());
        if (!any)
            continue;

        // The frame: planned, culled and uploaded here, drawn there.
        const std::vector<Target>& targets = screens.targets();
        for (std::size_t i = 0; i < targets.size(); ++i)
            if (targets[i].view)
                frame->resize(i, {targets[i].extent.width, targets[i].extent.height});
        frame->move_head(controls.head);
        frame->meter(session.options.exposure.automatic);
        frame->bloom(session.options.exposure.bloom);
        Shot shot = shot_of(session.flight, session.options.start.scene);
        shot.exposure_ev = ev_of(session);
        session.lab.ask(*frame, shot, session.flight, context.world, hud_updater.typesetter);
        const InputCapabilities capabilities = session.hid.capabilities();
        const Words& words = session.options.words;
        const std::string prompted = session.guide ? session.guide->prompt(words)
            : session.options.tutorial             ? prompt(session.tutorial, capabilities, words)
                                                 : "";
        const Panel* panel = hud_updater.update(session.flight, scene, words, shot.exposure_ev, session.exposure.locked,
            frame->hud_width(), prompted, session.guide ? session.guide->caption(words, capabilities) : std::nullopt, notice_of(session));
        // A pattern is left alone but for what its builder is being told.
        const bool told = session.alignment.pattern() == Pattern::none || !session.alignment.says().empty();
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
        screens.present(session.skew);
        if (session.options.timed)
            session.options.timed({controls.told_ns, steady_ns(now), steady_ns(handed), steady_ns(Clock::now())});
        ++session.shown;
    }
}

/// The closing lines: where the flight has led, and how well the screens kept together.
void tell(const Session& session, const SceneFile& scene)
{
    Readings last = readings(session.flight.ship, scene, session.flight.effects);
    last.mode = session.flight.mode;
    last.exposure_ev = ev_of(session);
    last.exposure_locked = session.exposure.locked;
    for (const auto& [label, value] : hud_fields(last, words_in("en")))
        std::printf("%s %s  ", label.c_str(), value.c_str());
    std::printf("\n");
    if (session.skew.frames() > 0)
        std::printf("%s\n", describe(session.skew).c_str());
}

} // namespace

int fly_exhibit(const ExhibitOptions& options)
{
    Session session{options};
    for (int losses = 0;;) {
        const Clock::time_point opened = Clock::now();
        std::unique_ptr<RenderContext> context;
        std::string lost;
        try {
            context = std::make_unique<RenderContext>(options.scene, device_options(true),
                options.frame_budget_ms > 0   ? options.ladder[0].quality.spectra
                    : options.quality ? options.quality->spectra
                                      : std::nullopt);
            for (const std::string& note : context->world.world.notes)
                if (losses == 0)
                    std::fprintf(stderr, "starbow: %s: %s\n", context->world.scene.gltf.c_str(), note.c_str());
            if (losses == 0)
                std::printf("%s\n", describe_light(*context).c_str());
            fly(session, *context);
            tell(session, context->world.scene);
            const bool same = session.record_replay.end(session.flight);
            return !same || session.complaints || !context->device.complaints.empty() ? 1 : 0;
        } catch (const vk::DeviceLostError& error) {
            lost = error.what();
        } catch (const InputError& error) {
            if (losses == 0)
                throw;
            lost = error.what(); // its driver is not back yet
        }
        session.complaints |= context && !context->device.complaints.empty();
        context.reset();
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
