#!/usr/bin/env python3
"""Writes rainbow.glb: a lamp four thousand light-seconds long that shines in one colour alone, a line at 450 nm, inside white
hoops, between rows of pillars. It lies along x at z = -3; the visitor flies beside it. Needs Python 3's own library only; the
same bytes come out every time."""
import sys
from math import cos, pi, sin
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
import textures
from glb import Glb

LINE_NM = 450
AWAY, RADIUS = 3, 0.6
PIECE, PIECES = 40, 100  # a texture's coordinates stay small within a piece
# Seen in one colour only the luminance of the emission counts, 0.25; elsewhere it is drawn as this blue.
EMISSION = (0.38, 0.14, 0.95)


def tube():
    """A piece of the lamp, open at both ends, with dots about a quarter apart."""
    around, apart = 15, 0.25

    def side(u, v):
        angle = 2 * pi * v
        normal = (0.0, cos(angle), -sin(angle))
        along = PIECE * (u - 0.5)
        return (along, RADIUS * normal[1], RADIUS * normal[2]), normal, (along / (2 * apart), around * v)
    return shapes.grid(4, 64, side)


def pillar():
    """Slender, four-sided, tapering to a point."""
    shape = shapes.Shape()
    for k in range(4):
        rim = [(r * sin(pi / 2 * (k + s)), y, r * cos(pi / 2 * (k + s)))
               for r, y, s in ((0.5, -7, -0.5), (0.5, -7, 0.5), (0.3, 7, 0.5), (0.3, 7, -0.5))]
        shape.add(shapes.fan(rim))
        shape.add(shapes.fan([rim[3], rim[2], (0, 8, 0)]))
    return shape


def main():
    glb = Glb("rainbow")
    dots = glb.texture(textures.stipple())
    blue = glb.material("450 nm", (0, 0, 0), emissive=EMISSION, emissive_texture=dots,
                        starbow={"emission": {"line_nm": LINE_NM}})
    lamp = glb.mesh("lamp", glb.geometry(tube()), blue)
    for i in range(PIECES):
        glb.node("lamp", lamp, (PIECE * (i - (PIECES - 1) / 2), 0, -AWAY))

    white = glb.material("white", (0.8, 0.8, 0.8))
    hoop = glb.mesh("hoop", glb.geometry(shapes.torus(64, 10, 1.0, 0.04)), white)
    quarter = shapes.quaternion((0, 1, 0), pi / 2)
    for i in range(-50, 51):
        glb.node("hoop", hoop, (20 * i, 0, -AWAY), quarter)

    stone = glb.material("stone", (0.52, 0.47, 0.40))
    mesh = glb.mesh("pillar", glb.geometry(pillar()), stone)
    for i in range(-40, 40):
        for z in (-16, 12):
            glb.node("pillar", mesh, (24 * i + (12 if z > 0 else 0), 0, z))
    glb.write(sys.argv[1] if len(sys.argv) > 1 else HERE / "rainbow.glb")


if __name__ == "__main__":
    main()
