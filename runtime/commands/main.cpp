#include "commands.h"
#include "config/error.h"
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

namespace {

int guarded(const std::function<int()>& run)
{
    try {
        return run();
    } catch (const starbow::InputError& error) {
        std::fprintf(stderr, "starbow: %s\n", error.what());
        return 2;
    }
}

} // namespace

int main(int count, char** arguments)
{
    CLI::App app("Starbow: fly near the speed of light and see what physics says you would see.");
    app.require_subcommand(1);
    std::function<int()> chosen;
    for (auto add : {starbow::add_run, starbow::add_render, starbow::add_bench})
        add(app, chosen);
    try {
        app.parse(count, arguments);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    return guarded(chosen);
}
