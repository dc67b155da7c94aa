#include "trace.h"
#include "config/model/angles.h"
#include "runtime/shadow/embree_scene.h"
#include "runtime/world/moving.h"
#include "runtime/world/shape.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace starbow {
namespace {

constexpr double tiny = std::numeric_limits<double>::epsilon();

/// The crossing of a line and a triangle: the corners' weights, none below 0, which sum up to 1, and the distance.
struct Crossing {
    glm::dvec3 weights;
    double distance;
    bool front, inside;
};

/// Twice the area of the origin with a and b. Exchanging them exchanges the sign and nothing else.
double area(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - b.x * a.y; }

/// Corners are from the line's beginning. Each corner is seen from the line first, at its small distances beside it. A
/// volume of the line with two distant corners would be the difference of products of their full distances: of a triangle
/// that is a millionth as wide as it is far, no digit would be left. Two triangles at an edge get the same area of the line
/// with the edge, with opposite signs, so no line passes between them. `inside` false: the plane is met beyond the edges.
std::optional<Crossing> crossing(const glm::dvec3 (&p)[3], const LineAxes& line)
{
    glm::dvec2 beside[3];
    for (int k = 0; k < 3; ++k)
        beside[k] = {glm::dot(line.x, p[k]), glm::dot(line.y, p[k])};
    const glm::dvec3 areas(area(beside[1], beside[2]), area(beside[2], beside[0]), area(beside[0], beside[1]));
    const bool none_above = areas.x <= 0 && areas.y <= 0 && areas.z <= 0;
    const bool none_below = areas.x >= 0 && areas.y >= 0 && areas.z >= 0;
    const bool inside = none_above || none_below;
    // Outside, the areas have different signs, and their sum would cancel where the line passes far from a small triangle.
    // The triangle's edges yield the sum there.
    const double sum = inside ? areas.x + areas.y + areas.z : area(beside[1] - beside[0], beside[2] - beside[0]);
    if (sum == 0 || !std::isfinite(sum))
        return {};
    const glm::dvec3 weights = areas / sum;
    const double distance
        = glm::dot(line.z, p[0]) + weights.y * glm::dot(line.z, p[1] - p[0]) + weights.z * glm::dot(line.z, p[2] - p[0]);
    return Crossing{weights, distance, sum < 0, inside};
}

/// The places of vertices of an animated instance at a time of its frame.
template <std::size_t count>
std::array<glm::dvec3, count> places_at(
    const World& world, const Instance& instance, const std::uint32_t (&vertices)[count], double time)
{
    std::array<glm::dvec3, count> places;
    if (instance.deformation < 0) {
        const glm::dmat4 pose = pose_at(world, instance, time);
        for (std::size_t k = 0; k < count; ++k)
            places[k] = glm::dvec3(pose * glm::dvec4(glm::dvec3(world.vertices[vertices[k]].position), 1));
        return places;
    }
    Shape shape(world, instance, time);
    for (std::size_t k = 0; k < count; ++k)
        places[k] = shape.vertex(vertices[k]).place;
    return places;
}

float below(double x) { return std::nextafter(float(std::clamp(x, -1e37, 1e37)), -1e38f); }
float above(double x) { return std::nextafter(float(std::clamp(x, -1e37, 1e37)), 1e38f); }

} // namespace

struct Tracer::Scene {
    struct Triangle {
        std::uint32_t instance;
        std::uint32_t corners[3]; ///< of World::vertices; of lines and points as Met's
        glm::dvec3 places[3]; ///< from the eye event's; of an animated instance, at each corner's retarded time
    };

    const World& world;
    const Pictures& pictures;
    EyeEvent eye_event;
    double farthest_eye, pixel_rad;
    std::vector<Triangle> triangles;
    EmbreeScene embree;

    struct Query {
        RayContext embree; // first: Embree hands it on
        const Scene* scene;
        const SightLine* line;
        double beyond;
        std::optional<SightHit> met;
    };

    double sent(const SightLine& line, const glm::dvec3& place) const
    {
        const glm::dvec3 from_eye = place - line.from;
        return line.time
            + (eye_event.now ? eye_event.beta * (eye_event.cube_from_frame * from_eye).z : -glm::length(from_eye));
    }

