// Globes: the Sun, planets and moons, spheroids whose light each output pixel finds by itself along its own ray. They lie before
// the cube map's sky. Needs received_light.glsl's constants; docs/physics/solar-system.md has the formulas and their sources.
#include "panorama.glsl"
#include "physics/detail.glsl"
#include "physics/aurora.glsl"
#include "physics/eclipse.glsl"
#include "physics/sun_surface.glsl"

#include "constants.h"

GLOBE_CONSTANTS(DECLARED)

layout(set = 0, binding = 15) uniform Globes { GlobeConstants globes; };
layout(set = 0, binding = 16) uniform sampler2DArray globe_maps; // parts of up to three kinds of ground
layout(set = 0, binding = 17) uniform sampler2DArray fine_globe_maps; // of a globe with air: its ground and water; its clouds, and its lamps' light through them in two bytes
layout(set = 0, binding = 18) uniform sampler2D globe_light; // a row for each kind of light at each level, over log2 D:
                                                             // Rec. 709 over a scale, and the scale's binary logarithm
layout(set = 0, binding = 19) uniform sampler2D ring_profile; // optical depth and brightness, from the inner edge outwards

// The place of a Doppler factor in globe_light.
struct ShiftColumn {
    int at;
    float part, beyond; // between two columns; the loss beyond the table, where every tail falls as 1 / D^2
};
ShiftColumn shift_column(float D)
{
    float unclamped = (log2(DOPPLER ? D : 1.0) - GLOBE_FIRST_LOG2_D) * GLOBE_PER_OCTAVE;
    float at = clamp(unclamped, 0.0, float(GLOBE_COLUMNS) - 1.001);
    float beyond = exp2(min(0.0, (at - unclamped) / GLOBE_PER_OCTAVE));
    return ShiftColumn(int(at), fract(at), beyond * beyond);
}
// The colour of a kind's light. first: its row at level 0; level: below GLOBE_LEVELS - 1.
vec3 globe_colour(ShiftColumn column, float first, float level)
{
    int row = int(first) + int(level);
    vec4 low = mix(texelFetch(globe_light, ivec2(column.at, row), 0), texelFetch(globe_light, ivec2(column.at + 1, row), 0), column.part);
    vec4 high = mix(texelFetch(globe_light, ivec2(column.at, row + 1), 0), texelFetch(globe_light, ivec2(column.at + 1, row + 1), 0), column.part);
    vec4 here = mix(low, high, fract(level));
    return here.rgb * (exp2(here.w) * column.beyond);
}
// The level of light whose way leads through so much air, in vertical columns from the ground: mass = (2^level - 1) / 2.
float air_level(float mass) { return min(log2(1.0 + 2.0 * mass), float(GLOBE_LEVELS) - 1.001); }

// The air along a ray from a height to space over the vertical column from the ground (Chapman's function, after Schueler, "An
// approximation to the Chapman grazing-incidence function", 2012, within 2 %). r: from the middle, radii; x: 1 / scale height; mu:
// cosine of the ray's angle from the zenith.
float air_above(float r, float x, float mu)
{
    float c = sqrt(1.5707963 * x * r), here = exp((1.0 - r) * x), up = here * c / ((c - 1.0) * abs(mu) + 1.0);
    if (mu >= 0.0)
        return up;
    float lowest = r * sqrt(1.0 - mu * mu);
    return 2.0 * sqrt(1.5707963 * x * lowest) * exp(min((1.0 - lowest) * x, 0.0)) - up;
}

// An element of the list, by constant indices where a driver in software would read it pixel by pixel.
GlobeEntry globe(int i) { return globes.entries[i + floatBitsToInt(globes.first.w)]; }

// A ray to a globe, in its own axes scaled by its radii, in which it is a sphere of radius 1.
struct GlobeRay {
    vec3 from, way, nearest; // unit way; the nearest point to the middle
    float ahead, off, pixel; // the way to that point, its distance from the middle, a pixel's width there
};
GlobeRay globe_ray(GlobeEntry g, vec3 n, float angle)
{
    GlobeRay ray;
    ray.from = vec3(g.row0.w, g.row1.w, g.row2.w);
    ray.way = vec3(dot(g.row0.xyz, n), dot(g.row1.xyz, n), dot(g.row2.xyz, n));
    ray.way *= inversesqrt(dot(ray.way, ray.way));
    ray.ahead = -dot(ray.from, ray.way);
    ray.nearest = ray.from + ray.way * ray.ahead;
    ray.off = length(ray.nearest);
    ray.pixel = max(angle * ray.ahead, 1e-12);
    return ray;
}
float covered(GlobeRay ray) { return ray.ahead > 0.0 ? clamp(0.5 + (1.0 - ray.off) / ray.pixel, 0.0, 1.0) : 0.0; }

