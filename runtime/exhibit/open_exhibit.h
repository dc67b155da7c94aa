#pragma once
#include "config/model/exhibit_file.h"
#include "exhibit.h"

namespace starbow {

/// Reads all files that an exhibit names. Throws InputError where one is wrong.
ExhibitOptions open_exhibit(const Exhibit& exhibit);

/// Throws InputError where the outputs of a layout have no machines, where none is the master, and where none is `node`, as
/// --node names it (empty: it names none), and where the interface is none and no network.
void check_machines(const Machines& machines, const Layout& layout, const std::string& node = "");

/// The identity by which an exhibit's machines know each other: the file's, or the layout's name with its nodes.
std::string identity_of(const Machines& machines, const Layout& layout);

} // namespace starbow
