#!/usr/bin/env python3
"""Writes left.data and right.data, the meshes of the layout dome2: python3 make.py [FOLDER].

To be measured: the dome's radius; where each projector's lens is, in the dome's own frame (+x right, +y the zenith, -z the
front of the rim; the dome's lean needs no number here, the layout has it as tilt_deg); and each lens's picture: half its width
and its lower and upper edge one metre before the lens, where the lens looks level across the dome.

A mesh is in Paul Bourke's format (paulbourke.net/dataformats/meshwarp): "2", columns and rows, then x y u v i for each point from
the lower left: x, y the place in the projector's picture, from -aspect to aspect and -1 to 1; u, v the place in the domemaster's
square from its lower left; i the brightness. A point that lies well below the dome's rim is a hole: u, v and i of -1.
"""
import math
import pathlib
import sys

RADIUS_M = 4.0  # of the dome
LENS_M = 3.9, -0.1, 0.0  # of the right projector: at the rim, a hand below the spring line; the left one mirrors it
HALF_WIDTH = 1.2  # of the picture one metre before the lens: an ultra short throw lens, 1 / 2.4 = 0.42
LOWER, UPPER = -0.0875, 1.4125  # its edges; the lens is shifted so that the picture stands above it
ASPECT = 1920 / 1200
COLUMNS, ROWS = 81, 51  # cells of 24 pixels: between the points a straight line is right to a third of a pixel
DIAMETER = 0.9  # of the domemaster's circle in its square, as in dome2.json
RIM = 1.08  # how far points reach beyond the circle, in its radius


def lit(lens, x, y):
    """The dome's point, from its centre, that a place in the picture of the projector at `lens` lights."""
    inwards = -math.copysign(1, lens[0])  # the projector looks level across the dome, to the other side
    across = x / ASPECT * HALF_WIDTH
    ray = inwards, LOWER + (y + 1) / 2 * (UPPER - LOWER), inwards * across  # its right hand is at +z when it looks along +x
    # |lens + t ray| = radius; the lens is inside the dome, so one of the two t is above 0.
    a = sum(r * r for r in ray)
    b = sum(l * r for l, r in zip(lens, ray))
    c = sum(l * l for l in lens) - RADIUS_M**2
    t = (-b + math.sqrt(b * b - a * c)) / a
    return [l + t * r for l, r in zip(lens, ray)]


def domemaster(point):
    """u, v of a dome's point, or None well below the rim. The front (-z) is at the bottom, the right on the right."""
    right, up, front = point[0], point[1], -point[2]
    sideways = math.hypot(right, front)
    radius = math.atan2(sideways, up) / (math.pi / 2)
    if radius > RIM:
        return None
    scale = radius * DIAMETER / 2 / sideways if sideways > 0 else 0
    return 0.5 + scale * right, 0.5 - scale * front


def mesh(lens):
    lines = ["2", f"{COLUMNS} {ROWS}"]
    for row in range(ROWS):
        y = 2 * row / (ROWS - 1) - 1
        for column in range(COLUMNS):
            x = (2 * column / (COLUMNS - 1) - 1) * ASPECT
            uv = domemaster(lit(lens, x, y))
            numbers = [round(n, 5) + 0.0 for n in (x, y, *(uv or (-1, -1)))]
            lines.append(" ".join(f"{n:.5f}" for n in numbers) + (" 1" if uv else " -1"))
    return "\n".join(lines) + "\n"


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent
    x, y, z = LENS_M
    (folder / "left.data").write_text(mesh((-x, y, z)), encoding="ascii", newline="\n")
    (folder / "right.data").write_text(mesh((x, y, z)), encoding="ascii", newline="\n")


if __name__ == "__main__":
    main()
