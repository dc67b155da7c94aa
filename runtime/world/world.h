#pragma once
#include "animation.h"
#include "config/model/body.h"
#include "config/model/emission.h"
#include "config/model/solar_system.h"
#include <compare>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace starbow {

struct SceneFile;
struct Shadows;

/// A world as plain arrays, ready for the device. Everything is at rest in its own frame, apart from animations; most of
/// it is at rest in the world's frame. Lengths are in scene units.
struct Vertex {
    glm::vec3 position;
    glm::vec3 normal; ///< unit
    glm::vec2 uv;
    std::uint32_t colour; ///< RGBA8, linear, red in the low byte
};
static_assert(sizeof(Vertex) == 36);

/// A vertex's data for surfaces with gloss or maps.
struct VertexMaps {
    glm::vec4 tangent{1, 0, 0, 1}; ///< unit, along which the normal map's u grows; w: 1 or -1: the other axis, along which
                                   ///< its v falls, is w cross(normal, tangent)
    glm::vec4 uvs{0}; ///< texture coordinates of two of the file's sets, as the file has them
};
static_assert(sizeof(VertexMaps) == 32);

enum class Wrap { repeat, mirror, clamp };
struct Sampler {
    Wrap u = Wrap::repeat, v = Wrap::repeat;
    bool magnify_linear = true, minify_linear = true, mipmaps = true, mip_linear = true;
    auto operator<=>(const Sampler&) const = default;
};

/// An image of a world whose images have too many pixels together.
struct LargeImage {
    /// Pixels of four bytes of all textures together. A picture of 8192 x 4096 pixels around a globe fits.
    static constexpr std::size_t all_pixels = std::size_t(40) << 20;
    int image; ///< of the glTF file
    glm::ivec2 size; ///< in the file
};

/// Rows from the top: colours by sRGB's curve with linear alpha, or numbers, all of them linear.
struct Texture {
    glm::ivec2 size;
    std::vector<std::uint8_t> rgba;
    Sampler sampler;
    bool numbers = false;
    std::optional<LargeImage> large; ///< the device is to hold it in a quarter of its memory
};

/// A clock's dial: it shows the time of the world, or of its body, counted from its own zero.
struct WorldClock {
    double zero_s = 0; ///< the time at which it shows 0
    bool operator==(const WorldClock&) const = default;
};

/// A light that is on in the part `on` of each period, from the period's beginning.
struct Blink {
    double period_s, on = 0.5; ///< seconds of its own time; 0 to 1
    double zero_s = 0; ///< the time at which a period begins
    bool operator==(const Blink&) const = default;
};

/// A texture with coordinates of its own.
struct Map {
    int texture = -1;
    bool second = false; ///< of the two sets of VertexMaps::uvs
    glm::mat2 rotate_scale{1}; ///< coordinate = rotate_scale * set + offset
    glm::vec2 offset{0};
};

/// Reflection by glTF's metallic-roughness model; gloss.h says how.
struct Gloss {
    double metallic = 1, roughness = 1; ///< 0 to 1
    double dielectric = 0.04; ///< reflectance of what is not metallic, at right angles
    double normal_scale = 1, occlusion_strength = 1;
    Map metallic_roughness, normal, occlusion;
};

struct Material {
    std::string name;
    glm::vec4 base_colour{1}; ///< Rec. 709 linear, alpha
    glm::vec3 emissive{0}; ///< Rec. 709 linear radiance
    int base_texture = -1, emissive_texture = -1;
    float alpha_cutoff = 0; ///< above 0: a masked material; anything with less alpha is cut out. Of a blended one: some
                            ///< places have at least this alpha and are opaque
    bool blended = false; ///< what is behind it shows through by its alpha
    bool double_sided = false;
    bool unlit = false; ///< KHR_materials_unlit: the base colour is the radiance
    std::optional<Gloss> gloss; ///< none: matt
    std::optional<Map> emissive_map; ///< the emissive texture's coordinates; none: the base texture's

    bool mapped() const { return gloss || emissive_map; } ///< it needs VertexMaps

