#include "frame_loop.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "exhibit_renderer.h"
#include "runtime/operation/log.h"
#include "runtime/operation/progress.h"
#include "runtime/operation/record_files.h"
#include "runtime/operation/trace.h"
#include "runtime/operation/waits.h"
#include "runtime/render/debug.h"
#include "spoken.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <cstdio>
#include <thread>
#include <utility>

namespace starbow {
namespace {

using Clock = std::chrono::steady_clock;

std::int64_t steady_ns(Clock::time_point t) { return std::chrono::nanoseconds(t.time_since_epoch()).count(); }

} // namespace

void FramePace::wait(double refresh_hz)
{
    const auto turn = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(0.99 / refresh_hz));
    std::this_thread::sleep_until(next);
    next = std::max(next + turn, Clock::now() - turn);
}

FrameLoop::FrameLoop(Session& session, RemoteControl& remote, Presenter& presenter, RenderContext& context)
    : session_(session)
    , remote_(remote)
    , presenter_(presenter)
    , context_(context)
    , device_(context.device)
    , frame_(exhibit_renderer(context, session.layout, session.qualities.next(device_), session.options.node))
    , timer_(device_)
    , screens_(device_, session.layout, session.options.node)
    , cold_(session.options.warms_up.value_or(!device_.on_processor()))
    , most_pipelines_(device_.on_processor() ? most_pipelines_in_software : most_pipelines)
    , pictures_(std::bind_front(drawn_thumbnails, session.options.cache, session.options.words))
    , done_(device_.device.createFence({vk::FenceCreateFlagBits::eSignaled}))
    , live_(device_)
    , commands_(device_.device, {*device_.pool, vk::CommandBufferLevel::ePrimary, 2})
    , presenter_window_(device_, presenter, session.options.presenter)
{
    if (session.options.machines)
        master_ = std::make_unique<Master>(session.options, session.kept),
        turned_ = turned_numbers(session.kept, session.layout);
    name_object(device_, done_, "frame done");
    name_object(device_, commands_[0], "frame: world");
    name_object(device_, commands_[1], "frame: outputs");
    if (session.options.trace) {
        device_.trace = session.options.trace;
        session.options.trace->name_thread("flight");
        count_commands(device_);
    }
}

FrameLoop::~FrameLoop()
{
    device_.settle();
    device_.trace = nullptr, device_.timer = nullptr;
    device_.save_pipelines();
}

