#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace starbow {

/// The compiler's figures of a shader, in the driver's words, with a table's title; least_is_worst: the more, the better.
struct ShaderFigure {
    const char *title, *figure;
    bool least_is_worst = false;
};
constexpr std::array<ShaderFigure, 7> shader_figures{
    {{"instructions", "Instructions"}, {"cycles", "Inverse Throughput"}, {"latency", "Latency"}, {"loads", "Loads"},
        {"VGPRs", "VGPRs"}, {"waves", "Subgroups per SIMD", true}, {"spills", "Spilled VGPRs"}}};
constexpr std::size_t cycles_figure = 1;

/// A shader of a pipeline and its figures, in the order of shader_figures. pass: such as "warp" or "warp, vertex". variant:
/// its constants and its target.
struct ShaderCost {
    std::string pass, variant;
    std::array<double, shader_figures.size()> figures{};
};

/// The costs on one card.
struct ShaderCosts {
    std::string card; ///< as its driver names it
    std::vector<ShaderCost> shaders; ///< by pass, then by cycles, the most first
};

/// The costs of all pipelines that these scenes reach in windows, domes and stereo pairs, in the qualities `balanced` and
/// `fine`, at each speed and with each switch, on a card that need not be there: Mesa compiles for any of AMD's families.
/// scenes: files. family: one of card_families. only: a pass; empty: all. Shows its progress. Afterwards this process finds
/// no other device. Throws InputError and NoRoom.
ShaderCosts shader_costs(
    const std::vector<std::filesystem::path>& scenes, const std::string& family, const std::string& only = {});

} // namespace starbow
