#pragma once
#include "config/model/scene_file.h"
#include "runtime/light/spectrum.h"
#include "runtime/world/world.h"
#include <array>
#include <atomic>
#include <functional>
#include <memory>

namespace starbow {

/// What is seen of some light as a function of its shift D, Rec. 709 linear: summed over wavelengths where it is asked for
/// first, and kept. 1024 steps an octave, straight between them: within 1e-5, and 2e-4 where a black body is so cold that
/// its light is gone. Safe to ask from several threads.
class ByShift {
public:
    using Sum = std::function<void(double D, glm::dvec3* seen)>;
    /// seen: so many colours. kept: false: sum anew each time, for what has edges.
    ByShift(int colours, Sum sum, bool kept = true);
    ~ByShift();
    ByShift(const ByShift&) = delete;

    void at(double D, glm::dvec3* seen) const;
    glm::dvec3 at(double D) const; ///< of one colour

private:
    const glm::dvec3* row(int i) const;
    int colours_;
    Sum sum_;
    mutable std::unique_ptr<std::atomic<const glm::dvec3*>[]> rows_;
};

/// All light of a scene as an observer sees it, with its whole spectrum.
class Colours {
public:
    Colours(const World& world, const SceneFile& scene, const StandardObserver& observer);

    /// Light of a kind that shines on surfaces: sunlight, or a lamp's own, that comes there shifted by D.
    struct Kind {
        std::optional<Emission> light;
        double D = 1;
        bool operator==(const Kind&) const = default;
    };
    /// Makes ready for a kind whose D is always the same. Not while others ask.
    std::size_t kind(const Kind& kind);
    static constexpr std::size_t sunlight = 0;

    /// What is seen at D of a surface of base colour `base` under a light of the colour `light` of that kind.
    glm::dvec3 lit(int material, std::size_t kind, const glm::dvec3& base, const glm::dvec3& light, double D) const;
    /// The same of a kind that is not made ready: summed on the spot.
    glm::dvec3 lit(int material, const Kind& kind, const glm::dvec3& base, const glm::dvec3& light, double D) const;
    /// Of what a surface sends by itself: its glow and the colour `emitted` of its emissive light.
    glm::dvec3 sent(int material, const glm::dvec3& emitted, double D) const;
    /// Of the sky, where its sunlit colour is `colour`.
    glm::dvec3 sky(const glm::dvec3& colour, double D) const;
    /// Of a point's light: a black body's surface that has luminance 1 at rest.
    glm::dvec3 star(double temperature_K, double D) const;

private:
    using Amounts = std::array<double, 5>; ///< of the three primaries, the ultraviolet and the infrared
    Amounts amounts(int material, const glm::dvec3& base, const glm::dvec3& light) const;
    std::function<double(double nm)> reflectance(int material, int part) const;
    void sum(const Kind& kind, int material, double D, glm::dvec3* seen) const;
    std::unique_ptr<ByShift> emission(const Emission& emission) const;
    int parts(int material) const;

    const World& world_;
    const StandardObserver& observer_;
    std::vector<Kind> kinds_;
    std::vector<int> set_; ///< of each material: which of a kind's reflectances, 0: base colours
    std::vector<int> material_of_set_;
    std::vector<std::vector<std::unique_ptr<ByShift>>> seen_; ///< [kind][set]
    std::vector<std::unique_ptr<ByShift>> emissions_, glows_; ///< of each material, null where it has none
    std::unique_ptr<ByShift> sky_glow_;
};

} // namespace starbow
