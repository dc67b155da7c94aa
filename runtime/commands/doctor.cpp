#include "commands.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/exhibit_file.h"
#include "config/model/layout.h"
#include "config/model/programme_file.h"
#include "config/model/quality.h"
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "displays/compile/compiled_view.h"
#include "input/hid.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/exhibit/desktop.h"
#include "runtime/exhibit/outputs.h"
#include "runtime/hud/highlights.h"
#include "runtime/hud/hud.h"
#include "runtime/machines/interface.h"
#include "runtime/operation/messages.h"
#include "runtime/render/render_context.h"
#include "runtime/world/open_scene.h"
#include "version.h"
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <thread>
#include <unistd.h>

namespace starbow {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

/// The findings of the examination: the same facts as lines for a person and as JSON for a program.
struct Report {
    std::vector<std::string> lines;
    json facts;
    std::vector<std::pair<std::string, std::string>> wrong; ///< a problem and its remedy

    /// label: at the start of the line; empty: the line continues the one above.
    void line(const std::string& label, const std::string& text)
    {
        std::string padded = label;
        padded.resize(std::max<std::size_t>(label.size() + 1, 10), ' ');
        lines.push_back(padded + one_line(text, 1000));
    }
    void problem(const std::string& what, const std::string& mend)
    {
        wrong.emplace_back(one_line(what, 1000), one_line(mend, 1000));
    }
};

std::string environment(const char* name)
{
    const char* value = std::getenv(name);
    return value ? value : "";
}

/// The folder itself, or the nearest existing one above it.
fs::path nearest(fs::path folder)
{
    std::error_code error;
    folder = fs::absolute(folder, error);
    while (!fs::exists(folder, error) && folder.has_relative_path())
        folder = folder.parent_path();
    return folder;
}

/// Sorted entries of a folder whose names begin with `start`.
std::vector<fs::path> entries(const fs::path& folder, const std::string& start)
{
    std::vector<fs::path> all;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        if (at->path().filename().string().starts_with(start))
            all.push_back(at->path());
    std::sort(all.begin(), all.end());
    return all;
}

void examine_system(Report& report)
{
    std::string name = "an unknown system";
    std::ifstream release("/etc/os-release");
    for (std::string line; std::getline(release, line);)
        if (line.starts_with("PRETTY_NAME=")) {
            name = line.substr(12);
            std::erase(name, '"');
        }
    utsname kernel{};
    uname(&kernel);
    const std::string running = std::string(kernel.sysname) + " " + kernel.release + " " + kernel.machine;
    const unsigned cores = std::thread::hardware_concurrency();
    report.facts["system"] = {{"os", name}, {"kernel", running}, {"processor_cores", cores}};
    report.line("system", name + ", " + running + ", " + std::to_string(cores) + " processor cores");
}

/// The maker of a graphics card that the kernel reports, or "".
std::string card_maker()
{
    for (const fs::path& card : entries("/sys/class/drm", "card")) {
        std::string vendor;
        std::ifstream(card / "device" / "vendor") >> vendor;
        if (vendor == "0x10de")
            return "NVIDIA";
        if (vendor == "0x1002")
            return "AMD";
        if (vendor == "0x8086")
            return "Intel";
    }
    return "";
}

void examine_gpus(Report& report, bool windows)
{
    report.facts["gpus"] = json::array();
    const std::vector<GpuListing> gpus = list_gpus(device_options(windows));
    const GpuListing* chosen = nullptr;
    for (const GpuListing& gpu : gpus) {
        if (gpu.chosen)
            chosen = &gpu;
        report.facts["gpus"].push_back(
            {{"name", gpu.name}, {"kind", gpu.kind}, {"software", gpu.software}, {"used", gpu.chosen},
                {"refusal", gpu.refusal}, {"driver_name", gpu.driver_name}, {"driver_version", gpu.driver_version},
                {"vulkan_version", gpu.api_version}, {"max_image_dimension_2d", gpu.largest_image_px},
                {"max_sampler_allocation_count", gpu.most_samplers}, {"max_memory_allocation_count", gpu.most_allocations},
                {"timestamp_period_ns", gpu.timestamp_ns}, {"device_memory_bytes", gpu.memory_bytes},
                {"device_memory_budget_bytes", gpu.budget ? json(gpu.budget->most_bytes) : json()}});
        report.line("GPU", gpu.name + " (" + gpu.kind + ")" + (gpu.chosen ? ": is used" : ""));
        if (!gpu.refusal.empty())
            report.line("", "can't be used: it " + gpu.refusal);
        report.line("", "driver " + gpu.driver_name + " " + gpu.driver_version + ", Vulkan " + gpu.api_version);
        char clock[60] = "no timestamps";
        if (gpu.timestamp_ns > 0)
            std::snprintf(clock, sizeof clock, "timestamps of %g ns", gpu.timestamp_ns);
        report.line("",
            "images up to " + std::to_string(gpu.largest_image_px) + " pixels wide, " + std::to_string(gpu.most_samplers)
                + " samplers, "
                + (gpu.most_allocations == UINT32_MAX ? "any number of" : std::to_string(gpu.most_allocations))
                + " allocations, " + clock + ", " + size_text(double(gpu.memory_bytes)) + " of memory"
                + (gpu.budget ? ", of which this program can have " + size_text(double(gpu.budget->most_bytes)) + " now"
                              : ""));
    }
    const std::string maker = card_maker();
    if (gpus.empty()) {
        report.line("GPU", "Vulkan finds none");
        report.problem("Vulkan finds no GPU", "install mesa-vulkan-drivers (software) or the GPU maker's Vulkan driver");
    } else if (!chosen) {
        report.problem("No GPU can be used: " + gpus[0].name + " " + gpus[0].refusal,
            environment("STARBOW_GPU").empty()
                ? "install the GPU maker's Vulkan 1.3 driver, or mesa-vulkan-drivers (software)"
                : "unset STARBOW_GPU, or set it to a part of a GPU's name above");
    } else if (chosen->software && !maker.empty() && environment("STARBOW_GPU").empty()) {
        report.problem("The " + maker + " graphics card is not used: Vulkan knows no usable driver of it",
            maker == "NVIDIA" ? "install NVIDIA's driver with its Vulkan part (nvidia-driver, libnvidia-gl)"
                              : "install mesa-vulkan-drivers and the card's firmware");
    }
    for (const fs::path& node : entries("/dev/dri", "renderD"))
        if (access(node.c_str(), R_OK | W_OK) != 0)
            report.problem(
                "This user lacks permission for the GPU's node " + node.string() + " (" + std::strerror(errno) + ")",
                "add the user to the group that owns it (render or video) and log in again");
}

void examine_monitors(Report& report, bool windows)
{
    json& facts = report.facts["monitors"] = {{"display_server", windows}, {"list", json::array()}};
    if (!windows) {
        const std::string display = environment("DISPLAY"), wayland = environment("WAYLAND_DISPLAY");
        report.line("monitors",
            "There is no display server here (DISPLAY and WAYLAND_DISPLAY lead nowhere), so no monitor is known.");
        if (!display.empty() || !wayland.empty())
            report.problem("The display server that "
                    + (wayland.empty() ? "DISPLAY=" + display : "WAYLAND_DISPLAY=" + wayland) + " names does not answer",
                "start the desktop session, and run this as the user who is logged in there");
        return;
    }
    const WindowSystem window_system;
    const Desktop desktop;
    std::string label = "monitors";
    for (const Monitor& monitor : desktop.monitors()) {
        facts["list"].push_back({{"connector", monitor.connector}, {"model", monitor.model}, {"serial", monitor.serial},
            {"position", {monitor.position.x, monitor.position.y}}, {"size", {monitor.size.x, monitor.size.y}},
            {"size_mm", {monitor.size_mm.x, monitor.size_mm.y}}, {"refresh_hz", monitor.refresh_hz},
            {"primary", monitor.primary}});
        char size[100];
        std::snprintf(size, sizeof size, ": %d x %d at [%d, %d], %.2f Hz", monitor.size.x, monitor.size.y,
            monitor.position.x, monitor.position.y, monitor.refresh_hz);
        report.line(std::exchange(label, ""),
            monitor.connector + size + (monitor.model.empty() ? "" : ", " + monitor.model)
                + (monitor.serial.empty() ? "" : ", serial " + monitor.serial) + (monitor.primary ? ", primary" : ""));
    }
    if (desktop.monitors().empty()) {
        report.line("monitors", "none");
        report.problem("The display server shows no monitor", "plug one in and switch it on");
    }
}

void examine_sticks(Report& report)
{
    std::error_code error;
    fs::path rule;
    for (const char* folder : {"/etc/udev/rules.d", "/run/udev/rules.d", "/usr/lib/udev/rules.d", "/lib/udev/rules.d"})
        if (rule.empty() && fs::exists(fs::path(folder) / "70-starbow.rules", error))
            rule = fs::path(folder) / "70-starbow.rules";
    const std::vector<fs::path> nodes = entries("/dev", "hidraw");
    json locked = json::array();
    for (const fs::path& node : nodes)
        if (access(node.c_str(), R_OK | W_OK) != 0)
            locked.push_back(node.string());
    std::vector<Profile> profiles;
    try {
        profiles = known_profiles();
    } catch (const InputError&) { // the examination of the files reports it
    }
    json list = json::array();
    std::string label = "sticks";
    for (const ControllerListing& stick : list_controllers(profiles)) {
        list.push_back({{"name", stick.info.name}, {"vendor", stick.info.vendor}, {"product", stick.info.product},
            {"path", stick.info.path}, {"profile", stick.profile}, {"may_be_read", stick.error == 0}});
        const std::string stick_name = describe(stick.info) + ", " + stick.info.path;
        report.line(std::exchange(label, ""),
            stick_name + (stick.error ? std::string(": ") + std::strerror(stick.error) : ", profile: " + stick.profile));
        if (stick.error == EACCES || stick.error == EPERM)
            report.problem(stick_name + " can't be read by this user",
                rule.empty() ? "copy config/udev/70-starbow.rules to /etc/udev/rules.d and plug it in again"
                             : "plug it in again, and run this as the user who sits at the machine");
        else if (stick.error)
            report.problem(stick_name + " can't be opened (" + std::strerror(stick.error) + ")",
                "plug it in again, into another socket");
    }
    if (list.empty())
        report.line("sticks", "none is plugged in");
    report.line("",
        std::to_string(nodes.size()) + " hidraw nodes, " + std::to_string(locked.size())
            + " of them not readable by this user; the udev rule "
            + (rule.empty() ? "is not installed" : "is " + rule.string()));
    report.facts["sticks"]
        = {{"list", list}, {"hidraw_nodes", nodes.size()}, {"hidraw_nodes_locked", locked}, {"udev_rule", rule.string()}};
}

void examine_font(Report& report)
{
    bool found = true;
    try {
        const Typesetter font;
    } catch (const InputError& error) {
        found = false;
        report.problem(
            "The font of the head-up display is missing or no font: " + std::string(hud_font), "install fonts-dejavu-core");
    }
    report.facts["font"] = {{"file", hud_font}, {"found", found}};
    report.line("font", std::string(hud_font) + (found ? "" : " is missing or no font"));
}

void examine_disk(Report& report)
{
    const fs::path folder = map_cache_folder();
    std::error_code error;
    std::uintmax_t bytes = 0, files = 0;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        if (at->is_regular_file(error))
            bytes += at->file_size(error), ++files;
    const fs::path place = folder.empty() ? fs::current_path(error) : nearest(folder);
    // The folder is made at need, so the nearest folder above it must be writable.
    const bool writable = !folder.empty() && fs::is_directory(place, error) && access(place.c_str(), W_OK | X_OK) == 0;
    report.facts["cache"] = {{"folder", folder.string()}, {"bytes", bytes}, {"files", files}, {"can_be_written", writable}};
    if (folder.empty())
        report.line("cache", "no folder: neither STARBOW_CACHE, XDG_CACHE_HOME nor HOME is set");
    else
        report.line("cache",
            folder.string() + ": " + size_text(double(bytes)) + " in " + std::to_string(files) + " files; can"
                + (writable ? "" : "'t") + " be written");
    if (!writable)
        report.problem(folder.empty() ? "There is no folder for the cache, so every start computes the layout's maps again"
                                      : "The cache folder " + folder.string()
                    + " can't be written, so every start computes the layout's maps again",
            "set STARBOW_CACHE to a folder that can be written");
    json& facts = report.facts["disk"] = json::array();
    std::string label = "disk";
    const fs::path here = fs::current_path(error);
    std::vector<dev_t> devices; // folders on one disk share its free space
    for (const fs::path& where : {place, here}) {
        struct stat found { };
        if (stat(where.c_str(), &found) != 0 || std::find(devices.begin(), devices.end(), found.st_dev) != devices.end())
            continue;
        devices.push_back(found.st_dev);
        const fs::space_info space = fs::space(where, error);
        if (error)
            continue;
        facts.push_back({{"folder", where.string()}, {"free_bytes", space.available}});
        report.line(std::exchange(label, ""), size_text(double(space.available)) + " free in " + where.string());
        if (space.available < std::uintmax_t(1) << 30)
            report.problem("Less than 1 GiB of disk is free in " + where.string(),
                "delete what is not needed there; the cache alone may take 4 GiB");
    }
}

/// Reads every shipped file of one kind and returns their number. load: throws InputError for a wrong file.
template <class Load>
std::size_t examine_kind(Report& report, const fs::path& config, const fs::path& site, const char* kind, Load load)
{
    std::size_t count = 0;
    std::vector<fs::path> files = entries(config / kind, "");
    const std::size_t shipped = files.size();
    if (!site.empty())
        for (const fs::path& file : entries(site / kind, ""))
            files.push_back(file);
    for (std::size_t i = 0; i < files.size(); ++i)
        if (const fs::path& file = files[i]; file.extension() == ".json") {
            count += i < shipped;
            try {
                load(file);
            } catch (const InputError& error) {
                report.problem(error.what(), "restore the file, or mend it as the message says");
            }
        }
    if (count == 0)
        report.problem("No file is in " + (config / kind).string(), "restore the folder from Starbow's own files");
    report.facts["files"][kind] = count;
    return count;
}

void examine_files(Report& report)
{
    fs::path folder;
    try {
        folder = home();
    } catch (const InputError& error) {
        report.facts["files"] = {{"home", nullptr}};
        report.line("files", "not found");
        report.problem(
            "Starbow's own files are not found: config/layouts is neither above the program nor above this folder",
            "install the package starbow, or run starbow from its own checkout");
        return;
    }
    const fs::path config = folder / "config", of_site = site();
    report.facts["files"] = {{"home", folder.string()}};
    std::string counts;
    const auto kind = [&](const char* name, auto load) {
        counts
            += (counts.empty() ? "" : ", ") + std::to_string(examine_kind(report, config, of_site, name, load)) + " " + name;
    };
    kind("exhibits", [](const fs::path& file) { load_exhibit(file); });
    kind("layouts", [](const fs::path& file) { load_layout(file); });
    kind("scenes", [](const fs::path& file) {
        const SceneFile scene = open_scene(file);
        if (!fs::exists(scene.gltf))
            throw InputError(file.string(), "/gltf", scene.gltf.string() + " is not there; a glTF file is right");
    });
    kind("shots", [](const fs::path& file) { load_shot(file); });
    kind("tours", [words = std::optional<Words>()](const fs::path& file) mutable {
        if (!words)
            words = words_in("en");
        const Tour tour = tour_in(file.string(), *words);
        check_highlights(tour, open_scene(scene_of(tour)));
    });
    kind("programmes", [](const fs::path& file) { load_programme(file); });
    kind("words", [](const fs::path& file) { load_words(file); });
    kind("qualities", [](const fs::path& file) {
        if (file.stem() == "ladder")
            load_ladder(file);
        else
            load_quality(file);
    });
    kind("profiles", [](const fs::path& file) { load_profile(file); });
    report.line("files", folder.string() + ": " + counts);
    if (!of_site.empty()) {
        report.facts["files"]["site"] = of_site.string();
        report.line("", "the site's own files, read before these, are in " + of_site.string());
        if (const fs::path file = of_site / "exhibit.json"; fs::exists(file))
            try {
                load_exhibit(file);
            } catch (const InputError& error) {
                report.problem(error.what(), "mend the file, then run systemctl restart starbow");
            }
    }
    std::size_t own = 0;
    for (const fs::path& file : entries(own_profiles(), ""))
        if (file.extension() == ".json") {
            ++own;
            try {
                load_profile(file);
            } catch (const InputError& error) {
                report.problem(error.what(), "mend the profile, or delete it and run starbow calibrate");
            }
        }
    report.facts["files"]["own_profiles"] = own;
    report.line("", std::to_string(own) + " profiles of your own in " + own_profiles().string());
}

/// The places on the network that the site's exhibit needs. It shows its pictures without them, so nobody else may notice.
/// Ports are not tried: the exhibit itself may have them.
void examine_network(Report& report)
{
    const fs::path folder = site(), file = folder / "exhibit.json";
    if (folder.empty() || !fs::exists(file))
        return;
    json& facts = report.facts["files"]["network"] = json::array();
    Exhibit exhibit;
    std::optional<HeadTracking> tracker;
    try {
        exhibit = load_exhibit(file);
        tracker = load_layout(shipped_file("layouts", exhibit.layout)).head_tracker;
    } catch (const InputError&) { // the examination of the files reports it
        return;
    }
    const auto add = [&](const std::string& what, const std::string& place, bool here, const std::string& mend) {
        facts.push_back({{"what", what}, {"place", place}, {"here", here}});
        report.line(facts.size() == 1 ? "network" : "", what + ": " + place + (here ? "" : ", which this machine lacks"));
        if (!here)
            report.problem("The exhibit's " + what + " waits for " + place + ", which this machine lacks", mend);
    };
    const std::string mend = "look at the network's cable and at ip addr, or change the address in the file";
    if (exhibit.remote.port != 0)
        add("remote", exhibit.remote.address, is_here(exhibit.remote.address), mend);
    if (tracker)
        add("head tracker", tracker->address, is_here(tracker->address), mend);
    if (exhibit.machines) {
        bool here = true;
        try {
            interface_of(exhibit.machines->interface);
        } catch (const InputError&) {
            here = false;
        }
        add("machines", "interface " + exhibit.machines->interface, here, mend);
    }
}

int doctor(bool as_json)
{
    Report report;
    report.facts["version"] = program_version;
    report.facts["build"] = build_type;
    report.lines.push_back(std::string("Starbow ") + program_version + ", build type " + build_type);
    // A failing part must not hide the others.
    const auto examine = [&](const char* part, auto&& look) {
        try {
            look();
        } catch (const std::exception& error) {
            report.line(part, "can't be examined");
            report.problem(std::string("The examination of the ") + part + " failed: " + error.what(),
                "reinstall the Debian packages in packages.txt");
        }
    };
    bool windows = false;
    examine("system", [&] { examine_system(report); });
    examine("display server", [&] { windows = has_display(); });
    examine("GPUs", [&] { examine_gpus(report, windows); });
    examine("monitors", [&] { examine_monitors(report, windows); });
    examine("sticks", [&] { examine_sticks(report); });
    examine("font", [&] { examine_font(report); });
    examine("disk", [&] { examine_disk(report); });
    examine("files", [&] { examine_files(report); });
    examine("network", [&] { examine_network(report); });

    json& wrong = report.facts["wrong"] = json::array();
    for (const auto& [what, mend] : report.wrong)
        wrong.push_back({{"problem", what}, {"mend", mend}});
    if (as_json) {
        std::printf("%s\n", report.facts.dump(2, ' ', false, json::error_handler_t::replace).c_str());
    } else {
        for (const std::string& line : report.lines)
            std::printf("%s\n", line.c_str());
        std::printf(report.wrong.empty() ? "\nNothing is wrong.\n" : "\nWrong:\n");
        for (const auto& [what, mend] : report.wrong)
            std::printf("- %s: %s.\n", what.c_str(), mend.c_str());
    }
    return report.wrong.empty() ? 0 : 1;
}

} // namespace

static void add_doctor(Subcommand& app, std::function<int()>& chosen)
{
    auto as_json = std::make_shared<bool>(false);
    Subcommand* command = app.add_subcommand("doctor",
        "Examine this machine: GPU, monitors, sticks, font, disk, files, network; and say what is wrong. Exit 0: nothing, "
        "1: "
        "something.");
    command->add_flag("--json", *as_json, "Print the same as JSON");
    command->footer("Examples:\n  starbow doctor\n  starbow doctor --json > out/doctor.json");
    command->callback([as_json, &chosen] { chosen = [as_json] { return doctor(*as_json); }; });
}

static const Registered doctor_command{4, add_doctor};

} // namespace starbow