    // From glTF's extras: properties that colours lack.
    std::optional<double> ultraviolet, infrared; ///< reflectance below about 360 and beyond 820 nm, 0 to 1; none: as the
                                                 ///< base colour's mean
    std::vector<std::pair<double, double>> reflectance; ///< not empty: at wavelengths in nm, rising; it replaces the base
                                                        ///< colour's, whose luminance then scales it
    double temperature_K = 0, emissivity = 0; ///< glows as a black body times the emissivity
    std::optional<WorldClock> clock; ///< a dial is drawn on the surface, across texture coordinates 0 to 1; only its
                                     ///< marks emit `emissive`
    std::optional<Blink> blink; ///< blinking of its emitted light
    std::optional<Emission> emission; ///< the spectrum of `emissive`, whose luminance 1 is then the energy of a sunlit
                                      ///< white surface. nullopt: a sunlit colour
};

/// Some neighbouring triangles of a surface, local units: inside a sphere, with all normals inside a cone. An eye sees only
/// their backs if dot(d, axis) >= cutoff * length(d) + radius, with d from the eye to the centre.
struct Cluster {
    glm::vec3 centre;
    float radius;
    glm::vec3 axis; ///< unit
    float cutoff; ///< 1: no eye sees only backs
    std::uint32_t first_index, index_count;
};

/// A run of World::clusters; empty for a surface of few triangles, which is drawn as a whole.
struct ClusterRange {
    std::uint32_t first = 0, count = 0;
};

/// A triangle of a blended surface, or a line or a point. Each frame draws a surface's in the order of their distances.
struct BlendedTriangle {
    glm::vec3 middle; ///< local units
    std::array<std::uint32_t, 3> corners; ///< as in World::indices; of a line the first two, of a point the first
};

/// A run of World::blended_triangles.
struct BlendedRange {
    std::uint32_t first = 0, count = 0;
};

/// The same surface in fewer triangles.
struct DetailLevel {
    std::uint32_t first_index, index_count;
    double error; ///< distance from the full surface, local units; a mean over planes, which decides how far away it is used
    double shading = 0; ///< width over which its shading differs, local units; less where it differs little
    double apart = 0; ///< greatest distance of the full surface from it, local units: how deep it may lie below that surface
    ClusterRange clusters{}; ///< in the order of the indices
    BlendedRange blended{}; ///< of a blended surface
};

/// A box and the errors of the surfaces made for it: the same in all pieces that were made together.
struct PieceGroup {
    glm::dvec3 low{0}, high{0}; ///< local units; around those of the groups of which it was made
    double error = 0, shading = 0, apart = 0; ///< as DetailLevel's; infinite where nothing coarser was made
};

/// A part of a large surface at some level. It is drawn where its own group is fine enough and the coarser one, into which
/// its own was made, is not. So all pieces drawn make up the whole surface once (as in "virtualized geometry"; Karis, Stubbe
/// and Wihlidal, SIGGRAPH 2021).
struct DetailPiece {
    glm::dvec3 low, high; ///< of its own triangles, local units
    DetailLevel triangles;
    PieceGroup own, coarser;
};

/// A run of World::pieces; empty for a surface that is not divided.
struct PieceRange {
    std::uint32_t first = 0, count = 0;
};

/// What a primitive's indices are: corners of triangles, pairs of ends, or single points.
enum class Topology { triangles, lines, points };
constexpr std::uint32_t corners_of(Topology topology)
{
    return topology == Topology::points ? 1 : topology == Topology::lines ? 2 : 3;
}

/// A run of triangles, lines or points (always a list) with one material, a bounding box and a bounding sphere in its own
/// frame.
struct Primitive {
    std::uint32_t first_index, index_count;
    std::int32_t vertex_offset;
    int material;
    glm::dvec3 low, high;
    glm::dvec3 centre;
    double radius;
    std::vector<DetailLevel> coarser; ///< finest first; empty until add_detail_levels
    ClusterRange clusters{}; ///< of the full surface; empty until add_detail_levels
    PieceRange pieces{}; ///< a surface with pieces has no coarser levels and no clusters of its own
    int deforming = -1; ///< index into World::deforming of its first DeformingVertex; -1: its shape is rigid
    int displacements = -1; ///< index of its first Displacement there; a vertex has one for each target, one after another
    BlendedRange blended{}; ///< of the full surface, if it is blended
    Topology topology
        = Topology::triangles; ///< lines and points are as wide as a pixel, cast no shadow, have no coarser levels
};

