#!/usr/bin/env python3
"""Writes gamow.glb, a street of a small town where light flies at 5 metres a second, and with it config/scenes/gamow.json, whose
trams and cyclists come one after the other for half an hour. Lengths are metres. Needs Python 3's own library only; the same
bytes come out every time."""
import json
import random
import sys
from math import atan2, cos, hypot, pi, sin
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
from dials import Dials
from glb import Glb
from land import quad

ROAD, PAVED = 4.2, 6.6  # half widths of the roadway and of all between the houses
NEAR, FAR = 34, -84  # walls with an archway, through which trams come and go
TOWER = -54
TRACK, LANE = -1.7, 2.5  # x of the tram's and of the cyclists' ways
QUARTER = pi / 2


def upright_turn(angle):
    return shapes.quaternion((0, 1, 0), angle)


class Town:
    """Materials by name, meshes that many nodes share, and nodes."""
    def __init__(self, glb):
        self.glb, self.materials, self.meshes = glb, {}, {}

    def paint(self, name, colour, emissive=None, **beyond):
        self.materials[name] = self.glb.material(name, colour, emissive=emissive, starbow=beyond or None)

    def mesh(self, name, shape, material):
        self.meshes[name] = self.glb.mesh(name, self.glb.geometry(shape, uvs=False), self.materials[material])

    def put(self, name, place, turn=None, scale=None, below=None):
        self.glb.node(name, self.meshes[name], tuple(round(p, 4) for p in place), turn and tuple(round(q, 7) for q in turn),
                      scale, below)

    def build(self, name, shape, material, below=None):
        mesh = self.glb.mesh(name, self.glb.geometry(shape, uvs=False), self.materials[material])
        self.glb.node(name, mesh, below=below)


def paints(town):
    for name, colour in (("ochre", (0.66, 0.44, 0.17)), ("rose", (0.64, 0.34, 0.28)), ("pale blue", (0.36, 0.48, 0.58)),
                         ("sage", (0.40, 0.50, 0.33)), ("cream", (0.76, 0.68, 0.50)), ("terracotta", (0.56, 0.24, 0.13)),
                         ("straw", (0.74, 0.60, 0.28)), ("pearl", (0.60, 0.58, 0.56))):
        town.paint(name, colour)
    town.paint("tiles", (0.40, 0.13, 0.075))
    town.paint("brown tiles", (0.26, 0.12, 0.08))
    town.paint("slate", (0.13, 0.16, 0.21))
    town.paint("copper", (0.22, 0.42, 0.36))
    town.paint("white", (0.82, 0.80, 0.75))
    town.paint("glass", (0.05, 0.075, 0.10), emissive=(0.010, 0.016, 0.024))
    town.paint("lit glass", (0.10, 0.08, 0.05), emissive=(0.62, 0.40, 0.16))
    town.paint("stone", (0.50, 0.46, 0.40))
    town.paint("dark stone", (0.30, 0.28, 0.26))
    town.paint("iron", (0.035, 0.05, 0.045))
    town.paint("lantern", (0.4, 0.38, 0.3), emissive=(0.95, 0.72, 0.38))
    town.paint("wood", (0.17, 0.085, 0.035))
    town.paint("green door", (0.03, 0.15, 0.10))
    town.paint("blue door", (0.04, 0.10, 0.24))
    town.paint("leaves", (0.10, 0.26, 0.055), infrared=0.5)
    town.paint("light leaves", (0.17, 0.34, 0.07), infrared=0.5)
    town.paint("bark", (0.15, 0.10, 0.065))
    town.paint("geraniums", (0.62, 0.04, 0.08))
    town.paint("grass", (0.14, 0.27, 0.07), infrared=0.5)
    town.paint("cobbles", (0.215, 0.205, 0.20))
    town.paint("dark cobbles", (0.165, 0.16, 0.16))
    town.paint("flags", (0.44, 0.41, 0.36))
    town.paint("dark flags", (0.38, 0.355, 0.31))
    town.paint("kerb", (0.56, 0.54, 0.50))
    town.paint("rails", (0.50, 0.51, 0.53))
    town.paint("red", (0.58, 0.05, 0.04))
    town.paint("tram green", (0.025, 0.20, 0.11))
    town.paint("tram cream", (0.56, 0.50, 0.38))  # its front meets the sun at 0.6 c, twice as bright as the houses do
    town.paint("black", (0.02, 0.02, 0.022))
    town.paint("coat", (0.05, 0.12, 0.36))
    town.paint("trousers", (0.12, 0.11, 0.10))
    town.paint("skin", (0.62, 0.38, 0.27))
    town.paint("scarf", (0.70, 0.12, 0.05))
    town.paint("cloud", (0.90, 0.90, 0.92), emissive=(0.16, 0.17, 0.19))