// The distance from a globe's middle of the middle of the part of a pixel that lies before the globe.
float middle_before(GlobeRay ray)
{
    float low = max(ray.off - 0.5 * ray.pixel, -1.0), high = ray.off + 0.5 * ray.pixel;
    return high > 1.0 ? 0.5 * (low + 1.0) : ray.off;
}

// Ways through a globe's air within a pixel. One is enough where the pixel is finer than the air. Where it is coarser and has
// a part beside the globe, way 0 is the middle of its part before the globe, and the others lie in its part beside it.
struct AirWays {
    int first, last, steps; // ways; places on each
    float low, high; // the lowest and the highest height of the ways beside the globe, as exp(-height / scale)
    float scale, beside; // of these heights; the part of the pixel that lies beside the globe
};
const int AIR_WAYS = 4;
AirWays air_ways(GlobeRay ray, float top, float x)
{
    float scale = 4.0 / x, inner = max(ray.off - 0.5 * ray.pixel, 0.0), low = max(inner, 1.0), high = ray.off + 0.5 * ray.pixel;
    // The ways are parallel to the ray: all must begin outside the air, or one could begin below the ground.
    bool near = ray.ahead * ray.ahead + inner * inner < top * top;
    if (ray.ahead <= 0.0 || near || ray.pixel * x < 0.5 || high <= 1.0 || low >= top)
        return AirWays(0, 0, GLOBE_AIR_STEPS, 0.0, 0.0, 0.0, 1.0);
    return AirWays(low > 1.0 ? 1 : 0, AIR_WAYS, 3 * GLOBE_AIR_STEPS, exp((1.0 - low) / scale),
        exp((1.0 - min(high, top)) / scale), scale, (high - low) / ray.pixel);
}
// Way number k: its distance from the globe's middle, and the part of the pixel that it stands for. middle: middle_before().
vec2 air_way(AirWays ways, GlobeRay ray, float middle, int k)
{
    if (ways.last == 0)
        return vec2(ray.off, 1.0);
    if (k == 0)
        return vec2(middle, 1.0 - ways.beside);
    float at = mix(ways.low, ways.high, (float(k) - 0.5) / float(AIR_WAYS));
    return vec2(1.0 - ways.scale * log(at), ways.scale * (ways.low - ways.high) / (float(AIR_WAYS) * at * ray.pixel));
}

// The part of a globe's light that is shown as a star's. radius: its radius in the picture, pixels.
float point_part(float radius) { return 1.0 - smoothstep(0.8, 1.6, radius); }

const int RING_PLACES = 8;
// A ring's pixel: some places across it, of which each has its own optical depth along the normal and its brightness.
struct RingPixel {
    float radius, step_; // the first place's, and the distance to the next
    float inside;        // the part of the pixel that the ring covers
};
// radius: from the middle; pixel: its change across a pixel.
RingPixel ring_pixel(GlobeEntry g, float radius, float pixel)
{
    pixel = clamp(pixel, 1e-9, 0.5 * radius); // near the plane's horizon a pixel does not reach back to the ring
    float inside = (min(radius + 0.5 * pixel, g.ring.y) - max(radius - 0.5 * pixel, g.ring.x)) / pixel;
    return RingPixel(radius + (0.5 / float(RING_PLACES) - 0.5) * pixel, pixel / float(RING_PLACES), max(inside, 0.0));
}
vec2 ring_place(GlobeEntry g, RingPixel at, int i)
{
    float part = (at.radius + float(i) * at.step_ - g.ring.x) / (g.ring.y - g.ring.x);
    return textureLod(ring_profile, vec2(part, 0.5), 0.0).rg * vec2(GLOBE_DEEPEST_RING, 1.0);
}
// The part of light that passes the ring. mu: cosine of its way from the normal.
float through_ring_at(GlobeEntry g, float radius, float pixel, float mu)
{
    RingPixel at = ring_pixel(g, radius, pixel);
    float sum = 0.0;
    for (int i = 0; at.inside > 0.0 && i < RING_PLACES; ++i)
        sum += exp(-ring_place(g, at, i).x / mu);
    return mix(1.0, sum / float(RING_PLACES), at.inside);
}
// The change of the distance from the axis, over a step across a way, where the way meets the ring's plane.
float radius_step(vec3 at, vec3 way)
{
    float slope = dot(at.xy, way.xy) / max(length(at.xy) * abs(way.z), 1e-6);
    return sqrt(1.0 + slope * slope);
}
// The place of a ray in the ring's plane; false: it is behind the eye.
bool ring_hit(GlobeEntry g, GlobeRay ray, out float t, out float radius, out float pixel)
{
    t = -ray.from.z / (abs(ray.way.z) < 1e-9 ? 1e-9 : ray.way.z);
    vec3 at = ray.from + ray.way * t;
    radius = length(at.xy);
    pixel = ray.pixel * abs(t / ray.ahead) * radius_step(at, ray.way);
    return t > 0.0;
}

