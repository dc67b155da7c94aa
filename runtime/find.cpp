#include "find.h"
#include "config/error.h"
#include <algorithm>
#include <vector>

namespace starbow {
namespace fs = std::filesystem;

fs::path home()
{
    std::error_code error;
    for (fs::path start : {fs::read_symlink("/proc/self/exe", error).parent_path(), fs::current_path(error)})
        for (fs::path folder = start; !folder.empty(); folder = folder.parent_path()) {
            if (fs::is_directory(folder / "config" / "layouts", error))
                return folder;
            if (folder == folder.root_path())
                break;
        }
    throw InputError("The folder config/layouts is neither above the program nor above the current folder: "
                     "run starbow from its own checkout");
}

fs::path find(const std::string& kind, const std::string& name)
{
    std::error_code error;
    // A path, by its looks, or a file that is there; otherwise a name.
    if (name.find('/') != std::string::npos || name.ends_with(".json"))
        return name;
    fs::path folder = home() / "config" / kind, file = folder / (name + ".json");
    if (fs::is_regular_file(file, error))
        return file;
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == ".json")
            names.push_back(entry.path().stem());
    std::sort(names.begin(), names.end());
    std::string list;
    for (const std::string& known : names)
        list += (list.empty() ? "" : ", ") + known;
    throw InputError("There is no " + name + ".json in config/" + kind + "; there are: " + list + "; or give the path of a file");
}

} // namespace starbow