def add_street(town):
    """Tiles of 8 m: stones 1 m long, that show how long the street looks."""
    tiles = {name: shapes.Shape() for name in ("cobbles", "dark cobbles", "flags", "dark flags", "kerb")}
    slab = lambda x0, x1, z, long, y: quad((x0, y, z + long), (x1, y, z + long), (x1, y, z), (x0, y, z))
    for j in range(8):
        for i in range(6):
            wide = 2 * ROAD / 6
            tiles["dark cobbles" if (i + j) % 2 else "cobbles"].add(slab(-ROAD + wide * i, -ROAD + wide * (i + 1), j, 1, 0))
        for side in (-1, 1):
            for i in range(2):
                wide = (PAVED + 1.0 - ROAD) / 2
                x = side * (ROAD + wide * (i + 0.5))
                name = "dark flags" if (i + j) % 2 else "flags"
                tiles[name].add(slab(x - wide / 2, x + wide / 2, j, 1, 0.14))
    for side in (-1, 1):
        tiles["kerb"].add(shapes.box((0.12, 0.08, 4), (side * ROAD, 0.075, 4)))
    for name, shape in tiles.items():
        town.mesh(f"{name} tile", shape, name)
        for k in range(-13, 8):
            town.put(f"{name} tile", (0, 0, 8 * k))
    rails = shapes.Shape()
    for x in (TRACK - 0.55, TRACK + 0.55):
        rails.add(quad((x - 0.05, 0.012, 64), (x + 0.05, 0.012, 64), (x + 0.05, 0.012, -104), (x - 0.05, 0.012, -104)))
    town.build("rails", rails, "rails")
    grass = shapes.Shape()
    for i in range(-3, 3):
        for j in range(-4, 3):
            grass.add(shapes.level(60 * i, 60 * (j + 1), 60 * (i + 1), 60 * j, -0.05))
    town.build("grass", grass, "grass")


def add_window_parts(town):
    """All face +z."""
    frame = shapes.Shape()
    for half, centre in (((0.06, 0.80, 0.05), (-0.50, 0, 0)), ((0.06, 0.80, 0.05), (0.50, 0, 0)), ((0.56, 0.06, 0.05), (0, 0.80, 0)),
                         ((0.64, 0.05, 0.11), (0, -0.84, 0.03)), ((0.03, 0.80, 0.035), (0, 0, 0)), ((0.50, 0.03, 0.035), (0, 0.25, 0))):
        frame.add(shapes.box(half, centre))
    town.mesh("frame", frame, "white")
    pane = quad((-0.5, -0.8, 0.015), (0.5, -0.8, 0.015), (0.5, 0.8, 0.015), (-0.5, 0.8, 0.015))
    town.mesh("pane", pane, "glass")
    town.mesh("lit pane", pane, "lit glass")
    shutter = shapes.box((0.24, 0.82, 0.025), (0, 0, 0.03))
    for name in ("green door", "blue door", "wood"):
        town.mesh(f"{name} shutter", shutter, name)
    blooms = shapes.Shape()
    for k in range(6):
        blooms.add(shapes.sphere(7, 4, 0.115), (-0.45 + 0.18 * k, -0.70 + 0.03 * (k % 2), 0.17))
    town.mesh("geraniums", blooms, "geraniums")
    town.mesh("flower box", shapes.box((0.54, 0.07, 0.09), (0, -0.80, 0.17)), "wood")
    for name in ("green door", "blue door", "wood"):
        door = shapes.box((0.55, 1.15, 0.04), (0, 1.15, 0.03))
        for y in (0.62, 1.55):
            door.add(shapes.box((0.40, 0.38, 0.02), (0, y, 0.07)))
        town.mesh(f"{name} leaf", door, name)
    case = shapes.Shape()
    for half, centre in (((0.09, 1.30, 0.09), (-0.64, 1.30, 0.04)), ((0.09, 1.30, 0.09), (0.64, 1.30, 0.04)),
                         ((0.78, 0.11, 0.14), (0, 2.70, 0.06)), ((0.80, 0.08, 0.30), (0, 0.08, 0.20))):
        case.add(shapes.box(half, centre))
    town.mesh("doorcase", case, "stone")
    shop = shapes.Shape()
    for half, centre in (((1.35, 0.35, 0.06), (0, 0.35, 0.03)), ((0.07, 1.25, 0.07), (-1.35, 1.25, 0.03)),
                         ((0.07, 1.25, 0.07), (1.35, 1.25, 0.03)), ((1.42, 0.18, 0.10), (0, 2.55, 0.05)),
                         ((0.04, 0.85, 0.05), (-0.45, 1.55, 0.03)), ((0.04, 0.85, 0.05), (0.45, 1.55, 0.03))):
        shop.add(shapes.box(half, centre))
    town.mesh("shop front", shop, "wood")
    town.mesh("shop pane", quad((-1.35, 0.7, 0.02), (1.35, 0.7, 0.02), (1.35, 2.4, 0.02), (-1.35, 2.4, 0.02)), "lit glass")
    cloth = (shapes.Shape(), shapes.Shape())
    for k in range(9):
        x0, x1 = -1.55 + 3.1 * k / 9, -1.55 + 3.1 * (k + 1) / 9
        for flip in (0, 1):
            low, high = ((x0, 2.35, 1.25), (x1, 2.35, 1.25)), ((x1, 2.95, 0.06), (x0, 2.95, 0.06))
            corners = (*low, *high)
            cloth[k % 2].add(quad(*(corners[::-1] if flip else corners)))
        cloth[k % 2].add(quad((x0, 2.13, 1.25), (x1, 2.13, 1.25), (x1, 2.35, 1.25), (x0, 2.35, 1.25)))
        cloth[k % 2].add(quad((x1, 2.13, 1.249), (x0, 2.13, 1.249), (x0, 2.35, 1.249), (x1, 2.35, 1.249)))
    town.mesh("red cloth", cloth[0], "red")
    town.mesh("white cloth", cloth[1], "white")


