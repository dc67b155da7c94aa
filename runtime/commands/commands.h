#pragma once
#include <functional>

namespace starbow {

class Subcommand;

/// Adds one subcommand to `app`. After parsing, `chosen` runs the given subcommand and returns the exit status.
using AddCommand = void (*)(Subcommand& app, std::function<int()>& chosen);

/// A subcommand registers itself by a constant in its own file, and belongs to the program into which that file is compiled:
/// starbow, or starbow-tools, which is built when one of its commands is first requested, because few people measure.
struct Registered {
    int place; ///< in --help, counted from 1
    AddCommand add;
    Registered(int its_place, AddCommand its_add);
};

/// A program's main function: reads the command line, runs the given one of the registered commands, and prints an error in
/// one line. Returns the exit status.
int run_program(int count, char** arguments);

} // namespace starbow
