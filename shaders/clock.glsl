// A clock's dial, evaluated for each point at its own retarded time. The dial's radius is 1 here, x to the right and y
// up.

const float TURN = 6.283185307179586;
const float MAIN_S = 60.0, FAST_S = 10.0, SLOW_S = 3600.0; // seconds per turn of the three hands
// The small dials are beside the middle, away from the long hand on the minute and from the digits.
const vec2 FAST_AT = vec2(-0.38, 0.06), SLOW_AT = vec2(0.38, 0.06);
const float SMALL = 0.25;
const float DIGITS_Y = -0.43, DIGITS_WIDE = 0.84;
const float CELL = 0.17, POINT = 0.4; // a figure with its gap to the next; in figures: the point before the last one

// Segments of the figures 0 to 9, of the minus and of the blank: 1 is the top, then clockwise, 64 is the middle.
const int SEGMENTS[12] = int[12](63, 6, 91, 79, 102, 109, 125, 7, 127, 111, 64, 0);

/// The part of a pixel of width `w` around x that lies within h of 0.
float overlap(float x, float h, float w)
{
    return clamp((h - abs(x)) / w + 0.5, 0.0, 1.0) - clamp((-h - abs(x)) / w + 0.5, 0.0, 1.0);
}

/// A pixel's extent along the unit vector n.
float extent(mat2 pixel, vec2 n) { return max(length(n * pixel), 1e-9); }

/// `count` lines from the middle, the first upwards, from radius `low` to `high`.
float ticks(vec2 at, mat2 pixel, float count, float low, float high, float half_width)
{
    float r = max(length(at), 1e-6);
    vec2 out_ = at / r;
    float turn = atan(at.x, at.y) * (count / TURN), apart = r * TURN / count;
    float w = extent(pixel, vec2(out_.y, -out_.x));
    float line = overlap((turn - round(turn)) * apart, half_width, w);
    // The mean replaces lines that are finer than pixels.
    line = mix(line, 2.0 * half_width / apart, clamp(2.0 * w / apart - 1.0, 0.0, 1.0));
    return line * overlap(r - 0.5 * (low + high), 0.5 * (high - low), extent(pixel, out_));
}

float ring(vec2 at, mat2 pixel, float radius, float half_width)
{
    float r = max(length(at), 1e-6);
    return overlap(r - radius, half_width, extent(pixel, at / r));
}

/// x: coverage by a hand, y: by the hand with a margin. Its width goes from `root` to `tip`. turned: turns from one pixel
/// to the next, to the right and down.
vec2 hand(vec2 at, mat2 pixel, float turn, vec2 turned, float reach, float tail, float root, float tip)
{
    vec2 way = vec2(sin(TURN * turn), cos(TURN * turn)), aside = vec2(way.y, -way.x);
    float along = dot(at, way), across = dot(at, aside);
    float half_width = mix(root, tip, clamp(along / reach, 0.0, 1.0));
    float within = overlap(along - 0.5 * (reach - tail), 0.5 * (reach + tail), extent(pixel, way));
    float w = max(length(aside * pixel - TURN * along * turned), 1e-9);
    return vec2(overlap(across, half_width, w), overlap(across, half_width + 0.02, w)) * within;
}

float box(vec2 at, vec2 half_size, vec2 w) { return overlap(at.x, half_size.x, w.x) * overlap(at.y, half_size.y, w.y); }

float cell_of(vec4 digits) { return min(CELL, DIGITS_WIDE / (digits.z + POINT)); }

/// The part of a pixel that the plate below the figures covers.
float plate(vec2 at, mat2 pixel, vec4 digits, float margin)
{
    vec2 half_size = vec2(0.5 * (digits.z + POINT) + margin, 0.8 + margin) * cell_of(digits);
    return box(at - vec2(0.0, DIGITS_Y), half_size, vec2(extent(pixel, vec2(1.0, 0.0)), extent(pixel, vec2(0.0, 1.0))));
}

