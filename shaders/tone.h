#pragma once
// The tone curve and the scale of colours compiled as C++: once as float (a shader's precision), once as double (the truth).
#include <glm/glm.hpp>

#define FN inline
namespace starbow::tone_double {
using namespace glm;
using real = double;
using rvec3 = glm::dvec3;
#include "scale.glsl"
#include "tone.glsl"
} // namespace starbow::tone_double

namespace starbow::tone_float {
using namespace glm;
using real = float;
using rvec3 = glm::vec3;
#include "scale.glsl"
#include "tone.glsl"
} // namespace starbow::tone_float
#undef FN
