"""Writes a world of one black speck at the origin: a world has a surface, also where its stars or its globes are all that shows."""
import sys
from pathlib import Path

import shapes
from glb import Glb


def write(world, size):
    """scenes/WORLD/WORLD.glb, or the file that the command line names. size: scene units."""
    glb = Glb(world)
    black = glb.material("black", (0, 0, 0))
    shape = shapes.Shape()
    shape.add(shapes.fan([(0, 0, 0), (size, 0, 0), (0, size, 0)]))
    glb.node("speck", glb.mesh("speck", glb.geometry(shape), black))
    glb.write(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent / world / f"{world}.glb")
