#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "view.glsl"
// Darkens a view's edge by the angle from an axis. The pipeline multiplies the picture by 1 - alpha.

layout(push_constant) uniform Push { ViewPush view; }; // boost: x, y: where the darkening begins and ends, radians; z: its part
layout(location = 0) out vec4 shown;

void main()
{
    float pixel_angle;
    vec3 n = look(view.row0, view.row1, view.row2, gl_FragCoord.xy - view.origin.xy, 0, pixel_angle); // z along the axis
    shown = vec4(0.0, 0.0, 0.0, view.boost.z * smoothstep(view.boost.x, view.boost.y, atan(length(n.xy), n.z)));
}
