#include "lab_panel.h"
#include "config/model/angles.h"
#include "lab_scales.h"
#include "why_sketch.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double margin = 0.035; ///< part of the width

bool has_scale(Overlay overlay) { return overlay == Overlay::distance || overlay == Overlay::emission; }

/// Writes a line in at most `room` pixels; long lines shrink.
void write_within(const Typesetter& typesetter, Panel& panel, const std::string& line, double x, double baseline, int size,
    double room, double strength)
{
    while (size > 6 && typesetter.width_of(line, size) > room)
        --size;
    typesetter.write(panel, line, x, baseline, size, strength);
}

/// Removes zeros at a fraction's end: 2.000 s says no more than 2 s.
std::string rounded(const std::string& label, const Words& words)
{
    const auto point = label.find(words("decimal_sign")), end = label.find(' ');
    if (point == label.npos || end == label.npos || point > end)
        return label;
    const auto last = label.find_last_not_of('0', end - 1);
    return label.substr(0, last == point ? point : last + 1) + label.substr(end);
}

std::string rounded_s(double s, const Words& words)
{
    return rounded(words("time.s", {{"number", shown_number(s, words)}}), words);
}

std::string overlay_line(Overlay overlay, const Measured& measured, const OverlayScale& scale, const Words& words)
{
    const auto unshifted = unshifted_angle(measured.observer);
    const std::string angle
        = unshifted ? words("angle.degrees", {{"number", shown_number(*unshifted / degree, 2, words)}}) : "";
    switch (overlay) {
    case Overlay::grid:
        return words("overlay.grid");
    case Overlay::ring:
        return unshifted ? words("overlay.ring", {{"unshifted", angle}}) : words("overlay.ring_rest");
    case Overlay::distance:
        return words("overlay.distance");
    case Overlay::emission:
        return words("overlay.emission",
            {{"step", rounded_s(scale.emission_step_s, words)}, {"five", rounded_s(5 * scale.emission_step_s, words)}});
    case Overlay::protractor:
        return words("overlay.protractor");
    case Overlay::off:
    case Overlay::aim:
    case Overlay::spectrum:
    case Overlay::photometer:
        break;
    }
    return unshifted ? words("overlay.aim", {{"unshifted", angle}}) : words("overlay.aim_rest");
}

/// True if an overlay's line shows where D is 1, which is a figure of the theory.
bool line_has_figure(Overlay overlay)
{
    return overlay != Overlay::grid && overlay != Overlay::protractor && !has_scale(overlay);
}

/// Writes numbers under the scale of colours: at 1, 2 and 5 times powers of ten.
void write_scale(const Typesetter& typesetter, Panel& panel, Overlay overlay, const OverlayScale& scale, double speed_m_s,
    const Words& words)
{
    const glm::vec4 place = scale_place(overlay, Why::none);
    const double left = place.x * panel.size.x, wide = (place.z - place.x) * panel.size.x, top = 1 - place.y;
    const double octaves = std::log10(scale.farthest_s / scale.nearest_s);
    const int size = int(0.10 * panel.size.y);
    const auto write_at = [&](double at_s, const std::string& label) {
        const double x = left + wide * std::log10(at_s / scale.nearest_s) / octaves;
        const double half = 0.5 * typesetter.width_of(label, size);
        typesetter.write(panel, label, std::clamp(x - half, 0.015 * panel.size.x, 0.985 * panel.size.x - 2 * half),
            (top + 0.11) * panel.size.y, size, 1);
        // A tick in the colours.
        for (int y = int((1 - place.w) * panel.size.y); y < int(top * panel.size.y); ++y)
            if (x > left + 1 && x < left + wide - 1)
                panel.texels[2 * (std::size_t(y) * panel.size.x + std::size_t(x))] = 200;
    };
    double before = -1;
    for (int k = int(std::floor(std::log10(scale.nearest_s))); k <= int(std::ceil(std::log10(scale.farthest_s))); ++k)
        for (int step : {1, 2, 5}) {
            const double at = step * std::pow(10.0, k), x = std::log10(at / scale.nearest_s) / octaves;
            if (x < -1e-6 || x > 1 + 1e-6 || x - before < 0.13)
                continue;
            before = x;
            write_at(at,
                overlay == Overlay::emission ? rounded_s(at, words)
                                             : rounded(shown_length(at * speed_m_s, speed_m_s, words), words));
        }
}

/// The readings' figures, in three rows.
void write_fields(const Typesetter& typesetter, Panel& panel, const Words& words, const Measured& measured)
{
    const int width = panel.size.x, unit = int(width * readings_aspect);
    const auto fields = reading_fields(measured, words);
    const double rows[] = {0.26, 0.50, 0.74}, columns[] = {margin, 0.36, 0.71};
    for (int i = 0; i < 9; ++i) {
        const double x = width * columns[i % 3], room = width * (i % 3 < 2 ? columns[i % 3 + 1] - 0.02 : 1 - margin) - x;
        int size = int((i < 3 ? 0.22 : 0.18) * unit);
        const auto label = [&] { return int(0.72 * size); };
        const auto value_at = [&] { return typesetter.width_of(fields[i].first, label()) + 0.3 * size; };
        while (size > 6 && value_at() + typesetter.width_of(fields[i].second, size) > room)
            --size;
        typesetter.write(panel, fields[i].first, x, rows[i / 3] * unit, label(), 0.72);
        typesetter.write(panel, fields[i].second, x + value_at(), rows[i / 3] * unit, size, 1);
    }
}

