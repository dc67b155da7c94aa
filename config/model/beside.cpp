#include "beside.h"
#include "config/json/reader.h"

namespace starbow {

Beside beside_named(std::string_view name)
{
    return Beside(index_named(name, {beside_names.begin(), beside_names.end()}, "small picture"));
}

} // namespace starbow
