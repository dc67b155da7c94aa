#pragma once
#include <filesystem>

namespace starbow {

/// The folder of what the program keeps about itself: STATE_DIRECTORY, which a service manager sets (systemd.exec(5)), else
/// starbow in XDG_STATE_HOME or ~/.local/state. Empty where none of these is set. It may not exist yet.
std::filesystem::path state_folder();

} // namespace starbow
