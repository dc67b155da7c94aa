#pragma once
#include <functional>
#include <string>
#include <vector>

namespace starbow {

class Subcommand;

/// Each function adds one subcommand to `app`. After parsing, `chosen` runs the given subcommand and returns the exit
/// status.
void add_run(Subcommand& app, std::function<int()>& chosen);
void add_render(Subcommand& app, std::function<int()>& chosen);
void add_devices(Subcommand& app, std::function<int()>& chosen);
void add_calibrate(Subcommand& app, std::function<int()>& chosen);
void add_doctor(Subcommand& app, std::function<int()>& chosen);
void add_displays(Subcommand& app, std::function<int()>& chosen);
void add_report(Subcommand& app, std::function<int()>& chosen);
void add_check(Subcommand& app, std::function<int()>& chosen);
void add_warp(Subcommand& app, std::function<int()>& chosen);
void add_import(Subcommand& app, std::function<int()>& chosen);
void add_tell(Subcommand& app, std::function<int()>& chosen);
void add_challenges(Subcommand& app, std::function<int()>& chosen);
void add_class(Subcommand& app, std::function<int()>& chosen);
void add_help(Subcommand& app, std::function<int()>& chosen);

/// The commands of starbow-tools, a program of its own: few people measure, and it is built when one of them is first asked
/// for.
void add_bench(Subcommand& app, std::function<int()>& chosen);
void add_measure(Subcommand& app, std::function<int()>& chosen);
void add_soak(Subcommand& app, std::function<int()>& chosen);
void add_reference(Subcommand& app, std::function<int()>& chosen); ///< render --reference

using AddCommand = void (*)(Subcommand&, std::function<int()>&);

/// A program's main function: reads the command line, runs the given command, and prints an error in one line. Returns the
/// exit status.
int run_program(int count, char** arguments, const std::vector<AddCommand>& commands);

} // namespace starbow