/// A rest frame of a part of the world. Its axes are the world's, carried by the pure boost.
struct RestFrame {
    glm::dvec3 u{0}; ///< proper velocity
    Event origin; ///< the world's event at the frame's place 0 and time 0
    bool operator==(const RestFrame&) const = default;
};

/// The interval of the rest frame's time in which an instance exists, and the zero of its own clock.
struct ExistenceInterval {
    double begin, end; ///< infinite where it exists for ever
    double zero = 0; ///< the frame's time when its own time is 0
    bool operator==(const ExistenceInterval&) const = default;
};

/// Triangles are counter-clockwise from outside in the world, also where `frame_from_local` mirrors: the primitive is
/// turned beforehand. Normals transform by the inverse transpose; the transform has an inverse.
struct Instance {
    glm::dmat4 frame_from_local; ///< at its own time 0 for an animated instance
    std::uint32_t primitive;
    int node = -1; ///< index into World::nodes
    int frame = 0; ///< index into World::frames
    int existence = -1; ///< index into World::existence_intervals; -1: it always exists, and its time is the frame's
    int motion = -1; ///< index into World::motions; -1: it stands still
    int deformation = -1; ///< index into World::deformations; -1: it is rigid
};

/// A node of the file; scene files name the parts below it by it.
struct WorldNode {
    std::string name;
    int parent; ///< -1 at the top
};

/// A light of the scene in one rest frame's coordinates.
struct Lamp {
    std::size_t light; ///< index into SceneFile::lights
    int frame = 0; ///< its rest frame
    glm::dvec3 position{0}; ///< a point light's place in that frame
    int existence = -1;
};

/// The Sun, planets and moons, with their maps.
struct Globes {
    SolarSystem system;
    std::vector<Texture>
        maps; ///< one for each globe; empty where it has none. All of one size, but that of the globe with air
    Texture sky; ///< above that globe: red: clouds, green: the root of its lamps' radiance
    std::vector<glm::dvec4> parts; ///< for each globe the mean parts of its four kinds
    double clouds = 0; ///< and of clouds
};

struct World {
    std::vector<Vertex> vertices;
    std::vector<VertexMaps> vertex_maps; ///< one for each vertex; empty where no material needs them
    std::vector<std::uint32_t> indices;
    std::vector<Texture> textures;
    int milky_way = -1; ///< index into `textures` of the sky's picture (MilkyWay::panorama); -1: none
    std::shared_ptr<const Globes> globes; ///< null: none
    std::vector<Material> materials; ///< never empty: glTF's default material stands in where none is named
    std::vector<Primitive> primitives;
    std::vector<DetailPiece> pieces;
    std::vector<Cluster> clusters;
    std::vector<BlendedTriangle> blended_triangles; ///< empty until add_blended_triangles
    std::vector<Instance> instances;
    std::vector<WorldNode> nodes;
    std::vector<RestFrame> frames{1}; ///< the first is the world's
    std::vector<ExistenceInterval> existence_intervals;
    std::vector<Lamp> lamps; ///< empty until place_bodies
    std::vector<Motion> motions; ///< this and the following are empty without animation
    std::vector<Joint> joints;
    std::vector<Track> tracks;
    std::vector<Deformation> deformations;
    std::vector<glm::vec4> deforming; ///< rows of shared::DeformingVertex and shared::Displacement of deforming surfaces,
                                      ///< of which `vertices` has the file's own pose
    std::shared_ptr<const Shadows> shadows; ///< null: none
    double seconds_per_time_unit = 1; ///< the scene's, from place_bodies on
    std::vector<std::string> notes; ///< unsupported optional parts of the file, each once
};

/// Reads glTF 2.0 (.glb or .gltf) and nothing outside the file's own folder. Throws InputError in one line for anything
/// broken, required but unsupported, or absurdly large.
World load_world(const std::filesystem::path& file);
/// A scene's world: its glTF, and the picture of its sky, if it has one. cache: load_sky's folder. Throws InputError.
World load_world(const SceneFile& scene, const std::filesystem::path& cache = {});

} // namespace starbow
