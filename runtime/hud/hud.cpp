#include "hud.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/model/named_words.h"
#include "shaders/physics/physics.h"
#include "visitor_panel.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <stb/stb_truetype.h>

namespace starbow {
namespace {

constexpr double light_speed_m_s = 299792458; // exact, SI
constexpr double julian_year_s = 365.25 * 86400;

template <class... Values> std::string text(const char* format, Values... values)
{
    std::array<char, 96> buffer;
    std::snprintf(buffer.data(), buffer.size(), format, values...);
    return buffer.data();
}

/// 3 or 4 figures: 0.25, 12.3, 4567; beyond a million as 1.23×10⁷.
std::string number(double x)
{
    double size = std::abs(x);
    if (size != 0 && (size >= 999999.5 || size < 1e-3)) { // six figures after rounding are the most that fit
        int exponent = int(std::floor(std::log10(size)));
        double mantissa = x / std::pow(10.0, exponent);
        if (std::abs(mantissa) >= 9.95)
            mantissa /= 10, ++exponent;
        static const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
        std::string power = exponent < 0 ? "⁻" : "";
        for (char c : std::to_string(std::abs(exponent)))
            power += digits[c - '0'];
        return text("%.1f×10", mantissa) + power;
    }
    return text(size >= 1000 ? "%.0f" : size >= 100 ? "%.1f" : size >= 10 ? "%.2f" : "%.3f", x);
}

/// A number of printf in the language's style: its decimal sign, a minus as long as a plus, and none before zero.
std::string figures(std::string c, const Words& words)
{
    if (c.starts_with('-'))
        c = c.find_first_of("123456789") == c.npos ? c.substr(1) : "−" + c.substr(1);
    return words.number(c);
}

} // namespace

std::string shown_number(double x, const Words& words) { return figures(number(x), words); }
std::string shown_number(double x, int decimals, const Words& words) { return figures(text("%.*f", decimals, x), words); }

std::string shown_duration(double s, const Words& words, int decimals)
{
    double size = std::abs(s);
    const auto phrase = [&](Key key, const std::string& figures) { return words(key, {{"number", figures}}); };
    return size < 600              ? phrase("time.s", shown_number(s, decimals, words))
        : size < 36000             ? phrase("time.min", shown_number(s / 60, 1, words))
        : size < 10 * 86400.0      ? phrase("time.h", shown_number(s / 3600, 1, words))
        : size < 2 * julian_year_s ? phrase("time.days", shown_number(s / 86400, 1, words))
                                   : phrase("time.years", shown_number(s / julian_year_s, words));
}

std::string shown_length(double m, double scene_light_speed_m_s, const Words& words)
{
    const auto phrase = [&](Key key, const std::string& figures) { return words(key, {{"number", figures}}); };
    if (scene_light_speed_m_s == light_speed_m_s && m > 1e6) {
        double s = m / light_speed_m_s;
        return s < 600               ? phrase("length.light_s", shown_number(s, 2, words))
            : s < 36000              ? phrase("length.light_min", shown_number(s / 60, 1, words))
            : s < julian_year_s / 10 ? phrase("length.light_h", shown_number(s / 3600, 1, words))
                                     : phrase("length.light_years", shown_number(s / julian_year_s, words));
    }
    return m < 1000 ? phrase("length.m", shown_number(m, 1, words)) : phrase("length.km", shown_number(m / 1000, words));
}

Panel plate(glm::ivec2 size, double corner)
{
    Panel panel;
    panel.size = size;
    panel.texels.assign(std::size_t(panel.size.x) * panel.size.y * 2, 0);
    for (int y = 0; y < panel.size.y; ++y)
        for (int x = 0; x < panel.size.x; ++x) {
            glm::dvec2 half = 0.5 * glm::dvec2(panel.size);
            glm::dvec2 out = glm::max(glm::abs(glm::dvec2(x + 0.5, y + 0.5) - half) - (half - corner), 0.0);
            panel.texels[2 * (std::size_t(y) * panel.size.x + x) + 1]
                = std::uint8_t(255 * std::clamp(corner - glm::length(out) + 0.5, 0.0, 1.0));
        }
    return panel;
}

Readings readings(const Ship& ship, const SceneFile& scene, const Effects& effects)
{
    double seconds_per_time_unit = scene.seconds_per_time_unit(), unit_m = scene.unit_m;
    glm::dvec3 u = ship.u.total();
    double speed = glm::length(u), gamma = physics::gamma_of(u), E = physics::exp_rapidity(speed);
    glm::dvec3 ahead = ship.ship_from_cockpit * glm::dvec3(0, 0, -1);
    double cosine = speed > 0 ? std::clamp(glm::dot(ahead, u) / speed, -1.0, 1.0) : 1;
    double sine = speed > 0 ? glm::length(glm::cross(ahead, u)) / speed : 0;
    return {.beta_deficit = 1 / (gamma * (gamma + speed)),
        .gamma = gamma,
        .doppler_ahead = physics::world_from_camera({sine, 0, cosine}, E, 1 / E).D,
        .looked_cosine = cosine,
        .ship_s = ship.proper_time.total() * seconds_per_time_unit,
        .world_s = ship.time.total() * seconds_per_time_unit,
        .distance_m = ship.distance.total() * unit_m,
        .light_speed_m_s = scene.light_speed_m_s,
        .frames_per_s = 0,
        .effects = effects};
}

Readings readings(const Flight& flight, const SceneFile& scene, const Comfort& comfort)
{
    Readings shown = readings(flight.ship, scene, flight.effects);
    const Shot seen = shot_of(flight, "", comfort);
    if (const double speed = glm::length(seen.u); speed > 0)
        shown.looked_cosine = std::clamp(glm::dot(seen.ship_from_cockpit * glm::dvec3(0, 0, -1), seen.u) / speed, -1.0, 1.0);
    return shown;
}

void show_on(Information information, double start_s, Readings& readings)
{
    readings.information = information;
    if (information != Information::laboratory)
        readings.world_s -= start_s;
}

std::string range_sentence(const Readings::Range& range, const Words& words)
{
    const std::string stops = text("%.0f", range.stops), shown = text("%.0f", range.shown);
    return stops == shown ? words("hud.range_whole", {{"stops", stops}})
                          : words("hud.range", {{"stops", stops}, {"shown", shown}});
}

std::string light_name(const Effects& on, const Words& words)
{
    if (on.comparison != Comparison::none)
        return words(on.comparison == Comparison::galilean ? "light.galilean"_key : "light.no_light_delay"_key);
    if (on[Effect::false_colours])
        return words(on[Effect::doppler] ? "light.false_colours"_key : "light.false_colours_unshifted"_key);
    return words(on[Effect::doppler] ? on[Effect::headlight] ? "light.seen"_key : "light.without_headlight"_key
            : on[Effect::headlight]  ? "light.without_doppler"_key
                                     : "light.at_rest"_key);
}

std::vector<std::pair<std::string, std::string>> hud_fields(const Readings& r, const Words& words)
{
    bool close = r.beta_deficit < 1e-3;
    std::vector<std::pair<std::string, std::string>> fields = {
        {words(close ? "hud.speed_deficit"_key : "hud.speed"_key),
            close ? shown_number(r.beta_deficit, words) : shown_number(1 - r.beta_deficit, 4, words)},
        {words("hud.gamma"), shown_number(r.gamma, words)},
        {words("hud.doppler_ahead"), shown_number(r.doppler_ahead, words)},
        {words("hud.ship"), shown_duration(r.ship_s, words)},
        {words("hud.world"), shown_duration(r.world_s, words)},
        {words("hud.flown"), shown_length(r.distance_m, r.light_speed_m_s, words)},
    };
    constexpr auto effect_keys = keys_of_usual_effects("hud.");
    for (const EffectEntry& one : all_effects)
        if (one.usual)
            fields.emplace_back(
                words(effect_keys[std::size_t(one.which)]), words(r.effects[one.which] ? "hud.on"_key : "hud.off"_key));
    fields.push_back({words("hud.flight"), words(r.frozen ? "flight.frozen"_key : mode_words[std::size_t(r.mode)])});
    const double ev = std::round(10 * r.exposure_ev) / 10;
    const std::string sign = ev < 0 ? "−" : ev > 0 ? "+" : "";
    std::string exposure = words(r.exposure_locked ? "hud.ev_locked"_key
            : r.filtered                           ? "hud.ev_filtered"_key
                                                   : "hud.ev"_key,
        {{"ev", sign + shown_number(std::abs(ev), 1, words)}});
    if (r.range)
        exposure = words("hud.ev_range",
            {{"stops", text("%.0f", r.range->stops)}, {"shown", text("%.0f", r.range->shown)}, {"ev", exposure}});
    fields.push_back({words("hud.exposure"), exposure});
    if (r.frames_per_s > 0)
        fields.push_back({words("hud.rate"), text("%.0f", r.frames_per_s)});
    fields.push_back({words("hud.light"), light_name(r.effects, words)});
    return fields;
}

struct Typesetter::Font {
    std::string file;
    stbtt_fontinfo info{};

