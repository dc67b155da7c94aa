#pragma once
#include <glm/glm.hpp>

// The shaders' scale of colours, as C++.
#define FN inline
namespace scale_shader {
using namespace glm;
using real = double;
using rvec3 = glm::dvec3;
#include "shaders/scale.glsl"
} // namespace scale_shader
#undef FN
