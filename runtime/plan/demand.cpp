#include "demand.h"
#include "config/model/angles.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// A circle on the sphere and its pixels' demand.
struct Disc {
    glm::dvec3 centre;
    double radius; // radians, up to pi
    double finest, coarsest; // one texel per pixel, radians
    double finest_pixel = 0, coarsest_pixel = 1e300; // the same in the ship; 0 and infinite where D does not give them
    double least_cos_half_square = 0; // of the outermost point's angle from straight ahead; 0 where that is unknown
    double times = 1; // D's ratio over its pixels
    double most_D = 1e300; // of its pixels; infinite where that is unknown
    double pixel = 0; // the finest in the ship, radians
    int rays = 1; // ViewRequest's
};

/// The range of tan(angle) of a disc along one axis of a face, clamped to the face. Returns false if the disc misses it.
/// sine: of the disc's radius; 1 or more for a disc that may be everywhere.
bool face_range(double along_axis, double along_normal, double sine, double& low, double& high)
{
    const double c_square = along_axis * along_axis + along_normal * along_normal - sine * sine;
    low = -1, high = 1;
    if (c_square <= 0)
        return true;
    // Both ends by rotation from the middle; each is inside or outside the face's quarter of the circle.
    const double c = std::sqrt(c_square);
    const double low_x = along_normal * c + along_axis * sine, low_y = along_axis * c - along_normal * sine;
    const double high_x = along_normal * c - along_axis * sine, high_y = along_axis * c + along_normal * sine;
    const bool low_within = std::abs(low_y) <= low_x, high_within = std::abs(high_y) <= high_x;
    if (low_within)
        low = low_y / low_x;
    if (high_within)
        high = high_y / high_x;
    return low_within || high_within || std::abs(along_axis) <= along_normal;
}

/// Calls each(tile, part of its face's plane) for the tiles that a circle may touch. No part is empty.
template <class Each> void each_tile(const glm::dvec3& centre, double radius, int finest_clip_level, Each&& each)
{
    const double sine = radius < 1.57 ? std::sin(radius) : 2;
    // A face reaches to acos(1 / sqrt(3)) from its middle.
    const double least_normal
        = sine < 1 ? std::sqrt(1 / 3.0) * std::sqrt(1 - sine * sine) - std::sqrt(2 / 3.0) * sine - 1e-9 : -2;
    for (int face = 0; face < 6; ++face) {
        const double normal = centre[face_axis[face]] * face_sign[face];
        if (normal < least_normal)
            continue;
        Rect wanted;
        if (!face_range(centre[face_a[face]], normal, sine, wanted.low.x, wanted.high.x)
            || !face_range(centre[face_b[face]], normal, sine, wanted.low.y, wanted.high.y))
            continue;
        auto part = [&](int tile) {
            const Rect part = intersection(tile_rect(tile), wanted);
            if (!part.empty())
                each(tile, part);
        };
        if (face == 0) {
            part(TILE_FRONT);
        } else if (face == 1) {
            // The nested squares from that of the circle's outermost point to that of its innermost.
            const glm::dvec2 far = glm::max(glm::abs(wanted.low), glm::abs(wanted.high));
            const glm::dvec2 near = glm::max(glm::max(wanted.low, -wanted.high), glm::dvec2(0));
            const int outer = clip_level(std::max(far.x, far.y), finest_clip_level),
                      inner = clip_level(std::max(near.x, near.y), finest_clip_level);
            for (int level = outer; level <= inner; ++level)
                part(TILE_REAR + level);
        } else {
            for (int band = 0; band < SIDE_BANDS; ++band)
                part(TILE_SIDES + (face - 2) * SIDE_BANDS + band);
        }
    }
}

/// The extent of a rest frame's surfaces: in each tile, and altogether.
struct FrameExtent {
    std::array<Rect, TILE_COUNT> rects;
    glm::dvec3 axis{0, 0, 1};
    double radius = pi; ///< radius of the circle around `axis` that encloses them; below 0 without surfaces

