#include "session_commands.h"
#include "config/json/reader.h"
#include "config/model/shipped.h"
#include "runtime/operation/last_language.h"
#include <cmath>

namespace starbow {
namespace {

/// The flight whose switches a docent may set: a tour shows its own effects until the visitor flies.
Flight& switched_flight(Session& session)
{
    if (Flight* flight = session.source->switched())
        return *flight;
    throw InputError("a tour shows its own effects; a tour's end, or a scene, is right");
}

/// The visitor's choices by a command, with the words, which a choice of the language changes.
void choose(Session& session, const Command& command)
{
    if (command.kind == CommandKind::language) {
        Words words = words_in(command.text);
        if (TourPlayer* tour = session.source->tour())
            tour->reword(*(session.content.tour = tour_in(session.content.tour_name, words)));
        session.words = std::move(words);
        keep_language(session.options.state, command.text);
    }
    apply(session.choices, command);
    if (command.kind == CommandKind::one_button)
        session.hands.forget();
}

void step_tour(const Session& session, Requests& requests, Switch by)
{
    if (!session.tour() || session.source->over())
        throw InputError("no tour with steps is shown; the command tour is right");
    requests.set(by);
}

/// The shown tour in its own motion; null where hands fly.
TourPlayer* moving_tour(Session& session) { return session.source->by_hand() ? nullptr : session.source->tour(); }

void begin_item(Session& session, double number)
{
    const std::optional<Programme>& programme = session.options.programme;
    if (!programme)
        throw InputError("the exhibit has no programme; \"programme\" in its file is right");
    if (!is_item(programme, number))
        throw InputError("the programme has no such item; a whole number from 1 to "
            + std::to_string(programme->items.size()) + " is right");
    session.item = int(number), session.item_began = Session::Clock::now();
}

} // namespace

void apply_command(Session& session, const Command& command, Requests& requests)
{
    switch (command.kind) {
    case CommandKind::fade:
    case CommandKind::exposure:
    case CommandKind::caption:
    case CommandKind::hold:
    case CommandKind::restart:
        session.docent.apply_command(command);
        break;
    case CommandKind::pointer:
        session.pointer.touch(command.number, command.second);
        break;
    case CommandKind::item: // what it shows is a command of its own
        begin_item(session, command.number);
        break;
    case CommandKind::touch:
        throw InputError("the live picture shows no direction there; a place within the picture is right");
    case CommandKind::speed_limit:
        session.docent.apply_command(command);
        session.rules.max_gamma = command.number;
        session.source->limit(command.number);
        break;
    case CommandKind::range:
    case CommandKind::sky_names:
    case CommandKind::filter:
    case CommandKind::one_button:
    case CommandKind::left_handed:
    case CommandKind::language:
    case CommandKind::inset:
    case CommandKind::information:
        choose(session, command);
        break;
    case CommandKind::stop:
        if (TourPlayer* tour = moving_tour(session))
            tour->pause(true);
        else
            requests.set(Switch::stop);
        break;
    case CommandKind::pause:
        if (TourPlayer* tour = moving_tour(session))
            tour->pause(command.on);
        else
            requests.set(Switch::freeze, session.flight().frozen != command.on);
        break;
    case CommandKind::next:
        step_tour(session, requests, Switch::home);
        break;
    case CommandKind::back:
        step_tour(session, requests, Switch::undo);
        break;
    case CommandKind::effect:
    case CommandKind::comparison:
        apply(switched_flight(session).effects, command);
        break;
    case CommandKind::slow_motion:
        switched_flight(session).time_scale = command.on && session.options.log.empty() ? 1 : 0;
        break;
    case CommandKind::pattern:
        session.alignment.show(pattern_named(command.text));
        break;
    case CommandKind::grip:
    case CommandKind::move:
    case CommandKind::move_back:
    case CommandKind::as_saved:
    case CommandKind::keep:
        session.alignment.queue(command, session.layout);
        break;
    case CommandKind::unlock:
        if (!session.attendance.attends())
            throw InputError("no key is locked here; an exhibit with \"visit\" in its file is right");
        unlock_builders_keys(session);
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

bool is_item(const std::optional<Programme>& programme, double number)
{
    return programme && number == std::floor(number) && number >= 1 && number <= double(programme->items.size());
}

SessionContent content_after(const Session& session, const Command& command)
{
    switch (command.kind) {
    case CommandKind::scene:
        return content_of_scene(command.text);
    case CommandKind::shot:
        return content_of_shot(command.text);
    case CommandKind::tour:
        return content_of_tour(command.text, session.words);
    default:
        return session.options.content;
    }
}

void begin_content(Session& session, SessionContent content, bool visitors)
{
    Flying rules = rules_in(session.options, session.options.rules, content);
    rules.max_gamma = session.docent.max_gamma().value_or(rules.max_gamma);
    session.source = source_of(content, rules, {visitors, session.speaker != nullptr, session.layout.surrounds});
    session.content = std::move(content);
    session.announcements = announced_on(session.options, session.content);
    session.rules = std::move(rules);
    session.attendance.count_by(counted_by(session.content));
    session.tutorial = tutorial_at(session.flight());
    session.goals = {};
    session.lab.forget();
    session.light.begin();
}

void unlock_builders_keys(Session& session)
{
    session.hands.unlock();
    session.alignment.say("The builder's keys are unlocked for ten minutes");
}

void forget_hands(Session& session)
{
    session.devices.forget();
    session.hands.forget();
}

void forget_visitor(Session& session)
{
    session.choices = first_choices(session.options);
    session.words = session.options.words;
    session.menu = {};
    forget_hands(session);
    forget_language(session.options.state);
    session.light.forget_visitor();
}

void forget_directions(Session& session)
{
    forget_visitor(session);
    session.docent.forget();
    session.pointer = {};
    session.item = 0;
    session.qualities.forget();
}

} // namespace starbow
