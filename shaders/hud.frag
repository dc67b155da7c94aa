#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "constants.h"
#include "view.glsl"
#include "physics/real.glsl"
#include "scale.glsl"
// The head-up display: a panel at infinity in the cockpit, seen through the same directions as the world.

PANEL_CONSTANTS(DECLARED)

layout(set = 0, binding = 1) uniform sampler2D panel; // r: letters, g: the dark plate behind them
layout(push_constant) uniform Push { ViewPush view; };
layout(location = 0) out vec4 shown;

void main()
{
    float pixel_angle;
    vec3 n = look(view.row0, view.row1, view.row2, gl_FragCoord.xy - view.origin.xy, 0, pixel_angle); // panel axes: z towards the panel's middle
    vec2 at = n.xy / (n.z * view.boost.xy) * 0.5 + 0.5;
    if (n.z <= 0.0 || (MAP && pixel_angle == 0.0) || any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0))))
        discard;
    if (LIGHT) {
        vec2 edge = min(at, 1.0 - at) * view.boost.xy; // a frame as wide on all sides
        bool frame = min(edge.x, edge.y) < 0.012 * view.boost.x;
        shown = vec4(frame ? vec3(0.55, 0.58, 0.62) : textureLod(panel, vec2(at.x, 1.0 - at.y), 0.0).rgb, 1.0);
        return;
    }
    vec2 covered = textureLod(panel, vec2(at.x, 1.0 - at.y), 0.0).rg;
    // Letters of 0.6 of full white have a contrast of 4.5 to 1 (WCAG 2.2, 1.4.3) on a plate before the brightest picture, which
    // the headlight effect makes of any sky.
    float plate = covered.g * 0.92;
    if (SCALE && all(greaterThan(at, view.eye.xy)) && all(lessThan(at, view.eye.zw)) && covered.r < 0.02) {
        shown = vec4(scale_colour((at.x - view.eye.x) / (view.eye.z - view.eye.x)), 1.0);
        return;
    }
    shown = vec4(vec3(0.92, 0.96, 1.0) * covered.r, covered.r + plate * (1.0 - covered.r)); // premultiplied
}
