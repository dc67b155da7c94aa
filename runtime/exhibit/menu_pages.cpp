#include "menu_pages.h"
#include "config/json/error.h"
#include "config/model/named_words.h"
#include "config/model/shipped.h"
#include "runtime/hud/small_picture.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

enum Page : std::size_t { beginning, worlds, tours, switches, hands, languages };

MenuPage page_of(const Words& words, const std::string& title, CommandKind kind, const std::string& named,
    const std::vector<std::string>& names)
{
    MenuPage page{.title = title, .items = {}};
    for (const std::string& name : names)
        page.items.push_back({words.title(named, name), Command{.kind = kind, .text = name}});
    return page;
}

/// The languages, each in its own word.
MenuPage languages_of(const Session& session)
{
    MenuPage page{.title = session.words("menu.language"), .items = {}};
    for (const auto& [name, text] : session.languages)
        page.items.push_back({text, Command{.kind = CommandKind::language, .text = name}});
    return page;
}

/// An item that switches something on or off.
MenuItem switch_of(const Words& words, Key key, Command command, bool is_on)
{
    command.on = !is_on;
    return {(is_on ? "☑ " : "☐ ") + words(key), std::move(command)};
}

/// An item with its present value, which leads to the next one.
MenuItem next_of(const Words& words, Key key, Key value, CommandKind kind, std::string_view next)
{
    return {words(key) + ": " + words(value), Command{.kind = kind, .text = std::string(next)}};
}

MenuPage switches_of(const Session& session)
{
    const Words& words = session.words;
    const Effects& on = session.flight().effects;
    MenuPage page{.title = words("menu.show"),
        .items = {switch_of(words, "menu.range", {.kind = CommandKind::range}, session.choices.range),
            next_of(words, "menu.inset", inset_view_words[std::size_t(session.choices.inset)], CommandKind::inset,
                name_of(after(session.choices.inset))),
            next_of(words, "menu.information", display_words[std::size_t(session.choices.information)],
                CommandKind::information, name_of(after(session.choices.information)))},
        .stays = true};
    constexpr auto effect_keys = keys_of_usual_effects("menu.");
    std::vector<MenuItem> effects;
    for (const EffectEntry& one : all_effects)
        if (one.usual)
            effects.push_back(switch_of(words, effect_keys[std::size_t(one.which)],
                {.kind = CommandKind::effect, .effect = one.which}, on[one.which]));
    page.items.insert(page.items.begin(), effects.begin(), effects.end());
    if (session.sky_has_names)
        page.items.push_back(
            switch_of(words, "menu.sky_names", {.kind = CommandKind::sky_names}, session.choices.sky_names));
    if (session.sky_has_sun)
        page.items.push_back(switch_of(words, "menu.filter", {.kind = CommandKind::filter}, session.choices.filter));
    if (session.options.log.empty())
        page.items.push_back(
            switch_of(words, "menu.slow_motion", {.kind = CommandKind::slow_motion}, session.flight().time_scale > 0));
    return page;
}

MenuPage hands_of(const Session& session)
{
    const Words& words = session.words;
    return {.title = words("menu.hands"),
        .items = {switch_of(words, "menu.one_button", {.kind = CommandKind::one_button}, session.choices.one_button),
            switch_of(words, "menu.left_handed", {.kind = CommandKind::left_handed}, session.choices.left_handed)},
        .stays = true};
}

} // namespace

std::vector<MenuPage> menu_of(const Session& session)
{
    const Words& words = session.words;
    std::vector<MenuPage> pages{{.title = words("menu.title"), .items = {}},
        page_of(words, words("menu.worlds"), CommandKind::scene, "scene", session.options.menu_scenes),
        page_of(words, words("menu.tours"), CommandKind::tour, "tour", session.options.menu_tours), switches_of(session),
        hands_of(session), languages_of(session)};
    for (std::size_t page = worlds; page < pages.size(); ++page)
        if (!pages[page].items.empty() && (page != switches || session.source->by_hand())) // a tour shows its own effects
            pages[beginning].items.push_back({pages[page].title, page});
    return pages;
}

Caption caption_of(const MenuState& menu, std::span<const MenuPage> pages, const Words& words,
    const InputCapabilities& capabilities, bool with_one_button)
{
    const MenuPage& page = pages[menu.page];
    Caption caption{.text = page.title, .chosen = int(menu.item), .menu = true};
    for (const MenuItem& item : page.items)
        caption.choices.push_back(item.text);
    if (const auto& [shown, item] = menu.shown; item < pages[shown].items.size())
        if (const Command* command = std::get_if<Command>(&pages[shown].items[item].leads))
            caption.picture = thumbnail_of(*command);
    if (with_one_button)
        caption.aside = words("scan.press_in_menu");
    else
        caption.aside = capabilities.stick && capabilities.stop_button > 0 && capabilities.home_button > 0
            ? words("menu.hands_stick",
                {{"take", std::to_string(capabilities.stop_button)}, {"back", std::to_string(capabilities.home_button)}})
            : words("menu.hands_keys");
    return caption;
}

Caption caption_of(const Scan& scan, const OneButton& rules, const Words& words)
{
    Caption caption{.chosen = int(scan.choice), .flying = true, .menu = true};
    constexpr Key choices[]{"scan.faster", "scan.slower", "scan.left", "scan.right", "scan.up", "scan.down", "scan.stop",
        "scan.home", "scan.menu"}; // in the order of ScanChoice
    static_assert(std::size(choices) == scan_choices);
    for (const Key key : choices)
        caption.choices.push_back(words(key));
    std::string& chosen = caption.choices[scan.choice];
    if (scan.acts)
        chosen = "▸ " + chosen + " ◂";
    constexpr int dots = 8;
    const int passed = int(std::floor(dots * passed_part(scan, rules)));
    for (int i = 0; i < dots; ++i)
        caption.aside += i < dots - passed ? "●" : "○";
    caption.aside += "   " + words(scan.acts ? "scan.acts"_key : "scan.press"_key);
    return caption;
}

} // namespace starbow
