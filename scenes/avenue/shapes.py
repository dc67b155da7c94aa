"""Shapes as lists of vertices and triangles, counter-clockwise from outside. Heights are y; angles start at +z, towards +x."""
from math import cos, pi, sin, sqrt


class Shape:
    def __init__(self):
        self.positions, self.normals, self.uvs, self.indices = [], [], [], []

    def vertex(self, position, normal, uv):
        self.positions.append(position)
        self.normals.append(normal)
        self.uvs.append(uv)
        return len(self.positions) - 1

    def add(self, other, at=(0, 0, 0), turn=(0, 0, 0, 1)):
        """turn: a quaternion, about the other's own origin."""
        first = len(self.positions)
        still = tuple(at) == (0, 0, 0) and tuple(turn) == (0, 0, 0, 1)
        self.positions += other.positions if still else [
            tuple(a + p for a, p in zip(at, turned(turn, position))) for position in other.positions]
        self.normals += other.normals if still else [turned(turn, normal) for normal in other.normals]
        self.uvs += other.uvs
        self.indices += [first + i for i in other.indices]


def unit(v):
    length = sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def turned(quaternion, v):
    x, y, z, w = quaternion
    t = tuple(2 * part for part in cross((x, y, z), v))
    return tuple(a + w * b + c for a, b, c in zip(v, t, cross((x, y, z), t)))


def grid(columns, rows, at, cut_first=False, cut_last=False):
    """A patch: at(u, v) gives position, normal and texture coordinates, u to the right and v up seen from outside.
    A row that is one point (a pole) is cut: its triangles without area are left out."""
    shape = Shape()
    for j in range(rows + 1):
        for i in range(columns + 1):
            shape.vertex(*at(i / columns, j / rows))
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            c = a + columns + 1
            if not (cut_first and j == 0):
                shape.indices += [a, a + 1, c + 1]
            if not (cut_last and j == rows - 1):
                shape.indices += [a, c + 1, c]
    return shape


def smooth(surface):
    """A function for grid() from one that gives position and texture coordinates only; the normal by differences."""
    def at(u, v):
        step = 1e-5
        position, uv = surface(u, v)
        along, up = ([(q - p) for p, q in zip(surface(*a)[0], surface(*b)[0])]
                     for a, b in (((u - step, v), (u + step, v)), ((u, v - step), (u, v + step))))
        return position, unit(cross(along, up)), uv
    return at


def revolved(columns, rows, profile, scale):
    """profile(t), from below to above, gives radius and height; texture coordinates are lengths divided by scale."""
    def surface(u, v):
        radius, y = profile(v)
        angle = 2 * pi * u
        return (radius * sin(angle), y, radius * cos(angle)), (u, -y / scale)
    return grid(columns, rows, smooth(surface))


def moulding(columns, radius, y, bulge, scale):
    """A half-round ring around a column."""
    return revolved(columns, 8, lambda t: (radius + bulge * cos(pi * (t - 0.5)), y + bulge * sin(pi * (t - 0.5))), scale)


def box(half, centre=(0, 0, 0), uv=lambda face, s, t: (s, t)):
    """Faces +x -x +y -y +z -z; uv(face, s, t) from the face's own 0..1, t downwards."""
    shape = Shape()
    frames = [((0, 0, -1), (0, 1, 0)), ((0, 0, 1), (0, 1, 0)), ((1, 0, 0), (0, 0, -1)), ((1, 0, 0), (0, 0, 1)),
              ((1, 0, 0), (0, 1, 0)), ((-1, 0, 0), (0, 1, 0))]
    for face, (right, up) in enumerate(frames):
        out = cross(right, up)
        first = len(shape.positions)
        for s, t in ((0, 1), (1, 1), (1, 0), (0, 0)):
            position = tuple(c + h * (o + r * (2 * s - 1) + w * (1 - 2 * t))
                             for c, h, o, r, w in zip(centre, half, out, right, up))
            shape.vertex(position, out, uv(face, s, t))
        shape.indices += [first + i for i in (0, 1, 2, 0, 2, 3)]
    return shape


def fan(rim):
    """A flat shape around the middle of its corners, all of which the middle sees; counter-clockwise from the front."""
    middle = tuple(sum(p[i] for p in rim) / len(rim) for i in range(3))
    normal = unit(cross(*(tuple(b - a for a, b in zip(middle, p)) for p in rim[:2])))
    shape = Shape()
    for p in [middle, *rim]:
        shape.vertex(p, normal, (p[0], -p[1]))
    for i in range(1, len(rim) + 1):
        shape.indices += [0, i, i % len(rim) + 1]
    return shape


