#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
// A rectangle over each image at infinity, behind everything: the sky where no surface was drawn.

layout(set = 0, binding = 10) readonly buffer SkyImages { SkyImage images[]; };
layout(location = 0) out vec3 way;

void main()
{
    const vec2 corners[6] = {{0, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 0}, {1, 1}};
    vec2 corner = corners[gl_VertexIndex];
    SkyImage image = images[gl_InstanceIndex];
    way = image.corner.xyz + corner.x * image.along_a.xyz + corner.y * image.along_b.xyz;
    gl_Position = vec4(image.place.xy + corner * image.place.zw, 0.0, 1.0);
}
