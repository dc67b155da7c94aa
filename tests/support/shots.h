#pragma once
#include "config/model/shot.h"
#include "tests/support/effects.h"

namespace starbow::testing {

/// A shot without colour effects, for tests of shapes alone.
inline Shot shot_at(
    const glm::dvec3& position, const glm::dvec3& u, const glm::dvec3& look = {0, 0, -1}, const glm::dvec3& up = {0, 1, 0})
{
    Shot shot;
    shot.position = position;
    shot.u = u;
    shot.ship_from_cockpit = orientation(look, up);
    shot.effects = effects_of(true, false, false);
    return shot;
}

} // namespace starbow::testing
