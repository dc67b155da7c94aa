#include "occluders.h"
#include "embree_scene.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>

namespace starbow {
namespace {

/// A texel's alpha at a texture coordinate, by the nearest one.
double alpha_at(const Texture& texture, const glm::dvec2& uv)
{
    const auto wrapped = [](Wrap wrap, double at, int size) {
        if (wrap == Wrap::clamp)
            return int(std::clamp(at * size, 0.0, size - 1.0));
        double inside = at - std::floor(at);
        if (wrap == Wrap::mirror && std::fmod(std::abs(std::floor(at)), 2) == 1)
            inside = 1 - inside;
        return std::clamp(int(inside * size), 0, size - 1);
    };
    if (!(std::abs(uv.x) < 1e15 && std::abs(uv.y) < 1e15))
        return 1;
    const int x = wrapped(texture.sampler.u, uv.x, texture.size.x), y = wrapped(texture.sampler.v, uv.y, texture.size.y);
    return texture.rgba[4 * (std::size_t(y) * std::size_t(texture.size.x) + std::size_t(x)) + 3] / 255.0;
}

} // namespace

bool hides_light(const World& world, const Instance& instance)
{
    const Material& material = world.materials[std::size_t(world.primitives[instance.primitive].material)];
    return instance.frame == 0 && instance.motion < 0 && instance.existence < 0 && !material.unlit && !material.blended
        && material.emissive == glm::vec3(0) && material.temperature_K == 0;
}

struct Occluders::Scene {
    struct Triangle {
        std::uint32_t primitive;
        std::uint32_t corners[3]; ///< of World::vertices
    };
    const World& world;
    std::vector<Triangle> whole, masked;
    double extent = 0;
    EmbreeScene embree;

    const Material& material_of(const Triangle& triangle) const
    {
        return world.materials[std::size_t(world.primitives[triangle.primitive].material)];
    }

    /// True if a mask cuts the triangle out there.
    bool cut_out(const Triangle& triangle, double u, double v) const
    {
        const Material& material = material_of(triangle);
        const double weights[3] = {1 - u - v, u, v};
        glm::dvec2 uv(0);
        double alpha = 0;
        for (int k = 0; k < 3; ++k) {
            const Vertex& vertex = world.vertices[triangle.corners[k]];
            uv += weights[k] * glm::dvec2(vertex.uv);
            alpha += weights[k] * (vertex.colour >> 24) / 255.0;
        }
        alpha *= double(material.base_colour.a);
        if (material.base_texture >= 0)
            alpha *= alpha_at(world.textures[std::size_t(material.base_texture)], uv);
        return alpha < double(material.alpha_cutoff);
    }

    static void filter(const RTCFilterFunctionNArguments* arguments)
    {
        const auto* own = static_cast<const Scene*>(arguments->geometryUserPtr);
        for (unsigned i = 0; i < arguments->N; ++i)
            if (arguments->valid[i] == -1
                && own->cut_out(own->masked[RTCHitN_primID(arguments->hit, arguments->N, i)],
                    RTCHitN_u(arguments->hit, arguments->N, i), RTCHitN_v(arguments->hit, arguments->N, i)))
                arguments->valid[i] = 0;
    }

    void add(const Instance& instance, std::vector<glm::vec3>& whole_places, std::vector<glm::vec3>& masked_places)
    {
        const Primitive& primitive = world.primitives[instance.primitive];
        const bool masks = world.materials[std::size_t(primitive.material)].alpha_cutoff > 0;
        for (std::uint32_t i = 0; primitive.topology == Topology::triangles && i + 2 < primitive.index_count; i += 3) {
            Triangle triangle{instance.primitive, {}};
            for (std::uint32_t k = 0; k < 3; ++k) {
                triangle.corners[k] = world.indices[primitive.first_index + i + k] + std::uint32_t(primitive.vertex_offset);
                const glm::dvec3 at(
                    instance.frame_from_local * glm::dvec4(glm::dvec3(world.vertices[triangle.corners[k]].position), 1));
                extent = std::max({extent, std::abs(at.x), std::abs(at.y), std::abs(at.z)});
                (masks ? masked_places : whole_places).push_back(at);
            }
            (masks ? masked : whole).push_back(triangle);
        }
    }

