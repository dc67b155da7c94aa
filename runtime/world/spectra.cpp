#include "spectra.h"
#include "config/json/reader.h"
#include "shaders/physics/physics.h"
#include "worldline.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

const std::optional<Emission>& spectrum_of(const Light& light)
{
    return std::visit([](const auto& l) -> const std::optional<Emission>& { return l.spectrum; }, light);
}

/// Light that illuminates surfaces, and its shift.
struct Kind {
    std::optional<Emission> light;
    double D = 1;
    bool operator==(const Kind&) const = default;
};

/// The range of D with which a lamp's light reaches surfaces that move against it.
struct Shift {
    double lowest = 1, highest = 1;
};
std::optional<Shift> shift_of(const World& world, const SceneFile& scene, std::size_t light, std::size_t frame)
{
    std::optional<Shift> shift;
    for (const Lamp& lamp : world.lamps) {
        if (lamp.light != light || std::size_t(lamp.frame) == frame)
            continue;
        const RestFrame &here = world.frames[frame], &there = world.frames[std::size_t(lamp.frame)];
        if (const auto* far = std::get_if<DirectionalLight>(&scene.lights[light])) {
            double D;
            aberrated(here.u, far->towards, D);
            return Shift{D, D};
        }
        const double E = physics::exp_rapidity(glm::length(physics::relative(here.u, there.u).u));
        const double most = std::max(E, shift ? shift->highest : 1);
        shift = {1 / most, most};
    }
    return shift;
}

std::string quoted(const std::string& name) { return '"' + one_line(name, 60) + '"'; }

/// Every emission once, in the order in which they are met.
std::vector<EmissionSpectrum> own_spectra(const World& world, const SceneFile& scene)
{
    std::vector<EmissionSpectrum> own;
    auto add = [&](const EmissionSpectrum& spectrum) {
        if (std::find(own.begin(), own.end(), spectrum) == own.end())
            own.push_back(spectrum);
    };
    const bool uneven = std::any_of(world.materials.begin(), world.materials.end(),
        [](const Material& m) { return m.ultraviolet || m.infrared || !m.reflectance.empty(); });
    for (const Light& light : scene.lights)
        if (const auto& spectrum = spectrum_of(light)) {
            add({*spectrum});
            if (uneven && !std::holds_alternative<SpectralLine>(*spectrum))
                add({*spectrum, true});
        }
    // Greys are exact where the shifted light on moving surfaces has an emission spectrum of its own; other cases are
    // approximated by sunlit basis functions. A line can't be.
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        for (std::size_t frame = 0; frame < world.frames.size(); ++frame)
            if (const auto shift = shift_of(world, scene, i, frame)) {
                const auto& spectrum = spectrum_of(scene.lights[i]);
                const bool line = spectrum && std::holds_alternative<SpectralLine>(*spectrum);
                const bool even = shift->lowest == shift->highest;
                if (line && !even)
                    throw InputError(scene.file, "/lights/" + std::to_string(i),
                        "is a line, and it passes what does not move with it, at wavelengths that change; a "
                        "\"temperature_K\" "
                        "or a \"spectrum\" is right there");
                if (even && (line || own.size() < MAX_OWN - 1))
                    add({shifted(spectrum, shift->lowest)});
            }
    for (const Material& material : world.materials) {
        if (material.temperature_K > 0)
            add({BlackBody{material.temperature_K}});
        if (material.emission)
            add({*material.emission});
    }
    if (scene.sky.temperature_K > 0)
        add({BlackBody{scene.sky.temperature_K}});
    if (own.size() > MAX_OWN)
        throw InputError(scene.gltf.string(), "",
            "has, with its lights and its sky, " + std::to_string(own.size())
                + " different spectra beside sunlight (of lamps, glows, lines and tables; a lamp counts twice where a "
                  "material's ultraviolet, infrared or reflectance is given); at most "
                + std::to_string(MAX_OWN) + " is right");
    return own;
}

std::size_t index_of(const SpectralBasis& basis, const Emission& emission)
{
    return std::size_t(std::find(basis.own.begin(), basis.own.end(), EmissionSpectrum{emission}) - basis.own.begin());
}

std::vector<double> lit_as(const SpectralBasis& basis, const Kind& kind, const std::function<double(double nm)>& reflectance)
{
    return kind.D == 1 ? lit(basis, kind.light, reflectance) : lit_shifted(basis, kind.light, kind.D, reflectance);
}

