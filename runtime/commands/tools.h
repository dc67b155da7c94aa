#pragma once
#include <functional>
#include <string>
#include <vector>

namespace starbow {

class Subcommand;

/// A command of starbow-tools, a program of its own beside starbow or in lib/starbow: few people measure, and `./run` builds
/// it when one of its commands is first asked for.
struct Tool {
    const char *name, *help;
};
constexpr Tool bench_tool{"bench", "Time the stages of a frame, and two ratios measured in turn in the same run."};
constexpr Tool measure_tool{"measure",
    "Measure the trade-off between speed and accuracy: each setting's time, memory and error against the ray-traced "
    "reference, as a table and a chart."};
constexpr Tool soak_tool{"soak",
    "Show the exhibit to many visitors made of random numbers, as fast as it goes, and compare the process's memory, "
    "files, threads and Vulkan objects at the end with those near the start. It ends with 1 where they have grown."};
constexpr Tool reference_tool{"reference", "Draw a shot by rays: starbow render --reference."};

/// This process becomes starbow-tools with these arguments. Throws InputError where that program is missing.
[[noreturn]] void become_tools(const std::vector<std::string>& arguments);

/// Adds a command of starbow-tools to starbow; its arguments are passed on as they are.
void add_tool(Subcommand& app, std::function<int()>& chosen, const Tool& tool);

} // namespace starbow