/// Sentences in the figures' place.
void write_sentences(const Typesetter& typesetter, Panel& panel, const std::string& text)
{
    const double unit = panel.size.x * readings_aspect, room = panel.size.x * (1 - 2 * margin);
    int letters = int(0.2 * unit);
    std::vector<std::string> lines;
    for (;; --letters) {
        lines = wrapped(text, room, [&](const std::string& line) { return typesetter.width_of(line, letters); });
        if (letters <= 6 || 1.3 * letters * double(lines.size()) < 0.65 * unit)
            break;
    }
    for (std::size_t i = 0; i < lines.size(); ++i)
        typesetter.write(panel, lines[i], margin * panel.size.x, 0.1 * unit + letters * (0.9 + 1.3 * double(i)), letters, 1);
}

Panel draw_readings(
    const Typesetter& typesetter, const Words& words, const Measured& measured, const LabView& view, int width)
{
    const glm::ivec2 size(width, int(width * lab_aspect(view.overlay, Why::none)));
    const int unit = int(width * readings_aspect);
    if (view.by_eye_says.empty() && view.overlay == Overlay::spectrum)
        return draw_spectroscope(typesetter, words, measured.aim.seen_nm, size);
    if (view.by_eye_says.empty() && view.overlay == Overlay::photometer)
        return draw_photometer(typesetter, words, measured.aim.light.value_or(0), size);
    Panel panel = plate(size, unit * 0.12);
    if (view.by_eye)
        write_sentences(typesetter, panel, view.by_eye_says.empty() ? words("lab.by_eye") : view.by_eye_says);
    else
        write_fields(typesetter, panel, words, measured);
    if (!view.by_eye || !line_has_figure(view.overlay))
        write_within(typesetter, panel, overlay_line(view.overlay, measured, view.scale, words), width * margin, 0.93 * unit,
            int(0.14 * unit), width * (1 - 2 * margin), 0.85);
    if (has_scale(view.overlay))
        write_scale(typesetter, panel, view.overlay, view.scale, measured.light_speed_m_s, words);
    return panel;
}

/// The page: a sketch at the left, the sentence beside it; below them the numbers, and the formula last.
Panel draw_page(const Typesetter& typesetter, const WhyPage& page, const std::vector<Stroke>& sketch, int width)
{
    const int height = int(width * why_aspect);
    Panel panel = plate({width, height}, width * readings_aspect * 0.12);
    constexpr double sketch_side = 0.36, beside = 0.42; // parts of the width
    draw_strokes(panel, sketch, double(width) * glm::dvec2(margin + 0.5 * sketch_side, margin + 0.5 * sketch_side),
        0.5 * width * sketch_side);
    const auto largest = [&](const std::vector<std::string>& lines, double size, double room) {
        int pixels = int(size * width);
        for (const std::string& line : lines)
            while (pixels > 6 && typesetter.width_of(line, pixels) > room * width)
                --pixels;
        return pixels;
    };
    constexpr double room = 1 - margin - beside;
    typesetter.write(panel, page.title, beside * width, 0.08 * width, largest({page.title}, 0.06, room), 1);
    std::string sentence;
    for (const std::string& line : page.sentence)
        sentence += (sentence.empty() ? "" : " ") + line;
    int pixels = int(0.045 * width);
    std::vector<std::string> lines;
    for (;; --pixels) {
        lines = wrapped(sentence, room * width, [&](const std::string& text) { return typesetter.width_of(text, pixels); });
        if (pixels <= 6 || 1.25 * pixels * double(lines.size()) < 0.27 * width)
            break;
    }
    double y = 0.08 * width + 1.5 * pixels;
    for (const std::string& line : lines) {
        typesetter.write(panel, line, beside * width, y, pixels, 0.9);
        y += 1.25 * pixels;
    }
    constexpr double whole = 1 - 2 * margin;
    const int numbers = largest(page.numbers, 0.04, whole), formula = largest({page.formula}, 0.04, whole);
    y = height - 0.028 * width;
    typesetter.write(panel, page.formula, margin * width, y, formula, 0.85);
    y -= 1.3 * formula;
    for (auto line = page.numbers.rbegin(); line != page.numbers.rend(); ++line) {
        typesetter.write(panel, *line, margin * width, y, numbers, 1);
        y -= 1.2 * numbers;
    }
    return panel;
}

} // namespace

double lab_aspect(Overlay overlay, Why why)
{
    return why != Why::none ? why_aspect : has_scale(overlay) ? scaled_aspect : readings_aspect;
}

glm::vec4 scale_place(Overlay overlay, Why why)
{
    if (why != Why::none || !has_scale(overlay))
        return glm::vec4(0);
    return {0.06, 0.155, 0.94, 0.215};
}

Panel draw_lab_panel(const Typesetter& typesetter, const Words& words, const Measured& measured, const LabView& view,
    int width, double sketch_s)
{
    if (view.why == Why::none)
        return draw_readings(typesetter, words, measured, view, width);
    // The sketch flies as fast as the formula beside it: for the Doppler effect past the spot, which may move itself.
    const double gamma_beta = view.why == Why::doppler ? measured.aim.relative_u : glm::length(measured.observer.u);
    WhyPage page = why_page(view.why, measured, words);
    if (view.by_eye)
        page.numbers.clear();
    return draw_page(typesetter, page, why_sketch(view.why, gamma_beta, sketch_s), width);
}

} // namespace starbow
