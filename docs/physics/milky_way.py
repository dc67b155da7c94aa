#!/usr/bin/env python3
"""Measures the sky in Starbow's own picture against published numbers, and draws milky-way.svg beside this file.

    python3 docs/physics/milky_way.py STARBOW [FOLDER]

STARBOW  the program, such as build/release/starbow.
FOLDER   for the two pictures, which are kept and used again [out/milky-way].

Both pictures are EXRs of the whole sky at rest, six faces of a cube. The first has no stars brighter than 6.5, as Pioneer 10's
map has none, and all others. The second has every star. Needs python3-numpy.
"""
import json
import subprocess
import sys
import zlib
from math import log10
from pathlib import Path

import numpy as np

from figures import BLUE, GREY, INK, ORANGE, Figure

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scenes/sky"))
import convert  # noqa: E402  Pioneer 10's table, and the turn from equatorial to galactic

SIDE = 900  # pixels of a face of the cube around the eye
FACES = {"ahead": {}, "right": {"yaw": 90}, "behind": {"yaw": 180}, "left": {"yaw": -90}, "up": {"pitch": 90},
         "down": {"pitch": -90}}
CELL = 0.25  # degrees
WIDTH, HEIGHT = int(360 / CELL), int(180 / CELL)
BRIGHTNESS = 500.0  # square minutes of arc of white that a star of magnitude 0 equals, in both pictures
BEAM = 2.3 / 2.355  # sigma of Pioneer 10's beam, degrees

# V and B-V of the Bright Star Catalogue, 5th ed. (Hoffleit and Warren 1991): right ascension, declination (degrees), V, B-V.
BRIGHT = [("Sirius", 101.287, -16.716, -1.46, 0.00), ("Canopus", 95.988, -52.696, -0.72, 0.15),
          ("Arcturus", 213.915, 19.182, -0.04, 1.23), ("Vega", 279.235, 38.784, 0.03, 0.00),
          ("Rigel", 78.634, -8.202, 0.12, -0.03), ("Procyon", 114.825, 5.225, 0.38, 0.42),
          ("Betelgeuse", 88.793, 7.407, 0.50, 1.85), ("Altair", 297.696, 8.868, 0.77, 0.22),
          ("Aldebaran", 68.980, 16.509, 0.85, 1.54), ("Spica", 201.298, -11.161, 0.98, -0.23)]


# ---------------------------------------------------------------- pictures

def draw(starbow, folder, name, faintest_left_out):
    """A picture of the whole sky without the stars brighter than a magnitude, as a Sky."""
    if not (folder / name / "down.exr").exists():
        folder.mkdir(parents=True, exist_ok=True)
        lines = (ROOT / "scenes/stars/stars.txt").read_text().splitlines(keepends=True)
        kept = [line for line in lines if line[0] == "#" or int(line.split()[2]) >= 100 * faintest_left_out]
        (folder / f"{name}.txt").write_text("".join(kept))
        (folder / f"{name}-scene.json").write_text(json.dumps({
            "gltf": str(ROOT / "scenes/voyage/voyage.glb"), "unit_m": 9460730472580800, "light_speed_m_s": 299792458,
            "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0], "nadir": [0, 0, 0]},
            "stars": {"catalogue": f"{name}.txt", "brightness_arcmin2": BRIGHTNESS,
                      "milky_way": {"panorama": str(ROOT / "scenes/sky/milky-way.png"), "peak_arcmin2": 3.2414e-5}},
            "start": {"position": [0, 0, 0], "look": [0, 0, -1], "up": [0, 1, 0]}}))
        (folder / f"{name}-shot.json").write_text(json.dumps({
            "scene": f"{name}-scene.json", "position": [0, 0, 0], "look": [0, 0, -1], "up": [0, 1, 0]}))
        (folder / "faces.json").write_text(json.dumps({"outputs": [
            {"name": face, "size": [SIDE, SIDE],
             "viewports": [{"projection": {"type": "planar", "fov_y_deg": 90, "turn_deg": turn}}]}
            for face, turn in FACES.items()]}))
        subprocess.run([starbow, "render", "--layout", folder / "faces.json", "--shot", folder / f"{name}-shot.json",
                        "--out", folder / name, "--exr"], check=True)
    return Sky([read_exr(folder / name / f"{face}.exr") for face in FACES])