bool FrameLoop::fly_frame()
{
    // The first frame is a part of loading: drivers compile shaders in it. So are the frames while another world is read:
    // the threads that read it may take the processor.
    const LimitedWait working = fresh_ || !worlds_.coming().empty()
        ? LimitedWait("the end of a frame's work beside a world's loading", loading_limit_s)
        : LimitedWait("the end of one frame's work");
    // One frame is in flight at a time, for the least delay between a control and its picture.
    Metered metered = await_device();

    // Follow files and monitors, and acquire the windows' images. This waits for the screens.
    apply_file_changes();
    screens_.follow();
    const bool visible = screens_.acquire();
    if (visible && std::exchange(cold_, false))
        warm_up(); // only now the windows' format is known

    // Read the controls as late as possible.
    std::optional<Trace::Span> span(std::in_place, device_.trace, "controls");
    if (visible)
        glfwPollEvents();
    else
        stand_by();
    const Clock::time_point now = Clock::now();
    RecordEntry entry{.shown = visible};
    if (!read_controls(session_, screens_.handles(), entry) || screens_.closed())
        return false;
    remote_.read(entry.commands);
    presenter_.read(entry.commands);
    aim_pointer(entry.commands);
    add_items_content(entry.commands);
    if (entry.controls[Switch::full_screen])
        screens_.switch_full_screen();
    if (session_.record_replay.replays() && !visible)
        return true; // a replay waits for a visible window

    // Follow the visit, carry out a docent's commands, and step the flight. From here on the controls may be a replay's.
    if (!session_.record_replay.play(entry))
        return false;
    Requests requests;
    if (!session_.record_replay.replays()) {
        choose_in_menu(entry, requests);
        await_worlds(entry.commands);
    }
    requests.add(attend(requested(entry.controls, requests), entry.dt_ns));
    for (const Command& command : entry.commands)
        apply_command(command, requests);
    entry.controls = session_.hands.finish(entry.controls, requests);
    step(session_, entry, metered);
    seek_goals(session_, context_.world.scene, entry.dt_ns);
    speak(session_, context_.world.scene);
    const Controls& controls = entry.controls;
    session_.lab.read(*frame_, controls, context_.world, 1e-9 * double(entry.dt_ns),
        [&](std::string line) { session_.alignment.say(std::move(line)); });
    apply_alignment(controls);
    if (controls[Switch::pattern] && master_ && session_.alignment.pattern() != Pattern::none)
        session_.alignment.say(screens_of(session_));
    if (turn_usage(session_, screens_.shown(), context_.pipelines.count())) {
        remote_.publish_condition(session_);
        gather_lacks();
    }
    if (!visible) {
        remote_.shown(session_); // there is no picture to wait for
        if (master_) { // but the other machines have some
            master_->send(shared(next_picture_state(controls.head)), session_.light.leapt());
            release_frame();
        }
        presenter_window_.show(session_, screens_.monitors());
        return true;
    }

    span.reset();

    // Plan, cull, upload and record; FrameRenderer::draw lists the passes.
    const Clock::time_point begun = Clock::now();
    fit_outputs();
    const PictureState picture = next_picture_state(controls.head);
    if (master_)
        master_->send(shared(picture), session_.light.leapt());
    const Panel* panel = pictures_.set_up(picture, session_.words, *frame_);
    const std::size_t pipelines = context_.pipelines.count();
    const CommandCounts before = command_counts();
    begin_commands();
    frame_->draw(*commands_[0], *commands_[1], picture.shot, panel, screens_.targets());
    end_commands();
    const std::size_t made = context_.pipelines.count() - pipelines;
    if (made > 0)
        write_log(LogKind::pipelines_made, std::to_string(made) + " made in flight");
    prepared_ms_ = 1e3 * seconds(Clock::now() - begun);

    // Present.
    const Trace::Span presenting(device_.trace, "present");
    submitted_ns_ = Trace::now_ns();
    device_.device.resetFences(*done_);
    screens_.submit(*commands_[0], *commands_[1], *done_);
    submitted_ = true;
    trace_calls(command_counts() - before);
    const Clock::time_point handed = Clock::now();
    if (master_) {
        if (master_->awaits_drawing())
            device_.await(*done_, "the end of the frame's drawing (fence)");
        release_frame();
        frame_->add_samples(master_->samples());
    }
    screens_.present(session_.skew);
    held_since_.reset();
    if (presented_ && !fresh_)
        count_frame(session_, seconds(Clock::now() - *presented_), screens_.refresh_hz());
    presented_ = Clock::now();
    remote_.shown(session_);
    presenter_window_.show(session_, screens_.monitors());
    fresh_ = false;
    session_.service.shows("Shows " + std::to_string(screens_.shown()) + " of "
        + std::to_string(session_.layout.outputs.size()) + (session_.layout.outputs.size() == 1 ? " output" : " outputs")
        + (session_.options.careful ? ", in safe mode after repeated crashes" : "")
        + (session_.lacks.empty() ? "." : "; " + session_.lacks + "."));
    if (session_.options.timed)
        session_.options.timed({controls.report_ns, steady_ns(now), steady_ns(handed), steady_ns(Clock::now()), made > 0});
    ++session_.shown;
    constexpr std::int64_t idle_ns = 2'000'000'000; // else somebody's hand is on a device, and waits for the picture
    if (steady_ns(now) - controls.report_ns > idle_ns)
        warm_up_at_rest(picture.shot);
    return true;
}

