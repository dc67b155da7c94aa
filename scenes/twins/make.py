#!/usr/bin/env python3
"""Writes twins.glb: two ships that are alike, each with a clock that is read from ahead and astern, a landing stage, and a ring for
each light-second of the way out. Needs Python 3's own library only; the same bytes come out every time."""
import random
import sys
from math import cos, pi, sin, sqrt
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
from dials import Dials
from glb import Glb
from textures import png

APART, WAY = 1.3, 8  # each ship from the middle; how far out one of them flies
BEFORE = 1000  # seconds of its worldline before it leaves: its clock begins with that
RINGS = -0.35  # their middles' height
DIAL, HULL = 0.62, -0.98  # the dial's radius; the hull's axis below the dial's middle, which is the ship's origin


def along_z(shape):
    """What stands upright, lying with its top ahead, along -z."""
    lying = shapes.Shape()
    lying.add(shape, (0, HULL, 0), shapes.quaternion((1, 0, 0), -pi / 2))
    return lying


def add_ship(glb, name, place, paint, dials, pale, dark):
    """All of it is ahead of the dial: nothing is seen twice where its worldline bends at home."""
    ship = glb.group(name)
    radius = lambda t: 0.36 * sqrt(max(1 - max(0, (t - 0.35) / 0.65) ** 2.2, 0.0)) * (0.82 + 0.18 * min(1, t / 0.35))
    put = lambda part, shape, material: glb.put(part, shape, material, place, below=ship)
    put("hull", along_z(shapes.revolved(40, 36, lambda t: (radius(t) + 1e-4, 1.5 * t), 1)), pale)
    for low, high in ((0.36, 0.50), (0.80, 0.84)):
        band = lambda t: (radius(low + (high - low) * t) + 0.015, 1.5 * (low + (high - low) * t))
        put("band", along_z(shapes.revolved(40, 4, band, 1)), paint)
    nozzle = shapes.revolved(32, 4, lambda t: (0.20 + 0.06 * (1 - t) ** 2, 0.10 * t), 1)
    put("nozzle", along_z(nozzle), dark)
    put("stern", along_z(shapes.fan([(0.296 * sin(-2 * pi * k / 40), 0.002, 0.296 * cos(-2 * pi * k / 40)) for k in range(40)])), dark)
    fins = shapes.Shape()
    for k in (-1, 1):
        fin = shapes.extruded([(0.25, 0.02), (0.78, 0.02), (0.78, 0.22), (0.25, 0.75)], -0.025, 0.025)
        fins.add(fin, turn=shapes.quaternion((0, 1, 0), pi / 2 + k * 1.0))
    put("fins", along_z(fins), paint)
    put("mast", shapes.box((0.035, 0.14, 0.10), (0, HULL + 0.32 + 0.1, -0.09)), dark)
    dials.put("clock", place, below=ship, both=True)


def add_stage(glb, dark):
    """Where the ships lie: a deck with a lit rim, and a cradle for each."""
    deck = shapes.revolved(72, 6, lambda t: (2.7 + 0.12 * sin(pi * t), HULL - 0.78 + 0.14 * t), 1)
    for y, way in ((HULL - 0.64, 1), (HULL - 0.78, -1)):
        deck.add(shapes.fan([(2.7 * sin(way * 2 * pi * k / 72), y, 2.7 * cos(way * 2 * pi * k / 72)) for k in range(72)]))
    glb.put("deck", deck, glb.material("deck", (0.20, 0.22, 0.26)))
    rim = shapes.Shape()
    rim.add(shapes.torus(96, 8, 2.84, 0.025), (0, HULL - 0.71, 0), shapes.quaternion((1, 0, 0), pi / 2))
    glb.put("rim light", rim, glb.material("rim light", (0, 0, 0), emissive=(0.25, 0.75, 1.0)))
    cradle = glb.mesh("cradle", glb.geometry(shapes.box((0.30, 0.14, 0.10), (0, HULL - 0.50, -0.6))), dark)
    marks = glb.mesh("berth", glb.geometry(shapes.level(-0.5, 0.3, 0.5, -1.6, HULL - 0.635)),
                     glb.material("berth", (0.10, 0.11, 0.13)))
    for x in (-APART, APART):
        glb.node("cradle", cradle, (x, 0, 0))
        glb.node("berth", marks, (x, 0, 0))


def add_way(glb):
    """A ring around the way for each light-second, and a golden one where the ship turns."""
    ring = glb.geometry(shapes.torus(72, 10, 1.2, 0.025))
    paints = [glb.mesh(f"{name} ring", ring, glb.material(f"{name} ring", colour, emissive=glow)) for name, colour, glow in (
        ("white", (0.65, 0.67, 0.70), (0.10, 0.11, 0.12)), ("blue", (0.10, 0.28, 0.62), (0.02, 0.06, 0.14)))]
    for k in range(1, WAY):
        glb.node("ring", paints[k % 2], (APART, RINGS, -k))
    gold = glb.material("gold", (0.80, 0.52, 0.10), emissive=(0.40, 0.24, 0.03))
    glb.put("golden ring", shapes.torus(96, 14, 1.3, 0.08), gold, (APART, RINGS, -WAY))


def cloud_bands(size=256):
    """A giant's, from pole to pole."""
    rng = random.Random(5)
    tones = [tuple(tone * c ** (1.5 - tone) for c in (0.93, 0.80, 0.66)) for tone in (rng.uniform(0.55, 1.0) for _ in range(22))]
    rows = []
    for j in range(size):
        at = (j + 0.5) / size * (len(tones) - 1.01)
        part = at - int(at)
        part = part * part * (3 - 2 * part)
        rows.append(bytes(round(255 * (a + (b - a) * part)) for a, b in zip(tones[int(at)], tones[int(at) + 1])) * 4)
    return png(4, size, rows)


def add_giant(glb):
    """Far behind the way: something that stands still."""
    paint = glb.material("giant", texture=glb.texture(cloud_bands()))
    mesh = glb.mesh("giant", glb.geometry(shapes.sphere(96, 48, 26)), paint)
    glb.node("giant", mesh, (-46, 17, -100), shapes.quaternion((0, 0, 1), 0.35))


def main():
    glb = Glb("twins")
    pale, dark = glb.material("enamel", (0.72, 0.73, 0.74)), glb.material("dark metal", (0.05, 0.055, 0.065))
    # Their marks shine, for the Sun hardly reaches what flies from it at such a speed.
    home, away = (Dials(glb, DIAL, zero_s, face=(0.02, 0.028, 0.045), marks=(0.95, 0.88, 0.66), name=name)
                  for zero_s, name in ((0, "home dial"), (BEFORE, "traveller's dial")))
    add_ship(glb, "stays", (-APART, 0, 0), glb.material("teal", (0.03, 0.36, 0.40)), home, pale, dark)
    add_ship(glb, "travels", (0, 0, 0), glb.material("orange", (0.80, 0.26, 0.03)), away, pale, dark)
    add_stage(glb, dark)
    add_way(glb)
    add_giant(glb)
    glb.write(sys.argv[1] if len(sys.argv) > 1 else HERE / "twins.glb")


if __name__ == "__main__":
    main()
