#!/usr/bin/python3
"""Writes tests/world/eclipse_witness.json: the part of the Sun's light that the Moon leaves at places of four eclipses, by PyEphem
(Debian's python3-ephem, MIT) and a sum over the Sun's disc. It shares neither places nor formulas with the program.
Example: scenes/solar-system/eclipse_witness.py"""
import json
import math
import pathlib
import re

import ephem

# I(mu) / I(1) at 550 nm: Neckel and Labs 1994, Solar Physics 153, 91, table 1, between the rows at 541.76 and 559.95 nm.
ROWS = ((541.76, (0.26073, 1.27428, -1.30352, 1.47085, -0.96618, 0.26384)),
        (559.95, (0.26892, 1.34319, -1.58427, 1.91271, -1.3135, 0.37295)))
PART = (550 - ROWS[0][0]) / (ROWS[1][0] - ROWS[0][0])
POWERS = [a + PART * (b - a) for a, b in zip(ROWS[0][1], ROWS[1][1])]

DAYS = {
    "1999-08-11T10:40Z": ((51.5, -0.1), (48.1, 11.6), (41.0, 29.0), (60.2, 24.9), (40.4, -3.7), (30.0, 31.2)),
    "2017-08-21T18:00Z": ((40.7, -74.0), (41.9, -87.6), (29.8, -95.4), (47.6, -122.3), (19.4, -99.1), (51.0, -114.1)),
    "2024-04-08T18:45Z": ((40.7, -74.0), (41.9, -87.6), (29.8, -95.4), (34.1, -118.2), (19.4, -99.1), (44.9, -93.3)),
    "2026-08-12T17:46Z": ((51.5, -0.1), (60.0, -5.0), (48.9, 2.3), (64.1, -21.9), (40.4, -3.7), (69.0, -50.0)),
}


def left(sun, moon, apart):
    """Sums the Sun's light over its disc, outside the Moon. All in radians."""
    whole = seen = 0.0
    rings, steps = 400, 720
    for i in range(rings):
        r = (i + 0.5) / rings
        mu = math.sqrt(1 - r * r)
        light = r * sum(a * mu**k for k, a in enumerate(POWERS))
        whole += light * steps
        for j in range(steps):
            turn = 2 * math.pi * (j + 0.5) / steps
            if math.hypot(sun * r * math.cos(turn) - apart, sun * r * math.sin(turn)) >= moon:
                seen += light
    return seen / whole


def main():
    out = {"made_by": "scenes/solar-system/eclipse_witness.py with PyEphem " + ephem.__version__ + " (MIT)",
           "what": "[geographic latitude, eastward longitude, part of the Sun's light at 550 nm that the Moon leaves, height of the "
                   "Sun]: degrees, without refraction, at sea level", "eclipses": []}
    for date, places in DAYS.items():
        rows = []
        for latitude, longitude in places:
            at = ephem.Observer()
            at.lat, at.lon, at.elevation, at.pressure = str(latitude), str(longitude), 0, 0
            at.date = ephem.Date(date[:-1].replace("T", " ").replace("-", "/"))
            sun, moon = ephem.Sun(at), ephem.Moon(at)
            apart = ephem.separation((sun.az, sun.alt), (moon.az, moon.alt))
            rows.append([latitude, longitude, round(left(sun.radius, moon.radius, float(apart)), 4),
                         round(math.degrees(sun.alt), 2)])
        days = float(at.date) - float(ephem.Date("2000/1/1 12:00"))
        out["eclipses"].append({"utc": date, "days": round(days, 6), "places": rows})
    target = pathlib.Path(__file__).resolve().parents[2] / "tests/world/eclipse_witness.json"
    text = json.dumps(out, indent=1)
    target.write_text(re.sub(r"\[\s+(-?[\d.]+),\s+(-?[\d.]+),\s+(-?[\d.]+),\s+(-?[\d.]+)\s+\]", r"[\1, \2, \3, \4]", text) + "\n")


main()
