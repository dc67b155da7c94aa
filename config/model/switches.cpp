#include "switches.h"
#include <algorithm>

namespace starbow {

std::string dashed(std::string_view name)
{
    std::string with(name);
    std::ranges::replace(with, '_', '-');
    return with;
}

} // namespace starbow