class Sky:
    """Light, galactic direction and solid angle (square degrees) of all pixels, and their sums over cells of galactic
    longitude and latitude."""

    def __init__(self, faces):
        across = (np.arange(SIDE) + 0.5) / SIDE * 2 - 1
        one = (2 / SIDE) ** 2 / (1 + across ** 2 + across[:, None] ** 2) ** 1.5 * np.degrees(1) ** 2
        self.light = np.concatenate([face[..., :3].reshape(-1, 3) for face in faces])
        self.solid = np.tile(one.ravel(), len(faces))
        x, y, z = np.moveaxis(np.concatenate([face[..., 3:].reshape(-1, 3) for face in faces]), -1, 0)
        # The scene's -z is the equinox, y north: x is right ascension 270 degrees.
        self.way = np.stack([-z, -x, y], -1) @ convert.GALACTIC.T
        l, b = convert.angles(self.way)
        cells = (np.minimum((b + 90) / CELL, HEIGHT - 1).astype(int), (l / CELL).astype(int) % WIDTH)
        sums = np.zeros((HEIGHT, WIDTH, 4))
        np.add.at(sums, cells, np.concatenate([self.light, np.ones((len(l), 1))], -1) * self.solid[:, None])
        self.cells = sums

    def around(self, l, b, reach):
        """Light times solid angle, solid angle, and distance (degrees) of the cells about a place."""
        rows = np.arange(max(0, int((b + 90 - reach) / CELL)), min(HEIGHT, int((b + 90 + reach) / CELL) + 1))
        polar = abs(b) + reach
        half = WIDTH // 2 if polar > 85 else int(reach / np.cos(np.radians(polar)) / CELL) + 2
        columns = (int(l / CELL) + np.arange(-half, half)) % WIDTH
        way = convert.unit((columns + 0.5) * CELL, (rows[:, None] + 0.5) * CELL - 90)
        part = self.cells[rows][:, columns]
        return part[..., :3], part[..., 3], np.degrees(np.arccos(np.clip(way @ convert.unit(l, b), -1, 1)))


def read_exr(path):
    """R, G, B and the world's direction, from an EXR of 32-bit channels by scan lines, plain or zipped."""
    data, at = path.read_bytes(), 8
    header = {}
    while data[at]:
        name, kind = data[at:at + 300].split(b"\0", 2)[:2]
        at += len(name) + len(kind) + 2
        size = int.from_bytes(data[at:at + 4], "little")
        header[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    channels, rest = [], header[b"channels"]
    while rest[0]:
        name, rest = rest.split(b"\0", 1)
        assert rest[0] == 2, "32-bit floats are right"
        channels.append(name.decode())
        rest = rest[16:]
    left, top, right, bottom = np.frombuffer(header[b"dataWindow"], "<i4")
    width, height = right - left + 1, bottom - top + 1
    rows = {0: 1, 3: 16}[header[b"compression"][0]]
    starts = np.frombuffer(data, "<u8", (height + rows - 1) // rows, at + 1)
    picture = np.empty((height, len(channels), width), "<f4")
    for k, start in enumerate(starts):
        start = int(start)
        size = int.from_bytes(data[start + 4:start + 8], "little")
        block = data[start + 8:start + 8 + size]
        count = min(rows, height - k * rows)
        if size < count * len(channels) * width * 4:  # zipped: differences of bytes, first the even ones and then the odd
            steps = np.frombuffer(zlib.decompress(block), "u1").astype(np.int64)
            steps[1:] -= 128
            whole = np.cumsum(steps).astype("u1")
            block = np.empty_like(whole)
            block[0::2], block[1::2] = whole[:(len(whole) + 1) // 2], whole[(len(whole) + 1) // 2:]
        picture[k * rows:k * rows + count] = np.frombuffer(block, "<f4").reshape(count, len(channels), width)
    wanted = ["R", "G", "B", "worldDirection.X", "worldDirection.Y", "worldDirection.Z"]
    return np.stack([picture[:, channels.index(c)] for c in wanted], -1).astype(float)


# ---------------------------------------------------------------- light and colour

NM = np.arange(360.0, 831.0)


def matching():
    """The CIE 1931 observer: Wyman, Sloan, Shirley, Journal of Computer Graphics Techniques 2(2), 2013."""
    def lobe(m, below, above):
        return np.exp(-0.5 * ((NM - m) / np.where(NM < m, below, above)) ** 2)

    return np.stack([1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2),
                     0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
                     1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)])


def black_body(kelvin):
    return matching() @ (NM ** -5 / np.expm1(1.438776877e7 / (NM * kelvin)))


def kelvin_of(bv):  # Ballesteros 2012
    return 4600 * (1 / (0.92 * bv + 1.7) + 1 / (0.92 * bv + 0.62))


# From the picture's Rec. 709 back to XYZ under the Sun: Bradford's adaptation, turned round.
XYZ_OF_709 = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]])
CONES = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])
SUN = black_body(5772) / black_body(5772)[1]
ADAPTED = np.linalg.inv(CONES) @ np.diag((CONES @ SUN) / (CONES @ XYZ_OF_709.sum(1))) @ CONES @ XYZ_OF_709
BV = np.arange(-0.4, 2.5, 0.005)
BLUE_TO_RED = np.array([log10(c[2] / c[0]) for c in map(black_body, map(kelvin_of, BV))])


