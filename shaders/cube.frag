#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "constants.h"
#include "physics/real.glsl"
#include "physics/aberration.glsl"
#include "physics/worldline.glsl"
// A surface's scene-linear, pre-exposed light as basis coefficients: of reflected sunlight first, then of the scene's
// emission basis spectra. Constants compile out the parts that a world does not need. MAPPED: a build for surfaces with gloss
// or with maps that have coordinates of their own; matt surfaces do not pay for it.

COEFFICIENT_CONSTANTS(DECLARED)
MOTION_CONSTANTS(DECLARED) // of several rest frames: also writes its coverage, after the coefficients
CORNER_CONSTANTS(DECLARED)
TEXEL_CONSTANTS(DECLARED)
SAMPLE_CONSTANTS(DECLARED)

layout(set = 0, binding = 0) uniform Constants { CubeConstants cube; };
layout(set = 0, binding = 3) uniform Matrices { vec4 columns[MAX_MATRICES]; }; // Spectra::columns
layout(set = 0, binding = 4) readonly buffer Times { TimeEntry times[]; };
layout(set = 0, binding = 9) readonly buffer Surfaces { SurfaceEntry surfaces[]; };
layout(set = 1, binding = 0) uniform sampler2D base_texture;
layout(set = 1, binding = 1) uniform sampler2D emissive_texture;

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;
layout(location = 4) flat in uvec3 draw; // instance, and the members of DrawEntry
layout(location = 7) flat in vec4 emissive; // SurfaceEntry's members
layout(location = 8) flat in vec4 beyond;
layout(location = 9) flat in vec4 plain_colour; // of surfaces whose corners have none
layout(location = 0) out vec4 coefficients0;
layout(location = 1) out vec4 coefficients1;
layout(location = 2) out vec4 coefficients2;
layout(location = 3) out vec4 coefficients3;
layout(location = 4) out vec4 coefficients4;

const int GROUPS = UNSHIFTED ? 1 : GROUP_COUNT(REFLECTED + OWN, WITH_ALPHA);
const int KEPT = LAMPS_MOVE ? 1 : KINDS; // kinds of light that are summed before they illuminate
const vec3 luminance = vec3(0.2126, 0.7152, 0.0722); // Rec. 709

#include "light_travel_offset.glsl"
#include "clock.glsl"
#include "blink.glsl"
#include "shadow.glsl"
#ifdef MAPPED
#include "gloss.glsl"
#endif

// Adds to a coefficient.
void add_to(inout vec4 coefficients[MAX_GROUPS + 1], int k, float light)
{
    int place = PLACE_IN_GROUPS(k, WITH_ALPHA);
    coefficients[place / 4][place % 4] += light;
}

// A vector's squared length and a little more: its root's inverse is finite, as a lamp's light very close to a surface must be.
float square_of(vec3 v) { return v.x * v.x + (v.y * v.y + (v.z * v.z + 1e-18)); }

float mean(vec3 v) { return (v.x + v.y + v.z) * (1.0 / 3.0); }

// The reflected light in the ultraviolet and the infrared.
vec2 beyond_visible(vec3 lit, vec3 light)
{
    return vec2(beyond.x < 0.0 ? mean(lit) : beyond.x * mean(light), beyond.y < 0.0 ? mean(lit) : beyond.y * mean(light));
}

// Adds the coefficients of reflected light of one kind, by a set's columns. lit: the colour; invisible: ultraviolet and infrared.
void add_columns(inout vec4 coefficients[MAX_GROUPS + 1], int set, int kind, vec3 lit, vec2 invisible)
{
    int at = (UNSHIFTED ? OWN : 0) + (set * KINDS + kind) * (GROUPS * 5);
    for (int group = 0; group < GROUPS; ++group) {
        int column = at + group * 5;
        coefficients[group] += columns[column] * lit.r + columns[column + 1] * lit.g + columns[column + 2] * lit.b
            + columns[column + 3] * invisible.x + columns[column + 4] * invisible.y;
    }
}
// Adds a surface's coefficients under a light of one kind, and those of the sunlit colour that it emits.
void add_lit(inout vec4 coefficients[MAX_GROUPS + 1], int kind, vec3 base, vec3 light, vec3 emitted)
{
    vec3 lit = base * light;
    vec2 invisible = beyond_visible(lit, light) + mean(emitted);
    add_columns(coefficients, int(beyond.z), kind, lit + emitted, invisible);
}

