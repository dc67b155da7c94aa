#pragma once
#include <array>
#include <cstdint>
#include <vulkan/vulkan.hpp>

namespace starbow {

class Device;

/// Counts of calls of Vulkan, taken in Vulkan's table of functions, so that no pass can be forgotten.
struct CommandCounts {
    enum Kind {
        submits,
        command_buffers, ///< that are submitted
        passes, ///< renderings
        barriers,
        draws,
        pipeline_binds,
        descriptor_binds,
        pushes, ///< of constants
        states, ///< dynamic ones: viewports, scissors, cull modes, line widths and the like, and buffers of vertices and
                ///< indices
        uploaded_bytes, ///< that the processor writes into mapped buffers
        kinds
    };
    std::array<std::uint64_t, kinds> of{};
};

/// For tables, and for a trace's curves.
inline constexpr std::array<const char*, CommandCounts::kinds> command_count_names = {"submits", "command buffers", "passes",
    "barriers", "draws", "pipeline binds", "descriptor binds", "pushes", "states", "uploaded bytes"};

/// From now on the calls for this device are counted, those that record until another device is opened. It must not be in
/// use by another thread meanwhile. Without this, calls cost nothing more, and uploaded bytes alone are counted.
void count_commands(const Device& device);

/// All counts of the calling thread so far; a frame's are the difference of two.
const CommandCounts& command_counts();
CommandCounts operator-(const CommandCounts& later, const CommandCounts& earlier);

void count_upload(std::uint64_t bytes);

/// Follows the draws of one thread.
class DrawObserver {
public:
    virtual void before_draw(vk::CommandBuffer commands, vk::Pipeline bound) = 0;
    virtual void after_draw(vk::CommandBuffer commands) = 0;

protected:
    ~DrawObserver() = default;
};
/// From now on `observer` follows the draws that the calling thread records; null: nobody does. count_commands() comes
/// before it.
void observe_draws(DrawObserver* observer);

} // namespace starbow
