#!/usr/bin/env python3
"""Makes runtime/primaries.h: the reflectances of red, green and blue that a base colour is made of.

The smoothest three functions of the wavelength (least sum of squared second differences over ln wavelength) that lie between
0 and 1 and add up to 1, so that lit by the Sun and seen by an eye adapted to it each has its Rec. 709 colour. A quadratic
programme, solved by alternating projections (ADMM: Boyd et al. 2011). Wants python3-numpy. Run in the repository's root:

    python3 scenes/make_primaries.py > primaries.new && mv primaries.new runtime/primaries.h
"""
import re
import numpy as np

POINTS, FROM_NM, TO_NM = 57, 345.0, 850.0
SUN_K, SECOND_RADIATION_NM_K = 5772.0, 1.438776877e7

rows = re.findall(r"\{\{?([0-9.e-]+), ([0-9.e-]+), ([0-9.e-]+)\}\}?", open("runtime/cie1931.h").read())
table = np.array(rows, float)
nm = np.arange(360, 831.0)


def spline(values, step):
    """A natural cubic spline through values, at every 1/step of the way."""
    n = len(values)
    a = np.diag(np.full(n, 4.0)) + np.diag(np.ones(n - 1), 1) + np.diag(np.ones(n - 1), -1)
    a[0], a[-1] = np.eye(n)[0], np.eye(n)[-1]
    b = np.zeros_like(values)
    b[1:-1] = 6 * (values[:-2] - 2 * values[1:-1] + values[2:])
    second = np.linalg.solve(a, b)
    at = np.arange((n - 1) * step + 1) / step
    i = np.minimum(at.astype(int), n - 2)
    w = (at - i)[:, None]
    v = 1 - w
    return v * values[i] + w * values[i + 1] + ((v**3 - v) * second[i] + (w**3 - w) * second[i + 1]) / 6


eye = np.maximum(spline(table, 5), 0)
sun = nm**-5.0 / np.expm1(SECOND_RADIATION_NM_K / (nm * SUN_K))
seen = eye * sun[:, None]
seen /= seen.sum(0)[1]

xyz_from_rec709 = np.array([[0.4123907993, 0.3575843394, 0.1804807884], [0.2126390059, 0.7151686788, 0.0721923154],
                            [0.0193308187, 0.1191947798, 0.9505321522]])
cones = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])  # Bradford
ratio = (cones @ xyz_from_rec709.sum(1)) / (cones @ seen.sum(0))
wanted = np.linalg.inv(np.linalg.inv(cones) @ np.diag(ratio) @ cones) @ xyz_from_rec709

# The ends blend into the mean of all three, as base_reflectance does where nothing else is said.
x = np.linspace(np.log(FROM_NM), np.log(TO_NM), POINTS)
hats = np.maximum(0, 1 - abs(np.clip(np.log(nm), x[0], x[-1])[:, None] - x) / (x[1] - x[0]))
ends = 1 / (1 + np.exp(np.log(nm / 360) / 0.035)) + 1 / (1 + np.exp(-np.log(nm / 820) / 0.05))
sums = (seen * (1 - ends)[:, None]).T @ hats
wanted -= (seen * ends[:, None]).sum(0)[:, None] / 3

second, first = np.diff(np.eye(POINTS), 2, axis=0), np.diff(np.eye(POINTS), axis=0)
rough = second.T @ second + 1e-4 * first.T @ first + 0.5 * (np.outer(first[0], first[0]) + np.outer(first[-1], first[-1]))
equal = [np.concatenate([np.zeros(j * POINTS), sums[i], np.zeros((2 - j) * POINTS)]) for j in range(2) for i in range(3)]
equal += list(np.tile(np.eye(POINTS), 3))
value = np.concatenate([wanted[:, 0], wanted[:, 1], np.ones(POINTS)])
equal, size, rho = np.array(equal), 3 * POINTS, 0.05
inverse = np.linalg.pinv(np.block([[np.kron(np.eye(3), rough) + rho * np.eye(size), equal.T],
                                   [equal, np.zeros((len(value), len(value)))]]))
bounded, dual = np.full(size, 1 / 3), np.zeros(size)
for _ in range(40000):
    free = (inverse @ np.concatenate([rho * (bounded - dual), value]))[:size]
    bounded = np.clip(free + dual, 0, 1)
    dual += free - bounded
assert abs(free - bounded).max() < 1e-9

head = open("runtime/primaries.h").read()
print(head[:head.index("{{") + 2])
for r, g, b in bounded.reshape(3, POINTS).T:
    print("    {{%.5ff, %.5ff, %.5ff}}," % (r, g, b))
print("}};\n\n} // namespace starbow")
