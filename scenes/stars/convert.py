#!/usr/bin/env python3
"""Writes stars.txt, the 118,216 stars of the Hipparcos catalogue:

    npm pack d3-celestial@0.7.35 && tar xf d3-celestial-0.7.35.tgz package/data/stars.14.json
    apt-get download stellarium-data && dpkg-deb -x stellarium-data_*.deb data
    scenes/stars/convert.py package/data/stars.14.json data/usr/share/stellarium/stars/default [stars.txt]

The first source (BSD-3, see LICENSE) gives each star's number in the Hipparcos catalogue, right ascension (-180 to 180) and
declination in degrees, J2000, to four decimals, the visual magnitude to two, and B-V as text, empty where it is not known.
The second gives for the same numbers places to 0.01 seconds of arc, and parallaxes with their errors.

Needs python3-numpy.
"""
import json
import sys
from pathlib import Path

import numpy as np

HEAD = """\
# The 118,216 stars of the Hipparcos catalogue, the brightest first; README.md beside this file names the sources. Written by
# convert.py. Right ascension and declination (J2000), 1e-5 degrees; visual magnitude and B-V, 0.01; parallax, 0.01
# milliseconds of arc; - where B-V is not known or the parallax below three times its error.
"""
RADIAN = 180 / np.pi * 3600  # seconds of arc


def unit(vector):
    return vector / np.linalg.norm(vector)


def zones(level):
    """The triangles into which Stellarium divides the sky: their middles, two axes of each, and the length of an axis.

    An icosahedron's faces, each divided into four, `level` times. The axes point east and north; places in a triangle
    are measured in units of the greatest distance of any corner along an axis.
    """
    golden = 0.5 * (1 + np.sqrt(5))
    b = 1 / np.sqrt(1 + golden**2)
    a = b * golden
    corners = np.array([(a, -b, 0), (a, b, 0), (-a, b, 0), (-a, -b, 0), (0, a, -b), (0, a, b), (0, -a, b), (0, -a, -b),
                        (-b, 0, a), (b, 0, a), (b, 0, -a), (-b, 0, -a)])
    faces = [(1, 0, 10), (0, 1, 9), (0, 9, 6), (9, 8, 6), (0, 7, 10), (6, 7, 0), (7, 6, 3), (6, 8, 3), (11, 10, 7),
             (7, 3, 11), (3, 2, 11), (2, 3, 8), (10, 11, 4), (2, 4, 11), (5, 4, 2), (2, 8, 5), (4, 1, 10), (4, 5, 1),
             (5, 9, 1), (8, 9, 5)]
    triangles = [tuple(corners[list(face)]) for face in faces]
    for _ in range(level):
        parts = []
        for c0, c1, c2 in triangles:
            e0, e1, e2 = unit(c1 + c2), unit(c2 + c0), unit(c0 + c1)
            parts += [(c0, e2, e1), (e2, c1, e0), (e1, e0, c2), (e0, e1, e2)]
        triangles = parts
    middles = [unit(sum(triangle)) for triangle in triangles]
    east = [unit(np.cross((0, 0, 1), middle)) for middle in middles]
    north = [np.cross(middle, axis) for middle, axis in zip(middles, east)]
    scale = 0
    for triangle, middle, x, y in zip(triangles, middles, east, north):
        for corner in triangle:
            off = np.array([(corner - middle) @ x, (corner - middle) @ y])
            scale = max(scale, *np.abs(off / np.sqrt(1 - off @ off)))
    return np.array(middles), np.array(east), np.array(north), scale


def stellariums_stars(folder):
    """Places (unit vectors) and parallaxes (milliseconds of arc) by number in the Hipparcos catalogue."""
    record = np.dtype([("hip", "u1", 3), ("part", "u1"), ("place", "<i4", 2), ("colour", "u1"), ("magnitude", "u1"),
                       ("spectrum", "<u2"), ("motion", "<i4", 2), ("parallax", "<i4")])
    stars = {}
    for level in range(3):
        raw = (folder / f"stars_{level}_0v0_8.cat").read_bytes()
        head, count = 32, 20 * 4**level
        counts = np.frombuffer(raw, "<u4", count, head)
        records = np.frombuffer(raw, record, counts.sum(), head + 4 * count)
        middles, east, north, scale = zones(level)
        zone = np.repeat(np.arange(count), counts)
        place = records["place"] * (scale / 0x7fffffff)
        v = middles[zone] + place[:, :1] * east[zone] + place[:, 1:] * north[zone]
        v /= np.linalg.norm(v, axis=1)[:, None]
        hip = records["hip"].astype(int) @ [1, 1 << 8, 1 << 16]
        for at in np.flatnonzero(hip):
            stars.setdefault(hip[at], (v[at], records["parallax"][at] / 100))
    return stars


def main():
    features = json.loads(Path(sys.argv[1]).read_text())["features"]
    folder = Path(sys.argv[2])
    target = Path(sys.argv[3]) if len(sys.argv) > 3 else Path(__file__).resolve().parent / "stars.txt"
    places = stellariums_stars(folder)
    errors = dict((int(hip), float(error)) for hip, error in (
        line.split() for line in (folder / "hip_plx_err.dat").read_text().splitlines() if not line.startswith("#")))
    lines, off, usable = [], [], 0
    for feature in features:
        hip, properties = feature["id"], feature["properties"]
        ra, dec = feature["geometry"]["coordinates"]
        a, d = np.radians((ra, dec))
        here = np.array([np.cos(d) * np.cos(a), np.cos(d) * np.sin(a), np.sin(d)])
        finer, parallax = places.get(hip, (here, 0))
        apart = np.linalg.norm(finer - here) * RADIAN
        off.append(apart)
        # A few members of pairs are a minute of arc off in the finer source; two stars just south of the equator are as far
        # north of it in the other.
        if apart < 2 or apart > 3600:
            ra, dec = np.degrees(np.arctan2(finer[1], finer[0])), np.degrees(np.arcsin(finer[2]))
        b_v = properties["bv"]
        # A parallax is usable from three times its error on; an unknown error is taken as 1.
        good = parallax >= 3 * errors.get(hip, 1) and parallax >= 0.01
        usable += good
        magnitude = round(properties["mag"] * 100)
        lines.append((magnitude, hip, f"{round(ra * 1e5) % 36000000} {round(dec * 1e5)} {magnitude} "
                      f"{round(float(b_v) * 100) if b_v else '-'} {round(parallax * 100) if good else '-'}\n"))
    target.write_text(HEAD + "".join(line for _, _, line in sorted(lines)))
    print(f"{len(lines)} stars, {usable} with a usable parallax; the sources' places are {np.median(off):.2f} seconds of arc "
          f"apart (median), {sum(a > 2 for a in off)} of them more than 2")


if __name__ == "__main__":
    main()