    struct Glyph {
        std::vector<std::uint8_t> coverage;
        int width = 0, height = 0, left = 0, top = 0;
        float advance = 0;
    };
    mutable std::map<std::pair<int, int>, Glyph> glyphs; ///< by size in pixels and code point

    const Glyph& glyph(int size, int code) const
    {
        auto [at, is_new] = glyphs.try_emplace({size, code});
        Glyph& g = at->second;
        if (is_new) {
            float scale = stbtt_ScaleForPixelHeight(&info, float(size));
            int advance, bearing;
            stbtt_GetCodepointHMetrics(&info, code, &advance, &bearing);
            g.advance = advance * scale;
            if (unsigned char* bitmap
                = stbtt_GetCodepointBitmap(&info, scale, scale, code, &g.width, &g.height, &g.left, &g.top)) {
                g.coverage.assign(bitmap, bitmap + g.width * g.height);
                stbtt_FreeBitmap(bitmap, nullptr);
            }
        }
        return g;
    }
};

namespace {

/// The code points of well-formed UTF-8.
std::vector<int> code_points(const std::string& utf8)
{
    std::vector<int> codes;
    for (std::size_t i = 0; i < utf8.size();) {
        auto lead = static_cast<unsigned char>(utf8[i]);
        int more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc0 ? 1 : 0;
        int code = more == 0 ? lead : lead & (0x3f >> more);
        for (++i; more > 0 && i < utf8.size(); --more, ++i)
            code = code << 6 | (utf8[i] & 0x3f);
        codes.push_back(code);
    }
    return codes;
}

} // namespace

std::string font_fault(std::string_view bytes)
{
    // OpenType specification 1.9, "Organization of an OpenType Font": numbers are big-endian, a table's record has its tag,
    // the sum of its words, its place and its length.
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = at; i < at + 4; ++i)
            value = value << 8 | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0);
        return value;
    };
    if (bytes.size() < 12 || word(0) != 0x00010000)
        return "is not a TrueType font";
    const std::size_t tables = word(4) >> 16;
    std::set<std::string_view> needed{"cmap", "glyf", "head", "hhea", "hmtx", "loca", "maxp"};
    for (std::size_t i = 0; i < tables; ++i) {
        const std::size_t record = 12 + 16 * i;
        if (bytes.size() < record + 16)
            return "is cut off in the list of its tables";
        const std::string_view tag = bytes.substr(record, 4);
        const std::size_t begin = word(record + 8), length = word(record + 12);
        if (begin > bytes.size() || length > bytes.size() - begin)
            return "is cut off in its table " + one_line(std::string(tag));
        std::uint32_t sum = tag == "head" && length >= 12 ? 0u - word(begin + 8) : 0; // that word counts as 0
        for (std::size_t at = begin; at < begin + length; at += 4)
            sum += word(at);
        if (sum != word(record + 4))
            return "is damaged in its table " + one_line(std::string(tag));
        needed.erase(tag);
    }
    return needed.empty() ? "" : "lacks the table " + std::string(*needed.begin());
}

