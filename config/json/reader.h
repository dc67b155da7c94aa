#pragma once
#include "error.h"
#include <algorithm>
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace starbow {

/// A parsed file. Places point into it: it must outlive them and must not move.
struct Document {
    std::string file; ///< as messages show it
    nlohmann::json root;
    std::string text; ///< the source of the parsed values
    int first_line = 1; ///< of the text in its file
};

/// The place of a value in its document's text.
struct Span {
    std::size_t begin, end; ///< its first byte and the one after its last
    int line; ///< of its first byte, counted from 1
    std::optional<std::size_t> first_key; ///< of an object that is not empty: the opening quote of its first member's name
};

/// A value in a document and the JSON pointer that leads to it.
struct Place {
    const Document* document;
    const nlohmann::json* json;
    std::string pointer;
};

/// The range of numbers from low to high; with low_open, without low itself.
struct Range {
    double low, high;
    bool low_open = false;
};

/// Reads JSON with // and /* */ comments. Throws InputError for a file that can't be read, is larger than 16 MiB or is not
/// JSON (with line and column). It throws also for nesting deeper than 64, a repeated member, or a number beyond a double.
Document read_document(const std::filesystem::path& file);
/// The same from a text; `file`: its name in messages; `first_line`: the line of the file where the text begins.
Document parse_document(const std::string& file, std::string text, int first_line = 1);
Place root(const Document& document);

/// The span of the value at a JSON pointer, or nullopt. It parses the text again, because only the few values of messages
/// and changes need a span.
std::optional<Span> find_span(const Document& document, const std::string& pointer);

/// Throws InputError "FILE:LINE: POINTER: VALUE problem". By convention the problem names the fault and, after a
/// semicolon, the right value.
[[noreturn]] void fail_at(const Place& place, const std::string& problem);

/// Each of these returns the value at a place, or throws an InputError about it.
double number(const Place& place, Range range);
int integer(const Place& place, int low, int high);
bool boolean(const Place& place);
std::string text(const Place& place); ///< neither empty nor with control characters
std::string one_of(const Place& place, const std::vector<std::string_view>& choices);
glm::dvec2 vec2(const Place& place, Range range); ///< every component in range
glm::dvec3 vec3(const Place& place, Range range);
glm::dvec4 vec4(const Place& place, Range range);

/// The index of a name among others, which is none of a file's. kind: the named thing. Throws InputError "the KIND NAME is
/// not known; A, B or C is right".
std::size_t index_named(std::string_view name, const std::vector<std::string_view>& names, const std::string& kind);

/// The names of named values.
template <class Value> std::vector<std::string_view> names_of(const std::vector<std::pair<std::string_view, Value>>& choices)
{
    std::vector<std::string_view> names;
    for (const auto& choice : choices)
        names.push_back(choice.first);
    return names;
}

/// The named value of the text at a place.
template <class Value> Value chosen(const Place& place, const std::vector<std::pair<std::string_view, Value>>& choices)
{
    const std::vector<std::string_view> names = names_of(choices);
    const std::string name = one_of(place, names);
    return choices[std::size_t(std::find(names.begin(), names.end(), name) - names.begin())].second;
}

/// The places of an array's elements.
std::vector<Place> elements(const Place& array);
/// The same of an array of `least` to `most` elements; `what` names them in the plural. Throws InputError.
std::vector<Place> items(const Place& place, std::size_t least, std::size_t most, const std::string& what);

/// Throws unless the place is an object whose members are all known.
void reject_unknown_members(const Place& place, const std::vector<std::string_view>& known);
/// The member of an object, or nullopt; reject_unknown_members has checked the object.
std::optional<Place> find_member(const Place& place, const std::string& name);
/// Each of these sets a value to an object's member where the object has it.
void read_optional(const Place& place, const std::string& name, double& value, Range range);
void read_optional(const Place& place, const std::string& name, bool& value);
void read_optional(const Place& place, const std::string& name, glm::dvec2& value, Range range);
void read_optional(const Place& place, const std::string& name, glm::dvec3& value, Range range);
/// The member of an object; throws where it is missing.
Place member(const Place& place, const std::string& name);

/// A member's name as a step of a JSON pointer.
std::string escaped(const std::string& name);

/// The shortest usual text of a number, for messages.
std::string shown(double number);

/// A foreign text as a terminal may show it: '?' for each control character (C0, DEL, C1), line and paragraph separator,
/// character that changes the direction of writing (Unicode TR 9), and byte that is no UTF-8. None of them steers the
/// terminal, or makes a message look like another.
std::string plain_text(const std::string& text);

/// A foreign text for a one-line message: plain_text, cut off at `most` bytes.
std::string one_line(std::string text, std::size_t most = 400);

} // namespace starbow
