#pragma once
#include "runtime/hud/signs.h"
#include "runtime/render/frame_renderer.h"
#include "session.h"

namespace starbow {

/// The things that are laid over the picture beside the head-up display: a sign at a thing, and the small picture with its
/// name.
class Placards {
public:
    /// Makes what the session shows now, for the next frame of `frame`. shot: of that frame. The device must have finished
    /// the frame before.
    void prepare(
        const Session& session, const Shot& shot, const GpuWorld& world, FrameRenderer& frame, const Typesetter& typesetter);
    /// Another world, layout or quality.
    void forget();

private:
    std::span<const AlignedBox> things_in(const Session& session, const GpuWorld& world);
    void add_sign(const Session& session, const Shot& shot, const GpuWorld& world, const ViewSet& views, double degree_px,
        const Typesetter& typesetter);
    void add_inset(
        const Session& session, const Shot& shot, FrameRenderer& frame, double degree_px, const Typesetter& typesetter);

    std::optional<std::vector<AlignedBox>> things_; ///< of a world without a pace; nullopt: not read yet
    std::optional<Sign> sign_;
    std::vector<std::string> sign_lines_;
    Panel sign_panel_, name_panel_;
    std::string name_;
    double telescope_deg_ = 0; ///< the telescope's field; 0: none
    bool no_room_ = false; ///< for the small picture
    std::vector<Placard> placards_;
};

} // namespace starbow