    /// The whole sphere.
    FrameExtent()
    {
        for (int tile = 0; tile < TILE_COUNT; ++tile)
            rects[std::size_t(tile)] = tile_rect(tile);
    }
    FrameExtent(const std::vector<BoundingSphere>& bounds, int finest_clip_level)
    {
        const BoundingCap cap = bounding_cap(bounds);
        axis = cap.axis, radius = cap.radius_rad;
        for (const BoundingSphere& thing : bounds) {
            const double distance = glm::length(thing.centre);
            const bool inside = !(distance > thing.radius * 1.0001);
            each_tile(inside ? axis : thing.centre / distance, inside ? pi : std::asin(thing.radius / distance),
                finest_clip_level, [&](int tile, const Rect& part) { rects[std::size_t(tile)].add(part); });
        }
    }

    bool touches(const glm::dvec3& centre, double r) const
    {
        return radius >= pi || (radius >= 0 && angle_between(axis, centre) <= radius + r);
    }
};

void add_disc(Demands& demands, const FrameExtent& held, const Disc& disc, double E, int finest_clip_level)
{
    if (!held.touches(disc.centre, disc.radius))
        return;
    each_tile(disc.centre, disc.radius, finest_clip_level, [&](int tile, const Rect& wanted) {
        const Rect part = intersection(held.rects[std::size_t(tile)], wanted);
        if (part.empty())
            return;
        Demands::Tile& own = demands.tiles[std::size_t(tile)];
        if (!own.any) {
            own.any = true;
            own.sub_tiles.fill({});
        }
        const bool hole = clip_hole(tile, finest_clip_level) > 0;
        const SubTileTable& all = sub_tile_table(tile);
        const SubTiles sub_tiles = sub_tiles_in(tile, part);
        for (int j = 0; j < sub_tiles.count.y; ++j)
            for (int i = 0; i < sub_tiles.count.x; ++i) {
                const glm::ivec2 at_cell = sub_tiles.first + glm::ivec2(i, j);
                const std::size_t sub_tile = std::size_t(at_cell.y * TILE_SUB_TILES + at_cell.x);
                const Rect here = intersection(part, all.rects[sub_tile]);
                // A disc over most of the sky excludes the directions behind.
                if (here.empty() || (hole && all.in_clip_hole[sub_tile])
                    || all.most_cos_half_square[sub_tile] < disc.least_cos_half_square)
                    continue;
                // The solid angle of a texel at (a, b) is its area over (1 + a^2 + b^2)^(3/2).
                const glm::dvec2 at = 0.5 * (here.low + here.high);
                const double square = 1 + glm::dot(at, at), per_angle = std::sqrt(square * std::sqrt(square));
                // Directions in this sub-tile have the sub-tile's D; the disc's own bounds may belong to other
                // directions.
                const double least = all.least_cos_half_square[sub_tile], most = all.most_cos_half_square[sub_tile];
                const double above = disc.finest_pixel * (E * least + (1 - least) / E);
                const double below = disc.coarsest_pixel * (E * most + (1 - most) / E);
                own.sub_tiles[sub_tile].add({here, std::clamp(disc.finest, above, below) * per_angle,
                    std::clamp(disc.coarsest, above, below) * per_angle / disc.rays});
            }
    });
}

/// Walks a view's cone hierarchy, finer where the boost spreads a cone over much of the sky.
struct Walk {
    const ViewRequest& view;
    const RestFrameRequest& request;
    double E;
    bool galilean;
    int finest_clip_level;
    const FrameExtent& held;
    Demands& demands;
    double spread; ///< greatest distance of a pixel's rays from its centre, pixels
    int coarsest_level; ///< the coarsest level that follows the view's outline
    double& dark_pixels;

