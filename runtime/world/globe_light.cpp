#include "globe_light.h"
#include "config/model/angles.h"
#include "ephemeris.h"
#include "runtime/light/colour_table.h"
#include "shaders/shared_structs.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// Light of a kind after a way through so much air.
Spectrum through_air(Spectrum light, double mass)
{
    return [light = std::move(light), mass](double nm) { return light(nm) * std::exp(-rayleigh_depth(nm) * mass); };
}

double air_mass(int level) { return (std::exp2(level) - 1) / 2; }

void add(
    GlobeRows& rows, const std::string& name, const std::function<Spectrum(int level)>& light, int levels = GLOBE_LEVELS)
{
    rows.first[name] = int(rows.spectra.size());
    for (int level = 0; level < std::max(levels, 2); ++level)
        rows.spectra.push_back(light(levels > 1 ? level : 0));
}

double disc_of_lommel_seeliger(double phase)
{
    if (phase < 1e-9)
        return 1;
    return phase >= pi ? 0 : 1 + std::sin(phase / 2) * std::tan(phase / 2) * std::log(std::tan(phase / 4));
}

} // namespace

double rayleigh_depth(double nm)
{
    const double um = std::clamp(nm, 200.0, 1e5) / 1000, square = um * um;
    return 0.0021520 * (1.0455996 - 341.29061 / square - 0.90230850 * square)
        / (1 + 0.0027059889 / square - 85.968563 * square);
}

double sun_radiance(const SolarSystem& system, double radius_m, double cosine, double nm)
{
    static const Spectrum white = sunlit_white();
    double factor = 1;
    if (!system.limb.empty()) {
        // Beyond the measured wavelengths the nearest one's law holds.
        const auto after = std::lower_bound(
            system.limb.begin(), system.limb.end(), nm, [](const LimbDarkening& one, double at) { return one.nm < at; });
        const LimbDarkening &high = after == system.limb.end() ? system.limb.back() : *after,
                            &low = after == system.limb.begin() ? high : *(after - 1);
        const double part = high.nm > low.nm ? std::clamp((nm - low.nm) / (high.nm - low.nm), 0.0, 1.0) : 0;
        double here = 0, mean = 0, power = 1;
        for (int k = 0; k < 6; ++k, power *= cosine) {
            const double a = std::lerp(low.powers[std::size_t(k)], high.powers[std::size_t(k)], part);
            here += a * power, mean += 2 * a / (k + 2);
        }
        factor = here / mean;
    }
    const double au_over_radius = astronomical_unit_m / radius_m;
    return white(nm) * factor * au_over_radius * au_over_radius;
}

GlobeRows globe_rows(const SolarSystem& system, std::span<const glm::dvec4> parts, double clouds)
{
    GlobeRows rows;
    const Spectrum white = sunlit_white();
    const auto reflected = [&](const NamedTable& kind) {
        return [white, reflectance = Reflectance{kind.points}](double nm) { return white(nm) * reflectance(nm); };
    };
    const auto kind_named = [&](const std::string& name) {
        return *std::find_if(
            system.kinds.begin(), system.kinds.end(), [&](const NamedTable& kind) { return kind.name == name; });
    };
    const auto airy
        = std::find_if(system.globes.begin(), system.globes.end(), [](const Globe& globe) { return globe.air.has_value(); });
    for (const NamedTable& kind : system.kinds) {
        const bool under_air = kind.name == "cloud"
            || (airy != system.globes.end()
                && std::find(airy->kinds.begin(), airy->kinds.end(), kind.name) != airy->kinds.end());
        const Spectrum light = reflected(kind);
        add(
            rows, kind.name, [&](int level) { return through_air(light, air_mass(level)); }, under_air ? GLOBE_LEVELS : 1);
    }
    add(rows, "air", [&](int level) {
        return through_air([white](double nm) { return white(nm) * rayleigh_depth(nm); }, air_mass(level));
    });
    add(rows, "white", [&](int level) { return through_air(white, air_mass(level)); });
    for (const NamedTable& lamp : system.lights) {
        const SpectralTable table{lamp.points};
        const Spectrum spectrum = law_of(table).spectrum;
        // A globe's "brightest_lamps" is a ratio of luminances. With the energy of sunlight, sodium has 1.45 times its
        // luminance.
        const double luminance = seen(eye(), spectrum, 1).y;
        add(
            rows, lamp.name, [&](int) { return [spectrum, luminance](double nm) { return spectrum(nm) / luminance; }; }, 1);
    }
    for (std::size_t i = 0; i < system.globes.size(); ++i) {
        const Globe& globe = system.globes[i];
        if (globe.scattering == Scattering::sun) {
            add(rows, "sun", [&](int level) {
                const double cosine = std::min(level / (GLOBE_LEVELS - 1.001), 1.0);
                return [&system, radius = globe.radius_m, cosine](
                           double nm) { return sun_radiance(system, radius, cosine, nm); };
            });
            const double bright = (astronomical_unit_m / globe.radius_m) * (astronomical_unit_m / globe.radius_m);
            add(
                rows, globe.name + " mean", [&](int) { return [white, bright](double nm) { return white(nm) * bright; }; },
                1);
        } else {
            // A matt sphere's geometric albedo is 2/3 of its surface's; other maps already hold geometric albedos.
            std::vector<std::pair<double, Reflectance>> sum;
            for (int k = 0; k < 4; ++k)
                if (!globe.kinds[std::size_t(k)].empty())
                    sum.emplace_back(parts[i][k] * (globe.air ? 2.0 / 3 : 1),
                        Reflectance{kind_named(globe.kinds[std::size_t(k)]).points});
            if (globe.air)
                sum.emplace_back(clouds * 2 / 3, Reflectance{kind_named("cloud").points});
            add(
                rows, globe.name + " mean",
                [&](int) {
                    return [white, sum](double nm) {
                        double all = 0;
                        for (const auto& [part, reflectance] : sum)
                            all += part * reflectance(nm);
                        return white(nm) * all;
                    };
                },
                1);
        }
        rows.means.push_back(rows.first[globe.name + " mean"]);
    }
    return rows;
}

