#include "information.h"
#include "config/json/reader.h"

namespace starbow {

Information information_named(std::string_view name)
{
    return informations[index_named(name, names_of(informations), "display")].second;
}

} // namespace starbow
