#pragma once
#include "config/json/error.h"
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace starbow {

using Json = nlohmann::json;

/// A text from a file in quotes, shortened to printable ASCII for one line of a message.
std::string in_quotes(const std::string& text);

/// A value of a glTF file's JSON with its place, which messages name.
struct JsonSpot {
    const Json& json;
    std::string at; ///< JSON pointer
    const std::string& file;

    [[noreturn]] void fail(const std::string& problem) const { throw InputError(file, at.empty() ? "/" : at, problem); }
    bool has(const char* key) const { return json.contains(key); }
    JsonSpot operator[](const std::string& key) const;
    JsonSpot operator[](std::size_t i) const { return {json[i], at + "/" + std::to_string(i), file}; }
    std::size_t size() const { return json.size(); }
};

/// Each of these returns the value, or throws InputError with a message that names a right value.
const JsonSpot& object(const JsonSpot& spot);
const JsonSpot& list(const JsonSpot& spot, std::size_t at_least = 1);
std::int64_t integer(const JsonSpot& spot, std::int64_t low, std::int64_t high);
double number(const JsonSpot& spot, double low, double high);
std::vector<double> numbers(const JsonSpot& spot, std::size_t count, double low, double high);
std::string text(const JsonSpot& spot);
bool boolean(const JsonSpot& spot);

/// Throws InputError if an object has members other than these.
void reject_unknown_members(const JsonSpot& spot, std::initializer_list<const char*> known);

/// An index into one of the file's lists, which has `size` elements.
std::int64_t index_into(const JsonSpot& spot, const char* what, std::size_t size);

/// The value of an optional member.
inline std::int64_t integer_or(const JsonSpot& spot, const char* key, std::int64_t absent, std::int64_t low, std::int64_t high)
{
    return spot.has(key) ? integer(spot[key], low, high) : absent;
}

} // namespace starbow