def add_house(town, name, centre, facing, wide, floors, wall, roof, rng, shop):
    """Its gable faces the street. centre: of its front's foot; facing: turn about y from +z."""
    turn = upright_turn(facing)
    place = lambda x, y, z: tuple(c + p for c, p in zip(centre, shapes.turned(turn, (x, y, z))))
    eaves, deep = 3.3 + 2.9 * (floors - 1) + 0.4, 9.0
    ridge = eaves + wide * 0.62
    half = wide / 2 - 0.02
    walls = shapes.Shape()
    outline = [(-half, 0), (half, 0), (half, eaves), (0, ridge), (-half, eaves)]
    walls.add(shapes.extruded(outline, -deep, 0), centre, turn)
    town.build(f"{name} walls", walls, wall)
    # The gable's coping and the string courses.
    trim = shapes.Shape()
    for y in [3.35] + ([eaves - 0.1] if floors > 1 else []):
        trim.add(shapes.box((half + 0.03, 0.07, 0.07), (0, y, 0.02)), centre, turn)
    trim.add(shapes.box((half + 0.02, 0.28, 0.05), (0, 0.28, 0)), centre, turn)
    slope = atan2(ridge - eaves, half)
    for side in (-1, 1):
        long = hypot(half, ridge - eaves) / 2 + 0.1
        edge = shapes.box((long, 0.09, 0.13), (0, 0.03, 0))
        lean = shapes.then(shapes.quaternion((0, 0, 1), -side * slope), turn)
        trim.add(edge, place(side * half / 2, (ridge + eaves) / 2 + 0.02, -0.02), lean)
    trim.add(shapes.sphere(12, 6, 0.16), place(0, ridge + 0.24, -0.02))
    town.build(f"{name} trim", trim, "white")
    tiles = shapes.Shape()
    for side in (-1, 1):
        long = hypot(half, ridge - eaves) / 2 + 0.16
        lean = shapes.then(shapes.quaternion((0, 0, 1), -side * slope), turn)
        tiles.add(shapes.box((long, 0.07, deep / 2 - 0.06), (0, 0.05, 0)),
                  place(side * (half / 2 + 0.06), (ridge + eaves) / 2 - 0.05, -deep / 2 - 0.1), lean)
    town.build(f"{name} roof", tiles, roof)
    chimney = shapes.box((0.28, 0.8, 0.28), (0, 0, 0))
    stack = shapes.Shape()
    stack.add(chimney, place(half * 0.45, ridge - 0.2, -deep * 0.6), turn)
    stack.add(shapes.box((0.34, 0.07, 0.34)), place(half * 0.45, ridge + 0.6, -deep * 0.6), turn)
    town.build(f"{name} chimney", stack, "terracotta")

    columns = 3 if wide > 6.2 else 2
    apart = wide / (columns + 0.35)
    shutters = rng.choice((None, "green door", "blue door", "wood")) if not shop else None
    def window(x, y, flowers):
        lit = rng.random() < 0.22
        town.put("frame", place(x, y, 0.03), turn)
        town.put("lit pane" if lit else "pane", place(x, y, 0.01), turn)
        if shutters and apart > 1.9:
            for side in (-1, 1):
                town.put(f"{shutters} shutter", place(x + side * 0.84, y, 0), turn)
        if flowers:
            town.put("flower box", place(x, y, 0), turn)
            town.put("geraniums", place(x, y, 0), turn)
    for floor in range(1, floors):
        for k in range(columns):
            window(apart * (k - (columns - 1) / 2), 2.9 * floor + 2.15, floor == 1 or rng.random() < 0.3)
    if wide > 5.4:
        window(0, eaves + (ridge - eaves) * 0.30, False)
    colour = rng.choice(("green door", "blue door", "wood"))
    side = rng.choice((-1, 1))
    at = side * (wide / 2 - 1.05)
    town.put(f"{colour} leaf", place(at, 0.14, 0), turn)
    town.put("doorcase", place(at, 0.14, 0), turn)
    if shop:
        x = -side * (wide / 2 - 2.0)
        for part in ("shop front", "shop pane", "red cloth", "white cloth"):
            town.put(part, place(x, 0.14, 0.02), turn)
    else:
        for k in range(columns - 1):
            x = at - side * (1.9 + k * 1.75)
            if abs(x) < wide / 2 - 0.7:
                window(x, 1.95, rng.random() < 0.5)