// The part of the Sun's light that another globe leaves. at: a place in a globe's own axes, radii.
float left_by_other(GlobeEntry g, vec3 at)
{
    if (g.shade.w == 0.0)
        return 1.0;
    vec3 to = g.shade.xyz - at, sun = normalize(g.light.xyz - at * g.lamps.z);
    float distance = length(to);
    if (dot(to, sun) < 0.0)
        return 1.0;
    return left_of_sun(g.shade.w / (distance * g.ring.w), length(to / distance - sun) / g.ring.w);
}

// Half of a ray's chord through a ball around a globe's middle, the mean over the pixel.
float half_chord_in(float radius, GlobeRay ray)
{
    float left = radius - ray.off, half_ = max(0.5 * ray.pixel, 0.01 * abs(left)); // else the difference would cancel
    float far = max(left + half_, 0.0), near = max(left - half_, 0.0);
    return sqrt(radius + ray.off) * (far * sqrt(far) - near * sqrt(near)) / (3.0 * half_);
}
// The direction of a ray's place from the globe's middle, own axes. along: from its place nearest to the middle.
vec3 above_globe(vec3 own, GlobeRay ray, float along) { return normalize((ray.nearest + ray.way * along) * own); }
// The middle of the oval on a direction's half.
vec3 oval_towards(vec3 up) { return dot(up, globes.aurora.xyz) < 0.0 ? -globes.aurora.xyz : globes.aurora.xyz; }
// True where a ray's way between two places may meet an aurora.
bool meets_aurora(vec3 own, GlobeRay ray, float begin, float end)
{
    vec3 middle = above_globe(own, ray, 0.5 * (begin + end)), first = above_globe(own, ray, begin);
    float reach = AURORA_REACH + acos(min(dot(middle, first), 1.0));
    return begin < end && abs(acos(min(dot(middle, oval_towards(middle)), 1.0)) - AURORA_RADIUS) < reach;
}
// The light of what shines above the air: before the ray's nearest place to the middle, and behind it. The layers of aurora lie
// on each other: a ray meets their boundaries from the highest to the lowest, and again upwards.
void add_glows(vec3 own, GlobeRay ray, ShiftColumn column, float disc, inout vec3 before, inout vec3 behind)
{
    int even = int(globes.first.y), layers = int(globes.first.z);
    for (int i = 0; i < even; ++i) {
        vec4 layer = globes.glows[i];
        float low = half_chord_in(layer.x, ray), high = half_chord_in(layer.y, ray);
        vec2 way = max(vec2(-low, high) - max(vec2(-high, low), -ray.ahead), 0.0);
        vec3 light = globe_colour(column, layer.w, 0.0) * (layer.z * disc);
        before += light * way.x, behind += light * way.y;
    }
    if (layers == 0)
        return;
    float lowest = half_chord_in(globes.glows[even].x, ray), highest = half_chord_in(globes.aurora.w, ray);
    bool hidden = ray.ahead > 0.0 && ray.off < 1.0 - ray.pixel; // by the ground
    bool far = !hidden && meets_aurora(own, ray, max(lowest, -ray.ahead), highest);
    bool near = meets_aurora(own, ray, max(-highest, -ray.ahead), -lowest);
    // A driver in software computes a branch that no pixel takes, but ends a loop.
    int last = far ? 2 * layers + 1 : near ? layers : -1;
    float from_along = 0.0;
    AuroraPlace from = AuroraPlace(0.0, 0.0, 0.0);
    for (int k = 0; k <= last; ++k) {
        bool down = k <= layers;
        int boundary = down ? layers - k : k - layers - 1;
        float half_ = half_chord_in(boundary < layers ? globes.glows[even + boundary].x : globes.aurora.w, ray);
        float along = max(down ? -half_ : half_, -ray.ahead), way = along - from_along;
        vec3 up = above_globe(own, ray, along);
        AuroraPlace here = aurora_place(up, oval_towards(up));
        if (k > 0 && k != layers + 1 && way > 0.0) {
            // The rays are those of the place nearest to the outer arc.
            float at = mix(from_along, along, clamp(from.outer / (from.outer - here.outer), 0.0, 1.0));
            vec4 layer = globes.glows[even + (down ? boundary : boundary - 1)];
            float pixel = aurora_pixel(ray.pixel / max(ray.ahead, 1e-9) * max(ray.ahead + at, 0.0), layer.x - 1.0);
            vec3 light = globe_colour(column, layer.w, 0.0)
                * (layer.z * disc * way * aurora(from, here, aurora_rays(above_globe(own, ray, at), pixel), pixel));
            before += down ? light : vec3(0.0), behind += down ? vec3(0.0) : light;
        }
        from_along = along, from = here;
    }
}

