#include "cull.h"
#include "painters_order.h"
#include "runtime/world/blended.h"
#include "runtime/world/instances.h"
#include "runtime/world/moving.h"
#include "runtime/world/shape.h"
#include "scratch.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

namespace starbow {
namespace {

/// An instance's bounding box.
using Box = DrawList::OrientedBox;

/// A box's extent along a unit vector from its centre.
double reach(const Box& box, const glm::dvec3& n)
{
    return std::abs(glm::dot(n, box.half[0])) + std::abs(glm::dot(n, box.half[1])) + std::abs(glm::dot(n, box.half[2]));
}

double reach(const BoundingSphere& sphere, const glm::dvec3&) { return sphere.radius; }

/// Half of a box's diagonal.
double half_diagonal(const Box& box)
{
    return std::sqrt(
        glm::dot(box.half[0], box.half[0]) + glm::dot(box.half[1], box.half[1]) + glm::dot(box.half[2], box.half[2]));
}

/// The planes through the eye and the sides of a rectangle on a face; unit normals inwards.
std::array<glm::dvec3, 4> side_planes(int face, const glm::dvec2& low, const glm::dvec2& high)
{
    const glm::dvec3 normal = face_direction(face, {0, 0});
    const glm::dvec3 a = face_direction(face, {1, 0}) - normal, b = face_direction(face, {0, 1}) - normal;
    return {glm::normalize(a - low.x * normal), glm::normalize(high.x * normal - a), glm::normalize(b - low.y * normal),
        glm::normalize(high.y * normal - b)};
}

/// An image's four sides and its face's plane: a shape is out if it is wholly behind one of them.
struct Frustum {
    glm::dvec3 normal;
    std::array<glm::dvec3, 4> sides;

    explicit Frustum(const PlannedImage& image)
        : normal(face_direction(image.face, {0, 0}))
        , sides(side_planes(image.face, image.low, image.high))
    {
    }
    template <class Shape> bool sees(const Shape& shape) const
    {
        const auto behind = [&](const glm::dvec3& plane) { return glm::dot(plane, shape.centre) < -reach(shape, plane); };
        return !behind(normal) && std::none_of(sides.begin(), sides.end(), behind);
    }
};

/// An image's clip-map hole, which the next finer image behind fills: no pixel reads it there.
struct ClipHole {
    bool any;
    std::array<glm::dvec3, 4> sides;

    explicit ClipHole(const PlannedImage& image)
        : any(image.clip_hole > 0)
        , sides(side_planes(image.face, glm::dvec2(-image.clip_hole), glm::dvec2(image.clip_hole)))
    {
    }
    /// True for a shape that lies wholly in it.
    template <class Shape> bool holds(const Shape& shape) const
    {
        return any && std::all_of(sides.begin(), sides.end(), [&](const glm::dvec3& plane) {
            return glm::dot(plane, shape.centre) >= reach(shape, plane);
        });
    }
};

/// True if a surface with some errors is fine enough in a box. surface: a DetailLevel or a PieceGroup.
template <class Surface> bool fits(const Surface& surface, const Box& box, const PlannedImage& image, const Quality& quality)
{
    const auto within
        = [&](double error, double most) { return error * box.scale * image.texels_per_unit <= most * box.distance; };
    return within(surface.error, quality.lod_error_texels) && within(surface.shading, quality.lod_shading_texels);
}

/// The level of detail for an instance: -1 is the full surface.
int level_of(const Primitive& primitive, const Box& box, const PlannedImage& image, const Quality& quality)
{
    int level = -1;
    while (level + 1 < int(primitive.coarser.size()) && fits(primitive.coarser[std::size_t(level + 1)], box, image, quality))
        ++level;
    return level;
}

/// thing: a primitive, a piece of one, or a group of pieces.
template <class Thing> Box box_of(const Thing& thing, const glm::dmat3& turn, const glm::dvec3& place)
{
    const glm::dvec3 half = 0.5 * (thing.high - thing.low), middle = 0.5 * (thing.high + thing.low);
    Box box{turn * middle + place, {turn[0] * half.x, turn[1] * half.y, turn[2] * half.z}, 0, 0, 0, true};
    const glm::dvec3 lengths(glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2]));
    const double longest = std::max({lengths.x, lengths.y, lengths.z});
    const double skew
        = std::abs(glm::dot(turn[0], turn[1])) + std::abs(glm::dot(turn[1], turn[2])) + std::abs(glm::dot(turn[2], turn[0]));
    if (skew < 1e-9 * longest * longest) {
        // The distance from the eye to the box, in the instance's own coordinates.
        const glm::dvec3 eye_local = -(place * turn) / (lengths * lengths);
        box.scale = longest;
        box.distance = std::min({lengths.x, lengths.y, lengths.z})
            * glm::distance(eye_local, glm::clamp(eye_local, thing.low, thing.high));
    } else {
        // A sheared node may stretch more than each of its axes; the root of the sum of squares is an upper bound.
        box.scale = glm::length(lengths);
        box.distance = std::max(0.0, glm::length(box.centre) - box.scale * glm::length(half));
    }
    return box;
}