def add_houses(town):
    rng = random.Random(1940)
    walls = ["ochre", "pale blue", "cream", "rose", "sage", "straw", "pearl", "terracotta"]
    for side, first in ((-1, 0), (1, 3)):
        z, k = NEAR - 1.5, first
        while z > FAR + 9:
            wide = rng.choice((5.0, 5.6, 6.4, 7.0))
            if z > TOWER + 7 > z - wide or (TOWER + 7 >= z > TOWER - 5):  # the tower stands between the houses
                z = TOWER - 5
                continue
            floors = rng.choice((2, 3, 3, 2))
            add_house(town, f"house {side} {k}", (side * PAVED, 0, z - wide / 2), -side * QUARTER, wide, floors,
                      walls[k % len(walls)], rng.choice(("tiles", "tiles", "brown tiles", "slate")), rng, rng.random() < 0.35)
            z -= wide
            k += 1


def archway(half_wide, half_deep, top, inner, spring):
    """A wall with a round arch through it along z, x from -half_wide to half_wide."""
    shape = shapes.Shape()
    for side in (-1, 1):
        shape.add(shapes.box(((half_wide - inner) / 2, top / 2, half_deep), (side * (half_wide + inner) / 2, top / 2, 0)))
    steps = 24
    arc = [(inner * cos(pi * k / steps), spring + inner * sin(pi * k / steps)) for k in range(steps + 1)]
    for (x0, y0), (x1, y1) in zip(arc, arc[1:]):
        for z, way in ((half_deep, 1), (-half_deep, -1)):
            corners = [(x0, y0, z), (x0, top, z), (x1, top, z), (x1, y1, z)]
            shape.add(quad(*(corners if way > 0 else corners[::-1])))
        shape.add(quad((x0, y0, half_deep), (x1, y1, half_deep), (x1, y1, -half_deep), (x0, y0, -half_deep)))
    shape.add(quad((-inner, top, half_deep), (inner, top, half_deep), (inner, top, -half_deep), (-inner, top, -half_deep)))
    return shape


def add_walls(town):
    shape = archway(28, 0.7, 6.6, 4.0, 2.0)
    for x in range(-27, 28, 2):
        shape.add(shapes.box((0.5, 0.45, 0.7), (x, 7.05, 0)))
    town.mesh("town wall", shape, "stone")
    for z in (NEAR, FAR):
        town.put("town wall", (0, 0, z))


def add_tower(town):
    """The church stands to the street with its tower, and the street goes through beneath it."""
    half, deep, top = 6.55, 4.2, 19.5
    body = shapes.Shape()
    body.add(archway(half, deep, 7.6, 4.05, 2.8), (0, 0, TOWER))
    body.add(shapes.box((half - 0.9, (top - 7.6) / 2, deep - 0.4), (0, (top + 7.6) / 2, TOWER)))
    town.build("tower", body, "cream")
    trim = shapes.Shape()
    for y, more in ((7.75, 0.12), (15.6, 0.06 - 0.75), (top, 0.30 - 0.75)):
        trim.add(shapes.box((half + more, 0.20, deep + more + (0.35 if more < 0 else 0)), (0, y, TOWER)))
    for x in (-1, 1):
        for z in (-1, 1):
            for k in range(14):  # quoins
                trim.add(shapes.box((0.48 if k % 2 else 0.34, 0.24, 0.48 if k % 2 else 0.34),
                                    (x * (half - 1.12), 8.35 + 0.8 * k, TOWER + z * (deep - 0.62))))
    town.build("tower's stone", trim, "stone")
    roof = shapes.Shape()
    corners = [(-1, 1), (1, 1), (1, -1), (-1, -1)]
    levels = ((5.95, 4.1, top + 0.15), (3.6, 2.7, top + 3.6), (2.2, 1.9, top + 5.2), (0.05, 0.05, top + 17.0))
    for (a, b, y0), (c, d, y1) in zip(levels, levels[1:]):
        for (sx, sz), (tx, tz) in zip(corners, corners[1:] + corners[:1]):
            roof.add(quad((sx * a, y0, TOWER + sz * b), (tx * a, y0, TOWER + tz * b), (tx * c, y1, TOWER + tz * d), (sx * c, y1, TOWER + sz * d)))
    town.build("spire", roof, "copper")
    dials = Dials(town.glb, 2.3, face=(0.03, 0.05, 0.10), rim=(0.70, 0.50, 0.12), marks=(0.95, 0.78, 0.36), name="church dial")
    for z, turn in ((deep - 0.4 + 0.06, 0), (-deep + 0.4 - 0.06, pi)):
        dials.put("church clock", (0, 12.4, TOWER + z), turn=turn)
    gold = shapes.sphere(20, 10, 0.42)
    gold.add(shapes.bar(8, (0, 0, 0), (0, 1.9, 0), 0.05))
    gold.add(shapes.box((0.45, 0.05, 0.05), (0, 1.35, 0)))
    ball = shapes.Shape()
    ball.add(gold, (0, top + 17.1, TOWER))
    town.paint("gold", (0.72, 0.50, 0.12))
    town.build("ball", ball, "gold")
    for x in (-3.9, 3.9):
        for y in (10.0, 13.4, 17.4):
            town.put("frame", (x, y, TOWER + deep - 0.36))
            town.put("pane", (x, y, TOWER + deep - 0.38))
    # The nave, to the left of the street behind the houses.
    nave = shapes.extruded([(-6, 0), (6, 0), (6, 9), (0, 15.5), (-6, 9)], 0, 24)
    shape = shapes.Shape()
    shape.add(nave, (-half + 0.6, 0, TOWER), upright_turn(-QUARTER))
    town.build("nave", shape, "cream")
    cover = shapes.Shape()
    slope = atan2(6.5, 6)
    for side in (-1, 1):
        lean = shapes.then(shapes.quaternion((0, 0, 1), -side * slope), upright_turn(-QUARTER))
        cover.add(shapes.box((4.7, 0.08, 12.2)), (-half + 0.6 - 12, 12.25, TOWER + side * 3.05), lean)
    town.build("nave's roof", cover, "tiles")


