#!/usr/bin/env python3
"""Writes train.glb: a tunnel of ribs, 15 light-seconds long, and a train of 20, modelled at rest around its own middle. What
moves and when doors are shut is in config/scenes/train.json. Needs Python 3's own library only; the same bytes come out every
time."""
import random
import sys
from math import cos, pi, sin, sqrt
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
from dials import Dials
from glb import Glb
from land import Kit, around, cloud, fir, house, mountains, pavement, quad, skyline, tree

TUNNEL, TRAIN = 15, 20
INNER, SPRING = 1.45, 1.5  # half the bore's width, and the height at which its vault begins
SIDE, MIDDLE, TALL = 0.95, 1.38, 1.03  # the train's half width, its axis above the ground, its half height
CARS = 4
REACH, SLEEPERS = 240, 20  # half the length of the rails, and the sleepers of one mesh
MEADOW, FIELD = 5, 15  # sides of the squares of the mown meadow along the line, and of the fields beyond it
DIAL_AT = 7.0  # from the train's middle: the clocks at its ends


def facing(corners, way):
    """A flat piece whose front looks along `way`, whatever the order of its corners."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners[:3]
    normal = shapes.cross((bx - ax, by - ay, bz - az), (cx - bx, cy - by, cz - bz))
    return shapes.fan(corners if sum(n * w for n, w in zip(normal, way)) > 0 else corners[::-1])


def arch(low, high, inner, thick, steps=24):
    """Two legs and half a ring, from x = low to high."""
    angles = [pi * k / steps for k in range(steps + 1)]
    path = lambda r: [(0, r)] + [(SPRING + r * sin(a), r * cos(a)) for a in angles] + [(0, -r)]
    near, far = path(inner), path(inner + thick)
    shape = shapes.Shape()
    for i in range(len(near) - 1):
        (y0, z0), (y1, z1), (v0, w0), (v1, w1) = near[i], near[i + 1], far[i], far[i + 1]
        out = (0, (y0 + y1) / 2 - SPRING if 0 < i < steps + 1 else 0, (z0 + z1) / 2)
        for x, way in ((low, (-1, 0, 0)), (high, (1, 0, 0))):
            shape.add(facing([(x, y0, z0), (x, v0, w0), (x, v1, w1), (x, y1, z1)], way))
        shape.add(facing([(low, y0, z0), (high, y0, z0), (high, y1, z1), (low, y1, z1)], tuple(-o for o in out)))
        shape.add(facing([(low, v0, w0), (high, v0, w0), (high, v1, w1), (low, v1, w1)], out))
    return shape


def add_tunnel(glb, stone, dials):
    iron = glb.material("ribs", (0.30, 0.36, 0.42))
    rib = glb.mesh("rib", glb.geometry(arch(-0.06, 0.06, INNER, 0.16)), iron)
    for k in range(-3, 4):
        glb.node("rib", rib, (TUNNEL / 8 * k, 0, 0))
    stringers = shapes.Shape()
    for k in (1, 3, 5, 7):
        y, z = SPRING + (INNER + 0.1) * sin(pi * k / 8), (INNER + 0.1) * cos(pi * k / 8)
        stringers.add(shapes.bar(12, (-TUNNEL / 2, y, z), (TUNNEL / 2, y, z), 0.05))
    glb.put("stringers", stringers, iron)

    portal = arch(-0.3, 0.3, INNER, 0.7)
    portal.add(shapes.box((0.36, 0.16, 0.44), (0, 0.16, INNER + 0.35)))
    portal.add(shapes.box((0.36, 0.16, 0.44), (0, 0.16, -INNER - 0.35)))
    portal.add(shapes.bar(16, (0, SPRING + INNER + 0.6, 0), (0, SPRING + INNER + 1.3, 0), 0.13))
    portal = glb.mesh("portal", glb.geometry(portal), stone)
    for side in (-1, 1):
        x = side * (TUNNEL / 2 + 0.3)
        glb.node("portal", portal, (x, 0, 0))
        dials.put("portal clock", (x, SPRING + INNER + 1.25 + dials.radius, 0), both=True)


def add_doors(glb):
    """Planks that fill the bore, just within the tunnel; and the lamps that tell from all around whether they are shut."""
    planks = (shapes.Shape(), shapes.Shape())
    count = 10
    for k in range(count):
        low, high = (-INNER + 2 * INNER * j / count for j in (k, k + 1))
        top = lambda z: SPRING + sqrt(max(INNER ** 2 - z ** 2, 0))
        planks[k // 2 % 2].add(shapes.extruded([(low, 0), (high, 0), (high, top(high)), (low, top(low))], -0.05, 0.05),
                               turn=shapes.quaternion((0, 1, 0), pi / 2))
    red = glb.material("door's red", (0.72, 0.04, 0.03), emissive=(0.20, 0.01, 0.008))
    white = glb.material("door's white", (0.85, 0.83, 0.78), emissive=(0.12, 0.11, 0.10))
    meshes = [glb.mesh(name, glb.geometry(shape), paint)
              for name, shape, paint in (("red planks", planks[0], red), ("white planks", planks[1], white))]
    globe = glb.geometry(shapes.sphere(24, 12, 0.36))
    lamps = {name: glb.mesh(f"{name} lamp", globe, glb.material(f"{name} lamp", (0, 0, 0), emissive=light))
             for name, light in (("shut", (2.2, 0.10, 0.06)), ("open", (0.10, 1.1, 0.22)))}
    for name, side in (("west", -1), ("east", 1)):
        shut, open_ = glb.group(f"{name} door shut"), glb.group(f"{name} door open")
        for mesh in meshes:
            glb.node("planks", mesh, (side * TUNNEL / 2, 0, 0), below=shut)
        for group, key in ((shut, "shut"), (open_, "open")):
            glb.node(f"{key} lamp", lamps[key], (side * (TUNNEL / 2 + 0.3), SPRING + INNER + 0.98, 0), below=group)


def train_side(v, x):
    """The hull's outline: v once around, from the top over +z. x: which part of a nose is left, 0 to 1."""
    c, s = cos(2 * pi * v), sin(2 * pi * v)
    round_ = lambda w: abs(w) ** (1 / 3) * (1 if w > 0 else -1)
    return (MIDDLE - 0.22 * (1 - x) + (TALL * (0.45 + 0.55 * x)) * round_(c), SIDE * (0.55 + 0.45 * x) * round_(s))


