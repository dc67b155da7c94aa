#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
// A triangle over the image at infinity, behind everything: the sky where no surface was drawn.

layout(push_constant) uniform Push { CubePush push; };
layout(location = 0) out vec3 way;

void main()
{
    vec2 corner = vec2(gl_VertexIndex == 1 ? 2.0 : 0.0, gl_VertexIndex == 2 ? 2.0 : 0.0);
    way = push.clip_x.xyz + corner.x * push.clip_y.xyz + corner.y * push.clip_w.xyz;
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
