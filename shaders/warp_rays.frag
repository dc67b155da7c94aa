#version 460
#extension GL_GOOGLE_include_directive : require
// Several rays a pixel, or a direction for each colour.
#include "warp.glsl"
