#pragma once
#include "animation.h"
#include "config/model/body.h"
#include "config/model/emission.h"
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace starbow {

/// What the device draws, as plain arrays. Everything is at rest in its own frame, most of it in the world's, but for what
/// moves slowly by itself; lengths in scene units.
struct Vertex {
    glm::vec3 position;
    glm::vec3 normal; ///< unit
    glm::vec2 uv;
    std::uint32_t colour; ///< RGBA8, linear, red in the low byte
};
static_assert(sizeof(Vertex) == 36);

enum class Wrap { repeat, mirror, clamp };
struct Sampler {
    Wrap u = Wrap::repeat, v = Wrap::repeat;
    bool magnify_linear = true, minify_linear = true, mipmaps = true, mip_linear = true;
    bool operator==(const Sampler&) const = default;
};

/// sRGB-encoded colours with linear alpha, rows from the top.
struct Texture {
    glm::ivec2 size;
    std::vector<std::uint8_t> rgba;
    Sampler sampler;
};

/// A dial of a clock: it shows the world's time, or that of the body that it is part of, from its own zero on.
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

struct Material {
    std::string name;
    glm::vec4 base_colour{1}; ///< Rec. 709 linear, alpha
    glm::vec3 emissive{0}; ///< Rec. 709 linear radiance
    int base_texture = -1, emissive_texture = -1;
    float alpha_cutoff = 0; ///< above 0: a masked material; what is below is not there
    bool double_sided = false;
    bool unlit = false; ///< KHR_materials_unlit: the base colour is the radiance

    // What colours don't tell, from glTF's extras.
    std::optional<double> ultraviolet, infrared; ///< reflectance below about 360 and beyond 820 nm, 0 to 1; none: as the
                                                 ///< base colour's mean
    std::vector<std::pair<double, double>> reflectance; ///< not empty: at wavelengths in nm, rising, instead of the base
                                                        ///< colour's, whose luminance then scales it
    double temperature_K = 0, emissivity = 0; ///< glows as a black body does, in part
    std::optional<WorldClock> clock; ///< a dial is drawn on the surface, across texture coordinates 0 to 1; its marks have
                                     ///< `emissive` for their light, and nothing else has it
    std::optional<Blink> blink; ///< of what it emits
    std::optional<Emission> emission; ///< the spectrum of what `emissive` tells; its luminance 1 is then as much energy
                                      ///< as a sunlit white surface's. None: a sunlit colour
};

/// The same surface in fewer triangles.
struct DetailLevel {
    std::uint32_t first_index, index_count;
    double error; ///< how far it strays from the full surface, local units
    double shading = 0; ///< how wide it is shaded otherwise, local units; less where it differs little
};

/// A run of triangles (always a list) with one material, a bounding box and a bounding sphere in its own frame.
struct Primitive {
    std::uint32_t first_index, index_count;
    std::int32_t vertex_offset;
    int material;
    glm::dvec3 low, high;
    glm::dvec3 centre;
    double radius;
    std::vector<DetailLevel> coarser; ///< finest first; empty until add_detail_levels
};

/// A frame in which some of a world stands still. Its axes are the world's, carried by the pure boost.
struct RestFrame {
    glm::dvec3 u{0}; ///< proper velocity
    Event origin; ///< the world's event that is its place 0 at its time 0
    bool operator==(const RestFrame&) const = default;
};

/// When something is there, by its rest frame's time, and what its own clock shows then.
struct ExistenceInterval {
    double begin, end; ///< infinite where it goes on for ever
    double zero = 0; ///< the frame's time at its own time 0
    bool operator==(const ExistenceInterval&) const = default;
};

/// Triangles are counter-clockwise from outside in the world, also where `frame_from_local` mirrors: its primitive's are
/// turned beforehand. Normals go by the inverse transpose; the transform has an inverse.
struct Instance {
    glm::dmat4 frame_from_local; ///< of what moves by itself: at its own time 0
    std::uint32_t primitive;
    int node = -1; ///< of World::nodes
    int frame = 0; ///< of World::frames
    int existence = -1; ///< of World::existence_intervals; none: there always, and its time is the frame's
    int motion = -1; ///< of World::motions; none: it stands still
};

/// A node of the file, by which scene files name what hangs below it.
struct WorldNode {
    std::string name;
    int parent; ///< -1 at the top
};

/// A light of the scene as one rest frame has it.
struct Lamp {
    std::size_t light; ///< of SceneFile::lights
    int frame = 0; ///< where it stands still
    glm::dvec3 position{0}; ///< of a point, there
    int existence = -1;
};

struct World {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<Texture> textures;
    std::vector<Material> materials; ///< never empty: glTF's default material stands in where none is named
    std::vector<Primitive> primitives;
    std::vector<Instance> instances;
    std::vector<WorldNode> nodes;
    std::vector<RestFrame> frames{1}; ///< the first is the world's
    std::vector<ExistenceInterval> existence_intervals;
    std::vector<Lamp> lamps; ///< empty until place_bodies
    std::vector<Motion> motions; ///< this and what follows are empty where nothing moves by itself
    std::vector<Joint> joints;
    std::vector<Track> tracks;
    double seconds_per_time_unit = 1; ///< the scene's, from place_bodies on
    std::vector<std::string> notes; ///< optional things in the file that are not supported, each once
};

/// Reads glTF 2.0 (.glb or .gltf). Reads nothing outside the file's own folder. Throws InputError in one line for whatever
/// is broken, required but unsupported, or absurdly large.
World load_world(const std::filesystem::path& file);

} // namespace starbow