/// True if light that arrives at the eye event may have left while the instance existed.
bool may_show(const World& world, const Instance& instance, const EyeEvent& eye_event, const Box& box)
{
    if (!finite_existence(world, instance))
        return true;
    const ExistenceInterval& existence = world.existence_intervals[std::size_t(instance.existence)];
    const double sent = retarded_time(eye_event, box.centre);
    const double around = glm::length(box.half[0]) + glm::length(box.half[1]) + glm::length(box.half[2]);
    return sent + around >= existence.begin && sent - around <= existence.end;
}

struct Standing {
    glm::dmat3 turn; ///< the cube map's axes from local
    glm::dvec3 place; ///< place of the local origin relative to the eye
};
Standing standing(const glm::dmat4& frame_from_local, const EyeEvent& eye_event)
{
    const glm::dmat4& m = frame_from_local;
    return {eye_event.cube_from_frame * glm::dmat3(m), eye_event.cube_from_frame * (glm::dvec3(m[3]) - eye_event.place)};
}

shared::InstanceEntry entry_of(const Standing& at)
{
    const glm::dmat3 rows = glm::transpose(at.turn);
    return {glm::vec4(rows[0], at.place.x), glm::vec4(rows[1], at.place.y), glm::vec4(rows[2], at.place.z)};
}

/// An instance's transform relative to an eye, and a box around all its visible places.
struct Placed {
    Standing at;
    Box box;
};
Placed placed(const World& world, const Instance& instance, const EyeEvent& eye_event)
{
    const Primitive& primitive = world.primitives[instance.primitive];
    if (instance.motion < 0) {
        const Standing at = standing(instance.frame_from_local, eye_event);
        return {at, box_of(primitive, at.turn, at.place)};
    }
    const SeenPose seen = seen_pose(world, instance, eye_event);
    Placed out{standing(seen.frame_from_local, eye_event), {}};
    out.box = box_of(primitive, out.at.turn, out.at.place);
    out.box.centre = out.at.turn * middle_of(world, instance) + out.at.place;
    for (int i = 0; i < 3; ++i)
        out.box.half[i] = glm::dvec3(0), out.box.half[i][i] = seen.window;
    out.box.distance = std::max(0.0, glm::length(out.box.centre) - seen.window);
    return out;
}

/// The box as the picture shows it.
Box as_shown(Box box, const EyeEvent& eye_event)
{
    box.centre.z *= eye_event.contraction;
    for (glm::dvec3& half : box.half)
        half.z *= eye_event.contraction;
    box.distance *= eye_event.contraction;
    box.farthest = glm::length(box.centre) + half_diagonal(box);
    return box;
}

} // namespace