def add_furniture(town):
    post = shapes.revolved(14, 10, lambda t: (0.13 - 0.085 * min(1, 2.2 * t) + (0.05 if t < 0.06 else 0), 3.5 * t), 1)
    post.add(shapes.bar(8, (-0.28, 3.3, 0), (0.28, 3.3, 0), 0.022))
    cap = shapes.revolved(6, 2, lambda t: (0.26 * (1 - t) + 0.004, 4.12 + 0.22 * t), 1)
    post.add(cap)
    post.add(shapes.fan([(0.26 * sin(-2 * pi * k / 6), 4.12, 0.26 * cos(-2 * pi * k / 6)) for k in range(6)]))
    post.add(shapes.revolved(6, 1, lambda t: (0.10 + 0.04 * t, 3.48 + 0.10 * t), 1))
    town.mesh("lamp post", post, "iron")
    town.mesh("lantern", shapes.revolved(6, 1, lambda t: (0.13 + 0.09 * t, 3.58 + 0.54 * t), 1), "lantern")
    for k in range(-9, 4):
        z = 9.0 * k + 4.5
        if abs(z - TOWER) < 7:
            continue
        for side in (-1, 1):
            for part in ("lamp post", "lantern"):
                town.put(part, (side * (ROAD + 0.55), 0.14, z))

    rng = random.Random(5)
    def blob(radius, centre):
        ball = shapes.sphere(12, 7, 1)
        rows = {}
        for i, p in enumerate(ball.positions):
            key = tuple(round(x, 6) for x in p)
            if key not in rows:
                rows[key] = radius * rng.uniform(0.88, 1.10)
            ball.positions[i] = tuple(c + rows[key] * x for c, x in zip(centre, p))
        return ball
    crowns = (shapes.Shape(), shapes.Shape())
    for k, (r, centre) in enumerate(((1.05, (0, 3.6, 0)), (0.85, (0.55, 3.0, 0.35)), (0.85, (-0.55, 3.1, 0.25)), (0.80, (0.1, 3.0, -0.6)),
                                     (0.70, (0.2, 4.3, 0.1)))):
        crowns[k % 2].add(blob(r, centre))
    town.mesh("crown", crowns[0], "leaves")
    town.mesh("light crown", crowns[1], "light leaves")
    town.mesh("trunk", shapes.bar(10, (0, 0, 0), (0, 3.0, 0), 0.13), "bark")
    tub = shapes.revolved(16, 1, lambda t: (0.50 + 0.10 * t, 0.45 * t), 1)
    tub.add(shapes.fan([(0.58 * sin(2 * pi * k / 16), 0.43, 0.58 * cos(2 * pi * k / 16)) for k in range(16)]))
    town.mesh("tub", tub, "dark stone")
    for k in range(-9, 4):
        z = 9.0 * k
        if abs(z - TOWER) < 8:
            continue
        for side in (-1, 1):
            if (k + side) % 3 == 0:
                continue
            turn = upright_turn(rng.uniform(0, 2 * pi))
            for part in ("crown", "light crown", "trunk", "tub"):
                town.put(part, (side * (ROAD + 0.75), 0.14, z + side * 0.8), turn, scale=(0.85, 0.85, 0.85))
    # Trees outside the walls, and hills of trees.
    for k in range(46):
        side = -1 if k % 2 else 1
        place = (side * rng.uniform(21, 60), -0.05, rng.uniform(-110, 60))
        size = rng.uniform(1.6, 2.6)
        for part in ("crown", "light crown", "trunk"):
            town.put(part, place, upright_turn(rng.uniform(0, 2 * pi)), scale=(size, size, size))

    column = shapes.revolved(28, 1, lambda t: (0.55, 0.25 + 2.3 * t), 1)
    base = shapes.revolved(28, 1, lambda t: (0.62, 0.25 * t), 1)
    base.add(shapes.revolved(28, 6, lambda t: (0.70 * cos(1.45 * t), 2.62 + 0.55 * sin(1.45 * t)), 1))
    base.add(shapes.revolved(28, 1, lambda t: (0.62 + 0.08 * t, 2.55 + 0.07 * t), 1))
    town.mesh("advertising column", column, "tram cream")
    town.mesh("column's iron", base, "green door")
    bills = {}
    for k, name in enumerate(("red", "coat", "straw", "sage", "rose")):
        bill = shapes.grid(8, 1, lambda u, v, k=k: ((0.555 * sin(1.2 * k + u), 0.6 + 0.25 * (k % 3) + 1.1 * v, 0.555 * cos(1.2 * k + u)),
                                                  (sin(1.2 * k + u), 0, cos(1.2 * k + u)), (u, v)))
        bills[name] = bill
        town.mesh(f"{name} bill", bill, name)
    for place in ((5.6, 0.14, 6.6), (-5.6, 0.14, -29)):
        for part in ("advertising column", "column's iron", *(f"{name} bill" for name in bills)):
            town.put(part, place)

    bench = shapes.Shape()
    for z in (-0.16, 0, 0.16):
        bench.add(shapes.box((0.85, 0.025, 0.065), (0, 0.45, z)))
    for y in (0.65, 0.82):
        bench.add(shapes.box((0.85, 0.06, 0.02), (0, y, -0.24)))
    town.mesh("bench", bench, "wood")
    legs = shapes.Shape()
    for x in (-0.7, 0.7):
        legs.add(shapes.box((0.03, 0.22, 0.2), (x, 0.22, 0)))
        legs.add(shapes.box((0.03, 0.25, 0.025), (x, 0.65, -0.25)))
    town.mesh("bench's legs", legs, "iron")
    for side, z in ((1, -4.2), (-1, 9.0), (1, -22), (-1, -13)):
        for part in ("bench", "bench's legs"):
            town.put(part, (side * 6.0, 0.14, z), upright_turn(-side * QUARTER))

    wire = shapes.bar(6, (TRACK, 5.2, NEAR), (TRACK, 5.2, FAR), 0.014)
    town.build("wire", wire, "black")
    # A clock of the street's own, on a post.
    clock = shapes.bar(14, (0, 0, 0), (0, 3.0, 0), 0.07)
    clock.add(shapes.revolved(14, 2, lambda t: (0.20 - 0.12 * t, 0.35 * t), 1))
    town.mesh("clock's post", clock, "iron")
    dials = Dials(town.glb, 0.48, rim=(0.03, 0.05, 0.045), face=(0.86, 0.84, 0.78), name="street dial", sides=40)
    for z in (12.0, -16.0):
        place = (ROAD + 0.5, 0.14, z)
        town.put("clock's post", place)
        dials.put("street clock", (place[0], 3.6, z), both=True)


