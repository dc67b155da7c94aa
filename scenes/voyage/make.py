#!/usr/bin/env python3
"""Writes voyage.glb: a black speck of a millionth of a light-year at the origin. The voyage's world is its stars; but a world has
a surface. Needs Python 3's own library only; the same bytes come out every time."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
from glb import Glb


def main():
    glb = Glb("voyage")
    black = glb.material("black", (0, 0, 0))
    shape = shapes.Shape()
    shape.add(shapes.fan([(0, 0, 0), (1e-6, 0, 0), (0, 1e-6, 0)]))
    glb.node("speck", glb.mesh("speck", glb.geometry(shape), black))
    glb.write(sys.argv[1] if len(sys.argv) > 1 else HERE / "voyage.glb")


if __name__ == "__main__":
    main()
