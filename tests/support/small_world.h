#pragma once
// Worlds made for one test: flat shapes in plain colours.
#include "gltf_fixture.h"
#include "gpu_environment.h"

namespace starbow::gpu_test {

using gltf_test::Doc;
using gltf_test::Json;

/// Adds a material whose colour needs no lamp, and returns its index.
int unlit(Doc& doc, const dvec3& colour);

/// Adds a rectangle. Seen from its front, `right` points to the right and `up` upwards; texture coordinates 0, 0 are at its
/// top left.
/// `node` has the node's further members; the corners are in its frame.
void quad(Doc& doc, const dvec3& centre, const dvec3& right, const dvec3& up, int material, Json node = Json::object());

/// Adds small bright octahedra as one mesh, each in its own colour; returns the mesh. Each has six vertices.
int blobs(Doc& doc, const std::vector<std::pair<dvec3, dvec3>>& places_and_colours, double radius);

/// The mean direction of the pixels that are lit in one colour.
dvec3 direction_of(const Numbers& numbers, int colour);

/// A vector, and a velocity by its proper velocity, as JSON.
Json numbers_of(const dvec3& v);
Json velocity_of(const dvec3& u);

/// Opens a scene file and its glTF as `starbow` does. One unit is a metre, if the scene does not say.
GpuWorld open_world(const std::string& name, const Doc& doc, Json scene = Json::object());
/// The same with shadows. One unit is a light-second.
GpuWorld shaded_world(const std::string& name, const Doc& doc, Json scene);

extern const Json smooth_sky;

/// Returns the sky's colour in the direction n.
dvec3 sky_colour(const dvec3& n, const Json& sky = smooth_sky);

inline bool near_colour(const dvec3& a, const dvec3& b, double by) { return glm::length(a - b) < by; }

/// Converts linear light to a pixel's encoded value, 0 to 1: IEC 61966-2-1.
inline double srgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

} // namespace starbow::gpu_test
