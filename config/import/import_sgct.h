#pragma once
#include "config/json/reader.h"
#include "config/model/layout.h"
#include <filesystem>
#include <functional>
#include <optional>

namespace starbow {

/// The result of an import from an SGCT configuration.
struct Import {
    nlohmann::ordered_json layout;
    /// A line for each member: "/POINTER -> its new place" or "/POINTER not mapped: reason".
    std::vector<std::string> lines;
    /// Values that only the builder knows, one line each: "/POINTER in the layout: its present value; the right kind of
    /// value".
    std::vector<std::string> to_mend;
};

/// A mesh file's own view, from which it is warped.
struct MeshView {
    bool frustum = true; ///< false: the file has no frustum
    std::optional<glm::dvec3> eye_m; ///< the eye, where the file has one
    std::optional<Planar> planar; ///< the frustum of a flat picture, with its sides
};
/// Reads a mesh's file, whose name is as in the configuration.
using LookInto = std::function<MeshView(const std::filesystem::path& mesh)>;

/// Reads an SGCT configuration. Throws InputError as read_document does, and for the XML of SGCT's older versions.
Document read_sgct(const std::filesystem::path& file);

/// Makes a layout from an SGCT configuration (its JSON format, version 1): of all its nodes, each a machine of the layout,
/// "node0" and so on; or of the one named by its number. `folder` leads from the layout's folder to the configuration's, for
/// the names of meshes and masks. look_into reads meshes of the kinds that may have a frustum. Throws InputError for a value
/// that SGCT would reject, for a missing node, and for a node without viewports.
Import import_sgct(
    const Document& document, std::optional<int> node, const std::filesystem::path& folder,
    const LookInto& look_into = [](const std::filesystem::path&) { return MeshView{}; });

} // namespace starbow