def add_clouds(town):
    rng = random.Random(3)
    cloud = shapes.Shape()
    for k in range(7):
        r = rng.uniform(4, 7.5)
        cloud.add(shapes.sphere(14, 8, r), (6.0 * (k - 3) + rng.uniform(-1, 1), rng.uniform(0, 3) - 0.3 * (k - 3) ** 2, rng.uniform(-5, 5)))
    cloud.positions = [(x, y * (0.75 if y > 0 else 0.35), z) for x, y, z in cloud.positions]
    town.mesh("cloud", cloud, "cloud")
    for x, y, z, turn, size in ((-90, 62, -190, 0.3, 1.1), (70, 80, -230, 2.6, 1.4), (10, 105, -300, 0.1, 1.2), (150, 70, -40, 1.4, 1.2),
                                (-150, 75, 20, 1.8, 1.3), (40, 70, 190, 0.4, 1.2), (-60, 90, 220, 3.0, 1.3)):
        town.put("cloud", (x, y, z), upright_turn(turn), scale=(size, size, size))


def plan(long, wide, cut):
    """Half a tram's outline seen from above, corners cut: x, z."""
    return [(-wide + cut, -long), (wide - cut, -long), (wide, -long + 1.6 * cut), (wide, long - 1.6 * cut), (wide - cut, long),
            (-wide + cut, long), (-wide, long - 1.6 * cut), (-wide, -long + 1.6 * cut)]


