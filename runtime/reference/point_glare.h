#pragma once
#include <glm/glm.hpp>

namespace starbow {

/// Nearer to a point than this, degrees, light belongs to the point and not to its glare.
constexpr double nearest_glare_deg = 0.1;

/// CIE 146:2002's equation of disability glare at small angles for 35 years: veiling luminance over illuminance, 1/sr. It is
/// flat within `nearest` degrees.
double glare_per_sr(double angle_deg, double nearest);

/// The part of a point's light in its glare above the glare's level at its end, degrees: a sum over rings.
double light_of_glare(double end, double nearest);

/// The Sun's glare fades out at so many degrees: docs/physics/solar-system.md, small globes.
constexpr double sun_glare_deg = 15;
double sun_glare_per_sr(double angle_deg, double nearest);
/// The part of the Sun's light in its glare.
double light_of_sun_glare(double nearest);

/// The angle, degrees, at which the glare of so much light (times steradians) is the dimmest that shows, at most `farthest`;
/// by bisection.
double glare_radius(const glm::dvec3& light, double exposure, double farthest);

} // namespace starbow
