#include "hud_place.h"
#include "config/model/angles.h"
#include "displays/check/floor_plan_table.h"
#include "hud.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace starbow {
namespace {

constexpr std::array<glm::dvec2, 4> sides{glm::dvec2(-1, 0), {1, 0}, {0, -1}, {0, 1}};

glm::dvec3 panel_middle(const HudPlacement& hud) { return direction_of({hud.azimuth_deg, hud.elevation_deg}); }

/// The point in pixels from the view's corner that shows a direction, if any does.
std::optional<glm::dvec2> pixel_of(const CompiledView& view, const glm::dvec3& direction)
{
    if (!view.matrix)
        return find_pixel(*view.map, *view.cones, direction);
    const glm::dvec3 at = glm::inverse(*view.matrix) * direction;
    const glm::dvec2 pixel = glm::dvec2(at) / at.z;
    if (at.z > 0 && glm::all(glm::greaterThanEqual(pixel, glm::dvec2(0)))
        && glm::all(glm::lessThanEqual(pixel, glm::dvec2(view.view.size))))
        return pixel;
    return {};
}

bool shows(const CompiledView& view, const glm::dvec3& direction) { return pixel_of(view, direction).has_value(); }

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

/// The views of a layout, grouped by the eyes that look at them, for the share of a panel that each eye sees.
class PanelSight {
public:
    PanelSight(const Layout& layout, std::span<const std::vector<CompiledView>> views)
        : views_(views)
    {
        for (std::size_t output = 0; output < views.size(); ++output)
            for (const CompiledView& view : views[output])
                if (!layout.outputs[output].preview)
                    group(view.view).views.push_back({&view, &layout.outputs[output]});
        const bool two_eyes = std::ranges::any_of(groups_, [](const Group& group) { return group.eye != Eye::middle; });
        std::erase_if(groups_, [&](const Group& group) { return two_eyes && group.eye == Eye::middle; });
    }

    /// The part of the panel, `scale` times as large as it is, that is seen by those who see its middle; 0 where an eye sees
    /// nothing of it. 1 means all of it.
    double share(const HudPlacement& hud, double scale) const
    {
        constexpr int across = 17, high = 5;
        const glm::dvec2 half = scale * std::tan(0.5 * hud.width_deg * degree) * glm::dvec2(1, panel_aspect);
        const glm::dmat3 cockpit_from_panel = glm::inverse(panel_from_cockpit(hud, views_));
        const glm::dvec3 middle = panel_middle(hud);
        double least = groups_.empty() ? 0 : 1;
        for (const Group& group : groups_) {
            if (!others_see(group, middle) || group.shows(middle)) {
                int seen = 0;
                for (int i = 0; i < across * high; ++i) {
                    const glm::dvec2 at(2.0 * (i % across) / (across - 1) - 1, 2.0 * (i / across) / (high - 1) - 1);
                    seen += group.shows(glm::normalize(cockpit_from_panel * glm::dvec3(at * half, 1)));
                }
                least = std::min(least, double(seen) / (across * high));
            }
        }
        return least;
    }

    /// True if all of the panel is seen, off the edges of flat pictures by safe_area of their extent and with some room
    /// around it elsewhere, and it takes no more of the picture than it may.
    bool fits(const HudPlacement& hud) const
    {
        constexpr double room = 1.02; // around the panel, so that its edge is not the picture's
        constexpr int least_high = 7; // of the picture, in halves of the panel's height
        const glm::dmat3 cockpit_from_panel = glm::inverse(panel_from_cockpit(hud, views_));
        const glm::dvec2 half = std::tan(0.5 * hud.width_deg * degree) * glm::dvec2(1, panel_aspect);
        const auto seen = [&](double x, double y) {
            return shows(glm::normalize(cockpit_from_panel * glm::dvec3(glm::dvec2(x, y) * half, 1)));
        };
        for (const double y : {-room, room}) // the corners first: most places fail there
            for (const double x : {-room, room})
                if (!seen(x, y))
                    return false;
        for (const double y : {-1.0, 1.0})
            for (const double x : {-1.0, 1.0})
                if (!is_off_edges(glm::normalize(cockpit_from_panel * glm::dvec3(glm::dvec2(x, y) * half, 1))))
                    return false;
        int high = 2;
        for (const int way : {-1, 1})
            for (int k = 1; k < least_high && seen(0, way * (1 + k)); ++k)
                ++high;
        return high >= least_high && share(hud, room) == 1;
    }

    /// True if each flat view that shows the direction shows it off its edges, or another one goes on beyond them.
    bool is_off_edges(const glm::dvec3& direction) const
    {
        return std::ranges::all_of(groups_, [&](const Group& group) { return group.is_off_edges(direction); });
    }

    /// True if some eye sees the direction, and where there are two eyes, both do.
    bool shows(const glm::dvec3& direction) const
    {
        for (const Group& group : groups_)
            if (!group.shows(direction) && !others_see(group, direction))
                return false;
        return !groups_.empty();
    }

private:
    struct Seen {
        const CompiledView* view;
        const Output* output;
    };
    /// The views that one eye of one observer has.
    struct Group {
        Eye eye;
        ViewportObserver observer;
        std::vector<Seen> views{};

        bool shows(const glm::dvec3& direction) const
        {
            return std::ranges::any_of(views, [&](const Seen& seen) {
                const auto pixel = pixel_of(*seen.view, direction);
                return pixel && !hidden(seen, *pixel);
            });
        }

