#include "machine_files.h"
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "runtime/machines/interface.h"
#include "runtime/operation/log.h"
#include "runtime/operation/record_files.h"
#include "runtime/world/open_scene.h"

namespace starbow {
namespace fs = std::filesystem;

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
    const fs::path& scene = options.programme.scene;
    add(scene.filename().string(), {scene});
    if (const fs::path gltf = open_scene(scene).gltf; !gltf.empty())
        add(gltf.filename().string(), {gltf});
    add(options.words.file.filename().string(), {options.words.file});
    return config;
}

std::string difference(const ConfigMessage& node, const ConfigMessage& master)
{
    for (std::size_t i = 0; i < std::max(node.files.size(), master.files.size()); ++i) {
        if (i >= node.files.size() || i >= master.files.size() || node.files[i].first != master.files[i].first) {
            const std::string here = i < node.files.size() ? node.files[i].first : "none",
                              there = i < master.files.size() ? master.files[i].first : "none";
            return "node '" + one_line(node.node) + "' has the file " + one_line(here) + " where the master '"
                + one_line(master.node) + "' has " + one_line(there) + "; the same exhibit on both is right";
        }
        if (node.files[i].second != master.files[i].second)
            return "node '" + one_line(node.node) + "' has another " + one_line(node.files[i].first) + " ("
                + one_line(node.files[i].second) + ") than the master '" + one_line(master.node) + "' ("
                + one_line(master.files[i].second) + "); the same file on both is right";
    }
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
