#!/usr/bin/env python3
"""Draws aberration.svg, doppler.svg, spectrum.svg, retarded.svg and tiles.svg beside this file:
python3 docs/physics/figures.py

Every curve is computed here from the formulas of the pages in this folder, with Python's own library. c = 1.
"""
from math import acos, asin, atan, atan2, cos, degrees, exp, expm1, hypot, log, radians, sin, sqrt, tan
from pathlib import Path

HERE = Path(__file__).resolve().parent
BLUE, ORANGE, GREEN, PINK, GREY, INK = "#0072b2", "#d55e00", "#00805e", "#a8457f", "#888", "#222"


def gamma(beta):
    return 1 / sqrt((1 - beta) * (1 + beta))


def exp_rapidity(beta):
    return sqrt((1 + beta) / (1 - beta))


def ship_angle(theta, beta):
    """Angle from the motion that the ship sees for the world's angle theta, radians."""
    return 2 * atan(tan(theta / 2) / exp_rapidity(beta))


def doppler_world(theta, beta):
    """D of light from the world's angle theta."""
    return gamma(beta) * (1 + beta * cos(theta))


def doppler_ship(theta, beta):
    """D of light that the ship sees at the angle theta."""
    return 1 / (gamma(beta) * (1 - beta * cos(theta)))


class Figure:
    """An SVG on a white ground."""

    def __init__(self, width, height, title):
        self.size = width, height
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
            f'font-family="DejaVu Sans, Verdana, Arial, sans-serif" font-size="14">',
            f"<title>{title}</title>",
            f'<rect width="{width}" height="{height}" fill="#fff"/>',
        ]

    def add(self, part):
        self.parts.append(part)

    def line(self, x1, y1, x2, y2, stroke=INK, width=1.5, dash=""):
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{stroke}" stroke-width="{width}"{dashed}/>')

    def path(self, points, stroke=INK, width=2.0, fill="none", dash="", opacity=1, closed=False):
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        shape = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points) + ("Z" if closed else "")
        self.add(f'<path d="{shape}" fill="{fill}" fill-opacity="{opacity}" stroke="{stroke}" stroke-width="{width}"'
                 f' stroke-linejoin="round"{dashed}/>')

    def circle(self, x, y, r, stroke=INK, width=1.5, fill="none", clip="", opacity=1):
        clipped = f' clip-path="url(#{clip})"' if clip else ""
        self.add(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r:.2f}" fill="{fill}" fill-opacity="{opacity}" stroke="{stroke}"'
                 f' stroke-width="{width}"{clipped}/>')

    def text(self, x, y, text, anchor="middle", fill=INK, size=14, weight="normal", halo=False):
        if halo:  # what is written on a line
            wide = 0.62 * size * len(text) + 4
            start = {"start": x - 2, "middle": x - wide / 2, "end": x - wide + 2}[anchor]
            self.add(f'<rect x="{start:.1f}" y="{y - 0.86 * size:.1f}" width="{wide:.1f}" height="{1.1 * size:.1f}" fill="#fff"/>')
        self.add(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{fill}" font-size="{size}"'
                 f' font-weight="{weight}">{text}</text>')

    def arrow(self, x1, y1, x2, y2, stroke=INK, width=2.0, dash="", head=9):
        a = atan2(y2 - y1, x2 - x1)
        self.line(x1, y1, x2 - head * cos(a), y2 - head * sin(a), stroke, width, dash)
        corners = [(x2, y2)] + [(x2 - head * cos(a + s), y2 - head * sin(a + s)) for s in (0.4, -0.4)]
        self.path(corners, "none", 0, stroke, closed=True)

    def write(self, name):
        (HERE / name).write_text("\n".join(self.parts + ["</svg>", ""]), encoding="utf-8")


