#include "caption.h"
#include "hud.h"
#include "runtime/flight/measuring.h"
#include "runtime/flight/tour.h"
#include <array>
#include <cmath>
#include <cstdio>

namespace starbow {
namespace {

/// About three figures, enough for a caption.
std::string figures(double x, const Words& words)
{
    std::array<char, 32> text;
    const double size = std::abs(x);
    std::snprintf(text.data(), text.size(), size < 9.995 ? "%.2f" : size < 99.95 ? "%.1f" : "%.0f", size);
    return (x < 0 ? "−" : "") + words.number(text.data());
}

std::string whole(double seconds) { return std::to_string(std::lround(std::ceil(seconds))); }

} // namespace

Caption caption_of(const Touring& now, const Show& show, const Words& words, const InputCapabilities& capabilities)
{
    if (now.over)
        return {};
    const Step& step = show.tour.steps[now.step()];
    const bool tries = std::holds_alternative<Try>(step.motion);
    Caption caption{step.caption};
    const auto number = [&](const Measure& measure) {
        return figures(measured(measure, now.flight.ship, now.starts.back().since, show.seconds_per_time_unit), words);
    };
    if (step.measure)
        caption.text = filled(caption.text, {{"measured", number(*step.measure)}});
    const std::string left = whole(left_s(now, show));
    caption.flying = tries && !now.measured_answer;
    if (caption.flying)
        caption.aside = words("touring.fly", {{"left", left}});
    if (step.question && now.measured_answer) {
        caption.text = words(now.right ? *now.right ? "touring.right"_key : "touring.wrong"_key : "touring.answer"_key) + " "
            + filled(step.question->explanation, {{"measured", figures(*now.measured_answer, words)}});
        if (const auto* choices = std::get_if<std::vector<Choice>>(&step.question->answer))
            for (const Choice& choice : *choices) {
                if (*now.measured_answer >= choice.from && *now.measured_answer < choice.below)
                    caption.right = int(caption.choices.size());
                caption.choices.push_back(choice.text);
            }
        caption.chosen = now.right ? now.chosen : -1;
    } else if (step.question) {
        caption.text = step.question->ask;
        if (const auto* choices = std::get_if<std::vector<Choice>>(&step.question->answer)) {
            for (const Choice& choice : *choices)
                caption.choices.push_back(choice.text);
            caption.chosen = now.chosen;
        } else if (std::holds_alternative<NumberToSet>(step.question->answer)) {
            caption.choices = {"← " + figures(now.number, words) + " →"};
            caption.chosen = 0;
        }
        if (!tries && show.visitors)
            caption.aside = capabilities.stick && capabilities.stop_button > 0
                ? words("touring.choose_stick", {{"button", std::to_string(capabilities.stop_button)}, {"left", left}})
                : words("touring.choose_keys", {{"left", left}});
    }
    const bool by_buttons
        = capabilities.stick && capabilities.stop_button > 0 && capabilities.home_button > 0 && capabilities.undo_button > 0;
    const std::vector<std::pair<std::string_view, std::string>> buttons{{"stop", std::to_string(capabilities.stop_button)},
        {"on", std::to_string(capabilities.home_button)}, {"back", std::to_string(capabilities.undo_button)}};
    if (now.paused)
        caption.aside = by_buttons ? words("touring.paused_stick", buttons) : words("touring.paused_keys");
    else if (caption.aside.empty() && show.visitors)
        caption.aside = by_buttons ? words("touring.guide_stick", buttons) : words("touring.guide_keys");
    return caption;
}

std::string verdict_of(const Caption& caption)
{
    if (caption.right < 0)
        return {};
    std::string verdict = "✓ " + caption.choices[std::size_t(caption.right)];
    if (caption.chosen >= 0 && caption.chosen != caption.right)
        verdict += "   ✗ " + caption.choices[std::size_t(caption.chosen)];
    return verdict;
}

/// Writes a menu's page: its title small at the top, or while the visitor flies the figures; the chosen choice large in the
/// middle, its neighbours at the sides.
static void write_menu(Panel& panel, const Typesetter& typesetter, const Caption& caption,
    const std::vector<std::pair<std::string, std::string>>& fields)
{
    const double width = panel.size.x, height = panel.size.y;
    const auto write
        = [&](const std::string& text, double middle, double baseline, double part, double room, double strength) {
              int size = int(part * height);
              while (size > 6 && typesetter.width_of(text, size) > room * width)
                  --size;
              typesetter.write(
                  panel, text, middle * width - 0.5 * typesetter.width_of(text, size), baseline * height, size, strength);
          };
    const int count = int(caption.choices.size()), chosen = caption.chosen;
    if (count == 0)
        return;
    const auto at = [&](int i) { return caption.choices[std::size_t((i + count) % count)]; };
    std::string top = caption.text;
    if (caption.flying)
        for (std::size_t i = 0; i < fields.size() && i < 4; ++i)
            top += (top.empty() ? "" : "     ") + fields[i].first + " " + fields[i].second;
    write(top, 0.5, 0.25, 0.19, 0.9, 0.8);
    write(at(chosen), 0.5, 0.62, 0.34, 0.5, 1);
    if (count > 1)
        write(at(chosen + 1) + " ›", 0.87, 0.6, 0.17, 0.21, 0.6);
    if (count > 2)
        write("‹ " + at(chosen - 1), 0.13, 0.6, 0.17, 0.21, 0.6);
    // A docent's or a tour's sentence may take two lines.
    int size = int(0.16 * height);
    std::vector<std::string> lines;
    for (;; --size) {
        lines
            = wrapped(caption.aside, 0.92 * width, [&](const std::string& text) { return typesetter.width_of(text, size); });
        if (size <= 6 || lines.size() == 1 || (lines.size() == 2 && size <= int(0.135 * height)))
            break;
    }
    for (std::size_t i = 0; i < lines.size(); ++i)
        typesetter.write(panel, lines[i], 0.5 * (width - typesetter.width_of(lines[i], size)),
            (lines.size() == 1 ? 0.89 : 0.82 + 0.14 * double(i)) * height, size, 0.8);
}

void write_caption(Panel& panel, const Typesetter& typesetter, const Caption& caption,
    const std::vector<std::pair<std::string, std::string>>& fields)
{
    if (caption.menu)
        return write_menu(panel, typesetter, caption, fields);
    const double width = panel.size.x, height = panel.size.y, left = 0.04 * width, right = 0.97 * width;
    // Above: the controls at the right, and at the left as many of the figures as fit.
    const int small = std::max(6, int(0.13 * height));
    const double line = 0.18 * height;
    const double aside = right - typesetter.width_of(caption.aside, small);
    typesetter.write(panel, caption.aside, aside, line, small, 1);
    double x = left;
    for (std::size_t i = 0; i < fields.size() && i < 5; ++i) {
        const std::string field = fields[i].first + " " + fields[i].second;
        int size = small;
        while (fields.size() == 1 && size > 6 && x + typesetter.width_of(field, size) > aside - small)
            --size; // a notice is alone and is shown whole
        const double end = x + typesetter.width_of(field, size);
        if (i > 0 && end > aside - small)
            break;
        typesetter.write(panel, field, x, line, size, 0.72);
        x = end + 1.2 * small;
    }

    // The largest size at which all lines fit.
    const double top = 0.23 * height, room = 0.72 * height, pitch = 1.18;
    int size = int(0.21 * height);
    std::vector<std::string> lines;
    const int rows = caption.choices.empty() || caption.right >= 0 ? 0 : 1;
    for (;; --size) {
        lines
            = wrapped(caption.text, right - left, [&](const std::string& text) { return typesetter.width_of(text, size); });
        double widest = 0;
        for (const std::string& text : lines)
            widest = std::max(widest, typesetter.width_of(text, size));
        if (size <= 6 || (double(lines.size() + rows) * pitch * size <= room && widest <= right - left))
            break;
    }
    const double slack = std::max(0.0, room - double(lines.size() + rows) * pitch * size);
    double baseline = top + (rows ? 0 : 0.5 * slack) + 0.9 * size;
    for (const std::string& text : lines) {
        typesetter.write(panel, text, left, baseline, size, 1);
        baseline += pitch * size;
    }
    if (!rows)
        return;

    // The choices side by side, all of one size.
    const double column = (right - left) / double(caption.choices.size());
    const auto shown = [&](std::size_t i) { return (int(i) == caption.chosen ? "▸ " : "   ") + caption.choices[i]; };
    int choice_size = size;
    for (std::size_t i = 0; i < caption.choices.size(); ++i)
        while (choice_size > 6 && typesetter.width_of(shown(i), choice_size) > column - 0.3 * size)
            --choice_size;
    for (std::size_t i = 0; i < caption.choices.size(); ++i)
        typesetter.write(panel, shown(i), left + double(i) * column, 0.90 * height, choice_size,
            caption.chosen < 0 || int(i) == caption.chosen ? 1 : 0.6);
}

} // namespace starbow
