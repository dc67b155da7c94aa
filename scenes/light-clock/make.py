#!/usr/bin/env python3
"""Writes light-clock.glb, two mirrors 2 light-seconds apart and what a pulse between them is made of, on a promenade by a lake in
the evening, and with it config/scenes/light-clock.json, where each flash of each pulse is a body of its own. Needs Python 3's own
library only; the same bytes come out every time.

A pulse is flashes: balls that rest in their clock, each for a good quarter of a second of its time, one after the other where the
light is. Where a flash of the moving clock was, a spark stays in the world, and they draw its way."""
import json
import sys
from math import cos, pi, sin
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "avenue"))
import shapes
from dials import Dials
from glb import Glb
from land import Kit, bench, mountains, skyline, slab

APART = 2  # of the mirrors, light-seconds
STEP, STAYS = 0.25, 0.3125  # from flash to flash, and how long each is there, seconds of its clock: one is always seen whole
RADIUS = 0.08  # a flash's; its limb is seen as it was so much earlier than its front
PLACES = 8  # flashes from mirror to mirror
BEHIND = -1.75  # where the moving clock passes
WIDE, NEAR, FAR = 40, 18, -10  # the promenade's half width, and its edges before and behind
GROUND = -0.75
BEFORE = 1000  # seconds of the moving clock's worldline before 0
# beta 0.6: gamma 5/4 and gamma beta 3/4, and with STEP and STAYS all events are exact in binary, so that all flashes share one frame.
GAMMA, PROPER = 1.25, 0.75
RESTING = (-16, 44)  # seconds of its own during which a clock's pulse runs
MOVING = (-16, 16)


def mirror():
    """A disc that shines downwards, its back and edge above."""
    shape = shapes.revolved(64, 6, lambda t: (0.62 + 0.03 * sin(pi * t), 0.10 * t), 1)
    shape.add(shapes.fan([(0.62 * sin(2 * pi * k / 64), 0.10, 0.62 * cos(2 * pi * k / 64)) for k in range(64)]))
    return shape


def glass():
    return shapes.fan([(0.62 * sin(-2 * pi * k / 64), 0, 0.62 * cos(-2 * pi * k / 64)) for k in range(64)])


def add_clock(glb, name, paint, dials, place, moves):
    clock = glb.group(name) if moves else None
    silver = glb.material("silver", (0.80, 0.84, 0.88), emissive=(0.10, 0.11, 0.12))
    metal = glb.material(f"{name} paint", paint)
    back, front = (glb.mesh(part, glb.geometry(shape), material)
                   for part, shape, material in (("mirror", mirror(), metal), ("glass", glass(), silver)))
    upside_down = shapes.quaternion((1, 0, 0), pi)
    x, _, z = place
    for y, turn in ((APART + RADIUS, None), (-RADIUS, upside_down)):  # a flash's radius beyond where its middle turns
        for mesh in (back, front):
            glb.node(glb.doc["meshes"][mesh]["name"], mesh, (x, y, z), turn, below=clock)
    rods = shapes.Shape()
    for k in range(3):
        angle = 2 * pi * (k + 0.5) / 3 + pi / 2
        a, b = 0.60 * sin(angle), 0.60 * cos(angle)
        rods.add(shapes.bar(12, (a, -RADIUS, b), (a, APART + RADIUS, b), 0.022))
    rods.add(shapes.bar(16, (0, GROUND + 0.05, 0), (0, -0.2, 0), 0.09))
    rods.add(shapes.box((0.42, 0.05, 0.42), (0, GROUND + 0.07, 0)))
    glb.put("rods", rods, metal, place, below=clock)
    dials.put("dial", (x, APART + 0.34 + dials.radius, z), below=clock, both=True)


def add_pulse(glb):
    """A flash and a spark for each place from the lower mirror to the upper one; config/scenes/light-clock.json says when."""
    flash = glb.mesh("flash", glb.geometry(shapes.sphere(20, 10, RADIUS)),
                     glb.material("flash", (0, 0, 0), emissive=(3.2, 2.7, 1.2)))
    spark = glb.mesh("spark", glb.geometry(shapes.sphere(8, 4, 0.038)),
                     glb.material("spark", (0, 0, 0), emissive=(1.4, 0.75, 0.15)))
    for k in range(PLACES + 1):
        glb.node(f"flash {k}", flash, (0, APART * k / PLACES, 0))
        glb.node(f"spark {k}", spark, (0, APART * k / PLACES, 0))