std::vector<BoundingSphere> bounding_spheres(const World& world, const EyeEvent& eye_event)
{
    std::vector<BoundingSphere> bounding_spheres;
    const InstanceRange range = instances_of(world, eye_event.frame);
    for (std::size_t i = range.first; i < range.last; ++i) {
        const Instance& instance = world.instances[i];
        const Box rests = placed(world, instance, eye_event).box, box = as_shown(rests, eye_event);
        if (may_show(world, instance, eye_event, rests))
            bounding_spheres.push_back({box.centre, half_diagonal(box)});
    }
    return bounding_spheres;
}

namespace {

/// A cone of less than half a sphere is convex: if it holds a box's corners, it holds the box.
BoundingCap cap_of(const Box& box)
{
    glm::dvec3 corners[8], sum(0);
    for (int i = 0; i < 8; ++i) {
        corners[i] = box.centre + (i & 1 ? 1.0 : -1.0) * box.half[0] + (i & 2 ? 1.0 : -1.0) * box.half[1]
            + (i & 4 ? 1.0 : -1.0) * box.half[2];
        const double length = glm::length(corners[i]);
        if (!(length > 0))
            return {};
        sum += corners[i] /= length;
    }
    if (!(box.distance > 0) || !(glm::length(sum) > 0))
        return {}; // the eye may be inside
    BoundingCap cap{glm::normalize(sum), 0};
    for (const glm::dvec3& corner : corners)
        cap.radius_rad = std::max(cap.radius_rad, angle_between(cap.axis, corner));
    constexpr double most = 1.5;
    return cap.radius_rad < most ? cap : BoundingCap{};
}

} // namespace

void find_caps(const DrawList& list, std::size_t rest_frame, std::vector<BoundingCap>& caps)
{
    caps.clear();
    const std::size_t first = list.first[rest_frame],
                      last = rest_frame + 1 < list.first.size() ? list.first[rest_frame + 1] : list.boxes.size();
    for (std::size_t i = first; i < last; ++i)
        if (list.boxes[i].shows)
            caps.push_back(cap_of(list.boxes[i]));
    reserve_headroom(caps);
}

namespace {

/// Adds a pose of a deforming instance: its bones, and its targets' weights.
void add_shape(const World& world, const Instance& instance, const EyeEvent& eye_event, double time, DrawList& list)
{
    const Deformation& deformation = world.deformations[std::size_t(instance.deformation)];
    Shape shape(world, instance, time);
    for (std::size_t bone = 0; bone < deformation.bones.size(); ++bone)
        list.instances.push_back(entry_of(standing(shape.bone(bone), eye_event)));
    for (int target = 0; target < deformation.targets; ++target) {
        if (target % WEIGHTS_PER_ENTRY == 0)
            list.instances.emplace_back();
        glm::vec4* const rows[] = {&list.instances.back().row0, &list.instances.back().row1, &list.instances.back().row2};
        (*rows[target % WEIGHTS_PER_ENTRY / 4])[target % 4] = float(shape.weight(target));
    }
}

/// Adds the poses of animated instances around their retarded times.
void add_poses(const World& world, std::span<const EyeEvent> eye_events, DrawList& list)
{
    for (const EyeEvent& eye_event : eye_events) {
        list.first_pose.push_back(std::uint32_t(list.instances.size()));
        std::set<int> known; // motions of deforming meshes
        const InstanceRange range = instances_of(world, eye_event.frame);
        for (std::size_t i = range.first; i < range.last && !world.motions.empty(); ++i) {
            const Instance& instance = world.instances[i];
            if (instance.motion < 0)
                continue;
            if (instance.deformation >= 0 && !known.insert(instance.motion).second)
                continue; // of the same mesh
            for (double time : pose_times(world, instance, seen_pose(world, instance, eye_event))) {
                if (instance.deformation < 0)
                    list.instances.push_back(entry_of(standing(pose_at(world, instance, time), eye_event)));
                else
                    add_shape(world, instance, eye_event, time, list);
            }
        }
    }
}

/// A view of the clusters of one instance that stands still.
struct ClusterView {
    glm::dmat3 turn; ///< the cube map's axes, as shown, from local
    glm::dvec3 place;
    double scale;
    glm::dvec3 eye; ///< local; any such map keeps the eye on its side of each triangle
    bool one_sided;

