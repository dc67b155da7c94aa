#version 460
#extension GL_GOOGLE_include_directive : require
// A pixel at which no light of the cube map shows: its stars alone.
#define DARK
#include "warp.glsl"
