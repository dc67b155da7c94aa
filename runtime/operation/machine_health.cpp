#include "machine_health.h"
#include <algorithm>
#include <array>
#include <cstdio>

namespace starbow {

std::size_t in_step(const std::vector<MachineHealth>& machines)
{
    return std::size_t(std::ranges::count_if(machines, &MachineHealth::in_step));
}

std::string line_of(const std::vector<MachineHealth>& machines)
{
    std::string line;
    for (const MachineHealth& machine : machines) {
        std::array<char, 24> time;
        std::snprintf(time.data(), time.size(), "%.1f ms", machine.frame_ms);
        line += (line.empty() ? "" : ", ") + machine.name + " "
            + (machine.in_step        ? std::string(time.data())
                    : machine.differs ? "has another file"
                                      : "away");
    }
    return line;
}

} // namespace starbow
