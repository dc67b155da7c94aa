#!/usr/bin/env python3
"""Writes chart.glb: a colour chart of 24 fields on a wall in a garden of sculptures, each with a reflectance of its own from 300 to
1000 nm, and above it three lamps of equal brightness: black bodies of 2000, 2856 and 10,000 K. Needs Python 3's own library only; the same
bytes come out every time."""
import random
import sys
from math import cos, exp, log, pi, sin
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
from glb import Glb
from land import Kit, around, bench, cloud, crown, mountains, pavement, skyline, tree

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
GROUND = -2.8


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
    field = glb.geometry(shapes.box((SIDE / 2, SIDE / 2, 0.02)), uvs=False)
    for i, (name, level, features) in enumerate(FIELDS):
        table = [[nm, round(reflectance(level, features, nm), 4)] for nm in range(300, 1001, 10)]
        # White: the base colour's luminance scales the table.
        paint = glb.material(name, (1, 1, 1), starbow={"reflectance": table})
        glb.node(name, glb.mesh(name, field, paint), (STEP * (i % 6 - 2.5), STEP * (1.5 - i // 6), WALL + 0.12))


def add_lamps(glb):
    brass = glb.material("bracket", (0.06, 0.055, 0.05))
    globe = glb.geometry(shapes.sphere(32, 16, 0.36), uvs=False)
    bracket = glb.mesh("bracket", glb.geometry(shapes.box((0.05, 0.05, 0.45), (0, 0, -0.45))), brass)
    for i, (kelvin, energy, colour) in enumerate(LAMPS):
        emissive = [round(part * energy / luminance(colour), 4) for part in colour]
        lamp = glb.material(f"{kelvin} K", (0, 0, 0), emissive=emissive, starbow={"emission": {"black_body_K": kelvin}})
        place = (2.0 * (i - 1), 2.85, WALL + 0.85)
        glb.node(f"{kelvin} K", glb.mesh(f"{kelvin} K", globe, lamp), place)
        glb.node("bracket", bracket, place)


def add_wall(kit):
    """What the chart hangs on: neutral plaster, so that no colour beside it deceives the eye, framed by stone."""
    kit.paint("plaster", (0.42, 0.42, 0.42))
    kit.paint("stone", (0.56, 0.52, 0.45))
    kit.build("wall", shapes.box((5.0, 3.35, 0.4), (0, GROUND + 3.35, WALL - 0.4)), "plaster")
    frame = shapes.box((5.75, 0.20, 0.62), (0, GROUND + 6.9, WALL - 0.4))
    frame.add(shapes.box((5.55, 0.18, 0.50), (0, GROUND + 0.18, WALL - 0.32)))
    for side in (-1, 1):
        frame.add(shapes.box((0.42, 3.35, 0.52), (side * 5.0, GROUND + 3.35, WALL - 0.4)))
        frame.add(shapes.sphere(16, 8, 0.42), (side * 5.0, GROUND + 7.45, WALL - 0.4))
    kit.build("frame", frame, "stone")


def add_terrace(kit):
    """Slabs before and beside the wall, gravel along them, and lawn."""
    for name, colour in (("light stone", (0.42, 0.39, 0.34)), ("dark stone", (0.30, 0.28, 0.25)), ("gravel", (0.50, 0.43, 0.31))):
        kit.paint(name, colour)
    kit.paint("lawn", (0.140, 0.265, 0.075), infrared=0.5)
    squares = pavement(-12, WALL - 3.5, 12, 12, 2, GROUND, lambda i, j: 2 if i in (0, 11) or j in (0, 11) else (i + j) % 2, 3)
    for name, shape in zip(("light stone", "dark stone", "gravel"), squares):
        kit.build(f"{name}s", shape, name)
    kit.build("lawn", around(-12, WALL + 20.5, 12, WALL - 3.5, 300, GROUND), "lawn")


def add_sculptures(kit):
    """Solids in plain strong colours on plinths, to both sides of the way to the chart: their colours change in flight as well."""
    kit.paint("plinth", (0.62, 0.60, 0.56))
    kit.make("plinth", shapes.box((0.55, 0.5, 0.55), (0, 0.5, 0)), "plinth")
    cone = shapes.revolved(28, 1, lambda t: (0.62 * (1 - t) + 1e-3, 1.4 * t), 1)
    ring = shapes.Shape()
    ring.add(shapes.torus(28, 8, 0.55, 0.17), (0, 0.72, 0))
    ball, cube = shapes.Shape(), shapes.Shape()
    ball.add(shapes.sphere(20, 10, 0.62), (0, 0.62, 0))
    cube.add(shapes.box((0.45, 0.45, 0.45)), (0, 0.74, 0), shapes.then(shapes.quaternion((1, 0, 1), 0.9), shapes.quaternion((0, 1, 0), 0.4)))
    solids = (("ball", ball, (0.66, 0.06, 0.05)), ("cube", cube, (0.05, 0.16, 0.52)), ("cone", cone, (0.78, 0.52, 0.04)), ("ring", ring, (0.05, 0.36, 0.20)))
    for k, (name, shape, colour) in enumerate(solids):
        kit.paint(name, colour)
        kit.make(name, shape, name)
        for side, order in ((-1, k), (1, 3 - k)):
            x, z = side * (6.75, 7.4, 8.3, 7.4)[order], WALL + 0.9 + 4.2 * order
            kit.put("plinth", (x, GROUND, z), 0.3 * order)
            kit.put(name, (x, GROUND + 1.0, z), 0.7 * k - side * 0.5)


def add_garden(kit):
    """Hedges, trees and benches around, hills and clouds behind."""
    for name, colour in (("leaves", (0.085, 0.225, 0.055)), ("light leaves", (0.15, 0.31, 0.07))):
        kit.paint(name, colour, infrared=0.5)
    kit.paint("bark", (0.13, 0.085, 0.05))
    kit.paint("wood", (0.24, 0.12, 0.05))
    kit.paint("iron", (0.03, 0.04, 0.045))
    dark, light, trunk = tree()
    kit.make("tree", dark, "leaves", light, "light leaves", trunk, "bark")
    kit.make("hedge", shapes.box((3.0, 0.62, 0.5), (0, 0.62, 0)), "leaves")
    kit.make("ball of box", crown([(0.75, (0, 0.68, 0))], 6, 12, 7), "light leaves")
    wood, legs = bench()
    kit.make("bench", wood, "wood", legs, "iron")
    for side in (-1, 1):
        for k in range(4):
            kit.put("hedge", (side * 13.2, GROUND, WALL + 1 + 6.4 * k), pi / 2)
            kit.put("ball of box", (side * 13.2, GROUND, WALL + 4.2 + 6.4 * k))
        for x in (8.6, 14.8, 21.0):
            kit.put("hedge", (side * x, GROUND, WALL - 6.5))
        kit.put("bench", (side * 10.6, GROUND, WALL + 4.8), -side * pi / 2)
        kit.put("bench", (side * 10.6, GROUND, WALL + 13.2), -side * pi / 2)
    rng = random.Random(12)
    for k in range(48):
        a = 2 * pi * k / 48 + rng.uniform(-0.04, 0.04)
        far = rng.uniform(21, 30) + (rng.uniform(0, 26) if k % 3 == 0 else 0)
        kit.put("tree", (far * sin(a), GROUND, -far * cos(a) + 1), rng.uniform(0, 6), rng.uniform(1.1, 1.9))
    kit.paint("hills", (0.14, 0.25, 0.18))
    kit.paint("cloud", (0.90, 0.90, 0.92), (0.16, 0.17, 0.19))
    kit.build("hills", mountains(140, 50, skyline(3, 6, 34), GROUND - 0.2, 72), "hills")
    kit.make("cloud", cloud(3), "cloud")
    for x, y, z, turn, size in ((-66, 62, -190, 0.3, 1.0), (120, 88, -170, 2.6, 1.2), (-170, 70, -20, 1.7, 1.3), (160, 80, 60, 1.4, 1.2), (0, 80, 200, 0.2, 1.3)):
        kit.put("cloud", (x, y, z), turn, size)


def main():
    glb = Glb("chart")
    add_chart(glb)
    add_lamps(glb)
    kit = Kit(glb)
    add_wall(kit)
    add_terrace(kit)
    add_sculptures(kit)
    add_garden(kit)
    glb.write(sys.argv[1] if len(sys.argv) > 1 else HERE / "chart.glb")


if __name__ == "__main__":
    main()