void FrameLoop::warm_up_at_rest(const Shot& shot)
{
    const ExhibitOptions& options = session_.options;
    // Other machines would take the master's silence for its end.
    const bool wanted = device_.on_processor() && options.paced && !master_ && options.warms_up.value_or(true);
    const bool rests = shot.u == glm::dvec3(0) && session_.alignment.pattern() == Pattern::none;
    if (!wanted || !rests || rested_ || (at_rest_ && !at_rest_->ready()))
        return;
    try {
        if (!at_rest_)
            at_rest_ = warm_up_in(session_.qualities.next(device_));
        // The first states matter most: later ones must not drive their pipelines out.
        constexpr std::size_t for_the_flight = 24;
        rested_ = !at_rest_ || !in_room([&] { return at_rest_->step(pictures_.panel()); })
            || at_rest_->made() + for_the_flight > most_pipelines_;
    } catch (const NoRoom&) { // the flight can do without
        rested_ = true;
    }
    if (rested_) {
        at_rest_.reset();
        write_log(LogKind::pipelines_ready,
            std::to_string(context_.pipelines.kept()) + " pipelines are ready, most of them made while the ship rested");
    }
    presented_.reset(); // the next picture comes late, and that is no stutter
}

void FrameLoop::stand_by()
{
    presented_.reset(); // a time without pictures is no long frame
    glfwWaitEventsTimeout(master_ ? 0.016 : 0.1); // all windows are minimised, or no monitor is there
    const Clock::time_point now = Clock::now();
    if (screens_.held() == 0) {
        held_since_.reset();
        session_.service.waits("Waits for a monitor.");
        return;
    }
    // The window system gives no window an image. On a desktop this may be its way with windows that nobody sees; a
    // supervised exhibit has its screens for itself.
    const double held_s = seconds(now - held_since_.value_or(now));
    if (!held_since_)
        held_since_ = now;
    else if (session_.service.watchdog_s() && held_s > wait_limit_s(session_.service))
        give_up("the next picture of any output (vkAcquireNextImageKHR)", held_s);
    session_.service.waits("Waits for the window system, which holds all pictures.");
}

Metered FrameLoop::await_device()
{
    const Trace::Span span(device_.trace, "wait");
    if (session_.options.paced)
        pace_.wait(screens_.refresh_hz());
    device_.await(*done_, "the end of the frame's drawing (fence)");
    context_.pipelines.release_old(most_pipelines_);
    // While all windows are minimised nothing is submitted, and the last frame's times are old.
    if (!std::exchange(submitted_, false))
        return {};
    trace_passes();
    publish_view();
    if (const auto ms = timer_.ms())
        if (session_.qualities.drawn(seconds(Clock::now() - session_.began),
                std::max(prepared_ms_ + *ms, master_ ? master_->slowest_ms() : 0))) // one level for all, or seams would show
            frame_->adopt(session_.qualities.next(device_));
    watch_memory();
    return {frame_->metered(), frame_->surface_samples(), frame_->star_samples(), frame_->samples_across()};
}

void FrameLoop::publish_view()
{
    const bool guides = std::exchange(guides_view_, false), remotes = std::exchange(remotes_view_, false);
    SmallPicture& view = presenter_.view();
    if (guides)
        if (const glm::ivec2 size = live_.take(view.rgb); size.x > 0)
            view.size = size;
    if (remotes)
        remote_.publish_picture([&](std::vector<std::uint8_t>& rgb) {
            if (!guides)
                return live_.take(rgb);
            rgb = view.rgb;
            return view.size;
        });
}

std::unique_ptr<WarmUp> FrameLoop::warm_up_in(const Quality& quality)
{
    try {
        return in_room([&] {
            return std::make_unique<WarmUp>(device_, context_.pipelines, context_.world, session_.layout, quality,
                session_.content.start, screens_.format(), session_.options.exposure.automatic,
                bloom_of(session_.options.exposure, device_.on_processor()));
        });
    } catch (const NoRoom&) {
        throw;
    } catch (const InputError&) {
        return nullptr;
    }
}

