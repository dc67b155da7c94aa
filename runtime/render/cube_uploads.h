#pragma once
#include "gpu_world.h"
#include "runtime/plan/cube_map_plan.h"
#include "runtime/plan/cull.h"

namespace starbow {

/// The data that the cube pass reads on the device in one frame, and the descriptor set that holds it.
class CubeUploads {
public:
    CubeUploads(Device& device, const Pipelines& pipelines, const GpuWorld& world);

    /// Writes the frame's data. Every stored radiance is multiplied by pre_exposure. skies: which the cube pass draws as
    /// instances. eye_events: the eye events of the rest frames. The device must have finished the frame before.
    void write(const DrawList& list, const std::vector<shared::SkyImage>& skies, std::span<const EyeEvent> eye_events,
        StoredLight light, double pre_exposure);
    void write_tile_table(const CubeMapPlan& plan);

    /// Binds the set with the constants of one rest frame.
    void bind(vk::CommandBuffer commands, int rest_frame) const;

    /// Of DrawList::sorted_indices.
    vk::Buffer sorted_indices() const { return *sorted_indices_.buffer; }
    /// DrawList::draws as vk::DrawIndexedIndirectCommand each.
    vk::Buffer draw_commands() const { return *draw_commands_.buffer; }

    vk::BufferView tiles() const { return *tiles_view_; } ///< TileTable, as texels
    std::uint64_t tiles_serial() const { return tiles_.serial; }

private:
    shared::CubeConstants constants_of(const EyeEvent& eye_event, StoredLight light, double pre_exposure) const;
    void write_shadows(shared::CubeConstants& constants, const EyeEvent& eye_event) const;
    void write_draws(const DrawList& list, double pre_exposure);
    void write_set(const Buffer& columns);

    Device& device_;
    const Pipelines& pipelines_;
    const GpuWorld& world_;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::DescriptorSet set_ = nullptr;
    Buffer constants_, instances_, visible_, draws_, surfaces_, draw_commands_, skies_, tiles_;
    Buffer times_, sorted_indices_; ///< null without any
    vk::raii::BufferView tiles_view_ = nullptr;
    vk::DeviceSize stride_; ///< bytes from one rest frame's constants to the next
    // Members so that their memory is reused.
    std::vector<shared::TimeEntry> time_writes_;
    std::vector<shared::DrawEntry> draw_writes_;
    std::vector<vk::DrawIndexedIndirectCommand> command_writes_;
    std::vector<shared::SurfaceEntry> surface_writes_;
    std::array<std::uint64_t, 8> written_{}; ///< serials of the buffers that set_ holds
};

} // namespace starbow
