#include "lit_pixels.h"
#include "scratch.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// A division of a square costs a draw or some pixels; the side is a compromise, and a power of two as the hierarchy's.
constexpr int side = 16;

/// An angle beyond the sphere: D is great enough everywhere.
constexpr double everywhere = 4;

/// The angle from straight ahead at which D has a value: outside that circle all light comes with less. Below 0 where D is
/// nowhere as great. E: e^rapidity of the ship, at least 1. From D = E (1 + t^2) / (1 + E^2 t^2), where t is the tangent of
/// half the angle.
double angle_of(double D, double E)
{
    if (D * E <= 1)
        return everywhere;
    return D > E ? -1 : 2 * std::atan(std::sqrt((E - D) / (E * (D * E - 1))));
}

} // namespace

/// Classes the blocks of a cone hierarchy, the large ones first.
struct LitPixels::Walk {
    const ConeHierarchy& cones;
    const glm::dmat3& motion_from_cockpit;
    double lit_angle; ///< of the circle around straight ahead outside which all is dark; below 0: all is
    double spread;
    std::span<const ShipCap> bodies;
    glm::ivec2 count; ///< of squares
    std::vector<Square>& squares;

    void block(int level, glm::ivec2 at) const
    {
        const BoundingCone cone = cones.cone(level, at);
        if (cone.empty())
            return;
        const glm::dvec3 centre = glm::normalize(glm::dvec3(cone.centre));
        const double reach = cone.radius + spread * cone.coarsest + 1e-6;
        const double away = lit_angle < everywhere ? angle_between(motion_from_cockpit * centre, {0, 0, 1}) : 0;
        const bool dark = away - reach > lit_angle, lit = away + reach <= lit_angle;
        const bool meets_bodies = !dark && std::any_of(bodies.begin(), bodies.end(), [&](const ShipCap& body) {
            // The filter reaches some pixels beyond the surfaces, as the shader's own test has it.
            const double least = body.least_cos - 4 * cone.coarsest - 2e-6;
            return least <= -1 || angle_between(centre, body.axis) - reach <= std::acos(std::min(least, 1.0));
        });
        // A map's block may have squares that show nothing.
        if (cones.side(level) > side && ((!dark && !lit) || meets_bodies || !cones.flat())) {
            const glm::ivec2 finer = cones.count(level + 1);
            for (int y = 2 * at.y; y < std::min(2 * at.y + 2, finer.y); ++y)
                for (int x = 2 * at.x; x < std::min(2 * at.x + 2, finer.x); ++x)
                    block(level + 1, {x, y});
            return;
        }
        const Square kind = dark ? Square::dark : meets_bodies ? Square::with_bodies : Square::lit;
        const glm::ivec2 first = at * cones.side(level) / side,
                         end = glm::min(first + std::max(cones.side(level) / side, 1), count);
        for (int y = first.y; y < end.y; ++y)
            for (int x = first.x; x < end.x; ++x) {
                Square& square = squares[std::size_t(y * count.x + x)];
                square = std::max(square, kind);
            }
    }
};

void LitPixels::find(const ConeHierarchy& cones, const glm::dmat3& motion_from_cockpit, double E, double dark_D,
    double spread, std::span<const ShipCap> bodies)
{
    lit.clear(), dark.clear(), with_bodies.clear();
    const glm::ivec2 size = cones.size(), count = (size + side - 1) / side;
    squares_.assign(std::size_t(count.x) * count.y, Square::empty);
    Walk{cones, motion_from_cockpit, angle_of(dark_D, E), spread, bodies, count, squares_}.block(0, {0, 0});

    for (int y = 0; y < count.y; ++y)
        for (int x = 0; x < count.x;) {
            const Square kind = squares_[std::size_t(y * count.x + x)];
            int end = x + 1;
            while (end < count.x && squares_[std::size_t(y * count.x + end)] == kind)
                ++end;
            if (kind != Square::empty) {
                std::vector<PixelRect>& list = kind == Square::lit ? lit : kind == Square::dark ? dark : with_bodies;
                const PixelRect run{glm::ivec2(x, y) * side, glm::min(glm::ivec2(end, y + 1) * side, size)};
                // A run as wide as one above grows that one.
                const auto above = std::find_if(list.rbegin(), list.rend(), [&](const PixelRect& one) {
                    return one.high.y == run.low.y && one.low.x == run.low.x && one.high.x == run.high.x;
                });
                if (above != list.rend())
                    above->high.y = run.high.y;
                else
                    list.push_back(run);
            }
            x = end;
        }
    reserve_headroom(lit), reserve_headroom(dark), reserve_headroom(with_bodies);
}

} // namespace starbow
