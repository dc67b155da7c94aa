#version 460
// One level of a texture from the next finer one, by linear filtering in the middle between its texels.

layout(set = 0, binding = 0) uniform sampler2D finer;
layout(location = 0) out vec4 mean;

void main()
{
    vec2 size = vec2(max(textureSize(finer, 0) / 2, ivec2(1)));
    mean = textureLod(finer, gl_FragCoord.xy / size, 0.0);
}