// The ground of a globe with air, and what is above it.
struct Ground {
    vec3 kinds; // the parts of land
    float water, cloud, lamps, wind; // lamps: as they are seen through the clouds; wind: m/s
    float land_sun, cloud_sun; // the part of sunlight that slopes catch
};
// The maps' parts at a normal, and where a pixel is finer than they their detail. place: in the maps; level: of the pixel.
Ground detailed(GlobeEntry g, vec3 normal, vec2 place, float level)
{
    float cells = g.map.y / 3.14159265, cosine = dot(normal, g.light.xyz);
    Detail detail = detail_at(normal * cells, g.light.xyz - normal * cosine, -level);
    vec4 map = textureLod(fine_globe_maps, vec3(place, 0.0), level);
    vec3 sky = textureLod(fine_globe_maps, vec3(place, 1.0), level).rgb;
    Ground here;
    here.cloud = detail_cover(sky.r, detail.value.x, detail.variance.x);
    here.water = detail_cover(map.a, detail.value.y, detail.variance.y);
    float light = max(1.0 + GLOBE_LAND_CONTRAST * detail.value.y, 0.2);
    here.kinds = map.rgb * (g.shape.x * (1.0 - here.water) / max(1.0 - map.a, 1e-3) * light);
    here.wind = 7.0 * clamp(1.0 + GLOBE_WIND_CONTRAST * detail.value.y, 0.2, 1.8);
    here.lamps = (sky.g * (65280.0 / 65535.0) + sky.b * (255.0 / 65535.0)) * ((1.0 - here.cloud) / max(1.0 - sky.r, 1e-3))
        * detail_spots(detail.value.y, detail.variance.y, GLOBE_LAMP_CONTRAST);
    here.land_sun = max(cosine - detail_slope(detail.slope.y, GLOBE_LAND_RELIEF * cells), 0.0);
    here.cloud_sun = max(cosine - detail_slope(detail.slope.x, GLOBE_CLOUD_RELIEF * cells), 0.0);
    return here;
}