Typesetter::Typesetter(const std::filesystem::path& file)
    : font_(std::make_unique<Font>())
{
    const std::string right = "DejaVu Sans, which the package fonts-dejavu-core installs,";
    font_->file = read_whole(file, std::size_t(16) << 20, right);
    const std::string fault = font_fault(font_->file);
    const auto* bytes = reinterpret_cast<const unsigned char*>(font_->file.data());
    if (!fault.empty() || !stbtt_InitFont(&font_->info, bytes, 0))
        throw InputError(
            one_line(file.string()), "", (fault.empty() ? "is not a font" : fault) + "; " + right + " is right");
}

Typesetter::~Typesetter() = default;

double Typesetter::width_of(const std::string& line, int size) const
{
    double x = 0;
    for (int code : code_points(line))
        x += font_->glyph(size, code).advance;
    return x;
}

void Typesetter::write(Panel& panel, const std::string& line, double x, double baseline, int size, double strength) const
{
    for (int code : code_points(line)) {
        const Font::Glyph& glyph = font_->glyph(size, code);
        for (int j = 0; j < glyph.height; ++j)
            for (int i = 0; i < glyph.width; ++i) {
                int px = int(std::lround(x)) + glyph.left + i, py = int(std::lround(baseline)) + glyph.top + j;
                if (px < 0 || py < 0 || px >= panel.size.x || py >= panel.size.y)
                    continue;
                std::uint8_t& letter = panel.texels[2 * (std::size_t(py) * panel.size.x + px)];
                letter = std::max(letter, std::uint8_t(strength * glyph.coverage[std::size_t(j) * glyph.width + i]));
            }
        x += glyph.advance;
    }
}

