#pragma once
#include "device.h"
#include <span>

namespace starbow {

/// How often a draw's shaders ran. A device counts fragments in blocks: llvmpipe in those of 4x4, hidden ones too, so that
/// its figures for small and for hidden triangles are too large.
struct DrawInvocations {
    vk::Pipeline pipeline;
    std::uint64_t vertex = 0, fragment = 0;
};

/// Counts how often the shaders of a frame run, draw by draw. The device was opened with Options::invocations, and no other
/// thread records for it meanwhile.
class InvocationCounter {
public:
    explicit InvocationCounter(const Device& device);
    ~InvocationCounter();
    InvocationCounter(const InvocationCounter&) = delete;

    /// From now on each draw that the calling thread records into `commands` is counted, in all command buffers that are
    /// submitted after it. A counter counts one frame.
    void begin(vk::CommandBuffer commands);
    /// The draws in the order of their recording, once the device has finished them.
    std::vector<DrawInvocations> end();

private:
    static constexpr std::uint32_t most_draws = 4096;
    vk::raii::QueryPool queries_;
};

} // namespace starbow