def aberration():
    """The world's circles of equal angle from the motion, in a stereographic view straight ahead."""
    figure = Figure(880, 318, "The world's directions in a view straight ahead, at four speeds")
    radius = 92.0
    speeds = [(0, "at rest"), (0.5, "β = 0.5"), (0.8, "β = 0.8"), (sqrt(15) / 4, "γ = 4")]
    for i, (beta, name) in enumerate(speeds):
        cx, cy = 116 + 216 * i, 146
        scale = radius / exp_rapidity(beta) if beta else radius  # of tan(theta / 2)
        figure.add(f'<clipPath id="v{i}"><circle cx="{cx}" cy="{cy}" r="{radius}"/></clipPath>')
        figure.add(f'<g clip-path="url(#v{i})">')
        for azimuth in range(0, 360, 30):
            a = radians(azimuth)
            reach = tan(radians(175) / 2)
            near = tan(radians(15) / 2)
            figure.line(cx + scale * near * cos(a), cy - scale * near * sin(a), cx + scale * reach * cos(a),
                        cy - scale * reach * sin(a), "#ccc", 1)
        for theta in range(15, 180, 15):
            r = scale * tan(radians(theta) / 2)
            main = theta in (30, 60, 90, 120, 150)
            figure.circle(cx, cy, r, ORANGE if theta == 90 else BLUE if main else "#ccc",
                          2.6 if theta == 90 else 1.6 if main else 1)
        # Discs of 8 degrees: a circle's stereographic picture is a circle, the ends of its diameter on one meridian.
        for theta in (52.5, 97.5, 142.5):
            for azimuth in (30, 150, 270):
                low, high = (scale * tan(radians(theta + s) / 2) for s in (-8, 8))
                a, middle = radians(azimuth), (low + high) / 2
                figure.circle(cx + middle * cos(a), cy - middle * sin(a), (high - low) / 2, "#333", 1, "#f0c000", opacity=0.8)
        figure.add("</g>")
        figure.circle(cx, cy, radius, INK, 1.5)
        figure.text(cx, 32, name, size=16, weight="bold")
        for theta in (30, 60, 90, 120, 150):
            r = scale * tan(radians(theta) / 2)
            previous = scale * tan(radians(theta - 30) / 2)
            if r < radius - 14 and r - previous > 15:
                figure.text(cx, cy - r + 5, f"{theta}°", fill=ORANGE if theta == 90 else BLUE, size=12, halo=True)
        edge = degrees(2 * atan(radius / scale))
        figure.text(cx, 258, f"to θ = {edge:.1f}°" if beta else "to θ = 90°", size=13)
    figure.text(440, 284, "Each view ends at θ′ = 90° from the motion. Circles: the world’s θ in steps of 15°; orange: θ = 90°.", size=13)
    figure.text(440, 304, "Yellow: discs that all have a radius of 8° in the world.", size=13)
    figure.write("aberration.svg")


def doppler():
    figure = Figure(880, 430, "The Doppler factor over the angle that the ship sees")
    left, right, top, bottom = 90, 640, 24, 368
    low, high = log(0.1), log(10)

    def x(theta):
        return left + (right - left) * theta / 180

    def y(D):
        return bottom - (bottom - top) * (log(D) - low) / (high - low)

    figure.add(f'<rect x="{left}" y="{top}" width="{right - left}" height="{bottom - top}" fill="none" stroke="{GREY}"/>')
    for theta in range(0, 181, 30):
        figure.line(x(theta), top, x(theta), bottom, "#ddd", 1)
        figure.text(x(theta), bottom + 20, f"{theta}°")
    for D in (0.1, 0.2, 0.5, 1, 2, 5, 10):
        figure.line(left, y(D), right, y(D), GREY if D == 1 else "#ddd", 1.5 if D == 1 else 1)
        figure.text(left - 8, y(D) + 5, f"{D:g}", "end")
    figure.text((left + right) / 2, bottom + 46, "angle θ′ from the motion, as the ship sees it")
    figure.add(f'<text transform="translate(34 {(top + bottom) / 2:.0f}) rotate(-90)" text-anchor="middle" fill="{INK}">Doppler factor D</text>')
    curves = [(0.2, GREY, "β = 0.2"), (0.5, GREEN, "β = 0.5"), (0.8, BLUE, "β = 0.8"), (sqrt(15) / 4, ORANGE, "γ = 4")]
    for beta, colour, _ in curves:
        figure.path([(x(t / 2), y(doppler_ship(radians(t / 2), beta))) for t in range(361)], colour, 2.4)
    for beta, colour, _ in curves:
        unshifted = degrees(acos((gamma(beta) - 1) / (gamma(beta) * beta)))
        figure.circle(x(unshifted), y(1), 4.5, "#fff", 1.2, colour)
        figure.add(f'<rect x="{x(90) - 4:.1f}" y="{y(1 / gamma(beta)) - 4:.1f}" width="8" height="8" fill="{colour}" stroke="#fff"/>')
    for k, (beta, colour, name) in enumerate(reversed(curves)):
        row = top + 12 + 66 * k
        figure.line(664, row, 694, row, colour, 3)
        unshifted = degrees(acos((gamma(beta) - 1) / (gamma(beta) * beta)))
        figure.text(702, row + 5, name, "start", weight="bold")
        figure.text(702, row + 23, f"ahead {exp_rapidity(beta):.3f}", "start", size=13)
        figure.text(702, row + 40, f"D = 1 at {unshifted:.2f}°", "start", size=13)
    figure.circle(679, 316, 4.5, INK, 1, INK)
    figure.text(702, 321, "no shift: D = 1", "start", size=13)
    figure.add(f'<rect x="675" y="338" width="8" height="8" fill="{INK}"/>')
    figure.text(702, 347, "abeam: D = 1/γ", "start", size=13)
    figure.write("doppler.svg")


