#pragma once
#include "runtime/hud/signs.h"
#include "runtime/machines/picture_state.h"
#include "session.h"

namespace starbow {

/// The inset of a kind that is not `none`. start_ev: as inset_shot()'s. telescope_deg: the telescope's field in the
/// frame before, and then in this one; 0: none.
InsetPicture inset_picture(InsetView kind, const Shot& shot, double start_ev, double& telescope_deg, const Words& words);

/// Adds the sky's names and the constellations' lines to a picture, whose shot is known.
void name_sky(const GpuWorld& world, const std::string& language, PictureState& now);

/// Chooses the things that are laid over the picture beside the head-up display: a sign at a thing, a tour's title and
/// marks, and the inset with its name.
class Callouts {
public:
    /// Adds to a picture, whose shot is known, what the session shows in it.
    void choose(const Session& session, const GpuWorld& world, PictureState& now);
    /// Another world, layout or quality.
    void forget() { things_.reset(), sign_.reset(); }

private:
    void show_step(const TourPlayer& tour, const GpuWorld& world, PictureState& now);
    std::span<const AlignedBox> things_in(const Session& session, const GpuWorld& world);

    std::optional<std::vector<AlignedBox>> things_; ///< of a world without a pace; nullopt: not read yet
    std::optional<Sign> sign_;
    double telescope_deg_ = 0; ///< the telescope's field; 0: none
    std::array<double, 2> enlarged_deg_{}; ///< as shown_highlights has it
};

} // namespace starbow
