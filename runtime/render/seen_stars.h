#pragma once
#include "gpu_world.h"
#include "runtime/plan/star_cull.h"

namespace starbow {

/// The stars as they stand around the ship. They have depth: for whoever has flown light-years, they stand elsewhere. The
/// processor places them in double, and only when the ship has moved so far that it shows.
class SeenStars {
public:
    SeenStars(Device& device, const GpuWorld& world);

    bool on() const { return !field_.stars.empty() || globes_; }
    /// Makes the entries for an eye at a place in the world, scene units: to 0.02 seconds of arc, or exactly. The device
    /// must have finished the frame before.
    void follow(const EyeEvent& eye, bool exactly);

    /// The globes' run of the entries, after the stars.
    StarRun globes() const { return {std::uint32_t(field_.stars.size()), globes_ ? std::uint32_t(globes_->count()) : 0}; }
    std::span<const StarPatch> patches() const { return patches_; }
    const Buffer& entries() const { return entries_; } ///< StarEntry each; null without stars

private:
    const StarField& field_;
    const GpuGlobes* globes_; ///< null: none
    std::optional<glm::dvec3> eye_; ///< for which the entries are; nullopt: none yet
    double nearest_ = 0; ///< distance of the nearest star, scene units
    std::vector<shared::StarEntry> stars_, seen_globes_; ///< as in `entries_`, which is slow to read
    Buffer entries_;
    std::vector<StarPatch> patches_;
};

} // namespace starbow
