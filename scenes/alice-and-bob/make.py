#!/usr/bin/env python3
"""Writes alice-and-bob.glb: Alice's row of clocks, which rests, and Bob's barge with as many, modelled at rest around its middle.
Needs Python 3's own library only; the same bytes come out every time."""
import sys
from math import cos, pi, sin
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
from dials import Dials
from glb import Glb

APART, CLOCKS, RADIUS = 4, 5, 1.35
GROUND = -3.0
BARGE = 4.6  # height of the dials on it
PLACES = [APART * (k - (CLOCKS - 1) / 2) for k in range(CLOCKS)]
# What tells the places of a row apart, in both rows alike.
COLOURS = (("red", (0.62, 0.06, 0.05)), ("yellow", (0.75, 0.50, 0.05)), ("green", (0.08, 0.42, 0.12)),
           ("blue", (0.06, 0.18, 0.60)), ("violet", (0.34, 0.10, 0.46)))


def pillar(top):
    height = top - GROUND
    shape = shapes.revolved(32, 8, lambda t: (0.40 - 0.14 * t + 0.02 * sin(pi * t), GROUND + height * t), 1)
    shape.add(shapes.box((0.75, 0.12, 0.75), (0, GROUND + 0.12, 0)))
    shape.add(shapes.box((0.56, 0.10, 0.56), (0, GROUND + 0.34, 0)))
    return shape


def add_alice(glb, paints):
    dials = Dials(glb, RADIUS, face=(0.88, 0.86, 0.80), rim=(0.06, 0.36, 0.40), name="Alice's dial")
    foot = glb.geometry(pillar(-RADIUS))
    collar = glb.geometry(shapes.torus(40, 10, 0.36, 0.12))
    stone = glb.mesh("pillar", foot, glb.material("limestone", (0.62, 0.56, 0.47)))
    for x, paint in zip(PLACES, paints):
        dials.put("Alice's clock", (x, 0, 0), both=True)
        glb.node("pillar", stone, (x, 0, 0))
        mesh = glb.mesh("collar", collar, paint)
        glb.node("collar", mesh, (x, -RADIUS - 0.35, 0), shapes.quaternion((1, 0, 0), pi / 2))


def hull(half_length):
    """A barge along x with pointed ends, its deck at y = 0."""
    def at(u, v):
        x = -half_length + 2 * half_length * v
        point = max(0.0, (abs(x) - half_length + 1.6) / 1.6)
        wide, deep = 0.85 * (1 - point ** 2), 0.75 * (1 - 0.8 * point ** 2)
        angle = pi * (u - 0.5)
        return (x, -deep * cos(angle) ** 0.6 if abs(angle) < pi / 2 else 0.0, -wide * sin(angle)), (u, v)
    shape = shapes.grid(24, 60, shapes.smooth(lambda u, v: at(0.001 + 0.998 * u, 0.0005 + 0.999 * v)))
    rim = [at(s, k / 60)[0] for s, ks in ((0.999, range(61)), (0.001, range(60, -1, -1))) for k in ks]
    port, starboard = rim[:61], rim[61:][::-1]
    for i in range(60):
        a, b, c, d = port[i], starboard[i], starboard[i + 1], port[i + 1]
        if abs(a[2] - b[2]) + abs(c[2] - d[2]) > 1e-3:
            shape.add(shapes.fan([(p[0], 0.0, p[2]) for p in (b, c, d, a)]))
    return shape


def add_bob(glb, paints):
    barge = glb.group("barge")
    dials = Dials(glb, RADIUS, face=(0.88, 0.86, 0.80), rim=(0.78, 0.30, 0.03), name="Bob's dial")
    deck = BARGE - RADIUS - 0.5
    half = APART * (CLOCKS - 1) / 2 + 3.0
    glb.put("hull", hull(half), glb.material("barge", (0.66, 0.22, 0.03)), (0, deck, 0), below=barge)
    rail = shapes.Shape()
    rail.add(shapes.box((half - 1.9, 0.04, 0.03), (0, 0.04, 0.86)))
    rail.add(shapes.box((half - 1.9, 0.04, 0.03), (0, 0.04, -0.86)))
    glb.put("rail", rail, glb.material("cream", (0.82, 0.76, 0.60)), (0, deck, 0), below=barge)
    post = glb.geometry(shapes.bar(20, (0, 0, 0), (0, 0.5, 0), 0.22))
    for x, paint in zip(PLACES, paints):
        dials.put("Bob's clock", (x, BARGE, 0), below=barge, both=True)
        glb.node("post", glb.mesh("post", post, paint), (x, deck, 0), below=barge)


def add_land(glb, paints):
    sand = (shapes.Shape(), shapes.Shape())
    side = 4
    for i in range(-22, 22):
        for j in range(-14, 10):
            sand[(i + j) % 2].add(shapes.level(side * i, side * (j + 1), side * (i + 1), side * j, GROUND))
    for name, shape, colour in (("light sand", sand[0], (0.40, 0.32, 0.21)), ("dark sand", sand[1], (0.34, 0.27, 0.175))):
        glb.put(name, shape, glb.material(name, colour, starbow={"infrared": 0.5}))
    field = glb.geometry(shapes.box((0.5, 0.10, 0.30)))
    for name, colour, first in (("white", (0.78, 0.77, 0.73), -12), ("teal", (0.05, 0.30, 0.34), -11)):
        mesh = glb.mesh(f"{name} field", field, glb.material(f"{name} field", colour))
        for x in range(first, 13, 2):
            glb.node("field", mesh, (x, GROUND + 0.10, 2.2))
    # Far behind, markers in the colours of the places; a pyramid each.
    pyramid = shapes.Shape()
    for k in range(4):
        a, b = (shapes.turned(shapes.quaternion((0, 1, 0), pi / 2 * (k + s)), (0, GROUND, 2.4)) for s in (-0.5, 0.5))
        pyramid.add(shapes.fan([a, b, (0, GROUND + 4.2, 0)]))
    geometry = glb.geometry(pyramid)
    meshes = [glb.mesh("pyramid", geometry, paint) for paint in paints]
    for k in range(-4, 5):
        glb.node("pyramid", meshes[(k + 2) % CLOCKS], (9 * k, 0, -30 - 3 * (k % 2)))


def main():
    glb = Glb("alice-and-bob")
    paints = [glb.material(name, colour) for name, colour in COLOURS]
    add_alice(glb, paints)
    add_bob(glb, paints)
    add_land(glb, paints)
    glb.write(sys.argv[1] if len(sys.argv) > 1 else HERE / "alice-and-bob.glb")


if __name__ == "__main__":
    main()
