#pragma once
#include "runtime/images/flashes.h"
#include <filesystem>
#include <string>

namespace starbow {

/// What is drawn of one output and one eye.
struct FlashStrip {
    std::string title;
    std::vector<double> times_s;
    std::array<std::vector<int>, flash_kinds> changes; ///< at each time
    std::array<Flashes, flash_kinds> worst;
    /// The frame with the worst flashes, or of the film's middle where there are none: RGBA8, rows from the top.
    glm::ivec2 size{0};
    std::vector<std::uint8_t> frame;
    std::vector<char> flashing; ///< its pixels that belong to the worst area; empty without flashes
};

/// Writes the strips as a PNG: flashes in a second over time beside the worst frame, in which the flashing area is outlined.
void write_flash_sheet(const std::filesystem::path& file, const std::vector<FlashStrip>& strips);

} // namespace starbow