def add_tram(town):
    """Around the middle of its floor on the rails, its front towards +z."""
    tram = town.glb.group("tram")
    lay = shapes.quaternion((1, 0, 0), -QUARTER)

    def storey(low, high, long, wide, cut):
        out = shapes.Shape()
        out.add(shapes.extruded([(x, -z) for x, z in plan(long, wide, cut)][::-1], low, high), turn=lay)
        return out

    def put(name, shape, material):
        town.build(name, shape, material, below=tram)

    put("tram's skirt", storey(0.28, 0.55, 4.0, 0.95, 0.3), "black")
    put("tram's side", storey(0.50, 1.32, 4.6, 1.12, 0.42), "tram green")
    band = storey(1.32, 1.42, 4.63, 1.15, 0.42)
    band.add(storey(1.42, 2.36, 4.56, 1.08, 0.42))
    band.add(storey(2.36, 2.66, 4.62, 1.14, 0.42))
    put("tram's upper side", band, "tram cream")
    roof = storey(2.66, 2.80, 4.5, 1.02, 0.42)
    roof.add(storey(2.80, 3.06, 3.5, 0.62, 0.25))
    put("tram's roof", roof, "slate")
    glass, line = shapes.Shape(), shapes.Shape()
    for side in (-1, 1):
        for k in range(6):
            z = -3.25 + 1.3 * k
            if (side, k) != (0, 0):
                glass.add(shapes.box((0.012, 0.40, 0.53), (side * 1.085, 1.90, z)))
        line.add(shapes.box((0.012, 0.025, 3.9), (side * 1.125, 1.15, 0)))
    for end in (-1, 1):
        glass.add(shapes.box((0.50, 0.40, 0.012), (0, 1.90, end * 4.565)))
    put("tram's windows", glass, "lit glass")
    put("tram's line", line, "gold")
    lamp = shapes.Shape()
    for end in (-1, 1):
        lamp.add(shapes.sphere(14, 7, 0.14), (0, 0.95, end * 4.62))
    put("tram's lamp", lamp, "lantern")
    pole = shapes.bar(8, (0, 3.05, -0.6), (0, 5.18, -3.4), 0.03)
    for z in (-2.6, 2.6):
        for x in (-0.55, 0.55):
            for dz in (-0.6, 0.6):
                wheel = shapes.cylinder_along_x(20, 1, 0.12, 0.30, lambda a, b: (a, b))
                pole.add(wheel, (x * 1.4, 0.30, z + dz))
    put("tram's iron", pole, "black")
    dials = Dials(town.glb, 0.36, face=(0.60, 0.58, 0.50), rim=(0.70, 0.50, 0.12), name="tram dial", sides=36)
    for side in (-1, 1):
        dials.put("tram's clock", (side * 1.15, 0.92, 0), below=tram, turn=side * QUARTER)
    dials.put("tram's clock", (0, 2.98, 4.3), below=tram)


def add_cyclist(town):
    """Around where the wheels stand, riding towards -z."""
    bike = town.glb.group("cyclist")
    bar = lambda shape, a, b, r: shape.add(shapes.bar(10, a, b, r))
    black, wheels, coat, legs, skin = (shapes.Shape() for _ in range(5))
    for z in (-0.55, 0.52):
        wheels.add(shapes.torus(32, 5, 0.33, 0.022), (0, 0.352, z), upright_turn(QUARTER))
        for k in range(8):
            angle = pi * k / 8
            bar(wheels, (0, 0.352 - 0.32 * cos(angle), z - 0.32 * sin(angle)), (0, 0.352 + 0.32 * cos(angle), z + 0.32 * sin(angle)), 0.006)
    seat, crank, head, back, front = (0, 0.95, 0.22), (0, 0.33, 0.05), (0, 0.98, -0.36), (0, 0.352, 0.52), (0, 0.352, -0.55)
    for a, b in ((seat, crank), (crank, head), (seat, head), (seat, back), (crank, back), (head, front)):
        bar(black, a, b, 0.024)
    black.add(shapes.box((0.07, 0.03, 0.13), (0, 0.98, 0.24)))
    bar(black, head, (0, 1.10, -0.34), 0.02)
    bar(black, (-0.26, 1.10, -0.30), (0.26, 1.10, -0.30), 0.02)
    hip, neck = (0, 1.04, 0.18), (0, 1.52, -0.06)
    for k in range(6):  # the coat: rounds from hip to neck
        t = k / 5
        coat.add(shapes.sphere(12, 7, 0.17 + 0.03 * sin(pi * t)), tuple(a + (b - a) * t for a, b in zip(hip, neck)))
    for side in (-1, 1):
        shoulder, hand = (side * 0.20, 1.46, -0.05), (side * 0.24, 1.11, -0.30)
        elbow = (side * 0.29, 1.22, -0.06)
        for a, b in ((shoulder, elbow), (elbow, hand)):
            bar(coat, a, b, 0.058)
        coat.add(shapes.sphere(10, 6, 0.075), shoulder)
        coat.add(shapes.sphere(8, 5, 0.06), elbow)
        skin.add(shapes.sphere(8, 5, 0.05), hand)
        foot = (side * 0.11, 0.33 - side * 0.15, 0.02)
        knee = (side * 0.12, 0.80 - side * 0.08, -0.20)
        for a, b, r in (((side * 0.09, 1.0, 0.18), knee, 0.082), (knee, foot, 0.06)):
            bar(legs, a, b, r)
        legs.add(shapes.sphere(10, 6, 0.085), knee)
        legs.add(shapes.box((0.045, 0.035, 0.11), (foot[0], foot[1] - 0.03, foot[2] - 0.05)))
    skin.add(shapes.sphere(18, 10, 0.125), (0, 1.74, -0.10))
    cap = shapes.Shape()
    cap.add(shapes.revolved(18, 4, lambda t: (0.14 * cos(1.4 * t), 0.09 * sin(1.4 * t)), 1), (0, 1.78, -0.09))
    cap.add(shapes.box((0.09, 0.012, 0.07), (0, 1.785, -0.24)))
    scarf = shapes.Shape()
    scarf.add(shapes.torus(18, 8, 0.10, 0.05), (0, 1.60, -0.07), shapes.quaternion((1, 0, 0), QUARTER))
    bar(scarf, (0.03, 1.60, 0.02), (0.06, 1.50, 0.50), 0.035)
    # Some that stand still, to compare.
    for name, shape, material in (("parked bicycle", black, "blue door"), ("parked wheels", wheels, "black")):
        town.mesh(name, shape, material)
        for place, lean in (((-5.35, 0.14, 4.6), 0.12), ((-5.35, 0.14, 2.2), -0.10), ((5.5, 0.14, 10.4), 0.1), ((5.5, 0.14, -19), 0.1)):
            town.put(name, place, shapes.quaternion((0, 0, 1), lean))
    for name, shape, material in (("bicycle", black, "red"), ("wheels", wheels, "black"), ("coat", coat, "coat"), ("trousers", legs, "trousers"),
                                  ("face", skin, "skin"), ("cap", cap, "wood"), ("scarf", scarf, "scarf")):
        town.build(name, shape, material, below=bike)


