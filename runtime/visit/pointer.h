#pragma once
#include <glm/glm.hpp>
#include <optional>

namespace starbow {

/// The ring with which a guide points at something in the picture. It fades in where it is first placed, glides after the
/// guide's finger, and is gone some seconds after the last touch. Nothing that a guide does makes it jump or blink: it moves
/// and fades at limited rates.
class Pointer {
public:
    static constexpr double stays_s = 4; ///< after the last touch
    static constexpr double fade_s = 0.5; ///< from nothing to the whole ring, and back
    static constexpr double fastest_deg_per_s = 90;

    /// The guide points there, a direction in the cockpit.
    void touch(double azimuth_deg, double elevation_deg);
    void advance(double dt_s);

    struct Shown {
        glm::dvec3 towards{0, 0, -1}; ///< unit, cockpit axes
        double strength = 1; ///< from above 0 to 1: the whole ring
    };
    std::optional<Shown> shown() const;

private:
    glm::dvec3 target_{0, 0, -1}, towards_{0, 0, -1};
    double left_s_ = 0; ///< until it fades
    double strength_ = 0;
};

} // namespace starbow
