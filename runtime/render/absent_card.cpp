#include "absent_card.h"
#include "config/json/error.h"
#include <cstdlib>
#include <filesystem>

namespace starbow {
namespace {

/// The number of a stage's instructions that read images or buffers for each pixel or vertex of its own.
int loads(const Device& device, const vk::PipelineExecutableInfoKHR& stage)
{
    auto texts = device.device.getPipelineExecutableInternalRepresentationsKHR(stage); // their sizes
    std::vector<std::string> room(texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
        room[i].resize(texts[i].dataSize);
        texts[i].pData = room[i].data();
    }
    auto count = std::uint32_t(texts.size());
    device.device.getDispatcher()->vkGetPipelineExecutableInternalRepresentationsKHR(VkDevice(*device.device),
        reinterpret_cast<const VkPipelineExecutableInfoKHR*>(&stage), &count,
        reinterpret_cast<VkPipelineExecutableInternalRepresentationKHR*>(texts.data()));
    int found = 0;
    for (std::size_t i = 0; i < texts.size(); ++i)
        if (std::string_view(texts[i].name) == "ACO IR")
            for (const char* load : {"= image_sample", "= image_gather4", "= image_load", "= buffer_load", "= global_load"})
                for (std::size_t at = room[i].find(load); at != std::string::npos; at = room[i].find(load, at + 1))
                    ++found;
    return found;
}

Device::Options options_of_absent_card() { return {.statistics = true, .name = "Null hardware"}; }

/// A family by the driver's own name, which ends the process for one that it does not know. The driver's variables are set.
std::string name_in_driver(const std::string& family)
{
    if (family != "gfx1100")
        return family;
    setenv("RADV_FORCE_FAMILY", "navi21", 1); // a name of all versions
    const bool renamed = Device(options_of_absent_card()).properties.driverVersion >= VK_MAKE_API_VERSION(0, 23, 0, 0);
    return renamed ? "navi31" : family;
}

} // namespace

std::unique_ptr<Device> open_absent_card(const std::string& family)
{
    const std::filesystem::path folder = "/usr/share/vulkan/icd.d";
    std::string driver;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none))
        if (entry.path().filename().string().starts_with("radeon_icd"))
            driver = entry.path();
    if (driver.empty())
        throw InputError(folder.string() + ": has no radeon_icd; the package mesa-vulkan-drivers is right");
    setenv("VK_DRIVER_FILES", driver.c_str(), 1);
    setenv("VK_ICD_FILENAMES", driver.c_str(), 1); // the same for loaders before 1.3.207
    setenv("RADV_FORCE_FAMILY", name_in_driver(family).c_str(), 1);
    return std::make_unique<Device>(options_of_absent_card());
}

std::map<std::string, double> shader_statistics(const Device& device, vk::Pipeline pipeline, vk::ShaderStageFlagBits stage)
{
    using Format = vk::PipelineExecutableStatisticFormatKHR;
    const auto parts = device.device.getPipelineExecutablePropertiesKHR({pipeline});
    std::map<std::string, double> all;
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        if (!(parts[i].stages & stage))
            continue;
        for (const auto& one : device.device.getPipelineExecutableStatisticsKHR({pipeline, i}))
            all[one.name] = one.format == Format::eBool32 ? double(one.value.b32)
                : one.format == Format::eInt64            ? double(one.value.i64)
                : one.format == Format::eUint64           ? double(one.value.u64)
                                                          : one.value.f64;
        all["Loads"] = loads(device, {pipeline, i});
    }
    return all;
}

} // namespace starbow
