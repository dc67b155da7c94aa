#pragma once
#include <filesystem>

namespace starbow {

/// Draws every shipped shot on a window, and one on the dome and the stereo pair, into `directory`, and all of them small
/// with their names into contact-sheet.png there. Tells its progress on standard output.
int render_contact_sheet(const std::filesystem::path& directory);

} // namespace starbow