    /// The retarded position of an animated instance's corner, from the eye event's place.
    glm::dvec3 seen_corner(const Instance& instance, std::uint32_t vertex) const
    {
        const SightLine line{glm::dvec3(0), glm::dvec3(0), eye_event.time};
        glm::dvec3 place(0);
        double time = eye_event.time;
        for (int round = 0; round < 60; ++round) {
            place = places_at(world, instance, {vertex}, time)[0] - eye_event.place;
            const double next = sent(line, place);
            if (std::abs(next - time) <= 4 * tiny * std::abs(time) || next == time)
                break;
            time = next;
        }
        return place;
    }

    void add(std::uint32_t index)
    {
        const Instance& instance = world.instances[index];
        const Primitive& primitive = world.primitives[instance.primitive];
        std::unordered_map<std::uint32_t, glm::dvec3> seen; // an animated corner takes a while to compute
        auto place_of = [&](std::uint32_t vertex) {
            if (instance.motion < 0)
                return glm::dvec3(instance.frame_from_local * glm::dvec4(glm::dvec3(world.vertices[vertex].position), 1))
                    - eye_event.place;
            const auto [at, is_new] = seen.try_emplace(vertex);
            if (is_new)
                at->second = seen_corner(instance, vertex);
            return at->second;
        };
        const std::uint32_t corners = corners_of(primitive.topology);
        for (std::uint32_t i = 0; i + corners <= primitive.index_count; i += corners) {
            Triangle triangle{index, {}, {}};
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t vertex = world.indices[primitive.first_index + i + std::min(k, corners - 1)]
                    + std::uint32_t(primitive.vertex_offset);
                triangle.corners[k] = vertex;
                triangle.places[k] = place_of(vertex);
            }
            triangles.push_back(triangle);
        }
    }

    /// True if any of an instance may be seen: if its light may have left while it existed.
    bool may_be_seen(const Instance& instance) const
    {
        if (instance.existence < 0)
            return true;
        const ExistenceInterval& existence = world.existence_intervals[std::size_t(instance.existence)];
        const Primitive& primitive = world.primitives[instance.primitive];
        if (instance.motion >= 0)
            return true;
        const glm::dvec3 middle = glm::dvec3(instance.frame_from_local * glm::dvec4(primitive.centre, 1)) - eye_event.place;
        const glm::dmat3 m(instance.frame_from_local);
        const double stretch = std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
        const double around = primitive.radius * stretch + 2 * farthest_eye;
        const double time = retarded_time(eye_event, eye_event.cube_from_frame * middle);
        return time + around >= existence.begin && time - around < existence.end;
    }

    void bounds(std::uint32_t index, RTCBounds& box) const
    {
        const Triangle& triangle = triangles[index];
        glm::dvec3 low = glm::min(glm::min(triangle.places[0], triangle.places[1]), triangle.places[2]);
        glm::dvec3 high = glm::max(glm::max(triangle.places[0], triangle.places[1]), triangle.places[2]);
        if (world.instances[triangle.instance].motion >= 0) {
            // The retarded times of two of its points differ by at most the seen distance of the two. In that time, and in
            // as much again for the eye's other places, no point moves further than a fifth of it.
            const double size = glm::length(high - low);
            const double bend = 0.5 * size + 2 * most_own_speed * farthest_eye;
            low -= bend, high += bend;
        }
        if (topology_of(triangle) != Topology::triangles) {
            // Half a pixel around it, where an angle is widest: as far away as its farther end.
            const glm::dvec3 farther = glm::max(glm::abs(low), glm::abs(high));
            const double width = pixel_rad * std::max(eye_event.E, 1 / eye_event.E) * (glm::length(farther) + farthest_eye);
            low -= width, high += width;
        }
        // A float line is off by its place's rounding and by its direction's, as far out as the box reaches.
        const glm::dvec3 most = glm::max(glm::abs(low), glm::abs(high));
        const double lost = 4e-7 * (std::max({most.x, most.y, most.z}) + farthest_eye) + 1e-30;
        low -= lost, high += lost;
        box.lower_x = below(low.x), box.lower_y = below(low.y), box.lower_z = below(low.z);
        box.upper_x = above(high.x), box.upper_y = above(high.y), box.upper_z = above(high.z);
    }

    Topology topology_of(const Triangle& triangle) const
    {
        return world.primitives[world.instances[triangle.instance].primitive].topology;
    }

    /// The line's passage by a line or a point of the world, in less than half a pixel's angle. A point is round, and its
    /// disc has the area of a square pixel.
    std::optional<Crossing> passage(const glm::dvec3 (&p)[3], const SightLine& line, bool point) const
    {
        const LineAxes axes(line.way);
        glm::dvec3 ends[2];
        for (int k = 0; k < 2; ++k)
            ends[k] = {glm::dot(axes.x, p[k]), glm::dot(axes.y, p[k]), glm::dot(axes.z, p[k])};
        if (!point) { // of a line that begins behind the eye, what is in front of it
            constexpr double nearest = 1e-9;
            for (int k = 0; k < 2; ++k)
                if (ends[k].z <= 0 && ends[1 - k].z > 0)
                    ends[k]
                        += (ends[1 - k] - ends[k]) * ((nearest * ends[1 - k].z - ends[k].z) / (ends[1 - k].z - ends[k].z));
        }
        if (!(ends[0].z > 0 && ends[1].z > 0))
            return {};
        const glm::dvec2 a = glm::dvec2(ends[0]) / ends[0].z, b = glm::dvec2(ends[1]) / ends[1].z;
        const double length = glm::dot(b - a, b - a);
        const double along = length > 0 ? -glm::dot(a, b - a) / length : 0, on = std::clamp(along, 0.0, 1.0);
        if (!point && (along < 0 || along > 1))
            return {};
        const double half = (point ? std::sqrt(1 / pi) : 0.5) * line.pixel_rad;
        if (!(glm::length(a + on * (b - a)) <= half))
            return {};
        // Halfway in the picture is nearer than halfway along the line.
        const double part = on * ends[0].z / (on * ends[0].z + (1 - on) * ends[1].z);
        const double z = ends[0].z + part * (ends[1].z - ends[0].z);
        return Crossing{{1 - part, part, 0}, z, true, true};
    }

    std::optional<Crossing> crossing_of(const Triangle& triangle, const SightLine& line, double& time) const
    {
        glm::dvec3 p[3] = {triangle.places[0] - line.from, triangle.places[1] - line.from, triangle.places[2] - line.from};
        const LineAxes axes(line.way);
        const Topology topology = topology_of(triangle);
        const auto cross = [&] {
            return topology == Topology::triangles ? crossing(p, axes) : passage(p, line, topology == Topology::points);
        };
        std::optional<Crossing> at = cross();
        if (!at)
            return {};
        const Instance& instance = world.instances[triangle.instance];
        auto time_at = [&](const Crossing& c) { return sent(line, line.from + line.way * c.distance); };
        time = time_at(*at);
        if (instance.motion < 0)
            return at;
        // The pose at the retarded time: the time at which its plane is met by light that leaves at that time.
        auto met_at = [&](double t) {
            const auto places = places_at(world, instance, triangle.corners, t);
            for (int k = 0; k < 3; ++k)
                p[k] = places[std::size_t(k)] - eye_event.place - line.from;
            return cross();
        };
        double before = 0, off_before = 0;
        for (int round = 0; round < 60; ++round) {
            at = met_at(time);
            if (!at)
                return {};
            const double off = time_at(*at) - time;
            if (std::abs(off) <= 4 * tiny * (std::abs(time) + std::abs(at->distance)))
                return at;
            const double slope = round == 0 ? -1 : (off - off_before) / (time - before);
            const double next = time - off / (std::abs(slope) > 0.2 && std::isfinite(slope) ? slope : -1);
            before = time, off_before = off;
            if (next == time || !std::isfinite(next))
                return at;
            time = next;
        }
        return {};
    }

    bool there(const SightHit& met) const
    {
        const Instance& instance = world.instances[met.instance];
        if (instance.existence >= 0) {
            const ExistenceInterval& existence = world.existence_intervals[std::size_t(instance.existence)];
            if (met.sent < existence.begin || met.sent >= existence.end)
                return false;
        }
        const Material& material = world.materials[std::size_t(world.primitives[instance.primitive].material)];
        if (!met.front && !material.double_sided)
            return false;
        return material.blended || material.alpha_cutoff <= 0
            || base_of(world, pictures, met).a >= double(material.alpha_cutoff);
    }

    void meet(std::uint32_t index, Query& query, float& farthest) const
    {
        const Triangle& triangle = triangles[index];
        const SightLine& line = *query.line;
        double time = 0;
        const auto at = crossing_of(triangle, line, time);
        if (!at || !at->inside || !(at->distance > query.beyond) || (query.met && query.met->distance <= at->distance))
            return;
        const SightHit met{triangle.instance, {triangle.corners[0], triangle.corners[1], triangle.corners[2]}, at->weights,
            line.from + line.way * at->distance, line.way, at->distance, time, at->front};
        if (!there(met))
            return;
        query.met = met;
        farthest = above(met.distance * (1 + 1e-6));
    }
};

