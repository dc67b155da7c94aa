#pragma once
#include "runtime/commands/options/command_line.h"
#include <string>

namespace starbow {

inline Option* add_language(Subcommand& command, std::string& language)
{
    return command.add_option(
        "--language", language, "The visitors' language: the name of one in config/words, or a file of words [en]");
}

} // namespace starbow
