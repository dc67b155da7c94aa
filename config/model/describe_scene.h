#pragma once
#include "describe_shot.h"
#include "scene_file.h"

namespace starbow {

// Scene files, as config/json/describe.h says.

/// From far below a nucleus to far beyond the universe's horizon; ratios of two such numbers fit a double.
constexpr Range any_size{1e-30, 1e30};
/// A colour's or a light's radiance, linear Rec. 709.
constexpr Range any_radiance{0, 1e6};

/// A path from the scene's folder.
struct ScenePath : Text {
    std::filesystem::path read(const Place& place, const Folder& folder) const { return folder.path / text(place); }
};
/// The same of a world, whose name may be written in composed or decomposed letters.
struct WorldPath : Text {
    std::filesystem::path read(const Place& place, const Folder& folder) const;
};
/// 0, or a temperature that a black body may have here.
struct GlowTemperature {
    double read(const Place& place, const Folder&) const;
    Json written(double kelvin) const { return kelvin; }
    Json schema(Json& definitions) const { return Number{{0, hottest_K}}.schema(definitions); }
};
template <>
inline constexpr auto description<Sky> = describe<Sky>("sky",
    "The sky behind everything: colours that are blended smoothly, and a black body's glow that is everywhere the same.",
    field("zenith", Numbers<3>{any_radiance}, "The colour above (+y), linear Rec. 709.", &Sky::zenith),
    field("horizon", Numbers<3>{any_radiance}, "The colour around, linear Rec. 709.", &Sky::horizon),
    field("nadir", Numbers<3>{any_radiance}, "The colour below, linear Rec. 709.", &Sky::nadir),
    field("temperature_K", GlowTemperature{},
        "The sky glows as a black body of this temperature, kelvins, 0.1 or more; 2.725 is the microwave background; 0: it "
        "does "
        "not glow.",
        &Sky::temperature_K));
static_assert(is_complete<Sky>());

template <>
inline constexpr auto description<Ground> = describe<Ground>("ground", "A level square of tiles for a world without one.",
    needed("middle", Numbers<3>{{-Ground::most, Ground::most}}, "Its middle, [x, y, z] in scene units.", &Ground::middle),
    needed("half_width", Number{{0, Ground::most, true}}, "From its middle to its sides, scene units.", &Ground::half_width),
    field("colour", Numbers<3>{{0, 1}}, "The reflectance of its lighter tiles, linear Rec. 709.", &Ground::colour));
static_assert(is_complete<Ground>());

template <>
inline constexpr auto description<MilkyWay> = describe<MilkyWay>("milky_way",
    "The light of all unresolved stars: a picture of the whole sky.",
    needed("panorama", ScenePath{},
        "An equirectangular picture: right ascension (J2000) grows to the right from 0 at the left edge, north is up.",
        &MilkyWay::panorama),
    needed("peak_arcmin2", Number{{0, 1e9, true}},
        "The picture's white: so many stars of magnitude 0 in each square arc minute.", &MilkyWay::peak_arcmin2));
static_assert(is_complete<MilkyWay>());

/// Right ascension and declination, degrees.
struct SkyDirection {
    glm::dvec2 read(const Place& place, const Folder&) const;
    Json written(const glm::dvec2& angles) const { return {angles.x, angles.y}; }
    Json schema(Json&) const;
};
/// A number of stars.
struct StarCount {
    std::size_t read(const Place& place, const Folder&) const { return std::size_t(integer(place, 0, most)); }
    Json schema(Json& definitions) const { return Whole{0, most}.schema(definitions); }
    static constexpr int most = 4'000'000;
};
template <>
inline constexpr auto description<StarSky> = describe<StarSky>("stars", "The stars of a catalogue, behind everything.",
    needed("catalogue", ScenePath{}, "The catalogue's path, from this file's folder.", &StarSky::catalogue),
    field("in_depth", StarCount{},
        "So many of the brightest are drawn one by one, each at its place in depth; the others are painted onto the Milky "
        "Way's "
        "panorama. Left out: all of them.",
        &StarSky::in_depth),
    field("brightness_arcmin2", Number{{0, 1e9, true}},
        "A star of magnitude 0 gives as much light as so many square arc minutes of the scene's white.",
        &StarSky::brightness_arcmin2),
    field("ahead_deg", SkyDirection{},
        "Right ascension and declination (J2000) of straight ahead (-z), degrees; north is up.", &StarSky::ahead_deg),
    field("sun_deg", SkyDirection{},
        "Right ascension and declination of the Sun, degrees, one astronomical unit from the origin; left out: there is "
        "none.",
        &StarSky::sun_deg),
    field("sun_light", Number{{0, 1e9, true}},
        "The light of a white surface that faces the Sun at the origin, over the scene's white. Left out: the Sun is as much "
        "brighter than the stars as it truly is.",
        &StarSky::sun_light),
    field("milky_way", Object<MilkyWay>{}, "", &StarSky::milky_way));
static_assert(is_complete<StarSky>());
void check(const Place& place, const StarSky& stars, const Folder&);

/// Days since 2000 January 1, 12 h UTC, of a date such as 2026-08-12T17:46Z.
struct DateForm {
    double read(const Place& place, const Folder&) const;
    Json schema(Json&) const;
};
template <>
inline constexpr auto description<GlobeSky> = describe<GlobeSky>("globes", "The Sun, planets and moons at a date.",
    needed("file", ScenePath{}, "The path of a file that describes them, from this file's folder.", &GlobeSky::file),
    needed(
        "date", DateForm{}, "The date at the scene's time 0, UTC, from 1800 to 2049: 2026-08-12T17:46Z.", &GlobeSky::days),
    needed("origin", Text{}, "The name of the globe at the world's origin.", &GlobeSky::origin));
static_assert(is_complete<GlobeSky>());

/// An angle of degrees that is kept in radians.
struct Degrees {
    Range range;
    double read(const Place& place, const Folder&) const { return glm::radians(number(place, range)); }
    Json schema(Json& definitions) const { return Number{range}.schema(definitions); }
};
template <>
inline constexpr auto description<LightCone> = describe<LightCone>("cone", "The directions into which a lamp shines.",
    needed("axis", UnitDirection{}, "Its middle, [x, y, z] of any length.", &LightCone::axis),
    needed("outer_deg", Degrees{{0, 90, true}}, "The angle from the axis beyond which it is dark, degrees.",
        &LightCone::outer_rad),
    field("inner_deg", Degrees{{0, 90}},
        "The angle from the axis within which it is at full strength, degrees; left out, 0.", &LightCone::inner_rad));
static_assert(is_complete<LightCone>());
void check(const Place& place, const LightCone& cone, const Folder&);

/// The form of each kind of spectrum in a light.
template <class Kind> struct EmissionForm;
template <> struct EmissionForm<BlackBody> {
    static constexpr const char* says = "A black body's temperature, kelvins: 3000 is a lamp's filament.";
    Emission read(const Place& place, const Folder&) const { return BlackBody{number(place, {coldest_K, hottest_K})}; }
    Json schema(Json& definitions) const { return Number{{coldest_K, hottest_K}}.schema(definitions); }
};
template <> struct EmissionForm<SpectralLine> {
    static constexpr const char* says = "One wavelength alone, nm: 589.3 is a sodium lamp.";
    Emission read(const Place& place, const Folder&) const { return SpectralLine{number(place, {shortest_nm, longest_nm})}; }
    Json schema(Json& definitions) const { return Number{{shortest_nm, longest_nm}}.schema(definitions); }
};
template <> struct EmissionForm<SpectralTable> {
    static constexpr const char* says
        = "A table: [[400, 0.1], [550, 1], [700, 0.4]], wavelengths in nm and relative radiance.";
    Emission read(const Place& place, const Folder&) const;
    Json schema(Json& definitions) const;
};
/// The schema's rule that at most one of some members stands there, as JSON.
template <std::size_t count> consteval auto at_most_one_of(const std::array<const char*, count>& names)
{
    std::array<char, 4096> rule{};
    std::size_t at = 0;
    const auto add = [&](const char* text) {
        while (*text)
            rule.at(at++) = *text++;
    };
    add("{\"not\":{\"anyOf\":[");
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j) {
            add(i == 0 && j == 1 ? "{\"required\":[\"" : ",{\"required\":[\"");
            add(names[i]), add("\",\""), add(names[j]), add("\"]}");
        }
    add("]}}");
    return rule;
}
template <class... Kinds> consteval auto scene_members(const std::variant<Kinds...>*)
{
    return std::array{Kinds::scene_member...};
}
inline constexpr std::array emission_members = scene_members(static_cast<const Emission*>(nullptr));
inline constexpr auto one_spectrum = at_most_one_of(emission_members);

