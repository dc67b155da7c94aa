#include "read_aloud.h"
#include "config/model/words.h"
#include <algorithm>
#include <cctype>

namespace starbow {
namespace {

/// A number as long as those that captions show.
constexpr const char* number = "0.123";

/// Measured with espeak-ng 1.51 on all shipped tours; beginning_s includes the start of the program.
constexpr double beginning_s = 1.0, letter_s = 0.073, figure_s = 0.3, mark_s = 0.1, verdict_s = 1.5;

} // namespace

std::string sentences(const std::vector<std::string>& texts)
{
    std::string all;
    for (const std::string& text : texts) {
        if (text.empty())
            continue;
        const bool ends = text.ends_with('.') || text.ends_with('!') || text.ends_with('?');
        all += (all.empty() ? "" : " ") + text + (ends ? "" : ".");
    }
    return all;
}

std::string text_to_read(const Step& step, const std::string& caption)
{
    std::vector<std::string> texts{step.title, step.description, caption};
    if (step.question)
        if (const auto* choices = std::get_if<std::vector<Choice>>(&step.question->answer))
            for (const Choice& choice : *choices)
                texts.push_back(choice.text);
    return sentences(texts);
}

std::string text_to_read(const Step& step)
{
    return text_to_read(step, filled(step.question ? step.question->ask : step.caption, {{"measured", number}}));
}

double reading_s(std::string_view text)
{
    double sum = text.empty() ? 0 : beginning_s;
    for (const char c : text)
        if ((c & 0xc0) != 0x80) // a character's first byte
            sum += letter_s + (std::isdigit(static_cast<unsigned char>(c)) ? figure_s : 0)
                + (std::string_view(".,:;?!").find(c) != std::string_view::npos ? mark_s : 0);
    return sum;
}

Tour paced_to_be_read(Tour tour)
{
    for (Step& step : tour.steps) {
        const double read_s = reading_s(text_to_read(step)), longer = std::max(1.0, read_s / step.seconds);
        step.seconds *= longer;
        step.ease_s *= longer;
        if (!std::holds_alternative<Try>(step.motion))
            step.ship_s_per_s /= longer;
        if (Question* question = step.question ? &*step.question : nullptr) {
            question->unattended_s = std::max(question->unattended_s, read_s);
            question->explanation_s = std::max(
                question->explanation_s, verdict_s + reading_s(filled(question->explanation, {{"measured", number}})));
        }
    }
    return tour;
}

} // namespace starbow
