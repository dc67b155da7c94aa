// The sky's light in a direction. SKY: the SkyConstants.

// The place of a unit direction in the panorama, equatorial axes: right ascension over a turn, and the angle from the north
// pole over half a turn. Within 0.015 degrees, a twelfth of a texel; the built-in functions take twice the time without a GPU.
vec2 place_in_panorama(vec3 n)
{
    vec2 side = abs(n.xy);
    float a = min(side.x, side.y) / max(max(side.x, side.y), 1e-20), square = a * a;
    float turn = ((-0.0074000 * square + 0.0253557) * square - 0.0521428) * square * a + 0.15915494 * a;
    turn = side.y > side.x ? 0.25 - turn : turn;
    turn = n.x < 0.0 ? 0.5 - turn : turn;
    float z = abs(n.z); // Abramowitz and Stegun, 4.4.45, over pi
    float from_pole = sqrt(max(1.0 - z, 0.0)) * (((-0.00596172 * z + 0.02363801) * z - 0.06751814) * z + 0.49997852);
    return vec2(n.y < 0.0 ? -turn : turn, n.z < 0.0 ? 1.0 - from_pole : from_pole);
}

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
