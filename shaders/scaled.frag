#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
// A picture scaled to the size of its target.

layout(set = 0, binding = 0) uniform sampler2D picture;
layout(push_constant) uniform Push { ViewPush view; };
layout(location = 0) out vec4 shown;

void main() { shown = textureLod(picture, gl_FragCoord.xy / view.zenith.zw, 0.0); }