def add_floor(glb, kit):
    """Tiles of 2 light-seconds in rows that share one mesh, a field for each light-second, and the lane of the moving clock."""
    stones = (shapes.Shape(), shapes.Shape())
    for i in range(WIDE):
        x = 2 * i - WIDE
        stones[i % 2].add(slab(x, 1, x + 2, -1, 0))
    kit.paint("light stones", (0.165, 0.160, 0.175))
    kit.paint("dark stones", (0.105, 0.105, 0.125))
    kit.make("row", stones[0], "light stones", stones[1], "dark stones")
    for j in range((NEAR - FAR) // 2):
        kit.put("row", (0, GROUND, FAR + 2 * j + 1), pi if j % 2 else 0)
    field = glb.geometry(shapes.box((0.5, 0.06, 0.12)), uvs=False)
    paints = [glb.mesh(f"{name} field", field, glb.material(f"{name} field", colour))
              for name, colour in (("white", (0.75, 0.75, 0.72)), ("red", (0.55, 0.07, 0.05)))]
    for x in range(-24, 24):
        glb.node("field", paints[x % 2], (x + 0.5, GROUND + 0.06, 1.1))
    lane = slab(-WIDE, BEHIND + 0.55, WIDE, BEHIND - 0.55, GROUND + 0.012)
    glb.put("lane", lane, glb.material("lane", (0.03, 0.11, 0.14)))


def balusters():
    """Four light-seconds of a balustrade along x, 1 high, from pier to pier."""
    shape = shapes.Shape()
    shape.add(shapes.box((2.0, 0.05, 0.10), (0, 0.05, 0)))
    shape.add(shapes.box((2.0, 0.05, 0.12), (0, 0.80, 0)))
    shape.add(shapes.box((0.16, 0.48, 0.16), (-2.0, 0.48, 0)))
    shape.add(shapes.box((0.20, 0.035, 0.20), (-2.0, 0.99, 0)))
    for k in range(7):
        x = 0.5 * (k - 3)
        shape.add(shapes.bar(6, (x, 0.1, 0), (x, 0.75, 0), 0.07))
    return shape


def lamp_post():
    """An iron post 2.3 high that carries a globe of light 0.2 wide: the iron, and the globe."""
    post = shapes.revolved(12, 8, lambda t: (0.10 - 0.065 * min(1, 2.5 * t) + (0.04 if t < 0.07 else 0), 2.1 * t), 1)
    post.add(shapes.moulding(12, 0.045, 2.08, 0.04, 1))
    globe = shapes.Shape()
    globe.add(shapes.sphere(14, 8, 0.17), (0, 2.28, 0))
    return post, globe


def add_promenade(kit):
    """Behind the lane: lamps, benches and a balustrade, and beyond it a lake between mountains."""
    kit.paint("balustrade", (0.40, 0.38, 0.38))
    kit.paint("iron", (0.03, 0.04, 0.045))
    kit.paint("globe of light", (0.2, 0.16, 0.1), (1.25, 0.66, 0.22))
    kit.paint("wood", (0.22, 0.11, 0.05))
    kit.make("balusters", balusters(), "balustrade")
    post, globe = lamp_post()
    kit.make("lamp post", post, "iron", globe, "globe of light")
    wood, legs = bench()
    kit.make("bench", wood, "wood", legs, "iron")
    for k in range(-WIDE // 4, WIDE // 4):
        kit.put("balusters", (4 * k + 2, GROUND, -5.4))
        if k % 2:
            kit.put("lamp post", (4 * k, GROUND, -4.6))
            kit.put("lamp post", (4 * k + 4, GROUND, 15.5))
        else:
            kit.put("bench", (4 * k + 2, GROUND, -4.7))
    kit.paint("quay", (0.14, 0.135, 0.145))
    kit.paint("lake", (0.035, 0.075, 0.125))
    kit.build("quay", ground_before_the_lake(), "quay")
    kit.build("lake", slab(-420, FAR, 420, -420, GROUND - 0.5), "lake")


def ground_before_the_lake():
    """The ground to both sides of the tiles and behind the visitor."""
    ground = slab(-420, 420, 420, NEAR, GROUND - 0.01)
    for left, right in ((-420, -WIDE), (WIDE, 420)):
        ground.add(slab(left, NEAR, right, FAR, GROUND - 0.01))
    return ground


def pavilion():
    """A round temple 5 high: steps, columns and a ring above them, and its dome."""
    stone, dome = shapes.Shape(), shapes.Shape()
    for radius, low in ((2.5, 0.0), (2.2, 0.15)):
        stone.add(shapes.revolved(36, 1, lambda t: (radius, low + 0.15 * t), 1))
        stone.add(shapes.fan([(radius * sin(2 * pi * k / 36), low + 0.15, radius * cos(2 * pi * k / 36)) for k in range(36)]))
    for k in range(8):
        a = 2 * pi * (k + 0.5) / 8
        stone.add(shapes.revolved(14, 3, lambda t: (0.17 - 0.03 * t, 2.6 * t), 1), (1.85 * sin(a), 0.3, 1.85 * cos(a)))
    stone.add(shapes.revolved(36, 1, lambda t: (2.1, 2.9 + 0.4 * t), 1))
    stone.add(shapes.fan([(2.1 * sin(-2 * pi * k / 36), 2.9, 2.1 * cos(-2 * pi * k / 36)) for k in range(36)]))
    dome.add(shapes.revolved(36, 8, lambda t: (2.15 * cos(1.55 * t) + 1e-3, 3.3 + 1.5 * sin(1.55 * t)), 1))
    dome.add(shapes.sphere(12, 6, 0.16), (0, 4.9, 0))
    return stone, dome


def add_far(kit):
    """Two pavilions on the shore, and mountains around the lake."""
    kit.paint("marble", (0.52, 0.47, 0.44))
    kit.paint("copper", (0.16, 0.34, 0.30))
    stone, dome = pavilion()
    kit.make("pavilion", stone, "marble", dome, "copper")
    for x in (-17, 17):
        kit.put("pavilion", (x, GROUND, -7.6))
    kit.paint("near mountains", (0.060, 0.075, 0.105))
    kit.paint("far mountains", (0.120, 0.150, 0.230))
    kit.build("near mountains", mountains(150, 50, skyline(4, 4, 24), GROUND - 0.6, 120), "near mountains")
    kit.build("far mountains", mountains(260, 90, skyline(31, 20, 92), GROUND - 0.6), "far mountains")


def bodies():
    """Of the scene: the moving clock, the flashes of both, the sparks of the moving one."""
    def event(t, x, z):
        return {"time": t, "position": [x, 0, z]}

    def runs(span):
        """Own time of each flash and its place between the mirrors, from -16 s on: up, and down again."""
        count = int((span[1] - span[0]) / STEP)
        for n in range(count):
            k = n % (2 * PLACES)
            yield span[0] + STEP * n, k if k <= PLACES else 2 * PLACES - k

    out = [{"name": "moving clock", "nodes": ["moving clock"], "worldline": [
        event(-GAMMA * BEFORE, -PROPER * BEFORE, BEHIND), event(GAMMA * BEFORE, PROPER * BEFORE, BEHIND)]}]
    for n, (own, k) in enumerate(runs(RESTING)):
        out.append({"name": f"resting {n}", "nodes": [f"flash {k}"],
                    "worldline": [event(own, 0, 0), event(own + STAYS, 0, 0)]})
    for n, (own, k) in enumerate(runs(MOVING)):
        line = [event(GAMMA * t, PROPER * t, BEHIND) for t in (own, own + STAYS)]
        out.append({"name": f"moving {n}", "nodes": [f"flash {k}"], "worldline": line})
        start = line[0]["time"]
        out.append({"name": f"spark {n}", "nodes": [f"spark {k}"], "worldline": [
            line[0], event(start + 60, line[0]["position"][0], BEHIND)]})
    return out


def scene():
    lines = ",\n".join("        " + json.dumps(body) for body in bodies())
    return SCENE.replace("BODIES", lines)


SCENE = """// Two light clocks: a pulse of light goes up and down between mirrors 2 light-seconds apart, 4 s there and back. One rests; one
// passes behind it at 0.6 c, and its light's way is longer: 5 s. Each flash of a pulse is a body: it rests in its clock from
// one event to another. They stand on a promenade by a lake, in the evening: light shows best there. One unit is one light-second.
// scenes/light-clock/make.py writes the glTF and this file.
{
    "$schema": "../schema/scene.schema.json",
    "gltf": "../../scenes/light-clock/light-clock.glb",
    "unit_m": 299792458,
    "light_speed_m_s": 299792458,
    "sky": { "zenith": [0.005, 0.016, 0.065], "horizon": [0.060, 0.098, 0.190], "nadir": [0.010, 0.015, 0.025] },
    "ambient": [0.17, 0.18, 0.24],
    "shadows": true,
    "lights": [
        // The last of the sun, from behind the visitor's left shoulder.
        { "type": "directional", "towards": [-0.55, 0.40, 0.72], "radiance": [0.85, 0.72, 0.58] }
    ],
    "bodies": [
BODIES
    ],
    "boundary": { "centre": [0, 0, 0], "radius": 40 },
    "flight": { "distance": 32, "time_s": 25 },
    "goals": [
        { "ask": "goal.light-clock.along", "reward": "goal.light-clock.along-done", "conditions": [{ "measure": { "quantity": "doppler", "at": [1000000, 0, 0] }, "from": 1.8, "below": 2.25 }] }
    ],
    // The moving clock has just come into view at the left, and the sparks of its pulse behind it.
    "start": { "time": 3, "position": [0, 1.1, 8.5], "look": [-0.16, 0, -1], "up": [0, 1, 0] }
}
"""


def main():
    glb = Glb("light-clock")
    face, marks = (0.02, 0.028, 0.045), (0.95, 0.88, 0.66)
    resting = Dials(glb, 0.5, face=face, marks=marks, name="resting dial")
    moving = Dials(glb, 0.5, BEFORE, face=face, marks=marks, name="moving dial")
    add_clock(glb, "resting clock", (0.34, 0.20, 0.07), resting, (0, 0, 0), False)
    add_clock(glb, "moving clock", (0.05, 0.26, 0.34), moving, (0, 0, 0), True)
    add_pulse(glb)
    kit = Kit(glb)
    add_floor(glb, kit)
    add_promenade(kit)
    add_far(kit)
    out = Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "light-clock.glb"
    glb.write(out)
    json_file = out.with_suffix(".json") if len(sys.argv) > 1 else HERE.parents[1] / "config/scenes/light-clock.json"
    json_file.write_text(scene())


if __name__ == "__main__":
    main()
