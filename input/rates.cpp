#include "rates.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

double sum(double device, double others, double full)
{
    const double most = std::max(full, std::abs(others));
    return std::clamp(std::clamp(device, -full, full) + others, -most, most);
}

} // namespace

Rates take_rates(Controls& controls)
{
    Rates rates;
    std::swap(rates.throttle_rate, controls.throttle_rate);
    std::swap(rates.exposure, controls.exposure);
    std::swap(rates.push, controls.push);
    std::swap(rates.turn, controls.turn);
    std::swap(rates.look_rad, controls.look_rad);
    return rates;
}

void add_rates(Controls& device, const Rates& others, double dt_s)
{
    device.throttle_rate = sum(device.throttle_rate, others.throttle_rate, 1);
    device.exposure = sum(device.exposure, others.exposure, 1);
    for (int i = 0; i < 3; ++i) {
        device.push[i] = sum(device.push[i], others.push[i], 1);
        device.turn[i] = sum(device.turn[i], others.turn[i], 1);
    }
    for (int i = 0; i < 2; ++i)
        device.look_rad[i] = sum(device.look_rad[i], others.look_rad[i], look_rad_per_s * dt_s);
}

} // namespace starbow
