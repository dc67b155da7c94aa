#include "shipped.h"
#include "config/json/error.h"
#include "config/json/file_name.h"
#include "config/json/folder.h"
#include "config/json/reader.h"
#include "file_kind.h"
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace starbow {
namespace fs = std::filesystem;
namespace {

bool is_path(const std::string& name)
{
    return name.find('/') != std::string::npos || name.ends_with(".json") || name.ends_with(".glb")
        || name.ends_with(".gltf");
}

/// The file kind of a folder of config/; nullopt for folders whose files kind_of_file does not recognise.
std::optional<FileKind> kind_in(const std::string& folder)
{
    static const std::map<std::string, FileKind> kinds{{"scenes", FileKind::scene}, {"layouts", FileKind::layout},
        {"tours", FileKind::tour}, {"shots", FileKind::shot}, {"exhibits", FileKind::exhibit},
        {"qualities", FileKind::quality}, {"words", FileKind::words}, {"programmes", FileKind::programme}};
    const auto kind = kinds.find(folder);
    return kind == kinds.end() ? std::nullopt : std::optional(kind->second);
}

} // namespace

fs::path home()
{
    std::error_code error;
    for (fs::path start : {fs::read_symlink("/proc/self/exe", error).parent_path(), fs::current_path(error)})
        for (fs::path folder = start; !folder.empty(); folder = folder.parent_path()) {
            for (const fs::path& place : {folder, folder / "share" / "starbow"})
                if (fs::is_directory(place / "config" / "layouts", error))
                    return place;
            if (folder == folder.root_path())
                break;
        }
    throw InputError("The folder config/layouts is neither above the program nor above the current folder: "
                     "install the package starbow, or run starbow from its own checkout");
}

fs::path site()
{
    const fs::path folder = home();
    if (folder.filename() != "starbow" || folder.parent_path().filename() != "share")
        return {};
    const fs::path prefix = folder.parent_path().parent_path();
    return (prefix.filename() == "usr" ? prefix.parent_path() : prefix) / "etc" / "starbow";
}

fs::path own_profiles()
{
    const char *config = std::getenv("XDG_CONFIG_HOME"), *person = std::getenv("HOME");
    return (config && *config ? fs::path(config) : fs::path(person ? person : "/") / ".config") / "starbow" / "profiles";
}

std::vector<Profile> known_profiles(const fs::path& exhibits)
{
    std::error_code error;
    if (!exhibits.empty() && !fs::is_directory(exhibits, error))
        throw InputError(exhibits.string(), "", "is not a folder; a folder with profiles is right");
    std::vector<Profile> all;
    const fs::path of_site = site();
    for (const fs::path& folder :
        {home() / "config" / "profiles", of_site.empty() ? of_site : of_site / "profiles", own_profiles(), exhibits}) {
        std::vector<fs::path> files;
        each_entry(folder, [&](const fs::path& file) {
            if (file.extension() == ".json")
                files.push_back(folder / file);
        });
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files)
            all.push_back(load_profile(file));
    }
    return all;
}

/// The folders of a kind's files, the first one first.
static std::vector<fs::path> folders_of(const std::string& kind)
{
    std::vector<fs::path> folders{home() / "config" / kind};
    if (const fs::path of_site = site(); !of_site.empty())
        folders.insert(folders.begin(), of_site / kind);
    return folders;
}

std::vector<std::string> shipped_names(const std::string& kind)
{
    std::set<std::string> names;
    for (const fs::path& folder : folders_of(kind))
        each_entry(folder, [&](const fs::path& file) {
            if (file.extension() == ".json")
                names.insert(file.stem());
        });
    return {names.begin(), names.end()};
}

fs::path shipped_file(const std::string& kind, const std::string& name)
{
    std::error_code error;
    if (is_path(name)) {
        const fs::path file = as_stored(name);
        if (const std::optional<FileKind> wanted = kind_in(kind))
            reject_other_kind(file, *wanted);
        return file;
    }
    const std::vector<fs::path> folders = folders_of(kind);
    for (const fs::path& folder : folders)
        if (const fs::path file = folder / (name + ".json"); fs::is_regular_file(file, error))
            return file;
    std::string list;
    for (const std::string& known : shipped_names(kind))
        list += (list.empty() ? "" : ", ") + known;
    throw InputError("There is no " + name + ".json in config/" + kind
        + (folders.size() > 1 ? " or " + folders[0].string() : "") + "; there are: " + list
        + "; or give the path of a file");
}

Words words_in(const std::string& language) { return load_words(shipped_file("words", language)); }

std::vector<std::pair<std::string, std::string>> languages_here(const std::function<void(const std::string&)>& say)
{
    std::vector<std::pair<std::string, std::string>> languages;
    for (const std::string& name : shipped_names("words"))
        try {
            languages.emplace_back(name, words_in(name)("remote.this_language"));
        } catch (const InputError& error) {
            say(one_line(error.what()));
        }
    return languages;
}

Tour tour_in(const std::string& name, const Words& words)
{
    return load_tour(
        shipped_file("tours", name), words, [](const std::string& shot) { return shipped_file("shots", shot); });
}

fs::path scene_of(const Tour& tour)
{
    return is_path(tour.scene) ? tour.file.parent_path() / tour.scene : shipped_file("scenes", tour.scene);
}

fs::path scene_of(const Shot& shot, const fs::path& shot_file)
{
    return is_path(shot.scene) ? shot_file.parent_path() / shot.scene : shipped_file("scenes", shot.scene);
}

} // namespace starbow
