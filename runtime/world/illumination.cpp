#include "illumination.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "shaders/shared_structs.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double luminance[3] = {0.2126, 0.7152, 0.0722}; // Rec. 709

bool any(const World& world, bool (*is)(const Material&))
{
    return std::any_of(world.materials.begin(), world.materials.end(), is);
}

ReflectanceSets sets_of(const World& world)
{
    ReflectanceSets all{{{}}, {"the base colours"}, {},
        any(world, [](const Material& m) { return m.ultraviolet.has_value(); }),
        any(world, [](const Material& m) { return m.infrared.has_value(); })};
    for (int c = 0; c < columns_of_a_set; ++c) {
        if ((c == 3 && !all.ultraviolet) || (c == 4 && !all.infrared))
            continue;
        // Beyond the visible a colour has the mean of red, green and blue, unless some material has values of its own.
        glm::dvec3 rgb(0);
        if (c < 3)
            rgb[c] = 1;
        const double uv = c == 3        ? 1
            : c < 3 && !all.ultraviolet ? 1.0 / 3
                                        : 0,
                     ir = c == 4     ? 1
            : c < 3 && !all.infrared ? 1.0 / 3
                                     : 0;
        SurfaceReflectance one{[=](double nm) { return base_reflectance(rgb, uv, ir, nm); }, {}};
        one.columns[c] = 1;
        all.sets[0].push_back(std::move(one));
    }
    for (const Material& material : world.materials) {
        all.of_material.push_back(material.reflectance.empty() ? 0 : all.sets.size());
        if (!material.reflectance.empty()) {
            all.sets.push_back({{Reflectance{material.reflectance}, {luminance[0], luminance[1], luminance[2], 0, 0}}});
            all.names.push_back(material_name(material));
        }
    }
    return all;
}

/// The kinds of light that meet each set: [set][kind].
using Meetings = std::vector<std::vector<bool>>;
Meetings meetings_of(const World& world, const SceneFile& scene, const ReflectanceSets& sets, const LightKinds& light)
{
    Meetings meet(sets.sets.size(), std::vector<bool>(light.kinds.size(), false));
    for (const Instance& instance : world.instances) {
        const std::size_t index = std::size_t(world.primitives[instance.primitive].material);
        const Material& material = world.materials[index];
        std::vector<bool>& met = meet[sets.of_material[index]];
        std::vector<bool>& met_white = meet[material.gloss ? 0 : sets.of_material[index]]; // highlights are white
        // Ambient light, an unlit surface's light, and a colour that is emitted in no other spectrum are sunlight.
        if (material.unlit || scene.ambient != glm::dvec3(0) || material.gloss
            || (material.emissive != glm::vec3(0) && !material.emission))
            met[0] = met_white[0] = true;
        for (std::size_t lamp = 0; lamp < world.lamps.size() && !material.unlit; ++lamp) {
            const LampKinds& kinds = light.lamps[world.lamps[lamp].light][std::size_t(instance.frame)];
            for (std::vector<bool>* set : {&met, &met_white})
                if (world.lamps[lamp].frame == instance.frame)
                    (*set)[std::size_t(kinds.kind)] = true;
                else
                    std::fill_n(set->begin() + kinds.first_shift, kinds.shifts, true);
        }
    }
    if (scene.sky.has_colour() || scene.milky_way() > 0)
        meet[0][0] = true;
    return meet;
}

std::vector<ReflectedSpectrum> reflected_spectra(
    const ReflectanceSets& sets, const std::vector<LightKind>& kinds, const Meetings& meet)
{
    std::vector<ReflectedSpectrum> all;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        for (std::size_t set = 0; set < sets.sets.size() && !kinds[kind].is_line(); ++set)
            for (std::size_t i = 0; i < sets.sets[set].size() && meet[set][kind]; ++i)
                all.push_back({set, i, kind});
    if (all.empty()) // nothing is lit: a basis has at least one spectrum
        for (std::size_t i = 0; i < sets.sets[0].size(); ++i)
            all.push_back({0, i, 0});
    return all;
}

void add_once(std::vector<Emission>& all, const Emission& emission)
{
    if (std::find(all.begin(), all.end(), emission) == all.end())
        all.push_back(emission);
}

/// Every emission once, in the order in which they are met.
std::vector<Emission> own_emissions(const World& world, const SceneFile& scene, const std::vector<LightKind>& kinds)
{
    std::vector<Emission> own;
    for (const LightKind& kind : kinds)
        if (kind.is_line())
            add_once(own, shifted_line(kind));
    for (const Material& material : world.materials) {
        if (material.temperature_K > 0)
            add_once(own, BlackBody{material.temperature_K});
        if (material.emission)
            add_once(own, *material.emission);
    }
    if (scene.sky.temperature_K > 0)
        add_once(own, BlackBody{scene.sky.temperature_K});
    if (own.size() > MAX_OWN)
        throw InputError(scene.gltf.string(), "",
            "has, with its lights and its sky, " + std::to_string(own.size())
                + " different spectra of glows, of emissions and of lines; at most " + std::to_string(MAX_OWN)
                + " is right");
    return own;
}

std::string name_of(const std::optional<Emission>& light) { return light ? lamp_name(*light) : "sunlight"; }

} // namespace

std::string material_name(const Material& material) { return "material \"" + one_line(material.name, 60) + '"'; }

Illumination illumination_of(const World& world, const SceneFile& scene)
{
    Illumination all;
    all.sets = sets_of(world);
    const int most = MAX_MATRICES / (int(all.sets.sets.size()) * MAX_GROUPS * columns_of_a_set);
    all.light = light_kinds(world, scene, most);
    all.reflected = reflected_spectra(all.sets, all.light.kinds, meetings_of(world, scene, all.sets, all.light));
    all.own = own_emissions(world, scene, all.light.kinds);
    return all;
}

std::vector<Spectrum> spectra_of(const Illumination& light)
{
    std::vector<Spectrum> spectra;
    for (const ReflectedSpectrum& one : light.reflected)
        spectra.push_back([spectrum = spectrum_of(light.light.kinds[one.kind]),
                              reflectance = light.sets.sets[one.set][one.reflectance].at](
                              double nm) { return spectrum(nm) * reflectance(nm); });
    return spectra;
}

std::vector<double> importance_of(const Illumination& light)
{
    constexpr double one_of_many = 0.2;
    std::vector<double> of_kind(light.light.kinds.size(), 1.0);
    for (const auto& frames : light.light.lamps)
        for (const LampKinds& lamp : frames)
            for (int k = 0; k < lamp.shifts && lamp.shifts > 1; ++k)
                of_kind[std::size_t(lamp.first_shift + k)] = one_of_many;
    std::vector<double> importance;
    for (const ReflectedSpectrum& one : light.reflected)
        importance.push_back(of_kind[one.kind]);
    return importance;
}

std::string name_of(const Illumination& light, const ReflectedSpectrum& spectrum)
{
    const LightKind& kind = light.light.kinds[spectrum.kind];
    std::string name = light.sets.names[spectrum.set] + " under " + name_of(kind.light);
    if (kind.D != 1)
        name += " shifted by D = " + shown(std::round(100 * kind.D) / 100);
    return name;
}

} // namespace starbow
