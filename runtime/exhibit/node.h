#pragma once
#include "exhibit.h"

namespace starbow {

/// Shows one node's outputs of an exhibit of several machines, as its master says, until it is interrupted or a window is
/// closed. Without a master the outputs are black. Returns the exit status. Throws InputError where a file differs from the
/// master's, or for errors before the first picture.
int show_node(const ExhibitOptions& options);

} // namespace starbow