std::vector<glm::vec4> globe_light(const GlobeRows& rows, const StandardObserver& observer)
{
    const ColourTable table = colour_table(rows.spectra, observer, GLOBE_FIRST_LOG2_D, int(GLOBE_PER_OCTAVE), GLOBE_COLUMNS);
    std::vector<glm::vec4> texels(rows.spectra.size() * GLOBE_COLUMNS);
    for (std::size_t row = 0; row < rows.spectra.size(); ++row)
        for (int column = 0; column < GLOBE_COLUMNS; ++column) {
            const glm::dvec3 seen = table.row(column)[row];
            const double peak = std::max({seen.x, seen.y, seen.z}),
                         log = peak > 0 ? std::max(std::log2(peak), -1000.0) : -1000;
            texels[row * GLOBE_COLUMNS + std::size_t(column)] = glm::vec4(observer.rec709 * (seen * std::exp2(-log)), log);
        }
    return texels;
}

glm::dvec3 globe_colour(std::span<const glm::vec4> texels, int row, double D)
{
    const double unclamped = (std::log2(D) - GLOBE_FIRST_LOG2_D) * GLOBE_PER_OCTAVE;
    const double at = std::clamp(unclamped, 0.0, GLOBE_COLUMNS - 1.001);
    const std::size_t texel = std::size_t(row) * GLOBE_COLUMNS + std::size_t(at);
    const glm::dvec4 here = glm::mix(glm::dvec4(texels[texel]), glm::dvec4(texels[texel + 1]), at - std::floor(at));
    // Beyond the table every tail falls as 1 / D^2.
    const double beyond = std::exp2(std::min(0.0, (at - unclamped) / GLOBE_PER_OCTAVE));
    return glm::dvec3(here) * (std::exp2(here.w) * beyond * beyond);
}

double phase_dimming(const Globe& globe, double phase_deg)
{
    if (globe.scattering != Scattering::dusty)
        return 1;
    const double a = std::min(phase_deg, 160.0); // nothing is measured beyond
    const double magnitudes = globe.dimming_per_deg * a + globe.dimming_per_deg4 * a * a * a * a;
    return std::pow(10, -0.4 * magnitudes) / std::max(disc_of_lommel_seeliger(a * degree), 1e-6);
}

double phase_part(const Globe& globe, double phase_deg)
{
    const double a = phase_deg * degree;
    if (globe.scattering == Scattering::dusty)
        return disc_of_lommel_seeliger(a) * phase_dimming(globe, phase_deg);
    return globe.scattering == Scattering::sun ? 1 : (std::sin(a) + (pi - a) * std::cos(a)) / pi;
}

} // namespace starbow