    ClusterView(const Instance& instance, const EyeEvent& eye_event, double box_scale, bool shows_one_side)
        : scale(box_scale * std::max(1.0, eye_event.contraction))
    {
        const Standing at = standing(instance.frame_from_local, eye_event);
        eye = -(glm::inverse(at.turn) * at.place);
        // The primitive of a mirroring map is turned.
        one_sided = shows_one_side && glm::determinant(at.turn) > 0;
        turn = at.turn, place = at.place;
        for (int i = 0; i < 3; ++i)
            turn[i].z *= eye_event.contraction;
        place.z *= eye_event.contraction;
    }
    bool sees(const Cluster& cluster, const Frustum& frustum, const ClipHole& hole) const
    {
        const glm::dvec3 from_eye = glm::dvec3(cluster.centre) - eye;
        // Slightly more than the float's own bounds.
        const double radius = 1.0001 * cluster.radius;
        if (one_sided
            && glm::dot(from_eye, glm::dvec3(cluster.axis)) >= (cluster.cutoff + 1e-4) * glm::length(from_eye) + radius)
            return false;
        const BoundingSphere sphere{turn * glm::dvec3(cluster.centre) + place, scale * radius};
        return frustum.sees(sphere) && !hole.holds(sphere);
    }
};

/// Adds a draw for each run of neighbouring clusters in view. draw: of the whole surface.
void add_cluster_draws(const World& world, const ClusterRange& clusters, const ClusterView& view, const Frustum& frustum,
    const ClipHole& hole, Draw draw, std::vector<Draw>& draws)
{
    bool runs = false;
    for (std::uint32_t i = clusters.first; i < clusters.first + clusters.count; ++i) {
        const Cluster& cluster = world.clusters[i];
        const bool sees = view.sees(cluster, frustum, hole);
        if (sees && runs) {
            draws.back().index_count += cluster.index_count;
        } else if (sees) {
            draw.first_index = cluster.first_index, draw.index_count = cluster.index_count;
            draws.push_back(draw);
        }
        runs = sees;
    }
}

/// Adds the draws of an instance of a divided surface: of its pieces in view that are as coarse as they may be. whole: the
/// instance's box as shown. moves: it is animated; its pieces then have no boxes of their own. draw: of the whole surface,
/// of this one instance.
void add_piece_draws(const World& world, const Primitive& primitive, const Instance& instance, const EyeEvent& eye_event,
    const PlannedImage& image, const Quality& quality, const Box& whole, bool moves, Draw draw, std::vector<Draw>& draws)
{
    const Frustum frustum(image);
    const ClipHole hole(image);
    const Standing at = standing(instance.frame_from_local, eye_event);
    const ClusterView view(instance, eye_event, whole.scale, !world.materials[std::size_t(primitive.material)].double_sided);
    const auto box
        = [&](const auto& thing) { return moves ? whole : as_shown(box_of(thing, at.turn, at.place), eye_event); };
    for (std::uint32_t i = 0; i < primitive.pieces.count; ++i) {
        const DetailPiece& piece = world.pieces[primitive.pieces.first + i];
        if (!fits(piece.own, box(piece.own), image, quality) || fits(piece.coarser, box(piece.coarser), image, quality))
            continue;
        const Box own = box(piece);
        if (!moves && (!frustum.sees(own) || hole.holds(own)))
            continue;
        const DetailLevel& level = piece.triangles;
        draw.first_index = level.first_index, draw.index_count = level.index_count, draw.farthest = own.farthest;
        draw.apart = piece.own.apart * own.scale;
        if (moves || level.clusters.count == 0)
            draws.push_back(draw);
        else
            add_cluster_draws(world, level.clusters, view, frustum, hole, draw, draws);
    }
}

} // namespace

