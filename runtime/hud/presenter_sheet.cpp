#include "presenter_sheet.h"
#include "config/model/named_words.h"
#include "hud.h"
#include "small_picture.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

using Order = CommandKind;

constexpr double exposure_step_ev = 0.5;

/// A limit as a docent says it: a part of light's speed, with as many digits as tell it from light's.
std::string limit_text(double max_gamma, const Words& words)
{
    if (max_gamma >= offered_limits.back())
        return words("remote.no_limit");
    const double speed = speed_of(max_gamma);
    return shown_number(speed, std::max(3, int(std::ceil(-std::log10(1 - speed)))), words) + " c";
}

std::string exposure_text(double ev, const Words& words)
{
    return words("hud.ev", {{"ev", (ev > 0 ? "+" : "") + shown_number(ev, 1, words)}});
}

std::string speed_text(const PresenterState& state, const Words& words)
{
    return shown_number(state.speed, state.speed > 0.999 ? 7 : 3, words) + " c    γ " + shown_number(state.gamma, words);
}

/// The states beside the visit itself, such as calm, in a few words; or "".
std::string also_text(const ExhibitState& state, const Words& words)
{
    std::string text;
    for (const auto& [is, key] : {std::pair{state.paused, "does.paused"_key}, {state.fade, "does.dark"_key},
             {state.hold, "does.held"_key}, {state.calm, "does.calm"_key}})
        if (is)
            text += (text.empty() ? "" : ", ") + words(key);
    return text;
}

using Values = std::vector<std::pair<std::string_view, std::string>>;

/// The placeholders of a time on a clock: 4:07.
Values clock_of(int seconds)
{
    const int rest = seconds % 60;
    return {{"minutes", std::to_string(seconds / 60)}, {"seconds", (rest < 10 ? "0" : "") + std::to_string(rest)}};
}

/// The present item's number, title and time.
std::string item_text(const PresenterState& state, std::size_t item, const Words& words)
{
    const ProgrammeCue& shown = state.programme[item - 1];
    Values time = clock_of(int(state.item_s));
    time.emplace_back("planned", shown_number(shown.minutes, shown.minutes == std::floor(shown.minutes) ? 0 : 1, words));
    return words("remote.item", {{"item", std::to_string(item)}, {"items", std::to_string(state.programme.size())}}) + " · "
        + shown.title + " · " + words("remote.item_time", time);
}

void add_programme(PresenterSheet& sheet, const PresenterState& state, const Words& words)
{
    const std::size_t items = state.programme.size();
    if (items == 0)
        return;
    const auto now = std::min(std::size_t(std::max(0, state.item)), items); // 0: it has not begun
    if (now == 0) {
        sheet.item_title = words("remote.not_begun");
    } else {
        sheet.item_title = item_text(state, now, words);
        sheet.item_notes = state.programme[now - 1].notes;
    }
    if (now < items)
        sheet.item_then = words("remote.then", {{"item", state.programme[now].title}});
}

struct Choices {
    std::string title;
    std::vector<std::pair<std::string, Command>> all;
    std::vector<bool> shown; ///< is what the exhibit shows
};

Choices named(const std::string& title, Order kind, const std::vector<std::pair<std::string, std::string>>& names,
    const std::string& now)
{
    Choices choices{title, {}, {}};
    for (const auto& [name, text] : names) {
        choices.all.emplace_back(text, Command{.kind = kind, .text = name});
        choices.shown.push_back(name == now);
    }
    return choices;
}

Choices choices_of(const PresenterState& state, PresenterList list, const Words& words)
{
    switch (list) {
    case PresenterList::worlds:
        return named(words("presenter.worlds"), Order::scene, state.scenes, state.scene);
    case PresenterList::tours:
        return named(words("presenter.tours"), Order::tour, state.tours, state.tour);
    case PresenterList::views:
        return named(words("presenter.views"), Order::shot, state.shots, state.shot);
    case PresenterList::languages:
        return named(words("remote.language"), Order::language, state.languages, state.language);
    case PresenterList::limits:
        break;
    }
    Choices choices{words("remote.speed_limit"), {}, {}};
    for (const double limit : offered_limits) {
        choices.all.emplace_back(limit_text(limit, words), Command{.kind = Order::speed_limit, .number = limit});
        choices.shown.push_back(std::abs(limit / state.max_gamma - 1) < 1e-3);
    }
    return choices;
}

std::size_t pages_of(const Choices& choices)
{
    return std::max<std::size_t>(1, (choices.all.size() + most_choices - 1) / most_choices);
}

