#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "constants.h"
// A block of 4 x 4 texels of a picture in the format BC7 (Khronos Data Format Specification 1.3, chapter 20), in its mode 6:
// two ends of four channels, 7 bits each and one more that an end's channels share, and 4 bits for each texel's place
// between them. The picture's edge fills a block that reaches beyond it.

COMPRESS_CONSTANTS(DECLARED)

layout(set = 0, binding = 0) uniform sampler2D picture; // one level
layout(location = 0) out uvec4 block;

const int TEXELS = 16, STEPS = 15, ROUNDS = 3, TURNS = 8;

// A texel's place between the ends. Each texel has 4 bits of `places`.
uint place_of(uvec2 places, int i) { return ((i < 8 ? places.x : places.y) >> (4 * (i & 7))) & 15u; }

// The weight of the last end at a place from 0 to STEPS, in 64ths, as the specification's table has it.
float weight(float place) { return floor(64.0 / float(STEPS) * place + 0.5); }

// A texel of the block as it is stored, 0 to 255. It is read again wherever it is needed: sixteen that are kept, and loops
// without a turn, take more registers than some graphics cards have.
vec4 texel(int i)
{
    ivec2 at = 4 * ivec2(gl_FragCoord.xy) + ivec2(i & 3, i >> 2);
    vec4 value = texelFetch(picture, min(at, textureSize(picture, 0) - 1), 0);
    if (COLOURS)
        value.rgb = mix(12.92 * value.rgb, 1.055 * pow(value.rgb, vec3(1.0 / 2.4)) - 0.055, greaterThan(value.rgb, vec3(0.0031308)));
    return round(value * 255.0);
}

// A block so far: whole ends, 0 to 255, each texel's place between them, and the sum of the squared errors.
struct Guess {
    vec4 ends[2];
    uvec2 places;
    float error;
};

// The nearest end that has the bit.
vec4 end_with(vec4 end, float bit) { return 2.0 * clamp(round((end - bit) / 2.0), 0.0, 127.0) + bit; }

Guess guess(vec4 first, vec4 last)
{
    Guess made;
    made.ends[0] = first, made.ends[1] = last, made.places = uvec2(0u), made.error = 0.0;
    vec4 along = last - first;
    float square = max(dot(along, along), 1e-6);
    [[dont_unroll]] for (int i = 0; i < TEXELS; ++i) {
        vec4 value = texel(i);
        float place = floor(clamp(dot(value - first, along) / square, 0.0, 1.0) * float(STEPS) + 0.5), w = weight(place);
        vec4 off = floor(((64.0 - w) * first + w * last + 32.0) / 64.0) - value;
        uint bits = uint(place) << (4 * (i & 7));
        made.places |= i < 8 ? uvec2(bits, 0u) : uvec2(0u, bits);
        made.error += dot(off, off);
    }
    return made;
}

// The best of the shared bits. An opaque block stays opaque: only odd ends reach 255.
void improve(inout Guess best, vec4 first, vec4 last, bool opaque)
{
    for (int bits = opaque ? 3 : 0; bits < 4; ++bits) {
        Guess next = guess(end_with(first, float(bits & 1)), end_with(last, float(bits >> 1)));
        if (next.error < best.error)
            best = next;
    }
}

// The direction in which the texels differ most, by powers of their covariance.
vec4 main_axis(vec4 mean)
{
    mat4 covariance = mat4(0.0);
    [[dont_unroll]] for (int i = 0; i < TEXELS; ++i) {
        vec4 off = texel(i) - mean;
        covariance += outerProduct(off, off);
    }
    vec4 axis = covariance * vec4(1.0, 0.9, 0.8, 0.7);
    for (int turn = 0; turn < TURNS; ++turn) {
        float longest = max(max(abs(axis.x), abs(axis.y)), max(abs(axis.z), abs(axis.w)));
        if (longest > 0.0)
            axis = covariance * (axis / longest);
    }
    float square = dot(axis, axis);
    return square > 0.0 ? axis * inversesqrt(square) : vec4(0.5);
}

// The ends that suit the texels' places best, by least squares. False where all texels have one place.
bool fitted(Guess from, out vec4 first, out vec4 last)
{
    float aa = 0.0, ab = 0.0, bb = 0.0;
    vec4 a_sum = vec4(0.0), b_sum = vec4(0.0);
    [[dont_unroll]] for (int i = 0; i < TEXELS; ++i) {
        float b = weight(float(place_of(from.places, i))) / 64.0, a = 1.0 - b;
        aa += a * a, ab += a * b, bb += b * b;
        vec4 value = texel(i);
        a_sum += a * value, b_sum += b * value;
    }
    float divisor = aa * bb - ab * ab;
    first = (bb * a_sum - ab * b_sum) / divisor, last = (aa * b_sum - ab * a_sum) / divisor;
    return divisor > 1e-3;
}

uvec4 words; // of the block, the lowest bit first

void put(uint value, int first, int count)
{
    words[first >> 5] |= value << (first & 31);
    if ((first & 31) + count > 32)
        words[(first >> 5) + 1] |= value >> (32 - (first & 31));
}

void main()
{
    vec4 mean = vec4(0.0);
    float least_alpha = 255.0;
    [[dont_unroll]] for (int i = 0; i < TEXELS; ++i) {
        vec4 value = texel(i);
        mean += value / float(TEXELS);
        least_alpha = min(least_alpha, value.a);
    }
    vec4 axis = main_axis(mean);
    float low = 0.0, high = 0.0;
    [[dont_unroll]] for (int i = 0; i < TEXELS; ++i) {
        float along = dot(texel(i) - mean, axis);
        low = min(low, along), high = max(high, along);
    }
    bool opaque = least_alpha == 255.0;
    Guess best;
    best.error = 1e30;
    improve(best, mean + low * axis, mean + high * axis, opaque);
    for (int turn = 0; turn < ROUNDS; ++turn) {
        vec4 first, last;
        if (fitted(best, first, last))
            improve(best, first, last, opaque);
    }
    // The first texel's highest bit is not stored: it is 0.
    bool turned = place_of(best.places, 0) > uint(STEPS / 2);
    vec4 first = best.ends[turned ? 1 : 0], last = best.ends[turned ? 0 : 1];
    words = uvec4(0u);
    put(64u, 0, 7); // the mode
    for (int channel = 0; channel < 4; ++channel) {
        put(uint(first[channel]) >> 1, 7 + 14 * channel, 7);
        put(uint(last[channel]) >> 1, 14 + 14 * channel, 7);
    }
    put(uint(first.x) & 1u, 63, 1);
    put(uint(last.x) & 1u, 64, 1);
    for (int i = 0; i < TEXELS; ++i)
        put(turned ? uint(STEPS) - place_of(best.places, i) : place_of(best.places, i), i == 0 ? 65 : 64 + 4 * i, i == 0 ? 3 : 4);
    block = words;
}
