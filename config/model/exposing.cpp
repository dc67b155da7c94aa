#include "exposing.h"
#include "config/json/reader.h"

namespace starbow {

ExposureMode exposure_mode_named(std::string_view name)
{
    return exposure_modes[index_named(name, names_of(exposure_modes), "mode of exposure")].second;
}

} // namespace starbow
