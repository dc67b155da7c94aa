#pragma once
#include "config/json/error.h"
#include "runtime/render/frame_renderer.h"
#include <string>

namespace starbow {

constexpr const char* pattern_help = "A test pattern instead of the flight: grid, rings (azimuth and elevation), names (of "
                                     "outputs and eyes), wedges (gamma "
                                     "and black level) or overlap";

/// Throws InputError for an unknown name.
inline Pattern pattern_of(const std::string& name)
{
    std::string known;
    for (std::size_t i = 0; i < pattern_names.size(); ++i) {
        if (name == pattern_names[i])
            return Pattern(i);
        known.append(i > 0 ? ", " : "").append(pattern_names[i]);
    }
    throw InputError("--pattern " + name + " is no test pattern; there are: " + known);
}

} // namespace starbow
