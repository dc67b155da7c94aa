#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace starbow {

/// A number that follows from the ship's state.
struct Measure {
    enum class Quantity {
        gamma,
        beta,
        rapidity,
        ship_s, ///< the ship's clock, seconds
        world_s, ///< the world's, seconds
        younger_s, ///< the time since the start by the world's clock, less that by the ship's, seconds
        trip_s, ///< the ship's clock since the tour's last cut, seconds
        distance, ///< to `at` in the world, scene units
        angle_deg, ///< between the motion and the seen direction of `at`; straight ahead 0
        doppler, ///< D of light from `at`
        doppler_ahead, ///< D straight along the motion
        size, ///< the angular size of a small thing at `at`, over that at the start
        reading_s, ///< the seen reading of a clock at `at` that keeps the world's time, seconds
        now_s, ///< that clock's reading at the ship's present, in the ship's frame, seconds
        own_colour_deg, ///< angle from the motion at which D is 1
    };
    Quantity quantity = Quantity::gamma;
    glm::dvec3 at{0}; ///< a place at rest in the world, scene units
    std::optional<glm::dvec3> relative_to; ///< the quantity at this place is subtracted
    double over = 1; ///< by which the quantity is divided: 31557600 makes years of seconds
};
inline const std::vector<std::pair<std::string_view, Measure::Quantity>> measures{{"gamma", Measure::Quantity::gamma},
    {"beta", Measure::Quantity::beta}, {"rapidity", Measure::Quantity::rapidity}, {"ship_s", Measure::Quantity::ship_s},
    {"world_s", Measure::Quantity::world_s}, {"younger_s", Measure::Quantity::younger_s},
    {"trip_s", Measure::Quantity::trip_s}, {"distance", Measure::Quantity::distance},
    {"angle_deg", Measure::Quantity::angle_deg}, {"doppler", Measure::Quantity::doppler},
    {"doppler_ahead", Measure::Quantity::doppler_ahead}, {"size", Measure::Quantity::size},
    {"reading_s", Measure::Quantity::reading_s}, {"now_s", Measure::Quantity::now_s},
    {"own_colour_deg", Measure::Quantity::own_colour_deg}};
constexpr bool has_place(Measure::Quantity quantity)
{
    using enum Measure::Quantity;
    return quantity == distance || quantity == angle_deg || quantity == doppler || quantity == size || quantity == reading_s
        || quantity == now_s;
}

} // namespace starbow
