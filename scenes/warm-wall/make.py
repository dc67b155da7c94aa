#!/usr/bin/env python3
"""Writes warm-wall.glb: a court without any light, open to the sky. Its wall has the temperature of a cool room, 288 K, the other
walls, the trees and the ground are cooler, and five figures and a dog are as warm as people. What stands out on the wall does so by
its emissivity alone: bare metal gives off little, paint nearly all. One unit is one light-second; the wall stands at z = -14. Needs
Python 3's own library only; the same bytes come out every time."""
import sys
from math import cos, pi, sin
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
from glb import Glb
from land import around, crown, mountains, pavement, quad, skyline

WALL_K, COURT_K, PEOPLE_K = 288, 282, 305
GROUND, TOP, HALF, BACK, FRONT = -3, 11, 14, -14, 14
TILE = 2
CENTRE = 3.5  # the disc's on the wall, and the height of the eye in the shots
LETTERS = {"1": "00100 01100 00100 00100 00100 00100 01110", "2": "01110 10001 00001 00110 01000 10000 11111",
           "5": "11111 10000 11110 00001 00001 10001 01110", "8": "01110 10001 10001 01110 10001 10001 01110",
           "K": "10001 10010 10100 11000 10100 10010 10001", "C": "01110 10001 10000 10000 10000 10001 01110",
           "=": "00000 00000 11111 00000 11111 00000 00000", "°": "01100 10010 10010 01100 00000 00000 00000"}


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


def capsule(half, low, high, bulb, z):
    """A thermometer's outline around x = 0: a tube with a round top, and a bulb at its foot; heights from the middle of the disc."""
    top = [(half * cos(pi * k / 16), CENTRE + high + half * sin(pi * k / 16), z) for k in range(17)]
    ball = [(bulb * cos(2 * pi * k / 40), CENTRE + low + bulb * sin(2 * pi * k / 40), z) for k in range(40)]
    return union([shapes.fan([(-half, CENTRE + low, z), (half, CENTRE + low, z), *top]), shapes.fan(ball)])


def marks(z):
    """The scale to the right of the thermometer: a mark for each ten degrees, longer where a temperature is round."""
    bars = [shapes.upright(1.15, CENTRE + y - 0.11, 2.5 if k % 2 else 1.9, CENTRE + y + 0.11, z)
            for k, y in enumerate(-1.6 + 0.95 * k for k in range(6))]
    return union(bars)


def writing(text, left, bottom, pixel, z):
    for letter in text:
        for row, bits in enumerate(LETTERS.get(letter, "").split()):
            for column, bit in enumerate(bits):
                if bit == "1":
                    x, y = left + pixel * column, bottom + pixel * (6 - row)
                    yield shapes.upright(x, y, x + pixel, y + pixel, z)
        left += pixel * (6 if letter in LETTERS else 3)


def person(arm_deg, stride):
    """A figure 3.4 high that stands on the ground and looks along +z. arm_deg: how far its left arm is raised; stride: of its feet."""
    limb = lambda a, b, r: union([shapes.bar(9, a, b, r), moved(shapes.sphere(9, 5, r), a), moved(shapes.sphere(9, 5, r), b)])
    swing = pi * arm_deg / 180
    hand = (0.48 + 0.95 * sin(swing), 2.62 - 1.05 * cos(swing), 0.10)
    parts = [shapes.revolved(20, 8, lambda t: (0.30 + 0.14 * sin(0.35 + 2.6 * t) - 0.10 * t, 1.55 + 1.22 * t), 1),
             moved(shapes.sphere(18, 10, 0.31), (0, 3.11, 0.02)), shapes.bar(10, (0, 2.70, 0), (0, 2.95, 0), 0.13)]
    parts += [limb((0.20, 1.55, 0), (0.24, 0.14, stride), 0.17), limb((-0.20, 1.55, 0), (-0.24, 0.14, -stride), 0.17)]
    parts += [limb((0.44, 2.62, 0), hand, 0.12), limb((-0.44, 2.62, 0), (-0.60, 1.60, 0.12), 0.12)]
    parts += [shapes.box((0.15, 0.10, 0.30), (x, 0.10, z + 0.12)) for x, z in ((0.24, stride), (-0.24, -stride))]
    parts += [moved(shapes.sphere(12, 6, 0.40), (0, 2.62, 0), (1.15, 0.42, 0.62))]
    return union(parts)


def moved(shape, to, size=(1, 1, 1)):
    """The shape, scaled about its origin and then moved."""
    shape.positions = [tuple(t + s * p for t, s, p in zip(to, size, position)) for position in shape.positions]
    shape.normals = [shapes.unit(tuple(n / s for n, s in zip(normal, size))) for normal in shape.normals]
    return shape


def dog():
    """A dog 1.1 high that looks along +z."""
    body = moved(shapes.sphere(14, 7, 0.4), (0, 0.78, 0), (0.72, 0.72, 1.5))
    head = moved(shapes.sphere(12, 6, 0.24), (0, 1.16, 0.66))
    muzzle = shapes.bar(8, (0, 1.10, 0.70), (0, 1.06, 1.04), 0.11)
    legs = [shapes.bar(7, (x, 0, z), (x, 0.7, z), 0.085) for x in (-0.17, 0.17) for z in (-0.4, 0.42)]
    ears = [shapes.bar(6, (x, 1.28, 0.62), (x * 1.3, 1.50, 0.56), 0.06) for x in (-0.14, 0.14)]
    return union([body, head, muzzle, shapes.bar(6, (0, 0.86, -0.55), (0, 1.30, -0.86), 0.06), *legs, *ears])