// Light, before the headlight effect. light: behind the globe on entry, with it on return. n: unit direction in
// the world, the cube map's axes; angle: of a ray there. disc: the part of its light that is no star's.
void add_globe(GlobeEntry g, vec3 n, float angle, float disc, ShiftColumn column, inout vec3 light)
{
    GlobeRay ray = globe_ray(g, n, angle);
    // Edges as soft as a pixel make a small disc too large, by a twelfth of a square pixel. Its light lacks as much, but it hides all
    // that is behind it, which may be the Sun.
    float pixels = g.shape.z / angle;
    float hides = covered(ray) * disc, cover = hides / (1.0 + 1.0 / max(12.0 * pixels * pixels, 1.0));
    vec3 own = vec3(1.0, 1.0, g.shape.y); // from the scaled axes to those of one unit
    vec3 sun_scaled = normalize(g.light.xyz / own);
    vec3 way = normalize(ray.way * own);
    float middle = middle_before(ray);
    float half_chord = sqrt(max(1.0 - ray.off * ray.off, 0.0)), t = ray.ahead - half_chord;

    float through_ring = 1.0, ring_t = 0.0;
    vec3 ring_light = vec3(0.0);
    if (g.ring.y > 0.0) {
        float radius, width;
        bool ahead = ring_hit(g, ray, ring_t, radius, width);
        RingPixel pixel = ring_pixel(g, radius, width);
        if (ahead && pixel.inside > 0.0) {
            vec3 at = ray.from + ray.way * ring_t;
            float mu = max(abs(way.z), 1e-4), mu_sun = max(abs(g.light.z), 1e-4);
            bool same_side = (ray.from.z > 0.0) == (g.light.z > 0.0);
            float scattered = 0.0, through = 0.0;
            for (int i = 0; i < RING_PLACES; ++i) {
                vec2 place = ring_place(g, pixel, i);
                float out_ = exp(-place.x / mu), in_ = exp(-place.x / mu_sun);
                // Light scattered once in a plane layer (Chandrasekhar, "Radiative transfer", 1960).
                scattered += place.y / float(RING_PLACES)
                    * (same_side                      ? mu_sun / (mu + mu_sun) * (1.0 - out_ * in_)
                            : abs(mu - mu_sun) < 1e-3 ? place.x / mu * out_
                                                      : mu_sun / (mu - mu_sun) * (out_ - in_));
                through += out_ / float(RING_PLACES);
            }
            float along = -dot(at, sun_scaled); // in the globe's shadow?
            vec3 side = at + sun_scaled * along;
            float unshaded = along > 0.0 ? clamp(0.5 + (length(side) - 1.0) / max(2.0 * g.ring.w * along, ray.pixel), 0.0, 1.0) : 1.0;
            ring_light = globe_colour(column, g.ring.z, 0.0) * (scattered * unshaded * g.light.w * pixel.inside);
            through_ring = mix(1.0, through, pixel.inside);
        }
    }
    bool rings = through_ring < 1.0 || ring_light != vec3(0.0);
    bool ring_before = rings && (cover <= 0.0 || ring_t < t);
    if (rings && !ring_before)
        light = light * mix(1.0, through_ring, disc) + ring_light * disc;

    // Air: light scattered once on the way, and the air between the eye and the ground.
    float air = 0.0;
    vec3 scattered = vec3(0.0);
    if (g.air.x > 0.0) {
        vec3 glow = vec3(0.0);
        if (GLOWS)
            add_glows(own, ray, column, disc, glow, light);
        float top = 1.0 + g.air.y, x = 1.0 / g.air.x, cosine = dot(way, g.light.xyz), through = 1.0;
        AirWays ways = air_ways(ray, top, x);
        for (int k = ways.first; k <= ways.last; ++k) {
            vec2 one = air_way(ways, ray, middle, k); // its distance from the middle, and its part of the pixel
            float square = one.x * one.x, inside = top * top - square;
            if (inside <= 0.0 || ray.ahead + sqrt(inside) <= 0.0)
                continue;
            vec3 from = ray.from + ray.nearest * (one.x / max(ray.off, 1e-9) - 1.0);
            float begin = max(ray.ahead - sqrt(inside), 0.0);
            float end = square < 1.0 && ray.ahead > 0.0 ? ray.ahead - sqrt(1.0 - square) : ray.ahead + sqrt(inside);
            // Places lie the denser, the nearer to the lowest: at squares of even steps from there.
            float lowest = clamp(ray.ahead, begin, end), first = -sqrt(lowest - begin), last = sqrt(end - lowest);
            float step_ = (last - first) / float(ways.steps), mass = 0.0;
            for (int i = 0; i < ways.steps; ++i) {
                float root = first + (float(i) + 0.5) * step_;
                vec3 at = from + ray.way * (lowest + root * abs(root));
                float r = length(at), mu = dot(at, sun_scaled) / r, part = exp((1.0 - r) * x) * 2.0 * abs(root) * step_ * x;
                // The Sun rises over the ground's horizon.
                float horizon = -sqrt(max(r * r - 1.0, 0.0)) / r, sun = smoothstep(-g.ring.w, g.ring.w, mu - horizon);
                if (sun > 0.0)
                    scattered += one.y * part * sun * left_by_other(g, at * own)
                        * globe_colour(column, g.air.z, air_level(mass + 0.5 * part + air_above(r, x, max(mu, horizon))));
                mass += part;
            }
            if (k == 0)
                air = mass;
            else
                through -= one.y * (1.0 - exp(-GLOBE_AIR_DEPTH * mass)) / ways.beside;
        }
        // Rayleigh's phase function over 4, for a sunlit white surface sends a part of 1 / pi.
        scattered = scattered * (0.1875 * (1.0 + cosine * cosine) * g.light.w * disc) + glow;
        light *= mix(1.0, ways.last > 0 ? through : exp(-GLOBE_AIR_DEPTH * air), disc);
    }

    if (cover > 0.0) {
        vec3 at = ray.nearest * (middle / max(ray.off, 1e-9)) - ray.way * sqrt(max(1.0 - middle * middle, 0.0));
        vec3 normal = normalize(at / own);
        float mu = max(-dot(normal, way), 0.0), mu_sun = max(dot(normal, g.light.xyz), 0.0);
        float lit = g.light.w * left_by_other(g, at * own);
        if (g.ring.y > 0.0 && at.z * sun_scaled.z < 0.0) { // its ring's shadow
            vec3 there = at - sun_scaled * (at.z / sun_scaled.z);
            float width = ray.pixel / max(mu, 0.1) * radius_step(there, sun_scaled);
            lit *= through_ring_at(g, length(there.xy), width, max(abs(g.light.z), 1e-4));
        }
        vec3 shown;
        vec2 place = place_in_panorama(normal) + vec2(0.5, 0.0);
        float pixel = ray.pixel / max(ray.ahead, 1e-9) * t / max(sqrt(mu), 0.3); // on the ground, radii
        float level = log2(max(g.map.y / 3.14159265 * pixel, 1e-9));
        if (g.shape.w == GLOBE_SUN) {
            shown = globe_colour(column, g.kinds.x, mu * (float(GLOBE_LEVELS) - 1.001)) * sun_surface(normal, pixel, mu);
        } else if (g.air.x > 0.0) {
            Ground here = detailed(g, normal, place, level);
            float way_down = mu_sun > 0.0 ? air_above(1.0, 1.0 / g.air.x, mu_sun) : 0.0;
            float clear = 1.0 - here.cloud, mass = air + way_down;
            // Half of the light that air takes from a wide field comes back to it; half of the air lies below the clouds.
            float through = air_level(0.5 * mass), through_clouds = air_level(0.25 * mass), straight = air_level(mass);
            lit *= smoothstep(-g.ring.w, g.ring.w, dot(normal, g.light.xyz)); // the Sun rises
            vec3 land = globe_colour(column, g.kinds.x, through) * here.kinds.r + globe_colour(column, g.kinds.y, through) * here.kinds.g
                + globe_colour(column, g.kinds.z, through) * here.kinds.b;
            shown = (land * here.land_sun + globe_colour(column, g.kinds.w, through) * (here.water * mu_sun)) * clear
                + globe_colour(column, g.air.w, through_clouds) * (here.cloud * here.cloud_sun);
            shown *= lit;
            // The Sun's glint on waves whose slopes are spread by the wind (Cox and Munk 1954).
            vec3 between = normalize(g.light.xyz - way);
            float upright = max(dot(between, normal), 1e-3), square = upright * upright, spread = 0.003 + 0.00512 * here.wind;
            float slopes = exp((1.0 - 1.0 / square) / spread) / (3.14159265 * spread);
            float bounce = 1.0 - max(dot(between, g.light.xyz), 0.0), fresnel = 0.0204 + 0.9796 * bounce * bounce * bounce * bounce * bounce;
            // Waves hide each other from low eyes and a low Sun (Smith 1967).
            float seen = 2.0 / (mu + sqrt(mu * mu + spread * (1.0 - mu * mu))), reached = 2.0 * mu_sun / (mu_sun + sqrt(mu_sun * mu_sun + spread * (1.0 - mu_sun * mu_sun)));
            float glint = 0.25 * 3.14159265 * slopes * fresnel * seen * reached / (square * square);
            shown += globe_colour(column, g.map.z, straight) * (glint * here.water * clear * lit);
            // The lamps of cities are seen through the air above them alone.
            shown += globe_colour(column, g.lamps.x, 0.0) * (g.lamps.y * here.lamps * exp(-GLOBE_AIR_DEPTH * air));
        } else {
            vec3 ground = g.map.x < 0.0 ? vec3(0.0) : textureLod(globe_maps, vec3(place, g.map.x), level).rgb * g.shape.x;
            shown = vec3(0.0);
            if (g.kinds.x >= 0.0)
                shown += globe_colour(column, g.kinds.x, 0.0) * ground.r;
            if (g.kinds.y >= 0.0)
                shown += globe_colour(column, g.kinds.y, 0.0) * ground.g;
            if (g.kinds.z >= 0.0)
                shown += globe_colour(column, g.kinds.z, 0.0) * ground.b;
            if (g.map.x < 0.0)
                shown = globe_colour(column, g.kinds.w, 0.0);
            shown *= lit * (g.shape.w == GLOBE_DUSTY ? 2.0 * mu_sun / max(mu + mu_sun, 1e-6) : 1.5 * mu_sun);
        }
        light = light * (1.0 - hides) + shown * cover;
    }
    light += scattered;
    if (ring_before)
        light = light * mix(1.0, through_ring, disc) + ring_light * disc;
}

