#pragma once
#include "reader.h"
#include "shot.h"

namespace starbow {

/// The part of a shot that its file and a scene's start share. `with_scene`: also the member "scene", which then is
/// required.
Shot read_shot(const Place& place, bool with_scene);

Effects read_effects(const Place& place);

} // namespace starbow
