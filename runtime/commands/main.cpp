#include "commands.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "runtime/operation/crash.h"
#include "runtime/operation/messages.h"
#include "runtime/operation/state_folder.h"
#include "version.h"
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace {

/// The exit status after wrong input and where the machine has failed: its memory, its disk, its graphics driver.
constexpr int not_done = 2;
constexpr std::string_view memory_used_up
    = "The memory is used up; smaller outputs, a smaller world or more memory is right";

/// Prints one line on standard error, after the log's lines.
int complain(std::string text) noexcept
{
    try {
        starbow::send_message(STDERR_FILENO, "starbow: " + starbow::plain_text(std::move(text)) + "\n");
    } catch (const std::bad_alloc&) {
        std::fputs("starbow: The memory is used up\n", stderr);
    }
    return not_done;
}

/// Names joined for a sentence: "a, b and c are".
std::string there_are(const std::vector<std::string>& names)
{
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i)
        list += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return list + (names.size() == 1 ? " is" : " are");
}

/// The first unknown option or command, with the known ones, or "". It is reported before a missing argument: most often
/// the unknown one is the missing one misspelt.
std::string unknown(const CLI::App& app)
{
    const std::vector<std::string> left = app.remaining();
    const std::vector<CLI::App*> taken = app.get_subcommands();
    if (left.empty())
        return taken.empty() ? "" : unknown(*taken.back());
    std::string whole_name = "starbow"; // the command's name with its parents'
    for (const CLI::App* at = &app; at->get_parent(); at = at->get_parent())
        whole_name.insert(7, " " + at->get_name());
    std::vector<std::string> names;
    if (left[0].starts_with("-")) {
        for (const CLI::Option* option : app.get_options())
            if (option->nonpositional())
                names.push_back("--" + option->get_lnames().at(0));
        return left[0] + " is no option of '" + whole_name + "'; " + there_are(names);
    }
    for (const CLI::App* command : app.get_subcommands({}))
        names.push_back(command->get_name());
    return left[0]
        + (names.empty() ? " is one argument too many for '" + whole_name + "'" : " is no command; " + there_are(names));
}

int guarded(const std::function<int()>& run)
{
    try {
        return run();
    } catch (const starbow::InputError& error) {
        return complain(error.what());
    } catch (const std::bad_alloc&) {
        return complain(std::string(memory_used_up));
    } catch (const std::system_error& error) {
        // The graphics driver's errors have a category of their own.
        const std::error_category& category = error.code().category();
        const bool driver = category != std::generic_category() && category != std::system_category();
        return complain(std::string(driver ? "The graphics driver has failed: " : "The system has failed: ") + error.what()
            + (driver ? "; 'starbow doctor' says what may mend it" : ""));
    } catch (const std::exception& error) {
        return complain(std::string("The program has failed: ") + error.what());
    }
}

int run(int count, char** arguments)
{
    starbow::guard_streams();
    if (const std::filesystem::path folder = starbow::state_folder(); !folder.empty())
        starbow::keep_crash_traces(folder / "crash", starbow::program_version);
    CLI::App app("Starbow: fly near the speed of light and see what physics says you would see.");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("starbow ") + starbow::program_version);
    app.footer("Examples:\n  starbow run --layout dome\n  starbow render --layout dome --shot avenue-gamma4 --out out/dome\n"
               "  starbow check my/wall.json --svg out/wall.svg\n  starbow COMMAND --help");
    std::function<int()> chosen;
    for (auto add : {starbow::add_run, starbow::add_render, starbow::add_check, starbow::add_doctor, starbow::add_displays,
             starbow::add_devices, starbow::add_calibrate, starbow::add_warp, starbow::add_import, starbow::add_bench,
             starbow::add_measure, starbow::add_report, starbow::add_soak, starbow::add_tell, starbow::add_challenges,
             starbow::add_class})
        add(app, chosen);
    try {
        app.parse(count, arguments);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0)
            return app.exit(error); // help, or the version
        const std::string what = unknown(app);
        return complain((what.empty() ? error.what() : what) + "; 'starbow --help' lists commands and options");
    }
    return chosen();
}

std::terminate_handler usual_end = nullptr;
thread_local bool memory_refused = false;

void note_refused_memory()
{
    memory_refused = true;
    throw std::bad_alloc();
}

/// True if the exception that ends the program is refused memory. GCC enters the terminate handler from a function that may
/// not throw in two ways: with the exception caught, or, where objects had to be destroyed first, with it still uncaught and
/// hence unnamed.
bool ended_by_refused_memory()
{
    try {
        if (const std::exception_ptr error = std::current_exception())
            std::rethrow_exception(error);
        return memory_refused && std::uncaught_exceptions() > 0;
    } catch (const std::bad_alloc&) {
        return true;
    } catch (...) {
        return false;
    }
}

/// Ends the program where memory is refused before main, or inside a destructor or a function that may not throw: nlohmann's
/// JSON values allocate while they are destroyed, and CLI11 while it looks an option up. All other terminations are crashes.
void end_at_once()
{
    if (ended_by_refused_memory()) {
        for (const std::string_view part : {std::string_view("starbow: "), memory_used_up, std::string_view("\n")})
            [[maybe_unused]] const ssize_t wrote = ::write(STDERR_FILENO, part.data(), part.size());
        std::_Exit(not_done);
    }
    usual_end();
    std::abort();
}

/// Runs before the other files' static objects are made, because these allocate, too.
[[gnu::constructor(101)]] void guard_memory()
{
    usual_end = std::set_terminate(end_at_once);
    std::set_new_handler(note_refused_memory);
}

} // namespace

int main(int count, char** arguments)
{
    return guarded([&] { return run(count, arguments); });
}
