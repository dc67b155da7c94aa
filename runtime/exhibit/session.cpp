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
#include "runtime/visit/doing.h"
#include "runtime/visit/hand_flight.h"
#include "runtime/visit/shown_record.h"
#include "runtime/world/open_scene.h"
#include "runtime/world/surroundings.h"
#include "session_commands.h"
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

/// The place in which one-button flying is used; none: the visitor flies with all controls.
std::optional<OneButtonPlace> one_button_place(const Session& session)
{
    using Kind = OneButtonPlace::Kind;
    if (!by_one_button(session))
        return {};
    if (session.menu.open) {
        const std::size_t page = session.menu.page;
        return OneButtonPlace{Kind::list, page, menu_of(session)[page].items.size()};
    }
    if (session.tour() && session.tour()->asks()) {
        constexpr std::size_t no_end = std::size_t(-1); // after the last answer comes the first one
        return OneButtonPlace{Kind::list, 0, no_end};
    }
    return OneButtonPlace{session.source->by_hand() ? Kind::flight : Kind::tour};
}

HandsRules hands_rules_of(const ExhibitOptions& options)
{
    return {.locks = options.visiting.has_value(),
        .laboratory = !options.log.empty(),
        .calm = options.exposure.calm,
        .turns_by_steps = options.rules.comfort.turn_steps_deg > 0,
        .one_button = options.one_button.value_or(OneButton())};
}

} // namespace

Visiting counted_by(const SessionContent& content)
{
    return {.idle_s = content.tour ? content.tour->again_after_s : Visiting().idle_s, .ask_s = 0, .fade_s = 0};
}

std::string command_name_of(const std::filesystem::path& file)
{
    return (file.extension() == ".json" ? file.stem() : file.filename()).string();
}

void describe(const Session& session, ExhibitState& out)
{
    const SessionContent& content = session.content;
    out.scene = command_name_of(content.scene), out.shot = command_name_of(content.shot);
    out.tour = command_name_of(content.tour_name);
    static_cast<Choices&>(out) = session.choices;
    const Flight& flight = session.flight();
    out.coming = session.coming;
    out.doing = session.record_replay.replays() ? Doing::replays
                                                : doing_of(session.attendance, *session.source, !content.record.empty());
    const TourPlayer* tour = session.tour();
    const bool runs = tour && !tour->over();
    out.step = runs ? int(tour->step()) + 1 : 0, out.steps = runs ? int(tour->steps().size()) : 0;
    out.left_s = runs ? tour->left_s() : 0;
    out.next_caption.clear();
    const std::size_t next = runs ? tour->step() + 1 : 0;
    for (const auto& [language, texts] : session.announcements)
        if (runs && next < texts.size() && !texts[next].empty())
            out.next_caption.emplace_back(language, texts[next]);
    out.item = session.item, out.items = session.options.programme ? int(session.options.programme->items.size()) : 0;
    out.item_s = session.item > 0 ? seconds(Session::Clock::now() - session.item_began) : 0;
    out.calm = session.options.exposure.calm;
    out.paused = session.source->paused();
    out.as_saved = session.alignment.as_saved();
    out.fade = session.docent.fades(), out.hold = session.docent.holds();
    out.effects = flight.effects, out.slow_motion = flight.time_scale > 0;
    const double rapidity = rapidity_of(flight.ship);
    out.speed = std::tanh(rapidity), out.gamma = std::cosh(rapidity);
    out.max_gamma = session.rules.max_gamma;
    out.exposure_ev = session.docent.exposure_ev();
    out.caption = session.docent.caption();
}

Choices first_choices(const ExhibitOptions& options)
{
    return {.language = options.words.language,
        .information = options.information,
        .range = options.exposure.mode == ExposureMode::range,
        .one_button = options.one_button.has_value(),
        .left_handed = options.left_handed};
}

bool by_one_button(const Session& session)
{
    return session.choices.one_button && session.attendance.in_hand() && !session.record_replay.replays()
        && !session.docent.holds();
}

bool seeks_goals(const Session& session)
{
    return session.choices.information != Information::laboratory && session.attendance.in_hand() && !session.tour();
}

void count_visit(Session& session, double length_s)
{
    session.usage.count([&](UsageCounts& counts) { ++counts.visits, counts.visits_s += length_s; });
}

