#!/usr/bin/env python3
"""Writes avenue.glb, the world of the paper "Real Time Relativity". One unit is one light-second, +y is up, and the
visitor starts at the origin, looking along -z. Needs Python 3's own library only; the same bytes come out every time."""
import random
import sys
from math import cos, pi, radians, sin
from pathlib import Path

import shapes
import textures
from glb import Glb

HERE = Path(__file__).resolve().parent

STONE_SCALE = 0.75  # the stone texture's height in the world: a drum of a column
EARTH_POSITION, EARTH_DIAMETER = (0.16, 0.10, -0.55), 0.0425  # 12742 km
SUN_DIAMETER, SUN_DISTANCE = 4.64, 499.0                      # 1.392e6 km, one astronomical unit
SUN_AZIMUTH, SUN_ELEVATION = radians(20.4), radians(13.2)     # past the Earth's upper right, clear of the first column


def column():
    """An Attic base, a shaft of 20 flutes that swells slightly while it tapers, a plain capital; y from -1.5 to 1.5."""
    low, high, flutes = -1.235, 1.26, 20

    def shaft(u, v):
        y = low + (high - low) * v
        radius = 0.150 - 0.024 * v + 0.004 * sin(pi * v)
        # The flutes fade into plain rings at both ends.
        depth = 0.012 * max(0.0, min(1.0, (y - low - 0.03) / 0.06)) * max(0.0, min(1.0, (high - 0.03 - y) / 0.06))
        around = (u * flutes) % 1
        radius -= depth * max(0.0, 1 - ((around - 0.5) / 0.42) ** 2)
        angle = 2 * pi * u
        return (radius * sin(angle), y, radius * cos(angle)), (u, -y / STONE_SCALE)

    shape = shapes.grid(flutes * 6, 26, shapes.smooth(shaft))
    stone = lambda face, s, t: (0.5 * s, 0.17 + 0.15 * t + 0.07 * face)
    shape.add(shapes.box((0.23, 0.05, 0.23), (0, -1.45, 0), stone))
    shape.add(shapes.moulding(64, 0.18, -1.36, 0.04, STONE_SCALE))
    scotia = lambda t: (0.185 - 0.025 * sin(pi * t) - 0.012 * t, -1.322 + 0.04 * t)
    shape.add(shapes.revolved(64, 6, scotia, STONE_SCALE))
    shape.add(shapes.moulding(64, 0.162, -1.26, 0.025, STONE_SCALE))
    shape.add(shapes.moulding(64, 0.127, 1.272, 0.014, STONE_SCALE))
    echinus = lambda t: (0.130 + 0.082 * sin(pi / 2 * t), 1.284 + 0.048 * t * (1 + t))
    shape.add(shapes.revolved(64, 8, echinus, STONE_SCALE))
    shape.add(shapes.box((0.225, 0.06, 0.225), (0, 1.44, 0), stone))
    return shape


def add_columns(glb):
    stone = glb.material("limestone", (0.95, 0.92, 0.86), glb.texture(textures.limestone()))
    mesh = glb.mesh("column", glb.geometry(column()), stone)
    for z in [-3 - 2 * k for k in range(20)] + list(range(1, 12, 2)):
        for x in (-0.8, 0.8):
            glb.node("column", mesh, (x, 0, z))
    glb.node("column at the end", mesh, (0, 0, -46))


def add_hoops(glb):
    geometry = glb.geometry(shapes.torus(96, 16, 1.6, 0.06))
    hoops = {4: ("red", (0.80, 0.10, 0.08)), 7: ("yellow", (0.82, 0.58, 0.06)), 10: ("green", (0.10, 0.55, 0.14)),
             -15: ("cyan", (0.07, 0.52, 0.60)), -27: ("violet", (0.36, 0.14, 0.70)), -39: ("orange", (0.84, 0.30, 0.05))}
    for z, (name, colour) in hoops.items():
        glb.node("hoop", glb.mesh(f"{name} hoop", geometry, glb.material(f"{name} hoop", colour)), (0, 0, z))


def add_cubes(glb):
    def face_of_die(face, s, t):
        # Opposite faces add up to seven, as on a die.
        number = (1, 6, 2, 5, 3, 4)[face] - 1
        return ((number % 3 + s) / 3, (number // 3 + t) / 2)
    geometry = glb.geometry(shapes.box((0.3, 0.3, 0.3), uv=face_of_die))
    texture = glb.texture(textures.dice())
    colours = {"red": (0.85, 0.16, 0.12), "gold": (0.90, 0.66, 0.14), "green": (0.22, 0.66, 0.24),
               "blue": (0.16, 0.36, 0.88), "white": (0.90, 0.90, 0.90), "magenta": (0.74, 0.18, 0.58)}
    meshes = [glb.mesh(f"{name} cube", geometry, glb.material(f"{name} cube", colour, texture))
              for name, colour in colours.items()]
    rng = random.Random(2)
    for i in range(21):
        z = round(12 - 2.6 * i, 3)
        for x in ((-2.4, 3.4) if i % 2 == 0 else (-3.4, 2.4)):
            turn = shapes.then(shapes.quaternion((0, 1, 0), rng.uniform(0, 2 * pi)),
                               shapes.quaternion((1, 0, 0), rng.uniform(-0.5, 0.5)))
            glb.node("cube", meshes[rng.randrange(len(meshes))], (x, round(rng.uniform(-0.9, 0.9), 3), z), turn)


def add_earth(glb):
    ground = glb.material("Earth", texture=glb.texture((HERE / "earth.jpg").read_bytes(),
                                                       {"wrapS": 10497, "wrapT": 33071}))
    mesh = glb.mesh("Earth", glb.geometry(shapes.sphere(96, 48, EARTH_DIAMETER / 2)), ground)
    # Australia and Asia face the start; the axis leans to the right.
    turn = shapes.then(shapes.quaternion((0, 1, 0), radians(-115)), shapes.quaternion((0, 0, 1), radians(-23.4)))
    glb.node("Earth", mesh, EARTH_POSITION, turn)


def sun_position():
    return (SUN_DISTANCE * cos(SUN_ELEVATION) * sin(SUN_AZIMUTH), SUN_DISTANCE * sin(SUN_ELEVATION),
            -SUN_DISTANCE * cos(SUN_ELEVATION) * cos(SUN_AZIMUTH))


def add_sun(glb):
    light = glb.material("Sun", (0, 0, 0), emissive=(60, 56, 48))
    glb.put("Sun", shapes.sphere(64, 32, SUN_DIAMETER / 2), light, sun_position())


def add_cylinder(glb):
    """The paper's rainbow figure: dots about 0.15 apart, a whole number of them around."""
    around, apart = 15, 0.15
    uv = lambda along, rim: (along / (2 * apart), rim / (2 * pi * 0.35 / around))
    dots = glb.texture(textures.stipple())
    blue = glb.material("stippled blue", (0.02, 0.06, 1.0), dots, (0.005, 0.015, 0.25), dots)
    shape = shapes.cylinder_along_x(64, 60, 16, 0.35, uv)
    glb.put("stippled cylinder", shape, blue, (-14, 0, 8))


def main():
    glb = Glb()
    for add in (add_columns, add_hoops, add_cubes, add_earth, add_sun, add_cylinder):
        add(glb)
    glb.write(sys.argv[1] if len(sys.argv) > 1 else HERE / "avenue.glb")


if __name__ == "__main__":
    main()
