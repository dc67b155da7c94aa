#pragma once
#include "config/json/patch.h"
#include "exhibit.h"
#include "runtime/machines/bus.h"
#include "runtime/machines/interface.h"

namespace starbow {

/// The files on which a node's pictures depend, with their digests: program, scene and words, and those of the layout.
ConfigMessage config_of(const ExhibitOptions& options, FileDigests of_layout);

/// A layout's file and its calibrations.
FileDigests digests_of(const Layout& layout);

/// One number for them all.
std::uint64_t digest_of(const FileDigests& digests);

/// A sentence about the first file in which a node's config differs from the master's; empty where none does. The first is
/// about all files but the layout's, which may change while the exhibit runs, and the second about those.
std::string difference(const ConfigMessage& node, const ConfigMessage& master);
std::string layout_difference(const ConfigMessage& node, const ConfigMessage& master);

/// The changes of a layout's numbers with which a node's file becomes the master's, if they do: the builder has kept them
/// there. kept: the layout of the node's file; shown: the one that it shows.
std::vector<Change> changes_to_keep(
    const ConfigMessage& node, const ConfigMessage& master, const Layout& kept, const Layout& shown);

/// The name by which another machine finds a file: a shipped one's, else its path. kind: "scenes", "layouts".
std::string shared_name(const std::string& kind, const std::filesystem::path& file);

/// A warning where the machines' network leads elsewhere, as it has no login; empty where it does not.
std::string warning_of_routes(const NetworkInterface& interface);
/// Logs that warning, if this machine is on the machines' network.
void log_routes(const Machines& machines);
/// The machines' messages of this program.
BusPlace place_of(const Machines& machines);

} // namespace starbow