glm::dvec2 uv_of(const World& world, const SightHit& met)
{
    glm::dvec2 uv(0);
    for (int k = 0; k < 3; ++k)
        uv += met.weights[k] * glm::dvec2(world.vertices[met.corners[k]].uv);
    return uv;
}

glm::dvec4 base_of(const World& world, const Pictures& pictures, const SightHit& met)
{
    const Material& material
        = world.materials[std::size_t(world.primitives[world.instances[met.instance].primitive].material)];
    glm::dvec4 colour(0);
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t packed = world.vertices[met.corners[k]].colour;
        colour += met.weights[k] * glm::dvec4(packed & 255, packed >> 8 & 255, packed >> 16 & 255, packed >> 24) / 255.0;
    }
    return colour * glm::dvec4(material.base_colour) * pictures.at(material.base_texture, uv_of(world, met));
}

Tracer::Tracer(
    const World& world, const Pictures& pictures, const EyeEvent& eye_event, double farthest_eye, double pixel_rad)
    : scene_(new Scene{world, pictures, eye_event, farthest_eye, pixel_rad, {}, {}})
{
    for (std::uint32_t i = 0; i < world.instances.size(); ++i)
        if (world.instances[i].frame == eye_event.frame && scene_->may_be_seen(world.instances[i]))
            scene_->add(i);
    RTCGeometry all = rtcNewGeometry(scene_->embree.device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(all, unsigned(scene_->triangles.size()));
    rtcSetGeometryUserData(all, scene_.get());
    rtcSetGeometryBoundsFunction(
        all,
        [](const RTCBoundsFunctionArguments* arguments) {
            static_cast<const Scene*>(arguments->geometryUserPtr)->bounds(arguments->primID, *arguments->bounds_o);
        },
        nullptr);
    rtcSetGeometryIntersectFunction(all, [](const RTCIntersectFunctionNArguments* arguments) {
        if (arguments->N != 1 || !arguments->valid[0])
            return;
        auto& own = *reinterpret_cast<Scene::Query*>(arguments->context);
        auto& hit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
        own.scene->meet(arguments->primID, own, hit.ray.tfar);
    });
    scene_->embree.attach(all, 0);
    scene_->embree.commit();
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;

std::optional<SightHit> Tracer::nearest(const SightLine& line, double beyond) const
{
    if (scene_->triangles.empty())
        return {};
    Scene::Query query{{}, scene_.get(), &line, beyond, {}};
    begin_query(query.embree);
    RTCRayHit hit{};
    hit.ray.org_x = float(line.from.x), hit.ray.org_y = float(line.from.y), hit.ray.org_z = float(line.from.z);
    hit.ray.dir_x = float(line.way.x), hit.ray.dir_y = float(line.way.y), hit.ray.dir_z = float(line.way.z);
    hit.ray.tfar = std::numeric_limits<float>::infinity();
    hit.ray.mask = ~0u;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    find_first(scene_->embree.scene, query.embree, hit);
    return query.met;
}

const EyeEvent& Tracer::eye_event() const { return scene_->eye_event; }
std::size_t Tracer::triangles() const { return scene_->triangles.size(); }

} // namespace starbow
