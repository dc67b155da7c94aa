#include "information.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include <algorithm>

namespace starbow {

Information information_named(std::string_view name)
{
    const auto at = std::ranges::find(informations, name, [](const auto& known) { return known.first; });
    if (at == informations.end())
        throw InputError(
            "the display " + one_line(std::string(name), 40) + " is not known; visitor, guide or laboratory is right");
    return at->second;
}

} // namespace starbow
