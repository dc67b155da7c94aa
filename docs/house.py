#!/usr/bin/env python3
"""Draws docs/house.svg: the rooms of CONTRIBUTING.md's table and the #includes between them. From the repository's root:

    python3 docs/house.py            # writes docs/house.svg
    python3 docs/house.py --check    # exits 1 where docs/house.svg is not up to date
"""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
MERGED = ("config", "displays", "shaders", "input", "tests")  # drawn as one room each
SOURCES = {".h", ".cpp", ".glsl", ".vert", ".frag", ".comp"}


def table():
    """[(room, one line of text)] in the table's order, each merged room once."""
    rooms = {}
    for folder, text in re.findall(r"^\| `([^`]+)/` \| ([^|]*)\|", (ROOT / "CONTRIBUTING.md").read_text(), re.M):
        room = folder.split("/")[0] if folder.split("/")[0] in MERGED else folder
        rooms.setdefault(room, text.strip())
    return list(rooms)


def room_of(path, rooms):
    fits = [room for room in rooms if str(path).startswith(room + "/")]
    return max(fits, key=len) if fits else None


def arrows(rooms):
    """{(from, to): number of includes}"""
    count = collections.Counter()
    for top in ("config", "displays", "input", "runtime", "shaders", "tests"):
        for file in sorted((ROOT / top).rglob("*")):
            if file.suffix not in SOURCES:
                continue
            here = file.relative_to(ROOT)
            for name in re.findall(r'^\s*#\s*include "([^"]+)"', file.read_text(), re.M):
                for folder in (here.parent, pathlib.Path(), pathlib.Path("shaders")):
                    if (ROOT / folder / name).is_file():
                        to = room_of(pathlib.Path((ROOT / folder / name).resolve()).relative_to(ROOT), rooms)
                        if to and to != room_of(here, rooms):
                            count[room_of(here, rooms), to] += 1
                        break
    return count


def draw(rooms, count):
    below = {room: {b for a, b in count if a == room} for room in rooms}
    level = {}

    def height(room):
        if room not in level:
            level[room] = 1 + max((height(other) for other in below[room]), default=-1)
        return level[room]

    def reaches(room, seen):
        for other in below[room]:
            if other not in seen:
                seen.add(other)
                reaches(other, seen)
        return seen

    # An arrow is drawn where no longer way leads to the same room.
    shown = [(a, b) for a, b in count if not any(b in reaches(c, set()) for c in below[a] if c != b)]
    rows = collections.defaultdict(list)
    for room in rooms:
        rows[height(room)].append(room)
    width, box_w, box_h, gap = 1000, 150, 46, 44
    # Columns that keep arrows off other rooms' boxes; a room without one stands in the middle.
    column = {"runtime/commands": 0.38, "tests": 0.62, "runtime/exhibit": 0.38, "runtime/visit": 0.1, "runtime/machines": 0.28,
              "runtime/render": 0.6, "runtime/hud": 0.44, "runtime/reference": 0.87, "runtime/remote": 0.18, "runtime/shadow": 0.66,
              "runtime/plan": 0.44, "runtime/operation": 0.22, "runtime/world": 0.42, "runtime/flight": 0.1, "runtime/images": 0.78, "displays": 0.3, "input": 0.1, "runtime/light": 0.66, "shaders": 0.56, "config": 0.3}
    place, y = {}, 20
    for h in sorted(rows, reverse=True):
        for room in rows[h]:
            place[room] = (width * column.get(room, 0.5), y)
        y += box_h + gap
    total = y - gap + 46
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {total}" font-family="DejaVu Sans, sans-serif">',
        '<defs><marker id="tip" markerWidth="9" markerHeight="9" refX="8" refY="4" orient="auto">'
        '<path d="M0,0 L9,4 L0,8 z" fill="#5b6b80"/></marker></defs>',
        f'<rect width="{width}" height="{total}" fill="#ffffff"/>',
    ]
    for a, b in sorted(shown):
        (xa, ya), (xb, yb) = place[a], place[b]
        ya, half = ya + box_h, (yb - ya - box_h) / 2
        out.append(
            f'<path d="M{xa:.0f},{ya} C{xa:.0f},{ya + half:.0f} {xb:.0f},{yb - half:.0f} {xb:.0f},{yb}" fill="none" '
            'stroke="#8fa0b5" stroke-width="1.4" marker-end="url(#tip)"/>'
        )
    vulkan = {"runtime/render", "runtime/exhibit"}
    for room, (x, top) in place.items():
        files = sum(1 for f in (ROOT / room).rglob("*") if f.suffix in SOURCES)
        fill = "#fde8c8" if room in vulkan else "#e4eef9"
        out.append(
            f'<rect x="{x - box_w / 2:.0f}" y="{top}" width="{box_w}" height="{box_h}" rx="6" fill="{fill}" '
            'stroke="#5b6b80"/>'
            f'<text x="{x:.0f}" y="{top + 20}" font-size="14" text-anchor="middle" fill="#111111">{room}/</text>'
            f'<text x="{x:.0f}" y="{top + 37}" font-size="11" text-anchor="middle" fill="#444444">{files} files</text>'
        )
    out.append(
        f'<text x="14" y="{total - 14}" font-size="12" fill="#444444">An arrow includes downwards; arrows that a longer way '
        f"replaces are left out ({len(shown)} of {len(count)} are drawn). Rooms that use Vulkan are yellow.</text>"
    )
    out.append("</svg>")
    return "\n".join(out) + "\n"


rooms_ = table()
picture = draw(rooms_, arrows(rooms_))
target = ROOT / "docs" / "house.svg"
if "--check" in sys.argv:
    if not target.exists() or target.read_text() != picture:
        sys.exit("docs/house.svg is not of these sources; python3 docs/house.py draws it anew")
else:
    target.write_text(picture)
