#pragma once
#include "command_counts.h"
#include "device.h"

namespace starbow {

/// How often a draw's shaders ran. A device counts fragments in blocks: llvmpipe in those of 4x4, hidden ones too, so that
/// its figures for small and for hidden triangles are too large.
struct DrawInvocations {
    vk::Pipeline pipeline;
    std::uint64_t vertex = 0, fragment = 0;
};

/// Counts how often the shaders of a frame run, draw by draw. The device was opened with Options::invocations, and no other
/// thread records for it meanwhile.
class InvocationCounter : private DrawObserver {
public:
    explicit InvocationCounter(const Device& device);
    ~InvocationCounter();
    InvocationCounter(const InvocationCounter&) = delete;

    /// From now on each draw of the calling thread is counted; `commands` is submitted before or with all of them. A
    /// counter counts one frame.
    void begin(vk::CommandBuffer commands);
    /// The draws in the order of their recording, once the device has finished them.
    std::vector<DrawInvocations> end();

private:
    void before_draw(vk::CommandBuffer commands, vk::Pipeline bound) override;
    void after_draw(vk::CommandBuffer commands) override;

    static constexpr std::uint32_t most_draws = 4096;
    vk::raii::QueryPool queries_;
    std::vector<DrawInvocations> draws_;
};

} // namespace starbow
