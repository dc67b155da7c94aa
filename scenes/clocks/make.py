#!/usr/bin/env python3
"""Writes clocks.glb: five great clocks in a row, five light-seconds apart, over a ruler of light-seconds. Needs Python 3's own
library only; the same bytes come out every time."""
import sys
from math import cos, pi, sin
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
from glb import Glb

APART, CLOCKS = 5, 5
RADIUS = 1.9  # no hand's tip outruns light: 0.82 of this in a minute is 0.16 c, 0.19 of it in ten seconds 0.23 c
GROUND = -4.5
FLIGHT = 31  # distance of the flight past them


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
    parts = [glb.mesh(name, glb.geometry(shape), material) for name, shape, material in (
        ("dial", shapes.dial(RADIUS), ivory), ("rim", shapes.torus(80, 12, RADIUS + 0.09, 0.11), brass), ("case", case(), bronze),
        ("pillar", pillar(), stone))]
    for i in range(CLOCKS):
        x = APART * (i - (CLOCKS - 1) / 2)
        for mesh in parts:
            glb.node(f"{glb.doc['meshes'][mesh]['name']} {i + 1}", mesh, (x, 0, -0.35 if mesh == parts[3] else 0))


def add_ruler(glb):
    """Before the pillars' feet; a field for each light-second."""
    field = shapes.box((0.5, 0.14, 0.5))
    geometry = glb.geometry(field)
    for name, colour, first in (("white", (0.75, 0.75, 0.72), -12), ("red", (0.55, 0.07, 0.05), -11)):
        mesh = glb.mesh(f"{name} field", geometry, glb.material(name, colour))
        for x in range(first, 13, 2):
            glb.node(f"{name} field", mesh, (x, GROUND + 0.14, 1.5))


def add_ground(glb):
    stones = (shapes.Shape(), shapes.Shape())
    side = 5
    for i in range(-10, 10):
        for j in range(-5, 11):
            stones[(i + j) % 2].add(shapes.level(side * i, side * (j + 1), side * (i + 1), side * j, GROUND))
    for name, shape, grey in (("light stones", stones[0], 0.075), ("dark stones", stones[1], 0.04)):
        glb.node(name, glb.mesh(name, glb.geometry(shape), glb.material(name, (0.9 * grey, 0.95 * grey, 1.1 * grey))))


def add_landmarks(glb):
    pale = glb.mesh("obelisk", glb.geometry(obelisk()), glb.material("pale stone", (0.40, 0.44, 0.52)))
    for k in range(-6, 6):
        glb.node("obelisk", pale, (7.74 * (k + 0.5), 0, -17))  # between the clocks, as seen from before the middle one
    hoop = glb.mesh("hoop", glb.geometry(shapes.torus(64, 8, 3.0, 0.07)), glb.material("copper", (0.55, 0.25, 0.13)))
    quarter = shapes.quaternion((0, 1, 0), pi / 2)
    for x in range(-50, 60, 20):  # none before the clocks where the shots are taken
        glb.node("hoop", hoop, (x, 0, FLIGHT), quarter)


def main():
    glb = Glb("clocks")
    add_clocks(glb)
    add_ruler(glb)
    add_ground(glb)
    add_landmarks(glb)
    glb.write(sys.argv[1] if len(sys.argv) > 1 else HERE / "clocks.glb")


if __name__ == "__main__":
    main()
