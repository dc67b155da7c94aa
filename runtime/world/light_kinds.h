#pragma once
#include "config/model/scene_file.h"
#include "runtime/light/spectrum.h"
#include "world.h"
#include <array>

namespace starbow {

/// Light that illuminates surfaces, and the D with which it reaches them.
struct LightKind {
    std::optional<Emission> light; ///< nullopt: sunlight
    double D = 1;
    bool operator==(const LightKind&) const = default;
    bool is_line() const { return light && law_of(*light).is_line(); }
};

/// The emission spectrum of a line that arrives shifted.
SpectralLine shifted_line(const LightKind& kind);

/// Spectral radiance per frequency of a kind's light on a white surface, kept as it was emitted. The kind is no line.
Spectrum spectrum_of(const LightKind& kind);

/// The kinds of a light in one rest frame. A light at rest there has one kind. A light that moves there has several kinds
/// of shifted light, evenly spaced in log2 D; the shader blends between two of them.
struct LampKinds {
    int kind = 0, first_shift = 0, shifts = 0;
    double first_log2_D = 0, per_octave = 0;
};

/// All kinds of light on a world's surfaces, the first of them sunlight, which may reach none.
struct LightKinds {
    std::vector<LightKind> kinds;
    std::vector<std::vector<LampKinds>> lamps; ///< [the scene's light][World::frames]
};

/// The kinds of all lights in all rest frames: the finest shifts with at most `most` kinds, or else the coarsest. Throws
/// InputError where a line passes surfaces that move relative to it at wavelengths that change.
LightKinds light_kinds(const World& world, const SceneFile& scene, int most);

/// The first light that shines on what moves relative to it; nullopt: none.
std::optional<std::size_t> passing_light(const World& world, const SceneFile& scene);

} // namespace starbow