SessionContent attraction_of(const ExhibitOptions& options, const Words& words, std::size_t number)
{
    const std::vector<std::string>& attract = options.visiting->attract;
    if (attract.empty())
        return options.content;
    const std::string& name = attract[number % attract.size()];
    return name.ends_with(".jsonl") ? content_of_record(name) : content_of_tour(name, words);
}

std::uint64_t digest(const Session& session)
{
    const auto& [language, information, inset, sky_names, range, filter, one_button, left_handed] = session.choices;
    std::string text = session.content.scene.string() + '\n' + session.content.tour_name + '\n' + language + '\n'
        + session.words("hud.speed") + '\n';
    for (const int number : {int(session.alignment.pattern()), session.tutorial.lesson, int(session.light.locked()),
             int(session.lab.shows_anything()), int(session.menu.open), int(information), int(inset), int(sky_names),
             int(range), int(filter), int(one_button), int(left_handed), int(session.goals.current)})
        text += std::to_string(number) + ' ';
    return digest(text, digest(session.flight()));
}

Flying rules_in(const ExhibitOptions& options, Flying rules, const SessionContent& content)
{
    // A record's rules have those of its first world.
    const bool bounded = options.visiting || options.rules.boundary, paced = options.paced_flight || options.rules.pace;
    const SceneFile scene = open_scene(content.scene);
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
        header_of(options.content.scene, options.layout, options.content.start, rules, options.exposure,
            pattern_names[std::size_t(options.pattern)]),
        write_log);
}

std::vector<Announcements> announced_on(const ExhibitOptions& options, const SessionContent& content)
{
    return announcements_of(options.remote.port > 0 ? content.tour_name : "");
}

Session::Session(const ExhibitOptions& given)
    : options(given)
    , attendance(given.visiting.value_or(counted_by(given.content)), given.visiting.has_value())
    , choices(first_choices(given))
    , words(given.words)
    , content(given.visiting ? attraction_of(given, given.words, 0) : given.content)
    , announcements(announced_on(given, content))
    , rules(given.replay.empty() ? rules_in(given, given.rules, content) : given.rules)
    , source(source_of(content, rules, {!given.visiting, given.speech, given.layout.surrounds}))
    , tutorial(tutorial_at(flight()))
    , record_replay(record_replay_of(given, rules))
    , devices(given.profiles, given.layout.head_tracker, write_log)
    , hands(hands_rules_of(given))
    , light(given.exposure)
    , qualities(given)
    , layout(given.layout)
    , kept(layout)
    , loader(layout)
    , alignment(given.pattern)
    , lab(given.log, given.log_every_s, given.by_eye, words)
    , speaker(given.speech ? std::make_unique<Speaker>() : nullptr)
    , usage(given.state, given.textfile)
{
}

std::unique_ptr<FlightSource> source_of(const SessionContent& content, const Flying& rules, const Staging& staging)
{
    if (!content.record.empty() && !staging.visitors)
        return std::make_unique<ShownRecord>(content.record);
    const double unit_s = open_scene(content.scene).seconds_per_time_unit();
    if (content.tour)
        return std::make_unique<TourPlayer>(*content.tour, rules, unit_s, staging);
    return std::make_unique<HandFlight>(content.start, rules, unit_s);
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

void log_world(const RenderContext& context)
{
    for (const std::string& note : context.world.world.notes)
        write_log(LogKind::world_note, context.world.scene.gltf.string() + ": " + note);
    print_message(describe_light(context));
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
    if (const std::string trouble = session.devices.hid().trouble(); !trouble.empty())
        return trouble;
    if (!session.lacks.empty())
        return session.lacks;
    if (const std::string steps = steps_of(session); !steps.empty())
        return steps;
    if (const HeadTracker* tracker = session.devices.tracker(); tracker && !tracker->heard(Session::Clock::now()))
        return "no head tracker is heard on port " + std::to_string(tracker->tracking().port);
    if (const std::optional<Governor>& governor = session.qualities.governor())
        return describe(*governor);
    return session.skew.frames() > 0 ? describe(session.skew) : "";
}

bool is_over(const Session& session)
{
    const ExhibitOptions& options = session.options;
    return session.docent.restarts() || (options.frames > 0 && session.shown >= options.frames)
        || (options.over && options.over());
}

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
    session.devices.write(session.lab.writes());
    controls = session.devices.read(windows, session.display.keyboard_grabbed(windows),
        std::chrono::nanoseconds(now - session.began).count(), dt_s, session.choices.left_handed, now);
    session.lab.type(session.devices.take_written());
    session.last = now;
    if (session.options.visitor)
        session.options.visitor(entry);
    const bool attends = session.attendance.attends();
    if (attends && session.devices.typed(session.options.visiting->unlock))
        unlock_builders_keys(session);
    controls = session.hands.advance({.devices = controls,
        .dt_ns = entry.dt_ns,
        .in_hand = !attends || session.attendance.in_hand(),
        .held = session.docent.holds(),
        .one_button = one_button_place(session)});
    return !controls[Switch::quit];
}

