#pragma once
#include "resources.h"
#include "runtime/world/eye_event.h"
#include "runtime/world/globe_light.h"
#include "runtime/world/globes.h"
#include "shaders/shared_structs.h"

namespace starbow {

/// A world's globes on the device.
class GpuGlobes {
public:
    /// Throws InputError where they are more than MAX_GLOBES.
    GpuGlobes(Device& device, std::shared_ptr<const Globes> globes, const GlobeSky& sky, double seconds_per_time_unit,
        double unit_m, const glm::dmat3& world_from_equatorial);

    bool have_glows() const { return !brightest_glows_.empty(); } ///< something shines above some globe's air
    int count() const { return int(globes_->system.globes.size()); }
    const Globes& globes() const { return *globes_; }

    /// The globes from an eye event in the world, the farthest first.
    struct Seen {
        std::vector<SeenGlobe> globes;
        glm::dmat3 cube_from_world; ///< turn, and without light delay the contraction
        glm::dmat3 contraction; ///< of the world's axes
    };
    Seen seen(const EyeEvent& eye) const;
    /// starbow::farthest_eye for the globes from the ship's place.
    double farthest_eye(const Seen& seen) const { return starbow::farthest_eye(globes_->system, seen.globes, unit_m_); }
    /// The world's origin at a time from the Sun's middle, scene units, world axes.
    glm::dvec3 from_sun(double time) const { return world_from_equatorial_ * origin_.at(time * seconds_) / unit_m_; }
    /// The shaders' constants of the globes that one eye sees.
    shared::GlobeConstants constants(const Seen& seen, double pre_exposure) const;
    /// The greatest light that what shines above the air has in a picture, over white; 0 where that globe is so far that it
    /// fills no pixel. E: e^rapidity.
    double brightest_glow(const Seen& seen, double E) const;
    /// Adds the Sun's glare for an observer. motion_from_world: turn; E: e^rapidity.
    void add_glare(shared::GlobeConstants& constants, const Seen& seen, const glm::dmat3& motion_from_world, double E,
        const Effects& on) const;
    /// The globes as stars, in the same order: count() entries.
    void as_stars(const Seen& seen, std::span<shared::StarEntry> entries) const;

    Image maps, fine_maps, rings;
    Image light, false_light;
    vk::raii::Sampler map_sampler = nullptr, ring_sampler = nullptr;

private:
    std::shared_ptr<const Globes> globes_;
    WorldOrigin origin_;
    double seconds_, unit_m_;
    glm::dmat3 world_from_equatorial_;
    GlobeRows rows_;
    std::vector<double> brightest_glows_; ///< brightest_glow near the globe, by E in equal ratios; empty: no glows
    std::vector<glm::vec4> light_texels_, false_texels_;
    std::vector<int> layers_; ///< of maps; -1: none
    void upload_maps(Device& device);
    void find_brightest_glows();
};

} // namespace starbow
