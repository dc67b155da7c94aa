#include "hud_place.h"
#include "config/model/angles.h"
#include "hud.h"
#include <array>
#include <cmath>

namespace starbow {
namespace {

glm::dvec3 panel_middle(const HudPlacement& hud)
{
    const double a = hud.azimuth_deg * degree, e = hud.elevation_deg * degree;
    return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
}

bool shows(const CompiledView& view, const glm::dvec3& direction)
{
    if (!view.matrix)
        return find_pixel(*view.map, *view.cones, direction).has_value();
    const glm::dvec3 at = glm::inverse(*view.matrix) * direction;
    const glm::dvec2 pixel = glm::dvec2(at) / at.z;
    return at.z > 0 && glm::all(glm::greaterThanEqual(pixel, glm::dvec2(0)))
        && glm::all(glm::lessThanEqual(pixel, glm::dvec2(view.view.size)));
}

/// The direction that the panel faces: the normal of the flat view around the panel's middle, away from the eye;
/// elsewhere the middle itself.
glm::dvec3 panel_faces(const glm::dvec3& middle, std::span<const std::vector<CompiledView>> views)
{
    for (const auto& output : views)
        for (const CompiledView& view : output)
            if (view.matrix && shows(view, middle))
                return glm::normalize(glm::cross((*view.matrix)[0], (*view.matrix)[1]));
    return middle;
}

/// The number of a panel's four corners that are seen, a little within its edge.
int corners_shown(
    const glm::dmat3& panel_from_cockpit, const glm::dvec2& half, std::span<const std::vector<CompiledView>> views)
{
    const glm::dmat3 cockpit_from_panel = glm::inverse(panel_from_cockpit);
    int count = 0;
    for (int i = 0; i < 4; ++i) {
        const glm::dvec2 corner = 0.97 * half * glm::dvec2(i % 2 ? 1 : -1, i / 2 ? 1 : -1);
        const glm::dvec3 way = glm::normalize(cockpit_from_panel * glm::dvec3(corner, 1));
        bool shown = false;
        for (const auto& output : views)
            for (const CompiledView& view : output)
                shown = shown || shows(view, way);
        count += shown;
    }
    return count;
}

} // namespace

glm::dmat3 panel_from_cockpit(const HudPlacement& hud, std::span<const std::vector<CompiledView>> views)
{
    const glm::dvec3 middle = panel_middle(hud), faces = panel_faces(middle, views);
    const glm::dvec3 across = glm::cross(faces, glm::dvec3(0, 1, 0));
    const glm::dvec3 x = glm::length(across) > 1e-6 ? glm::normalize(across) : glm::dvec3(1, 0, 0), y = glm::cross(x, faces);
    const glm::dvec2 at = glm::dvec2(glm::dot(middle, x), glm::dot(middle, y)) / glm::dot(middle, faces);
    return glm::transpose(glm::dmat3(x - at.x * faces, y - at.y * faces, faces));
}

HudPlacement instruments_place(const HudPlacement& hud, double aspect, std::span<const std::vector<CompiledView>> views)
{
    const double half_width = std::tan(0.5 * hud.width_deg * degree), half = half_width * aspect,
                 hud_half = half_width * panel_aspect, hud_at = std::tan(hud.elevation_deg * degree);
    const double across = (hud_at < 0 ? 1 : -1) * (std::abs(hud_at) + hud_half - half); // up from a low display
    const double beside = 1.05 * (half + hud_half);
    HudPlacement best = hud;
    int most = -1;
    for (const double at : {across, hud_at + beside, hud_at - beside}) {
        if (std::abs(at - hud_at) < half + hud_half)
            continue; // they would overlap
        HudPlacement place = hud;
        place.elevation_deg = std::atan(at) / degree;
        const int corners = views.empty() ? 0 : corners_shown(panel_from_cockpit(place, views), {half_width, half}, views);
        if (corners > most)
            best = place, most = corners;
    }
    return best;
}

PixelBox panel_box(const ConeHierarchy& cones, const glm::dmat3& panel_from_cockpit, const glm::dvec2& half)
{
    // The panel's edges as planes through the eye, in the panel's axes, and the plane that excludes the directions behind.
    const glm::dmat3 cockpit_from_panel_normals = glm::transpose(panel_from_cockpit);
    std::array<glm::dvec3, 5> sides
        = {glm::dvec3(1, 0, half.x), {-1, 0, half.x}, {0, 1, half.y}, {0, -1, half.y}, {0, 0, 1}};
    for (glm::dvec3& side : sides)
        side = glm::normalize(cockpit_from_panel_normals * side);
    return pixels_in_pyramid(cones, sides);
}

} // namespace starbow
