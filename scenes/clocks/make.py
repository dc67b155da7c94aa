#!/usr/bin/env python3
"""Writes clocks.glb: five great clocks in a row, five light-seconds apart, over a ruler of light-seconds, on a terrace among
mountains before sunrise. Needs Python 3's own library only; the same bytes come out every time."""
import sys
from math import cos, pi, sin
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
from glb import Glb
from land import Kit, around, mountains, skyline, slab

APART, CLOCKS = 5, 5
RADIUS = 1.9  # no hand's tip outruns light: 0.82 of this in a minute is 0.16 c, 0.19 of it in ten seconds 0.23 c
GROUND = -4.5
FLIGHT = 31  # distance of the flight past them
TILE, WIDE, NEAR, FAR = 5, 60, 60, -30  # the terrace's tiles, its half width, and its edges before and behind


def case():
    """Behind the dial: a drum along z, closed at its back."""
    profile = [(RADIUS + 0.16, -0.05), (RADIUS + 0.16, -0.45), (RADIUS - 0.15, -0.75)]
    shape, sides = shapes.Shape(), 96
    for (r0, z0), (r1, z1) in zip(profile, profile[1:]):
        def side(u, v):
            r = r0 + (r1 - r0) * v
            return (r * cos(2 * pi * u), r * sin(2 * pi * u), z0 + (z1 - z0) * v), (u, v)
        # From the front backwards and counter-clockwise: seen from outside u runs to the left, so turn it.
        shape.add(shapes.grid(sides, 1, shapes.smooth(lambda u, v: side(-u, v))))
    r, z = profile[-1]
    shape.add(shapes.fan([(r * cos(-2 * pi * i / 48), r * sin(-2 * pi * i / 48), z) for i in range(48)]))
    return shape


def pillar():
    """From the ground up to a clock's case, with a foot and a collar."""
    top = -(RADIUS + 0.1)
    height = top - GROUND
    shape = shapes.revolved(32, 8, lambda t: (0.34 - 0.12 * t + 0.02 * sin(pi * t), GROUND + height * t), 1)
    shape.add(shapes.moulding(32, 0.24, top - 0.12, 0.07, 1))
    shape.add(shapes.box((0.62, 0.12, 0.62), (0, GROUND + 0.12, 0)))
    shape.add(shapes.box((0.48, 0.08, 0.48), (0, GROUND + 0.32, 0)))
    return shape


def obelisk():
    shape = shapes.Shape()
    for k in range(4):
        rim = [(r * sin(pi / 2 * (k + s)), y, r * cos(pi / 2 * (k + s)))
               for r, y, s in ((0.9, GROUND, -0.5), (0.9, GROUND, 0.5), (0.5, 5.5, 0.5), (0.5, 5.5, -0.5))]
        shape.add(shapes.fan(rim))
        shape.add(shapes.fan([rim[3], rim[2], (0, 6.5, 0)]))
    return shape


def add_clocks(glb):
    ivory = glb.material("dial", (0.86, 0.83, 0.74), starbow={"clock": {"zero_s": 0}})
    brass = glb.material("brass", (0.62, 0.42, 0.14))
    bronze = glb.material("bronze", (0.16, 0.10, 0.055))
    stone = glb.material("stone", (0.46, 0.42, 0.37))
    parts = [glb.mesh(name, glb.geometry(shape, uvs=name == "dial"), material) for name, shape, material in (
        ("dial", shapes.dial(RADIUS), ivory), ("rim", shapes.torus(80, 10, RADIUS + 0.09, 0.11), brass), ("case", case(), bronze),
        ("pillar", pillar(), stone))]
    for i in range(CLOCKS):
        x = APART * (i - (CLOCKS - 1) / 2)
        for mesh in parts:
            glb.node(f"{glb.doc['meshes'][mesh]['name']} {i + 1}", mesh, (x, 0, -0.35 if mesh == parts[3] else 0))


def add_ruler(glb):
    """Before the pillars' feet; a field for each light-second."""
    field = shapes.box((0.5, 0.14, 0.5))
    geometry = glb.geometry(field, uvs=False)
    for name, colour, first in (("white", (0.75, 0.75, 0.72), -12), ("red", (0.55, 0.07, 0.05), -11)):
        mesh = glb.mesh(f"{name} field", geometry, glb.material(name, colour))
        for x in range(first, 13, 2):
            glb.node(f"{name} field", mesh, (x, GROUND + 0.14, 1.5))


