#pragma once
#include "layout.h"

namespace starbow {

/// The guide's window beside the visitors' ones.
struct Presenting {
    MonitorName monitor; ///< the window covers it; empty: a window with a frame where the desktop puts it
};

} // namespace starbow
