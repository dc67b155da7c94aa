#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "constants.h"
#include "view.glsl"
// Test patterns for lining up projectors. Linear light.

PATTERN_CONSTANTS(DECLARED)
layout(set = 0, binding = 1) uniform sampler2D label; // r: letters
layout(push_constant) uniform Push { PatternPush pattern; };
layout(location = 0) out vec4 shown;

const float degree = 0.01745329252;

// 1 on lines of a width in pixels, 0 elsewhere; off: distance from the line in pixels.
float line(float off, float width) { return clamp(0.5 * width + 0.5 - abs(off), 0.0, 1.0); }

// Distance to the nearest multiple of `every`.
float from_multiple(float x, float every) { return abs(x - every * round(x / every)); }

vec3 grid(vec2 p, vec2 size)
{
    vec2 off = p - 0.5 * size;
    float cells = max(line(from_multiple(off.x, 64.0), 1.0), line(from_multiple(off.y, 64.0), 1.0));
    float cross = max(line(off.x, 3.0), line(off.y, 3.0));
    float circle = line(length(off) - 0.5 * min(size.x, size.y) + 1.0, 2.0);
    vec2 edge = min(p, size - p);
    float border = step(min(edge.x, edge.y), 2.0);
    vec3 light = vec3(0.18) * cells;
    light = mix(light, vec3(1.0, 0.45, 0.1), cross);
    light = mix(light, vec3(0.1, 0.7, 1.0), circle);
    return mix(light, vec3(1.0), border);
}

// Digits of 3 x 5 cells, rows from the top, three bits each.
const int digits[10] = int[10](0x7b6f, 0x2c97, 0x73e7, 0x73cf, 0x5bc9, 0x79cf, 0x79ef, 0x7249, 0x7bef, 0x7bcf);

// Draws the number `value` centred above (0, 0) to (0, 5), one unit a cell, y down. x: 1 inside its digits; y: 1 on the
// plate around them, where nothing else is drawn.
vec2 number(vec2 at, int value)
{
    int size = abs(value);
    int signs = int(value < 0), count = signs + (size >= 100 ? 3 : size >= 10 ? 2 : 1);
    at.x += float(count) * 2.0 - 0.5;
    if (at.x < -1.0 || at.x >= float(count) * 4.0 || at.y < -1.0 || at.y >= 6.0)
        return vec2(0.0);
    int place = int(floor(at.x / 4.0)), cell_x = int(floor(at.x)) - 4 * place, cell_y = int(floor(at.y));
    if (place < 0 || cell_x > 2 || cell_y < 0 || cell_y > 4)
        return vec2(0.0, 1.0);
    if (place < signs)
        return vec2(cell_y == 2, 1.0);
    int power = place == count - 1 ? 1 : place == count - 2 ? 10 : 100;
    return vec2(digits[(size / power) % 10] >> (14 - cell_y * 3 - cell_x) & 1, 1.0);
}

vec3 written(vec3 light, vec2 mark, vec3 colour) { return mix(light * (1.0 - mark.y), colour, mark.x); }

vec3 rings(vec3 n, float angle)
{
    float elevation = asin(clamp(n.y, -1.0, 1.0)) / degree, azimuth = atan(n.x, -n.z) / degree;
    float pixel = angle / degree, shrink = max(sqrt(max(1.0 - n.y * n.y, 0.0)), 1e-4);
    float fine = max(line(from_multiple(elevation, 15.0) / pixel, 1.5),
        shrink > 0.05 ? line(from_multiple(azimuth, 15.0) * shrink / pixel, 1.5) : 0.0);
    float horizon = line(elevation / pixel, 3.0), front = abs(azimuth) < 90.0 ? line(azimuth * shrink / pixel, 3.0) : 0.0;
    vec3 light = (n.y > 0.0 ? vec3(0.25, 0.5, 0.8) : vec3(0.5, 0.35, 0.2)) * fine;
    light = mix(light, vec3(1.0, 0.45, 0.1), horizon);
    light = mix(light, vec3(0.2, 1.0, 0.3), front);
    // Labels: the azimuth above the horizon and the 45 degree rings, each 30 degrees; the elevation along the four main
    // azimuths.
    float cell = 0.45;
    float ring = 45.0 * round(elevation / 45.0), spoke = 30.0 * round(azimuth / 30.0);
    vec2 at = vec2((azimuth - spoke) * shrink, ring - elevation) / cell;
    if (abs(ring) < 60.0)
        light = written(light, number(at - vec2(0.0, -6.5), int(spoke < -170.0 ? 180.0 : spoke)), vec3(1.0));
    float height = 15.0 * round(elevation / 15.0), main_spoke = 90.0 * round(azimuth / 90.0);
    at = vec2((azimuth - main_spoke) * shrink, height - elevation) / cell;
    if (abs(height) > 1.0 && abs(height) < 89.0)
        light = written(light, number(at - vec2(8.0, 2.0), int(height)), vec3(1.0, 0.9, 0.4));
    return light;
}

