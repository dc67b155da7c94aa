#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "view.glsl"
// The least possible work of a cube map display: one look-up for each pixel. It is a baseline for measurements of the
// warp pass and has no other use.

layout(set = 0, binding = 1) uniform samplerCube cube_texture;
layout(push_constant) uniform Push { ViewPush view; };
layout(location = 0) out vec4 shown;

void main()
{
    float pixel_angle;
    shown = textureLod(cube_texture, look(view.row0, view.row1, view.row2, gl_FragCoord.xy - view.origin.xy, 0, pixel_angle), 0.0);
}