    void block(int level, glm::ivec2 at) const
    {
        const bool last = level + 1 == view.cones->levels();
        if (view.cones->flat() && level < coarsest_level)
            return split(level, at);
        const BoundingCone cap = view.cones->cone(level, at);
        if (cap.empty())
            return;
        if (!last && (level < coarsest_level || cap.radius > 0.3))
            return split(level, at);

        const glm::dvec3 centre = view.motion_from_cockpit * glm::dvec3(cap.centre);
        const Disc disc = in_the_world(centre, cap);
        // Few blocks are that large, so they may be divided further.
        const double most_varied = level <= coarsest_level ? 1.22 : 1.5;
        if (!last && (disc.radius > 0.25 || (!galilean && disc.coarsest > most_varied * disc.finest)))
            return split(level, at);
        if (view.dark_D > 0 && !view.beside)
            dark_pixels += dark_part(disc) * pixels(level, at);
        if (disc.times > most_uneven && cap.radius < 1)
            cut(centre, cap);
        else
            ask_for(disc);
    }
    static constexpr double most_uneven = 1.5;

    double pixels(int level, glm::ivec2 at) const
    {
        const int side = view.cones->side(level);
        const glm::ivec2 shown = glm::min((at + 1) * side, view.cones->size()) - at * side;
        return double(shown.x) * shown.y;
    }
    /// The part of a disc that is dark, as if the logarithm of D were spread evenly.
    double dark_part(const Disc& disc) const
    {
        if (disc.times <= 1 || disc.most_D < view.dark_D)
            return disc.most_D < view.dark_D ? 1 : 0;
        return std::clamp(1 - std::log(disc.most_D / view.dark_D) / std::log(disc.times), 0.0, 1.0);
    }

    /// A boost maps circles to circles, so the world's disc follows exactly from the two ends on its meridian.
    Disc in_the_world(const glm::dvec3& centre, const BoundingCone& cap) const
    {
        const double radius = cap.radius + spread * cap.coarsest;
        const double across = glm::length(glm::dvec2(centre)); // of a unit vector, so that no square overflows
        Disc disc;
        glm::dvec2 middle_in_world; // cosine and sine of its angle from the motion
        if (galilean) {
            const double beta = (E - 1 / E) / (E + 1 / E), theta = std::atan2(across, centre.z);
            auto world = [&](double camera) { return camera + std::asin(beta * std::sin(camera)); };
            const double low = world(theta - radius), high = world(std::min(theta + radius, theta + pi));
            // The stretch along the meridian and across it differ; these bounds hold the disc and its pixels.
            const glm::dvec2 stretch = physics::galilean_stretch(glm::dvec3(across, 0, centre.z), E, 1 / E);
            disc.radius = std::min(pi, std::max(0.5 * (high - low), 1.2 * radius * std::max(stretch.x, stretch.y)));
            middle_in_world = {std::cos(0.5 * (low + high)), std::sin(0.5 * (low + high))};
            disc.finest = std::min(stretch.x, stretch.y) * cap.finest;
            disc.coarsest = std::max(stretch.x, stretch.y) * cap.coarsest;
        } else {
            // Tangents of half the angles: from the motion, of the disc, and of its pixels' centres.
            const double middle = centre.z > 0 ? across / (1 + centre.z) : (1 - centre.z) / std::max(across, 1e-100);
            const double reach = std::tan(0.5 * radius), own_reach = std::tan(0.5 * double(cap.radius));
            auto turned = [&](double by) { return (middle + by) / std::max(1 - middle * by, 1e-100); };
            auto doppler = [&](double tangent) { return E * (1 + tangent * tangent) / (1 + E * E * tangent * tangent); };
            // Half of the two ends' angles in the world, as points of the circle, continued beyond the axis behind. Their
            // sum is the middle's angle and their difference the radius, so only the last angle is computed.
            const double low_tangent = E * turned(-reach), past = 1 - middle * reach, beyond = E * (middle + reach);
            const double low_length = std::sqrt(1 + low_tangent * low_tangent), high_square = past * past + beyond * beyond;
            const double lengths = 1 / (low_length * std::sqrt(high_square));
            middle_in_world = lengths * glm::dvec2(past - low_tangent * beyond, beyond + low_tangent * past);
            disc.radius = radius < pi ? std::atan2(beyond - low_tangent * past, past + low_tangent * beyond) : pi;
            const double near = doppler(std::max(turned(-own_reach), 0.0)),
                         far = doppler(std::min(turned(own_reach), 1e100));
            disc.times = near / far;
            disc.most_D = near;
            disc.pixel = cap.finest;
            disc.finest = far * cap.finest;
            disc.coarsest = near * cap.coarsest;
            if (view.parallax_rad == 0 && request.aligned()) {
                disc.finest_pixel = cap.finest, disc.coarsest_pixel = cap.coarsest;
                if (past > 0)
                    disc.least_cos_half_square = past * past / high_square;
            }
        }
        const glm::dvec2 meridian = across > 0 ? glm::dvec2(centre) / across : glm::dvec2(1, 0);
        disc.centre = request.cube_from_motion * glm::dvec3(meridian * middle_in_world.y, middle_in_world.x);
        return disc;
    }

