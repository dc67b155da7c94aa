#pragma once
#include "effects.h"
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>

namespace starbow {

/// One frozen instant, in the scene's units (lengths in units, times in unit / c).
struct Shot {
    std::string scene; ///< name or path of a scene file
    double time = 0;
    glm::dvec3 position{0};
    glm::dvec3 u{0}; ///< proper velocity, gamma beta, world frame
    glm::dquat ship_from_cockpit{1, 0, 0, 0}; ///< from `look` and `up`; ship frame: the world's axes carried by a pure boost
    Effects effects;
    double exposure_ev = 0;
};

/// Reads and checks a shot. Speeds: exactly one of gamma (>= 1), beta (>= 0, < 1), rapidity (>= 0) beside a direction;
/// without "velocity" the ship is at rest. Throws InputError.
Shot load_shot(const std::filesystem::path& file);

/// Rotation that takes the cockpit's axes (-z ahead, +y up) to those of `look` and `up` (need not be perpendicular or unit).
glm::dquat orientation(const glm::dvec3& look, const glm::dvec3& up);

} // namespace starbow