def hull(low, high, nose):
    """A car from x = low to high; nose: -1 or 1 where one of its ends is the train's."""
    def at(u, v):
        x = low + (high - low) * v
        end = low if nose < 0 else high
        left = min(1.0, abs(end - x) / 2.0) if nose else 1.0
        y, z = train_side(u, sqrt(1 - (1 - left) ** 2))
        return (x, y, z), (u, v)
    shape = shapes.grid(48, 14 if nose else 1, shapes.smooth(at))
    for end, way in ((low, -1), (high, 1)):
        left = 0.0 if nose == way else 1.0
        rim = [(end, *train_side(k / 48, left)) for k in range(48)]
        shape.add(facing(rim, (way, 0, 0)))
    return shape


def add_train(glb, dials):
    train = glb.group("train")
    red = glb.material("crimson", (0.50, 0.045, 0.04))
    cream = glb.material("cream", (0.80, 0.72, 0.52))
    dark = glb.material("undercarriage", (0.03, 0.03, 0.035))
    lit = glb.material("lit windows", (0.05, 0.05, 0.05), emissive=(0.75, 0.50, 0.22))
    long = TRAIN / CARS
    windows, stripes, under = shapes.Shape(), shapes.Shape(), shapes.Shape()
    for k in range(CARS):
        low, high = -TRAIN / 2 + long * k, -TRAIN / 2 + long * (k + 1)
        nose = -1 if k == 0 else 1 if k == CARS - 1 else 0
        near, far = low + (0 if nose < 0 else 0.10), high - (0 if nose > 0 else 0.10)
        glb.put("car", hull(near, far, nose), red, below=train)
        straight = (near + (2.0 if nose < 0 else 0.15), far - (2.0 if nose > 0 else 0.15))
        middle, half = sum(straight) / 2, (straight[1] - straight[0]) / 2
        for z in (-1, 1):
            for y in (0.78, 2.04):
                stripes.add(shapes.box((half, 0.035, 0.02), (middle, y, z * (SIDE + 0.005))))
        under.add(shapes.box(((far - near) / 2 - (0.6 if nose else 0.1), 0.15, 0.7),
                             ((near + far) / 2 - 0.5 * nose, 0.2, 0)))
        if k < CARS - 1:
            under.add(shapes.box((0.12, 0.85, 0.75), (high, MIDDLE - 0.05, 0)))
        count, first, step = (1, nose * 5.55, 0) if nose else (6, middle - 1.95, 0.78)
        for j in range(count):
            for z in (-1, 1):
                windows.add(shapes.box((0.27, 0.36, 0.02), (first + step * j, 1.46, z * (SIDE + 0.005))))
    glb.put("windows", windows, lit, below=train)
    glb.put("stripes", stripes, cream, below=train)
    glb.put("undercarriage", under, dark, below=train)
    for x in (-DIAL_AT, DIAL_AT):
        for z, turn in ((1, 0), (-1, pi)):
            dials.put("train clock", (x, MIDDLE, z * (SIDE + 0.03)), below=train, turn=turn)
    lamp = glb.mesh("headlamp", glb.geometry(shapes.sphere(16, 8, 0.10)),
                    glb.material("headlamp", (0, 0, 0), emissive=(1.6, 1.5, 1.2)))
    for z in (-0.3, 0.3):
        glb.node("headlamp", lamp, (TRAIN / 2, 0.95, z), below=train)


