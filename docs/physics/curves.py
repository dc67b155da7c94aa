#!/usr/bin/env python3
"""Draws limb.svg, glint.svg, range.svg and flight.svg beside this file: python3 docs/physics/curves.py

Every curve is computed here from the formulas of the pages in this folder, with Python's own library; the comments name the
equations. Limb darkening reads its coefficients in scenes/solar-system/spectra.json.
"""
import json
from math import acosh, asin, cos, degrees, exp, expm1, log, log2, pi, radians, sin, sqrt, tan, tanh

from figures import BLUE, GREEN, GREY, HERE, INK, ORANGE, PINK, Figure, gamma, luminous

ROOT = HERE.parents[1]


class Chart:
    """Axes of a figure: a frame, and from values to the page. `y_log` spaces values by their logarithm."""

    def __init__(self, figure, box, x_range, y_range, y_log=False):
        self.figure, self.box, self.x_range = figure, box, x_range
        self.scale = (lambda v: log(max(v, 1e-99))) if y_log else float
        self.y_range = tuple(self.scale(v) for v in y_range)

    def x(self, value):
        left, _, right, _ = self.box
        return left + (right - left) * (value - self.x_range[0]) / (self.x_range[1] - self.x_range[0])

    def y(self, value):
        _, top, _, bottom = self.box
        return bottom - (bottom - top) * (self.scale(value) - self.y_range[0]) / (self.y_range[1] - self.y_range[0])

    def frame(self, x_ticks, y_ticks, x_title, y_title, y_text=lambda v: f"{v:g}", x_text=lambda v: f"{v:g}"):
        left, top, right, bottom = self.box
        for value in x_ticks:
            self.figure.line(self.x(value), top, self.x(value), bottom, "#e2e2e2", 1)
            self.figure.text(self.x(value), bottom + 20, x_text(value), size=13)
        for value in y_ticks:
            self.figure.line(left, self.y(value), right, self.y(value), "#e2e2e2", 1)
            self.figure.text(left - 8, self.y(value) + 5, y_text(value), "end", size=13)
        self.figure.add(f'<rect x="{left}" y="{top}" width="{right - left}" height="{bottom - top}" fill="none" stroke="{GREY}"/>')
        self.figure.text((left + right) / 2, bottom + 44, x_title, size=13)
        middle = (top + bottom) / 2
        self.figure.add(f'<text transform="translate({left - 52} {middle:.0f}) rotate(-90)" text-anchor="middle" fill="{INK}"'
                        f' font-size="13">{y_title}</text>')

    def curve(self, points, colour, width=2.4, dash=""):
        """Draws the part of a curve that lies within the frame."""
        run, low, high = [], *self.y_range
        for x, y in points:
            if y is not None and low <= self.scale(y) <= high:
                run.append((self.x(x), self.y(y)))
            elif run:
                self.figure.path(run, colour, width, dash=dash)
                run = []
        if run:
            self.figure.path(run, colour, width, dash=dash)


# ---------------------------------------------------------------- the Sun's limb

def limb_rows():
    return json.loads((ROOT / "scenes/solar-system/spectra.json").read_text())["sun_limb_darkening"]["rows"]


def limb_part(rows, nm, mu):
    """(S5): radiance over the disc's mean; coefficients linear between the measured wavelengths."""
    high = next(i for i, row in enumerate(rows) if row[0] >= nm)
    part = (nm - rows[high - 1][0]) / (rows[high][0] - rows[high - 1][0])
    a = [(1 - part) * one + part * other for one, other in zip(rows[high - 1][1:], rows[high][1:])]
    return sum(a[k] * mu ** k for k in range(6)) / sum(2 * a[k] / (k + 2) for k in range(6))