void add_choices(PresenterSheet& sheet, const PresenterState& state, const PresenterHands& hands, const Words& words)
{
    const Choices choices = choices_of(state, hands.list, words);
    const std::size_t pages = pages_of(choices), page = hands.page % pages;
    sheet.list_title = choices.title;
    for (std::size_t i = page * most_choices; i < std::min(choices.all.size(), (page + 1) * most_choices); ++i) {
        const char digit = char('0' + (i + 1) % most_choices);
        sheet.choices.push_back({.key = digit,
            .name = std::string(1, digit),
            .label = choices.all[i].first,
            .on = choices.shown[i],
            .deed = choices.all[i].second});
    }
    if (pages > 1)
        sheet.choices.push_back({.key = 'M',
            .name = "M",
            .label = words("presenter.more"),
            .state = std::to_string(page + 1) + " / " + std::to_string(pages),
            .deed = MoreChoices{}});
}

void add_keys(PresenterSheet& sheet, const PresenterState& state, const Words& words)
{
    using namespace keys;
    std::vector<PresenterKey>& keys = sheet.keys;
    const auto deed = [&](int key, const char* name, Key label, PresenterDeed deed) -> PresenterKey& {
        return keys.emplace_back(PresenterKey{.key = key, .name = name, .label = words(label), .deed = std::move(deed)});
    };
    const auto toggle = [&](int key, Key label, Command command, bool on) -> PresenterKey& {
        const char name[]{char(key), 0};
        command.on = !on;
        PresenterKey& added = deed(key, name, label, std::move(command));
        added.on = on;
        added.state = words(on ? "hud.on"_key : "hud.off"_key);
        return added;
    };
    const auto list = [&](int key, Key label, PresenterList which) -> PresenterKey& {
        const char name[]{char(key), 0};
        return deed(key, name, label, OpenList{which});
    };
    const auto brighter = [&](double ev) {
        const double steps = std::round(state.exposure_ev / exposure_step_ev) + ev / exposure_step_ev;
        return Command{
            .kind = Order::exposure, .number = std::clamp(steps * exposure_step_ev, -most_exposure_ev, most_exposure_ev)};
    };
    const auto step = [&](int key, Key label, Command command, std::string state_text, bool on) -> PresenterKey& {
        const char name[]{char(key), 0};
        PresenterKey& added = deed(key, name, label, std::move(command));
        added.state = std::move(state_text), added.on = on;
        return added;
    };
    const bool toured = !state.cues.empty();
    PresenterKey& back = deed(left, "←", "remote.back", Command{.kind = Order::back});
    back.also = page_up, back.usable = toured;
    PresenterKey& next = deed(right, "→", "remote.next", Command{.kind = Order::next});
    next.also = page_down, next.usable = toured;
    toggle('P', toured ? "remote.pause"_key : "presenter.freeze"_key, {.kind = Order::pause}, state.paused);
    toggle('H', "remote.hold", {.kind = Order::hold}, state.hold);
    toggle('B', "remote.fade", {.kind = Order::fade}, state.fade);

    const auto item = [](int number) { return Command{.kind = Order::item, .number = double(std::max(1, number))}; };
    deed(',', ",", "remote.item_back", item(state.item - 1)).usable = state.item > 1;
    deed('.', ".", "remote.item_next", item(state.item + 1)).usable = state.item < state.items;

    deed(space, words("presenter.space").c_str(), "remote.stop", Command{.kind = Order::stop});
    deed('R', "R", "remote.reset", Command{.kind = Order::reset});
    list('W', "presenter.worlds", PresenterList::worlds);
    list('T', "presenter.tours", PresenterList::tours);
    list('V', "presenter.views", PresenterList::views);

    constexpr auto effect_keys = keys_of_effects("remote.");
    for (const EffectEntry& one : all_effects)
        toggle(one.letter, effect_keys[std::size_t(one.which)], {.kind = Order::effect, .effect = one.which},
            state.effects[one.which])
            .usable
            = state.own_effects;
    toggle('S', "remote.slow_motion", {.kind = Order::slow_motion}, state.slow_motion).usable = state.own_effects;

    constexpr Key comparisons[]{"remote.none", "remote.galilean", "remote.no_light_delay"};
    const Comparison compared = state.effects.comparison;
    step('C', "remote.comparison", {.kind = Order::comparison, .text = comparison_names[std::size_t(after(compared))]},
        words(comparisons[std::size_t(compared)]), compared != Comparison::none)
        .usable
        = state.own_effects;
    step('X', "presenter.inset", {.kind = Order::inset, .text = name_of(after(state.inset))},
        words(inset_view_words[std::size_t(state.inset)]), state.inset != InsetView::none);
    step('I', "remote.information", {.kind = Order::information, .text = std::string(name_of(after(state.information)))},
        words(display_words[std::size_t(state.information)]), false);
    deed(down, "↓", "presenter.darker", brighter(-exposure_step_ev)).state = exposure_text(state.exposure_ev, words);
    deed(up, "↑", "presenter.brighter", brighter(exposure_step_ev)).state = exposure_text(state.exposure_ev, words);

    toggle('U', "remote.range", {.kind = Order::range}, state.range);
    toggle('J', "remote.sky_names", {.kind = Order::sky_names}, state.sky_names);
    toggle('Z', "remote.filter", {.kind = Order::filter}, state.filter);
    list('G', "remote.speed_limit", PresenterList::limits).state = limit_text(state.max_gamma, words);
    PresenterKey& language = list('L', "remote.language", PresenterList::languages);
    for (const auto& [name, text] : state.languages)
        if (name == state.language)
            language.state = text;
    PresenterKey& caption = deed('K', "K", "remote.caption", TypeCaption{});
    caption.on = !state.caption.empty();
    caption.state = words(caption.on ? "hud.on"_key : "hud.off"_key);
    toggle('O', "remote.one_button", {.kind = Order::one_button}, state.one_button);
    toggle('N', "remote.left_handed", {.kind = Order::left_handed}, state.left_handed);
}

