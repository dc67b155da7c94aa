#pragma once
#include <filesystem>

namespace starbow {

/// Draws every shipped shot in a window, and one on the dome and on the stereo pair, into `directory`. Draws all of them
/// small with their names into contact-sheet.png there. Prints its progress on standard output.
int render_contact_sheet(const std::filesystem::path& directory);

} // namespace starbow
