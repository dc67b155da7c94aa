#pragma once
#include <cstdio>
#include <string>

namespace starbow {

/// A number with so many significant digits, for people.
inline std::string digits(double number, int count = 3)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", count, number);
    return text;
}

} // namespace starbow