def luminous(nm):
    """The CIE 1931 observer's y, within 0.008: Wyman, Sloan, Shirley, "Simple analytic
    approximations to the CIE XYZ color matching functions", Journal of Computer Graphics Techniques 2(2), 2013."""
    def lobe(height, middle, below, above):
        return height * exp(-0.5 * ((nm - middle) / (below if nm < middle else above)) ** 2)

    return lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1)


def spectrum():
    """A sunlit green surface, shifted along the logarithm of the wavelength."""
    figure = Figure(880, 350, "A spectrum that the Doppler shift moves past the eye's response")
    left, right = 70, 850
    first, last = 160.0, 2200.0

    def x(nm):
        return left + (right - left) * log(nm / first) / log(last / first)

    def sunlit_green(nm):  # per frequency; the Sun's 5772 K
        sun = (500 / nm) ** 3 / expm1(1.438776877e7 / (nm * 5772))
        return sun * (0.12 + 0.75 * exp(-0.5 * (log(nm / 530) / 0.09) ** 2) + 0.35 / (1 + exp(-log(nm / 820) / 0.05)))

    top, bottom = 54, 290
    most = max(sunlit_green(nm) for nm in range(160, 2200, 2))

    def y(value):
        return bottom - (bottom - top) * value / 1.12

    samples = [first * (last / first) ** (i / 400) for i in range(401)]
    eye = [nm for nm in samples if 390 <= nm <= 710]
    figure.path([(x(eye[0]), y(0))] + [(x(nm), y(luminous(nm))) for nm in eye] + [(x(eye[-1]), y(0))], "none", 0, "#ddd",
                closed=True)
    figure.add(f'<rect x="{right - 118}" y="58" width="16" height="12" fill="#ddd"/>')
    figure.text(right - 96, 69, "the eye’s ȳ(λ′)", "start", size=13)
    summit = max(range(480, 600), key=sunlit_green)
    for D, colour in ((2, BLUE), (1, GREEN), (0.5, ORANGE)):
        figure.path([(x(nm), y(sunlit_green(D * nm) / most)) for nm in samples], colour, 2.6)
        peak = summit / D
        height = y(sunlit_green(summit) / most)
        figure.line(x(peak), height - 6, x(peak), height - 18, colour, 1.5)
        figure.text(x(peak), height - 24, f"D = {D:g}", fill=colour, weight="bold", halo=True)
    level = 28
    figure.arrow(x(summit) - 6, level, x(summit / 2) + 2, level, BLUE, 1.6)
    figure.arrow(x(summit) + 6, level, x(2 * summit) - 2, level, ORANGE, 1.6)
    figure.text((x(summit) + x(summit / 2)) / 2, level - 8, "ln 2", fill=BLUE, size=13)
    figure.text((x(summit) + x(2 * summit)) / 2, level - 8, "ln 2", fill=ORANGE, size=13)
    figure.line(left, bottom, right, bottom, INK, 1.5)
    for nm in (200, 300, 400, 500, 700, 1000, 1500, 2000):
        figure.line(x(nm), bottom, x(nm), bottom + 5, INK, 1.5)
        figure.text(x(nm), bottom + 21, str(nm), size=13)
    figure.text((left + right) / 2, bottom + 42, "wavelength λ′ as seen, nm (logarithmic); each curve is L<tspan font-size=\"10\" dy=\"3\">ν</tspan><tspan dy=\"-3\">(Dλ′) of a sunlit green surface, without D³</tspan>", size=13)
    figure.write("spectrum.svg")


