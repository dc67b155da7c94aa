#include "words.h"
#include "config/json/reader.h"
#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace starbow {
namespace {

/// The prefix of the tours' keys, which the tours define.
constexpr std::string_view of_tours = "tour.";
/// The prefix of the goals' keys, which the scenes define.
constexpr std::string_view of_goals = "goal.";

struct Known {
    std::string_view key;
    std::vector<std::string_view> placeholders{};
};

/// Every text of the program. A new one belongs in each file of config/words too.
const std::vector<Known> known{
    {"decimal_sign"},
    {"hud.speed"},
    {"hud.speed_deficit"},
    {"hud.gamma"},
    {"hud.doppler_ahead"},
    {"hud.ship"},
    {"hud.world"},
    {"hud.flown"},
    {"hud.aberration"},
    {"hud.doppler"},
    {"hud.headlight"},
    {"hud.on"},
    {"hud.off"},
    {"hud.flight"},
    {"hud.exposure"},
    {"hud.ev", {"ev"}},
    {"hud.ev_locked", {"ev"}},
    {"hud.rate"},
    {"hud.light"},
    {"hud.slow_motion", {"board", "world"}},
    {"flight.guided"},
    {"flight.free"},
    {"flight.newtonian"},
    {"flight.frozen"},
    {"say.percent", {"number"}},
    {"say.of_light"},
    {"say.clock_board", {"time"}},
    {"say.clock_world", {"time"}},
    {"say.rest"},
    {"say.slow"},
    {"say.rain"},
    {"say.colours"},
    {"say.beam"},
    {"say.limit"},
    {"say.back"},
    {"say.back_colours"},
    {"say.no_aberration"},
    {"say.no_effects"},
    {"say.galilean"},
    {"say.no_light_delay"},
    {"say.false_colours"},
    {"say.frozen"},
    {"remote.display.visitor"},
    {"remote.display.guide"},
    {"remote.display.laboratory"},
    {"menu.information"},
    {"remote.information"},
    {"sign.behind"},
    {"sign.behind_light"},
    {"sign.clock"},
    {"sign.clock_light", {"time"}},
    {"beside.none"},
    {"beside.at-rest"},
    {"beside.aberration"},
    {"beside.doppler"},
    {"beside.headlight"},
    {"beside.telescope"},
    {"beside.telescope_angle", {"angle"}},
    {"menu.beside"},
    {"light.seen"},
    {"light.without_headlight"},
    {"light.without_doppler"},
    {"light.at_rest"},
    {"light.galilean"},
    {"light.no_light_delay"},
    {"light.false_colours"},
    {"light.false_colours_unshifted"},
    {"time.s", {"number"}},
    {"time.min", {"number"}},
    {"time.h", {"number"}},
    {"time.days", {"number"}},
    {"time.years", {"number"}},
    {"length.m", {"number"}},
    {"length.km", {"number"}},
    {"length.light_s", {"number"}},
    {"length.light_min", {"number"}},
    {"length.light_h", {"number"}},
    {"length.light_years", {"number"}},
    {"lab.doppler"},
    {"lab.wavelength"},
    {"lab.angle"},
    {"lab.at_rest"},
    {"lab.distance"},
    {"lab.sky"},
    {"lab.emitted"},
    {"lab.shown_at"},
    {"lab.clock"},
    {"lab.light"},
    {"lab.marks_angle"},
    {"lab.marks_length"},
    {"lab.marks_lengths", {"apparent", "rest"}},
    {"lab.marks_clocks"},
    {"lab.mark_two"},
    {"lab.mark_another"},
    {"lab.logged", {"file", "line"}},
    {"lab.no_log"},
    {"angle.degrees", {"number"}},
    {"wave.x_rays"},
    {"wave.ultraviolet", {"number"}},
    {"wave.visible", {"number"}},
    {"wave.infrared", {"number"}},
    {"wave.far_infrared", {"number"}},
    {"wave.radio"},
    {"overlay.aim", {"unshifted"}},
    {"overlay.aim_rest"},
    {"overlay.grid"},
    {"overlay.ring", {"unshifted"}},
    {"overlay.ring_rest"},
    {"overlay.distance"},
    {"overlay.emission", {"five", "step"}},
    {"why.comparison"},
    {"why.aberration"},
    {"why.aberration_rain"},
    {"why.aberration_abeam"},
    {"why.aberration_formula"},
    {"why.aberration_numbers", {"beta", "beta", "cos", "cos", "result"}},
    {"why.aberration_angles", {"seen", "theta"}},
    {"why.doppler"},
    {"why.doppler_waves"},
    {"why.doppler_abeam"},
    {"why.doppler_formula"},
    {"why.doppler_numbers", {"D", "beta", "cos", "gamma"}},
    {"why.doppler_seen", {"nm"}},
    {"why.headlight"},
    {"why.headlight_more"},
    {"why.headlight_photons"},
    {"why.headlight_formula"},
    {"why.headlight_numbers", {"D", "cube"}},
    {"why.headlight_off"},
    {"why.delay"},
    {"why.delay_seen"},
    {"why.delay_moving"},
    {"why.delay_formula"},
    {"why.delay_numbers", {"left", "now", "way"}},
    {"why.delay_none"},
    {"why.delay_marks", {"apart", "first", "second"}},
    {"why.dilation"},
    {"why.dilation_slow"},
    {"why.dilation_clocks"},
    {"why.dilation_formula"},
    {"why.dilation_numbers", {"gamma", "gamma"}},
    {"why.dilation_ship", {"ship"}},
    {"why.length"},
    {"why.length_shorter"},
    {"why.length_seen"},
    {"why.length_formula"},
    {"why.length_numbers", {"contracted", "rest"}},
    {"why.length_apparent", {"apparent"}},
    {"why.length_none"},
    {"plot.doppler"},
    {"plot.doppler_x"},
    {"plot.doppler_y"},
    {"plot.doppler_read", {"count"}},
    {"plot.doppler_by_eye", {"count"}},
    {"plot.length"},
    {"plot.length_y"},
    {"plot.length_read", {"count"}},
    {"plot.length_by_eye", {"count"}},
    {"plot.clock"},
    {"plot.clock_y"},
    {"plot.clock_read", {"count"}},
    {"plot.beta"},
    {"plot.theory"},
    {"plot.theory_at", {"beta"}},
    {"plot.empty"},
    {"challenge.sheet"},
    {"challenge.sheet_intro"},
    {"challenge.start"},
    {"challenge.tools"},
    {"challenge.check"},
    {"challenge.hint", {"number"}},
    {"challenge.done", {"found", "line", "right"}},
    {"challenge.not_yet", {"found", "line"}},
    {"challenge.no_line"},
    {"challenge.about", {"right", "tolerance"}},
    {"challenge.at_most", {"right"}},
    {"challenge.slow_clock"},
    {"challenge.slow_clock_ask"},
    {"challenge.slow_clock_tools"},
    {"challenge.slow_clock_check"},
    {"challenge.slow_clock_hint_a"},
    {"challenge.slow_clock_hint_b"},
    {"challenge.slow_clock_hint_c"},
    {"challenge.own_colour"},
    {"challenge.own_colour_ask"},
    {"challenge.own_colour_tools"},
    {"challenge.own_colour_check"},
    {"challenge.own_colour_hint_a"},
    {"challenge.own_colour_hint_b"},
    {"challenge.own_colour_hint_c"},
    {"challenge.red_to_green"},
    {"challenge.red_to_green_ask"},
    {"challenge.red_to_green_tools"},
    {"challenge.red_to_green_check"},
    {"challenge.red_to_green_hint_a"},
    {"challenge.red_to_green_hint_b"},
    {"challenge.red_to_green_hint_c"},
    {"challenge.two_lengths"},
    {"challenge.two_lengths_ask"},
    {"challenge.two_lengths_tools"},
    {"challenge.two_lengths_check"},
    {"challenge.two_lengths_hint_a"},
    {"challenge.two_lengths_hint_b"},
    {"challenge.two_lengths_hint_c"},
    {"challenge.half_size"},
    {"challenge.half_size_ask"},
    {"challenge.half_size_tools"},
    {"challenge.half_size_check"},
    {"challenge.half_size_hint_a"},
    {"challenge.half_size_hint_b"},
    {"challenge.half_size_hint_c"},
    {"challenge.same_light"},
    {"challenge.same_light_ask"},
    {"challenge.same_light_tools"},
    {"challenge.same_light_check"},
    {"challenge.same_light_hint_a"},
    {"challenge.same_light_hint_b"},
    {"challenge.same_light_hint_c"},
    {"challenge.younger"},
    {"challenge.younger_ask"},
    {"challenge.younger_tools"},
    {"challenge.younger_check"},
    {"challenge.younger_hint_a"},
    {"challenge.younger_hint_b"},
    {"challenge.younger_hint_c"},
    {"challenge.same_time"},
    {"challenge.same_time_ask"},
    {"challenge.same_time_tools"},
    {"challenge.same_time_check"},
    {"challenge.same_time_hint_a"},
    {"challenge.same_time_hint_b"},
    {"challenge.same_time_hint_c"},
    {"challenge.half_rate"},
    {"challenge.half_rate_ask"},
    {"challenge.half_rate_tools"},
    {"challenge.half_rate_check"},
    {"challenge.half_rate_hint_a"},
    {"challenge.half_rate_hint_b"},
    {"challenge.half_rate_hint_c"},
    {"challenge.behind_ahead"},
    {"challenge.behind_ahead_ask"},
    {"challenge.behind_ahead_tools"},
    {"challenge.behind_ahead_check"},
    {"challenge.behind_ahead_hint_a"},
    {"challenge.behind_ahead_hint_b"},
    {"challenge.behind_ahead_hint_c"},
    {"class.title"},
    {"class.group"},
    {"class.lines"},
    {"class.count"},
    {"class.mean"},
    {"class.spread"},
    {"class.explain"},
    {"class.read"},
    {"class.by_eye"},
    {"class.theory"},
    {"touring.right"},
    {"touring.wrong"},
    {"touring.answer"},
    {"touring.fly", {"left"}},
    {"touring.choose_stick", {"button", "left"}},
    {"touring.choose_keys", {"left"}},
    {"touring.guide_stick", {"back", "on", "stop"}},
    {"touring.guide_keys"},
    {"touring.paused_stick", {"stop"}},
    {"touring.paused_keys"},
    {"touring.over"},
    {"tutorial.go_throttle"},
    {"tutorial.go_trigger"},
    {"tutorial.go_key"},
    {"tutorial.go_left_key"},
    {"tutorial.go_left_trigger"},
    {"tutorial.turn_stick"},
    {"tutorial.turn_keys"},
    {"tutorial.turn_left_keys"},
    {"tutorial.stop_button", {"button"}},
    {"tutorial.stop_key"},
    {"visit.begin_stick"},
    {"visit.begin_keys"},
    {"visit.asking", {"left"}},
    {"visit.ending", {"left"}},
    {"visit.boundary"},
    {"visit.homeward"},
    {"visit.held"},
    {"menu.title"},
    {"menu.worlds"},
    {"menu.tours"},
    {"menu.show"},
    {"menu.language"},
    {"menu.aberration"},
    {"menu.doppler"},
    {"menu.headlight"},
    {"menu.slow_motion"},
    {"menu.hands"},
    {"menu.one_button"},
    {"menu.left_handed"},
    {"scan.faster"},
    {"scan.slower"},
    {"scan.left"},
    {"scan.right"},
    {"scan.up"},
    {"scan.down"},
    {"scan.stop"},
    {"scan.home"},
    {"scan.menu"},
    {"scan.press"},
    {"scan.press_in_menu"},
    {"scan.press_in_question", {"left"}},
    {"scan.press_on"},
    {"scan.acts"},
    {"menu.hands_stick", {"back", "take"}},
    {"menu.hands_keys"},
    {"menu.coming", {"world"}},
    {"menu.scene.alice-and-bob"},
    {"menu.scene.avenue"},
    {"menu.scene.chart"},
    {"menu.scene.clocks"},
    {"menu.scene.gamow"},
    {"menu.scene.light-clock"},
    {"menu.scene.rainbow"},
    {"menu.scene.solar-system"},
    {"menu.scene.train"},
    {"menu.scene.twins"},
    {"menu.scene.warm-wall"},
    {"menu.tour.first-minute"},
    {"menu.tour.rainbow"},
    {"menu.tour.simultaneity"},
    {"menu.tour.twins"},
    {"menu.tour.voyage"},
    {"presenter.worlds"},
    {"presenter.tours"},
    {"presenter.views"},
    {"presenter.more"},
    {"presenter.beside"},
    {"presenter.freeze"},
    {"presenter.brighter"},
    {"presenter.darker"},
    {"presenter.space"},
    {"presenter.no_tour"},
    {"presenter.left", {"left"}},
    {"presenter.typed"},
    {"presenter.somebody"},
    {"presenter.asking"},
    {"presenter.nobody"},
    {"presenter.watches"},
    {"remote.this_language"},
    {"remote.page_language"},
    {"remote.login"},
    {"remote.pin"},
    {"remote.log_in"},
    {"remote.log_out"},
    {"remote.wrong_pin"},
    {"remote.locked", {"minutes"}},
    {"remote.connected"},
    {"remote.reconnecting"},
    {"remote.silent"},
    {"remote.not_connected"},
    {"remote.done", {"command"}},
    {"remote.refused", {"command", "reason"}},
    {"remote.first"},
    {"remote.fade"},
    {"remote.stop"},
    {"remote.reset"},
    {"remote.now"},
    {"remote.picture"},
    {"remote.scene"},
    {"remote.shot"},
    {"remote.tour"},
    {"remote.no_tour"},
    {"remote.step", {"step", "steps"}},
    {"remote.paused"},
    {"remote.speed"},
    {"remote.gamma"},
    {"remote.visitors"},
    {"remote.fly"},
    {"remote.held"},
    {"remote.dark"},
    {"remote.frames"},
    {"remote.frames_value", {"ms", "rate"}},
    {"remote.runs"},
    {"remote.hours", {"hours", "minutes"}},
    {"remote.days", {"number"}},
    {"remote.last_error"},
    {"remote.no_error"},
    {"remote.which_tour"},
    {"remote.start"},
    {"remote.back"},
    {"remote.pause"},
    {"remote.next"},
    {"remote.place"},
    {"remote.go"},
    {"remote.hold"},
    {"remote.speed_limit"},
    {"remote.no_limit"},
    {"remote.exposure"},
    {"remote.language"},
    {"remote.effects"},
    {"remote.aberration"},
    {"remote.doppler"},
    {"remote.headlight"},
    {"remote.false_colours"},
    {"remote.slow_motion"},
    {"remote.one_button"},
    {"remote.left_handed"},
    {"remote.comparison"},
    {"remote.none"},
    {"remote.galilean"},
    {"remote.no_light_delay"},
    {"remote.caption"},
    {"remote.caption_text"},
    {"remote.show"},
    {"remote.clear"},
    {"remote.engineer"},
    {"remote.layout"},
    {"remote.use"},
    {"remote.pattern"},
    {"remote.no_pattern"},
    {"remote.grid"},
    {"remote.rings"},
    {"remote.names"},
    {"remote.wedges"},
    {"remote.overlap"},
    {"remote.quality"},
    {"remote.unlock"},
    {"remote.restart"},
    {"remote.restart_sure"},
    {"remote.no"},
    {"remote.metrics"},
    {"remote.log"},
    {"remote.you_are", {"role"}},
    {"remote.role_look"},
    {"remote.role_docent"},
    {"remote.role_engineer"},
    {"remote.who"},
    {"remote.who_look"},
    {"remote.who_docent"},
    {"remote.who_engineer"},
};

std::vector<std::string_view> known_keys()
{
    std::vector<std::string_view> keys;
    for (const Known& one : known)
        keys.push_back(one.key);
    return keys;
}

std::string in_braces(const std::vector<std::string_view>& names)
{
    std::string list;
    for (std::string_view name : names)
        list.append(list.empty() ? "{" : ", {").append(name).append("}");
    return list.empty() ? "no { }" : list;
}

} // namespace

