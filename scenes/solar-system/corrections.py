#!/usr/bin/env python3
"""Fits Jupiter's and Saturn's pull on each other: what Standish's elements (bodies.json) leave out.

    corrections.py bodies.json

Prints the table CORRECTIONS of bodies.py. The longitudes and distances fitted are ERFA's plan94 (Simon et al. 1994, A&A
282, 663), 1500 dates from 1895 to 2055; the witness's library has no part in it. Needs python3-numpy, python3-erfa.
"""
import json
import sys

import erfa
import numpy as np

import check_bodies as c

c.B = json.load(open(sys.argv[1]))
c.B["orbits"].pop("corrections", None)
TO_ECLIPTIC = c.rx(c.B["orbits"]["obliquity_deg"] * c.DEG)
T = np.linspace(-1.05, 0.55, 1500)
LJ, LS = ((v["L_deg"][0] + v["L_deg"][1] * T) * c.DEG for v in (c.B["orbits"]["bodies"][n] for n in ("Jupiter", "Saturn")))
ARGUMENTS = [(1, 0), (0, 1), (1, -1), (2, -2), (3, -3), (1, -2), (2, -3), (3, -4), (2, -4), (2, -5), (3, -5), (0, 2),
             (2, 0), (4, -5), (2, -1)]
POLYNOMIAL = np.stack([T ** 0, T, T * T], 1)


def waves(j):
    a, b = ARGUMENTS[j]
    return np.stack([np.sin(a * LJ + b * LS), np.cos(a * LJ + b * LS)], 1)


for name, number in (("Jupiter", 5), ("Saturn", 6)):
    ours = np.array([c.orbit(name, t) for t in T])
    theirs = np.array([TO_ECLIPTIC @ erfa.plan94(2451545.0, t * 36525, number)["p"] for t in T])
    lon = [np.arctan2(v[:, 1], v[:, 0]) / c.DEG for v in (ours, theirs)]
    r = [np.linalg.norm(v, axis=1) for v in (ours, theirs)]
    for what, y, count, digits in (("longitude_deg", (lon[1] - lon[0] + 180) % 360 - 180, 6, 4),
                                   ("distance_fraction", r[1] / r[0] - 1, 4, 6)):
        chosen = []
        while len(chosen) < count:  # one after the other, the argument that lowers the worst error most
            trials = []
            for i in set(range(len(ARGUMENTS))) - set(chosen):
                m = np.hstack([POLYNOMIAL] + [waves(j) for j in chosen + [i]])
                x = np.linalg.lstsq(m, y, rcond=None)[0]
                trials.append((abs(y - m @ x).max(), i, x))
            error, i, x = min(trials, key=lambda v: v[0])
            chosen.append(i)
        x = [round(float(v), digits) for v in x]
        terms = [[*ARGUMENTS[j], x[3 + 2 * k], x[4 + 2 * k]] for k, j in enumerate(chosen)]
        print(f'    ("{name}", "{what}", {x[:3]}, {terms}),  # worst {abs(y).max():.5f}, then {error:.5f}')
