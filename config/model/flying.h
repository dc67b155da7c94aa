#pragma once
#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace starbow {

/// guided: the throttle's place sets the speed, and the velocity follows the nose. free: the throttle's place sets the
/// speed, and the nose turns by itself. newtonian: the throttle sets the thrust along the nose, and the ship is not
/// slowed down otherwise.
enum class FlightMode { guided, free, newtonian };
constexpr std::array<std::string_view, 3> flight_mode_names{"guided", "free", "newtonian"};
inline const std::vector<std::pair<std::string_view, FlightMode>> flight_modes{{flight_mode_names[0], FlightMode::guided},
    {flight_mode_names[1], FlightMode::free}, {flight_mode_names[2], FlightMode::newtonian}};
inline std::string_view name_of(FlightMode mode) { return flight_mode_names[std::size_t(mode)]; }

/// The part of a world that visitors fly in: a ball. Scene units.
struct Boundary {
    glm::dvec3 centre{0};
    double radius = 0;
};

/// A box along the world's axes around a thing. Scene units.
struct AlignedBox {
    glm::dvec3 low{0}, high{0};
};

/// A ball that no visitor flies into: a planet's ground. Its middle moves along a polynomial of the world's time over
/// `span`; scene units.
struct Solid {
    double radius = 0, span = 1;
    std::array<glm::dvec3, 6> path{}; ///< coefficients, the constant first
};

/// The flight that a world is made for: straight ahead from its start, with the throttle held open.
struct PlannedFlight {
    double distance = 0; ///< scene units
    double time_s = 0; ///< the visitor's
};

/// The pace at which visitors gain speed among a world's things: the less, the sooner they reach the nearest one.
struct Pace {
    double per_s2 = 0; ///< rapidity per second for each second to the nearest thing
    double least = 0; ///< a nearer thing counts as so far away, scene units
    std::vector<AlignedBox> things; ///< that rest in the world
};

/// Darkens the picture's edge while the ship turns smoothly. Angles from the middle of the clear part.
struct Vignette {
    double elevation_deg = 0; ///< that middle, above the cockpit's nose: the eye's axis, or a dome's front
    double clear_deg = 35; ///< the part that stays clear
    double soft_deg = 20; ///< from the clear part's edge to the darkest
    double darkness = 1; ///< the part of the light that is lost there, in a turn at half of the rules' rate or faster
};

/// Rules against motion sickness, for a dome or a headset, where the whole field of view turns.
struct Comfort {
    bool no_roll = false; ///< the controls' roll does nothing
    bool level_horizon = false; ///< the cockpit's right axis stays at right angles to the ship's y
    double turn_steps_deg = 0; ///< the view turns at once, by so much; 0: smoothly
    std::optional<Vignette> vignette{};
};

/// The rules of flight of an exhibit. Times are the visitor's seconds, which are the ship's.
struct Flying {
    FlightMode mode = FlightMode::guided;
    double max_gamma = 1e6; ///< at full throttle; lower places are evenly spaced in rapidity
    // Limits that spare the visitors' stomachs.
    double turn_deg_per_s = 40; ///< nose up, down, left, right
    double roll_deg_per_s = 40;
    double turn_jerk_deg_per_s3 = 8000; ///< of any of these turns, even when a stick is thrown from end to end
    double rapidity_per_s = 1.5; ///< greatest gain or loss of speed
    double rapidity_jerk_per_s2 = 15; ///< greatest change of that gain
    std::optional<Boundary> boundary{}; ///< the world's, where visitors shall not get lost
    std::optional<Pace> pace{}; ///< the world's, where a flight through it shall last its planned time
    std::vector<Solid> solids{}; ///< of the world
    Comfort comfort{};
    bool paced = false; ///< the visitors gain speed at each world's own pace
};

} // namespace starbow
