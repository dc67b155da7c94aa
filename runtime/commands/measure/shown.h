#pragma once
#include "config/model/layout.h"
#include "config/model/shot.h"
#include "runtime/render/device.h"
#include <filesystem>
#include <string>
#include <vector>

namespace starbow {

/// A shot and its scene's file.
struct ShotInScene {
    std::string name;
    Shot shot;
    std::filesystem::path scene;
};

/// Prints how much of a layout's picture each shot fills: the part of the pixels from which light comes, and the parts that
/// show above 13 of 255, the dimmest that is seen beside a projector's black, as an eye sees it and by the range curve. Of
/// what has light the curve shows at least four fifths. folder: for shown.md, made if it is not there; empty: printed
/// alone. shots: those of a scene one after another, so that each world is loaded once. Returns the exit status: 1 where the
/// curve shows less. Throws InputError.
int measure_shown(const std::filesystem::path& folder, const Layout& layout, const std::vector<ShotInScene>& shots,
    const Device::Options& options);

} // namespace starbow
