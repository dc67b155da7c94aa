#include "machine_files.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/adjust.h"
#include "config/model/shipped.h"
#include "runtime/operation/log.h"
#include "runtime/operation/record_files.h"
#include "runtime/world/open_scene.h"
#include <algorithm>

namespace starbow {
namespace fs = std::filesystem;

/// Before the names of a scene's files. A master after many disorderly ends shows another one than the exhibit's.
static constexpr std::string_view scenes = "the scene's ";

FileDigests digests_of(const Layout& layout)
{
    FileDigests digests;
    for (const fs::path& file : files_of(layout)) // the layout first, then its calibrations
        digests.emplace_back(file.filename().string(), shown_digest(digest_of({file})));
    return digests;
}

std::uint64_t digest_of(const FileDigests& digests)
{
    std::uint64_t sum = digest(std::string_view());
    for (const auto& [name, text] : digests)
        sum = digest(name + "\n" + text + "\n", sum);
    return sum;
}

ConfigMessage config_of(const ExhibitOptions& options, FileDigests of_layout)
{
    ConfigMessage config{options.node, {}, std::move(of_layout)};
    const auto add = [&](const std::string& name, const std::vector<fs::path>& files) {
        config.files.emplace_back(name, shown_digest(digest_of(files)));
    };
    std::error_code error;
    add("the program", {fs::read_symlink("/proc/self/exe", error)});
    add(options.words.file.filename().string(), {options.words.file});
    const fs::path& scene = options.content.scene;
    const fs::path gltf = open_scene(scene).gltf;
    for (const fs::path& file : {scene, gltf})
        if (!file.empty())
            add(std::string(scenes) + file.filename().string(), {file});
    return config;
}

/// The same for one of the lists of two configs.
static std::string difference(const ConfigMessage& node, const ConfigMessage& master, FileDigests ConfigMessage::*list)
{
    const auto find = [](const FileDigests& in, const std::string& name) {
        return std::ranges::find(in, name, [](const auto& file) { return file.first; });
    };
    const FileDigests &nodes = node.*list, &masters = master.*list;
    const std::string of_node = "node '" + one_line(node.node) + "'",
                      of_master = "the master '" + one_line(master.node) + "'";
    for (const auto& [name, digest] : nodes) {
        const auto same = find(masters, name);
        if (same != masters.end() && same->second != digest)
            return of_node + " has a different " + one_line(name) + " (" + one_line(digest) + ") from " + of_master + " ("
                + one_line(same->second) + "); the same file on both is right";
        if (same == masters.end() && !name.starts_with(scenes))
            return of_node + " has the file " + one_line(name) + ", which " + of_master
                + " lacks; the same exhibit on both is right";
    }
    for (const auto& [name, digest] : masters)
        if (find(nodes, name) == nodes.end() && !name.starts_with(scenes))
            return of_node + " lacks the file " + one_line(name) + " of " + of_master
                + "; the same exhibit on both is right";
    return "";
}

std::string difference(const ConfigMessage& node, const ConfigMessage& master)
{
    return difference(node, master, &ConfigMessage::files);
}

std::string layout_difference(const ConfigMessage& node, const ConfigMessage& master)
{
    return difference(node, master, &ConfigMessage::layout);
}

std::vector<Change> changes_to_keep(
    const ConfigMessage& node, const ConfigMessage& master, const Layout& kept, const Layout& shown)
{
    std::vector<Change> turned = changes(kept, shown);
    if (turned.empty() || node.layout.empty())
        return {};
    std::string text = read_document(kept.file).text;
    for (const Change& change : turned)
        text = patched(kept.file.string(), text, change);
    FileDigests then = node.layout;
    then.front().second = shown_digest(digest(text, digest(std::string_view())));
    return then == master.layout ? turned : std::vector<Change>();
}

std::string shared_name(const std::string& kind, const fs::path& file)
{
    const std::string name = file.stem().string();
    try {
        if (shipped_file(kind, name) == file)
            return name;
    } catch (const InputError&) { // no shipped one
    }
    return file.string();
}

std::string warning_of_routes(const NetworkInterface& interface)
{
    if (!leads_elsewhere(interface))
        return "";
    return "the network of interface " + interface.name + " (" + interface.address
        + ") leads elsewhere, too; a switch of their own for the exhibit's machines, which have no login, is right";
}

void log_routes(const Machines& machines)
{
    try {
        if (const std::string warning = warning_of_routes(interface_of(machines.interface)); !warning.empty())
            write_log(LogKind::network_routed, warning);
    } catch (const NoInterface&) { // it has gone meanwhile
    }
}

BusPlace place_of(const Machines& machines) { return {machines.interface, machines.domain, machines.exhibit}; }

} // namespace starbow
