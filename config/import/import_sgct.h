#pragma once
#include "config/json/reader.h"
#include <filesystem>
#include <functional>

namespace starbow {

/// What became of an SGCT configuration.
struct Import {
    nlohmann::ordered_json layout;
    /// One for each member: "/POINTER  -> what it became" or "/POINTER  not mapped: reason".
    std::vector<std::string> lines;
    /// What only the builder can tell, a line each: "/POINTER in the layout: what stands there; what would be right".
    std::vector<std::string> to_mend;
};

/// What a mesh's file says of the view that it bends.
struct MeshView {
    bool frustum = true; ///< whether it brings one
    std::optional<glm::dvec3> eye_m; ///< from where, where it says
};
/// Looks into a mesh's file, whose name is as the configuration has it.
using LookInto = std::function<MeshView(const std::filesystem::path& mesh)>;

/// Makes a layout of one node of an SGCT configuration (its JSON format, version 1). `folder` leads from the layout's folder
/// to the configuration's, for the names of meshes and masks; look_into is asked of meshes of the kinds that may bring a
/// frustum. Throws InputError where a value is none that SGCT would read, the node is not there, or nothing is left to show.
Import import_sgct(
    const Document& document, int node, const std::filesystem::path& folder,
    const LookInto& look_into = [](const std::filesystem::path&) { return MeshView{}; });

} // namespace starbow
