"""What stands around a world: pavements, mountains, trees, clouds, benches. Shapes are shared by as many nodes as want them."""
import random
from math import cos, pi, sin

import shapes


def quad(a, b, c, d):
    """A flat piece with four vertices, counter-clockwise from the front."""
    shape = shapes.Shape()
    normal = shapes.unit(shapes.cross(tuple(q - p for p, q in zip(a, b)), tuple(q - p for p, q in zip(a, d))))
    for p in (a, b, c, d):
        shape.vertex(p, normal, (p[0], p[2]))
    shape.indices += [0, 1, 2, 0, 2, 3]
    return shape


def slab(left, near, right, far, y):
    """A rectangle that faces up; far is the smaller z."""
    return quad((left, y, near), (right, y, near), (right, y, far), (left, y, far))


def pavement(left, far, columns, rows, side, y, choose=lambda i, j: (i + j) % 2, kinds=2):
    """Squares from the far left corner on, as so many shapes; choose: the shape of column i and row j, or None for no square."""
    stones = [shapes.Shape() for _ in range(kinds)]
    for i in range(columns):
        for j in range(rows):
            kind = choose(i, j)
            if kind is not None:
                x, z = left + side * i, far + side * j
                stones[kind].add(slab(x, z + side, x + side, z, y))
    return stones


def around(left, near, right, far, reach, y):
    """The ground from a rectangle's edges out to `reach` on all sides, in four pieces."""
    ground = shapes.Shape()
    for piece in ((-reach, reach, reach, near), (-reach, far, reach, -reach), (-reach, near, left, far), (right, near, reach, far)):
        ground.add(slab(*piece, y))
    return ground


def skyline(seed, least, most, waves=7):
    """A function of the angle: heights of peaks all around, from about `least` to `most`."""
    rng = random.Random(seed)
    terms = [(rng.randint(2 + 2 * k, 4 + 4 * k), rng.uniform(0, 2 * pi), 0.72 ** k) for k in range(waves)]
    whole = sum(weight for _, _, weight in terms)

    def height(a):
        return least + (most - least) * sum(w * (1 - abs(sin(0.5 * n * a * 2 + p))) for n, p, w in terms) / whole
    return height


def mountains(radius, deep, height, y=0.0, columns=144, rows=(0.0, 0.35, 0.7, 1.0), ribs=0.05):
    """A ring of mountains around the origin that faces inwards, from their feet to their crest, `deep` farther out."""
    def surface(u, v):
        a = 2 * pi * u
        part = rows[0] + (rows[-1] - rows[0]) * v
        bulge = ribs * radius * (sin(19 * a + 4 * part) + 0.6 * sin(43 * a - 3 * part)) * part * (1.15 - part)
        r = radius + deep * part + bulge
        return (r * sin(a), y + height(a) * part, -r * cos(a)), (u, v)
    return shapes.grid(columns, len(rows) - 1, shapes.smooth(surface))


def crown(balls, seed, columns=9, rows=5):
    """Leaves as uneven balls: (radius, middle) of each."""
    rng = random.Random(seed)
    shape = shapes.Shape()
    for radius, centre in balls:
        ball = shapes.sphere(columns, rows, 1)
        uneven = {}
        for i, p in enumerate(ball.positions):
            key = tuple(round(x, 6) + 0.0 for x in p)
            uneven.setdefault(key, radius * rng.uniform(0.90, 1.08))
            ball.positions[i] = tuple(c + uneven[key] * x for c, x in zip(centre, p))
        shape.add(ball)
    return shape


def tree():
    """A broad tree 4.6 high as leaves, lighter leaves, and a trunk."""
    dark = crown([(1.15, (0, 3.2, 0)), (0.85, (-0.65, 2.7, 0.3)), (0.70, (0.2, 3.95, 0.1))], 11)
    light = crown([(0.90, (0.65, 2.65, 0.35)), (0.80, (0.1, 2.7, -0.65))], 12)
    return dark, light, shapes.bar(8, (0, 0, 0), (0, 2.6, 0), 0.15)


def fir(sides=12):
    """A fir 3.1 high as its green and its stem."""
    green = shapes.Shape()
    for low, high, r in ((0.5, 1.9, 0.75), (1.2, 2.5, 0.58), (1.9, 3.1, 0.4)):
        green.add(shapes.revolved(sides, 1, lambda t: (r * (1 - t) + 0.002, low + (high - low) * t), 1))
        green.add(shapes.fan([(r * sin(-2 * pi * k / sides), low, r * cos(-2 * pi * k / sides)) for k in range(sides)]))
    return green, shapes.bar(8, (0, 0, 0), (0, 0.7, 0), 0.12)


