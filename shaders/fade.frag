#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
// Black over a finished picture, so that a guide can fade it out. The pipeline multiplies the picture by 1 - alpha.

layout(push_constant) uniform Push { float part; };
layout(location = 0) out vec4 shown;

void main() { shown = vec4(0.0, 0.0, 0.0, part); }