def luminance_and_bv(light):
    """Luminance, and the B-V of the black body with the same ratio of Z to X."""
    xyz = light @ ADAPTED.T
    return xyz[..., 1], np.interp(-np.log10(xyz[..., 2] / xyz[..., 0]), -BLUE_TO_RED, BV)


def beam(sky, l, b):
    """S10(V), B-V and S10 at 440 nm in Pioneer 10's beam about a place."""
    light, solid, off = sky.around(l, b, 3.5 * BEAM)
    weight = np.exp(-0.5 * (off / BEAM) ** 2)
    Y, bv = luminance_and_bv((light * weight[..., None]).sum((0, 1)) / (solid * weight).sum())
    return s10(Y), bv, s10(Y) * 10 ** (-0.4 * (bv - convert.SUN_BV))


def s10(luminance):
    """One star of magnitude 0 in each square minute of arc has the luminance BRIGHTNESS."""
    return luminance / BRIGHTNESS * 3600 * 1e4


def star(sky, ra, dec):
    """V and B-V of the light within half a degree of a place, without that of the ring around."""
    off = np.degrees(np.arccos(np.clip(sky.way @ (convert.GALACTIC @ convert.unit(ra, dec)), -1, 1)))
    near = off < 0.5
    ring = np.median(sky.light[(off > 0.7) & (off < 1.1)], 0)
    Y, bv = luminance_and_bv(((sky.light[near] - ring) * sky.solid[near][:, None]).sum(0))
    return -2.5 * log10(Y * 3600 / BRIGHTNESS), bv


def catalogue_star(ra, dec):
    """V and B-V of the brightest star of scenes/stars within a tenth of a degree."""
    for line in (ROOT / "scenes/stars/stars.txt").open():
        if line[0] != "#":
            numbers = line.split()
            place = [int(n) / 1e5 for n in numbers[:2]]
            if convert.unit(*place) @ convert.unit(ra, dec) > np.cos(np.radians(0.1)):
                return int(numbers[2]) / 100, int(numbers[3]) / 100


# ---------------------------------------------------------------- the figure

def statistics(ratios):
    """Mean, spread about the mean (rms) and worst of some ratios."""
    ratios = np.asarray(ratios)
    return ratios.mean(), np.sqrt(((ratios - ratios.mean()) ** 2).mean()), ratios[np.abs(np.log(ratios)).argmax()]