// The light of a direction with globe number i before it. distance: the nearest globe's along n, on return.
void add_disc(int i, vec3 n, float angle, ShiftColumn column, inout vec3 light, inout float distance)
{
    GlobeEntry g = globe(i);
    float pixels = g.shape.z / angle, disc = 1.0 - point_part(pixels);
    if (disc <= 0.0)
        return;
    // A small disc changes within a pixel: four rays.
    int rays = pixels < 8.0 ? 4 : 1;
    vec3 side = normalize(cross(n, abs(n.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0))), up = cross(side, n);
    vec3 sum = vec3(0.0), behind = light;
    for (int k = 0; k < rays; ++k) {
        vec2 off = rays == 1 ? vec2(0.0) : (vec2(k & 1, k >> 1) - 0.5) * (0.5 * angle);
        light = behind;
        add_globe(g, normalize(n + side * off.x + up * off.y), angle / sqrt(float(rays)), disc, column, light);
        sum += light;
    }
    GlobeRay middle = globe_ray(g, n, angle);
    if (covered(middle) > 0.5)
        distance = (middle.ahead - sqrt(max(1.0 - middle.off * middle.off, 0.0)))
            / length(vec3(dot(g.row0.xyz, n), dot(g.row1.xyz, n), dot(g.row2.xyz, n)));
    light = sum / float(rays);
}

