#include "hud_updater.h"
#include "menu_pages.h"
#include <cmath>

namespace starbow {

/// True while the choices of one-button flying are shown in turn.
static bool scans(const Session& session) { return by_one_button(session) && session.source->by_hand(); }

std::optional<HudText> HudUpdater::update(const Session& session, const SceneFile& scene, double exposure_ev)
{
    const Clock::time_point now = Clock::now();
    const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
    ++frames_;
    if (const double passed = seconds(now - since_); passed > 0.5) {
        rate_ = frames_ / passed;
        frames_ = 0, since_ = now;
    }
    if (seconds(now - written_at_) > 0.1) {
        written_ = {written_.number + 1, readings_of(session, scene, exposure_ev)};
        written_at_ = now;
    }
    const bool covers_pattern
        = session.alignment.pattern() != Pattern::none && session.alignment.says().empty() && !shows_pins(session);
    const bool asks = session.attendance.seconds_left().has_value() || session.menu.open || scans(session);
    return (session.flight().hud || asks) && !covers_pattern ? std::optional(written_) : std::nullopt;
}

/// Says a sentence in the place of a caption; below the choices of one button, which go on.
static void say(const std::string& text, bool flying, Readings& shown)
{
    if (shown.caption && shown.caption->menu)
        shown.caption->aside = text;
    else
        shown.caption = Caption{.text = text, .flying = flying};
}

/// Adds the visit's line, in the place of a tour's caption or below it.
static void add_visit(const Session& session, Readings& shown)
{
    const Words& words = session.words;
    const Attendance& attendance = session.attendance;
    const Flight& flight = session.flight();
    if (const auto left = attendance.seconds_left()) {
        const Key key = attendance.visit().phase == VisitPhase::asking ? "visit.asking"_key : "visit.ending"_key;
        shown.caption = Caption{.text = words(key, {{"left", std::to_string(int(std::ceil(*left)))}})};
    } else if (flight.homing && flight.homing->from_boundary) {
        say(words("visit.boundary"), true, shown);
    } else if (flight.homeward) {
        say(words("visit.homeward"), true, shown);
    } else if (session.docent.holds()) {
        if (shown.caption) // a tour's text, which the guide speaks to
            shown.caption->aside = words("visit.held");
        else
            say(words("visit.held"), true, shown);
    } else if (attendance.attends() && !attendance.in_hand()) {
        const std::string& begin
            = words(session.devices.hid().capabilities().stick ? "visit.begin_stick"_key : "visit.begin_keys"_key);
        // Large for some seconds, and small beside the tour's caption, which passers-by read meanwhile.
        constexpr std::int64_t turn_ns = 12'000'000'000, large_ns = 4'000'000'000;
        shown.prompt.clear();
        if (shown.caption && attendance.visit().phase_ns % turn_ns >= large_ns)
            shown.caption->aside = begin;
        else
            shown.caption = Caption{.text = begin};
    }
}

Readings HudUpdater::readings_of(const Session& session, const SceneFile& scene, double exposure_ev) const
{
    const Words& words = session.words;
    const InputCapabilities capabilities = session.devices.hid().capabilities();
    const bool by_hand = session.source->by_hand();
    const Flight& flight = session.flight();
    Readings shown = readings(flight, scene, by_hand ? session.rules.comfort : Comfort());
    shown.frames_per_s = rate_;
    show_on(session.choices.information, session.content.start.time * scene.seconds_per_time_unit(), shown);
    shown.mode = flight.mode, shown.frozen = flight.frozen, shown.lever = flight.lever;
    if (const TourPlayer* tour = session.tour()) {
        shown.prompt = tour->prompt(words);
        shown.caption = tour->caption(words, capabilities);
        if (shown.caption && by_one_button(session) && !by_hand)
            shown.caption->aside = words(tour->asks() ? "scan.press_in_question"_key : "scan.press_on"_key,
                {{"left", std::to_string(int(std::ceil(tour->left_s())))}});
    } else if (session.options.tutorial)
        shown.prompt = prompt(session.tutorial, capabilities, words);
    if (shown.prompt.empty() && seeks_goals(session))
        shown.prompt = goal_line(session.goals, scene.goals, words);
    if (flight.time_scale > 0) {
        const double board_s = time_rates[flight.time_scale];
        shown.prompt = words("hud.slow_motion",
            {{"board", shown_duration(board_s, words, 2)}, {"world", shown_duration(board_s * shown.gamma, words, 2)}});
    }
    if (!session.coming.empty())
        shown.prompt = words("menu.coming", {{"world", session.words.title("scene", session.coming)}});
    if (scans(session)) // a tour's caption of the flight speaks of keys and buttons that this visitor does not have
        shown.caption = caption_of(session.hands.scan(), session.options.one_button.value_or(OneButton()), words);
    add_visit(session, shown);
    if (session.menu.open)
        shown.caption = caption_of(session.menu, menu_of(session), words, capabilities, session.choices.one_button);
    if (shows_pins(session))
        shown.caption = Caption{.text = session.pins};
    else if (!session.docent.caption().empty())
        say(session.docent.caption(), by_hand, shown);
    if (shown.caption && !shown.caption->flying)
        shown.lever.reset();
    shown.exposure_ev = exposure_ev, shown.exposure_locked = session.light.locked();
    shown.filtered = session.light.filtered();
    if (const std::optional<RangeCurve>& curve = session.light.curve())
        shown.range = Readings::Range{curve->stops(), curve->shown_stops()};
    shown.notice = notice_of(session);
    return shown;
}

} // namespace starbow
