#pragma once
#include "config/model/layout.h"
#include "cube_faces.h"
#include "cylinder.h"
#include "equirectangular.h"
#include "fisheye.h"
#include "keystone.h"
#include "lens.h"
#include "plane.h"
#include "spherical_mirror.h"
#include <glm/glm.hpp>
#include <optional>

namespace starbow {

/// A rectangle of pixels, its projection, and the eye that looks at it (cockpit's frame, metres; only walls and mirrors use
/// it). `size` need not be a screen's: a squeezed or small picture is read elsewhere.
struct Picture {
    Projection projection;
    glm::ivec2 size; ///< pixels, square ones
    glm::dvec3 eye_m{0};
};

enum class Channel { red, green, blue };

/// The unit direction in the cockpit's frame that the point `pixel` shows. The top left corner is (0, 0), a pixel's centre
/// is at +0.5. nullopt where the projection shows nothing (outside the dome's circle, beyond the mirror). Only lenses
/// distinguish channels.
std::optional<glm::dvec3> direction(const Picture& picture, glm::dvec2 pixel, Channel channel = Channel::green);

/// The pixel that shows a direction: the inverse. nullopt where no pixel of the projection shows it; the point may lie
/// outside the picture where the projection goes on beyond its edge.
std::optional<glm::dvec2> pixel(const Picture& picture, const glm::dvec3& direction, Channel channel = Channel::green);

/// M for projections whose direction is linear in the pixel: direction is along M (x, y, 1). nullopt for the others.
std::optional<glm::dmat3> planar_matrix(const Picture& picture);

/// The angle that one pixel covers around `pixel`, radians: the square root of its solid angle. 0 where nothing is shown.
double pixel_angle(const Picture& picture, glm::dvec2 pixel, Channel channel = Channel::green);

/// A picture prepared for many calls: the functions above, with everything that does not depend on the point computed once.
class PictureRays {
public:
    explicit PictureRays(const Picture& picture);
    std::optional<glm::dvec3> direction(glm::dvec2 pixel, Channel channel = Channel::green) const;
    std::optional<glm::dvec2> pixel(const glm::dvec3& direction, Channel channel = Channel::green) const;
    double pixel_angle(glm::dvec2 pixel, Channel channel = Channel::green) const;
    std::optional<glm::dmat3> planar_matrix() const;

private:
    /// A wall whose front the eye does not see.
    struct Nothing {
        std::optional<glm::dvec3> direction(glm::dvec2) const { return {}; }
        std::optional<glm::dvec2> pixel(const glm::dvec3&) const { return {}; }
        double pixel_angle(glm::dvec2) const { return 0; }
    };
    using Lenses = std::array<LensRays, 3>; ///< by channel
    using Rays = std::variant<Nothing, Plane, Keystone, FisheyeRays, CylinderRays, EquirectangularRays, CubeFaceRays,
        SphericalMirrorRays, Lenses>;
    static Rays prepare(const Picture& picture);
    Rays rays_;
};

/// True if the three channels of a pixel have directions of their own.
bool splits_colours(const Projection& projection);

} // namespace starbow
