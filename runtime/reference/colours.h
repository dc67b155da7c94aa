#pragma once
#include "config/model/scene_file.h"
#include "runtime/light/spectrum.h"
#include "runtime/world/world.h"
#include <array>
#include <atomic>
#include <functional>
#include <memory>

namespace starbow {

/// The colour of some light as a function of its shift D, Rec. 709 linear. It is summed over wavelengths at its first use,
/// and kept. There are 1024 steps an octave with linear interpolation. It is accurate to 1e-5, and to 2e-4 where a black
/// body is so cold that its light is gone. Several threads may call it.
class ByShift {
public:
    using Sum = std::function<void(double D, glm::dvec3* seen)>;
    /// seen: the sum for `colours` colours. kept: false: sum anew each time, for spectra with edges.
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

    /// The kind of a light on surfaces: sunlight, or a lamp's own spectrum, that arrives shifted by D.
    struct Kind {
        std::optional<Emission> light;
        double D = 1;
        bool operator==(const Kind&) const = default;
    };
    /// Prepares a kind whose D is always the same. No other thread may use the object meanwhile.
    std::size_t kind(const Kind& kind);
    static constexpr std::size_t sunlight = 0;

    /// The colour, seen at D, of a surface of base colour `base` under a light of the colour `light` and that kind.
    glm::dvec3 lit(int material, std::size_t kind, const glm::dvec3& base, const glm::dvec3& light, double D) const;
    /// The same for a kind that is not prepared: summed on the spot.
    glm::dvec3 lit(int material, const Kind& kind, const glm::dvec3& base, const glm::dvec3& light, double D) const;
    /// The colour of a surface's own light: its glow and the colour `emitted` of its emission.
    glm::dvec3 sent(int material, const glm::dvec3& emitted, double D) const;
    /// The colour of the sky, where its sunlit colour is `colour`.
    glm::dvec3 sky(const glm::dvec3& colour, double D) const;
    /// The colour of a star: a black body's surface that has luminance 1 at rest.
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
    std::vector<int> set_; ///< by material: its set of a kind's reflectances; 0: base colours
    std::vector<int> material_of_set_;
    std::vector<std::vector<std::unique_ptr<ByShift>>> seen_; ///< [kind][set]
    std::vector<std::unique_ptr<ByShift>> emissions_, glows_; ///< by material, null where it has none
    std::vector<double> amounts_; ///< of the emissions, with the energy of sunlit_white
    std::unique_ptr<ByShift> sky_glow_;
};

} // namespace starbow
