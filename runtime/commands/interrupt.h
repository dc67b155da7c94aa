#pragma once

namespace starbow {

/// From here on the first Ctrl-C (SIGINT), SIGTERM or SIGHUP only sets interrupted(), so that a command can end its work in
/// order. The second one ends the program. poll() and sleeps return early; reads and writes go on.
void catch_interrupts();

bool interrupted();

} // namespace starbow