def retarded():
    """A body that passes at 0.8 c, at the moment at which it is abeam, and at which it is seen abeam."""
    beta = 0.8
    u, g = beta * gamma(beta), gamma(beta)
    figure = Figure(880, 392, "Where a body that passes is, and where it is seen")
    L = 150.0  # pixels
    line_y, oy = 142, 292
    for panel, (ahead, title) in enumerate(((0.0, "The body is abeam"), (beta, "The body is seen abeam"))):
        left = 440 * panel
        ox = left + (300, 180)[panel]
        now = ahead * L  # along its way, from abeam
        # (R15), the earlier root.
        root = sqrt((now * u) ** 2 + now ** 2 + L ** 2)
        tau = now * u - root
        then, delay = now + u * tau, -g * tau
        assert abs(hypot(then, L) - delay) < 1e-9 * delay
        D = delay / root
        figure.text(left + 220, 30, title, size=16, weight="bold")
        figure.line(left + 24, line_y, left + 420, line_y, GREY, 1.2, "6 5")
        if panel == 0:
            figure.line(ox, oy - 10, ox, line_y, INK, 1.2, "2 4")
        figure.arrow(ox + then, line_y, ox + now - 22, line_y, BLUE, 2)
        reach = hypot(then, L)
        figure.arrow(ox + then, line_y, ox + then * 14 / reach, oy - L * 14 / reach, ORANGE, 2.2)
        # A ball where it is: contracted along the motion.
        figure.add(f'<ellipse cx="{ox + now:.1f}" cy="{line_y:.1f}" rx="{20 / g:.1f}" ry="20" fill="#dceaf5" stroke="{BLUE}" stroke-width="2"/>')
        figure.circle(ox + then, line_y, 6, ORANGE, 1.5, ORANGE)
        figure.circle(ox, oy, 7, INK, 1.5, INK)
        figure.text(ox, oy + 26, "observer")
        figure.text(ox + now, line_y - 32, "now", fill=BLUE, weight="bold")
        figure.text(ox + then, line_y - 32, "when the light left", fill=ORANGE, weight="bold")
        if panel == 0:
            figure.text(ox + then / 2 + 22, line_y + 24, f"γβL = {(now - then) / L:.3f} L", fill=BLUE, size=13)
            figure.text(ox + then / 2 - 16, oy - L / 2 + 26, f"delay γL = {delay / L:.3f} L", "end", ORANGE, size=13)
            figure.text(ox + 10, oy - L / 2 + 5, "L", "start")
            angle = atan2(-then, L)
            figure.path([(ox - 46 * sin(angle * i / 20), oy - 46 * cos(angle * i / 20)) for i in range(21)], INK, 1.2)
            figure.text(ox - 32, oy - 62, f"{degrees(angle):.1f}°", size=13)
            figure.text(left + 220, 354, f"It is seen arctan(γβ) = {degrees(angle):.2f}° behind abeam,", size=13)
            figure.text(left + 220, 374, f"with D = γ = {D:.3f}.", size=13)
        else:
            figure.text(ox + now / 2, line_y + 24, f"βL = {(now - then) / L:.3f} L", fill=BLUE, size=13)
            figure.text(ox - 12, oy - L / 2 + 5, "delay L", "end", ORANGE, size=13)
            figure.text(left + 220, 354, f"It is seen turned by arcsin β = {degrees(asin(beta)):.2f}°,", size=13)
            figure.text(left + 220, 374, f"with D = 1/γ = {D:.3f}.", size=13)
    figure.line(440, 20, 440, 380, "#ddd", 1)
    figure.write("retarded.svg")


