#include "effects.h"
#include "config/json/reader.h"

namespace starbow {

Comparison comparison_named(std::string_view name)
{
    return Comparison(index_named(name, {comparison_names.begin(), comparison_names.end()}, "comparison"));
}

} // namespace starbow
