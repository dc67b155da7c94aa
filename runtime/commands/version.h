#pragma once

namespace starbow {

extern const char* const program_version; ///< as in CMakeLists.txt, such as "0.9.0"
extern const char* const build_type;      ///< CMake's, such as "Release"

} // namespace starbow
