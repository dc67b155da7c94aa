#include "spherical_mirror.h"
#include "config/model/angles.h"
#include "config/model/turn.h"
#include "planar.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// The intersection of a ray and a sphere: the distance to the chord's middle, and half the chord.
struct Chord {
    double middle, half;
};

std::optional<Chord> chord(const glm::dvec3& from, const glm::dvec3& way, const glm::dvec3& centre, double radius)
{
    const glm::dvec3 to_centre = centre - from;
    const double middle = glm::dot(to_centre, way);
    const glm::dvec3 beside = to_centre - middle * way; // the ray's distance, without cancellation
    const double left = radius * radius - glm::dot(beside, beside);
    if (!(left > 0))
        return {};
    return Chord{middle, std::sqrt(left)};
}

/// The angle at the mirror's centre from the lens, at distance p, to the point that reflects it to a place at distance q.
/// The place is at the angle `apart` from the lens, seen from the centre; all lengths are in mirror radii. Equal angles
/// to the normal mean
///     p sin a (q cos(apart - a) - 1) = q sin(apart - a) (p cos a - 1).
/// The difference of the sides changes its sign between the angles at which the two rays graze the mirror, so the root is
/// between them. The brackets are positive there, so it is the only one.
std::optional<double> alhazen(double p, double q, double apart)
{
    double low = std::max(0.0, apart - std::acos(1 / q)), high = std::min(apart, std::acos(1 / p));
    if (!(low <= high))
        return {}; // the place is in the mirror's shadow
    const auto difference
        = [&](double a) { return p * q * std::sin(2 * a - apart) - p * std::sin(a) + q * std::sin(apart - a); };
    const auto slope
        = [&](double a) { return 2 * p * q * std::cos(2 * a - apart) - p * std::cos(a) - q * std::cos(apart - a); };
    double a = (low + high) / 2;
    for (int i = 0; i < 100; ++i) {
        const double value = difference(a);
        if (value == 0)
            break;
        (value < 0 ? low : high) = a;
        const double next = a - value / slope(a);
        if (std::abs(next - a) <= 4e-16 * apart)
            break;
        a = next > low && next < high ? next : (low + high) / 2;
    }
    return a;
}

} // namespace

SphericalMirrorRays::SphericalMirrorRays(const SphericalMirror& mirror, glm::ivec2 size, const glm::dvec3& eye_m)
    : mirror_(mirror)
    , projector_(planar_plane(mirror.projector, size))
    , eye_m_(eye_m)
    , zenith_(dome_zenith(mirror.dome_tilt_deg))
    // Slack beyond the rim, so that light computed for a point on the rim still lands on it.
    , least_height_m_(mirror.dome_radius_m * (std::cos(glm::radians(mirror.dome_aperture_deg) / 2) - 1e-12))
{
}

/// The last point of the dome's inside that a ray meets, within the aperture.
std::optional<glm::dvec3> SphericalMirrorRays::dome_hit(const glm::dvec3& from, const glm::dvec3& way) const
{
    const auto through = chord(from, way, mirror_.dome_m, mirror_.dome_radius_m);
    if (!through || !(through->middle + through->half > 0))
        return {};
    const glm::dvec3 point = from + way * (through->middle + through->half);
    if (!(glm::dot(point - mirror_.dome_m, zenith_) >= least_height_m_))
        return {};
    return point;
}

std::optional<SphericalMirrorRays::Path> SphericalMirrorRays::trace(glm::dvec2 pixel) const
{
    Path path;
    path.out = glm::normalize(projector_.point(pixel));
    const auto through = chord(mirror_.projector_m, path.out, mirror_.mirror_m, mirror_.mirror_radius_m);
    if (!through || !(through->middle - through->half > 0))
        return {};
    path.depth = through->middle - through->half;
    path.mirror_point = mirror_.projector_m + path.out * path.depth;
    path.mirror_normal = glm::normalize(path.mirror_point - mirror_.mirror_m);
    path.reflected = glm::reflect(path.out, path.mirror_normal);
    const auto landed = dome_hit(path.mirror_point, path.reflected);
    if (!landed)
        return {};
    path.dome_point = *landed;
    path.flight = glm::distance(path.dome_point, path.mirror_point);
    return path;
}

std::optional<glm::dvec3> SphericalMirrorRays::direction(glm::dvec2 pixel) const
{
    const auto path = trace(pixel);
    if (!path || path->dome_point == eye_m_)
        return {};
    return glm::normalize(path->dome_point - eye_m_);
}

std::optional<glm::dvec2> SphericalMirrorRays::pixel(const glm::dvec3& direction) const
{
    const auto place = dome_hit(eye_m_, glm::normalize(direction));
    if (!place)
        return {};
    const double radius = mirror_.mirror_radius_m;
    const glm::dvec3 lens = (mirror_.projector_m - mirror_.mirror_m) / radius, spot = (*place - mirror_.mirror_m) / radius;
    const double p = glm::length(lens), q = glm::length(spot);
    if (!(p > 1 && q > 1))
        return {};
    // The plane's axes: towards the lens, and away from it on the lit place's side.
    const glm::dvec3 to_lens = lens / p;
    glm::dvec3 aside = spot - to_lens * glm::dot(spot, to_lens);
    const double across = glm::length(aside);
    aside = across > 0 ? aside / across : glm::dvec3(0);
    const auto angle = alhazen(p, q, std::atan2(across, glm::dot(spot, to_lens)));
    if (!angle)
        return {};
    const glm::dvec3 normal = to_lens * std::cos(*angle) + aside * std::sin(*angle);
    // From a mirror outside the dome's sphere, light may reach the place from outside.
    if (!(glm::dot(spot - normal, *place - mirror_.dome_m) > 0))
        return {};
    return projector_.pixel(normal - lens);
}

double SphericalMirrorRays::pixel_angle(glm::dvec2 pixel) const
{
    const auto path = trace(pixel);
    if (!path || path->dome_point == eye_m_)
        return 0;
    const glm::dvec3 &out = path->out, &normal = path->mirror_normal, &reflected = path->reflected;
    const glm::dvec3 dome_normal = (path->dome_point - mirror_.dome_m) / mirror_.dome_radius_m;
    const glm::dvec3 look = path->dome_point - eye_m_;
    const double far = glm::length(look), unit = glm::length(projector_.point(pixel));
    // The derivative of each point and direction along the path, for a step of one pixel in the projector's plane.
    const auto moved = [&](const glm::dvec3& step) {
        const glm::dvec3 d_out = (step - out * glm::dot(out, step)) / unit;
        glm::dvec3 d_point = path->depth * d_out;
        d_point -= out * (glm::dot(normal, d_point) / glm::dot(normal, out)); // stays on the mirror
        const glm::dvec3 d_normal = d_point / mirror_.mirror_radius_m;
        const glm::dvec3 d_reflected
            = d_out - 2. * (normal * (glm::dot(d_out, normal) + glm::dot(out, d_normal)) + d_normal * glm::dot(out, normal));
        glm::dvec3 d_place = d_point + path->flight * d_reflected;
        d_place -= reflected * (glm::dot(dome_normal, d_place) / glm::dot(dome_normal, reflected)); // stays on the dome
        return (d_place - look * (glm::dot(look, d_place) / (far * far))) / far;
    };
    const double solid_angle = glm::length(glm::cross(moved(projector_.right()), moved(projector_.down())));
    return std::sqrt(solid_angle < 2 * pi ? solid_angle : 2 * pi);
}

} // namespace starbow
