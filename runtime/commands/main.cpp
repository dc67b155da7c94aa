#include "commands.h"
#include "tools.h"

namespace {

template <const starbow::Tool& tool> void add(starbow::Subcommand& app, std::function<int()>& chosen)
{
    starbow::add_tool(app, chosen, tool);
}

} // namespace

int main(int count, char** arguments)
{
    using namespace starbow;
    return run_program(count, arguments,
        {add_run, add_render, add_check, add_doctor, add_displays, add_devices, add_calibrate, add_warp, add_import,
            add<bench_tool>, add<measure_tool>, add_report, add<soak_tool>, add_tell, add_challenges, add_class, add_help});
}