/// Draws digits.z figures of seven segments each.
float figures(vec2 at, mat2 pixel, vec4 digits)
{
    float count = digits.z, cell = cell_of(digits);
    vec2 p = (at - vec2(0.0, DIGITS_Y)) / cell;
    float place = p.x + 0.5 * (count + POINT), last = count - 1.0; // the first figure's begin
    if (abs(p.y) > 1.0 || place < 0.0 || place >= count + POINT)
        return 0.0;
    vec2 point = vec2(place - last - 0.5 * POINT, p.y);
    place = place < last ? place : max(place - POINT, last);
    int k = int(place);
    int packed = int(k < 6 ? digits.x : digits.y);
    int lit = SEGMENTS[min((packed >> (4 * (k % 6))) & 15, 11)];
    vec2 in_cell = vec2(place - float(k) - 0.5, p.y);
    vec2 w = vec2(extent(pixel, vec2(1.0, 0.0)), extent(pixel, vec2(0.0, 1.0))) / cell;
    const float x = 0.27, y = 0.33, thick = 0.1; // from a figure's middle to its right and to the middle of its upper half
    const vec2 level = vec2(x, thick), upright = vec2(thick, y);
    const vec2 middles[7] = vec2[7](vec2(0.0, 2.0 * y), vec2(x, y), vec2(x, -y), vec2(0.0, -2.0 * y), vec2(-x, -y),
        vec2(-x, y), vec2(0.0));
    float ink = 0.0;
    for (int i = 0; i < 7; ++i)
        if ((lit >> i & 1) != 0)
            ink = max(ink, box(in_cell - middles[i], i % 3 == 0 ? level : upright, w));
    return max(ink, box(point + vec2(0.0, 2.0 * y - 0.03), vec2(thick + 0.03), w));
}

/// The part of a pixel that marks cover, 0 to 1: lines, hands and figures. `pixel`: the steps of `at` to the right and
/// down. `later_s`: this point's light-travel offset from the clock's middle, seconds; `step_s`: its steps.
float marks(vec2 at, mat2 pixel, float later_s, vec2 step_s, TimeEntry clock)
{
    vec2 main_hand = hand(at, pixel, clock.turns.x + later_s / MAIN_S, step_s / MAIN_S, 0.82, 0.16, 0.034, 0.012);
    float fast = hand(at - FAST_AT, pixel, clock.turns.y + later_s / FAST_S, step_s / FAST_S, 0.19, 0.05, 0.020, 0.008).x;
    float slow = hand(at - SLOW_AT, pixel, clock.turns.z + later_s / SLOW_S, step_s / SLOW_S, 0.19, 0.05, 0.020, 0.008).x;
    float ink = max(ticks(at, pixel, 60.0, 0.90, 0.96, 0.005), ticks(at, pixel, 12.0, 0.85, 0.96, 0.014));
    for (int i = 0; i < 2; ++i) {
        vec2 small = at - (i == 0 ? FAST_AT : SLOW_AT);
        if (dot(small, small) > 0.08)
            continue;
        ink = max(ink, 0.6 * ring(small, pixel, SMALL, 0.006));
        ink = max(ink, ticks(small, pixel, i == 0 ? 10.0 : 12.0, 0.205, SMALL, 0.006));
        ink = max(ink, i == 0 ? fast : slow);
        ink = max(ink, ring(small, pixel, 0.0, 0.032));
    }
    ink = max(ink * (1.0 - main_hand.y), main_hand.x);
    // The hand passes behind the plate, so that the figures stay readable.
    float inner = plate(at, pixel, clock.digits, 0.2), outer = plate(at, pixel, clock.digits, 0.26);
    ink = max(ink * (1.0 - outer), 0.6 * (outer - inner));
    ink = max(ink, figures(at, pixel, clock.digits));
    ink = max(ink, ring(at, pixel, 0.0, 0.075));
    return ink * (1.0 - ring(at, pixel, 0.0, 0.035)); // the pin that the hand turns on
}
