#pragma once
#include "device.h"
#include <array>
#include <map>

namespace starbow {

/// Families of AMD's cards as RADV_FORCE_FAMILY names them in Mesa 22.3.
/// vangogh stands for all processors with graphics of its generation, RDNA 2; with rembrandt, another of them, Mesa 22.3
/// divides by zero.
constexpr std::array<const char*, 5> card_families{"navi21", "polaris10", "vega10", "vangogh", "gfx1100"};

/// Opens a graphics card that is not there: RADV, Mesa's driver for AMD's cards, compiles shaders for each of its families
/// without one. Pipelines can be made, and nothing drawn, for the card has no memory. It chooses the driver of the whole
/// process by the loader's environment variables, so nothing else should open a device afterwards. family: one of
/// card_families. Throws InputError where the driver is missing.
std::unique_ptr<Device> open_absent_card(const std::string& family);

/// The compiler's figures of a pipeline's stage, by the driver's names, such as "Instructions", "VGPRs" and "Inverse
/// Throughput", and "Loads": its instructions that read images or buffers. The device was opened with Options::statistics.
std::map<std::string, double> shader_statistics(const Device& device, vk::Pipeline pipeline, vk::ShaderStageFlagBits stage);

} // namespace starbow
