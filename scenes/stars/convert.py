#!/usr/bin/env python3
"""Writes stars.txt from data/stars.6.json of the npm package d3-celestial 0.7.35 (BSD-3, see LICENSE):

    npm pack d3-celestial@0.7.35 && tar xf d3-celestial-0.7.35.tgz package/data/stars.6.json
    scenes/stars/convert.py package/data/stars.6.json [stars.txt]

The source gives right ascension (-180 to 180) and declination in degrees, J2000, to four decimals, the visual magnitude to
two, and B-V as text, empty where it is not known.
"""
import json
import sys
from pathlib import Path

HEAD = """\
# The 5,044 stars down to magnitude 6, from d3-celestial 0.7.35 (LICENSE beside this file); written by convert.py.
# Right ascension and declination (J2000), 1e-4 degrees; visual magnitude and B-V, 0.01; - where B-V is not known.
"""


def line(feature):
    ra, dec = (round(angle * 1e4) for angle in feature["geometry"]["coordinates"])
    magnitude, b_v = feature["properties"]["mag"], feature["properties"]["bv"]
    return f"{ra % 3600000} {dec} {round(magnitude * 100)} {round(float(b_v) * 100) if b_v else '-'}\n"


def main():
    features = json.loads(Path(sys.argv[1]).read_text())["features"]
    target = Path(sys.argv[2]) if len(sys.argv) > 2 else Path(__file__).resolve().parent / "stars.txt"
    target.write_text(HEAD + "".join(line(feature) for feature in features))


if __name__ == "__main__":
    main()
