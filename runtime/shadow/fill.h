#pragma once
#include "occluders.h"
#include "runtime/world/shadows.h"
#include "still_things.h"
#include <functional>

namespace starbow {

/// The maps that the scene's lamps get, the directional ones first. size: of a map; layers: the number of maps in all.
std::vector<ShadowMap> maps_of(const SceneFile& scene, const Boxes& boxes, int& size, int& layers);

/// Fills a lamp's maps. progress: from `from` to `to`.
void fill_map(Shadows& shadows, const ShadowMap& map, const Occluders& occluders,
    const std::function<void(double)>& progress, double from, double to);

/// Fills the grid of the sky's visible part, around most things. progress: from `from` to 1.
void fill_sky(Shadows& shadows, const Boxes& boxes, const Occluders& occluders, const std::function<void(double)>& progress,
    double from);

} // namespace starbow
