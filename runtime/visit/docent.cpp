#include "docent.h"
#include <algorithm>

namespace starbow {

bool Docent::apply_command(const Command& command)
{
    switch (command.kind) {
    case CommandKind::fade:
        fades_ = command.on;
        return true;
    case CommandKind::exposure:
        exposure_ev_ = command.number;
        return true;
    case CommandKind::caption:
        caption_ = command.text;
        return true;
    case CommandKind::hold:
        holds_ = command.on;
        return true;
    case CommandKind::speed_limit:
        max_gamma_ = command.number;
        return true;
    case CommandKind::restart:
        restarts_ = true;
        return true;
    default:
        return false;
    }
}

void Docent::advance(double dt_s)
{
    constexpr double to_black_s = 1.5;
    fade_ = std::clamp(fade_ + (fades_ ? dt_s : -dt_s) / to_black_s, 0.0, 1.0);
}

} // namespace starbow
