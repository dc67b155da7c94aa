#pragma once
#include <functional>

namespace CLI {
class App;
}

namespace starbow {

/// Each function adds one subcommand to `app`. After parsing, `chosen` runs the given subcommand and returns the exit
/// status.
void add_run(CLI::App& app, std::function<int()>& chosen);
void add_render(CLI::App& app, std::function<int()>& chosen);
void add_devices(CLI::App& app, std::function<int()>& chosen);
void add_calibrate(CLI::App& app, std::function<int()>& chosen);
void add_doctor(CLI::App& app, std::function<int()>& chosen);
void add_displays(CLI::App& app, std::function<int()>& chosen);
void add_bench(CLI::App& app, std::function<int()>& chosen);
void add_report(CLI::App& app, std::function<int()>& chosen);
void add_soak(CLI::App& app, std::function<int()>& chosen);
void add_measure(CLI::App& app, std::function<int()>& chosen);
void add_check(CLI::App& app, std::function<int()>& chosen);
void add_warp(CLI::App& app, std::function<int()>& chosen);
void add_import(CLI::App& app, std::function<int()>& chosen);
void add_tell(CLI::App& app, std::function<int()>& chosen);
void add_challenges(CLI::App& app, std::function<int()>& chosen);
void add_class(CLI::App& app, std::function<int()>& chosen);

} // namespace starbow
