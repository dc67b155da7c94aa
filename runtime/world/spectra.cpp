#include "spectra.h"
#include "config/json/reader.h"
#include "illumination.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

std::size_t index_of(const SpectralBasis& basis, const Emission& emission)
{
    return std::size_t(std::find(basis.own.begin(), basis.own.end(), emission) - basis.own.begin());
}

/// The columns of all sets, one after the other: the coefficients of each reflectance under each kind of light.
std::vector<glm::vec4> columns_of(const Spectra& spectra, const Illumination& light)
{
    const auto& [sets, lamps, reflected, own] = light;
    const std::vector<LightKind>& kinds = lamps.kinds;
    const std::size_t groups = std::size_t(spectra.groups);
    std::vector<glm::vec4> columns(sets.sets.size() * kinds.size() * groups * columns_of_a_set, glm::vec4(0));
    auto add = [&](std::size_t set, std::size_t kind, const SurfaceReflectance& one, std::size_t k, double coefficient) {
        const std::size_t place = spectra.place(k);
        glm::vec4* at = &columns[((set * kinds.size() + kind) * groups + place / 4) * columns_of_a_set];
        for (int c = 0; c < columns_of_a_set; ++c)
            at[c][int(place % 4)] += float(one.columns[c] * coefficient);
    };
    const std::size_t count = std::size_t(spectra.basis.reflected);
    for (std::size_t i = 0; i < reflected.size(); ++i)
        for (std::size_t k = 0; k < count; ++k)
            add(reflected[i].set, reflected[i].kind, sets.sets[reflected[i].set][reflected[i].reflectance], k,
                spectra.basis.columns[i * count + k]);
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        for (std::size_t set = 0; set < sets.sets.size() && kinds[kind].is_line(); ++set)
            for (const SurfaceReflectance& one : sets.sets[set]) {
                // A line on a surface is a line times the reflectance there. Shifted with its radiance per frequency kept,
                // it is D times as wide.
                const SpectralLine line = shifted_line(kinds[kind]);
                add(set, kind, one, count + index_of(spectra.basis, line), kinds[kind].D * one.at(line.nm));
            }
    return columns;
}

void add_surfaces(Spectra& spectra, const World& world, const SceneFile& scene, const ReflectanceSets& sets)
{
    for (std::size_t i = 0; i < world.materials.size(); ++i) {
        const Material& material = world.materials[i];
        Spectra::Surface surface;
        surface.beyond
            = glm::vec4(material.ultraviolet.value_or(-1), material.infrared.value_or(-1), float(sets.of_material[i]), -1);
        if (!material.reflectance.empty() && material.emissive != glm::vec3(0) && !material.emission)
            throw InputError(scene.gltf.string(), material_name(material),
                "has a reflectance of its own and an emissive colour without a spectrum; an \"emission\" is right");
        if (material.emission) {
            surface.beyond.w = float(index_of(spectra.basis, *material.emission));
            surface.emission = law_of(*material.emission).sunlit_part;
            spectra.most = std::max(
                spectra.most, surface.emission * std::max({material.emissive.x, material.emissive.y, material.emissive.z}));
        }
        if (material.temperature_K > 0) {
            surface.own[int(index_of(spectra.basis, BlackBody{material.temperature_K}))] += material.emissivity;
            spectra.most = std::max(spectra.most, material.emissivity);
        }
        spectra.surfaces.push_back(surface);
    }
}

void add_sky(Spectra& spectra, const SceneFile& scene)
{
    const Sky& sky = scene.sky;
    const std::array<glm::dvec3, 6> colours = sky_colours(scene);
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const glm::dvec3& rgb = colours[i];
        const double mean = (rgb.r + rgb.g + rgb.b) / 3;
        for (int group = 0; group < MAX_GROUPS; ++group)
            spectra.sky[i][std::size_t(group)] = glm::dvec4(0);
        for (std::size_t group = 0; group < std::size_t(spectra.groups); ++group) {
            const glm::vec4* columns = &spectra.columns[group * columns_of_a_set];
            for (int c = 0; c < columns_of_a_set; ++c)
                spectra.sky[i][group] += glm::dvec4(columns[c]) * (c < 3 ? rgb[c] : mean);
        }
        if (sky.temperature_K > 0 && i < 3) { // its glow is behind the Milky Way as well
            const std::size_t place = spectra.place(
                std::size_t(spectra.basis.reflected) + index_of(spectra.basis, BlackBody{sky.temperature_K}));
            spectra.sky[i][place / 4][int(place % 4)] += 1;
            spectra.most = std::max(spectra.most, 1.0);
        }
    }
}

} // namespace

std::array<glm::dvec3, 6> sky_colours(const SceneFile& scene)
{
    const Sky& sky = scene.sky;
    const double milky = scene.milky_way();
    return {sky.zenith, sky.horizon, sky.nadir, glm::dvec3(milky, 0, 0), glm::dvec3(0, milky, 0), glm::dvec3(0, 0, milky)};
}