/// A surface's five columns under one light: [group * 5 + column].
std::vector<glm::vec4> by_colour(const SpectralBasis& basis, int groups, const Kind& light)
{
    std::vector<glm::vec4> columns(std::size_t(groups * 5), glm::vec4(0));
    for (int column = 0; column < 5; ++column) {
        glm::dvec3 rgb(0);
        if (column < 3)
            rgb[column] = 1;
        std::vector<double> coefficients(std::size_t(basis.size()), 0.0);
        if (light != Kind{} || basis.reflected > 5)
            coefficients = lit_as(basis, light, [&](double nm) { return base_reflectance(rgb, column == 3, column == 4, nm); });
        else if (column < basis.reflected) // these are its coefficients
            coefficients[std::size_t(column)] = 1;
        for (std::size_t k = 0; k < coefficients.size(); ++k)
            columns[k / 4 * 5 + std::size_t(column)][int(k % 4)] = float(coefficients[k]);
    }
    return columns;
}

/// The same for a material with a reflectance of its own, which the base colour's luminance scales.
std::vector<glm::vec4> by_table(const SpectralBasis& basis, int groups, const Kind& light, const Reflectance& reflectance)
{
    constexpr double luminance[3] = {0.2126, 0.7152, 0.0722}; // Rec. 709
    std::vector<glm::vec4> columns(std::size_t(groups * 5), glm::vec4(0));
    const std::vector<double> coefficients = lit_as(basis, light, reflectance);
    for (std::size_t column = 0; column < 3; ++column)
        for (std::size_t k = 0; k < coefficients.size(); ++k)
            columns[k / 4 * 5 + column][int(k % 4)] = float(luminance[column] * coefficients[k]);
    return columns;
}

/// One light's kinds in one rest frame: the light at rest, and the shifts of a light that moves there. New ones are added.
Spectra::Lamp lamp_kinds(
    const std::optional<Emission>& light, const std::optional<Shift>& shift, double per_octave, std::vector<Kind>& kinds)
{
    Spectra::Lamp lamp;
    const auto at = std::find(kinds.begin(), kinds.end(), Kind{light});
    lamp.kind = int(at - kinds.begin());
    if (at == kinds.end())
        kinds.push_back({light});
    if (!shift)
        return lamp;
    lamp.per_octave = per_octave;
    const bool even = shift->lowest == shift->highest;
    const int least = even ? 0 : int(std::floor(std::log2(shift->lowest) * per_octave));
    lamp.first_log2_D = even ? std::log2(shift->lowest) : least / per_octave;
    lamp.shifts = 1 - 2 * least;
    lamp.first_shift = int(kinds.size());
    for (int k = 0; k < lamp.shifts; ++k)
        kinds.push_back({light, even ? shift->lowest : std::exp2((least + k) / per_octave)});
    return lamp;
}

/// Fills the lamps of all lights in all rest frames. Returns their kinds: the finest shifts with at most so many kinds, or
/// else the coarsest.
std::vector<Kind> add_lamps(Spectra& spectra, const World& world, const SceneFile& scene, int most)
{
    std::vector<Kind> kinds;
    // Between two shifts of a sixteenth of an octave light that falls as a black body's tail is straight within 0.5 %.
    for (double per_octave : {16.0, 8.0, 4.0, 2.0}) {
        kinds = {Kind{}};
        spectra.lamps.clear();
        for (std::size_t i = 0; i < scene.lights.size(); ++i) {
            spectra.lamps.emplace_back();
            for (std::size_t frame = 0; frame < world.frames.size(); ++frame)
                spectra.lamps[i].push_back(
                    lamp_kinds(spectrum_of(scene.lights[i]), shift_of(world, scene, i, frame), per_octave, kinds));
        }
        if (int(kinds.size()) <= most)
            break;
    }
    return kinds;
}

/// Fills the columns: the set of the base colours, then one for each material with a reflectance of its own.
void add_columns(Spectra& spectra, const World& world, const std::vector<Kind>& kinds)
{
    auto add_set = [&](auto&& columns_under) {
        for (const Kind& light : kinds) {
            const std::vector<glm::vec4> columns = columns_under(light);
            spectra.columns.insert(spectra.columns.end(), columns.begin(), columns.end());
        }
    };
    add_set([&](const Kind& light) { return by_colour(spectra.basis, spectra.groups, light); });
    for (const Material& material : world.materials)
        if (!material.reflectance.empty())
            add_set(
                [&](const Kind& light) { return by_table(spectra.basis, spectra.groups, light, {material.reflectance}); });
}

