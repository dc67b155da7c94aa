#include "tutorial.h"
#include "pilot.h"
#include <cmath>

namespace starbow {

Tutorial tutorial_at(const Flight& flight) { return {.begun_at = rapidity_of(flight.ship)}; }

Tutorial advance(Tutorial tutorial, const Controls& controls, const Flight& flight, double dt_s)
{
    tutorial.turned_rad += std::hypot(flight.turn_rad_s.x, flight.turn_rad_s.y) * dt_s;
    const double speed = rapidity_of(flight.ship);
    const bool done[] = {std::abs(speed - tutorial.begun_at) > lesson_rapidity, tutorial.turned_rad > lesson_turn_rad,
        controls[Switch::stop] || controls[Switch::home]};
    if (tutorial.lesson < lessons && done[tutorial.lesson])
        tutorial = {.lesson = tutorial.lesson + 1, .begun_at = speed};
    return tutorial;
}

std::string prompt(const Tutorial& tutorial, const InputCapabilities& capabilities, const Words& words)
{
    switch (tutorial.lesson) {
    case 0:
        if (capabilities.lever)
            return words("tutorial.go_throttle");
        if (capabilities.trigger)
            return words(capabilities.left_handed ? "tutorial.go_left_trigger"_key : "tutorial.go_trigger"_key);
        return words(capabilities.left_handed ? "tutorial.go_left_key"_key : "tutorial.go_key"_key);
    case 1:
        return words(capabilities.stick    ? "tutorial.turn_stick"_key
                : capabilities.left_handed ? "tutorial.turn_left_keys"_key
                                           : "tutorial.turn_keys"_key);
    case 2:
        return capabilities.stop_button > 0
            ? words("tutorial.stop_button", {{"button", std::to_string(capabilities.stop_button)}})
            : words("tutorial.stop_key");
    default:
        return "";
    }
}

} // namespace starbow
