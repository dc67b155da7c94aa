// The sky's light in a direction. SKY: the SkyConstants.

#include "panorama.glsl"

// n: unit direction, the cube map's axes. angle: of a pixel there, radians.
void sky_light(vec3 n, float angle, out vec4 coefficients[MAX_GROUPS])
{
    float height = dot(n, SKY.up.xyz), part = smoothstep(0.0, 1.0, abs(height));
    for (int group = 0; group < GROUPS; ++group)
        coefficients[group] = mix(SKY.horizon[group], height > 0.0 ? SKY.zenith[group] : SKY.nadir[group], part);
    if (MILKY_WAY) {
        vec3 there = vec3(dot(SKY.equatorial0.xyz, n), dot(SKY.equatorial1.xyz, n), dot(SKY.equatorial2.xyz, n));
        float level = log2(angle * 0.31830989 * float(textureSize(milky_way, 0).y)) - 0.5; // its stars are two texels wide
        vec3 light = textureLod(milky_way, place_in_panorama(there), level).rgb;
        for (int group = 0; group < GROUPS; ++group)
            coefficients[group] += light.r * SKY.red[group] + light.g * SKY.green[group] + light.b * SKY.blue[group];
    }
}
