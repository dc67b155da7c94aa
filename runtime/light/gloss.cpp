#include "gloss.h"
#include "config/model/angles.h"
#include "shaders/shared_structs.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr int steps = 40; // along each of the two numbers that distribute the microfacets

double fifth_power(double x) { return x * x * x * x * x; }

/// Calls each(normal, weight) for the microfacets that an eye sees; the weights sum up to 1 (Heitz 2018, Sampling the GGX
/// Distribution of Visible Normals). eye: unit, z along the surface's normal.
template <typename Each> void each_microfacet(const glm::dvec3& eye, double width, Each each)
{
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(width * eye.x, width * eye.y, eye.z));
    const double level = std::hypot(stretched.x, stretched.y);
    const glm::dvec3 across = level > 0 ? glm::dvec3(-stretched.y, stretched.x, 0) / level : glm::dvec3(1, 0, 0);
    const glm::dvec3 along = glm::cross(stretched, across);
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            // More of them stand at the rim of the disc, where they are steep: their light is that of the whole lower sky.
            const double left = 1 - (i + 0.5) / steps, radius = std::sqrt(1 - left * left);
            const double turn = 2 * pi * (j + 0.5) / steps;
            // The visible part of the disc: half of it is narrowed by the eye's angle.
            const double x = radius * std::cos(turn), half = 0.5 * (1 + stretched.z);
            const double y = (1 - half) * std::sqrt(1 - x * x) + half * radius * std::sin(turn);
            const glm::dvec3 h = x * across + y * along + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * stretched;
            each(glm::normalize(glm::dvec3(width * h.x, width * h.y, std::max(h.z, 0.0))), 2 * left / (steps * steps));
        }
}

/// Smith's function of a direction that has that cosine to the normal.
double smith(double width, double cosine) { return 0.5 * (std::sqrt(1 + width * width * (1 / (cosine * cosine) - 1)) - 1); }

/// The parts of light from all around that a surface mirrors to an eye at an angle.
void add_mirrored(GlossTexel& texel, double cosine, double width)
{
    const glm::dvec3 eye(std::sqrt(1 - cosine * cosine), 0, cosine);
    double metal = 0, white = 0;
    each_microfacet(eye, width, [&](const glm::dvec3& h, double weight) {
        const double on_facet = glm::dot(eye, h), light = 2 * on_facet * h.z - eye.z;
        if (!(light > 0))
            return;
        const double part = weight * (1 + smith(width, cosine)) / (1 + smith(width, cosine) + smith(width, light));
        const double grazing = fifth_power(1 - on_facet);
        metal += part * (1 - grazing), white += part * grazing;
    });
    texel.metal = float(metal), texel.white = float(white);
}

/// The upper sky's part of light from around a direction of that height, mirrored at right angles.
double above_around(double height, double width)
{
    const glm::dvec3 up(std::sqrt(1 - height * height), 0, height);
    double above = 0, all = 0;
    each_microfacet({0, 0, 1}, width, [&](const glm::dvec3& h, double weight) {
        const glm::dvec3 light = 2 * h.z * h - glm::dvec3(0, 0, 1);
        if (!(light.z > 0))
            return;
        const double there = std::clamp(glm::dot(light, up), 0.0, 1.0);
        above += weight * light.z * there * there * (3 - 2 * there); // sky.glsl's gradient
        all += weight * light.z;
    });
    return above / all;
}

double grazing_mean(double cosine)
{
    const glm::dvec3 eye(std::sqrt(1 - cosine * cosine), 0, cosine);
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double square = (i + 0.5) / steps, turn = 2 * pi * (j + 0.5) / steps;
            const glm::dvec3 light(
                std::sqrt(square) * std::cos(turn), std::sqrt(square) * std::sin(turn), std::sqrt(1 - square));
            sum += fifth_power(1 - 0.5 * glm::length(eye + light));
        }
    return sum / (steps * steps);
}

std::vector<GlossTexel> computed_table()
{
    std::vector<GlossTexel> table;
    for (int row = 0; row < GLOSS_TABLE; ++row) {
        const double roughness = std::max(double(row) / (GLOSS_TABLE - 1), LEAST_ROUGHNESS);
        for (int column = 0; column < GLOSS_TABLE; ++column) {
            const double part = double(column) / (GLOSS_TABLE - 1), cosine = std::max(part, 1e-3);
            GlossTexel& texel = table.emplace_back();
            add_mirrored(texel, cosine, roughness * roughness);
            texel.above = float(above_around(2 * part - 1, roughness * roughness));
            texel.grazing = row == 0 ? float(grazing_mean(cosine)) : table[std::size_t(column)].grazing;
        }
    }
    return table;
}

} // namespace

const std::vector<GlossTexel>& gloss_table()
{
    static const std::vector<GlossTexel> table = computed_table();
    return table;
}

} // namespace starbow
