#pragma once
#include "displays/compile/compiled_view.h"
#include <span>
#include <string>

namespace starbow {

/// The panel's axes from the cockpit's: x right and y up on the panel, z = 1 on its plane, the origin at its middle. On a
/// flat screen the panel is parallel to the screen, so that its lines stay level; elsewhere it faces the visitor. views: of
/// each output.
glm::dmat3 panel_from_cockpit(const HudPlacement& hud, std::span<const std::vector<CompiledView>> views);

/// The part of a flat picture's width and height, at each of its edges, that a found placement leaves free: frames, curtains
/// and televisions' overscan hide the outermost rows.
constexpr double safe_area = 0.05;

/// The head-up display's placement: the layout's own, or one that is found from its views. Found ones are seen whole, by
/// both eyes and by each observer who sees the middle; they are straight ahead if that can be, low in the picture, 48
/// degrees wide, 60 on domes and walls at least 120 degrees wide, and narrower in narrow pictures. A layout's own placement
/// is used as it is while the outputs have the layout's shape; in a window of another shape, where it would be cut, one is
/// found. sizes: of the outputs, pixels. views: of each output. Where nothing fits: the layout's own, or the default one.
HudPlacement placed_hud(
    const Layout& layout, std::span<const glm::ivec2> sizes, std::span<const std::vector<CompiledView>> views);

/// A line of warning about a placement that is not seen whole, or "".
std::string hud_warning(const Layout& layout, const HudPlacement& hud, std::span<const std::vector<CompiledView>> views);

/// The placement of the instruments' panel. It lies opposite the head-up display, its far edge where the display's would
/// be. If it would not be seen whole there, it lies right above the display, or right below. It never covers the display.
/// aspect: height over width. views: of each output; empty: as if all directions were seen.
HudPlacement instruments_place(const HudPlacement& hud, double aspect, std::span<const std::vector<CompiledView>> views);

/// True if each corner of a panel is seen in some view. half: its extent on its plane z = 1.
bool is_seen_whole(
    const glm::dmat3& panel_from_cockpit, const glm::dvec2& half, std::span<const std::vector<CompiledView>> views);

/// A box around all pixels that may show a panel of half the extent `half` on its plane z = 1.
PixelBox panel_box(const ConeHierarchy& cones, const glm::dmat3& panel_from_cockpit, const glm::dvec2& half);

} // namespace starbow
