#include "commands.h"
namespace starbow { void add_run(CLI::App&, std::function<int()>&) {} }
