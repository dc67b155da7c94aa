#pragma once
#include <string>

namespace starbow {

/// Opens a scene or a glTF file without one, prints its size, its parts, its memory, its times on this machine and
/// everything that is drawn otherwise than the file says, and draws a plan and three stills into one page.
/// page: the page's file; empty: NAME-world.html in the current folder. write: a scene file to write with what is
/// suggested, for a glTF; empty: none. Throws InputError, and then nothing is written.
int check_world(const std::string& scene, const std::string& page, const std::string& write);

} // namespace starbow
