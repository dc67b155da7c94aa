#pragma once
#include "light_kinds.h"
#include <functional>

namespace starbow {

constexpr int columns_of_a_set = 5; ///< red, green, blue, ultraviolet, infrared

/// A reflectance that surfaces have in some amount, and its factors in the columns of a set.
struct SurfaceReflectance {
    std::function<double(double nm)> at;
    double columns[columns_of_a_set];
};

/// The reflectances of each set: first those of base colours, then one for each material with a reflectance of its own,
/// which the base colour's luminance scales.
struct ReflectanceSets {
    std::vector<std::vector<SurfaceReflectance>> sets;
    std::vector<std::string> names; ///< of the sets, with an article: "the base colours", "material ..."
    std::vector<std::size_t> of_material; ///< the set of each material
    bool ultraviolet = false, infrared = false; ///< whether a base colour has values of its own there
};

/// A spectrum that surfaces reflect: a reflectance of a set under a kind of light that is no line.
struct ReflectedSpectrum {
    std::size_t set, reflectance, kind;
};

/// Light as the surfaces of a world meet it, in no more parts than its scene requires.
struct Illumination {
    ReflectanceSets sets;
    LightKinds light;
    std::vector<ReflectedSpectrum> reflected; ///< at least one
    std::vector<Emission> own; ///< emissions and lines, each once, in the order in which they are met
};

/// world: after place_bodies. Throws InputError as light_kinds does, and for more than MAX_OWN emissions and lines.
Illumination illumination_of(const World& world, const SceneFile& scene);

/// A material's name for people, after the word material.
std::string material_name(const Material& material);

/// The spectra that surfaces reflect, in the order of `reflected`.
std::vector<Spectrum> spectra_of(const Illumination& light);

/// The importance of their errors: most surfaces rest beside their lamps, and the kinds of a point lamp that passes are
/// many.
std::vector<double> importance_of(const Illumination& light);

/// A spectrum's name for people: a surface and its light.
std::string name_of(const Illumination& light, const ReflectedSpectrum& spectrum);

} // namespace starbow
