#pragma once
// The formulas of this folder compiled as C++: once as float (a shader's precision), once as double (the truth).
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#define FN inline
namespace starbow::physics_double {
using namespace glm;
using real = double;
using rvec2 = glm::dvec2;
using rvec3 = glm::dvec3;
using rvec4 = glm::dvec4;
#include "aberration.glsl"
#include "boost.glsl"
#include "detail.glsl"
#include "aurora.glsl"
#include "eclipse.glsl"
#include "galilean.glsl"
#include "glare.glsl"
#include "motion.glsl"
#include "sun_surface.glsl"
#include "worldline.glsl"
} // namespace starbow::physics_double

namespace starbow::physics_float {
using namespace glm;
using real = float;
using rvec2 = glm::vec2;
using rvec3 = glm::vec3;
using rvec4 = glm::vec4;
#include "aberration.glsl"
#include "boost.glsl"
#include "detail.glsl"
#include "aurora.glsl"
#include "eclipse.glsl"
#include "galilean.glsl"
#include "glare.glsl"
#include "motion.glsl"
#include "sun_surface.glsl"
#include "worldline.glsl"
} // namespace starbow::physics_float
#undef FN

namespace starbow {
namespace physics = physics_double;
}
