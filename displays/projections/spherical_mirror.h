#pragma once
#include "config/model/layout.h"
#include "plane.h"

namespace starbow {

/// The sphere reflects light from the projector's lens, which lands on the inside of the dome; an eye sees the place where
/// it lands. The method is Bourke's (2005, Using a spherical mirror for projection into immersive environments). picture.h
/// has the contract of each function. They return nullopt where the light misses the mirror or lands beyond the dome's
/// aperture, and everywhere for a lens inside the mirror. The dome's aperture is measured at its centre.
class SphericalMirrorRays {
public:
    SphericalMirrorRays(const SphericalMirror& mirror, glm::ivec2 size, const glm::dvec3& eye_m);
    std::optional<glm::dvec3> direction(glm::dvec2 pixel) const;

    /// The pixel whose light reaches the dome where `direction` meets it. The reflecting point of the mirror is Alhazen's
    /// problem. It is solved in the plane of lens, place and the mirror's centre, to a few roundings of the angle at that
    /// centre.
    std::optional<glm::dvec2> pixel(const glm::dvec3& direction) const;

    /// Computed at the point, from ray differentials (Igehy 1999). At the mirror's limb it grows without bound and is cut
    /// off at the root of 2 pi, half the sky.
    double pixel_angle(glm::dvec2 pixel) const;

private:
    struct Path { ///< a ray's unit directions and its points in the room
        double depth; ///< from the lens to the mirror
        glm::dvec3 out, mirror_normal, mirror_point, reflected, dome_point;
        double flight; ///< from the mirror to the dome
    };
    std::optional<Path> trace(glm::dvec2 pixel) const;
    std::optional<glm::dvec3> dome_hit(const glm::dvec3& from, const glm::dvec3& way) const;

    SphericalMirror mirror_;
    Plane projector_;
    glm::dvec3 eye_m_, zenith_;
    double least_height_m_; ///< of the dome's rim along the zenith, from its centre
};

} // namespace starbow
