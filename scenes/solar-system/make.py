#!/usr/bin/env python3
"""Writes solar-system.glb: a black speck of three millimetres at the origin, inside the Earth. This world is its globes; but a world has
a surface. Needs Python 3's own library only; the same bytes come out every time."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
from glb import Glb


def main():
    glb = Glb("solar-system")
    black = glb.material("black", (0, 0, 0))
    shape = shapes.Shape()
    shape.add(shapes.fan([(0, 0, 0), (1e-11, 0, 0), (0, 1e-11, 0)]))
    glb.node("speck", glb.mesh("speck", glb.geometry(shape), black))
    glb.write(sys.argv[1] if len(sys.argv) > 1 else HERE / "solar-system.glb")


if __name__ == "__main__":
    main()