#ifdef MAPPED
// Adds light that a surface reflects as white.
void add_white(inout vec4 coefficients[MAX_GROUPS + 1], int kind, vec3 light)
{
    if (MATRICES) {
        add_columns(coefficients, 0, kind, light, vec2(mean(light)));
        return;
    }
    coefficients[0].rgb += light;
    if (REFLECTED == 5) {
        add_to(coefficients, 3, mean(light));
        add_to(coefficients, 4, mean(light));
    }
}
#endif

// The retarded position of a point lamp that may move, as seen from a surface. Its distance is the light's travel distance in
// the lamp's frame, its direction is in the surface's. It also yields D; 0: no light. towards: from the surface, at the
// eye's time. The surface's light left `delay` earlier, and the lamp's light that it reflects left before that.
vec3 lamp_seen(LightEntry lamp, vec3 towards, float delay, out float D)
{
    D = lamp.kind.w;
    float u = lamp.way.w, own = 0.0;
    if (u > 0.0) {
        RetardedPosition seen = retarded_position(towards - lamp.way.xyz * (u / lamp.shifts.w * delay), lamp.way.xyz, u, lamp.shifts.w);
        D = seen.D;
        own = seen.tau - delay / lamp.shifts.w;
        towards = seen.place / D; // the light's travel distance is D times as long here
    } else {
        own = -delay - length(towards);
    }
    return own < lamp.kind.y || own > lamp.kind.z ? vec3(0.0) : towards;
}

// The part of a lamp's light that it sends within its cone to a surface. towards: from the surface to the lamp where its light left, unit.
float in_cone(LightEntry lamp, vec3 towards)
{
    if (lamp.edge.x == 0.0)
        return 1.0;
    if (LAMPS_MOVE && lamp.way.w > 0.0) {
        // In the lamp's frame the surface moves the other way.
        float ahead = -dot(towards, lamp.way.xyz), E = lamp.shifts.w + lamp.way.w;
        vec3 across = towards + lamp.way.xyz * ahead;
        AberratedRay sight = world_from_camera(vec3(length(across), 0.0, ahead), E, 1.0 / E);
        towards = across * sight.D - lamp.way.xyz * sight.n.z;
    }
    float part = clamp(lamp.edge.y - lamp.edge.x * dot(towards, lamp.cone.xyz), 0.0, 1.0);
    return part * part;
}

// The surface's clock, blinking and existence at its retarded time. ink: the clock's marks; lit_part: the part of the time
// in which it is lit.
void apply_time(inout vec4 base, out float ink, out float lit_part)
{
    ink = 0.0;
    lit_part = 1.0;
    if (!CLOCK && !FINITE_EXISTENCE && !BLINK)
        return;
    TimeEntry time = times[draw.x - uint(cube.first.x) + uint(cube.first.y)];
    float offset_s = travel_offset_from(place, time.middle);
    float late = light_travel_offset(place);
    vec2 step_ = vec2(dFdx(late), dFdy(late));
    if (CLOCK) {
        vec2 at = vec2(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y);
        ink = marks(at, mat2(dFdx(at), dFdy(at)), offset_s * time.turns.w, step_ * time.turns.w, time);
        base.rgb *= 1.0 - ink;
    }
    if (BLINK)
        lit_part = blinking(time.blink, offset_s, step_);
    if (FINITE_EXISTENCE && (offset_s < time.there.x || offset_s >= time.there.y))
        discard;
}

#ifdef MAPPED
vec2 emissive_uv() { return coordinates(surface.emissive); }
#else
vec2 emissive_uv() { return uv; }
#endif

