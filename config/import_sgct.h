#pragma once
#include "reader.h"
#include <filesystem>

namespace starbow {

/// What became of an SGCT configuration.
struct Import {
    nlohmann::ordered_json layout;
    /// One for each member: "/POINTER  -> what it became" or "/POINTER  not mapped: reason".
    std::vector<std::string> lines;
};

/// Makes a layout of one node of an SGCT configuration (its JSON format, version 1). `folder` leads from the layout's folder
/// to the configuration's, for the names of meshes and masks. Throws InputError where a value is none that SGCT would read,
/// the node is not there, or nothing is left to show.
Import import_sgct(const Document& document, int node, const std::filesystem::path& folder);

} // namespace starbow