std::string filled(std::string text, const std::vector<std::pair<std::string_view, std::string>>& with)
{
    for (const auto& [name, value] : with) {
        const std::string hole = std::string("{").append(name).append("}");
        for (std::size_t at = 0; (at = text.find(hole, at)) != text.npos; at += value.size())
            text.replace(at, hole.size(), value);
    }
    return text;
}

std::vector<std::string> placeholders(const std::string& text)
{
    std::vector<std::string> names;
    for (std::size_t at = 0; (at = text.find('{', at)) != text.npos; ++at)
        if (const std::size_t end = text.find('}', at); end != text.npos)
            names.push_back(text.substr(at + 1, end - at - 1));
    return names;
}

std::string Words::operator()(std::string_view key, const std::vector<std::pair<std::string_view, std::string>>& with) const
{
    const auto found = texts.find(key);
    if (found == texts.end()) {
        std::fprintf(stderr, "starbow: no words for %s among %zu texts\n", std::string(key).c_str(), texts.size());
        std::abort();
    }
    return filled(found->second, with);
}

const std::string* Words::tour(const std::string& key) const
{
    const auto found = key.starts_with(of_tours) ? texts.find(key) : texts.end();
    return found == texts.end() ? nullptr : &found->second;
}

std::string Words::number(std::string c) const
{
    if (const std::size_t point = c.find('.'); point != c.npos)
        c.replace(point, 1, (*this)("decimal_sign"));
    return c;
}

Words load_words(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    const Place top = root(document);
    if (!top.json->is_object())
        complain(top, "is not an object; an object in { } is right");
    std::vector<std::string_view> keys = known_keys();
    for (const auto& [key, value] : top.json->items())
        if (key.starts_with(of_tours) || key.starts_with(of_goals))
            keys.push_back(key);
    reject_unknown_members(top, keys);
    Words words{.language = file.stem(), .file = file, .texts = {}};
    for (const auto& [key, value] : top.json->items())
        words.texts[key] = text(member(top, key));
    for (const Known& one : known) {
        const Place at = member(top, std::string(one.key));
        std::vector<std::string> there = placeholders(words.texts.find(one.key)->second);
        std::sort(there.begin(), there.end());
        if (!std::equal(there.begin(), there.end(), one.placeholders.begin(), one.placeholders.end()))
            complain(
                at, "has other places to fill than are filled; a text with " + in_braces(one.placeholders) + " is right");
    }
    return words;
}

} // namespace starbow
