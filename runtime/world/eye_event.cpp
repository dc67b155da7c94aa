#include "eye_event.h"
#include "shaders/physics/physics.h"

namespace starbow {

glm::dmat3 motion_from_world(const glm::dvec3& u, const glm::dquat& ship_from_cockpit)
{
    double length = glm::length(u);
    glm::dvec3 z = length > 0 ? u / length : ship_from_cockpit * glm::dvec3(0, 0, -1);
    z = glm::normalize(z);
    glm::dvec3 up = ship_from_cockpit * glm::dvec3(0, 1, 0);
    if (std::abs(glm::dot(up, z)) > 0.99)
        up = ship_from_cockpit * glm::dvec3(0, 0, 1);
    glm::dvec3 y = glm::normalize(up - glm::dot(up, z) * z);
    glm::dvec3 x = glm::cross(y, z);
    return glm::transpose(glm::dmat3(x, y, z));
}

EyeEvent eye_event_of(const RestFrameView& rest_frame, int frame, const glm::dvec3& place)
{
    const glm::dvec3 offset = rest_frame.shot.ship_from_cockpit * place;
    return {frame, rest_frame.shot.position + physics::eye_place(rest_frame.shot.u, offset),
        rest_frame.shot.time + physics::eye_time(rest_frame.shot.u, offset), rest_frame.cube_from_frame, rest_frame.now,
        rest_frame.contraction, rest_frame.beta, rest_frame.E, rest_frame.cube_from_motion * glm::dvec3(0, 0, 1)};
}

} // namespace starbow
