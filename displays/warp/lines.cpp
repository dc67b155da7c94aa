#include "parts.h"
#include <charconv>
#include <cmath>

namespace starbow {
namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && blank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && blank(text.back()))
        text.remove_suffix(1);
    return text;
}

} // namespace

void refuse(const WarpFile& file, const std::string& place, const std::string& problem)
{
    throw InputError(file.name, one_line(place), one_line(problem, 600));
}

std::string in_quotes(std::string_view text)
{
    std::string quoted = "\"";
    return quoted.append(one_line(std::string(text.substr(0, 100)), 40)).append("\"");
}

std::optional<double> parsed(std::string_view text)
{
    if (text.size() > 1 && text.front() == '+' && text[1] != '-')
        text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || text.empty())
        return {};
    if (error == std::errc::result_out_of_range) // too large, or so small that it is nothing
        return text.find("e-") != text.npos || text.find("E-") != text.npos ? std::optional(0.0) : std::nullopt;
    if (error != std::errc() || !std::isfinite(value))
        return {};
    return value;
}

Lines::Lines(const WarpFile& file)
    : file_(file)
    , rest_(file.content)
{
    if (rest_.starts_with("\xef\xbb\xbf"))
        rest_.remove_prefix(3);
}

bool Lines::next()
{
    while (!rest_.empty()) {
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        text_ = trimmed(rest_.substr(0, end));
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        ++line_;
        if (!text_.empty())
            return true;
    }
    text_ = {};
    ++line_;
    return false;
}

void Lines::want(const std::string& what)
{
    if (!next())
        starbow::refuse(file_, "line " + std::to_string(line_), "is missing, the file ends early; " + what + " is right");
}

const std::vector<std::string_view>& Lines::fields(char separator)
{
    fields_.clear();
    std::string_view rest = text_;
    while (!rest.empty()) {
        const std::size_t end = std::min(separator == ' ' ? rest.find_first_of(" \t\r") : rest.find(separator), rest.size());
        fields_.push_back(trimmed(rest.substr(0, end)));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (separator == ' ')
            rest = trimmed(rest);
    }
    return fields_;
}

const std::vector<std::string_view>& Lines::fields(std::size_t count, const std::string& right, char separator)
{
    fields(separator);
    if (fields_.size() != count)
        refuse(in_quotes(text_) + " has " + std::to_string(fields_.size()) + " values; " + right + " is right");
    return fields_;
}

double Lines::number(std::string_view field, Range range) const
{
    const std::string right = "a number from " + shown(range.low) + " to " + shown(range.high) + " is right";
    const std::optional<double> value = parsed(field);
    if (!value)
        refuse(in_quotes(field) + " is not a number; " + right);
    if (*value < range.low || *value > range.high)
        refuse(in_quotes(field) + " is too " + (*value < range.low ? "small" : "large") + "; " + right);
    return *value;
}

int Lines::integer(std::string_view field, int low, int high) const
{
    const double value = number(field, {double(low), double(high)});
    if (value != std::floor(value))
        refuse(in_quotes(field) + " is not a whole number; one from " + std::to_string(low) + " to " + std::to_string(high)
            + " is right");
    return int(value);
}

void Lines::refuse(const std::string& problem) const { starbow::refuse(file_, "line " + std::to_string(line_), problem); }

} // namespace starbow
