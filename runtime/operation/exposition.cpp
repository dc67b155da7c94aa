#include "exposition.h"
#include <array>
#include <cstdio>

namespace starbow {

std::string escaped_label(const std::string& value)
{
    std::string out;
    for (char c : value)
        out += c == '\\' ? "\\\\" : c == '"' ? "\\\"" : c == '\n' ? "\\n" : std::string(1, c);
    return out;
}

void Exposition::metric(const char* name, const char* kind, const char* help)
{
    text += std::string("# HELP starbow_") + name + " " + help + "\n# TYPE starbow_" + name + " " + kind + "\n";
}

void Exposition::value(const std::string& name, double value)
{
    std::array<char, 40> digits;
    std::snprintf(digits.data(), digits.size(), " %.15g\n", value);
    text += "starbow_" + name + digits.data();
}

void Exposition::one(const char* name, const char* kind, const char* help, double number)
{
    metric(name, kind, help);
    value(name, number);
}

} // namespace starbow