def bodies():
    """Trams towards +z at 0.6 c, cyclists towards -z at 0.8 c, until half an hour after 0: 9000 m of light. Each way is made of
    numbers that are exact in binary, so that all trams share one frame, and all cyclists."""
    def ride(name, node, x, start, since, way, takes):
        return {"name": f"{name} {since}", "nodes": [node], "worldline": [
            {"time": since, "position": [x, 0, start]}, {"time": since + takes, "position": [x, 0, start + way]}]}
    trams = [ride("tram", "tram", TRACK, -100, t, 150, 250) for t in range(-165, 9000, 110)]
    cyclists = [ride("cyclist", "cyclist", LANE, 55, t, -160, 200) for t in range(-151, 9000, 95)]
    return trams + cyclists


SCENE = """// A street where light flies at 5 metres a second (after George Gamow's Mr Tompkins): trams at 3 m/s, cyclists at 4 m/s, and whoever
// walks briskly sees the houses lean. One unit is one metre. scenes/gamow/make.py writes the glTF and this file.
{
    "$schema": "../schema/scene.schema.json",
    "gltf": "../../scenes/gamow/gamow.glb",
    "unit_m": 1,
    "light_speed_m_s": 5,
    "sky": { "zenith": [0.075, 0.220, 0.600], "horizon": [0.620, 0.740, 0.840], "nadir": [0.140, 0.200, 0.110] },
    "ambient": [0.34, 0.38, 0.45],
    "shadows": true,
    "lights": [
        // A morning's sun over the houses on the right. It stands across the street, so that neither the trams nor the cyclists fly
        // straight into its light.
        { "type": "directional", "towards": [0.60, 0.70, 0.27], "radiance": [0.92, 0.78, 0.58] }
    ],
    "bodies": [
BODIES
    ],
    "boundary": { "centre": [0, 0, -30], "radius": 220 },
    "flight": { "distance": 130, "time_s": 30 },
    "goals": [
        { "ask": "goal.gamow.tram", "reward": "goal.gamow.tram-done", "conditions": [{ "measure": { "quantity": "beta" }, "from": 0.55, "below": 0.65 }] }
    ],
    // The visit begins with shapes alone, as in Gamow's tale, and a tram and a cyclist have their colours. With the Doppler and headlight
    // effects a coming tram (0.6 c) shines blue, sixteen times as bright, and a cyclist who flees (0.8 c) is black: each is a switch.
    "start": {
        "time": 13,
        "position": [1.0, 1.7, 17],
        "look": [0, 0, -1],
        "up": [0, 1, 0],
        "effects": { "aberration": true, "doppler": false, "headlight": false }
    }
}
"""


def main():
    glb = Glb("gamow")
    town = Town(glb)
    paints(town)
    add_street(town)
    add_window_parts(town)
    add_houses(town)
    add_walls(town)
    add_tower(town)
    add_furniture(town)
    add_clouds(town)
    add_tram(town)
    add_cyclist(town)
    out = Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "gamow.glb"
    glb.write(out)
    lines = ",\n".join("        " + json.dumps(body) for body in bodies())
    text = out.with_suffix(".json") if len(sys.argv) > 1 else HERE.parents[1] / "config/scenes/gamow.json"
    text.write_text(SCENE.replace("BODIES", lines))


if __name__ == "__main__":
    main()