std::array<glm::dvec3, 3> surroundings_of(const SceneFile& scene, int frame)
{
    const Sky& sky = scene.sky;
    if (frame > 0 || !sky.has_colour())
        return {scene.ambient, scene.ambient, scene.ambient};
    return {sky.zenith, sky.horizon, sky.nadir};
}

NeededLevel needed_level(const World& world, const SceneFile& scene)
{
    const Illumination light = illumination_of(world, scene);
    NeededLevel needed{SpectralLevel::colours, int(light.reflected.size()), ""};
    while (needed.level != SpectralLevel::fine && needed.spectra > reflected_counts[std::size_t(needed.level)])
        needed.level = SpectralLevel(int(needed.level) + 1);
    if (needed.level == SpectralLevel::colours)
        return needed;
    const auto passing = passing_light(world, scene);
    for (const Material& material : world.materials) {
        const std::string name = material_name(material);
        if (!material.reflectance.empty())
            needed.why = name + " has a reflectance of its own";
        else if (material.ultraviolet || material.infrared)
            needed.why = name + " has its own reflectance in the ultraviolet or the infrared";
    }
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (light.light.lamps[i][0].kind > 0)
            needed.why = "light " + std::to_string(i) + " is not sunlight";
    if (passing)
        needed.why = "light " + std::to_string(*passing) + " shines on what does not move with it";
    return needed;
}

std::string describe(const NeededLevel& needed)
{
    const std::size_t level = std::size_t(needed.level);
    const int most = reflected_counts[level];
    return "light in " + std::to_string(std::min(needed.spectra, most)) + " coefficients (" + spectral_level_names[level]
        + "): "
        + (needed.why.empty() ? "no surface here needs more"
                              : needed.why
                    + (needed.spectra > most ? "; they stand for " + std::to_string(needed.spectra) + " spectra"
                                             : "; more would change nothing"));
}

Spectra spectra_of(const World& world, const SceneFile& scene, SpectralLevel level)
{
    const Illumination light = illumination_of(world, scene);
    Spectra spectra;
    spectra.level = level;
    spectra.with_alpha = std::ranges::any_of(world.materials, &Material::blended);
    int reflected = reflected_counts[std::size_t(level)];
    if (spectra.with_alpha) // the most that all groups hold
        reflected = std::min(reflected, 3 * MAX_GROUPS - int(light.own.size()));
    spectra.basis = spectral_basis(spectra_of(light), reflected, light.own, importance_of(light));
    spectra.groups = GROUP_COUNT(spectra.basis.size(), spectra.with_alpha);
    spectra.kinds = int(light.light.kinds.size());
    spectra.lamps = light.light.lamps;
    const std::size_t sets = light.sets.sets.size();
    spectra.matrices
        = !spectra.basis.exact() || spectra.kinds > 1 || sets > 1 || light.sets.ultraviolet != light.sets.infrared;
    spectra.columns = columns_of(spectra, light);
    add_surfaces(spectra, world, scene, light.sets);
    if (spectra.columns.size() > MAX_MATRICES)
        throw InputError(scene.gltf.string(), "",
            "has " + std::to_string(sets - 1) + " materials with a reflectance of their own; at most "
                + std::to_string(MAX_MATRICES / int(spectra.columns.size() / sets) - 1)
                + " is right here, the others need a base colour");
    add_sky(spectra, scene);
    return spectra;
}

std::optional<Spectra> unshifted(const Spectra& spectra, std::span<const glm::dvec3> colours)
{
    const std::size_t own = spectra.basis.own.size(), groups = std::size_t(spectra.groups);
    const std::size_t columns = own + spectra.columns.size() / groups;
    if ((spectra.basis.reflected == 3 && own == 0 && !spectra.matrices) || columns > MAX_MATRICES)
        return {};
    // Sums the coefficients of a column of groups; `step` apart in the array.
    const auto colour_of = [&](const auto* first, std::size_t step) {
        glm::dvec3 colour(0);
        for (std::size_t k = 0; k < colours.size(); ++k)
            colour += colours[k] * double(first[spectra.place(k) / 4 * step][int(spectra.place(k) % 4)]);
        return colour;
    };
    Spectra same = spectra;
    same.groups = 1, same.matrices = true, same.unshifted = true;
    same.columns.clear();
    double brightest = 0;
    for (const glm::dvec3& colour : colours.last(own)) {
        same.columns.push_back(glm::vec4(colour, 0));
        brightest = std::max({brightest, colour.x, colour.y, colour.z});
    }
    same.most *= brightest;
    for (std::size_t at = 0; at < spectra.columns.size(); at += groups * columns_of_a_set) {
        glm::dvec3 white(0);
        for (std::size_t c = 0; c < columns_of_a_set; ++c) {
            const glm::dvec3 colour = colour_of(&spectra.columns[at + c], columns_of_a_set);
            same.columns.push_back(glm::vec4(colour, 0));
            white += glm::max(colour, 0.0);
        }
        same.gain = std::max({same.gain, white.x, white.y, white.z});
    }
    for (auto& sky : same.sky)
        sky = {glm::dvec4(colour_of(sky.data(), 1), 0)};
    return same;
}

} // namespace starbow
