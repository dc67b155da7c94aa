#pragma once
#include <string>
#include <vector>

namespace starbow {

/// Checks the properties that tinyexr takes on trust, so that it only reads files of write_exr's kind: no attributes but
/// the usual eight, of the right sizes; plain float channels, rows from the top, each block of rows inside the file.
/// Returns "" for a sound file, else the fault and what would be right.
std::string exr_fault(const std::vector<unsigned char>& bytes);

} // namespace starbow
