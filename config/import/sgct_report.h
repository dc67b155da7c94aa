#pragma once
#include "config/json/reader.h"
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace starbow {

inline constexpr std::string_view sgct_choice_of_program = "the program chooses it";

/// A place in SGCT's files, metres, and as a layout writes it.
inline glm::dvec3 sgct_xyz(const Place& place)
{
    const Range metres{-1000, 1000};
    return {number(member(place, "x"), metres), number(member(place, "y"), metres), number(member(place, "z"), metres)};
}
inline nlohmann::ordered_json json_of(const glm::dvec3& v) { return nlohmann::ordered_json::array({v.x, v.y, v.z}); }

/// The report of an import from SGCT: a line for each member of the configuration.
class SgctReport {
public:
    using Reasons = std::map<std::string_view, std::string_view>;

    std::vector<std::string> lines;
    std::vector<std::string> left_out; ///< of the lines those about viewports and windows that are left out

    void became(const Place& place, const std::string& what) { lines.push_back(place.pointer + "  -> " + what); }
    void not_mapped(const Place& place, std::string_view reason)
    {
        lines.push_back(place.pointer + "  not mapped: " + std::string(reason));
    }
    /// The same for a viewport's projection or a window of which nothing is made.
    void leave_out(const Place& place, std::string_view reason)
    {
        not_mapped(place, reason);
        left_out.push_back(place.pointer + " " + std::string(reason));
    }

    /// Calls take(name, place) for every member of an object. Members that it does not take get their reason.
    template <class Take> void members(const Place& place, const Reasons& reasons, Take take)
    {
        if (!place.json->is_object())
            fail_at(place, "is not an object; an object in { } is right");
        for (const auto& [name, value] : place.json->items()) {
            const Place at{place.document, &value, place.pointer + "/" + escaped(name)};
            if (take(name, at))
                continue;
            const auto found = reasons.find(name);
            not_mapped(at, found != reasons.end() ? found->second : "SGCT's configurations have no such name here");
        }
    }
};

} // namespace starbow
