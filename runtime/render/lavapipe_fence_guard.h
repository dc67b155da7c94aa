#pragma once
#include <vulkan/vulkan_raii.hpp>

namespace starbow {

/// Keeps the fences of lavapipe's scenes alive until no thread uses them any more.
///
/// llvmpipe draws each rendering as a scene, and the last thread of its rasterizer signals the scene's fence under the
/// fence's mutex. Mesa 22.3 reads the signal without that mutex, and may so free the fence while the rasterizer still
/// unlocks it; the unlock then writes into memory that belongs to something else. A query holds a reference to the fence
/// of the scene in which it ended. Each rendering therefore ends queries of a ring, and its fence lives until the ring
/// comes round. tests/rig/early_free.c shows the fault and its absence.
class LavapipeFenceGuard {
public:
    explicit LavapipeFenceGuard(const vk::raii::Device& device);

    /// Before a rendering that is so many scenes at most: frees queries from the scenes of a ring ago. The commands that
    /// free them are in the same buffer as those that use them, because a recorded buffer may never be submitted.
    void begin(vk::CommandBuffer commands, std::uint32_t scenes);
    /// Within a rendering, after begin: a query takes the fence of the present scene, and so begins one where the rendering
    /// has only cleared so far.
    void hold(vk::CommandBuffer commands);

private:
    static constexpr std::uint32_t most = 4096; ///< queries; a frame needs some twenty to two hundred
    vk::raii::QueryPool queries_;
    std::uint32_t next_ = 0, end_ = 0; ///< the queries that the present rendering may still use
};

} // namespace starbow
