#pragma once
#include "config/model/adjust.h"

namespace starbow {

/// The direction in the cockpit of the handle that a number moves: where its viewport would show it if nobody had pulled the
/// picture, for the left eye where it shows two. nullopt for a number that moves no handle, where nothing is shown there,
/// and in a viewport with a calibration's file, which says itself what is shown where.
std::optional<glm::dvec3> handle_direction(const Layout& layout, const Adjustable& number);

} // namespace starbow
