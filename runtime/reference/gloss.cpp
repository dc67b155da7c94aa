#include "gloss.h"
#include "shaders/shared_structs.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace starbow {
namespace {

glm::dvec4 map_at(const World& world, const Pictures& pictures, const SightHit& met, const Map& map)
{
    glm::dvec2 uv(0);
    for (int k = 0; k < 3; ++k) {
        const glm::dvec4 uvs(world.vertex_maps[met.corners[k]].uvs);
        uv += met.weights[k] * (map.second ? glm::dvec2(uvs.z, uvs.w) : glm::dvec2(uvs.x, uvs.y));
    }
    return pictures.at(map.texture, glm::dmat2(map.rotate_scale) * uv + glm::dvec2(map.offset));
}

/// A direction of light or shadow by Smith: the part of microfacets that see it, over those of one side.
double lambda(double cosine, double width)
{
    const double tangent_square = (1 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (std::sqrt(1 + width * width * tangent_square) - 1);
}

double schlick(double cosine) { return std::pow(1 - std::clamp(cosine, 0.0, 1.0), 5); }

} // namespace

GlossyHit::GlossyHit(
    const World& world, const Pictures& pictures, const SightHit& met, const SurfaceAxes& axes, const glm::dvec3& facet)
    : normal_(facet)
    , eye_(-met.way)
{
    const Primitive& primitive = world.primitives[world.instances[met.instance].primitive];
    const Gloss& gloss = *world.materials[std::size_t(primitive.material)].gloss;
    metallic_ = gloss.metallic, dielectric_ = gloss.dielectric;
    double roughness = gloss.roughness;
    if (gloss.metallic_roughness.texture >= 0) {
        const glm::dvec4 map = map_at(world, pictures, met, gloss.metallic_roughness);
        roughness *= map.g, metallic_ *= map.b;
    }
    roughness = std::max(roughness, LEAST_ROUGHNESS);
    width_ = roughness * roughness;
    if (gloss.occlusion.texture >= 0)
        occlusion_ = 1 + gloss.occlusion_strength * (map_at(world, pictures, met, gloss.occlusion).r - 1);
    if (gloss.normal.texture < 0)
        return;
    // The map's axes on the outer side; on a back side all three are turned round.
    const double side = met.front ? 1 : -1;
    const glm::dvec3 outer = side * facet;
    double sense = 0;
    for (int k = 0; k < 3; ++k)
        sense += met.weights[k] * double(world.vertex_maps[met.corners[k]].tangent.w);
    glm::dvec3 along = axes.tangent - outer * glm::dot(outer, axes.tangent);
    if (!(glm::length(along) > 0))
        return;
    along = glm::normalize(along);
    const glm::dvec3 other = glm::cross(outer, along) * (sense * axes.sense);
    const glm::dvec3 map = (glm::dvec3(map_at(world, pictures, met, gloss.normal)) * 255.0 - 128.0) / 127.0;
    normal_ = side * glm::normalize(gloss.normal_scale * (map.x * along + map.y * other) + map.z * outer);
}

GlossyHit::Parts GlossyHit::of_lamp(const glm::dvec3& towards) const
{
    const double light = glm::dot(normal_, towards), eye = std::max(glm::dot(normal_, eye_), 1e-3);
    if (!(light > 0))
        return {};
    const glm::dvec3 facet = glm::normalize(towards + eye_);
    const double across = glm::length(glm::cross(normal_, facet)), along = glm::dot(normal_, facet);
    const double grazing = schlick(glm::dot(facet, towards)), fresnel = dielectric_ + (1 - dielectric_) * grazing;
    double mirrored = 0;
    if (along > 0) {
        const double density // times pi
            = width_ * width_ / std::pow(across * across + width_ * width_ * along * along, 2);
        mirrored = density / (1 + lambda(light, width_) + lambda(eye, width_)) / (4 * eye);
    }
    return {(1 - metallic_) * (1 - fresnel) * light + metallic_ * (1 - grazing) * mirrored,
        ((1 - metallic_) * fresnel + metallic_ * grazing) * mirrored};
}

GlossyHit::Colours GlossyHit::of_surroundings(
    const glm::dvec3& ambient, const std::function<glm::dvec3(const glm::dvec3&)>& around) const
{
    constexpr int steps = 16;
    const LineAxes axes(normal_);
    glm::dvec3 eye(glm::dot(axes.x, eye_), glm::dot(axes.y, eye_), std::max(glm::dot(normal_, eye_), 1e-3));
    eye = glm::normalize(eye);
    // The microfacets that the eye sees (Heitz 2018, Sampling the GGX Distribution of Visible Normals).
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(width_ * eye.x, width_ * eye.y, eye.z));
    const double level = std::hypot(stretched.x, stretched.y);
    const glm::dvec3 first = level > 0 ? glm::dvec3(-stretched.y, stretched.x, 0) / level : glm::dvec3(1, 0, 0);
    const glm::dvec3 second = glm::cross(stretched, first);
    Colours sum;
    double grazing_of_matt = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            // Denser towards the rim of the disc: microfacets there mirror light from far around.
            const double t = (i + 0.5) / steps, radius = std::sqrt(t * (2 - t)), weight = 2 * (1 - t);
            const double turn = 2 * std::numbers::pi * (j + 0.5) / steps;
            const glm::dvec3 matt(radius * std::cos(turn), radius * std::sin(turn), std::sqrt(1 - radius * radius));
            grazing_of_matt += weight * schlick(glm::dot(glm::normalize(matt + eye), matt));

            const double s = 0.5 * (1 + stretched.z), across = matt.x;
            const double up = (1 - s) * std::sqrt(1 - across * across) + s * matt.y;
            const glm::dvec3 seen
                = across * first + up * second + std::sqrt(std::max(0.0, 1 - across * across - up * up)) * stretched;
            const glm::dvec3 facet = glm::normalize(glm::dvec3(width_ * seen.x, width_ * seen.y, std::max(0.0, seen.z)));
            const glm::dvec3 light = 2 * glm::dot(eye, facet) * facet - eye;
            if (!(light.z > 0))
                continue;
            const double part = weight * (1 + lambda(eye.z, width_)) / (1 + lambda(eye.z, width_) + lambda(light.z, width_));
            const double grazing = schlick(glm::dot(eye, facet));
            const glm::dvec3 from = part * around(light.x * axes.x + light.y * axes.y + light.z * normal_);
            sum.by_base += metallic_ * (1 - grazing) * from;
            sum.white += (metallic_ * grazing + (1 - metallic_) * (dielectric_ + (1 - dielectric_) * grazing)) * from;
        }
    constexpr double all = steps * steps;
    sum.by_base
        = occlusion_ * (sum.by_base / all + (1 - metallic_) * (1 - dielectric_) * (1 - grazing_of_matt / all) * ambient);
    sum.white = occlusion_ * sum.white / all;
    return sum;
}

} // namespace starbow
