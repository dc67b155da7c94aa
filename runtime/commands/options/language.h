#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace starbow {

inline CLI::Option* add_language(CLI::App& command, std::string& language)
{
    return command.add_option(
        "--language", language, "The visitors' language: the name of one in config/words, or a file of words [en]");
}

} // namespace starbow