void FrameLoop::warm_up()
{
    const auto began = Clock::now();
    const std::size_t levels = session_.qualities.levels();
    Progress progress;
    LimitedWait warming("the next step of the warm-up", loading_limit_s);
    for (std::size_t level = 0; level < levels; ++level) {
        if (!session_.qualities.has_room(level))
            continue;
        const Quality quality = session_.qualities.of_level(level, device_);
        try {
            const std::unique_ptr<WarmUp> steps = warm_up_in(quality);
            if (!steps)
                break;
            hud_.update(session_, context_.world.scene, 0);
            const Panel* panel = pictures_.panel_of(hud_.written(), session_.words, frame_->views().hud_width());
            while (steps->step(panel)) {
                glfwPollEvents(); // else the window system takes the program for dead
                warming.restart();
                session_.service.loads("Compiles the pipelines of all switches.", loading_limit_s);
                progress.show(
                    "compiling pipelines of all switches: " + std::to_string(level * steps->steps() + steps->step_number())
                        + " of " + std::to_string(levels * steps->steps()),
                    (double(level) + double(steps->step_number()) / double(steps->steps())) / double(levels));
            }
        } catch (const NoRoom& error) {
            if (!session_.qualities.leave(level, error.what()))
                throw;
        }
    }
    const std::size_t made = context_.pipelines.count();
    frame_->adopt(session_.qualities.next(device_));
    most_pipelines_ += made; // else the warm-up would be in vain
    rested_ = true;
    std::array<char, 80> text;
    std::snprintf(text.data(), text.size(), "%zu pipelines are ready after %.1f s", made, seconds(Clock::now() - began));
    write_log(LogKind::pipelines_ready, text.data());
    device_.save_pipelines();
    session_.last = Clock::now();
}

/// Gathers the sentences about missing places on the network, for the display, the remote and the service manager.
void FrameLoop::gather_lacks()
{
    session_.lacks.clear();
    for (const std::string& lack : {master_ ? master_->lack() : "",
             session_.devices.tracker() ? session_.devices.tracker()->lack() : "", remote_.lack()})
        if (!lack.empty())
            session_.lacks += (session_.lacks.empty() ? "" : "; ") + lack;
}

void FrameLoop::watch_memory()
{
    const Clock::time_point now = Clock::now();
    if (now - memory_watched_ < std::chrono::seconds(1))
        return;
    memory_watched_ = now;
    const std::optional<MemoryBudget> budget = device_.memory_budget();
    if (!budget || !budget->exceeded) {
        memory_reported_ = false;
        return;
    }
    if (memory_reported_)
        return;
    const std::string used = size_text(double(budget->used_bytes)) + " of the GPU's memory are used, and its driver gives "
        + "this program " + size_text(double(budget->most_bytes)) + " now";
    const std::optional<Governor>& governor = session_.qualities.governor();
    if (governor && session_.qualities.leave(governor->level(), used)) {
        frame_->adopt(session_.qualities.next(device_));
        frame_->release_images();
        return;
    }
    memory_reported_ = true;
    session_.qualities.forget_refusals(); // no level is small enough, so that none shall be missed
    write_log(LogKind::memory_exceeded,
        used + ": pictures may come slowly. Other programs closed, a coarser quality or smaller outputs are right");
}

void FrameLoop::trace_passes()
{
    if (!device_.trace)
        return;
    add_passes(*device_.trace, timer_.passes(), submitted_ns_);
}

void FrameLoop::trace_calls(const CommandCounts& counts)
{
    if (!device_.trace)
        return;
    for (std::size_t kind = 0; kind < counts.of.size(); ++kind)
        if (counts.of[kind] != traced_.of[kind])
            device_.trace->counter(command_count_names[kind], double(counts.of[kind]));
    traced_ = counts;
}

