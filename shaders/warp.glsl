// The relativistic transform of one output pixel, as shown.
#include "shared.h"
#include "physics/real.glsl"
#include "physics/aberration.glsl"
#include "physics/galilean.glsl"
#include "view.glsl"
#include "received_light.glsl"
#include "tone.glsl"
#include "sun_glare.glsl"
#include "dither.glsl"
#include "range.glsl"

#include "constants.h"

LINEAR_CONSTANTS(DECLARED)
DITHER_CONSTANTS(DECLARED)

layout(location = 0) out vec4 shown;

vec4 starlight_at(vec2 pixel) { return texelFetch(stars_picture, ivec2(pixel + view.corner.xy), 0); }

// Exposed. shows: false where the map shows nothing; there the light is 0.
vec3 exposed_light(vec2 pixel, int channel, out bool shows)
{
    float pixel_angle, stops = ONE_LIGHT ? view.zenith.x : 0.0; // of one light the exposure joins its other powers of two
#if defined DARK
    vec3 light = vec3(0.0);
    if (MAP)
        look(view.row0, view.row1, view.row2, pixel, channel, pixel_angle);
#elif defined ONE_RAY
    vec3 light = light_at_middle(pixel, channel, stops, pixel_angle);
#else
    vec3 light = light_at(pixel, channel, stops, pixel_angle);
#endif
    shows = !MAP || pixel_angle > 0.0;
    if (WITH_SUN_GLARE && !RANGE && shows) {
        float same_angle;
        light += sun_glare(look(view.row0, view.row1, view.row2, pixel, channel, same_angle));
    }
    if (!ONE_LIGHT)
        light *= view.boost.z;
    if (STARS && shows && !RANGE)
        light += starlight_at(pixel).rgb;
    return light;
}

void main()
{
    vec2 pixel = gl_FragCoord.xy - view.origin.xy;
    bool shows;
    vec3 light = exposed_light(pixel, 0, shows);
#if !defined ONE_RAY && !defined DARK
    bool also_shows;
    if (CHANNELS)
        light = vec3(light.r, exposed_light(pixel, 1, also_shows).g, exposed_light(pixel, 2, also_shows).b);
#endif
    // Infinite D^3 is clamped to a number: the greatest light is already white, and 60000 is fp16's greatest, nearly.
    light = clamp(light, vec3(0.0), vec3(LINEAR && !RANGE ? 60000.0 : 1e30));
    if (RANGE) {
        float whole = luminance_of(light);
        light *= range_factor(whole);
        if (STARS && shows) {
            // Each star went through the curve as a whole: its spot keeps its shape. A crowd of them is no brighter than the
            // curve shows its light.
            vec4 stars = starlight_at(pixel);
            whole += stars.a;
            light += max(stars.rgb, vec3(0.0));
            light *= min(whole * range_factor(whole) / max(luminance_of(light), 1e-30), 1.0);
        }
    }
    if (LINEAR) {
        shown = vec4(min(light, vec3(60000.0)), shows ? 1.0 : 0.0);
        return;
    }
#ifdef DARK
    // Few pixels hold a star. A driver without a GPU passes by a loop, not a branch.
    shown = vec4(0.0, 0.0, 0.0, 1.0);
    for (int turn = 0; turn < (light == vec3(0.0) ? 0 : 1); ++turn)
#endif
    {
        vec3 screen = RANGE ? tone_map_in_order(light) : tone_map(light);
        shown = vec4(DITHERED ? dithered_srgb(screen, ivec2(gl_FragCoord.xy)) : screen, 1.0);
    }
}
