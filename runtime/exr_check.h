#pragma once
#include <string>
#include <vector>

namespace starbow {

/// What tinyexr takes on trust in an EXR file, checked: the bounds of every attribute, plain float channels, the size, and
/// that every block of rows lies inside the file. Nothing where the file is sound, else what is wrong and would be right.
std::string exr_fault(const std::vector<unsigned char>& bytes);

} // namespace starbow
