#pragma once
#include "exhibit.h"
#include "runtime/machines/bus.h"

namespace starbow {

/// The files on which a node's pictures depend, with their digests: program, layout with its calibrations, scene and words.
ConfigMessage config_of(const ExhibitOptions& options);

/// A sentence about the first file in which a node's config differs from the master's; empty where none does.
std::string difference(const ConfigMessage& node, const ConfigMessage& master);

/// The name by which another machine finds a scene: a shipped one's, else its path.
std::string shared_name_of_scene(const std::filesystem::path& scene);

/// Logs a warning where the machines' network leads elsewhere: it has no login.
void warn_of_routes(const Machines& machines);

} // namespace starbow
