#include "lever.h"
#include <algorithm>

namespace starbow {

std::optional<double> LeverChoice::place(std::span<const Lever> levers, std::int64_t now_ns)
{
    auto take = [&](const Lever& lever) {
        device_ = lever.device, axis_ = lever.axis;
        claim_ns_ = lever.moved_ns;
        there_ = true;
    };
    if (device_.empty() && !levers.empty())
        take(*std::min_element(
            levers.begin(), levers.end(), [](const Lever& a, const Lever& b) { return a.place < b.place; }));
    const auto held = std::find_if(
        levers.begin(), levers.end(), [&](const Lever& lever) { return lever.device == device_ && lever.axis == axis_; });
    const bool there = held != levers.end();
    if (there != there_) // the chosen lever was unplugged, or is back and unmoved
        claim_ns_ = now_ns;
    there_ = there;
    const Lever* chosen = there ? &*held : nullptr;
    if (there)
        claim_ns_ = std::max(claim_ns_, held->moved_ns);
    for (const Lever& lever : levers)
        if (lever.moved_ns > claim_ns_) {
            take(lever);
            chosen = &lever;
        }
    return chosen ? std::optional(chosen->place) : std::nullopt;
}

} // namespace starbow