def upright(left, bottom, right, top, z):
    """A rectangle that faces +z."""
    return fan([(left, bottom, z), (right, bottom, z), (right, top, z), (left, top, z)])


def level(left, near, right, far, y):
    """A rectangle that faces up; far is the smaller z."""
    return fan([(left, y, near), (right, y, near), (right, y, far), (left, y, far)])


def sphere(columns, rows, radius):
    """Texture coordinates of a map of the whole globe: longitude 0 at +z and at u = 1/2, north up."""
    def at(u, v):
        longitude, latitude = 2 * pi * (u - 0.5), pi * (v - 0.5)
        ring = cos(latitude) if 0 < v < 1 else 0.0
        normal = (ring * sin(longitude), sin(latitude), ring * cos(longitude))
        return tuple(radius * x for x in normal), normal, (u, 1 - v)
    return grid(columns, rows, at, True, True)


def dial(radius, sides=96):
    """Faces +z; texture coordinates from 0 to 1 across it, as a clock wants them."""
    shape = Shape()
    shape.vertex((0, 0, 0), (0, 0, 1), (0.5, 0.5))
    for i in range(sides):
        x, y = cos(2 * pi * i / sides), sin(2 * pi * i / sides)
        shape.vertex((radius * x, radius * y, 0), (0, 0, 1), (0.5 + 0.5 * x, 0.5 - 0.5 * y))
        shape.indices += [0, i + 1, (i + 1) % sides + 1]
    return shape


def torus(columns, rows, radius, tube):
    """Around the z axis."""
    def at(u, v):
        a, b = 2 * pi * u, 2 * pi * v
        normal = (cos(b) * cos(a), cos(b) * sin(a), sin(b))
        ring = radius + tube * cos(b)
        return (ring * cos(a), ring * sin(a), tube * sin(b)), normal, (u, v)
    return grid(columns, rows, at)


def cylinder_along_x(columns, rows, length, radius, uv):
    """Closed. uv(along, around) from lengths along the axis and along the rim."""
    def side(u, v):
        angle = 2 * pi * v
        normal = (0.0, cos(angle), -sin(angle))
        along = length * (u - 0.5)
        return (along, radius * normal[1], radius * normal[2]), normal, uv(along, radius * angle)
    shape = grid(columns, rows, lambda u, v: side(u, v))
    for end in (-1, 1):
        middle = shape.vertex((end * length / 2, 0.0, 0.0), (float(end), 0.0, 0.0), uv(0, 0))
        rim = []
        for j in range(rows + 1):
            angle = 2 * pi * j / rows
            y, z = radius * cos(angle), -radius * sin(angle)
            rim.append(shape.vertex((end * length / 2, y, z), (float(end), 0.0, 0.0), uv(z, y)))
        for a, b in zip(rim, rim[1:]):
            shape.indices += [middle, b, a] if end > 0 else [middle, a, b]
    return shape


def bar(columns, start, end, radius):
    """A round bar from one place to another, open at its ends."""
    along = unit(tuple(b - a for a, b in zip(start, end)))
    side = unit(cross(along, (0, 0, 1) if abs(along[2]) < 0.9 else (1, 0, 0)))
    other = cross(along, side)
    shape = Shape()
    for i in range(columns + 1):
        c, s = cos(2 * pi * i / columns), sin(2 * pi * i / columns)
        normal = tuple(c * a + s * b for a, b in zip(side, other))
        for place, v in ((start, 0), (end, 1)):
            shape.vertex(tuple(p + radius * n for p, n in zip(place, normal)), normal, (i / columns, v))
    for i in range(0, 2 * columns, 2):
        shape.indices += [i, i + 2, i + 3, i, i + 3, i + 1]
    return shape


def extruded(outline, low, high):
    """A flat outline of (x, y), counter-clockwise from +z and seen whole from its middle, from z = low to high."""
    shape = Shape()
    shape.add(fan([(x, y, high) for x, y in outline]))
    shape.add(fan([(x, y, low) for x, y in reversed(outline)]))
    for (x0, y0), (x1, y1) in zip(outline, outline[1:] + outline[:1]):
        shape.add(fan([(x0, y0, high), (x0, y0, low), (x1, y1, low), (x1, y1, high)]))
    return shape


def quaternion(axis, angle):
    s = sin(angle / 2)
    return (axis[0] * s, axis[1] * s, axis[2] * s, cos(angle / 2))


def then(first, second):
    """The rotation that does `first` and after it `second`."""
    ax, ay, az, aw = second
    bx, by, bz, bw = first
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)