// From the texel's middle to the mean place of its samples that the triangle covers (the Vulkan specification's standard sample
// locations), in texels. Light is taken there: a middle beyond the triangle may lie inside its neighbour, in a shadow that no
// sample has. Triangles that share a texel have its middle as the mean of their places, so that their border does not show.
vec2 lit_offset()
{
    const ivec2 sixteenths[14] = {{4, 4}, {-4, -4}, {-2, -6}, {6, -2}, {-6, 2}, {2, 6}, {1, -3}, {-1, 3}, {5, 1}, {-3, -5},
        {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
    ivec2 sum = ivec2(0);
    for (int i = 0; i < CUBE_SAMPLES; ++i)
        sum += (gl_SampleMaskIn[0] & 1 << i) != 0 ? sixteenths[CUBE_SAMPLES - 2 + i] : ivec2(0);
    return vec2(sum) / (16.0 * max(bitCount(gl_SampleMaskIn[0]), 1));
}

vec3 emitted_light(float ink, float lit_part)
{
    if (!EMITS)
        return vec3(0.0);
    vec3 emitted = emissive.rgb;
    if (EMISSIVE_TEXTURE)
        emitted *= texture(emissive_texture, emissive_uv()).rgb;
    if (CLOCK)
        emitted *= ink;
    if (BLINK)
        emitted *= lit_part;
    return emitted;
}

#ifdef MAPPED
#define SURFACE Glossy
vec3 white_light[KEPT]; // that a surface reflects as white, by its kind
#else
#define SURFACE vec3 // its unit normal
#endif

// Adds a lamp's light on a surface: to `light` by its kind, or to the coefficients at once where each lamp has a shift of
// its own. is_point: a point lamp, otherwise a directional one.
void add_lamp(inout vec4 coefficients[MAX_GROUPS + 1], inout vec3 light[KEPT], LightEntry lamp, bool is_point, vec3 point,
    SURFACE at, vec3 base, float lit)
{
    vec3 towards = is_point ? lamp.place.xyz - point : lamp.place.xyz;
    float D = lamp.kind.w;
    if (LAMPS_MOVE && is_point)
        towards = lamp_seen(lamp, towards, -light_travel_offset(point), D);
    if (LAMPS_MOVE && towards == vec3(0.0))
        return;
    float square = is_point ? square_of(towards) : 1.0;
    if (CONES)
        lit *= in_cone(lamp, towards * inversesqrt(square));
#ifdef MAPPED
    float distance_ = is_point ? sqrt(square) : 1.0;
    float facing = dot(at.n, towards) / distance_;
    if (!(facing > 0.0))
        return;
    vec3 falling = lit * (is_point ? lamp.radiance.rgb * (lamp.radiance.w / square) : lamp.radiance.rgb);
    vec2 parts = reflected_lamp(at, towards / distance_, facing);
    vec3 add = falling * parts.x, white = falling * parts.y;
#else
    float near = inversesqrt(square), facing = dot(at, towards);
    // Bounds of 0 and 1 cost a graphics card nothing.
    float cosine = clamp(is_point ? facing * near : facing, 0.0, 1.0);
    vec3 add = lamp.radiance.rgb * (cosine * (is_point ? lamp.radiance.w * (near * near) : 1.0) * lit);
#endif
    int first = int(lamp.kind.x);
    if (LAMPS_MOVE) {
        // In addition to the shift of its spectrum, a point light's flux per frequency grows as D.
        float shift = clamp((log2(D) - lamp.shifts.x) * lamp.shifts.y, 0.0, max(lamp.shifts.z - 1.001, 0.0));
        add_lit(coefficients, first + int(shift), base, add * (D * (1.0 - fract(shift))), vec3(0.0));
        if (fract(shift) > 0.0)
            add_lit(coefficients, first + int(shift) + 1, base, add * (D * fract(shift)), vec3(0.0));
#ifdef MAPPED
        add_white(coefficients, first + int(shift), white * (D * (1.0 - fract(shift))));
        if (fract(shift) > 0.0)
            add_white(coefficients, first + int(shift) + 1, white * (D * fract(shift)));
#endif
    } else {
        for (int kind = 0; kind < KEPT; ++kind) {
            light[kind] += KEPT == 1 || first == kind ? add : vec3(0.0);
#ifdef MAPPED
            white_light[kind] += KEPT == 1 || first == kind ? white : vec3(0.0);
#endif
        }
    }
}

// Adds the coefficients of reflected sunlight and of the sunlit colour that the surface emits.
void add_reflected(inout vec4 coefficients[MAX_GROUPS + 1], vec3 light[KEPT], vec3 base, vec3 emitted)
{
    if (MATRICES) {
        for (int kind = 0; kind < KEPT; ++kind)
            add_lit(coefficients, kind, base, light[kind], kind == 0 ? emitted : vec3(0.0));
        return;
    }
    vec3 lit = base * light[0];
    coefficients[0].rgb = lit + emitted;
    if (REFLECTED == 5) {
        vec2 invisible = beyond_visible(lit, light[0]) + mean(emitted);
        add_to(coefficients, 3, invisible.x);
        add_to(coefficients, 4, invisible.y);
    }
}

void write(vec4 coefficients[MAX_GROUPS + 1], float alpha)
{
    // 60000 is below fp16's greatest number: a light very close to a surface must not become infinite, nor change its colour.
    float most = 60000.0;
    for (int group = 0; group < GROUPS; ++group) {
        if (MATRICES || LAMPS_MOVE)
            coefficients[group] = clamp(coefficients[group], vec4(-1e30), vec4(1e30));
        vec4 size = abs(coefficients[group]);
        most = max(most, max(max(size.x, size.y), max(size.z, size.w)));
    }
    for (int group = 0; group < GROUPS; ++group)
        coefficients[group] *= 60000.0 / most;
    if (SEVERAL_REST_FRAMES) // a texel's samples are averaged: its coverage, and the sum of its depths
        coefficients[GROUPS] = vec4(1.0, gl_FragCoord.z, 0.0, 0.0);
    for (int group = 0; group < MAX_GROUPS + 1 && BLENDED; ++group)
        coefficients[group] = alpha * vec4(coefficients[group].rgb, 1.0);
    const int outputs = SEVERAL_REST_FRAMES ? GROUPS + 1 : GROUPS;
    coefficients0 = coefficients[0];
    if (outputs > 1)
        coefficients1 = coefficients[1];
    if (outputs > 2)
        coefficients2 = coefficients[2];
    if (outputs > 3)
        coefficients3 = coefficients[3];
    if (outputs > 4)
        coefficients4 = coefficients[4];
}

void main()
{
    vec4 base = COLOURED ? colour : plain_colour;
    if (BASE_TEXTURE)
        base *= texture(base_texture, uv);
    float ink, lit_part;
    apply_time(base, ink, lit_part);
    if (MASKED && (base.a < emissive.w) != BLENDED)
        discard;
    vec3 emitted = emitted_light(ink, lit_part);

    vec4 coefficients[MAX_GROUPS + 1];
    for (int group = 0; group < GROUPS; ++group)
        coefficients[group] = vec4(0.0);
    vec3 light[KEPT];
    for (int kind = 0; kind < KEPT; ++kind)
        light[kind] = vec3(0.0);
    light[0] = vec3(cube.ambient.w);
    if (!UNLIT) {
        vec3 lit_place = place, lit_normal = normal;
        if (CUBE_SAMPLES > 1) {
            // By derivatives, which have no bound at a horizon: interpolateAtOffset has the middle's perspective on lavapipe.
            vec2 off = lit_offset();
            vec3 step_ = off.x * dFdx(place) + off.y * dFdy(place);
            if (dot(step_, step_) < 0.1 * dot(place, place)) {
                lit_place += step_;
                lit_normal += off.x * dFdx(normal) + off.y * dFdy(normal);
            }
        }
        float squares = fma(lit_normal.x, lit_normal.x, 1e-37); // a normal of length 0, of a flattened thing, stays 0
        float unit = inversesqrt(fma(lit_normal.z, lit_normal.z, fma(lit_normal.y, lit_normal.y, squares)));
        vec3 n = lit_normal * (gl_FrontFacing ? unit : -unit);
        float daylight = SHADOWS == 0 ? 1.0 : ambient_part(lit_place, n);
        vec3 above = uintBitsToFloat(draw.z) * n; // to a place that is on the lit side of the full surface, or on it
#ifdef MAPPED
        Glossy at = glossy_at(lit_place, n, gl_FrontFacing);
        at.occlusion *= daylight;
        Reflected all_around = reflected_surroundings(at, cube.sky.up.xyz, cube.ambient.rgb, cube.around);
        for (int kind = 0; kind < KEPT; ++kind)
            white_light[kind] = vec3(0.0);
        light[0] = all_around.by_base;
        white_light[0] = all_around.white;
#else
        vec3 at = n;
        light[0] = cube.ambient.rgb * daylight;
#endif
        for (int i = 0; i < LIGHTS; ++i) {
            bool is_point = (POINT_LAMPS & 1 << i) != 0;
            float lit = 1.0;
            if ((SHADOWS & 1 << i) != 0)
                lit = is_point ? reached_from_near(cube.shadows[i], lit_place, above)
                               : reached_from_afar(cube.shadows[i], lit_place, above);
            add_lamp(coefficients, light, cube.lights[floatBitsToInt(cube.first.w) + i], is_point, lit_place, at, base.rgb,
                lit);
        }
    }

    bool own_emission = OWN > 0 && beyond.w >= 0.0;
    add_reflected(coefficients, light, base.rgb, own_emission ? vec3(0.0) : emitted);
#ifdef MAPPED
    for (int kind = 0; kind < KEPT && !UNLIT && !MATT; ++kind)
        add_white(coefficients, kind, white_light[kind]);
#endif
    for (int i = 0; i < OWN; ++i) {
        float own = surfaces[draw.y].own[i] + (int(beyond.w) == i ? dot(luminance, emitted) : 0.0);
        if (UNSHIFTED)
            coefficients[0] += columns[i] * own;
        else
            add_to(coefficients, REFLECTED + i, own);
    }
    write(coefficients, clamp(base.a, 0.0, 1.0));
}