def add_wall(glb):
    paint = warm(glb, "matt paint", WALL_K, 0.95)
    worn = warm(glb, "worn paint", WALL_K, 0.55)
    metal = warm(glb, "bare metal", WALL_K, 0.1)
    fields = pavement_upright()
    put(glb, "painted fields", fields[0], paint)
    put(glb, "worn fields", fields[1], worn)
    put(glb, "disc", shapes.fan(ring(5.4, 72, BACK + 0.06)), metal)
    put(glb, "thermometer", capsule(0.78, -3.0, 3.7, 1.45, BACK + 0.12), paint)
    put(glb, "empty tube", shapes.upright(-0.36, CENTRE + 0.77, 0.36, CENTRE + 3.8, BACK + 0.18), metal)
    put(glb, "marks", marks(BACK + 0.12), paint)
    put(glb, "plate", shapes.upright(-6.9, 9.1, 6.9, 10.9, BACK + 0.06), metal)
    put(glb, "writing", union(writing("288 K = 15 °C", -6.5, 9.3, 0.2, BACK + 0.12)), paint)
    put(glb, "wall", shapes.box((HALF, (TOP - GROUND) / 2, 0.5), (0, (TOP + GROUND) / 2, BACK - 0.6)), paint)
    put(glb, "coping", shapes.box((HALF + 0.2, 0.22, 0.75), (0, TOP + 0.2, BACK - 0.45)), worn)


def pavement_upright():
    """The wall's fields in two sorts, as a chessboard's."""
    fields = (shapes.Shape(), shapes.Shape())
    for i in range(-HALF // TILE, HALF // TILE):
        for j in range((TOP - GROUND) // TILE):
            x, y = TILE * i, GROUND + TILE * j
            fields[(i + j) % 2].add(quad((x, y, BACK), (x + TILE, y, BACK), (x + TILE, y + TILE, BACK), (x, y + TILE, BACK)))
    return fields


def put(glb, name, shape, material):
    """A shape without texture coordinates that stands in one place."""
    glb.node(name, glb.mesh(name, glb.geometry(shape, uvs=False), material))


def add_court(glb):
    """Slabs, side walls with pilasters and a cornice, trees in tubs before them, and hills around."""
    plaster = warm(glb, "plaster", COURT_K, 0.9)
    slab = warm(glb, "slabs", COURT_K, 0.6)
    band = warm(glb, "bands", COURT_K, 0.3)
    leaves = warm(glb, "leaves", COURT_K, 0.97)
    light, dark = pavement(-HALF, BACK, 2 * HALF // TILE, (FRONT - BACK) // TILE, TILE, GROUND)
    put(glb, "light slabs", light, plaster)
    put(glb, "dark slabs", dark, slab)
    put(glb, "land", around(-HALF, FRONT, HALF, BACK, 150, GROUND), slab)
    put(glb, "hills", mountains(110, 40, skyline(2, 6, 36), GROUND, 72), leaves)
    height = 8
    mesh = lambda name, shape, material: glb.mesh(name, glb.geometry(shape, uvs=False), material)
    sides = mesh("side wall", shapes.box((0.5, height / 2, (FRONT - BACK) / 2), (0, GROUND + height / 2, (FRONT + BACK) / 2)), plaster)
    cornice = mesh("cornice", shapes.box((0.8, 0.2, (FRONT - BACK) / 2), (0, GROUND + height + 0.2, 0)), band)
    pilaster = mesh("pilaster", shapes.box((0.25, height / 2, 0.5), (0, GROUND + height / 2, 0)), band)
    tub = shapes.revolved(18, 1, lambda t: (0.62 + 0.14 * t, GROUND + 0.9 * t), 1)
    tub.add(shapes.fan([(0.74 * sin(2 * pi * k / 18), GROUND + 0.86, 0.74 * cos(2 * pi * k / 18)) for k in range(18)]))
    green = crown([(1.2, (0, 0.9, 0)), (0.9, (0.5, 1.7, 0.2)), (0.8, (-0.5, 1.8, -0.1))], 4)
    green.add(shapes.bar(7, (0, GROUND + 0.8, 0), (0, 0.4, 0), 0.14))
    tree, tubs = mesh("tree", green, leaves), mesh("tub", tub, band)
    for way in (-1, 1):
        glb.node("side wall", sides, (way * (HALF + 0.5), 0, 0))
        glb.node("cornice", cornice, (way * (HALF + 0.5), 0, 0))
        for z in range(BACK + 3, FRONT, 4):
            glb.node("pilaster", pilaster, (way * (HALF - 0.25), 0, z))
        for z in range(BACK + 5, FRONT, 4):
            for part in (tubs, tree):
                glb.node("tree", part, (way * (HALF - 1.6), 0, z), shapes.quaternion((0, 1, 0), z))


def add_people(glb):
    skin = warm(glb, "people", PEOPLE_K, 0.97)
    mesh = lambda name, shape: glb.mesh(name, glb.geometry(shape, uvs=False), skin)
    waves, walks, animal = mesh("who waves", person(150, 0.05)), mesh("who walks", person(12, 0.34)), mesh("dog", dog())
    for who, x, z, turn, size in ((walks, -6.6, -10.5, 0.5, 1.0), (waves, -5.0, -10.9, 0.2, 0.66), (waves, 5.6, -9.4, -0.2, 1.04),
                                  (walks, 7.3, -10.2, -0.6, 0.97), (walks, -9.0, -5.5, 1.1, 1.0), (animal, 3.6, -8.6, -0.9, 1.1)):
        glb.node("person", who, (x, GROUND, z), shapes.quaternion((0, 1, 0), turn), (size, size, size))


def main():
    glb = Glb("warm-wall")
    add_wall(glb)
    add_court(glb)
    add_people(glb)
    glb.write(sys.argv[1] if len(sys.argv) > 1 else HERE / "warm-wall.glb")


if __name__ == "__main__":
    main()
