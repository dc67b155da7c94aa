#include "commands.h"
#include "config/model/schemas.h"
#include "runtime/commands/options/command_line.h"
#include <cstdio>
#include <memory>

namespace starbow {

static void add_help(Subcommand& app, std::function<int()>& chosen)
{
    Subcommand* command
        = app.add_subcommand("help", "Print every member of a kind of file, with its meaning and its limits.");
    const auto kind = std::make_shared<std::string>();
    std::string kinds;
    for (const std::string& one : kinds_with_schema())
        kinds += (kinds.empty() ? "" : ", ") + one;
    command->add_option("KIND", *kind, "The kind of file: " + kinds)->required();
    command->footer("Example:\n  starbow help layout");
    command->callback([kind, &chosen] {
        chosen = [kind] {
            std::printf("%s", members_text(*kind).c_str());
            return 0;
        };
    });
}

static const Registered help_command{18, add_help};

} // namespace starbow
