#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "constants.h"
#include "physics/real.glsl"
#include "physics/aberration.glsl"
#include "physics/galilean.glsl"
#include "view.glsl"
#include "received_light.glsl"
#include "distance.glsl"
#include "scale.glsl"
#include "panorama.glsl"
// The overlays of a viewport: the world's directions, the ring where D is 1, distances and retarded times in false colours,
// the crosshair and the marks; or the constellations' lines alone. Line widths are in the viewport's own pixels.

OVERLAY_PASS_CONSTANTS(DECLARED)

layout(set = 1, binding = 0) uniform Constants { OverlayConstants overlay; };
layout(set = 1, binding = 1) uniform samplerBuffer figures;
layout(location = 0) out vec4 shown; // premultiplied

vec4 over(vec4 above, vec4 below) { return above + below * (1.0 - above.a); }

// A line, from the distance to its middle in pixels, with a dark edge for bright skies.
vec4 line(vec3 colour, float off, float half_width, float strength)
{
    float ink = clamp(half_width + 0.5 - abs(off), 0.0, 1.0), edge = clamp(half_width + 2.0 - abs(off), 0.0, 1.0);
    return vec4(colour * ink, ink + 0.5 * edge * (1.0 - ink)) * strength;
}

// Distance from the nearest multiple of `step`, signed.
float from_multiple(float x, float step) { return x - step * round(x / step); }

// Parallels and meridians of the world every 15 degrees, poles at +y and -y; the horizon and the four main meridians are
// wider. n: the world's direction; footprint: of a pixel there, radians.
vec4 grid(vec3 n, float footprint)
{
    const float apart = radians(15.0);
    float latitude = asin(clamp(n.y, -1.0, 1.0)), longitude = atan(n.x, -n.z), across = length(n.xz);
    // Lines only a few pixels apart fade, so that they don't fill the picture.
    float room = clamp(apart / footprint / 8.0 - 0.5, 0.0, 1.0);
    vec4 sum = vec4(0.0);
    if (abs(latitude) < radians(82.0)) {
        float off = from_multiple(latitude, apart) / footprint;
        sum = line(vec3(0.55, 0.75, 0.85), off, 0.6, 0.6 * room);
    }
    float off = sin(from_multiple(longitude, apart)) * across / footprint;
    if (across > sin(apart)) // nearer the poles the four main ones are enough
        sum = over(line(vec3(0.55, 0.75, 0.85), off, 0.6, 0.6 * room * clamp(apart * across / footprint / 8.0 - 0.5, 0.0, 1.0)), sum);
    float wide_room = clamp(6.0 * apart / footprint / 8.0 - 0.5, 0.0, 1.0);
    off = sin(from_multiple(longitude, radians(90.0))) * across / footprint;
    bool ahead = abs(n.z) > abs(n.x);
    sum = over(line(ahead ? vec3(0.45, 0.85, 1.0) : vec3(0.65, 0.95, 0.55), off, 1.1, 0.9 * wide_room), sum);
    return over(line(vec3(1.0, 0.62, 0.2), latitude / footprint, 1.1, 0.9 * wide_room), sum); // the horizon
}

// The constellations' lines, which stop short of their stars. n: the world's direction; footprint: of a pixel there, radians.
vec4 constellations(vec3 n, float footprint)
{
    vec2 at = place_in_panorama(n);
    int row = clamp(int(at.y * float(FIGURE_ROWS)), 0, FIGURE_ROWS - 1),
        column = clamp(int(fract(at.x + 0.5) * float(FIGURE_COLUMNS)), 0, FIGURE_COLUMNS - 1);
    vec4 cell = texelFetch(figures, row * FIGURE_COLUMNS + column);
    float nearest = 9.0, gap = max(radians(0.7), 3.0 * footprint);
    for (int i = 0; i < int(cell.y); ++i) {
        vec3 a = texelFetch(figures, int(cell.x) + 2 * i).xyz, b = texelFetch(figures, int(cell.x) + 2 * i + 1).xyz;
        vec3 axis = normalize(cross(a, b)), from_a = n - a, from_b = n - b;
        bool between = dot(cross(axis, a), n) > 0.0 && dot(cross(b, axis), n) > 0.0;
        if (between && min(dot(from_a, from_a), dot(from_b, from_b)) > gap * gap)
            nearest = min(nearest, abs(dot(axis, n)));
    }
    // A line that is wider than the cells' reach fades, so that none ends at a cell's edge.
    float room = clamp(2.0 - 4.0 * footprint / FIGURE_REACH, 0.0, 1.0);
    return line(vec3(0.5, 0.7, 1.0), nearest / footprint, 0.4, 0.75 * room);
}

// The ring where D = 1. n: the ship's direction, motion axes.
vec4 ring(vec3 n, float pixel_angle)
{
    float away = length(n.xy) * overlay.ring.x - n.z * overlay.ring.y; // sine of the angle beyond it
    float off = (dot(n.xy, n.xy) > 0.0 || n.z > 0.0 ? away : 1.0) / pixel_angle;
    // Both sides are tinted close to the ring: blue inside, red outside.
    float side = exp(-abs(off) / 14.0) * 0.55;
    vec4 tint = vec4((off < 0.0 ? vec3(0.05, 0.15, 0.9) : vec3(0.9, 0.06, 0.03)) * side, side);
    return over(line(vec3(1.0), off, 0.9, 1.0), tint) * overlay.ring.z;
}

