"""Clocks for a world: a dial, its rim, and a case behind it or a second dial on its back."""
from math import pi

import shapes


class Dials:
    """Clocks of one radius and one zero; as many as are wanted share their meshes."""
    def __init__(self, glb, radius, zero_s=0, face=(0.86, 0.83, 0.74), rim=(0.62, 0.42, 0.14), marks=None, name="dial", sides=64):
        """marks: the light of hands and figures; without it they are black."""
        self.glb, self.radius = glb, radius
        case = shapes.revolved(sides // 2, 1, lambda t: (radius * 1.02, radius * (0.16 * t - 0.08)), 1)
        self.dial = glb.mesh(name, glb.geometry(shapes.dial(radius, sides)),
                             glb.material(name, face, emissive=marks, starbow={"clock": {"zero_s": zero_s}}))
        metal = glb.material(f"{name} rim", rim)
        self.rim = glb.mesh(f"{name} rim", glb.geometry(shapes.torus(sides, 8, radius * 1.04, radius * 0.07)), metal)
        self.case = glb.mesh(f"{name} case", glb.geometry(case), metal)

    def put(self, name, place, below=None, turn=0, both=False):
        """Faces +z, or what a turn about y makes of it; with `both` the other way as well."""
        x, y, z = place
        deep = 0.08 * self.radius if both else 0
        for back in (0, pi) if both else (0,):
            way = shapes.quaternion((0, 1, 0), turn + back)
            ahead = shapes.turned(way, (0, 0, deep))
            for mesh in (self.dial, self.rim):
                self.glb.node(name, mesh, (x + ahead[0], y, z + ahead[2]), way, below=below)
        if both:
            drum = shapes.then(shapes.quaternion((1, 0, 0), pi / 2), shapes.quaternion((0, 1, 0), turn))
            self.glb.node(f"{name} case", self.case, place, drum, below=below)