void count_frame(Session& session, double frame_s, double refresh_hz)
{
    session.frame_s = session.frame_s > 0 ? glm::mix(session.frame_s, frame_s, 0.05) : frame_s;
    session.usage.count([&](UsageCounts& counts) { counts.add_frame(frame_s, frame_s * refresh_hz > 1.5); });
}

bool turn_usage(Session& session, std::size_t outputs_shown, std::size_t pipelines)
{
    const Session::Clock::time_point now = Session::Clock::now();
    if (now - session.turned < std::chrono::seconds(1))
        return false;
    session.turned = now;
    const Vitals own = vitals();
    const double skew_s = session.skew.take_worst_s();
    const Hid& hid = session.devices.hid();
    const std::size_t unplugged = hid.unplugged();
    const double visited_s = session.attendance.take_visited_s();
    session.usage.count([&](UsageCounts& counts) {
        counts.resident_bytes = std::max<std::uint64_t>(counts.resident_bytes, own.resident_bytes);
        counts.worst_skew_s = std::max(counts.worst_skew_s, skew_s);
        counts.unplugged += unplugged - session.unplugged;
        if (visited_s > 0)
            counts.scenes_s[session.content.scene.stem()] += visited_s;
    });
    session.unplugged = unplugged;
    return session.usage.turn(std::time(nullptr),
        {.uptime_s = seconds(now - session.began),
            .resident_bytes = own.resident_bytes,
            .files = own.files,
            .threads = own.threads,
            .devices = hid.kinds().size(),
            .worn_axes = hid.ignored_axes(),
            .outputs_shown = outputs_shown,
            .outputs = session.layout.outputs.size(),
            .pipelines = pipelines,
            .machines = session.machines,
            .version = session.options.version});
}

void seek_goals(Session& session, const SceneFile& scene, std::int64_t dt_ns)
{
    if (seeks_goals(session) && !session.flight().frozen)
        session.goals = advance(session.goals, scene.goals, session.flight().ship, ship_at(session.content.start),
            scene.seconds_per_time_unit(), dt_ns);
}

void step(Session& session, RecordEntry& entry, const Metered& metered)
{
    const Controls& controls = entry.controls;
    const double dt_s = 1e-9 * double(entry.dt_ns);
    const bool over = session.source->over();
    session.source->advance(controls, entry.dt_ns);
    if (session.tour() && session.source->over() && !over && session.attendance.in_hand())
        session.usage.count([](UsageCounts& counts) { ++counts.tours_finished; });
    apply(session.choices, controls);
    const bool replays = session.record_replay.replays();
    if (replays)
        session.choices.range = entry.ranged;
    entry.ranged = session.choices.range;
    session.docent.advance(dt_s);
    session.pointer.advance(dt_s);
    session.light.advance(entry,
        {.source = *session.source,
            .metered = metered,
            .range = session.choices.range,
            .filter = session.choices.filter,
            .locks = controls[Switch::lock_exposure],
            .replays = replays,
            .fade = std::max(session.docent.fade(), session.attendance.fade()),
            .directed_ev = session.docent.exposure_ev(),
            .dt_s = dt_s});
    session.record_replay.keep(entry, session.flight());
    session.tutorial = advance(session.tutorial, controls, session.flight(), dt_s);
}

} // namespace starbow