// Ticks of a scale of degrees: every degree, longer every five, longest every ten. along: the angle; across: the distance
// from the scale's line; both in radians.
vec4 degree_ticks(float along, float across, float pixel_angle)
{
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 3; ++i) {
        float apart = radians(i == 0 ? 1.0 : i == 1 ? 5.0 : 10.0), reach = radians(i == 0 ? 0.35 : i == 1 ? 0.7 : 1.1);
        float room = clamp(apart / pixel_angle / 3.0 - 0.5, 0.0, 1.0); // ticks a few pixels apart would fill the line
        float within = clamp((reach - abs(across)) / pixel_angle + 0.5, 0.0, 1.0);
        sum = over(line(vec3(1.0), from_multiple(along, apart) / pixel_angle, 0.4, room * within), sum);
    }
    return sum;
}

// Circles around the motion, and a scale of degrees from it through the crosshair and beyond. n: the ship's direction, motion
// axes.
vec4 protractor(vec3 n, float pixel_angle)
{
    float angle = atan(length(n.xy), n.z), ten = from_multiple(angle, radians(10.0)), thirty = from_multiple(angle, radians(30.0));
    vec4 sum = line(vec3(0.55, 0.75, 0.85), ten / pixel_angle, 0.6, 0.7);
    sum = over(line(vec3(0.45, 0.85, 1.0), thirty / pixel_angle, 1.1, 0.9), sum);
    sum = over(line(vec3(1.0, 0.62, 0.2), (angle - radians(90.0)) / pixel_angle, 1.1, 0.9), sum);
    // Straight ahead the crosshair has no side: the scale is level.
    vec2 aside = overlay.aim[int(overlay.world0.w)].xy;
    aside = dot(aside, aside) > 1e-6 ? aside : overlay.right.xy;
    float across = dot(n.xy, vec2(-aside.y, aside.x)) / length(aside);
    sum = over(line(vec3(1.0), across / pixel_angle, 0.4, 0.8), sum);
    return over(degree_ticks(angle, across, pixel_angle), sum) * overlay.ring.z;
}

// A distance (scene units) along n (the ship's direction, motion axes) as a colour with contours; the picture behind stays
// visible.
vec4 false_colour(float distance, vec3 n)
{
    bool sky = is_sky(distance);
    float logarithm = log2(sky ? 1e30 : max(distance, 1e-30)) * 0.30103 + overlay.scale.z; // of seconds of light
    float per_pixel = max(fwidth(logarithm), 1e-7);
    float off, wide_off, room, fine_off = 1e9, fine_room = 0.0;
    if (OVERLAY == OVERLAY_EMISSION) {
        // Light's travel time; without light delay the lapse between the world's present and the ship's.
        float later = overlay.ring.w > 0.0 ? overlay.steps.w * n.z : -1.0;
        float time = overlay.steps.y + (sky ? 0.0 : distance * later * overlay.steps.z), step = overlay.steps.x;
        float footprint = max(fwidth(time), 1e-7 * step);
        off = from_multiple(time, step) / footprint;
        wide_off = from_multiple(time, 5.0 * step) / footprint;
        room = clamp(step / footprint / 6.0 - 0.5, 0.0, 1.0);
    } else {
        // Contours are at 1, 2 and 5 times each power of ten, with ten finer ones between.
        float within = fract(logarithm), nearest = 1.0;
        float leading = exp2(within * 3.3219281), apart = leading < 2.0 ? 0.1 : leading < 5.0 ? 0.2 : 0.5;
        fine_off = from_multiple(leading, apart) / (leading * 2.3025851 * per_pixel);
        fine_room = 0.45 * clamp(apart / (leading * 2.3025851 * per_pixel) / 8.0 - 0.5, 0.0, 1.0);
        const float at[4] = float[4](0.0, 0.30103, 0.69897, 1.0);
        for (int i = 0; i < 4; ++i)
            nearest = min(nearest, abs(within - at[i]));
        off = nearest / per_pixel;
        wide_off = from_multiple(logarithm, 1.0) / per_pixel;
        room = clamp(0.3 / per_pixel / 6.0 - 0.5, 0.0, 1.0);
    }
    if (sky)
        return vec4(0.0, 0.0, 0.0, 0.35);
    vec3 colour = scale_colour((logarithm - overlay.scale.x) * overlay.scale.y);
    vec4 sum = vec4(colour, 1.0) * 0.72;
    float ink = max(clamp(1.2 - abs(off), 0.0, 1.0), clamp(1.9 - abs(wide_off), 0.0, 1.0)) * room;
    ink = max(ink, clamp(1.0 - abs(fine_off), 0.0, 1.0) * fine_room);
    vec3 contour = dot(colour, vec3(0.2, 0.7, 0.1)) > 0.25 ? vec3(0.0) : vec3(1.0);
    return over(vec4(contour, 1.0) * (0.8 * ink), sum);
}

