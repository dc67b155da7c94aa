#include "machine_files.h"
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "runtime/machines/interface.h"
#include "runtime/operation/log.h"
#include "runtime/operation/record_files.h"
#include "runtime/world/open_scene.h"
#include <algorithm>

namespace starbow {
namespace fs = std::filesystem;

/// Before the names of a scene's files. A master after many disorderly ends shows another one than the exhibit's.
static constexpr std::string_view scenes = "the scene's ";

ConfigMessage config_of(const ExhibitOptions& options)
{
    ConfigMessage config{options.node, {}};
    const auto add = [&](const std::string& name, const std::vector<fs::path>& files) {
        config.files.emplace_back(name, shown_digest(digest_of(files)));
    };
    std::error_code error;
    add("the program", {fs::read_symlink("/proc/self/exe", error)});
    for (const fs::path& file : files_of(options.layout)) // the layout first, then its calibrations
        add(file.filename().string(), {file});
    add(options.words.file.filename().string(), {options.words.file});
    const fs::path& scene = options.programme.scene;
    const fs::path gltf = open_scene(scene).gltf;
    for (const fs::path& file : {scene, gltf})
        if (!file.empty())
            add(std::string(scenes) + file.filename().string(), {file});
    return config;
}

std::string difference(const ConfigMessage& node, const ConfigMessage& master)
{
    const auto find = [](const ConfigMessage& in, const std::string& name) {
        return std::ranges::find(in.files, name, [](const auto& file) { return file.first; });
    };
    const std::string of_node = "node '" + one_line(node.node) + "'",
                      of_master = "the master '" + one_line(master.node) + "'";
    for (const auto& [name, digest] : node.files) {
        const auto same = find(master, name);
        if (same != master.files.end() && same->second != digest)
            return of_node + " has another " + one_line(name) + " (" + one_line(digest) + ") than " + of_master + " ("
                + one_line(same->second) + "); the same file on both is right";
        if (same == master.files.end() && !name.starts_with(scenes))
            return of_node + " has the file " + one_line(name) + ", and " + of_master
                + " has not; the same exhibit on both is right";
    }
    for (const auto& [name, digest] : master.files)
        if (find(node, name) == node.files.end() && !name.starts_with(scenes))
            return of_node + " has not the file " + one_line(name) + " of " + of_master
                + "; the same exhibit on both is right";
    return "";
}

std::string shared_name_of_scene(const fs::path& scene)
{
    const std::string name = scene.stem().string();
    try {
        if (shipped_file("scenes", name) == scene)
            return name;
    } catch (const InputError&) { // no shipped one
    }
    return scene.string();
}

void warn_of_routes(const Machines& machines)
{
    const NetworkInterface interface = interface_of(machines.interface);
    if (leads_elsewhere(interface))
        write_log(LogKind::network_routed,
            "the network of interface " + interface.name + " (" + interface.address
                + ") leads elsewhere, too; a switch of their own for the exhibit's machines, which know no login, is right");
}

} // namespace starbow