void FrameLoop::fit_outputs()
{
    const std::vector<Target>& targets = screens_.targets();
    std::vector<glm::ivec2> sizes(targets.size(), glm::ivec2(0));
    for (std::size_t i = 0; i < targets.size(); ++i)
        if (targets[i].view) {
            fit(i);
            sizes[i] = {targets[i].extent.width, targets[i].extent.height};
        }
    session_.qualities.follow_sizes(sizes);
}

PictureState FrameLoop::next_picture_state(const Head& head)
{
    const bool by_hand = session_.source->by_hand(); // a tour's own motion may roll
    const Flight& flight = session_.flight();
    const ShownLight& light = session_.light;
    PictureState now{.shot = shot_of(flight, session_.content.start.scene, by_hand ? session_.rules.comfort : Comfort()),
        .head = head,
        .range = light.curve(),
        .meters = session_.options.exposure.automatic || session_.options.exposure.calm || session_.choices.range
            || session_.choices.filter,
        .bloom = bloom_of(session_.options.exposure, device_.on_processor()),
        .fade = light.fade(),
        .vignette = session_.rules.comfort.vignette.value_or(Vignette()),
        .vignette_part = by_hand ? flight.vignette : 0,
        .pattern = session_.alignment.pattern()};
    now.shot.exposure_ev = light.ev();
    now.instruments = session_.lab.request(frame_->views(), now.shot, flight, context_.world, pictures_.typesetter);
    now.hud = hud_.update(session_, context_.world.scene, now.shot.exposure_ev);
    callouts_.choose(session_, context_.world, now);
    if (const auto pointer = session_.pointer.shown())
        now.pointer = {pointer->towards, pointer->strength};
    if (const auto handle = session_.alignment.handle()) // the builder's, who stands at the wall
        now.pointer = {*handle, 1};
    return now;
}

void FrameLoop::release_frame()
{
    master_->go();
    master_->describe(session_.machines);
    const bool barrier = screens_.barrier() && master_->nodes_barrier();
    if (in_step(session_.machines) < 2 || std::exchange(session_.barrier, barrier) == barrier)
        return;
    if (barrier)
        write_log(
            LogKind::screens_together, "the screens of all machines in step change in the same refresh (present barrier)");
    else
        write_log(LogKind::screens_apart,
            "the screens of the machines change at most one refresh apart; not every graphics card has "
            "VK_NV_present_barrier");
}

SharedState FrameLoop::shared(const PictureState& now) const
{
    const std::filesystem::path coming = worlds_.coming();
    const std::optional<Governor>& governor = session_.qualities.governor();
    return {.scene = master_->name_of("scenes", session_.content.scene),
        .coming = coming.empty() ? "" : master_->name_of("scenes", coming),
        .layout = master_->name_of("layouts", session_.layout.file),
        .layout_digest = master_->layout_digest(),
        .turned = turned_,
        .language = session_.words.language,
        .quality = governor ? "" : session_.qualities.name(),
        .level = governor ? std::int32_t(governor->level()) : -1,
        .picture = now};
}

/// Gives an output the size of its window's picture, or half of it, or a quarter, until the device has room for it.
void FrameLoop::fit(std::size_t output)
{
    const auto size = [&] {
        const vk::Extent2D& extent = screens_.targets()[output].extent;
        return glm::ivec2(extent.width, extent.height);
    };
    for (const glm::ivec2 whole = size();;) {
        try {
            return frame_->resize(output, size());
        } catch (const InputError& error) {
            constexpr int smallest_px = 32;
            const glm::ivec2 smaller = size() / 2;
            if (std::min(smaller.x, smaller.y) < smallest_px)
                throw;
            screens_.draw_smaller(context_.pipelines, output, smaller);
            write_log(LogKind::output_smaller,
                "output '" + session_.layout.outputs[output].name + "' is drawn smaller, " + text_of(smaller)
                    + " pixels scaled up to " + text_of(whole) + ": " + one_line(error.what()));
        }
    }
}