void add_surfaces(Spectra& spectra, const World& world, const SceneFile& scene)
{
    int set = 1; // of the columns; 0 is the base colours'
    for (const Material& material : world.materials) {
        Spectra::Surface surface;
        surface.beyond = glm::vec4(material.ultraviolet.value_or(-1), material.infrared.value_or(-1), 0, -1);
        if (!material.reflectance.empty()) {
            surface.beyond.z = float(set++);
            if (material.emissive != glm::vec3(0) && !material.emission)
                throw InputError(scene.gltf.string(), "material " + quoted(material.name),
                    "has a reflectance of its own and an emissive colour without a spectrum; an \"emission\" is right");
        }
        if (material.emission) {
            surface.beyond.w = float(index_of(spectra.basis, *material.emission));
            surface.emission = sunlit_part(*material.emission);
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

void add_sky(Spectra& spectra, const Sky& sky)
{
    const glm::dvec3* colours[] = {&sky.zenith, &sky.horizon, &sky.nadir};
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& rgb = *colours[i];
        const double mean = (rgb.r + rgb.g + rgb.b) / 3;
        for (int group = 0; group < MAX_GROUPS; ++group)
            spectra.sky[i][std::size_t(group)] = glm::dvec4(0);
        for (std::size_t group = 0; group < std::size_t(spectra.groups); ++group) {
            const glm::vec4* columns = &spectra.columns[group * 5];
            for (int c = 0; c < 5; ++c)
                spectra.sky[i][group] += glm::dvec4(columns[c]) * (c < 3 ? rgb[c] : mean);
        }
        if (sky.temperature_K > 0) {
            const std::size_t k
                = std::size_t(spectra.basis.reflected) + index_of(spectra.basis, BlackBody{sky.temperature_K});
            spectra.sky[i][k / 4][int(k % 4)] += 1;
            spectra.most = std::max(spectra.most, 1.0);
        }
    }
}

} // namespace

NeededLevel needed_level(const World& world, const SceneFile& scene)
{
    NeededLevel needed;
    for (const Material& material : world.materials) {
        const std::string name = "material " + quoted(material.name);
        if (!material.reflectance.empty())
            return {SpectralLevel::fine, name + " has a reflectance of its own"};
        if ((material.ultraviolet || material.infrared) && needed.level == SpectralLevel::colours)
            needed = {SpectralLevel::middle, name + " has its own reflectance in the ultraviolet or the infrared"};
    }
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (spectrum_of(scene.lights[i]))
            return {SpectralLevel::fine, "light " + std::to_string(i) + " is no sunlight"};
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        for (std::size_t frame = 0; frame < world.frames.size(); ++frame)
            if (shift_of(world, scene, i, frame))
                return {SpectralLevel::fine, "light " + std::to_string(i) + " shines on what does not move with it"};
    return needed;
}

std::string describe(const NeededLevel& needed)
{
    const std::size_t level = std::size_t(needed.level);
    return "light in " + std::to_string(reflected_counts[level]) + " coefficients (" + spectral_level_names[level] + "): "
        + (needed.why.empty()                         ? "no surface here needs more"
                : needed.level == SpectralLevel::fine ? needed.why
                                                      : needed.why + "; more would change nothing");
}

Spectra spectra_of(const World& world, const SceneFile& scene, SpectralLevel level)
{
    Spectra spectra;
    spectra.level = level;
    spectra.basis = spectral_basis(reflected_counts[std::size_t(level)], own_spectra(world, scene));
    spectra.groups = (spectra.basis.size() + 3) / 4;
    const int own_sets = int(std::count_if(
        world.materials.begin(), world.materials.end(), [](const Material& m) { return !m.reflectance.empty(); }));
    const int sets = 1 + own_sets; // the first is the base colours'
    const std::vector<Kind> kinds = add_lamps(spectra, world, scene, MAX_MATRICES / (sets * spectra.groups * 5));
    spectra.kinds = int(kinds.size());
    spectra.matrices = spectra.basis.reflected > 5 || kinds.size() > 1 || own_sets > 0;
    add_columns(spectra, world, kinds);
    add_surfaces(spectra, world, scene);
    if (spectra.columns.size() > MAX_MATRICES)
        throw InputError(scene.gltf.string(), "",
            "has " + std::to_string(own_sets) + " materials with a reflectance of their own; at most "
                + std::to_string(MAX_MATRICES / int(spectra.columns.size() / std::size_t(sets)) - 1)
                + " is right here, the others need a base colour");
    add_sky(spectra, scene.sky);
    return spectra;
}

} // namespace starbow
