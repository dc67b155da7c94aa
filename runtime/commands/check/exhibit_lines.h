#pragma once
#include <string>

namespace starbow {

/// Reads an exhibit and all that it names, and prints what it shows, its machines with their outputs, and the network
/// between them. Returns its layout's file. Throws InputError where a file is wrong.
std::string print_exhibit(const std::string& file);

} // namespace starbow
