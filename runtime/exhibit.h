#pragma once
#include "config/layout.h"
#include "theatre.h"

namespace starbow {

/// Flies until the visitor leaves or `frames` frames have been shown (0: no end). start: where the visit begins and where
/// reset leads back to. Returns the exit status.
int fly_exhibit(Theatre& theatre, const Layout& layout, const Shot& start, const Quality& quality, long frames);

} // namespace starbow