// The light of a direction with all globes before it; they are sorted, the farthest first. Without the headlight effect.
// light: the sky's, as light_seen has it.
void add_globes(vec3 n, float angle, float D, inout vec3 light, inout float distance)
{
    int hits = 0;
    for (int i = 0; i < GLOBES; ++i) {
        vec4 where = globes.entries[i].near;
        vec3 off = n - where.xyz;
        float reach = where.w + 2.0 * angle;
        hits |= int(dot(off, off) < reach * reach) << i;
    }
    if (hits == 0)
        return;
    float gain = HEADLIGHT ? headlight(D) : 1.0;
    gain *= globes.first.x;
    ShiftColumn column = shift_column(D);
    light /= max(gain, 1e-37);
    for (int k = 0; EACH_GLOBE ? k < GLOBES : hits != 0; ++k) {
        int i = EACH_GLOBE ? k : findLSB(hits);
        if ((hits >> i & 1) != 0)
            add_disc(i, n, angle, column, light, distance);
        hits &= ~(1 << i);
    }
    light *= gain;
}

// The part of a star's light that globes leave, or that of globe number `own`.
float left_by_globes(vec3 n, int own)
{
    float left = 1.0;
    for (int i = own + 1; i < GLOBES; ++i) {
        GlobeEntry g = globe(i);
        vec3 off = n - g.near.xyz;
        if (dot(off, off) >= g.near.w * g.near.w)
            continue;
        GlobeRay ray = globe_ray(g, n, 0.0);
        left *= 1.0 - covered(ray);
        if (g.ring.y > 0.0) {
            float t, radius, width, mu = abs(normalize(ray.way * vec3(1.0, 1.0, g.shape.y)).z);
            if (ring_hit(g, ray, t, radius, width))
                left *= through_ring_at(g, radius, 0.0, max(mu, 1e-4));
        }
    }
    return left;
}