        bool is_off_edges(const glm::dvec3& direction) const
        {
            return std::ranges::all_of(views, [&](const Seen& seen) {
                const auto pixel = seen.view->matrix ? pixel_of(*seen.view, direction) : std::nullopt;
                const glm::dvec2 off = safe_area * glm::dvec2(seen.view->view.size);
                return !pixel || std::ranges::all_of(sides, [&](const glm::dvec2& side) {
                    return shows(glm::normalize(*seen.view->matrix * glm::dvec3(*pixel + side * off, 1)));
                });
            });
        }

        /// True if a viewport of a higher order covers this pixel of a view.
        static bool hidden(const Seen& seen, const glm::dvec2& pixel)
        {
            const Viewport& own = seen.output->viewports[seen.view->view.viewport];
            const glm::dvec2 at
                = glm::dvec2(own.rect) + glm::dvec2(own.rect.z, own.rect.w) * pixel / glm::dvec2(seen.view->view.size);
            return std::ranges::any_of(seen.output->viewports, [&](const Viewport& other) {
                const glm::dvec2 inside = at - glm::dvec2(other.rect);
                return other.order > own.order && inside.x > 0 && inside.y > 0 && inside.x < other.rect.z
                    && inside.y < other.rect.w;
            });
        }
    };

    Group& group(const View& view)
    {
        for (Group& one : groups_)
            if (one.eye == view.eye && one.observer == view.observer)
                return one;
        return groups_.emplace_back(view.eye, view.observer);
    }

    /// True if another observer sees with the same eye a direction that this one need not see.
    bool others_see(const Group& group, const glm::dvec3& direction) const
    {
        return std::ranges::any_of(groups_,
            [&](const Group& other) { return &other != &group && other.eye == group.eye && other.shows(direction); });
    }

    std::span<const std::vector<CompiledView>> views_;
    std::vector<Group> groups_;
};

/// The best place for a layout that gives none: straight ahead if it can be, low, and as wide as it is easily read; nullopt
/// if it is whole nowhere.
std::optional<HudPlacement> found_place(const PanelSight& sight)
{
    constexpr double widest_deg = 60, usual_deg = 48, narrowest_deg = 4, narrower = 0.95;
    constexpr double low_deg = -25.7; // along the bottom of a view 60 degrees high
    constexpr double step_deg = 0.5, azimuth_step_deg = 2;
    constexpr double aside_deg = 60; // this far from straight ahead a display e times as wide is as good
    std::optional<HudPlacement> best;
    double best_score = 0;
    for (int i = 0; i * azimuth_step_deg <= 360; ++i) {
        HudPlacement place{.azimuth_deg = (i % 2 ? 1 : -1) * ((i + 1) / 2) * azimuth_step_deg};
        const auto score = [&](double width_deg) { return width_deg * std::exp(-std::abs(place.azimuth_deg) / aside_deg); };
        if (score(widest_deg) <= best_score)
            break;
        std::vector<double> seen; // the elevations of a middle, the best first: low, then above, then below
        const auto add = [&](double elevation_deg) {
            place.elevation_deg = elevation_deg;
            if (sight.shows(panel_middle(place)))
                seen.push_back(elevation_deg);
        };
        for (double e = low_deg; e < 89; e += step_deg)
            add(e);
        for (double e = low_deg - step_deg; e > -89; e -= step_deg)
            add(e);
        const auto find = [&](double width_deg) {
            for (const double elevation : seen) {
                place.elevation_deg = elevation, place.width_deg = width_deg;
                HudPlacement left = place, right = place;
                left.azimuth_deg -= width_deg, right.azimuth_deg += width_deg;
                if (width_deg > usual_deg && !(sight.shows(panel_middle(left)) && sight.shows(panel_middle(right))))
                    continue; // a picture this narrow has the usual width
                if (sight.fits(place)) {
                    best = place, best_score = score(width_deg);
                    return true;
                }
            }
            return false;
        };
        bool found = score(widest_deg) > best_score && find(widest_deg);
        for (double width = usual_deg; !found && width > narrowest_deg && score(width) > best_score; width *= narrower)
            found = find(width);
    }
    return best;
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

HudPlacement placed_hud(
    const Layout& layout, std::span<const glm::ivec2> sizes, std::span<const std::vector<CompiledView>> views)
{
    const PanelSight sight(layout, views);
    bool reshaped = false;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const glm::dvec2 own(layout.outputs[i].size), now(sizes[i]);
        reshaped = reshaped || std::abs(now.x * own.y - now.y * own.x) > 1.5 * std::max(own.x, own.y);
    }
    if (layout.hud && (!reshaped || sight.share(*layout.hud, 1) == 1))
        return *layout.hud;
    return found_place(sight).value_or(layout.hud.value_or(HudPlacement{}));
}

std::string hud_warning(const Layout& layout, const HudPlacement& hud, std::span<const std::vector<CompiledView>> views)
{
    const double seen = PanelSight(layout, views).share(hud, 0.99);
    if (seen == 1)
        return "";
    return "the head-up display, " + short_number(hud.width_deg) + "° wide at azimuth " + short_number(hud.azimuth_deg)
        + "° and elevation " + short_number(hud.elevation_deg) + "°, is "
        + (seen == 0 ? "seen nowhere" : "cut: " + short_number(std::floor(1000 * seen) / 10) + " % of it are seen")
        + (layout.hud ? "; without \"hud\" the program finds a place where it is whole"
                      : "; no place was found where it is whole, and \"hud\" sets one");
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

bool is_seen_whole(
    const glm::dmat3& panel_from_cockpit, const glm::dvec2& half, std::span<const std::vector<CompiledView>> views)
{
    return corners_shown(panel_from_cockpit, half, views) == 4;
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
