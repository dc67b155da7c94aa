#include "obey.h"
#include "config/json/reader.h"
#include "config/model/shipped.h"
#include "runtime/operation/last_language.h"
#include <algorithm>

namespace starbow {
namespace {

/// The flight whose switches a docent may set: a tour shows its own effects until the visitor flies.
Flight& flight_of(Session& session)
{
    if (!session.guide)
        return session.flight;
    if (!session.guide->flies())
        throw InputError("a tour shows its own effects; a tour's end, or a scene, is right");
    return session.guide->flight();
}

/// The same tour in other words keeps its step and its time.
void set_words(Session& session, Words words)
{
    if (session.programme.tour)
        *session.programme.tour = tour_in(session.programme.tour_name, words);
    session.words = std::move(words);
}

void step_tour(const Session& session, Controls& controls, Switch by)
{
    if (!session.guide || session.guide->over())
        throw InputError("no tour with steps is shown; the command tour is right");
    controls.set(by);
}

void limit_speed(Session& session, double max_gamma)
{
    session.rules.max_gamma = max_gamma;
    if (session.guide)
        session.guide->limit(max_gamma);
}

} // namespace

void obey(Session& session, const Command& command, Controls& controls)
{
    switch (command.kind) {
    case CommandKind::fade:
        session.directions.fades = command.on;
        break;
    case CommandKind::stop:
        if (!visitor_flies(session))
            session.guide->pause(true);
        else
            controls.set(Switch::stop);
        break;
    case CommandKind::next:
        step_tour(session, controls, Switch::home);
        break;
    case CommandKind::back:
        step_tour(session, controls, Switch::undo);
        break;
    case CommandKind::pause:
        if (!visitor_flies(session))
            session.guide->pause(command.on);
        else
            controls.set(Switch::freeze, session.flight.frozen != command.on);
        break;
    case CommandKind::speed_limit:
        limit_speed(session, command.number);
        break;
    case CommandKind::exposure:
        session.directions.exposure_ev = command.number;
        break;
    case CommandKind::range:
        session.range = command.on;
        break;
    case CommandKind::effect:
    case CommandKind::comparison:
        apply(flight_of(session).effects, command);
        break;
    case CommandKind::slow_motion:
        flight_of(session).slowness = command.on && session.options.log.empty() ? 1 : 0;
        break;
    case CommandKind::one_button:
        session.one_button = command.on;
        session.scan = {};
        break;
    case CommandKind::left_handed:
        session.left_handed = command.on;
        break;
    case CommandKind::language:
        set_words(session, words_in(command.text));
        keep_language(session.options.state, command.text);
        break;
    case CommandKind::beside:
        session.beside = beside_named(command.text);
        break;
    case CommandKind::information:
        session.information = information_named(command.text);
        break;
    case CommandKind::caption:
        session.directions.caption = command.text;
        break;
    case CommandKind::hold:
        session.directions.holds = command.on;
        break;
    case CommandKind::pattern:
        session.alignment.show(pattern_named(command.text));
        break;
    case CommandKind::unlock:
        if (!session.options.visiting)
            throw InputError("no key is locked here; an exhibit with \"visit\" in its file is right");
        unlock_builders_keys(session);
        break;
    case CommandKind::restart:
        session.directions.restarts = true;
        break;
    case CommandKind::reset:
    case CommandKind::tour:
    case CommandKind::scene:
    case CommandKind::shot:
    case CommandKind::layout:
    case CommandKind::quality:
        break; // the frame loop's
    }
}

Programme programme_after(const Session& session, const Command& command)
{
    switch (command.kind) {
    case CommandKind::scene:
        return programme_of_scene(command.text);
    case CommandKind::shot:
        return programme_of_shot(command.text);
    case CommandKind::tour:
        return programme_of_tour(command.text, session.words);
    default:
        return session.options.programme;
    }
}

void begin_programme(Session& session, Programme programme, bool visitors)
{
    session.guide.reset(); // it refers to the programme
    session.programme = std::move(programme);
    session.rules = rules_in(session.options, session.rules, session.programme);
    if (std::optional<Guide> guide = guide_of(session.programme, session.rules, visitors))
        session.guide.emplace(std::move(*guide));
    if (!session.options.visiting)
        session.visiting = counted_by(session.programme);
    session.shown_record
        = session.programme.record.empty() || visitors ? nullptr : std::make_unique<ShownRecord>(session.programme.record);
    session.flight
        = session.shown_record ? session.shown_record->flight() : flight_at(session.programme.start, session.rules);
    session.history = {};
    session.tutorial = tutorial_at(session.flight);
    session.goals = {};
    session.lab.forget();
    session.leaps.reset();
}

void forget_hands(Session& session)
{
    session.hid.forget();
    session.keyboard.forget();
}

void forget_visitor(Session& session)
{
    session.words = session.options.words;
    session.information = session.options.information;
    session.beside = Beside::none;
    session.menu = {};
    session.one_button = session.options.one_button.has_value();
    session.left_handed = session.options.left_handed;
    session.scan = {};
    forget_hands(session);
    forget_language(session.options.state);
    session.range = session.options.exposure.mode == ExposureMode::range;
    session.range_mode = {};
}

void forget_directions(Session& session)
{
    forget_visitor(session);
    session.directions = {};
    session.rules = rules_in(session.options, session.options.rules, session.programme);
    session.quality = session.options.quality, session.quality_name = session.options.quality_name;
    if (!session.governor)
        session.governor = governor_of(session.options);
}

} // namespace starbow