def limb():
    rows = limb_rows()
    figure = Figure(880, 372, "The Sun's radiance from the middle of its disc to its limb, at four wavelengths")
    chart = Chart(figure, (80, 24, 560, 310), (0, 1), (0, 1.5))
    chart.frame([0, 0.2, 0.4, 0.6, 0.8, 1], [0, 0.25, 0.5, 0.75, 1, 1.25, 1.5],
                "distance from the middle of the disc over its radius", "radiance over its mean over the disc")
    figure.line(chart.x(0), chart.y(1), chart.x(1), chart.y(1), GREY, 1.2, "5 4")
    for k, (nm, colour) in enumerate(((400, PINK), (480, BLUE), (560, GREEN), (700, ORANGE))):
        places = [i / 200 for i in range(197)] + [0.985 + 0.015 * i / 30 for i in range(31)]
        curve = [(r, limb_part(rows, nm, sqrt(max(1 - r * r, 0)))) for r in places]
        chart.curve(curve, colour)
        y = 220 + 22 * k
        figure.line(96, y, 122, y, colour, 3)
        figure.text(130, y + 5, f"{nm} nm: limb {curve[-1][1] / curve[0][1]:.2f} of the middle", "start", size=13)
    # The disc by the law at 560 nm, on a screen of sRGB's curve, its middle near white.
    figure.add('<defs><radialGradient id="disc">')
    for i in range(25):
        r = min(1 - (1 - i / 24) ** 2, 0.9999)
        light = 0.92 * limb_part(rows, 560, sqrt(1 - r * r)) / limb_part(rows, 560, 1)
        code = round(255 * (1.055 * light ** (1 / 2.4) - 0.055))
        figure.add(f'<stop offset="{r:.4f}" stop-color="rgb({code},{code},{code})"/>')
    figure.add("</radialGradient></defs>")
    figure.add('<rect x="600" y="24" width="256" height="286" fill="#111"/>')
    figure.circle(728, 167, 112, "none", 0, "url(#disc)")
    figure.text(728, 330, "the disc at 560 nm", size=13)
    figure.text(728, 349, "as a screen shows it", size=13)
    figure.write("limb.svg")


# ---------------------------------------------------------------- the sea's glint

WAVES = 0.003 + 0.00512 * 7  # (S11): variance of the slopes at 7 m/s


def glint_light(way, sun):
    """(S10) without air: radiance of water, 1 for a sunlit white surface. way, sun: unit, from the water to the eye and to
    the Sun, z upwards."""
    mu, mu_sun = way[2], sun[2]
    if mu <= 0:
        return 0.0
    between = [a + b for a, b in zip(way, sun)]
    length = sqrt(sum(v * v for v in between))
    upright, cos_i = between[2] / length, sum(a * b for a, b in zip(between, sun)) / length
    slopes = exp((1 - 1 / upright ** 2) / WAVES) / (pi * WAVES * upright ** 4)
    fresnel = 0.0204 + 0.9796 * (1 - cos_i) ** 5

    def q(m):
        return sqrt(m * m + WAVES * (1 - m * m))

    return pi / 4 * slopes * fresnel * 2 / (mu + q(mu)) * 2 * mu_sun / (mu_sun + q(mu_sun))