def add_terrace(kit):
    """Tiles of 5 light-seconds in rows that share one mesh, each turned by half a turn from the one before."""
    kit.paint("light stones", (0.250, 0.225, 0.195))
    kit.paint("dark stones", (0.120, 0.112, 0.115))
    stones = (shapes.Shape(), shapes.Shape())
    for i in range(2 * WIDE // TILE):
        x = TILE * i - WIDE
        stones[i % 2].add(slab(x, TILE / 2, x + TILE, -TILE / 2, 0))
    kit.make("row", stones[0], "light stones", stones[1], "dark stones")
    for j in range((NEAR - FAR) // TILE):
        kit.put("row", (0, GROUND, FAR + TILE * (j + 0.5)), pi if j % 2 else 0)


def balusters():
    """Five light-seconds of a balustrade along x, from pier to pier."""
    shape = shapes.Shape()
    shape.add(shapes.box((2.5, 0.10, 0.20), (0, 0.10, 0)))
    shape.add(shapes.box((2.5, 0.09, 0.22), (0, 1.26, 0)))
    shape.add(shapes.box((0.30, 0.75, 0.30), (-2.5, 0.75, 0)))
    shape.add(shapes.box((0.38, 0.06, 0.38), (-2.5, 1.53, 0)))
    for k in range(5):
        x = 0.8 * (k - 2)
        shape.add(shapes.bar(6, (x, 0.2, 0), (x, 1.17, 0), 0.12))
    return shape


def add_balustrade(kit):
    """Around the terrace, with a lantern on every second pier."""
    kit.paint("balustrade", (0.48, 0.45, 0.42))
    kit.paint("lantern", (0.3, 0.25, 0.2), (1.30, 0.78, 0.32))
    kit.make("balusters", balusters(), "balustrade")
    lantern = shapes.Shape()
    lantern.add(shapes.sphere(12, 6, 0.34), (0, 1.9, 0))
    kit.make("lantern", lantern, "lantern")
    deep, middle = (NEAR - FAR) / 2, (NEAR + FAR) / 2
    for way, half, out in ((0, WIDE, deep), (1, deep, WIDE), (2, WIDE, deep), (3, deep, WIDE)):
        turn = way * pi / 2
        for k in range(int(2 * half) // 5):
            along = 2.5 + 5 * k - half
            place = shapes.turned(shapes.quaternion((0, 1, 0), turn), (along, GROUND, -out))
            pier = shapes.turned(shapes.quaternion((0, 1, 0), turn), (along - 2.5, GROUND, -out))
            kit.put("balusters", (place[0], place[1], place[2] + middle), turn)
            if k % 2 == 0:
                kit.put("lantern", (pier[0], pier[1], pier[2] + middle))


def column():
    """A round column 11 high on a plinth, with a slab above."""
    shape = shapes.revolved(18, 6, lambda t: (0.62 - 0.12 * t + 0.03 * sin(pi * t), 0.5 + 9.9 * t), 1)
    shape.add(shapes.moulding(18, 0.62, 0.55, 0.12, 1))
    shape.add(shapes.moulding(18, 0.50, 10.25, 0.10, 1))
    shape.add(shapes.box((0.85, 0.25, 0.85), (0, 0.25, 0)))
    shape.add(shapes.box((0.78, 0.30, 0.78), (0, 10.7, 0)))
    return shape


def add_colonnades(kit):
    """Two crescents, to the left and to the right of the row: the view between them is open."""
    kit.paint("marble", (0.56, 0.50, 0.45))
    kit.make("column", column(), "marble")
    step, radius = 6.5, 47  # degrees; around the middle of the world
    beam = shapes.box((radius * sin(step * pi / 360) + 0.5, 0.55, 0.75), (0, 11.55, 0))
    beam.add(shapes.box((radius * sin(step * pi / 360) + 0.56, 0.16, 0.98), (0, 12.2, 0)))
    kit.make("beam", beam, "marble")
    at = lambda degrees: (radius * sin(degrees * pi / 180), GROUND, 15 - radius * cos(degrees * pi / 180))
    for side in (-1, 1):
        for k in range(9):
            degrees = side * (32 + step * k)
            kit.put("column", at(degrees), -degrees * pi / 180)
            if k < 8:
                a, b = at(degrees), at(degrees + side * step)
                kit.put("beam", tuple((p + q) / 2 for p, q in zip(a, b)), -(degrees + side * step / 2) * pi / 180)


def add_mountains(kit):
    """A plain around the terrace, wooded hills, and snowy mountains behind them."""
    kit.paint("plain", (0.055, 0.066, 0.055))
    kit.build("plain", around(-WIDE, NEAR, WIDE, FAR, 430, GROUND - 0.02), "plain")
    kit.paint("foothills", (0.060, 0.085, 0.085))
    kit.paint("rock", (0.15, 0.145, 0.175))
    kit.paint("snow", (0.62, 0.62, 0.66))
    kit.build("foothills", mountains(190, 50, skyline(5, 6, 24), GROUND, 120), "foothills")
    far = skyline(9, 30, 132)
    kit.build("rock", mountains(300, 90, far, GROUND, 144, (0.0, 0.3, 0.62)), "rock")
    kit.build("snow", mountains(300, 90, far, GROUND, 144, (0.62, 0.8, 1.0)), "snow")


def add_landmarks(kit):
    kit.paint("pale stone", (0.40, 0.44, 0.52))
    kit.paint("copper", (0.55, 0.25, 0.13))
    kit.make("obelisk", obelisk(), "pale stone")
    for k in range(-6, 6):
        kit.put("obelisk", (7.74 * (k + 0.5), 0, -17))  # between the clocks, as seen from before the middle one
    hoop = shapes.Shape()
    hoop.add(shapes.torus(64, 6, 3.0, 0.07), turn=shapes.quaternion((0, 1, 0), pi / 2))
    hoop.add(shapes.bar(10, (0, GROUND, 0), (0, -3.0, 0), 0.10))
    hoop.add(shapes.box((0.5, 0.15, 0.5), (0, GROUND + 0.15, 0)))
    kit.make("hoop", hoop, "copper")
    for x in range(-50, 60, 20):  # none before the clocks where the shots are taken
        kit.put("hoop", (x, 0, FLIGHT))


def main():
    glb = Glb("clocks")
    add_clocks(glb)
    add_ruler(glb)
    kit = Kit(glb)
    add_terrace(kit)
    add_balustrade(kit)
    add_colonnades(kit)
    add_mountains(kit)
    add_landmarks(kit)
    glb.write(sys.argv[1] if len(sys.argv) > 1 else HERE / "clocks.glb")


if __name__ == "__main__":
    main()
