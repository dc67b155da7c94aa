#include "state_folder.h"
#include <cstdlib>
#include <string>

namespace starbow {

std::filesystem::path state_folder()
{
    const auto set = [](const char* name) -> std::string {
        const char* value = std::getenv(name);
        return value ? value : "";
    };
    if (const std::string given = set("STATE_DIRECTORY"); !given.empty())
        return given.substr(0, given.find(':')); // a unit may have several
    if (const std::string base = set("XDG_STATE_HOME"); !base.empty())
        return std::filesystem::path(base) / "starbow";
    const std::string person = set("HOME");
    return person.empty() ? std::filesystem::path() : std::filesystem::path(person) / ".local" / "state" / "starbow";
}

} // namespace starbow