def cloud(seed):
    """A heap of flattened balls some 40 long."""
    rng = random.Random(seed)
    shape = shapes.Shape()
    for k in range(7):
        r = rng.uniform(4, 7.5)
        shape.add(shapes.sphere(10, 6, r), (6.0 * (k - 3) + rng.uniform(-1, 1), rng.uniform(0, 3) - 0.3 * (k - 3) ** 2, rng.uniform(-5, 5)))
    shape.positions = [(x, y * (0.75 if y > 0 else 0.35), z) for x, y, z in shape.positions]
    return shape


def house(half, eaves, deep, ridge):
    """A house with its gable towards +z, as walls, roof and windows."""
    walls = shapes.extruded([(-half, 0), (half, 0), (half, eaves), (0, ridge), (-half, eaves)], -deep, 0)
    roof, panes = shapes.Shape(), shapes.Shape()
    over = 0.12 * half
    for side in (-1, 1):
        low, high = (side * (half + over), eaves - over * (ridge - eaves) / half), (0, ridge)
        for lift, way in ((0.10 * half, 1), (0.02 * half, -1)):
            corners = [(low[0], low[1] + lift, over), (high[0], high[1] + lift, over),
                       (high[0], high[1] + lift, -deep - over), (low[0], low[1] + lift, -deep - over)]
            roof.add(quad(*(corners if side * way > 0 else corners[::-1])))
        roof.add(quad(*[(x, y + lift, over) for (x, y), lift in
                        ((low, 0.02 * half), (high, 0.02 * half), (high, 0.10 * half), (low, 0.10 * half))][::1 if side < 0 else -1]))
        w, h = 0.16 * half, 0.13 * eaves
        for y in (0.35 * eaves, 0.75 * eaves):
            panes.add(quad(*((side * 0.5 * half + dx * w, y + dy * h, 0.02) for dx, dy in ((-1, -1), (1, -1), (1, 1), (-1, 1)))))
            for z in (-0.3 * deep, -0.7 * deep):
                corners = [(side * (half + 0.02), y + dy * h, z + dz * w) for dz, dy in ((1, -1), (-1, -1), (-1, 1), (1, 1))]
                panes.add(quad(*(corners if side > 0 else corners[::-1])))
    return walls, roof, panes


def bench():
    """A bench 1.7 long whose back is at -z, as wood and legs."""
    wood, legs = shapes.Shape(), shapes.Shape()
    for z in (-0.16, 0, 0.16):
        wood.add(shapes.box((0.85, 0.025, 0.065), (0, 0.45, z)))
    for y in (0.65, 0.82):
        wood.add(shapes.box((0.85, 0.06, 0.02), (0, y, -0.24)))
    for x in (-0.7, 0.7):
        legs.add(shapes.box((0.03, 0.22, 0.2), (x, 0.22, 0)))
        legs.add(shapes.box((0.03, 0.25, 0.025), (x, 0.65, -0.25)))
    return wood, legs


class Kit:
    """Meshes by name that many nodes share; each may be of several parts with a paint each."""
    def __init__(self, glb):
        self.glb, self.paints, self.things = glb, {}, {}

    def paint(self, name, colour, emissive=None, **beyond):
        """A matt material; beyond: what colours don't tell, docs/scenes.md."""
        self.paints[name] = self.glb.material(name, colour, emissive=emissive, starbow=beyond or None)

    def make(self, name, *parts):
        """parts: a shape and the name of its paint, in turns."""
        self.things[name] = [self.glb.mesh(name if len(parts) == 2 else f"{name}, {paint}", self.glb.geometry(shape, uvs=False),
                                           self.paints[paint]) for shape, paint in zip(parts[::2], parts[1::2])]

    def put(self, name, place=(0, 0, 0), turn=0.0, size=1.0):
        """turn: about the y axis, radians; size: one number, or one for each axis."""
        way = tuple(round(q, 6) for q in shapes.quaternion((0, 1, 0), turn)) if turn else None
        scale = None if size == 1.0 else tuple(round(s, 4) for s in (size if isinstance(size, tuple) else (size,) * 3))
        for mesh in self.things[name]:
            self.glb.node(name, mesh, tuple(round(p, 3) for p in place), way, scale)

    def build(self, name, *parts):
        """What stands in one place alone."""
        self.make(name, *parts)
        self.put(name)
