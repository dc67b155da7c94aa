#pragma once
#include <string>
#include <vector>

namespace starbow {

/// Checks what tinyexr takes on trust, so that it is only given files of the kind that write_exr makes: no attributes but
/// the usual eight, of the right sizes, plain float channels, rows from the top, each block of rows inside the file. ""
/// where the file is sound, else what is wrong with it and what would be right.
std::string exr_fault(const std::vector<unsigned char>& bytes);

} // namespace starbow
