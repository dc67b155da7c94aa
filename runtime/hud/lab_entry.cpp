#include "lab_entry.h"
#include "hud.h"
#include <algorithm>
#include <charconv>
#include <cmath>

namespace starbow {
namespace {

/// A typed number with a decimal point or comma; nullopt for any other text.
std::optional<double> typed_number(std::string text)
{
    std::replace(text.begin(), text.end(), ',', '.');
    double value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size())
        return {};
    return value;
}

std::string exact(double value, const Words& words)
{
    std::array<char, 40> text;
    std::snprintf(text.data(), text.size(), "%.5g", std::abs(value));
    return (value < 0 ? "−" : "") + words.number(text.data());
}

} // namespace

LabEntry::LabEntry(Measured at)
    : at_(std::move(at))
    , offered_(quantities_at(at_))
{
}

void LabEntry::type(std::string_view keys)
{
    for (const char key : keys)
        if (open())
            type_one(key);
}

void LabEntry::type_one(char key)
{
    constexpr std::size_t longest = 12;
    if (key == escape_character) {
        step_ = Step::given_up;
    } else if (step_ == Step::quantity) {
        if (const std::size_t chosen = std::size_t(key - '1'); key >= '1' && chosen < offered_.size())
            reading_.of = offered_[chosen], step_ = Step::value;
    } else if (key == '\n') {
        enter();
    } else if (key == '\b') {
        if (!typed_.empty())
            typed_.pop_back();
    } else if (std::string_view("0123456789.,-").find(key) != std::string_view::npos && typed_.size() < longest) {
        typed_ += key;
    }
}

void LabEntry::enter()
{
    const std::optional<double> number = typed_number(typed_);
    refused_ = !number || (step_ == Step::uncertainty && !(*number > 0));
    if (refused_) {
        typed_.clear();
        return;
    }
    if (step_ == Step::value) {
        reading_.value = *number, value_text_ = typed_, step_ = Step::uncertainty;
    } else {
        reading_.uncertainty = *number, reading_.theory = *entry_of(reading_.of).theory(at_), step_ = Step::done;
    }
    typed_.clear();
}

std::optional<WrittenReading> LabEntry::written() const
{
    return step_ == Step::done ? std::optional(reading_) : std::nullopt;
}

std::vector<std::string> LabEntry::lines(const Words& words) const
{
    std::vector<std::string> all;
    if (step_ == Step::quantity) {
        all.push_back(words("lab.choose"));
        for (std::size_t i = 0; i < offered_.size(); ++i)
            all.push_back(std::to_string(i + 1) + "   " + words(entry_of(offered_[i]).says));
        return all;
    }
    all.push_back(words(entry_of(reading_.of).says));
    all.push_back(step_ == Step::value ? words("lab.type_value", {{"typed", typed_ + "_"}})
                                       : words("lab.type_uncertainty", {{"value", value_text_}, {"typed", typed_ + "_"}}));
    if (refused_)
        all.push_back(words("lab.type_again"));
    return all;
}

std::string says_of(const WrittenReading& reading, const Words& words)
{
    return words("lab.written",
        {{"value", exact(reading.value, words)}, {"uncertainty", exact(reading.uncertainty, words)},
            {"theory", exact(reading.theory, words)}, {"sigmas", shown_number(reading.sigmas(), 1, words)}});
}

} // namespace starbow
