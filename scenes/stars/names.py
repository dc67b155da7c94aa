#!/usr/bin/env python3
"""Writes names.json, the figures of the constellations and the names of stars:

    npm pack d3-celestial@0.7.35 && tar xf d3-celestial-0.7.35.tgz package/data
    scenes/stars/names.py package/data [names.json]

The source (BSD-3, see LICENSE) gives places in degrees, J2000, right ascension from -180 to 180.
"""
import json
import sys
from pathlib import Path

FAINTEST = 2.3  # of a star with a name, magnitudes
GLOBES = {"Sun": "Sonne", "Mercury": "Merkur", "Venus": "Venus", "Earth": "Erde", "Moon": "Mond", "Mars": "Mars",
          "Jupiter": "Jupiter", "Saturn": "Saturn", "Uranus": "Uranus", "Neptune": "Neptun"}


def place(degrees):
    """Right ascension from 0 to 360 and declination, to a hundredth of a degree."""
    return [round(degrees[0] % 360, 2), round(degrees[1], 2)]


def main():
    folder = Path(sys.argv[1])
    out = Path(sys.argv[2] if len(sys.argv) > 2 else Path(__file__).with_name("names.json"))
    read = lambda name: json.loads((folder / name).read_text(encoding="utf-8"))
    lines = {}
    for feature in read("constellations.lines.json")["features"]:
        lines.setdefault(feature["id"], []).extend(feature["geometry"]["coordinates"])
    constellations = []
    for feature in read("constellations.json")["features"]:
        words = feature["properties"]
        if feature["id"] in (one["id"] for one in constellations):  # the Serpent's two parts
            continue
        plain = lambda text: " ".join(text.split())
        constellations.append({
            "id": feature["id"],
            "en": "Serpens" if feature["id"] == "Ser" else plain(words["name"]),
            "de": plain(words["de"]),
            "rank": int(words["rank"]),
            "at": place(words["display"]),
            "lines": [[place(point) for point in line] for line in lines[feature["id"]]],
        })
    sky = {str(star["id"]): star for star in read("stars.8.json")["features"]}
    stars = []
    for number, words in read("starnames.json").items():
        star = sky.get(number)
        if words["name"] and star and star["properties"]["mag"] <= FAINTEST:
            stars.append({"name": words["name"], "at": place(star["geometry"]["coordinates"]), "magnitude": star["properties"]["mag"]})
    stars.sort(key=lambda star: star["magnitude"])
    rows = lambda all: ",\n".join("    " + json.dumps(one, ensure_ascii=False, separators=(",", ":")) for one in all)
    globes = [{"id": name, "en": name, "de": german} for name, german in GLOBES.items()]
    lists = {"constellations": constellations, "stars": stars, "globes": globes}
    out.write_text("{\n" + ",\n".join(f'  "{name}": [\n{rows(all)}\n  ]' for name, all in lists.items()) + "\n}\n", encoding="utf-8")
    print(f"{len(constellations)} constellations, {sum(len(one['lines']) for one in constellations)} lines, {len(stars)} stars")


main()
