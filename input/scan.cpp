#include "scan.h"
#include <algorithm>
#include <utility>

namespace starbow {
namespace {

std::int64_t nanoseconds(double seconds) { return std::int64_t(1e9 * seconds); }

/// A choice's steering while it acts.
Steering rates_of(ScanChoice choice)
{
    Steering steering;
    switch (choice) {
    case ScanChoice::faster:
        steering.throttle_rate = 1;
        break;
    case ScanChoice::slower:
        steering.throttle_rate = -1;
        break;
    case ScanChoice::left:
        steering.turn.y = 1;
        break;
    case ScanChoice::right:
        steering.turn.y = -1;
        break;
    case ScanChoice::up:
        steering.turn.x = 1;
        break;
    case ScanChoice::down:
        steering.turn.x = -1;
        break;
    case ScanChoice::stop:
    case ScanChoice::home:
    case ScanChoice::menu:
        break;
    }
    return steering;
}

} // namespace

ScannedHands advance(Scan& scan, const OneButton& rules, AnyButton button, std::int64_t dt_ns)
{
    if (scan.page > 0) // the menu is closed: from the first choice on
        scan = {};
    const auto choice = ScanChoice(scan.choice);
    const bool takes = button.pressed && !scan.acts;
    if (button.pressed) {
        scan.acts = takes;
        scan.acts_ns = scan.shown_ns = 0;
    } else if (scan.acts) {
        scan.acts_ns += dt_ns;
        scan.acts = scan.acts_ns < (button.held ? longest_hold_ns : nanoseconds(rules.act_s));
        scan.shown_ns = 0;
    } else if ((scan.shown_ns += dt_ns) >= nanoseconds(rules.scan_s)) {
        scan.shown_ns -= nanoseconds(rules.scan_s);
        scan.choice = (scan.choice + 1) % scan_choices;
    }
    ScannedHands hands{scan.acts ? rates_of(choice) : Steering(), {}};
    hands.set(Switch::stop, takes && choice == ScanChoice::stop);
    hands.set(Switch::home, takes && choice == ScanChoice::home);
    hands.set(Switch::menu, takes && choice == ScanChoice::menu);
    return hands;
}

ScannedHands advance_in_menu(
    Scan& scan, const OneButton& rules, AnyButton button, std::size_t page, std::size_t items, std::int64_t dt_ns)
{
    if (std::exchange(scan.page, page + 1) != page + 1)
        scan.shown_ns = 0, scan.passed = 0;
    scan.acts = false;
    ScannedHands hands;
    if (button.pressed) {
        hands.set(Switch::stop);
        scan.shown_ns = 0, scan.passed = 0;
    } else if ((scan.shown_ns += dt_ns) >= nanoseconds(rules.scan_s)) {
        scan.shown_ns -= nanoseconds(rules.scan_s);
        if (++scan.passed < items)
            hands.turn.y = -1;
        else
            hands.set(Switch::home), scan.passed = 0;
    }
    return hands;
}

double passed_part(const Scan& scan, const OneButton& rules)
{
    const double part = scan.acts ? 1e-9 * double(scan.acts_ns) / rules.act_s : 1e-9 * double(scan.shown_ns) / rules.scan_s;
    return std::clamp(part, 0.0, 1.0);
}

} // namespace starbow
