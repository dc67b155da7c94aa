#include "tools.h"
#include "commands.h"
#include "config/json/error.h"
#include "options/command_line.h"
#include <filesystem>
#include <system_error>
#include <unistd.h>

namespace starbow {

void become_tools(const std::vector<std::string>& arguments)
{
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    const fs::path beside = folder / "starbow-tools", installed = folder.parent_path() / "lib" / "starbow" / "starbow-tools";
    std::vector<char*> passed{const_cast<char*>("starbow")};
    for (const std::string& argument : arguments)
        passed.push_back(const_cast<char*>(argument.c_str()));
    passed.push_back(nullptr);
    for (const fs::path& program : {beside, installed})
        ::execv(program.c_str(), passed.data());
    throw InputError(beside.string(), "",
        "can't be started (" + std::error_code(errno, std::generic_category()).message()
            + "); ./run builds it, and so does 'ninja starbow-tools' in the build's folder");
}

void add_tool(Subcommand& app, std::function<int()>& chosen, const Tool& tool)
{
    Subcommand* command = app.add_subcommand(tool.name, tool.help);
    command->pass_arguments_on();
    command->callback([command, &chosen, name = std::string(tool.name)] {
        std::vector<std::string> arguments = command->passed_on();
        arguments.insert(arguments.begin(), name);
        chosen = [arguments]() -> int { become_tools(arguments); };
    });
}

template <const Tool& tool> static void add(Subcommand& app, std::function<int()>& chosen) { add_tool(app, chosen, tool); }
static const Registered bench_forward{10, add<bench_tool>}, measure_forward{11, add<measure_tool>},
    soak_forward{13, add<soak_tool>};

} // namespace starbow