def contours(value, columns, rows, level):
    """Line segments of one level on a grid: marching squares."""
    grid = [[value(x, y) for x in columns] for y in rows]
    pieces = []
    for j in range(len(rows) - 1):
        for i in range(len(columns) - 1):
            corners = [(columns[i + a], rows[j + b], grid[j + b][i + a]) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            ends = []
            for (x0, y0, v0), (x1, y1, v1) in zip(corners, corners[1:] + corners[:1]):
                if (v0 < level) != (v1 < level):
                    t = (level - v0) / (v1 - v0)
                    ends.append((x0 + t * (x1 - x0), y0 + t * (y1 - y0)))
            pieces += [ends[k:k + 2] for k in range(0, len(ends) - 1, 2)]
    return pieces


def joined(pieces):
    """Segments as few polylines."""
    key = lambda p: (round(p[0], 6), round(p[1], 6))
    lines = []
    ends = {}
    for a, b in pieces:
        ends.setdefault(key(a), []).append((a, b))
        ends.setdefault(key(b), []).append((b, a))
    used = set()
    for a, b in pieces:
        if (key(a), key(b)) in used:
            continue
        line = [a, b]
        used |= {(key(a), key(b)), (key(b), key(a))}
        for _ in range(2):
            while True:
                on = [q for p, q in ends[key(line[-1])] if (key(p), key(q)) not in used]
                if not on:
                    break
                used |= {(key(line[-1]), key(on[0])), (key(on[0]), key(line[-1]))}
                line.append(on[0])
            line.reverse()
        lines.append(line)
    return lines


def glint():
    figure = Figure(880, 400, "The Sun's glint on the sea, by the angle of view and of the Sun")
    chart = Chart(figure, (86, 24, 440, 330), (-90, 90), (1e-3, 30), y_log=True)
    chart.frame([-90, -60, -30, 0, 30, 60, 90], [1e-3, 0.01, 0.1, 1, 10],
                "angle of view from straight down, towards the Sun, degrees", "radiance, 1: a sunlit white surface")
    suns = ((10, ORANGE), (30, GREEN), (60, BLUE), (90, PINK))
    for k, (height, colour) in enumerate(suns):
        sun = (cos(radians(height)), 0, sin(radians(height)))
        # The eye looks towards the Sun's side: the water lies there, and sends light back to the other side.
        chart.curve([(a / 2, glint_light((-sin(radians(a / 2)), 0, cos(radians(a / 2))), sun)) for a in range(-179, 180)], colour)
        mirror = 90 - height
        if mirror:
            figure.circle(chart.x(mirror), chart.y(glint_light((-sin(radians(mirror)), 0, cos(radians(mirror))), sun)), 4, "#fff", 1.2,
                          colour)
        y = 48 + 22 * k
        figure.line(100, y, 126, y, colour, 3)
        figure.text(134, y + 5, f"Sun {height}° high", "start", size=13)
    figure.circle(113, 136, 4, INK, 1, INK)
    figure.text(134, 141, "mirror image", "start", size=13)

    # The glitter's path for an eye above the sea: azimuth from the Sun's, angle below the horizon.
    path = Chart(figure, (540, 24, 850, 330), (-60, 60), (-90, 0))
    path.frame([-60, -30, 0, 30, 60], [0, -15, -30, -45, -60, -75, -90], "azimuth from the Sun’s, degrees",
               "angle below the horizon, degrees", lambda v: f"{-v:g}")
    columns = [-60 + 1.5 * i for i in range(81)]
    rows = [-89.5 + 1.5 * i for i in range(50)] + [-14.5 + 0.5 * i for i in range(29)]
    for height, colour in suns[:3]:
        sun = (cos(radians(height)), 0, sin(radians(height)))

        def seen(azimuth, below):
            a, e = radians(azimuth), radians(below)
            return glint_light((-cos(e) * cos(a), -cos(e) * sin(a), -sin(e)), sun)

        most = max(seen(x, y) for x in columns for y in rows)
        for part, width in ((0.5, 2.6), (0.1, 1.3)):
            for line in joined(contours(seen, columns, rows, part * most)):
                figure.path([(path.x(x), path.y(y)) for x, y in line], colour, width)
        figure.circle(path.x(0), path.y(-height), 4.5, "#fff", 1.2, colour)
    figure.text(695, 392, "lines: 0.5 and 0.1 of the brightest; dots: mirror", size=13)
    figure.text(263, 392, f"wind 7 m/s: slopes of {degrees(sqrt(WAVES)):.1f}° (rms), no air", size=13)
    figure.write("glint.svg")


# ---------------------------------------------------------------- everything at once

def luminance(kelvin):
    """Of a black body, by its radiance per frequency and the eye's y; no unit."""
    total = 0.0
    for nm in range(380, 761, 4):
        exponent = 1.438776877e7 / (nm * kelvin)
        total += luminous(nm) / nm ** 5 / (expm1(exponent) if exponent < 600 else exp(600))
    return total


RANGE_TOP, RANGE_BOTTOM, BEYOND = -0.3959, -8.0, 0.125  # runtime/light/range_curve.h


def range_slopes(weights, whole):
    """(L13): slopes of at most 1, in the weights' proportion below, with that sum."""
    least, most = 0.0, 1e9
    for _ in range(100):
        factor = (least + most) / 2
        slope = [min(1.0, factor * w) for w in weights]
        least, most = (least, factor) if sum(slope) > whole else (factor, most)
    return slope


def range_curve():
    # A sky of 5772 K all around, a sunlit grey at rest, seen at gamma 4: (R7), (L3) and (L6).
    g = 4.0
    beta = sqrt(15) / 4
    assert abs(gamma(beta) - g) < 1e-12
    grey = log2(0.18) - log2(luminance(5772))
    kelvins = [400 * 2 ** (k / 32) for k in range(32 * 7 + 1)]
    table = [log2(luminance(T)) for T in kelvins]

    def seen(cosine):
        at = log2(5772 / (g * (1 - beta * cosine)) / 400) * 32
        k = min(int(at), len(table) - 2)
        return grey + table[k] + (at - k) * (table[k + 1] - table[k])

    stops = {}
    samples = sorted(seen(-1 + (i + 0.5) / 20000) for i in range(40000))  # equal solid angles
    for s in samples:  # shared out between the two nearest stops' middles
        k = int((s - 0.5) // 1)
        part = s - 0.5 - k
        stops[k] = stops.get(k, 0) + (1 - part) / len(samples)
        stops[k + 1] = stops.get(k + 1, 0) + part / len(samples)
    low, top, high = (samples[int(part * len(samples))] for part in (0.002, 0.995, 0.999))
    first = int(low // 1)
    last = int(-(-top // 1)) - 1
    kernel = (1, 4, 6, 4, 1)
    roots = [sqrt(sum(kernel[i + 2] * stops.get(k + i, 0) for i in range(-2, 3)) / 16) for k in range(first, last + 1)]
    weights = [0.1 / len(roots) + 0.9 * r / sum(roots) for r in roots]
    slope = range_slopes(weights, RANGE_TOP - RANGE_BOTTOM)

    def shown(stop):
        if stop >= last + 1:
            return RANGE_TOP + BEYOND * (stop - last - 1)
        if stop <= first:
            return RANGE_TOP - sum(slope) - BEYOND * (first - stop)
        k = int(stop - first)
        return RANGE_TOP - sum(slope[k:]) + slope[k] * (stop - first - k)

    figure = Figure(880, 412, "A curve that shows everything at once, and the view that it follows from")
    chart = Chart(figure, (90, 24, 850, 340), (-46, 10), (-10, 1))
    chart.frame(list(range(-40, 11, 10)), list(range(-10, 1, 2)), "luminance of the scene, log₂ (stops); 0: a sunlit white surface",
                "shown luminance, log₂; 0: white")
    scale = 190 / max(stops.values())
    for k in sorted(stops):
        if stops[k] * scale > 0.4:
            figure.add(f'<rect x="{chart.x(k):.1f}" y="{340 - stops[k] * scale:.1f}" width="{chart.x(1) - chart.x(0) - 1:.1f}"'
                       f' height="{stops[k] * scale:.1f}" fill="#d9d9d9"/>')
    for level in (RANGE_TOP, RANGE_BOTTOM):
        figure.line(90, chart.y(level), 850, chart.y(level), GREEN, 1.2, "6 4")
    figure.text(96, chart.y(RANGE_TOP) + 17, "0.76 of white: the shoulder begins", "start", GREEN, 13)
    figure.text(844, chart.y(RANGE_BOTTOM) + 17, "2⁻⁸ of white: 13 of 255", "end", GREEN, 13)
    chart.curve([(s / 4, s / 4 + 2.5 if s / 4 + 2.5 < 0.9 else None) for s in range(-184, 40)], GREY, 1.8, "5 4")
    chart.curve([(s / 8, shown(s / 8)) for s in range(-368, 81)], BLUE, 2.8)
    figure.text(chart.x(-1.2), chart.y(0.5), "one exposure: slope 1", "start", "#666", 13)
    figure.text(chart.x(-24), chart.y(-2.9), "the curve: each slope ≤ 1", "middle", BLUE, 14, "bold")
    figure.text(chart.x(-41.5), 332, "grey: solid angle in each stop", "start", "#666", 13)
    figure.text(470, 402, f"The view: a sky of 5772 K all around at γ = 4, {high - low:.0f} stops, shown in {shown(high) - shown(low):.1f}.", size=13)
    figure.write("range.svg")


# ---------------------------------------------------------------- the throttle

TICK, SETTLE, GAIN, JERK, MOST = 1e-3, 0.8, 1.5, 15.0, 100.0  # runtime/flight/flight.h, config/model/flying.h


def flown(lever, newtonian=False, until=8.0):
    """(R24), (R25): time on board, rapidity, proper acceleration, from rest."""
    w = rate = 0.0
    share = -expm1(-TICK / (2 * GAIN / JERK))
    states = [(0.0, 0.0, 0.0)]
    for i in range(1, round(until / TICK) + 1):
        wanted = lever * GAIN if newtonian else max(-GAIN, min(GAIN, (lever * acosh(MOST) - w) / SETTLE))
        rate += share * (wanted - rate)
        gain = min(rate * TICK, acosh(MOST) - w) if newtonian else rate * TICK
        w += gain
        if i % 40 == 0:
            states.append((i * TICK, w, gain / TICK))
    return states


def flight():
    figure = Figure(880, 400, "Rapidity and proper acceleration after the throttle is pushed, from rest")
    rapidity = Chart(figure, (76, 24, 400, 320), (0, 8), (0, 6))
    thrust = Chart(figure, (552, 24, 850, 320), (0, 8), (0, 1.75))
    rapidity.frame(range(0, 9, 2), range(0, 7), "time on board, s", "rapidity η")
    for g, name in ((1, "γ = 1"), (2, "2"), (4, "4"), (10, "10"), (100, "100")):
        y = rapidity.y(acosh(g))
        figure.line(400, y, 406, y, INK, 1.5)
        figure.text(410, y + 5, name, "start", size=13)
    thrust.frame(range(0, 9, 2), [0, 0.25, 0.5, 0.75, 1, 1.25, 1.5], "time on board, s", "proper acceleration dη/dτ, c/s",
                 lambda v: f"{v:.2f}")
    levers = ((1.0, False, ORANGE, "guided, free: lever 1", ""), (0.5, False, GREEN, "lever ½", ""),
              (0.25, False, BLUE, "lever ¼", ""), (0.5, True, PINK, "newtonian: engine ½", "7 4"))
    for k, (lever, newtonian, colour, name, dash) in enumerate(levers):
        states = flown(lever, newtonian)
        rapidity.curve([(t, w) for t, w, _ in states], colour, 2.4, dash)
        thrust.curve([(t, a) for t, _, a in states], colour, 2.4, dash)
        x = (76, 300, 430, 560)[k]
        figure.line(x, 388, x + 26, 388, colour, 3, dash)
        figure.text(x + 33, 393, name, "start", size=13)
    for lever, colour in ((1.0, ORANGE), (0.5, GREEN), (0.25, BLUE)):  # where the lever's place leads
        figure.line(390, rapidity.y(lever * acosh(MOST)), 400, rapidity.y(lever * acosh(MOST)), colour, 4)
    figure.write("flight.svg")


def check():
    """Numbers that the pages quote."""
    rows = limb_rows()
    # The mean of a disc is 1: rings of equal area.
    assert abs(sum(limb_part(rows, 560, sqrt(1 - (i + 0.5) / 5000)) for i in range(5000)) / 5000 - 1) < 1e-3
    assert abs(luminance(5772 * (4 + sqrt(15))) / luminance(5772) / 118 - 1) < 0.02
    assert abs(tanh(acosh(MOST) / 4) - 0.868) < 1e-3
    assert abs(degrees(asin(sqrt(WAVES)))) < 12 and tan(0) == 0


if __name__ == "__main__":
    check()
    limb()
    glint()
    range_curve()
    flight()
