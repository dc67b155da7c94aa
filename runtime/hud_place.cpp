#include "hud_place.h"
#include <cmath>

namespace starbow {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;

glm::dvec3 panel_middle(const HudPlacement& hud)
{
    const double a = hud.azimuth_deg * degree, e = hud.elevation_deg * degree;
    return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
}

/// Which way the flat picture faces that shows the panel's middle, towards the eye's far side; elsewhere the middle itself.
glm::dvec3 panel_faces(const glm::dvec3& middle, std::span<const std::vector<CompiledPane>> panes)
{
    for (const auto& output : panes)
        for (const CompiledPane& pane : output)
            if (pane.matrix) {
                const glm::dvec3 at = glm::inverse(*pane.matrix) * middle;
                const glm::dvec2 pixel = glm::dvec2(at) / at.z, size(pane.pane.size);
                if (at.z > 0 && glm::all(glm::greaterThanEqual(pixel, glm::dvec2(0)))
                    && glm::all(glm::lessThanEqual(pixel, size)))
                    return glm::normalize(glm::cross((*pane.matrix)[0], (*pane.matrix)[1]));
            }
    return middle;
}

} // namespace

glm::dmat3 panel_from_cockpit(const HudPlacement& hud, std::span<const std::vector<CompiledPane>> panes)
{
    const glm::dvec3 middle = panel_middle(hud), faces = panel_faces(middle, panes);
    const glm::dvec3 across = glm::cross(faces, glm::dvec3(0, 1, 0));
    const glm::dvec3 x = glm::length(across) > 1e-6 ? glm::normalize(across) : glm::dvec3(1, 0, 0), y = glm::cross(x, faces);
    const glm::dvec2 at = glm::dvec2(glm::dot(middle, x), glm::dot(middle, y)) / glm::dot(middle, faces);
    return glm::transpose(glm::dmat3(x - at.x * faces, y - at.y * faces, faces));
}

} // namespace starbow