Panel Typesetter::draw(const Readings& readings, const Words& words, int width) const
{
    const int height = int(width * panel_aspect);
    Panel panel = plate({width, height}, height * 0.12);

    // The lever's track along the left edge, filled up to the lever's place. Stills have no lever.
    const glm::ivec2 from(panel.size.x * 0.016, panel.size.y * 0.13), to(panel.size.x * 0.023, panel.size.y * 0.87);
    const int filled = to.y - int(std::lround((to.y - from.y) * std::clamp(readings.lever.value_or(0), 0.0, 1.0)));
    for (int y = from.y; readings.lever && y < to.y; ++y)
        for (int x = from.x; x < to.x; ++x)
            panel.texels[2 * (std::size_t(y) * panel.size.x + x)] = y >= filled ? 255 : 64;

    if (readings.caption) {
        // The guide's text has the number that the step is about; the ship's would only stand beside it.
        std::vector<std::pair<std::string, std::string>> fields;
        if (!readings.notice.empty())
            fields = {{readings.notice, ""}};
        else if (const std::string verdict = verdict_of(*readings.caption); !verdict.empty())
            fields = {{verdict, ""}};
        else if (readings.caption->flying && readings.information == Information::visitor)
            fields = {{shown_percent(readings.beta_deficit, words), words("say.of_light")}};
        else if (readings.caption->flying)
            fields = hud_fields(readings, words);
        Caption caption = *readings.caption;
        if (readings.range && caption.aside.empty())
            caption.aside = range_sentence(*readings.range, words);
        write_caption(panel, *this, caption, fields);
        return panel;
    }

    if (readings.information != Information::laboratory) {
        write_visitor_panel(panel, *this, readings, words);
        return panel;
    }

    // Three rows of three, with the speed row larger. A prompt replaces the third row; notices are below.
    auto fields = hud_fields(readings, words);
    double unit = panel.size.y;
    const double rows[] = {0.27, 0.53, 0.76};
    const double columns[] = {0.04, 0.415, 0.64};
    const double sizes[] = {0.26, 0.20, 0.20};
    for (int i = 0; i < (readings.prompt.empty() ? 9 : 6); ++i) {
        int column = i % 3;
        double x = panel.size.x * columns[column],
               room = panel.size.x * (column < 2 ? columns[column + 1] - 0.02 : 0.97) - x;
        int size = int(sizes[i / 3] * unit);
        auto label = [&] { return int(0.7 * size); };
        auto value_at = [&] { return width_of(fields[i].first, label()) + 0.3 * size; };
        while (size > 6
            && value_at() + width_of(fields[i].second, size)
                > room) // long figures shrink, so that they never reach the next column
            --size;
        write(panel, fields[i].first, x, rows[i / 3] * unit, label(), 0.72);
        write(panel, fields[i].second, x + value_at(), rows[i / 3] * unit, size, 1);
    }
    int prompt_size = int(0.24 * unit);
    while (prompt_size > 6 && width_of(readings.prompt, prompt_size) > 0.93 * panel.size.x)
        --prompt_size;
    write(panel, readings.prompt, panel.size.x * columns[0], 0.785 * unit, prompt_size, 1);
    // A long notice shrinks, down to half, and then replaces the frame rate.
    const int small = int(0.15 * unit);
    const auto notice_width = [&](int size) { return width_of(readings.notice, size) / panel.size.x; };
    int notice_size = small;
    while (notice_size > small / 2 && notice_width(notice_size) > 0.92)
        --notice_size;
    double room = 0.92 * panel.size.x; // left of the rate
    if (notice_width(notice_size) < 0.7) {
        std::string rate = fields[9].second + "   " + fields[10].second;
        if (readings.frames_per_s > 0)
            rate += "   " + fields[11].second + " " + fields[11].first;
        const double width = width_of(rate, small);
        write(panel, rate, panel.size.x * 0.96 - width, 0.93 * unit, small, 0.72);
        room -= width + small;
    }
    if (readings.notice.empty()) {
        const std::string light = light_name(readings.effects, words);
        int size = small;
        while (size > 6 && width_of(light, size) > room)
            --size;
        write(panel, light, panel.size.x * 0.04, 0.93 * unit, size, 0.72);
    }
    write(panel, readings.notice, panel.size.x * 0.04, 0.93 * unit, notice_size, 1);
    return panel;
}

} // namespace starbow