const PresenterKey* key_found(const std::vector<PresenterKey>& keys, int key)
{
    const auto at = std::ranges::find_if(
        keys, [&](const PresenterKey& one) { return one.key == key || (one.also != 0 && one.also == key); });
    return at == keys.end() ? nullptr : &*at;
}

/// Keys while a caption is typed.
std::optional<Command> press_typing(PresenterHands& hands, int key)
{
    using namespace keys;
    std::string& text = *hands.typed;
    if (key == escape) {
        hands.typed.reset();
    } else if (key == backspace && !text.empty()) {
        while (text.size() > 1 && (text.back() & 0xc0) == 0x80) // the rest of a character
            text.pop_back();
        text.pop_back();
    } else if (key == enter || key == keypad_enter) {
        Command command{.kind = Order::caption, .text = std::move(text)};
        hands.typed.reset();
        return command;
    }
    return {};
}

} // namespace

std::string thumbnail_of(const PresenterKey& key)
{
    const Command* command = std::get_if<Command>(&key.deed);
    return command ? thumbnail_of(*command) : "";
}

PresenterSheet sheet_of(const PresenterState& state, const PresenterHands& hands, const Words& words)
{
    PresenterSheet sheet{.cues = state.cues,
        .step = std::size_t(std::max(0, state.step - 1)),
        .said = state.said,
        .refused = state.refused,
        .typed = hands.typed};
    constexpr auto doing_words = keys_of("does.", doing_names);
    sheet.facts = {{words("remote.now"), words(doing_words[std::size_t(state.doing)])},
        {words("remote.scene"),
            state.coming.empty() ? words.title("scene", state.scene)
                                 : words("does.coming", {{"world", words.title("scene", state.coming)}})},
        {words("remote.speed"), speed_text(state, words)}, {words("remote.speed_limit"), limit_text(state.max_gamma, words)},
        {words("remote.exposure"), exposure_text(state.exposure_ev, words)}};
    if (const std::string also = also_text(state, words); !also.empty())
        sheet.facts.emplace(sheet.facts.begin() + 1, "", also);
    if (!state.caption.empty())
        sheet.facts.emplace_back(words("remote.caption"), state.caption);
    if (state.cues.empty()) {
        sheet.cue_title = words("presenter.no_tour");
    } else {
        const std::string step
            = words("remote.step", {{"step", std::to_string(state.step)}, {"steps", std::to_string(state.steps)}});
        sheet.cue_title = words.title("tour", state.tour) + " · " + step + " · "
            + (state.paused ? words("does.paused") : words("does.left", clock_of(int(std::ceil(state.left_s)))));
    }
    sheet.typed_help = words("presenter.typed");
    add_programme(sheet, state, words);
    add_choices(sheet, state, hands, words);
    add_keys(sheet, state, words);
    return sheet;
}

std::optional<Command> press(const PresenterSheet& sheet, PresenterHands& hands, int key)
{
    if (hands.typed)
        return press_typing(hands, key);
    if (key == keys::escape)
        hands = {};
    const PresenterKey* pressed = key_found(sheet.choices, key);
    if (!pressed)
        pressed = key_found(sheet.keys, key);
    if (!pressed)
        return {};
    if (const auto* command = std::get_if<Command>(&pressed->deed))
        return *command;
    if (const auto* opened = std::get_if<OpenList>(&pressed->deed))
        hands = {.list = opened->list};
    else if (std::holds_alternative<MoreChoices>(pressed->deed))
        ++hands.page;
    else
        hands.typed.emplace();
    return {};
}

void type(PresenterHands& hands, char32_t c)
{
    if (!hands.typed || c < 32 || c == 127 || c > 0x10ffff)
        return;
    std::string one; // UTF-8
    if (c < 0x80)
        one = {char(c)};
    else if (c < 0x800)
        one = {char(0xc0 | c >> 6), char(0x80 | (c & 0x3f))};
    else if (c < 0x10000)
        one = {char(0xe0 | c >> 12), char(0x80 | (c >> 6 & 0x3f)), char(0x80 | (c & 0x3f))};
    else
        one = {char(0xf0 | c >> 18), char(0x80 | (c >> 12 & 0x3f)), char(0x80 | (c >> 6 & 0x3f)), char(0x80 | (c & 0x3f))};
    if (hands.typed->size() + one.size() <= most_command_text)
        *hands.typed += one;
}

} // namespace starbow
