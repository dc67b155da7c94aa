#!/usr/bin/env python3
"""Invents three groups' lists of readings with seeded noise, as the test's data: tests/lab/{hertz,kirchhoff,noddack}.csv.

Usage: invent.py FOLDER. hertz judges its uncertainties well. kirchhoff states less than half of them, has two slips of the
pen, and saves as a German spreadsheet does: byte order mark, semicolons, decimal commas. noddack states four times too much."""
import math
import random
import sys
from pathlib import Path

from theory import THEORY

folder = Path(sys.argv[1])
# A careful eye's uncertainty: degrees, parts of D and of light, nanometres, seconds, light-seconds.
UNCERTAINTY = {"A1": 0.3, "A2": 0.3, "A3": 0.3, "D1": 0.08, "D2": 0.003, "D7": 0.006, "D8": 3, "C1": 0.1, "C3": 0.1,
               "C6": 0.1, "T2": 0.5, "L3": 0.2, "H1": 0.007}
SLIPS = {("D8", 1): 20, ("C3", 0): -1.5}  # a wrong tick, a wrong hand

noise = random.Random(20261130)


def readings(stated):
    for no, theory in THEORY.items():
        for i in range(3):
            value = noise.gauss(theory, UNCERTAINTY[no])
            digits = max(0, 1 - math.floor(math.log10(UNCERTAINTY[no])))
            yield no, i, round(value, digits), UNCERTAINTY[no] * stated, digits


def text(value, digits):
    return f"{value:.{digits}f}"


def write(name, lines, mark=""):
    (folder / f"{name}.csv").write_bytes((mark + "\r\n".join(lines) + "\r\n").encode())


write("hertz", ["no,quantity,reading,uncertainty"]
      + [f"{no},,{text(v, d)},{u:.5g}" for no, i, v, u, d in readings(1)] + ["T4,distance in the ship / light-s,,"])
german = []
for no, i, v, u, d in readings(0.4):
    german.append(f'{no};"";{text(v + SLIPS.get((no, i), 0), d)};{u:.5g}'.replace(".", ","))
write("kirchhoff", ["no;quantity;reading;uncertainty"] + german + [";;;"], "\ufeff")
write("noddack", ["no,quantity,reading,uncertainty"] + [f"{no},,{text(v, d)},{u:.5g}" for no, i, v, u, d in readings(4)])
