#pragma once

namespace starbow {

constexpr const char* pattern_help = "A test pattern instead of the flight: grid, rings (azimuth and elevation), names (of "
                                     "outputs and eyes), wedges (gamma "
                                     "and black level) or overlap";

} // namespace starbow