DrawList cull(const World& world, std::span<const EyeEvent> eye_events, const std::vector<PlannedImage>& images,
    const Quality& quality, DrawList before)
{
    DrawList list = std::move(before);
    list.sorted_indices.clear(), list.sorted_surfaces.clear();
    list.instances.clear(), list.first_pose.clear(), list.first.clear(), list.visible.clear(), list.draws.clear();
    list.boxes.clear();
    for (const EyeEvent& eye_event : eye_events) {
        list.first.push_back(std::uint32_t(list.instances.size()));
        const InstanceRange range = instances_of(world, eye_event.frame);
        list.instances.reserve(list.instances.size() + range.last - range.first);
        for (std::size_t i = range.first; i < range.last; ++i) {
            const Instance& instance = world.instances[i];
            const Placed own = placed(world, instance, eye_event);
            list.instances.push_back(entry_of(own.at));
            list.boxes.push_back(as_shown(own.box, eye_event));
            list.boxes.back().shows = may_show(world, instance, eye_event, own.box);
        }
    }
    if (!world.blended_triangles.empty())
        list.sorted_surfaces.resize(list.instances.size());
    add_poses(world, eye_events, list);
    const std::vector<Box>& boxes = list.boxes;
    std::vector<std::vector<std::uint32_t>>& by_level = list.by_level;
    for (std::uint32_t i = 0; i < images.size(); ++i) {
        const PlannedImage& image = images[i];
        if (!image.needed)
            continue;
        const std::size_t first_draw = list.draws.size();
        const Frustum frustum(image);
        const ClipHole hole(image);
        const std::uint32_t first = list.first[std::size_t(image.rest_frame)];
        const InstanceRange range = instances_of(world, eye_events[std::size_t(image.rest_frame)].frame);
        for (std::size_t at = range.first; at < range.last;) {
            const std::uint32_t index = world.instances[at].primitive;
            const auto kind = kind_of(world, world.instances[at]);
            const Primitive& primitive = world.primitives[index];
            by_level.resize(std::max(by_level.size(), primitive.coarser.size() + 1));
            for (; at < range.last && world.instances[at].primitive == index && kind_of(world, world.instances[at]) == kind;
                 ++at) {
                const std::uint32_t own = first + std::uint32_t(at - range.first);
                if (boxes[own].shows && frustum.sees(boxes[own]) && !hole.holds(boxes[own]))
                    by_level[std::size_t(level_of(primitive, boxes[own], image, quality) + 1)].push_back(own);
            }
            for (std::size_t level = 0; level < by_level.size(); ++level) {
                std::vector<std::uint32_t>& seen = by_level[level];
                if (seen.empty())
                    continue;
                // Nearest first, so that hidden instances fail the depth test before they are shaded.
                std::sort(seen.begin(), seen.end(), [&](auto a, auto b) { return boxes[a].distance < boxes[b].distance; });
                const DetailLevel detail = level == 0
                    ? DetailLevel{primitive.first_index, primitive.index_count, 0, 0, 0, primitive.clusters}
                    : primitive.coarser[level - 1];
                Draw draw{i, index, std::uint32_t(list.visible.size()), std::uint32_t(seen.size()), detail.first_index,
                    detail.index_count, kind.first, kind.second, primitive.deforming >= 0};
                list.visible.insert(list.visible.end(), seen.begin(), seen.end());
                draw.farthest = boxes[seen.front()].farthest;
                for (std::uint32_t own : seen)
                    draw.apart = std::max(draw.apart, detail.apart * boxes[own].scale);
                const Material& material = world.materials[std::size_t(primitive.material)];
                if (material.blended) {
                    const std::span<const BlendedTriangle> triangles = blended_triangles(world, primitive, level);
                    const std::uint32_t corners = corners_of(primitive.topology);
                    Draw own = draw;
                    own.blended = true, own.count = 1, own.index_count = corners * std::uint32_t(triangles.size());
                    for (std::size_t k = 0; k < seen.size(); ++k, ++own.first) {
                        own.farthest = boxes[seen[k]].farthest;
                        own.first_index = sorted_from_behind(list, seen[k], level, triangles, corners);
                        list.draws.push_back(own);
                    }
                }
                if (material.blended && material.alpha_cutoff <= 0) {
                    // nothing of it is opaque
                } else if (primitive.pieces.count > 0) {
                    draw.count = 1;
                    for (std::uint32_t own : seen) {
                        add_piece_draws(world, primitive, world.instances[range.first + (own - first)],
                            eye_events[std::size_t(image.rest_frame)], image, quality, boxes[own], kind.second, draw,
                            list.draws);
                        ++draw.first;
                    }
                } else if (detail.clusters.count == 0 || kind.second) {
                    list.draws.push_back(draw);
                } else {
                    const bool one_sided = !world.materials[std::size_t(primitive.material)].double_sided;
                    const EyeEvent& eye_event = eye_events[std::size_t(image.rest_frame)];
                    draw.count = 1;
                    for (std::uint32_t own : seen) {
                        const Instance& instance = world.instances[range.first + (own - first)];
                        draw.farthest = boxes[own].farthest;
                        add_cluster_draws(world, detail.clusters,
                            ClusterView(instance, eye_event, boxes[own].scale, one_sided), frustum, hole, draw, list.draws);
                        ++draw.first;
                    }
                }
                reserve_headroom(seen);
                seen.clear();
            }
        }
        // Nearest first, as the instances of a draw. What is large and around everything, such as a ground, comes last.
        const auto order
            = [&](const Draw& draw) { return std::tuple(draw.blended, draw.farthest, draw.first, draw.first_index); };
        const auto own = list.draws.begin() + std::ptrdiff_t(first_draw);
        std::sort(own, list.draws.end(), [&](const Draw& a, const Draw& b) { return order(a) < order(b); });
        const auto blended = std::find_if(own, list.draws.end(), [](const Draw& draw) { return draw.blended; });
        sort_from_behind(std::span(blended, list.draws.end()), list);
    }
    reserve_headroom(list.draws);
    reserve_headroom(list.sorted_indices);
    reserve_headroom(list.visible);
    return list;
}

double nearest_box(const World& world, const EyeEvent& eye_event)
{
    double nearest = 1e300;
    const glm::dvec3& place = eye_event.place;
    const InstanceRange range = instances_of(world, eye_event.frame);
    for (std::size_t at = range.first; at < range.last; ++at) {
        const Instance& instance = world.instances[at];
        const Primitive& primitive = world.primitives[instance.primitive];
        if (instance.motion >= 0) {
            nearest = std::min(nearest, placed(world, instance, eye_event).box.distance);
            continue;
        }
        // The axis-aligned box of the corners: it encloses the oriented one, so the distance is a lower bound.
        glm::dvec3 low(1e300), high(-1e300);
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 corner(i & 1 ? primitive.high.x : primitive.low.x, i & 2 ? primitive.high.y : primitive.low.y,
                i & 4 ? primitive.high.z : primitive.low.z);
            const glm::dvec3 moved = glm::dvec3(instance.frame_from_local * glm::dvec4(corner, 1));
            low = glm::min(low, moved), high = glm::max(high, moved);
        }
        nearest = std::min(nearest, glm::distance(place, glm::clamp(place, low, high)));
    }
    return nearest * eye_event.contraction;
}

} // namespace starbow
