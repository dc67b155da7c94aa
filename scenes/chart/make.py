#!/usr/bin/env python3
"""Writes chart.glb: a colour chart of 24 fields on a gallery's wall, each with a reflectance of its own from 300 to 1000 nm, and
above it three lamps of equal brightness: black bodies of 2000, 2856 and 10,000 K. Needs Python 3's own library only; the same
bytes come out every time."""
import sys
from math import exp, log
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
from glb import Glb

# After the names and the kinds of a colour chart's fields: a level, then steps (s) and bumps (g) of a height, around a
# wavelength in nm, so wide.
FIELDS = [
    ("dark skin", 0.06, [("s", 0.14, 600, 35)]),
    ("light skin", 0.22, [("s", 0.2, 520, 60), ("s", 0.28, 590, 15), ("g", -0.06, 550, 14)]),
    ("blue sky", 0.12, [("g", 0.24, 450, 60), ("s", 0.04, 700, 20)]),
    ("foliage", 0.05, [("g", 0.11, 550, 32), ("s", 0.35, 710, 14)]),
    ("blue flower", 0.2, [("g", 0.26, 440, 48), ("s", 0.3, 680, 25)]),
    ("bluish green", 0.2, [("g", 0.42, 505, 52), ("s", 0.15, 720, 20)]),
    ("orange", 0.05, [("s", 0.56, 588, 17)]),
    ("purplish blue", 0.08, [("g", 0.3, 440, 38), ("s", 0.35, 700, 20)]),
    ("moderate red", 0.1, [("s", 0.48, 605, 16), ("g", 0.04, 430, 30)]),
    ("purple", 0.045, [("g", 0.15, 425, 32), ("s", 0.32, 665, 25)]),
    ("yellow green", 0.07, [("s", 0.45, 520, 18), ("g", -0.1, 640, 40), ("s", 0.2, 720, 25)]),
    ("orange yellow", 0.06, [("s", 0.62, 560, 20)]),
    ("blue", 0.05, [("g", 0.29, 445, 30), ("s", 0.15, 720, 20)]),
    ("green", 0.055, [("g", 0.3, 530, 35), ("s", 0.15, 715, 25)]),
    ("red", 0.045, [("s", 0.68, 617, 13)]),
    ("yellow", 0.055, [("s", 0.7, 515, 17)]),
    ("magenta", 0.1, [("s", 0.7, 610, 18), ("g", 0.3, 430, 45), ("g", -0.03, 540, 25)]),
    ("cyan", 0.07, [("g", 0.33, 480, 48), ("s", 0.1, 720, 20)]),
    ("white", 0.9, []), ("neutral 8", 0.59, []), ("neutral 6.5", 0.36, []), ("neutral 5", 0.19, []),
    ("neutral 3.5", 0.09, []), ("black", 0.03, [])]

# Kelvin; the energy, in a sunlit white surface's, that gives half its luminance; a colour for who draws no spectra.
LAMPS = [(2000, 28.7, (1.0, 0.33, 0.02)), (2856, 2.80, (1.0, 0.53, 0.18)), (10000, 0.626, (0.72, 0.84, 1.0))]

WALL, STEP, SIDE = -6.5, 1.0, 0.88


def visible(level, features, nm):
    for kind, height, middle, width in features:
        x = (nm - middle) / width
        level += height * (1 / (1 + exp(-x)) if kind == "s" else exp(-0.5 * x * x))
    return min(max(level, 0.005), 0.98)


def reflectance(level, features, nm):
    """As paints do, each goes on beyond the visible into a value of its own."""
    if not features:
        return level
    mean = sum(visible(level, features, at) for at in range(400, 701, 10)) / 31
    uv = 1 / (1 + exp(log(nm / 360) / 0.035))
    ir = 1 / (1 + exp(-log(nm / 820) / 0.05))
    return (uv * (0.5 * visible(level, features, 380) + 0.02) + ir * (0.8 * mean + 0.05)
            + (1 - uv - ir) * visible(level, features, min(max(nm, 330.0), 900.0)))


def luminance(rgb):
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]


def add_chart(glb):
    glb.put("board", shapes.box((3.12, 2.12, 0.05), (0, 0, WALL + 0.05)), glb.material("board", (0.02, 0.02, 0.02)))
    field = glb.geometry(shapes.box((SIDE / 2, SIDE / 2, 0.02)))
    for i, (name, level, features) in enumerate(FIELDS):
        table = [[nm, round(reflectance(level, features, nm), 4)] for nm in range(300, 1001, 10)]
        # White: the base colour's luminance scales the table.
        paint = glb.material(name, (1, 1, 1), starbow={"reflectance": table})
        glb.node(name, glb.mesh(name, field, paint), (STEP * (i % 6 - 2.5), STEP * (1.5 - i // 6), WALL + 0.12))


def add_lamps(glb):
    brass = glb.material("bracket", (0.06, 0.055, 0.05))
    globe = glb.geometry(shapes.sphere(48, 24, 0.36))
    bracket = glb.mesh("bracket", glb.geometry(shapes.box((0.05, 0.05, 0.45), (0, 0, -0.45))), brass)
    for i, (kelvin, energy, colour) in enumerate(LAMPS):
        emissive = [round(part * energy / luminance(colour), 4) for part in colour]
        lamp = glb.material(f"{kelvin} K", (0, 0, 0), emissive=emissive, starbow={"emission": {"black_body_K": kelvin}})
        place = (2.0 * (i - 1), 2.85, WALL + 0.85)
        glb.node(f"{kelvin} K", glb.mesh(f"{kelvin} K", globe, lamp), place)
        glb.node("bracket", bracket, place)


def add_gallery(glb):
    plaster = glb.material("plaster", (0.36, 0.36, 0.36))
    light, dark = (glb.material(name, (c, c, c)) for name, c in (("light stone", 0.30), ("dark stone", 0.16)))
    glb.put("wall", shapes.box((14, 4, 0.5), (0, 1.2, WALL - 0.5)), plaster)
    glb.put("skirting", shapes.box((14, 0.15, 0.06), (0, -2.65, WALL + 0.06)), dark)
    pier = glb.mesh("pier", glb.geometry(shapes.box((0.5, 4, 0.4), (0, 1.2, WALL + 0.4))), plaster)
    for x in (-13.5, -9, -4.75, 4.75, 9, 13.5):
        glb.node("pier", pier, (x, 0, 0))
    stones = (shapes.Shape(), shapes.Shape())
    for i in range(-7, 7):
        for j in range(10):
            z = WALL + 2 * j
            stones[(i + j) % 2].add(shapes.level(2 * i, z + 2, 2 * i + 2, z, -2.8))
    glb.put("light stones", stones[0], light)
    glb.put("dark stones", stones[1], dark)


def main():
    glb = Glb("chart")
    add_gallery(glb)
    add_chart(glb)
    add_lamps(glb)
    glb.write(sys.argv[1] if len(sys.argv) > 1 else HERE / "chart.glb")


if __name__ == "__main__":
    main()