/// A light's description with a member for each kind of spectrum.
template <class Owner, class... Fields> constexpr auto with_spectra(const Description<Owner, Fields...>& light)
{
    return [&]<class First, class... Others>(const std::variant<First, Others...>*) {
        return with_rules(
            with_fields(light,
                field(First::scene_member, EmissionForm<First>{}, EmissionForm<First>::says, &Owner::spectrum),
                again(Others::scene_member, EmissionForm<Others>{}, EmissionForm<Others>::says, &Owner::spectrum)...),
            one_spectrum.data());
    }(static_cast<const Emission*>(nullptr));
}
constexpr const char* radiance_says
    = "Its strength and its tint, linear Rec. 709: the colour of a white surface that faces it.";

template <>
inline constexpr auto description<DirectionalLight> = with_spectra(
    describe<DirectionalLight>("directional", "A light that is the same everywhere.",
        needed("towards", UnitDirection{}, "The direction from the world to the light, [x, y, z] of any length.",
            &DirectionalLight::towards),
        needed("radiance", Numbers<3>{any_radiance}, radiance_says, &DirectionalLight::radiance)));
static_assert(is_complete<DirectionalLight>());
void check_members(const Place& place, const DirectionalLight*);

template <>
inline constexpr auto description<PointLight> = with_spectra(describe<PointLight>("point", "A light that falls as 1 / r^2.",
    needed("position", Numbers<3>{{-farthest, farthest}}, "Its place, [x, y, z] in scene units; in its body's own frame.",
        &PointLight::position),
    needed("distance", Number{{0, farthest, true}}, "The distance at which its radiance holds, scene units.",
        &PointLight::distance),
    needed("radiance", Numbers<3>{any_radiance}, radiance_says, &PointLight::radiance),
    field("body", Text{}, "The name of one of the scene's bodies, with which it moves.", &PointLight::body),
    field("cone", Object<LightCone>{}, "", &PointLight::cone)));