    void ask_for(Disc disc) const
    {
        if (disc.most_D < view.dark_D) {
            disc.finest = std::max(disc.finest, view.dark_D * disc.pixel) / dark_density;
            disc.coarsest = std::max(disc.coarsest, disc.finest);
            disc.finest_pixel = 0, disc.coarsest_pixel = 1e300;
        }
        disc.rays = view.rays;
        disc.radius = std::min(pi, disc.radius + view.parallax_rad);
        add_disc(demands, held, disc, E, finest_clip_level);
    }

    /// Divides the disc of a smallest block like the square around it, repeatedly where D varies over the parts. It ends
    /// at a single pixel's size, or where D is constant around straight ahead.
    void cut(const glm::dvec3& centre, const BoundingCone& cap) const
    {
        const glm::dvec3 aside = std::abs(centre.z) > 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
        const glm::dvec3 right = glm::normalize(glm::cross(aside, centre)), up = glm::cross(centre, right);
        cut(centre, right, up, std::tan(double(cap.radius)), cap);
    }
    void cut(
        const glm::dvec3& centre, const glm::dvec3& right, const glm::dvec3& up, double half, const BoundingCone& cap) const
    {
        BoundingCone part = cap;
        part.radius = float(std::sqrt(0.5) * half);
        const double smallest = std::max(0.03 * cap.coarsest, 0.3 / E);
        for (int i = -1; i <= 1; i += 2)
            for (int j = -1; j <= 1; j += 2) {
                const glm::dvec3 there = centre + 0.5 * half * (double(i) * right + double(j) * up);
                const Disc disc = in_the_world(glm::normalize(there), part);
                if (disc.times > most_uneven && part.radius >= smallest)
                    cut(there, right, up, 0.5 * half, cap);
                else
                    ask_for(disc);
            }
    }

    void split(int level, glm::ivec2 at) const
    {
        const glm::ivec2 finer = view.cones->count(level + 1);
        for (int j = 2 * at.y; j < std::min(2 * at.y + 2, finer.y); ++j)
            for (int i = 2 * at.x; i < std::min(2 * at.x + 2, finer.x); ++i)
                block(level + 1, {i, j});
    }
};

} // namespace

double add_demands(Demands& demands, const RestFrameRequest& request, int finest_clip_level, int pixel_rays)
{
    double dark_pixels = 0;
    const FrameExtent held = request.bounds ? FrameExtent(*request.bounds, finest_clip_level) : FrameExtent();
    if (held.radius < 0)
        return dark_pixels;
    for (const ViewRequest& view : request.views) {
        const ConeHierarchy& cones = *view.cones;
        const double spread = ray_spread(pixel_rays * view.rays);
        // At least 20 blocks across: coarser blocks draw too much in vain.
        const double wanted = std::max(cones.size().x, cones.size().y) / 20.0;
        int level = 0;
        while (level + 1 < cones.levels() && cones.side(level) > wanted)
            ++level;
        Walk{view, request, request.E, request.galilean, finest_clip_level, held, demands, spread, level, dark_pixels}.block(
            0, {0, 0});
    }
    return dark_pixels;
}

} // namespace starbow
