#include "commands.h"
#include "config/error.h"
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

namespace {

/// One line, whatever a name or an argument holds: control characters are not for the terminal.
int complain(std::string text)
{
    for (char& c : text)
        if ((unsigned char)(c) < 0x20 || c == 0x7f)
            c = '?';
    std::fprintf(stderr, "starbow: %s\n", text.c_str());
    return 2;
}

int guarded(const std::function<int()>& run)
{
    try {
        return run();
    } catch (const starbow::InputError& error) {
        return complain(error.what());
    }
}

} // namespace

int main(int count, char** arguments)
{
    CLI::App app("Starbow: fly near the speed of light and see what physics says you would see.");
    app.require_subcommand(1);
    std::function<int()> chosen;
    for (auto add : {starbow::add_run, starbow::add_render, starbow::add_check, starbow::add_displays, starbow::add_warp,
             starbow::add_import, starbow::add_bench})
        add(app, chosen);
    try {
        app.parse(count, arguments);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0)
            return app.exit(error); // help
        return complain(error.what() + std::string("; 'starbow --help' tells what there is"));
    }
    return guarded(chosen);
}
