#pragma once
#include <array>
#include <filesystem>
#include <string>

namespace starbow {

/// The displays that bench_card() times, by name.
constexpr std::array card_displays = {"window", "dome-4096", "dome-8192", "walls", "eyes"};

/// Times the avenue on this device: each display at rest, gamma 4 and 100, in `balanced` and in `fine`, whole and pass by
/// pass by the device's clock; without a display's name also the frame's stages beside a plain picture. Writes card.json,
/// card.html and trace.json into the folder, the first after each measurement. Results of Google Test that are there
/// already, tests-*.json, are on the page, too. rounds: frames of each measurement at most; slow ones take fewer. Throws
/// InputError.
void bench_card(const std::filesystem::path& folder, const std::string& display, int rounds);

} // namespace starbow
