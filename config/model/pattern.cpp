#include "pattern.h"
#include "config/json/reader.h"

namespace starbow {

Pattern pattern_named(const std::string& name)
{
    return Pattern(index_named(name, {pattern_names.begin(), pattern_names.end()}, "pattern"));
}

} // namespace starbow
