#include "solar_system.h"
#include "config/json/reader.h"
#include <algorithm>
#include <cmath>
#include <set>

namespace starbow {
namespace {

constexpr Range any{-1e12, 1e12};

OrbitElements::Element read_element(const Place& orbit, const std::string& name)
{
    const std::vector<Place> pair = items(member(orbit, name), 2, 2, "numbers (at J2000, change in a century)");
    return {number(pair[0], any), number(pair[1], any)};
}

OrbitElements read_orbit(const Place& place)
{
    reject_unknown_members(place, {"a_au", "e", "i_deg", "L_deg", "perihelion_longitude_deg", "node_longitude_deg"});
    OrbitElements orbit{read_element(place, "a_au"), read_element(place, "e"), read_element(place, "i_deg"),
        read_element(place, "L_deg"), read_element(place, "perihelion_longitude_deg"),
        read_element(place, "node_longitude_deg")};
    if (!(orbit.semi_major_au.at_j2000 > 0))
        fail_at(member(place, "a_au"), "is not an orbit's; a first number above 0 is right");
    if (!(orbit.eccentricity.at_j2000 >= 0 && orbit.eccentricity.at_j2000 < 0.9))
        fail_at(member(place, "e"), "is not a planet's; a first number from 0 to below 0.9 is right");
    return orbit;
}

OrbitElements::Correction read_correction(const Place& place)
{
    OrbitElements::Correction correction;
    for (const Place& at : items(member(place, "polynomial"), 0, 9, "coefficients"))
        correction.polynomial.push_back(number(at, any));
    for (const Place& at : items(member(place, "terms"), 0, 1000, "terms [a, b, sine, cosine]")) {
        const std::vector<Place> row
            = items(at, 4, 4, "numbers (multiples of Jupiter's and Saturn's longitude, sine, cosine)");
        correction.terms.push_back(
            {{integer(row[0], -20, 20), integer(row[1], -20, 20)}, number(row[2], any), number(row[3], any)});
    }
    return correction;
}

std::vector<LunarTerm> read_terms(const Place& place)
{
    std::vector<LunarTerm> terms;
    for (const Place& row : items(place, 0, 1000, "terms")) {
        const std::vector<Place> at = items(row, 5, 5, "numbers (multiples of D, M, M' and F, amplitude)");
        terms.push_back(
            {{integer(at[0], -20, 20), integer(at[1], -20, 20), integer(at[2], -20, 20), integer(at[3], -20, 20)},
                number(at[4], any)});
    }
    return terms;
}

Rotation read_rotation(const Place& place, bool universal_time)
{
    const auto pair = [&](const char* name) {
        const std::vector<Place> two = items(member(place, name), 2, 2, "numbers (at J2000, rate)");
        return glm::dvec2(number(two[0], any), number(two[1], any));
    };
    const glm::dvec2 ascension = pair("pole_ra_deg"), declination = pair("pole_dec_deg"), meridian = pair("W_deg");
    Rotation rotation{
        {ascension.x, declination.x}, {ascension.y, declination.y}, meridian.x, meridian.y, {}, universal_time};
    const auto terms = find_member(place, "terms");
    if (!terms)
        return rotation;
    const Place angles = member(*terms, "angles");
    for (const auto& [name, value] : angles.json->items()) {
        const Place angle = member(angles, name);
        const auto amplitude = [&](const char* list) {
            const auto amplitudes = find_member(*terms, list);
            const auto own = amplitudes ? find_member(*amplitudes, name) : std::nullopt;
            return own ? number(*own, any) : 0.0;
        };
        double per_day = 0, per_century = 0;
        read_optional(angle, "deg_per_day", per_day, any);
        read_optional(angle, "deg_per_century", per_century, any);
        rotation.librations.push_back({number(member(angle, "deg"), any), per_day + per_century / 36525,
            amplitude("pole_ra_sin"), amplitude("pole_dec_cos"), amplitude("W_sin")});
    }
    return rotation;
}

std::vector<std::pair<double, double>> read_points(const Place& place)
{
    std::vector<std::pair<double, double>> points;
    for (const Place& at : items(place, 2, 4096, "pairs [wavelength in nm, value]")) {
        const std::vector<Place> pair = items(at, 2, 2, "numbers (wavelength in nm, value)");
        const double nm = number(pair[0], {40, 12000});
        if (!points.empty() && !(nm > points.back().first))
            fail_at(pair[0], "does not rise; a wavelength above the one before is right");
        points.emplace_back(nm, number(pair[1], {0, 1e6}));
    }
    return points;
}

std::vector<NamedTable> read_kinds(const Place& place, const char* member_name)
{
    std::vector<NamedTable> kinds;
    for (const auto& [name, value] : place.json->items())
        kinds.push_back({name, read_points(member(member(place, name), member_name))});
    return kinds;
}

/// The name of one of the tables of a member of the file of spectra. what: such as "kind" of "kinds".
std::string name_in(const std::vector<NamedTable>& tables, const Place& at, const std::string& what)
{
    const std::string name = text(at);
    if (std::none_of(tables.begin(), tables.end(), [&](const NamedTable& one) { return one.name == name; }))
        fail_at(at, "is not a " + what + " of the file of \"spectra\"; one of its \"" + what + "s\" is right");
    return name;
}

/// The layers that shine above a globe's air; without the member none.
std::vector<Glow> read_glows(const Place& air, const SolarSystem& system)
{
    std::vector<Glow> glows;
    const auto list = find_member(air, "glows");
    for (const Place& at : list ? items(*list, 0, most_glows, "glows") : std::vector<Place>()) {
        reject_unknown_members(at, {"from_km", "to_km", "zenith", "light", "aurora"});
        Glow glow{number(member(at, "from_km"), {0, 10000}) * 1000, number(member(at, "to_km"), {0, 10000}) * 1000,
            number(member(at, "zenith"), {0, 1}), name_in(system.lights, member(at, "light"), "light"), false};
        read_optional(at, "aurora", glow.aurora);
        if (!(glow.to_m > glow.from_m))
            fail_at(member(at, "to_km"), "is not above \"from_km\"; a greater height is right");
        if (!glows.empty() && glows.back().aurora && (!glow.aurora || glow.from_m != glows.back().to_m))
            fail_at(at, "stands after a layer of aurora; a layer of aurora that begins at that one's \"to_km\" is right");
        glows.push_back(std::move(glow));
    }
    return glows;
}

/// All measured spectra.
void read_spectra(const Place& place, SolarSystem& system)
{
    system.kinds = read_kinds(member(place, "kinds"), "reflectance");
    system.lights = read_kinds(member(place, "lights"), "relative_power");
    const Place limb_darkening = member(place, "sun_limb_darkening");
    for (const Place& row : items(member(limb_darkening, "rows"), 0, 1000, "rows")) {
        const std::vector<Place> at = items(row, 7, 7, "numbers (wavelength in nm, six coefficients)");
        LimbDarkening limb{number(at[0], {40, 12000}), {}};
        for (std::size_t k = 0; k < 6; ++k)
            limb.powers[k] = number(at[k + 1], {-100, 100});
        if (!system.limb.empty() && !(limb.nm > system.limb.back().nm))
            fail_at(at[0], "does not rise; a wavelength above the one before is right");
        system.limb.push_back(limb);
    }
    // In the infrared a straight line: 1 - u (1 - cosine).
    for (const Place& at : items(member(limb_darkening, "infrared_u"), 0, 1000, "pairs [wavelength in nm, u]")) {
        const glm::dvec2 pair = vec2(at, {0, 12000});
        if (system.limb.empty() || pair.x > system.limb.back().nm)
            system.limb.push_back({pair.x, {1 - pair.y, pair.y}});
    }
}

PlanetRing read_ring(const Place& place)
{
    std::vector<glm::dvec3> rows;
    for (const Place& at : items(member(place, "rows"), 2, 4096, "rows [radius in km, optical depth, reflectivity]")) {
        rows.push_back(vec3(at, {0, 1e9}));
        if (rows.size() > 1 && !(rows.back().x > rows[rows.size() - 2].x))
            fail_at(at, "does not rise; a radius above the one before is right");
    }
    PlanetRing ring{rows.front().x * 1000, rows.back().x * 1000, {}, "rings"};
    constexpr int count = 512;
    std::size_t next = 1;
    for (int i = 0; i < count; ++i) {
        const double radius = std::lerp(rows.front().x, rows.back().x, (i + 0.5) / count);
        while (rows[next].x < radius)
            ++next;
        const glm::dvec3 &low = rows[next - 1], &high = rows[next];
        const glm::dvec3 here = glm::mix(low, high, (radius - low.x) / (high.x - low.x));
        ring.profile.push_back({here.y, 2 * here.z});
    }
    return ring;
}

} // namespace

SolarSystem load_solar_system(const std::filesystem::path& file)
{
    const std::filesystem::path folder = file.parent_path();
    const Document document = read_document(file);
    const Place top = root(document);
    reject_unknown_members(top, {"bodies", "spectra", "globes"});
    const Document bodies_document = read_document(folder / text(member(top, "bodies")));
    const Document spectra_document = read_document(folder / text(member(top, "spectra")));
    const Place bodies = root(bodies_document);
    const Place sizes = member(member(bodies, "sizes"), "bodies"), orbits = member(member(bodies, "orbits"), "bodies"),
                rotations = member(member(bodies, "rotation"), "bodies"), moon = member(bodies, "moon");
    const auto corrections = find_member(member(bodies, "orbits"), "corrections");
    SolarSystem system;
    read_spectra(root(spectra_document), system);
    system.moon_longitude = read_terms(member(moon, "longitude_deg_sin"));
    system.moon_latitude = read_terms(member(moon, "latitude_deg_sin"));
    system.moon_distance = read_terms(member(moon, "distance_km_cos"));
    const auto require_kind = [&](const Place& place, const char* name) {
        if (std::none_of(system.kinds.begin(), system.kinds.end(), [&](const NamedTable& one) { return one.name == name; }))
            fail_at(place,
                std::string("needs the kind \"") + name + "\", and the file of \"spectra\" has none; one with it is right");
    };
    std::set<std::string> names;
    for (const Place& at : items(member(top, "globes"), 1, 16, "globes")) {
        reject_unknown_members(at, {"body", "scattering", "map", "map_scale", "kinds", "dimming", "air", "ring"});
        Globe globe;
        const Place name = member(at, "body");
        globe.name = text(name);
        if (!names.insert(globe.name).second)
            fail_at(name, "is there already; each globe once is right");
        const auto size = find_member(sizes, globe.name);
        if (!size)
            fail_at(name, "has no size in the file of \"bodies\"; one of its names is right");
        globe.radius_m = number(member(*size, "radius_km"), {1e-3, 1e9}) * 1000;
        globe.flattening = number(member(*size, "flattening"), {0, 0.5});
        globe.rotation = read_rotation(member(rotations, globe.name), globe.name == "Earth");
        globe.moon = globe.name == "Moon";
        globe.scattering = chosen(member(at, "scattering"),
            std::vector<std::pair<std::string_view, Scattering>>{
                {"cloudy", Scattering::cloudy}, {"dusty", Scattering::dusty}, {"sun", Scattering::sun}});
        if (!globe.moon && globe.scattering != Scattering::sun)
            globe.orbit = read_orbit(member(orbits, globe.name == "Earth" ? "EarthMoonBarycenter" : globe.name));
        if (globe.orbit && corrections)
            if (const auto own = find_member(member(*corrections, "bodies"), globe.name)) {
                globe.orbit->longitude_deg = read_correction(member(*own, "longitude_deg"));
                globe.orbit->distance_part = read_correction(member(*own, "distance_fraction"));
                system.jupiter_deg = read_element(member(orbits, "Jupiter"), "L_deg");
                system.saturn_deg = read_element(member(orbits, "Saturn"), "L_deg");
            }
        if (auto p = find_member(at, "map"))
            globe.map = folder / text(*p);
        read_optional(at, "map_scale", globe.map_scale, {0, 100, true});
        if (globe.scattering != Scattering::sun) {
            const std::vector<Place> kinds
                = items(member(at, "kinds"), 4, 4, "kinds (of red, green, blue and the rest; null: none)");
            for (std::size_t k = 0; k < 4; ++k)
                if (!kinds[k].json->is_null())
                    globe.kinds[k] = name_in(system.kinds, kinds[k], "kind");
        }
        if (auto p = find_member(at, "dimming")) {
            const std::vector<Place> two = items(*p, 2, 2, "numbers (magnitudes per degree, per its fourth power)");
            globe.dimming_per_deg = number(two[0], {0, 1}), globe.dimming_per_deg4 = number(two[1], {0, 1});
        }
        if (auto p = find_member(at, "air")) {
            reject_unknown_members(*p, {"scale_height_km", "clouds", "water", "lamps", "brightest_lamps", "lamp", "glows"});
            globe.air = {number(member(*p, "scale_height_km"), {0.1, 1000}) * 1000, folder / text(member(*p, "clouds")),
                folder / text(member(*p, "water")), folder / text(member(*p, "lamps")),
                number(member(*p, "brightest_lamps"), {0, 1}), {}, read_glows(*p, system)};
            if (auto lamp = find_member(*p, "lamp"))
                globe.air->lamp = name_in(system.lights, *lamp, "light");
            if (std::any_of(
                    system.globes.begin(), system.globes.end(), [](const Globe& other) { return other.air.has_value(); }))
                fail_at(*p, "is a second globe's; one globe with air is right");
            require_kind(*p, "cloud");
            if (globe.map.empty())
                fail_at(*p, "needs a \"map\" of the ground below it");
        }
        if (auto p = find_member(at, "ring")) {
            require_kind(*p, "rings");
            const Document ring = read_document(folder / text(*p));
            globe.ring = read_ring(root(ring));
        }
        system.globes.push_back(std::move(globe));
    }
    if (system.globes.front().scattering != Scattering::sun)
        fail_at(member(top, "globes"), "begin with another globe; the Sun first is right");
    if (names.contains("Moon") && !names.contains("Earth"))
        fail_at(member(top, "globes"), "have a Moon without the Earth that it goes around; both are right");
    return system;
}

} // namespace starbow
