#include "frame_state.h"
#include "config/json/error.h"
#include <algorithm>

namespace starbow {

Pattern pattern_named(const std::string& name)
{
    const auto at = std::ranges::find(pattern_names, name);
    if (at == pattern_names.end())
        throw InputError("the pattern " + name + " is not known; none, grid, rings, names, wedges or overlap is right");
    return Pattern(at - pattern_names.begin());
}

} // namespace starbow
