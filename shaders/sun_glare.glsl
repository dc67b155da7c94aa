// The Sun's glare over the whole picture, in worlds with globes.
#ifdef WITH_GLOBES
#include "physics/glare.glsl"
const bool WITH_SUN_GLARE = true;
// n: the ship's direction, motion axes. The same law as a star's glare, but without an end at 3 degrees, because the Sun's
// shows there. It fades instead: farther out it is an even veil, to which an eye adapts and which a picture would show as grey
// haze.
vec3 sun_glare(vec3 n)
{
    if (globes.sunlight.xyz == vec3(0.0))
        return vec3(0.0);
    vec3 off = n - globes.sun.xyz;
    float chord = sqrt(dot(off, off)), angle = degrees(2.0 * asin(min(0.5 * chord, 1.0)));
    float least = max(GLARE_LEAST, globes.sun.w);
    return globes.sunlight.xyz * (glare_at(angle * angle + least * least) * glare_fade(angle, SUN_GLARE_MOST));
}
#else
const bool WITH_SUN_GLARE = false;
vec3 sun_glare(vec3 n) { return vec3(0.0); }
#endif
