#include "session.h"
#include "config/json/reader.h"
#include "config/model/scene_file.h"
#include "menu_pages.h"
#include "runtime/flight/pace.h"
#include "runtime/flight/ship.h"
#include "runtime/operation/log.h"
#include "runtime/operation/messages.h"
#include "runtime/operation/record_files.h"
#include "runtime/operation/vitals.h"
#include "runtime/render/render_context.h"
#include "runtime/world/open_scene.h"
#include "runtime/world/surroundings.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <utility>

namespace starbow {
namespace {

RecordReplay record_replay_of(const ExhibitOptions& options, const Flying& rules)
{
    // An exhibit that attends to its visitors has a record for each visit, which begins with it.
    return {options.record.empty() || options.visiting ? nullptr : recorder_of(options, rules),
        options.replay.empty() ? nullptr : std::make_unique<Replay>(options.replay)};
}

/// A visitor's hands do nothing while a docent holds the exhibit. Devices and the head tracker are read as always. taken:
/// the docent has the stick, and the ship comes to coasting.
void hold(Controls& controls, bool taken)
{
    static_cast<Steering&>(controls) = {.lever = controls.lever, .taken = taken};
    const Head head = controls.head;
    static_cast<Looking&>(controls) = {};
    controls.head = head;
    static_cast<Switches&>(controls)
        = controls - switches_of(Presser::pilot) - switches_of(Presser::visitor) - switches_of(Presser::student);
}

/// The steering of a visitor with one button, which is any but those of the window and of builders.
void scan(Session& session, Controls& controls, std::int64_t dt_ns)
{
    const bool other = (controls & switches_of(Presser::builder)).any() || controls.choose != 0 || controls.turn_by != 0;
    const AnyButton button{.pressed = controls.pressed && !other, .held = controls.held};
    hold(controls, false);
    controls.lever.reset();
    ScannedHands hands;
    const OneButton rules = session.options.one_button.value_or(OneButton());
    if (session.menu.open) {
        const std::vector<MenuPage> pages = menu_of(session);
        const std::size_t page = session.menu.page;
        hands = advance_in_menu(session.scan, rules, button, page, pages[page].items.size(), dt_ns);
    } else if (session.guide && session.guide->asks()) {
        constexpr std::size_t question = 0, no_end = std::size_t(-1); // after the last answer comes the first one
        hands = advance_in_menu(session.scan, rules, button, question, no_end, dt_ns);
    } else if (!visitor_flies(session)) {
        session.scan = {};
        hands.set(Switch::home, button.pressed); // the tour's next step
    } else {
        hands = advance(session.scan, rules, button, dt_ns);
    }
    static_cast<Steering&>(controls) = hands;
    static_cast<Switches&>(controls) = (controls & switches_of(Presser::builder)) | hands;
}

/// In an exhibit that nobody attends to, visitors press every key there is.
void lock_builders_keys(Session& session, Controls& controls)
{
    if (session.keyboard.typed(session.options.visiting->unlock))
        unlock_builders_keys(session);
    if (session.last < session.locked_from)
        return;
    static_cast<AlignmentSteps&>(controls) = {};
    static_cast<Switches&>(controls) = controls - switches_of(Presser::builder) - switches_of(Presser::student);
}

} // namespace

void unlock_builders_keys(Session& session)
{
    session.locked_from = session.last + std::chrono::minutes(10);
    session.alignment.say("The builder's keys are unlocked for ten minutes");
}

Visiting counted_by(const Programme& programme)
{
    return {.idle_s = programme.tour ? programme.tour->again_after_s : Visiting().idle_s, .ask_s = 0, .fade_s = 0};
}

std::string command_name_of(const std::filesystem::path& file)
{
    return (file.extension() == ".json" ? file.stem() : file.filename()).string();
}

void describe(const Session& session, ExhibitState& out)
{
    const Programme& programme = session.programme;
    out.scene = command_name_of(programme.scene), out.shot = command_name_of(programme.shot);
    out.tour = command_name_of(programme.tour_name);
    out.language = session.words.language;
    out.paused = visitor_flies(session) ? session.flight.frozen : session.guide->paused();
    out.fade = session.directions.fades, out.hold = session.directions.holds;
    out.effects = session.flight.effects, out.slow_motion = session.flight.slowness > 0;
    out.information = session.information, out.beside = session.beside;
    out.one_button = session.one_button, out.left_handed = session.left_handed;
    const double rapidity = rapidity_of(session.flight.ship);
    out.speed = std::tanh(rapidity), out.gamma = std::cosh(rapidity);
    out.max_gamma = session.rules.max_gamma;
    out.exposure_ev = session.directions.exposure_ev;
    out.range = session.range;
    out.caption = session.directions.caption;
}

bool visitor_flies(const Session& session) { return !session.guide || session.guide->flies(); }

bool by_one_button(const Session& session)
{
    return session.one_button && in_hand(session.visit) && !session.record_replay.replays() && !session.directions.holds;
}

bool seeks_goals(const Session& session)
{
    return session.information != Information::laboratory && in_hand(session.visit) && !session.guide;
}

bool knows_visitor(const Session& session)
{
    return in_hand(session.visit) && (session.options.visiting || session.visit.touched_ns > 0);
}

void count_visit(Session& session, double length_s)
{
    session.diary.count([&](Tally& tally) { ++tally.visits, tally.visits_s += length_s; });
}

Programme attraction_of(const ExhibitOptions& options, const Words& words, std::size_t number)
{
    const std::vector<std::string>& attract = options.visiting->attract;
    if (attract.empty())
        return options.programme;
    const std::string& name = attract[number % attract.size()];
    return name.ends_with(".jsonl") ? programme_of_record(name) : programme_of_tour(name, words);
}

std::uint64_t digest(const Session& session)
{
    std::string text = session.programme.scene.string() + '\n' + session.programme.tour_name + '\n'
        + session.words("hud.speed") + '\n' + std::to_string(int(session.alignment.pattern()))
        + std::to_string(session.tutorial.lesson) + std::to_string(session.exposure.locked) + std::to_string(session.range)
        + std::to_string(session.history.empty()) + std::to_string(session.lab.shows_anything())
        + std::to_string(session.menu.open) + std::to_string(int(session.information)) + std::to_string(int(session.beside))
        + std::to_string(session.goals.current) + std::to_string(session.one_button) + std::to_string(session.left_handed);
    return digest(text, digest(session.flight));
}

Flying rules_in(const ExhibitOptions& options, Flying rules, const Programme& programme)
{
    // A record's rules have those of its first world.
    const bool bounded = options.visiting || options.rules.boundary, paced = options.paced_flight || options.rules.pace;
    const SceneFile scene = open_scene(programme.scene);
    rules.solids = solid_globes(scene);
    if (options.exposure.calm)
        rules = calm_rules(rules);
    if (bounded)
        rules.boundary = scene.boundary;
    rules.pace.reset();
    if (paced && scene.planned)
        rules.pace
            = pace_for(*scene.planned, things_at_rest(scene), scene.start, options.rules, scene.seconds_per_time_unit());
    return rules;
}

std::unique_ptr<Recorder> recorder_of(const ExhibitOptions& options, const Flying& rules)
{
    return std::make_unique<Recorder>(options.record,
        header_of(options.programme.scene, options.layout, options.programme.start, rules, options.exposure,
            pattern_names[std::size_t(options.pattern)]),
        write_log);
}

Session::Session(const ExhibitOptions& given)
    : options(given)
    , visiting(given.visiting.value_or(counted_by(given.programme)))
    , visit(given.visiting ? Visit{} : begun({}))
    , one_button(given.one_button.has_value())
    , left_handed(given.left_handed)
    , programme(given.visiting ? attraction_of(given, given.words, 0) : given.programme)
    , words(given.words)
    , information(given.information)
    , rules(given.replay.empty() ? rules_in(given, given.rules, programme) : given.rules)
    , quality(given.quality)
    , quality_name(given.quality_name)
    , layout(given.layout)
    , kept(layout)
    , loader(layout)
    , guide(guide_of(programme, rules, !given.visiting))
    , shown_record(programme.record.empty() ? nullptr : std::make_unique<ShownRecord>(programme.record))
    , flight(flight_at(programme.start, rules))
    , range(given.exposure.mode == ExposureMode::range)
    , tutorial(tutorial_at(flight))
    , record_replay(record_replay_of(given, rules))
    , hid(given.profiles, write_log)
    , tracker(tracker_of(layout))
    , alignment(given.pattern)
    , lab(given.log, given.log_every_s, words)
    , speaker(given.speech ? std::make_unique<Speaker>() : nullptr)
    , diary(given.state, given.textfile)
    , governor(governor_of(given))
{
}

std::optional<Guide> guide_of(const Programme& programme, const Flying& rules, bool visitors)
{
    if (!programme.tour)
        return {};
    return Guide(*programme.tour, rules, open_scene(programme.scene).seconds_per_time_unit(), visitors);
}

std::optional<Governor> governor_of(const ExhibitOptions& options)
{
    if (options.frame_budget_ms <= 0)
        return {};
    return Governor(options.ladder, options.frame_budget_ms);
}

std::unique_ptr<HeadTracker> tracker_of(const Layout& layout)
{
    return layout.head_tracker ? std::make_unique<HeadTracker>(*layout.head_tracker, write_log) : nullptr;
}

std::string describe(const Skew& skew)
{
    std::array<char, 96> text;
    std::snprintf(text.data(), text.size(), "outputs %s together within %.2f ms, at worst %.2f ms",
        skew.on_screen ? "shown" : "handed over", 1e3 * skew.median_s(), 1e3 * skew.worst_s());
    return text.data();
}

double wait_limit_s(const Service& service)
{
    // Without a watchdog nothing starts the exhibit again, and a slow frame is better than none.
    return service.watchdog_s() ? 0.8 * *service.watchdog_s() : 20;
}

std::optional<SpectralLevel> spectral_level_of(const Session& session)
{
    if (session.governor)
        return session.governor->ladder()[0].quality.spectra;
    return session.quality ? session.quality->spectra : std::nullopt;
}

void log_world(const RenderContext& context)
{
    for (const std::string& note : context.world.world.notes)
        write_log(LogKind::world_note, context.world.scene.gltf.string() + ": " + note);
    print_message(describe_light(context));
}

std::optional<SpectralLevel> spectral_level_of(const ExhibitOptions& options)
{
    if (const std::optional<Governor> governor = governor_of(options))
        return governor->ladder()[0].quality.spectra;
    return options.quality ? options.quality->spectra : std::nullopt;
}

Quality quality_of(const Session& session, const Device& device)
{
    if (session.governor)
        return within(device, session.governor->ladder()[session.governor->level()].quality);
    return session.quality ? within(device, *session.quality) : default_quality(device, false);
}

bool take_coarser_level(Session& session, std::size_t level, const std::string& reason)
{
    if (!session.governor || !session.governor->refuse(level))
        return false;
    write_log(LogKind::level_no_room,
        "level " + std::to_string(level + 1) + " of " + std::to_string(session.governor->ladder().size())
            + " has no room on the GPU (" + one_line(reason) + "); level " + std::to_string(session.governor->level() + 1)
            + " is drawn, and that one is not tried again before the layout or a window's size changes");
    return true;
}

bool shows_pins(const Session& session) { return !session.pins.empty() && session.alignment.pattern() != Pattern::none; }

Device::Options device_of(const ExhibitOptions& options)
{
    Device::Options device = device_options(true);
    device.counted = options.counts_driver_memory, device.barrier = options.machines.has_value();
    return device;
}

std::string steps_of(const Session& session)
{
    std::string missing;
    for (const MachineHealth& machine : session.machines)
        if (!machine.in_step)
            missing += (missing.empty() ? "" : ", ") + machine.name;
    return missing.empty() ? "" : "not in step: " + missing;
}

std::string screens_of(const Session& session)
{
    constexpr std::size_t most_in_a_line = 4; // more would be too small to be read
    const std::vector<MachineHealth>& machines = session.machines;
    const std::string times = machines.size() <= most_in_a_line
        ? line_of(machines)
        : "the slowest is " + line_of({*std::ranges::max_element(machines, {}, &MachineHealth::frame_ms)});
    return std::to_string(in_step(machines)) + " of " + std::to_string(machines.size()) + " machines in step, "
        + (session.barrier.value_or(false) ? "in the same refresh (present barrier)" : "at most one refresh apart") + "; "
        + times;
}

std::string notice_of(const Session& session)
{
    if (!session.alignment.says().empty())
        return session.alignment.says();
    if (!session.refused.empty())
        return session.refused;
    if (const std::string trouble = session.hid.trouble(); !trouble.empty())
        return trouble;
    if (!session.lacks.empty())
        return session.lacks;
    if (const std::string steps = steps_of(session); !steps.empty())
        return steps;
    if (session.tracker && !session.tracker->heard(Session::Clock::now()))
        return "no head tracker is heard on port " + std::to_string(session.tracker->tracking().port);
    if (session.governor)
        return describe(*session.governor);
    return session.skew.frames() > 0 ? describe(session.skew) : "";
}

const std::optional<RangeCurve>& curve_of(const Session& session) { return session.range_mode.follower.shown; }

/// The visitor's change of the exposure, EV.
static double visitors_ev(const Session& session)
{
    return session.guide ? session.guide->brighter_ev() : session.flight.exposure_ev - session.programme.start.exposure_ev;
}

/// The exposure without a docent's change, EV.
static double undirected_ev(const Session& session)
{
    const Exposing& rules = session.options.exposure;
    return session.guide
        ? session.guide->shown_ev(session.exposure, rules)
        : shown_ev(session.exposure, rules, session.flight.exposure_ev, session.programme.start.exposure_ev);
}

double ev_of(const Session& session)
{
    if (session.calm_ev.value)
        return *session.calm_ev.value;
    return (curve_of(session) ? visitors_ev(session) : undirected_ev(session)) + session.directions.exposure_ev;
}

/// Steps the curve that shows everything at once. The record's entry holds what it follows.
static void follow_range(Session& session, RecordEntry& entry, const Metered& metered, double dt_s)
{
    session.range ^= entry.controls[Switch::range];
    if (session.record_replay.replays())
        session.range = entry.ranged;
    entry.ranged = session.range;
    if (!session.range) {
        session.range_mode = {};
        return;
    }
    const bool locked = session.exposure.locked;
    if (!session.record_replay.replays() && (!locked || !session.range_mode.wanted) && wants_goal(session.range_mode, dt_s))
        entry.range_goal = range_goal(metered.surfaces, metered.stars, undirected_ev(session) - visitors_ev(session));
    session.range_mode = advance(std::move(session.range_mode), entry.range_goal, dt_s, locked);
}

bool is_over(const Session& session)
{
    const ExhibitOptions& options = session.options;
    return session.directions.restarts || (options.frames > 0 && session.shown >= options.frames)
        || (options.over && options.over());
}

/// Duration of a fade to black, s.
constexpr double to_black_s = 1.5;
/// A calm exhibit's fastest way to black and back, its part in a second.
constexpr double black_per_s = 2;

bool read_controls(Session& session, std::span<GLFWwindow* const> windows, RecordEntry& entry)
{
    const Session::Clock::time_point now = Session::Clock::now();
    Controls& controls = entry.controls;
    // A stall of the machine must make neither the ship nor the look leap.
    const std::chrono::nanoseconds passed = now - session.last;
    entry.dt_ns = std::min<std::int64_t>(passed.count(), 100'000'000);
    entry.skipped_ns = passed.count() - entry.dt_ns;
    const double dt_s = 1e-9 * double(entry.dt_ns);
    session.desktop_saver.keep_away();
    controls = session.keyboard.read(windows, session.display.keyboard_grabbed(windows),
        std::chrono::nanoseconds(now - session.began).count(), dt_s, session.hid.kinds(), session.left_handed);
    session.hid.left_handed(session.left_handed);
    session.hid.add(dt_s, controls);
    if (session.tracker)
        controls.head = session.tracker->read(now);
    session.last = now;
    if (session.options.visitor)
        session.options.visitor(entry);
    session.somebody = session.presence.take(controls, dt_s);
    if (session.options.visiting)
        lock_builders_keys(session, controls);
    if (!session.options.log.empty())
        controls.set(Switch::slow_motion, false); // a laboratory's seconds are the ship's
    const bool quits = controls[Switch::quit];
    if (session.directions.holds || (session.options.visiting && !in_hand(session.visit)))
        hold(controls, session.directions.holds);
    else if (by_one_button(session))
        scan(session, controls, entry.dt_ns);
    if (session.options.exposure.calm)
        controls = session.calm_hands.let_through(controls, dt_s, session.rules.comfort.turn_steps_deg > 0);
    return !quits;
}

void count_frame(Session& session, double frame_s, double refresh_hz)
{
    session.frame_s = session.frame_s > 0 ? glm::mix(session.frame_s, frame_s, 0.05) : frame_s;
    session.diary.count([&](Tally& tally) { tally.add_frame(frame_s, frame_s * refresh_hz > 1.5); });
}

bool turn_diary(Session& session, std::size_t outputs_shown, std::size_t pipelines)
{
    const Session::Clock::time_point now = Session::Clock::now();
    if (now - session.turned < std::chrono::seconds(1))
        return false;
    session.turned = now;
    const Vitals own = vitals();
    const double skew_s = session.skew.take_worst_s();
    const std::size_t unplugged = session.hid.unplugged();
    session.diary.count([&](Tally& tally) {
        tally.resident_bytes = std::max<std::uint64_t>(tally.resident_bytes, own.resident_bytes);
        tally.worst_skew_s = std::max(tally.worst_skew_s, skew_s);
        tally.unplugged += unplugged - session.unplugged;
        if (session.visited_s > 0)
            tally.scenes_s[session.programme.scene.stem()] += session.visited_s;
    });
    session.visited_s = 0;
    session.unplugged = unplugged;
    return session.diary.turn(std::time(nullptr),
        {.uptime_s = seconds(now - session.began),
            .resident_bytes = own.resident_bytes,
            .files = own.files,
            .threads = own.threads,
            .devices = session.hid.kinds().size(),
            .worn_axes = session.hid.ignored_axes(),
            .outputs_shown = outputs_shown,
            .outputs = session.layout.outputs.size(),
            .pipelines = pipelines,
            .machines = session.machines,
            .version = session.options.version});
}

/// Dims a calm exhibit's picture where it would flash. before: of the picture before.
static void guard_light(Session& session, RecordEntry& entry, const Metered& before, double dt_s)
{
    if (session.record_replay.replays()) {
        session.calm_light = entry.light;
        return;
    }
    const std::optional<RangeCurve>& curve = curve_of(session);
    const double gain = std::exp2(session.drawn_ev);
    session.flash_guard.take(
        before.surfaces, before.across,
        [&](double luminance) { return gain * (curve ? std::exp2(curve->at(std::log2(luminance))) : luminance); }, dt_s);
    entry.light = session.calm_light = session.flash_guard.light();
}

/// Limits the turns of a calm exhibit's exposure and of its way to black.
void keep_calm(Session& session, double dt_s)
{
    session.calm_black = followed(session.calm_black, session.black, dt_s, black_per_s, 0);
    session.black = *session.calm_black.value;
    SlowTurns before = std::exchange(session.calm_ev, {});
    const bool ranged = curve_of(session).has_value();
    if (std::exchange(session.calm_range, ranged) != ranged)
        before = {}; // a leap, as each switch is
    // A tour shows its own exposures; the first view of a world is exposed at once.
    if ((session.exposure.ev || !session.options.exposure.automatic) && visitor_flies(session))
        session.calm_ev = calmed_ev(before, ev_of(session), dt_s);
}

void seek_goals(Session& session, const SceneFile& scene, std::int64_t dt_ns)
{
    if (seeks_goals(session) && !session.flight.frozen)
        session.goals = advance(session.goals, scene.goals, session.flight.ship, ship_at(session.programme.start),
            scene.seconds_per_time_unit(), dt_ns);
}

/// Adapts at once where the picture has leapt. Returns true if it has: what was metered then belongs to another picture.
static bool follow_leap(Session& session)
{
    const Leaps leaps = session.flight.leaps;
    const std::optional<Leaps> before = std::exchange(session.leaps, leaps);
    if (before == leaps)
        return false;
    if (before && before->begun == leaps.begun) {
        session.exposure.leapt = true;
        return true;
    }
    session.exposure = {}, session.calm_ev = {};
    session.begun_ev = session.guide ? session.flight.exposure_ev : session.programme.start.exposure_ev;
    session.range_mode.follows_at_once = true;
    return true;
}

void step(Session& session, RecordEntry& entry, const Metered& before, double seconds_per_time_unit)
{
    const Exposing& exposing = session.options.exposure;
    const Shot& start = session.programme.start;
    const Controls& controls = entry.controls;
    const double dt_s = 1e-9 * double(entry.dt_ns);
    if (exposing.calm)
        guard_light(session, entry, before, dt_s);
    const bool toured = session.guide && !session.guide->over();
    session.flight = session.guide ? session.guide->flown(controls, entry.dt_ns)
        : session.shown_record
        ? session.shown_record->flown(entry.dt_ns)
        : flown(session.flight, session.history, controls, entry.dt_ns, session.rules, seconds_per_time_unit, start);
    session.leapt = follow_leap(session);
    const Metered metered = session.leapt ? Metered() : before;
    session.exposure.locked ^= controls[Switch::lock_exposure];
    if (controls[Switch::information])
        session.information = after(session.information);
    if (controls[Switch::beside])
        session.beside = after(session.beside);
    if (session.record_replay.replays())
        session.exposure = adapted_to(session.exposure, entry.exposure_ev, exposing, session.begun_ev);
    else
        session.exposure = adapted(session.exposure, metered.ev, dt_s, exposing, session.begun_ev);
    entry.exposure_ev = session.exposure.ev;
    follow_range(session, entry, metered, dt_s);
    session.record_replay.keep(entry, session.flight);
    session.tutorial = advance(session.tutorial, controls, session.flight, dt_s);
    if (toured && session.guide->over() && in_hand(session.visit))
        session.diary.count([](Tally& tally) { ++tally.tours_finished; });
    Directions& directions = session.directions;
    directions.fade = std::clamp(directions.fade + (directions.fades ? dt_s : -dt_s) / to_black_s, 0.0, 1.0);
    session.black = std::max({directions.fade, session.home_black, blackness(session.visit, session.visiting)});
    if (exposing.calm)
        keep_calm(session, dt_s);
    session.drawn_ev = ev_of(session);
}

} // namespace starbow