// The label's coverage at p, for a copy with its top left corner at `corner`.
float label_at(vec2 p, vec2 corner)
{
    vec2 at = (p - corner) / pattern.label.xy;
    return all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(1.0))) ? textureLod(label, at, 0.0).r : 0.0;
}

float labels(vec2 p, vec2 size, bool corners)
{
    float letters = label_at(p, floor(0.5 * (size - pattern.label.xy)));
    for (int i = 0; corners && i < 4; ++i)
        letters = max(letters, label_at(p, floor(vec2(i & 1, i >> 1) * (size - pattern.label.xy - 16.0)) + 8.0));
    return letters;
}

vec3 names(vec2 p, vec2 size)
{
    vec2 edge = min(p, size - p);
    vec3 light = pattern.tint.rgb * 0.25;
    light = mix(light, pattern.tint.rgb, step(min(edge.x, edge.y), 6.0));
    return mix(light, vec3(1.0), labels(p, size, true));
}

// The light that the output's curve encodes as this input, 0 to 1.
float light_of_input(float value)
{
    if (pattern.label.w > 0.0)
        return pow(value, pattern.label.w);
    return value > 0.04045 ? pow((value + 0.055) / 1.055, 2.4) : value / 12.92;
}

// From the top: seventeen even steps of input; for each channel, lines of black and white beside the grey that a right
// curve makes of them; the darkest inputs, each of which should be just visible.
vec3 wedges(vec2 p, vec2 size)
{
    vec2 at = (p / size - 0.5) / pattern.label.z + 0.5;
    if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(1.0))))
        return vec3(0.0);
    if (at.y < 0.4)
        return vec3(light_of_input(floor(at.x * 17.0) / 16.0));
    if (at.y < 0.7) {
        int band = int(at.x * 4.0);
        vec3 colour = band == 3 ? vec3(1.0) : vec3(band == 0, band == 1, band == 2);
        bool lines = fract(at.x * 4.0) > 0.25 && fract(at.x * 4.0) < 0.75 && at.y > 0.46 && at.y < 0.64;
        return colour * (lines ? float(int(p.y) & 1) : 0.5);
    }
    float step_ = floor(at.x * 12.0);
    bool inside = fract(at.x * 12.0) > 0.2 && fract(at.x * 12.0) < 0.8 && at.y > 0.76 && at.y < 0.94;
    return vec3(inside ? light_of_input((step_ + 1.0) / 255.0 * 2.0) : 0.0);
}

void main()
{
    float angle;
    vec2 p = gl_FragCoord.xy - pattern.origin.xy, size = pattern.origin.zw;
    vec3 n = look(pattern.row0, pattern.row1, pattern.row2, p, 0, angle);
    bool seen = !MAP || angle > 0.0;
    vec3 light = vec3(0.0);
    if (PATTERN == PATTERN_GRID)
        light = grid(p, size);
    else if (PATTERN == PATTERN_RINGS && seen)
        light = rings(n, angle);
    else if (PATTERN == PATTERN_NAMES)
        light = names(p, size);
    else if (PATTERN == PATTERN_WEDGES && seen)
        light = wedges(p, size);
    else if (PATTERN == PATTERN_OVERLAP && seen)
        light = mix(pattern.tint.rgb * 0.8, vec3(0.0), labels(p, size, false));
    shown = vec4(light, 1.0);
}