static_assert(is_complete<PointLight>());
void check_members(const Place& place, const PointLight*);

template <>
inline constexpr auto description<Event> = describe<Event>("event", "An event of the body's origin.",
    field("time", Number{{-farthest, farthest}}, "The world's time, scene units / c.", &Event::time),
    field("position", Numbers<3>{{-farthest, farthest}}, "The place, [x, y, z] in scene units.", &Event::position));
static_assert(is_complete<Event>());

/// Events in order, each within the light cone of the one before.
struct WorldLine {
    std::vector<Event> read(const Place& place, const Folder& folder) const;
    Json schema(Json& definitions) const;
};
template <>
inline constexpr auto description<Body> = with_rules(
    describe<Body>("body", "Nodes of the glTF file, with all nodes below them, that move as one.",
        needed("name", Text{}, "A unique name; lights refer to it.", &Body::name),
        needed("nodes", List{Text{}, 1, 256, "names of nodes"}, "Names of nodes in the glTF.", &Body::nodes),
        field("velocity", Velocity{}, "Its velocity, for ever; this or a worldline.", &Body::u),
        field("at", Object<Event>{}, "", &Body::at),
        field("worldline", WorldLine{},
            "Events in order, each within the light cone of the one before, joined by straight segments.",
            &Body::worldline)),
    R"({ "oneOf": [{ "required": ["velocity"] }, { "required": ["worldline"] }],
        "not": { "required": ["at", "worldline"] } })");
static_assert(is_complete<Body>());
void check_members(const Place& place, const Body*);

template <>
inline constexpr auto description<Boundary> = describe<Boundary>("boundary",
    "The ball in which the visitors fly, where an exhibit attends to them. Before its edge the ship slows down and turns to "
    "the "
    "start.",
    needed("centre", Numbers<3>{{-1e9, 1e9}}, "Its centre, [x, y, z] in scene units.", &Boundary::centre),
    needed("radius", Number{{0, 1e9, true}}, "Its radius, scene units.", &Boundary::radius));
static_assert(is_complete<Boundary>());

template <>
inline constexpr auto description<PlannedFlight> = describe<PlannedFlight>("flight",
    "The flight that the world is made for, where an exhibit has a pace.",
    needed("distance", Number{{0, 1e9, true}}, "Straight ahead from the start, scene units.", &PlannedFlight::distance),
    needed("time_s", Number{{1, 3600}}, "The visitor's time with the throttle held open, seconds.", &PlannedFlight::time_s));
static_assert(is_complete<PlannedFlight>());

template <>
inline constexpr auto description<SceneFile> = describe_file<SceneFile>("scene",
    "A world with its size and its light. Lengths are in the glTF's own units, paths start at this file's folder.",
    needed("gltf", WorldPath{}, "The world's glTF file.", &SceneFile::gltf),
    field("unit_m", Number{any_size}, "The length of one unit of the glTF, metres.", &SceneFile::unit_m),
    field("light_speed_m_s", Number{any_size}, "The speed of light, m/s: the real one, or a slow one.",
        &SceneFile::light_speed_m_s),
    field("sky", Object<Sky>{}, "", &SceneFile::sky), field("ground", Object<Ground>{}, "", &SceneFile::ground),
    field("stars", Object<StarSky>{}, "", &SceneFile::stars),
    field("ambient", Numbers<3>{any_radiance},
        "A white surface's light without any lamp, linear Rec. 709: the sky's, from all sides.", &SceneFile::ambient),
    field("shadows", Flag{}, "true: still things hide lamps and the sky from each other.", &SceneFile::shadows),
    field("bodies", List{Object<Body>{}, 0, 1024, "bodies"}, "The moving parts of the glTF.", &SceneFile::bodies),
    field("lights", List{Tagged<Light>{}, 0, 8, "lights"}, "The lamps and the sun.", &SceneFile::lights),
    field("globes", Object<GlobeSky>{}, "", &SceneFile::globes),
    field("boundary", Object<Boundary>{}, "", &SceneFile::boundary),
    field("flight", Object<PlannedFlight>{}, "", &SceneFile::planned),
    field("goals", List{Object<Goal>{}, 0, 20, "goals"}, "Things for visitors to find or do, one after the other.",
        &SceneFile::goals),
    field("start", Varied<Shot>{{.without = "scene"}}, "The visitor's start, as in a shot.", &SceneFile::start),
    not_in_file(&SceneFile::name, &SceneFile::file, &SceneFile::notes));
static_assert(is_complete<SceneFile>());
void check(const Place& place, const SceneFile& scene, const Folder&);

} // namespace starbow