void FrameLoop::begin_commands()
{
    for (vk::raii::CommandBuffer& commands : commands_) {
        commands.reset();
        commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    }
    timer_.begin(*commands_[0]);
    timer_.resume(*commands_[1]);
    device_.timer = device_.trace ? &timer_ : nullptr; // passes are timed between begin and end only
    screens_.begin_pictures(*commands_[1]);
}

void FrameLoop::end_commands()
{
    remotes_view_ = remote_.wants_picture(), guides_view_ = presenter_.wants_view();
    if (const auto copied = remotes_view_ || guides_view_ ? screens_.readable() : std::nullopt) {
        live_.record(*commands_[1], screens_.targets()[*copied]);
        live_output_ = *copied;
    }
    screens_.end_pictures(*commands_[1]);
    device_.timer = nullptr;
    timer_.pause(*commands_[0]);
    timer_.end(*commands_[1]);
    for (const vk::raii::CommandBuffer& commands : commands_)
        commands.end();
}

void FrameLoop::apply_file_changes()
{
    if (session_.loader.changed()) {
        LayoutLoader::Shown shown{.kept = session_.kept,
            .layout = session_.layout,
            .quality = session_.qualities.next(device_),
            .sizes = screens_.sizes(),
            .has_stars = !context_.world.stars.stars.empty()};
        session_.loader.load(std::move(shown));
    }
    std::optional<LayoutLoader::Result> result = session_.loader.result();
    if (!result)
        return;
    try {
        apply(LayoutLoader::loaded_of(*std::move(result)));
    } catch (const InputError& error) {
        const std::string why = one_line(error.what());
        write_log(LogKind::layout_refused, why + "; the exhibit stays as it was");
        // On the head-up display the folder's path would take the reason's place.
        const std::string folder = session_.layout.file.parent_path().string() + "/";
        session_.refused = why.starts_with(folder) ? why.substr(folder.size()) : why;
    }
    if (session_.options.reloaded)
        session_.options.reloaded();
}

void FrameLoop::apply(LayoutLoader::Loaded loaded)
{
    const LimitedWait applying("the changed layout", loading_limit_s);
    session_.service.loads("Applies the changed layout.", loading_limit_s);
    Layout layout = loaded.fresh.file == session_.layout.file ? turned_again(loaded.fresh, session_.kept, session_.layout)
                                                              : loaded.layout;
    std::optional<PreparedLayout> prepared;
    if (changes(loaded.layout, layout).empty()) // else a builder has turned something meanwhile
        prepared = std::move(loaded.prepared);
    frame_
        = exhibit_renderer(context_, layout, session_.qualities.next(device_), session_.options.node, std::move(prepared));
    forget_drawn();
    session_.devices.track(layout.head_tracker);
    if (layout.file != session_.layout.file)
        session_.alignment.reset_moves();
    session_.layout = std::move(layout);
    session_.kept = std::move(loaded.fresh);
    if (master_) {
        master_->adopt(session_.layout, std::move(loaded.digests));
        turned_ = turned_numbers(session_.kept, session_.layout);
    }
    session_.refused.clear();
    session_.qualities.forget_refusals();
    screens_.adopt(session_.layout);
    session_.usage.count([](UsageCounts& counts) { ++counts.layouts; });
    const std::size_t unkept = changes(session_.kept, session_.layout).size();
    write_log(LogKind::layout_applied,
        session_.layout.file.string() + ": applied" + (unkept > 0 ? "; changes made by keys are kept (F5 saves them)" : ""));
}

void FrameLoop::apply_alignment(const Controls& controls)
{
    Layout layout = session_.layout;
    if (!session_.alignment.apply(controls, layout, session_.kept))
        return;
    try {
        std::vector<TurnedNumber> turned;
        if (master_)
            turned = turned_for_machines(session_.kept, layout);
        frame_->adopt(layout); // the device has finished the frame before
        session_.layout = std::move(layout);
        turned_ = std::move(turned);
    } catch (const InputError& error) {
        session_.docent.refusal = session_.alignment.refuse(one_line(error.what())); // a tablet's state has it
    }
}

} // namespace starbow
