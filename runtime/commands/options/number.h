#pragma once
#include <CLI/CLI.hpp>
#include <charconv>
#include <string>

namespace starbow {

/// Accepts only whole numbers from low to high.
inline CLI::Validator whole_number(long low, long high)
{
    const std::string from = std::to_string(low), to = std::to_string(high);
    const auto problem = [=](const std::string& text) -> std::string {
        long value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool whole = error == std::errc() && end == text.data() + text.size();
        if (whole && value >= low && value <= high)
            return "";
        return text + " is no whole number" + (whole ? " that fits" : "") + "; one from " + from + " to " + to + " is right";
    };
    return CLI::Validator(problem, "from " + from + " to " + to);
}

} // namespace starbow