def add_track(glb, stone):
    """Rails on sleepers in a bed of gravel, beyond the boundary of the flight on both sides."""
    kit = Kit(glb)
    kit.paint("gravel", (0.30, 0.28, 0.25))
    kit.paint("steel", (0.42, 0.43, 0.46))
    kit.paint("timber", (0.16, 0.10, 0.06))
    rails, sleepers, bed = shapes.Shape(), shapes.Shape(), shapes.Shape()
    for z in (-0.62, 0.62):
        rails.add(shapes.box((REACH, 0.04, 0.05), (0, 0.10, z)))
    for k in range(SLEEPERS):
        sleepers.add(shapes.box((0.13, 0.02, 1.0), (k - (SLEEPERS - 1) / 2, 0.05, 0)))
    flat, foot, high = 1.12, 1.38, 0.035
    for corners in (((flat, high), (-flat, high)), ((foot, 0.0), (flat, high)), ((-flat, high), (-foot, 0.0))):
        (z0, y0), (z1, y1) = corners
        bed.add(quad((-REACH, y0, z0), (REACH, y0, z0), (REACH, y1, z1), (-REACH, y1, z1)))
    kit.build("rails", rails, "steel")
    kit.build("bed", bed, "gravel")
    kit.make("sleepers", sleepers, "timber")
    for k in range(-REACH // SLEEPERS, REACH // SLEEPERS + 1):
        kit.put("sleepers", (SLEEPERS * k, 0, 0))
    # Before the tunnel a field for each light-second, from one door to the other.
    geometry = glb.geometry(shapes.box((0.5, 0.08, 0.22)), uvs=False)
    paints = [glb.mesh(f"{name} field", geometry, glb.material(f"{name} field", colour))
              for name, colour in (("white", (0.75, 0.75, 0.72)), ("blue", (0.05, 0.16, 0.48)))]
    for k in range(TUNNEL):
        for z in (-3.2, 3.2):
            glb.node("field", paints[k % 2], (k - (TUNNEL - 1) / 2, 0.08, z))


def add_fields(kit):
    """Two greens along the line, in squares of 5 light-seconds, and crops beyond; all on one level, none above another."""
    crops = (("light grass", (0.170, 0.270, 0.085)), ("dark grass", (0.140, 0.232, 0.072)), ("wheat", (0.52, 0.40, 0.15)),
             ("clover", (0.11, 0.25, 0.075)), ("rye", (0.42, 0.39, 0.17)), ("young corn", (0.22, 0.34, 0.09)), ("earth", (0.24, 0.155, 0.095)))
    meadow = pavement(-150, -30, 60, 12, MEADOW, 0)
    beyond = [pavement(-150, far, 20, 5, FIELD, 0, lambda i, j: (7 * (i // 2) + 3 * j + (i // 2) * j) % 5, 5) for far in (-105, 30)]
    for k, (name, colour) in enumerate(crops):
        shape = meadow[k] if k < 2 else beyond[0][k - 2]
        if k >= 2:
            shape.add(beyond[1][k - 2])
        kit.paint(name, colour, infrared=0.18 if name in ("wheat", "rye", "earth") else 0.45)
        kit.build(name, shape, name)
    kit.build("grass", around(-150, 105, 150, -105, 420, 0), "dark grass")


def add_land(glb):
    """Meadows, fields, woods, a village and mountains."""
    kit = Kit(glb)
    add_fields(kit)
    for name, colour, radius, deep, low, high in (("hills", (0.13, 0.23, 0.15), 190, 60, 8, 34), ("far hills", (0.26, 0.36, 0.44), 330, 60, 20, 74)):
        kit.paint(name, colour)
        kit.build(name, mountains(radius, deep, skyline(len(name), low, high), -0.3), name)
    add_trees(kit)
    add_village(kit)
    kit.paint("cloud", (0.90, 0.90, 0.92), (0.16, 0.17, 0.19))
    kit.make("cloud", cloud(3), "cloud")
    for x, y, z, turn, size in ((-150, 112, -230, 0.3, 1.3), (60, 92, -260, 2.6, 1.5), (170, 80, -120, 1.4, 1.2), (-220, 80, -60, 1.8, 1.4),
                                (-150, 85, 160, 2.4, 1.3), (40, 95, 240, 0.4, 1.4), (210, 90, 90, 1.2, 1.2)):
        kit.put("cloud", (x, y, z), turn, size)


def add_trees(kit):
    """Firs and broad trees behind the line and far behind the visitor, and woods on the slopes; none where a visitor looks on."""
    for name, colour in (("fir", (0.045, 0.14, 0.075)), ("leaves", (0.10, 0.25, 0.06)), ("light leaves", (0.16, 0.32, 0.075))):
        kit.paint(name, colour, infrared=0.5)
    kit.paint("bark", (0.13, 0.085, 0.05))
    green, stem = fir()
    kit.make("fir", green, "fir", stem, "bark")
    dark, light, trunk = tree()
    kit.make("tree", dark, "leaves", light, "light leaves", trunk, "bark")
    for k in range(-15, 16):
        for side in (-1, 1):
            x, z = 5.1 * k + 1.9 * sin(2.3 * k), side * (14.5 + 4.5 * sin(1.7 * k + side)) + (0 if side < 0 else 14)
            if side > 0 and -20 < x < 60:
                continue  # nothing before a visitor who watches from there
            kit.put("fir" if k % 3 else "tree", (x, 0, z), k, 1.15 + 0.3 * sin(3.1 * k + side))
    rng = random.Random(8)
    for _ in range(60):
        x = rng.choice((-1, 1)) * rng.uniform(4, 115)
        kit.put("fir" if rng.random() < 0.5 else "tree", (x, 0, rng.choice((-1, 1, -1)) * rng.uniform(42, 96)), rng.uniform(0, 6), rng.uniform(1.3, 2.3))


def add_village(kit):
    """Houses and a church on the far side of the line."""
    for name, colour in (("rose wall", (0.62, 0.36, 0.28)), ("white wall", (0.76, 0.72, 0.64)), ("ochre wall", (0.66, 0.48, 0.22)),
                         ("tiles", (0.40, 0.13, 0.075)), ("slate", (0.13, 0.16, 0.21)), ("panes", (0.06, 0.08, 0.11))):
        kit.paint(name, colour)
    walls, roof, panes = house(1.6, 2.2, 4.6, 3.9)
    for name in ("rose", "white", "ochre"):
        kit.make(f"{name} house", walls, f"{name} wall", roof, "tiles", panes, "panes")
    rng = random.Random(21)
    for k in range(15):
        x, z = -30 + 4.9 * (k % 8) + rng.uniform(-0.7, 0.7), (-29 if k < 8 else -38) + rng.uniform(-1.2, 1.2)
        if abs(x + 5) > 3.5 or k < 8:
            kit.put(f"{('rose', 'white', 'ochre')[k % 3]} house", (x, 0, z), rng.uniform(-0.4, 0.4), rng.uniform(0.85, 1.1))
    tower = shapes.box((1.3, 4.2, 1.3), (0, 4.2, 0))
    spire = shapes.Shape()
    for k in range(4):
        corner = [(1.5 * (1 if j in (0, 1) else -1), 8.4, 1.5 * (1 if j in (0, 3) else -1)) for j in (k, (k + 1) % 4)]
        spire.add(facing([corner[0], corner[1], (0, 14.0, 0)], tuple(a + b for a, b in zip(*corner))))
    kit.make("church tower", tower, "white wall", spire, "slate")
    kit.make("nave", walls, "white wall", roof, "slate", panes, "panes")
    kit.put("church tower", (-5, 0, -38))
    kit.put("nave", (-6.4, 0, -38), -pi / 2, 1.5)


def main():
    glb = Glb("train")
    stone = glb.material("stone", (0.50, 0.45, 0.38))
    add_tunnel(glb, stone, Dials(glb, 1.0, name="tunnel dial"))
    add_doors(glb)
    add_train(glb, Dials(glb, 0.78, face=(0.88, 0.86, 0.80), rim=(0.70, 0.60, 0.30), name="train dial"))
    add_track(glb, stone)
    add_land(glb)
    glb.write(sys.argv[1] if len(sys.argv) > 1 else HERE / "train.glb")


if __name__ == "__main__":
    main()