def tiles():
    """Three faces of the cube map, with the tiles and the Doppler factor on them."""
    beta = sqrt(15) / 4
    figure = Figure(880, 400, "Tiles of the cube map, and the Doppler factor at gamma 4")
    side, top, gap = 250.0, 62.0, 20.0
    lefts = [35 + (side + gap) * i for i in range(3)]

    def screen(face, a, b):
        """Face coordinates, -1 to 1, to the page; a is drawn to the right."""
        return lefts[face] + side * (a + 1) / 2, top + side * (1 - b) / 2

    def D_at(face, a, b):
        along = (1, -a, -1)[face]  # the side face has the motion to the left
        length = sqrt(1 + a * a + b * b)
        return gamma(beta) * (1 + beta * along / length)

    def contour(face, D):
        """Points of one value of D, by steps along the face: per column the crossing nearest to it."""
        wanted = (D / gamma(beta) - 1) / beta  # the cosine from the motion
        lines = []
        if face == 1:
            # -a / sqrt(1 + a^2 + b^2) = wanted
            line = []
            for i in range(-100, 101):
                b = i / 100
                a = -wanted * sqrt((1 + b * b) / (1 - wanted * wanted))
                if abs(a) <= 1:
                    line.append(screen(face, a, b))
            if line:
                lines.append(line)
        else:
            cosine = abs(wanted)
            if (wanted > 0) == (face == 0) and cosine < 1:
                r, run = tan(acos(cosine)), []
                for i in range(361):
                    a, b = r * cos(radians(i)), r * sin(radians(i))
                    if max(abs(a), abs(b)) <= 1:
                        run.append(screen(face, a, b))
                    elif run:
                        lines.append(run)
                        run = []
                if run:
                    lines.append(run)
        return lines

    for face, name in enumerate(("ahead: one tile", "one of four sides: three tiles", "behind: nested squares")):
        left = lefts[face]
        figure.add(f'<rect x="{left}" y="{top}" width="{side}" height="{side}" fill="#f4f7fa" stroke="{INK}" stroke-width="2"/>')
        figure.text(left + side / 2, top - 16, name, size=14, weight="bold")
    # Sub-tiles' grid, shown for the tile ahead.
    for i in range(1, 16):
        at = -1 + i / 8
        figure.line(*screen(0, at, -1), *screen(0, at, 1), "#d4dae0", 0.7)
        figure.line(*screen(0, -1, at), *screen(0, 1, at), "#d4dae0", 0.7)
    for at in (0, 0.5):
        figure.line(*screen(1, at, -1), *screen(1, at, 1), INK, 2)
    for k in range(1, 12):
        half = 2 ** (-k / 2)
        x0, y0 = screen(2, -half, half)
        figure.add(f'<rect x="{x0:.1f}" y="{y0:.1f}" width="{side * half:.1f}" height="{side * half:.1f}" fill="none" stroke="{INK}" stroke-width="{2 if k < 5 else 1.2}"/>')
    shown = {0: (7.75, 7.5, 7, 6.5), 1: (6, 5, 3, 2), 2: (1.5, 1, 0.5, 0.25)}
    for face, values in shown.items():
        for D in values:
            for line in contour(face, D):
                figure.path(line, ORANGE, 1.8)
    for face, values in shown.items():
        for k, D in enumerate(values):
            wanted = (D / gamma(beta) - 1) / beta
            if face == 1:
                a = -wanted / sqrt(1 - wanted * wanted)
                figure.text(*[p + d for p, d in zip(screen(1, a, 0), (0, 5))], f"{D:g}", fill=ORANGE, size=13, halo=True)
            else:
                r = tan(acos(abs(wanted)))
                azimuth = radians(45 if r > 1 else (k if face == 0 else -k) * 90 + 180)  # apart from one another
                where = screen(face, r * cos(azimuth), r * sin(azimuth))
                figure.text(where[0], where[1] + 5, f"{D:g}", fill=ORANGE, size=13, halo=True)
    figure.text(440, 342, "Orange: the world’s directions of equal D, at γ = 4. A pixel needs texels of the angle D times its own:", size=13)
    figure.text(440, 362, "fine ones behind, where D is small, and coarse ones ahead, where D is large.", size=13)
    figure.text(440, 386, "Grey, ahead: the 16 × 16 cells of which a tile’s sub-tiles are made; every tile has them.", size=13)
    figure.write("tiles.svg")


def check():
    """The half-angle form against the cosine form, and the numbers that the pages quote."""
    for beta in (0.1, 0.5, 0.9):
        for theta in range(5, 180, 5):
            t = radians(theta)
            seen = ship_angle(t, beta)
            assert abs(cos(seen) - (cos(t) + beta) / (1 + beta * cos(t))) < 1e-12
            assert abs(doppler_world(t, beta) / doppler_ship(seen, beta) - 1) < 1e-12
    assert abs(degrees(ship_angle(radians(120), 0.5)) - 90) < 1e-9


if __name__ == "__main__":
    check()
    aberration()
    doppler()
    spectrum()
    retarded()
    tiles()
