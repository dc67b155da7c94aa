#!/usr/bin/env python3
"""Writes warm-wall.glb: a court without any light, open to the sky. Its wall has the temperature of a room, 288 K, the other
walls and the ground are cooler, and five figures are as warm as people. What stands out does so by its emissivity alone: bare
metal gives off little, paint nearly all. One unit is one light-second; the wall stands at z = -14. Needs Python 3's own
library only; the same bytes come out every time."""
import sys
from math import cos, pi, sin
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
from glb import Glb

WALL_K, COURT_K, PEOPLE_K = 288, 282, 305
GROUND, TOP, HALF, BACK, FRONT = -3, 11, 14, -14, 14
TILE = 2
CENTRE = 3.5  # the star's, and the height of the eye in the shots
LETTERS = {"2": "01110 10001 00001 00110 01000 10000 11111", "8": "01110 10001 10001 01110 10001 10001 01110",
           "K": "10001 10010 10100 11000 10100 10010 10001"}


def warm(glb, name, kelvin, emissivity):
    # What gives off light takes it up as well (Kirchhoff), so a good emitter is dark.
    dark = round(0.5 * (1 - emissivity), 3)
    return glb.material(name, (dark, dark, dark), starbow={"temperature_K": kelvin, "emissivity": emissivity})


def union(parts):
    shape = shapes.Shape()
    for part in parts:
        shape.add(part)
    return shape


def ring(radius, count, z):
    return [(radius * cos(2 * pi * i / count), CENTRE + radius * sin(2 * pi * i / count), z) for i in range(count)]


def star(outer, inner, z):
    radii = (outer, inner)
    return shapes.fan([(radii[i % 2] * cos(pi / 2 + pi * i / 5), CENTRE + radii[i % 2] * sin(pi / 2 + pi * i / 5), z)
                       for i in range(10)])


def writing(text, left, bottom, pixel, z):
    for letter in text:
        for row, bits in enumerate(LETTERS.get(letter, "").split()):
            for column, bit in enumerate(bits):
                if bit == "1":
                    x, y = left + pixel * column, bottom + pixel * (6 - row)
                    yield shapes.upright(x, y, x + pixel, y + pixel, z)
        left += pixel * (6 if letter in LETTERS else 3)


def person():
    """A plain figure 3.4 high, standing on the ground."""
    def body(t):
        return 0.62 - 0.42 * t + 0.1 * sin(2 * pi * t), 2.5 * t
    shape = shapes.revolved(32, 12, body, 1)
    shape.add(shapes.revolved(32, 8, lambda t: (0.2 + 0.18 * sin(pi * t) - 0.02 * t, 2.5 + 0.16 * t), 1))
    head = shapes.sphere(32, 16, 0.44)
    head.positions = [(x, y + 2.98, z) for x, y, z in head.positions]
    shape.add(head)
    return shape


def add_wall(glb):
    paint = warm(glb, "matt paint", WALL_K, 0.95)
    worn = warm(glb, "worn paint", WALL_K, 0.55)
    metal = warm(glb, "bare metal", WALL_K, 0.1)
    fields = ([], [])
    for i in range(-HALF // TILE, HALF // TILE):
        for j in range((TOP - GROUND) // TILE):
            y = GROUND + TILE * j
            fields[(i + j) % 2].append(shapes.upright(TILE * i, y, TILE * (i + 1), y + TILE, BACK))
    glb.put("painted fields", union(fields[0]), paint)
    glb.put("worn fields", union(fields[1]), worn)
    glb.put("disc", shapes.fan(ring(5.4, 96, BACK + 0.06)), metal)
    glb.put("star", star(5.0, 1.91, BACK + 0.12), paint)
    glb.put("plate", shapes.upright(-3.2, 9.1, 3.2, 10.9, BACK + 0.06), metal)
    glb.put("writing", union(writing("288 K", -2.6, 9.3, 0.2, BACK + 0.12)), paint)
    back = shapes.box((HALF, (TOP - GROUND) / 2, 0.5), (0, (TOP + GROUND) / 2, BACK - 0.6))
    glb.put("wall", back, paint)


def add_court(glb):
    plaster = warm(glb, "plaster", COURT_K, 0.9)
    slab = warm(glb, "slabs", COURT_K, 0.6)
    band = warm(glb, "bands", COURT_K, 0.3)
    fields = ([], [])
    for i in range(-HALF // TILE, HALF // TILE):
        for j in range((FRONT - BACK) // TILE):
            z = FRONT - TILE * j
            fields[(i + j) % 2].append(shapes.level(TILE * i, z, TILE * (i + 1), z - TILE, GROUND))
    glb.put("light slabs", union(fields[0]), plaster)
    glb.put("dark slabs", union(fields[1]), slab)
    height = 8
    side = shapes.box((0.5, height / 2, (FRONT - BACK) / 2), (0, GROUND + height / 2, (FRONT + BACK) / 2))
    pilaster = shapes.box((0.25, height / 2, 0.5), (0, GROUND + height / 2, 0))
    sides, pilasters = glb.mesh("side wall", glb.geometry(side), plaster), glb.mesh("pilaster", glb.geometry(pilaster), band)
    for way in (-1, 1):
        glb.node("side wall", sides, (way * (HALF + 0.5), 0, 0))
        for z in range(BACK + 3, FRONT, 4):
            glb.node("pilaster", pilasters, (way * (HALF - 0.25), 0, z))


def add_people(glb):
    skin = warm(glb, "people", PEOPLE_K, 0.97)
    mesh = glb.mesh("person", glb.geometry(person()), skin)
    for x, z, size in ((-6.6, -10.5, 1.0), (-5.2, -10.9, 0.72), (5.6, -9.4, 1.04), (7.3, -10.2, 0.97), (-9.8, -5.5, 1.0)):
        # Turned so that the seam of its surface is behind it.
        glb.node("person", mesh, (x, GROUND, z), shapes.quaternion((0, 1, 0), pi), (size, size, size))


def main():
    glb = Glb("warm-wall")
    add_wall(glb)
    add_court(glb)
    add_people(glb)
    glb.write(sys.argv[1] if len(sys.argv) > 1 else HERE / "warm-wall.glb")


if __name__ == "__main__":
    main()