def main(starbow, folder):
    faint = draw(starbow, folder, "without-bright", convert.PIONEER_LIMIT)
    every = draw(starbow, folder, "every-star", -99)
    ls, bs = convert.PIONEER_L, convert.PIONEER_B
    nodes = np.array([[beam(faint, float(l), float(b)) for l in ls] for b in bs])  # latitude, longitude, (V, B-V, 440 nm)
    mapped = np.ones(convert.PIONEER.shape, bool)
    mapped[np.ix_(convert.UNMAPPED[1], convert.UNMAPPED[0])] = False
    published = convert.PIONEER * 10 ** (0.4 * (nodes[..., 1] - convert.SUN_BV))  # brought to V by the picture's colour there
    ratio = nodes[..., 2] / convert.PIONEER
    level = nodes[..., 0] / (convert.PIONEER * 10 ** (0.4 * (convert.WHOLE_SKY_BV - convert.SUN_BV)))
    row, column = list(bs).index(0), list(ls).index(0)
    cases = {"b = 0": np.s_[row, :], "l = 0": np.s_[:, column], "the whole table": mapped}
    outcome = {}
    for name, where in cases.items():
        outcome[name] = statistics(ratio[where])
        print(f"{name}: {ratio[where].size} places, picture / Pioneer 10: mean {outcome[name][0]:.3f}, rms about it "
              f"{outcome[name][1]:.3f}, worst {outcome[name][2]:.3f}; brought to V by B-V 0.80 everywhere: mean "
              "%.3f, rms %.3f, worst %.3f" % statistics(level[where]))
    i, j = np.unravel_index(np.where(mapped, np.abs(np.log(ratio)), 0).argmax(), ratio.shape)
    print(f"the worst: l {ls[j]}, b {bs[i]}, picture {nodes[i, j, 2]:.0f}, Pioneer 10 {convert.PIONEER[i, j]:.0f} S10 at 440 nm")
    for name, ra, dec, blue, _ in convert.POLES:
        l, b = convert.angles(convert.unit(ra, dec) @ convert.GALACTIC.T)
        print(f"  {name} (table 34, not used to make the panorama): picture {beam(faint, float(l), float(b))[2]:.1f}, "
              f"Pioneer 10 {blue} S10 at 440 nm")
    for name, sky in (("without the stars above 6.5", faint), ("with every star", every)):
        Y, bv = luminance_and_bv((sky.light * sky.solid[:, None]).sum(0) / sky.solid.sum())
        print(f"whole sky {name}: {s10(Y):.1f} S10(V), B-V {bv:.2f}; solid angle {sky.solid.sum():.1f} square degrees")

    figure = Figure(880, 922, "The Milky Way's brightness and the bright stars in Starbow's picture, and published values")
    left, right = 74, 858
    figure.text(left, 24, "Starbow’s picture at rest, without the stars brighter than magnitude 6.5", "start", size=13)
    figure.line(left - 36, 19, left - 8, 19, BLUE, 2.4)
    figure.circle(left - 22, 41, 4, "#fff", 1, ORANGE)
    figure.text(left, 46, "Pioneer 10, ± 10 % (its accuracy), from 440 nm to V by the picture’s own B−V", "start", size=13)

    def panel(top, bottom, most, step, title, ticks, x_of, curve, points, sums):
        def y(s10):
            return bottom - (bottom - top) * s10 / most

        for s10 in range(0, most + 1, step):
            figure.line(left, y(s10), right, y(s10), GREY if s10 == 0 else "#ddd", 1)
            figure.text(left - 8, y(s10) + 5, str(s10), "end", size=13)
        for value, label in ticks:
            figure.line(x_of(value), top, x_of(value), bottom, "#ddd", 1)
            figure.text(x_of(value), bottom + 18, label, size=13)
        figure.add(f'<rect x="{left}" y="{top}" width="{right - left}" height="{bottom - top}" fill="none" stroke="{GREY}"/>')
        figure.add(f'<text transform="translate(24 {(top + bottom) / 2:.0f}) rotate(-90)" text-anchor="middle" fill="{INK}" '
                   'font-size="13">surface brightness, S10(V)</text>')
        figure.text((left + right) / 2, bottom + 38, title, size=13)
        figure.path([(x_of(value), y(s10)) for value, s10 in curve], BLUE, 2.2)
        for value, s10 in points:
            figure.line(x_of(value), y(0.9 * s10), x_of(value), y(1.1 * s10), ORANGE, 1.3)
            figure.circle(x_of(value), y(s10), 3.6, "#fff", 1, ORANGE)
        mean, spread, worst = sums
        figure.text(right - 10, top + 20, f"picture / published: mean {mean:.3f}, rms {100 * spread:.0f} %, worst {worst:.2f}",
                    "end", size=13, halo=True)

    def wrapped(l):  # longitude, 180 to -180
        return (l + 180) % 360 - 180

    along = [(l, beam(faint, l % 360, 0.0)[0]) for l in np.arange(180, -180.5, -1.0)]
    dots = [(wrapped(l), published[row, i]) for i, l in enumerate(ls)]
    dots += [(180, s) for l, s in dots if l == -180]
    panel(64, 304, 1000, 200, "galactic longitude l, at b = 0", [(l, f"{l % 360}°") for l in range(180, -181, -30)],
          lambda l: left + (right - left) * (180 - l) / 360, along, dots, outcome["b = 0"])
    across = [(b, beam(faint, 0.0, b)[0]) for b in np.arange(-90, 90.25, 0.5)]
    panel(362, 602, 1000, 200, "galactic latitude b, at l = 0", [(b, f"{b}°".replace("-", "−")) for b in range(-90, 91, 15)],
          lambda b: left + (right - left) * (b + 90) / 180, across,
          [(b, published[i, column]) for i, b in enumerate(bs)], outcome["l = 0"])

    found = [(*one, *star(every, one[1], one[2]), *catalogue_star(one[1], one[2])) for one in BRIGHT]
    top, bottom = 688, 840
    for k, (title, limit, places) in enumerate((("V", 0.2, (3, 5, 7)), ("B−V", 0.4, (4, 6, 8)))):
        x0 = left + k * ((right - left) / 2 + 22)
        wide = (right - left) / 2 - 22

        def y(difference):
            return (top + bottom) / 2 - (bottom - top) / 2 * difference / limit

        for tick in (-1, -0.5, 0, 0.5, 1):
            figure.line(x0, y(tick * limit), x0 + wide, y(tick * limit), GREY if tick == 0 else "#ddd", 1)
            figure.text(x0 - 6, y(tick * limit) + 5, f"{tick * limit:+.1f}".replace("-", "−") if tick else "0", "end", size=12)
        figure.text(x0 + wide / 2, top - 12, f"{title} of ten bright stars: picture minus published", size=13, weight="bold")
        for i, one in enumerate(found):
            x = x0 + wide * (i + 0.5) / len(found)
            seen, own = one[places[1]], one[places[2]]
            figure.circle(x, y(seen - one[places[0]]), 4.2, "#fff", 1, BLUE)
            figure.circle(x, y(seen - own), 4.2, INK, 1.3)
            figure.add(f'<text transform="translate({x + 5:.1f} {bottom + 10}) rotate(-38)" text-anchor="end" '
                       f'fill="{INK}" font-size="12">{one[0]}</text>')
    figure.circle(left + 6, 909, 4.2, "#fff", 1, BLUE)
    figure.text(left + 18, 914, "minus the Bright Star Catalogue", "start", size=12)
    figure.circle(left + 262, 909, 4.2, INK, 1.3)
    figure.text(left + 274, 914, "minus the shipped catalogue (Hipparcos), of which the picture is made", "start", size=12)
    figure.write("milky-way.svg")
    for name, _, _, V, bv, seen, seen_bv, own, own_bv in found:
        print(f"{name:11s} V {seen:5.2f}, published {V:5.2f}, shipped {own:5.2f}; B-V {seen_bv:5.2f}, published {bv:5.2f}, "
              f"shipped {own_bv:5.2f}")
    for title, a, b in (("V - published", 5, 3), ("V - shipped", 5, 7), ("B-V - published", 6, 4), ("B-V - shipped", 6, 8)):
        off = np.array([one[a] - one[b] for one in found])
        print(f"{title}: mean {off.mean():+.3f}, rms {np.sqrt((off ** 2).mean()):.3f}, worst {off[np.abs(off).argmax()]:+.3f} "
              f"({found[np.abs(off).argmax()][0]})")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(str(Path(sys.argv[1]).resolve()), Path(sys.argv[2]) if len(sys.argv) == 3 else ROOT / "out/milky-way")
