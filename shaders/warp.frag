#version 460
#extension GL_GOOGLE_include_directive : require
// The usual pixel: one ray, one direction for all colours. A driver copies a function to each of its calls, so the pipeline of
// this variant is made in a quarter of the time of warp_rays.frag's. A loop around one call would be made as fast, but in worlds
// with several rest frames lavapipe draws it at half the speed.
#define ONE_RAY
#include "warp.glsl"
