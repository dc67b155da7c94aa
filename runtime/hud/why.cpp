#include "why.h"
#include "config/model/angles.h"
#include "hud.h"
#include "shaders/physics/physics.h"
#include <cmath>

namespace starbow {
namespace {

/// The title, the two lines of the sentence, and the formula.
constexpr std::array<std::array<Key, 4>, why_names.size()> page_words = {{
    {},
    {"why.aberration", "why.aberration_rain", "why.aberration_abeam", "why.aberration_formula"},
    {"why.doppler", "why.doppler_waves", "why.doppler_abeam", "why.doppler_formula"},
    {"why.headlight", "why.headlight_more", "why.headlight_photons", "why.headlight_formula"},
    {"why.delay", "why.delay_seen", "why.delay_moving", "why.delay_formula"},
    {"why.dilation", "why.dilation_slow", "why.dilation_clocks", "why.dilation_formula"},
    {"why.length", "why.length_shorter", "why.length_seen", "why.length_formula"},
}};

/// Formats measured numbers for a page.
struct Formatter {
    const Words& words;
    double light_speed_m_s;

    std::string angle(const std::optional<double>& radians) const
    {
        return radians ? words("angle.degrees", {{"number", shown_number(*radians / degree, 2, words)}}) : "—";
    }
    std::string cosine(const std::optional<double>& radians) const
    {
        return shown_number(radians ? std::cos(*radians) : 1, 4, words);
    }
    std::string seconds(const std::optional<double>& s) const { return s ? shown_duration(*s, words, 2) : "—"; }
    std::string length(const std::optional<double>& s) const
    {
        return s ? shown_length(*s * light_speed_m_s, light_speed_m_s, words) : "—";
    }
    /// The name of a wavelength's colour or band.
    std::string wavelength(double nm) const
    {
        const auto phrase = [&](Key key, const std::string& number) { return words(key, {{"number", number}}); };
        return nm < 0.01 ? words("wave.gamma_rays")
            : nm < 10    ? words("wave.x_rays")
            : nm < 380   ? phrase("wave.ultraviolet", shown_number(nm, 0, words))
            : nm < 780   ? phrase("wave.visible", shown_number(nm, 0, words))
            : nm < 10000 ? phrase("wave.infrared", shown_number(nm, 0, words))
            : nm < 1e9   ? phrase("wave.far_infrared", shown_number(nm / 1000, words))
                         : words("wave.radio");
    }
};

} // namespace

Measured measured_of(const MeasuringObserver& observer, const Ship& ship, const SceneFile& scene, const World& world,
    const Effects& effects, const Spot& aim, double light, const std::array<std::optional<Spot>, 2>& marks)
{
    const double seconds = scene.seconds_per_time_unit();
    Measured m{.observer = observer,
        .ship_s = ship.proper_time.total() * seconds,
        .world_s = observer.time * seconds,
        .light_speed_m_s = scene.light_speed_m_s,
        .seconds_per_time_unit = seconds,
        .effects = effects,
        .aim = read_spot(observer, aim, world, seconds)};
    m.aim.light = light;
    for (std::size_t i = 0; i < 2; ++i)
        if (marks[i])
            m.marks[i] = read_spot(observer, *marks[i], world, seconds);
    if (marks[0] && marks[1])
        m.pair = read_pair(observer, *marks[0], *marks[1], world, seconds);
    return m;
}

WhyPage why_page(Why why, const Measured& m, const Words& words)
{
    if (why == Why::none)
        return {};
    const Formatter format{words, m.light_speed_m_s};
    const double speed = glm::length(m.observer.u), gamma = physics::gamma_of(m.observer.u);
    const std::string beta = shown_number(speed / gamma, 4, words), gammas = shown_number(gamma, words),
                      D = shown_number(m.aim.ray.D, words);
    const auto& [title, first, second, formula] = page_words[std::size_t(why)];
    WhyPage page{words(title), {words(first), words(second)}, words(formula), {}};
    const auto add = [&](Key key, const std::vector<std::pair<std::string_view, std::string>>& with = {}) {
        page.numbers.push_back(words(key, with));
    };
    const SpotReading& aim = m.aim;
    // The picture is not what these formulas say. The clocks on the display are.
    if (m.effects.comparison != Comparison::none && why != Why::dilation) {
        add("why.comparison");
        return page;
    }
    switch (why) {
    case Why::none:
        break;
    case Why::aberration:
        if (!m.effects[Effect::aberration]) {
            add("why.aberration_off");
            break;
        }
        add("why.aberration_numbers",
            {{"cos", format.cosine(aim.from_motion_world_rad)}, {"beta", beta},
                {"result", format.cosine(aim.from_motion_rad)}});
        add("why.aberration_angles",
            {{"theta", format.angle(aim.from_motion_world_rad)}, {"seen", format.angle(aim.from_motion_rad)}});
        break;
    case Why::doppler: { // of the motion past the spot, which may move itself
        const double spot_gamma = std::sqrt(1 + aim.relative_u * aim.relative_u), spot_beta = aim.relative_u / spot_gamma;
        // Without aberration a moving spot is not seen in this formula's direction.
        const double by_formula = 1 / (spot_gamma * (1 - spot_beta * std::cos(aim.from_relative_motion_rad.value_or(0))));
        if (m.effects[Effect::aberration] || std::abs(by_formula / aim.ray.D - 1) < 1e-3)
            add("why.doppler_numbers",
                {{"gamma", shown_number(spot_gamma, words)}, {"beta", shown_number(spot_beta, 4, words)},
                    {"cos", format.cosine(aim.from_relative_motion_rad)}, {"D", D}});
        else
            add("why.aberration_off");
        if (m.effects[Effect::doppler])
            add("why.doppler_seen", {{"nm", format.wavelength(aim.seen_nm)}});
        else
            add("why.doppler_off");
        break;
    }
    case Why::headlight:
        add("why.headlight_numbers", {{"D", D}, {"cube", shown_number(std::pow(aim.ray.D, 3), words)}});
        if (!m.effects[Effect::headlight])
            add("why.headlight_off");
        break;
    case Why::delay:
        if (aim.distance_s)
            add("why.delay_numbers",
                {{"now", format.seconds(m.world_s)}, {"way", format.seconds(aim.distance_s)},
                    {"left", format.seconds(aim.emitted_s)}});
        else
            add("why.delay_none");
        if (m.pair && m.pair->clocks_s)
            add("why.delay_marks",
                {{"first", format.seconds(m.marks[0]->clock_s)}, {"second", format.seconds(m.marks[1]->clock_s)},
                    {"apart", format.seconds(std::abs(*m.pair->clocks_s))}});
        break;
    case Why::dilation:
        add("why.dilation_numbers", {{"gamma", gammas}});
        add("why.dilation_ship", {{"ship", shown_duration(m.ship_s, words)}});
        break;
    case Why::length:
        if (m.pair && m.pair->apparent_s) {
            add("why.length_numbers",
                {{"rest", format.length(m.pair->rest_s)}, {"contracted", format.length(m.pair->contracted_s)}});
            add("why.length_apparent", {{"apparent", format.length(m.pair->apparent_s)}});
        } else {
            const bool far = m.pair && m.marks[0]->distance_s && m.marks[1]->distance_s;
            add(!m.pair ? "why.length_none"_key : far ? "why.aberration_off"_key : "why.length_sky"_key);
        }
    }
    return page;
}

std::array<std::pair<std::string, std::string>, 9> reading_fields(const Measured& m, const Words& words)
{
    const Formatter format{words, m.light_speed_m_s};
    const SpotReading& aim = m.aim;
    const std::string sky = words("lab.sky");
    std::array<std::pair<std::string, std::string>, 9> fields = {{
        {words("lab.doppler"), shown_number(aim.ray.D, words)},
        {words("lab.wavelength"), format.wavelength(aim.seen_nm)},
        {words("lab.angle"), aim.from_motion_rad ? format.angle(aim.from_motion_rad) : words("lab.at_rest")},
        {words("lab.distance"), aim.distance_s ? format.length(aim.distance_s) : sky},
        {aim.emitted_s ? words(m.effects.comparison == Comparison::no_light_delay ? "lab.shown_at"_key : "lab.emitted"_key)
                       : "",
            aim.emitted_s ? format.seconds(aim.emitted_s) : ""},
        {words("lab.light"), aim.light ? shown_number(*aim.light, words) : "—"},
        {"", ""},
        {"", ""},
        {"", ""},
    }};
    if (aim.clock_s)
        fields[5] = {words("lab.clock"), format.seconds(aim.clock_s)};
    if (!m.pair) {
        fields[6] = {words(m.marks[0] ? "lab.mark_another"_key : "lab.mark_two"_key), ""};
        return fields;
    }
    fields[6] = {words("lab.marks_angle"), format.angle(m.pair->angle_rad)};
    fields[7] = {words("lab.marks_length"), "—"};
    if (m.pair->apparent_s) {
        std::string apparent = format.length(m.pair->apparent_s), rest = format.length(m.pair->rest_s);
        // Equal units are written once.
        const auto unit = apparent.find(' ');
        if (unit != apparent.npos && rest.ends_with(apparent.substr(unit)))
            apparent.erase(unit);
        fields[7].second = words("lab.marks_lengths", {{"apparent", apparent}, {"rest", rest}});
    }
    if (m.pair->clocks_s)
        fields[8] = {words("lab.marks_clocks"), format.seconds(m.pair->clocks_s)};
    return fields;
}

} // namespace starbow
