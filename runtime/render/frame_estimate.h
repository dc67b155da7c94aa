#pragma once
#include "config/model/layout.h"
#include "config/model/shot.h"
#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace starbow {

/// A graphics card as its maker describes it. simds: of a compute unit 4 with 16 lanes (GCN), or 2 with 32 (RDNA).
struct NamedCard {
    const char *name, *family; ///< family: one of card_families
    double simds, clock_ghz, gigabytes_per_s;
};
constexpr std::array<NamedCard, 5> named_cards{{{"Radeon RX 6800", "navi21", 120, 2.105, 512},
    {"Radeon RX 580", "polaris10", 144, 1.340, 256}, {"Radeon RX Vega 64", "vega10", 256, 1.546, 484},
    {"Radeon 680M with DDR5-4800", "vangogh", 24, 2.4, 77}, {"Radeon RX 7900 XTX", "gfx1100", 192, 2.5, 960}}};

/// The work of one pass of a frame, and the time of its two parts, which run side by side: the arithmetic of the shaders on
/// all of the card's SIMDs, and the bytes of the targets through the card's memory.
struct PassEstimate {
    std::string pass;
    double vertices = 0, fragments = 0; ///< invocations
    double arithmetic_ms = 0, memory_ms = 0;
    double ms() const { return std::max(arithmetic_ms, memory_ms); }
};

/// Draws a frame of a layout on the present device, in the forms of shaders and the quality that a GPU has, counts its
/// invocations, and takes each pipeline's cycles from the compiler of a card that need not be there. The estimate leaves out
/// the wait for texels, the fixed cost of a pass, and the processor; where the present device is llvmpipe, the surfaces'
/// and the sky's fragments are too many. Afterwards this process finds no other device. Throws
/// InputError and NoRoom.
std::vector<PassEstimate> frame_estimate(
    const std::filesystem::path& scene, const Layout& layout, const Shot& shot, const NamedCard& card);

} // namespace starbow
