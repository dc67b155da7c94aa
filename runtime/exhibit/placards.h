#pragma once
#include "runtime/hud/signs.h"
#include "runtime/render/inset.h"
#include "session.h"

namespace starbow {

/// The things that are laid over the picture beside the head-up display: a sign at a thing, and the small picture with its
/// name. Lost with the device.
class Placards {
public:
    Placards(Device& device, Pipelines& pipelines)
        : device_(device)
        , pipelines_(pipelines)
    {
    }

    /// Makes what the session shows now, for the next frame of `frame`. shot: of that frame. Records the small picture into
    /// `commands`. The device must have finished the frame before.
    void prepare(vk::CommandBuffer commands, const Session& session, const Shot& shot, const GpuWorld& world,
        FrameRenderer& frame, const Quality& quality, const Typesetter& typesetter);
    /// Another world, layout or quality.
    void forget();

private:
    std::span<const AlignedBox> things_in(const Session& session, const GpuWorld& world);
    void add_sign(const Session& session, const Shot& shot, const GpuWorld& world, const ViewSet& views, double degree_px,
        const Typesetter& typesetter);
    void add_inset(vk::CommandBuffer commands, const Session& session, const Shot& shot, const GpuWorld& world,
        const ViewSet& views, const Quality& quality, double degree_px, const Typesetter& typesetter);

    Device& device_;
    Pipelines& pipelines_;
    std::optional<std::vector<AlignedBox>> things_; ///< of a world without a pace; nullopt: not read yet
    std::optional<Sign> sign_;
    std::vector<std::string> sign_lines_;
    Panel sign_panel_, name_panel_;
    std::string name_;
    std::unique_ptr<Inset> inset_; ///< null while there is no small picture
    bool no_room_ = false; ///< for the small picture
    std::vector<Placard> placards_;
};

} // namespace starbow
