#include "commands.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/operation/crash.h"
#include "runtime/operation/messages.h"
#include "runtime/operation/state_folder.h"
#include "version.h"
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace starbow {
namespace {

/// The exit status after wrong input and where the machine has failed: its memory, its disk, its graphics driver.
constexpr int not_done = 2;
constexpr std::string_view memory_used_up
    = "The memory is used up; smaller outputs, a smaller world or more memory is right";

/// Prints one line on standard error, after the log's lines.
int fail_at(std::string text) noexcept
{
    try {
        send_message(STDERR_FILENO, "starbow: " + plain_text(std::move(text)) + "\n");
    } catch (const std::bad_alloc&) {
        std::fputs("starbow: The memory is used up\n", stderr);
    }
    return not_done;
}

int guarded(const std::function<int()>& run)
{
    try {
        return run();
    } catch (const InputError& error) {
        return fail_at(error.what());
    } catch (const std::bad_alloc&) {
        return fail_at(std::string(memory_used_up));
    } catch (const std::system_error& error) {
        // The graphics driver's errors have a category of their own.
        const std::error_category& category = error.code().category();
        const bool driver = category != std::generic_category() && category != std::system_category();
        return fail_at(std::string(driver ? "The graphics driver has failed: " : "The system has failed: ") + error.what()
            + (driver ? "; 'starbow doctor' says what may mend it" : ""));
    } catch (const std::exception& error) {
        return fail_at(std::string("The program has failed: ") + error.what());
    }
}

std::vector<Registered>& commands()
{
    static std::vector<Registered> all; // in the order of their places
    return all;
}

int run(int count, char** arguments)
{
    guard_streams();
    if (const std::filesystem::path folder = state_folder(); !folder.empty())
        keep_crash_traces(folder / "crash", program_version);
    std::function<int()> chosen;
    const auto add = [&](Subcommand& program) {
        for (const Registered& command : commands())
            command.add(program, chosen);
    };
    const bool given = parse_command_line(count, arguments, std::string("starbow ") + program_version, add);
    return given ? chosen() : 0;
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

Registered::Registered(int its_place, AddCommand its_add)
    : place(its_place)
    , add(its_add)
{
    std::vector<Registered>& all = commands();
    all.insert(std::ranges::upper_bound(all, place, {}, &Registered::place), *this);
}

int run_program(int count, char** arguments)
{
    return guarded([&] { return run(count, arguments); });
}

} // namespace starbow