    void attach(const std::vector<glm::vec3>& places, unsigned id, bool filtered)
    {
        RTCGeometry geometry = rtcNewGeometry(embree.device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* to = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
            sizeof(glm::vec3), std::max<std::size_t>(places.size(), 1)));
        auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), places.size() / 3));
        if (!to || (!indices && !places.empty()))
            throw std::bad_alloc();
        std::copy(places.begin(), places.end(), to);
        for (std::uint32_t i = 0; i < places.size(); ++i)
            indices[i] = i;
        if (filtered) {
            rtcSetGeometryUserData(geometry, this);
            rtcSetGeometryIntersectFilterFunction(geometry, filter);
            rtcSetGeometryOccludedFilterFunction(geometry, filter);
        }
        embree.attach(geometry, id);
    }

    /// True if a ray along `way` meets the side of a triangle that is not visible.
    bool is_back(unsigned geometry, unsigned number, const glm::vec3& normal, const glm::vec3& way) const
    {
        return glm::dot(normal, way) > 0 && !material_of((geometry == 0 ? whole : masked)[number]).double_sided;
    }

    RTCRay ray(const glm::dvec3& from, const glm::dvec3& way, double far) const
    {
        RTCRay ray{};
        ray.org_x = float(from.x), ray.org_y = float(from.y), ray.org_z = float(from.z);
        ray.dir_x = float(way.x), ray.dir_y = float(way.y), ray.dir_z = float(way.z);
        ray.tfar = float(std::min(far, 1e37));
        ray.mask = ~0u;
        return ray;
    }
};

Occluders::Occluders(const World& world, std::span<const Instance> instances)
    : scene_(new Scene{world, {}, {}, 0, {}})
{
    std::vector<glm::vec3> whole, masked;
    for (const Instance& instance : instances)
        if (hides_light(world, instance))
            scene_->add(instance, whole, masked);
    if (!whole.empty())
        scene_->attach(whole, 0, false);
    if (!masked.empty())
        scene_->attach(masked, 1, true);
    scene_->embree.commit();
}

Occluders::~Occluders() = default;
Occluders::Occluders(Occluders&&) noexcept = default;

std::optional<Occluders::Hit> Occluders::first(const glm::dvec3& from, const glm::dvec3& way, double far) const
{
    RayContext context;
    begin_query(context);
    RTCRayHit hit{};
    hit.ray = scene_->ray(from, way, far);
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    find_first(scene_->embree.scene, context, hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return {};
    return Hit{double(hit.ray.tfar),
        scene_->is_back(hit.hit.geomID, hit.hit.primID, {hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z},
            {hit.ray.dir_x, hit.ray.dir_y, hit.ray.dir_z})};
}

Occluders::Hits Occluders::first(const Vectors& from, const Vectors& ways) const
{
    RayContext context;
    begin_query(context);
    alignas(32) constexpr std::array<int, bundle> all{-1, -1, -1, -1, -1, -1, -1, -1};
    RTCRayHit8 found;
    RTCRay8& ray = found.ray;
    for (int i = 0; i < bundle; ++i) {
        ray.org_x[i] = from.x[i], ray.org_y[i] = from.y[i], ray.org_z[i] = from.z[i];
        ray.dir_x[i] = ways.x[i], ray.dir_y[i] = ways.y[i], ray.dir_z[i] = ways.z[i];
        ray.tnear[i] = 0, ray.tfar[i] = 1e37f, ray.time[i] = 0;
        ray.mask[i] = ~0u, ray.id[i] = 0, ray.flags[i] = 0;
        found.hit.geomID[i] = found.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    find_first_of(scene_->embree.scene, context, all.data(), found);
    Hits hits{};
    for (int i = 0; i < bundle; ++i) {
        const RTCHit8& hit = found.hit;
        hits.distance[i] = std::numeric_limits<float>::infinity();
        if (hit.geomID[i] == RTC_INVALID_GEOMETRY_ID)
            continue;
        hits.distance[i] = ray.tfar[i];
        hits.back[i] = scene_->is_back(
            hit.geomID[i], hit.primID[i], {hit.Ng_x[i], hit.Ng_y[i], hit.Ng_z[i]}, {ways.x[i], ways.y[i], ways.z[i]});
    }
    return hits;
}

bool Occluders::hidden(const glm::dvec3& from, const glm::dvec3& way, double far) const
{
    RayContext context;
    begin_query(context);
    RTCRay ray = scene_->ray(from, way, far);
    find_any(scene_->embree.scene, context, ray);
    return ray.tfar < 0;
}

std::size_t Occluders::triangles() const { return scene_->whole.size() + scene_->masked.size(); }
double Occluders::extent() const { return scene_->extent; }

} // namespace starbow