// The crosshair and the marks.
vec4 signs(vec3 n, float pixel_angle)
{
    vec4 sum = vec4(0.0);
    int none = int(overlay.world0.w); // shared.h says why
    vec4 marks[2] = vec4[2](overlay.marks[none], overlay.marks[none + 1]);
    vec3 first = marks[0].xyz, second = marks[1].xyz;
    if (marks[0].w > 0.0 && marks[1].w > 0.0) {
        // Dashes follow the great circle between them.
        vec3 axis = cross(first, second);
        float sine = length(axis);
        if (sine > 1e-6) {
            axis /= sine;
            if (dot(cross(first, n), axis) > 0.0 && dot(cross(n, second), axis) > 0.0) {
                float along = atan(dot(cross(first, n), axis), dot(first, n)), across = dot(n, axis);
                float dash = step(0.5, fract(along / max(radians(0.8), 8.0 * pixel_angle)));
                bool ruler = OVERLAY == OVERLAY_PROTRACTOR;
                sum = line(vec3(1.0), across / pixel_angle, 0.6, ruler ? 0.8 : 0.8 * dash);
                if (ruler)
                    sum = over(degree_ticks(along, across, pixel_angle), sum);
            }
        }
    }
    float size = max(radians(1.0), 6.0 * pixel_angle), width = max(radians(0.05), 1.2 * pixel_angle);
    for (int i = 0; i < 2; ++i) {
        vec3 to = n - marks[i].xyz;
        if (marks[i].w <= 0.0 || dot(to, to) > 9.0 * size * size)
            continue;
        vec2 at = vec2(dot(to, overlay.right.xyz), dot(to, overlay.up.xyz));
        // At the edge of the view the look's axes are oblique; the length is always right.
        at *= length(to) / max(length(at), 1e-9);
        float off = i == 0 ? length(at) - size : 0.7071 * (abs(at.x) + abs(at.y) - 1.2 * size);
        sum = over(line(i == 0 ? vec3(1.0, 0.62, 0.2) : vec3(0.35, 0.9, 1.0), off / pixel_angle, 0.5 * width / pixel_angle, 1.0), sum);
        sum = over(line(vec3(1.0), length(at) / pixel_angle, 0.5 * width / pixel_angle, 1.0), sum);
    }
    vec4 aim = overlay.aim[none];
    vec3 to = n - aim.xyz;
    float reach = max(radians(1.6), 14.0 * pixel_angle);
    if (aim.w > 0.0 && dot(to, to) < 4.0 * reach * reach) {
        vec2 at = abs(vec2(dot(to, overlay.right.xyz), dot(to, overlay.up.xyz)));
        float along = max(at.x, at.y), beside = min(at.x, at.y);
        float gap = clamp((along - 0.3 * reach) / pixel_angle + 0.5, 0.0, 1.0) * clamp((reach - along) / pixel_angle + 0.5, 0.0, 1.0);
        sum = over(line(vec3(1.0), beside / pixel_angle, 0.5 * width / pixel_angle, gap), sum);
        sum = over(line(vec3(1.0), length(at) / pixel_angle, 0.5 * width / pixel_angle, 1.0), sum);
    }
    return sum;
}

void main()
{
    float pixel_angle;
    vec3 n = look(view.row0, view.row1, view.row2, gl_FragCoord.xy - view.origin.xy, CHANNELS ? 1 : 0, pixel_angle);
    if (MAP && pixel_angle == 0.0)
        discard;
    vec4 sum = vec4(0.0);
    if (OVERLAY == OVERLAY_GRID || OVERLAY == OVERLAY_FIGURES) {
        AberratedRay sight = from_camera(n, view.boost.xy);
        vec3 world = ABERRATION ? sight.n : n;
        world = vec3(dot(overlay.world0.xyz, world), dot(overlay.world1.xyz, world), dot(overlay.world2.xyz, world));
        float footprint = world_angle(sight, n, pixel_angle);
        sum = OVERLAY == OVERLAY_GRID ? grid(world, footprint) : constellations(world, footprint);
    }
    if (OVERLAY == OVERLAY_RING)
        sum = ring(n, pixel_angle);
    if (OVERLAY == OVERLAY_PROTRACTOR)
        sum = protractor(n, pixel_angle);
    if (OVERLAY == OVERLAY_DISTANCE || OVERLAY == OVERLAY_EMISSION) {
        Shown seen = shown_along(n, pixel_angle);
        // Moving things have no distance in the world where velocities simply add.
        bool unknown = GALILEAN && seen.frame > 0.0;
        sum = false_colour(unknown ? SKY_DISTANCE : exact_distance(seen, pixel_angle), n);
    }
    if (OVERLAY == OVERLAY_FIGURES && sum.a > 0.0 && !is_sky(shown_along(n, pixel_angle).distance))
        discard;
    shown = OVERLAY == OVERLAY_FIGURES ? sum : over(signs(n, pixel_angle), sum);
}
