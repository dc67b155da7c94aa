#!/usr/bin/env python3
"""Computes a class's deviations of what was seen from its logs by school formulas, and compares them with the page of `starbow class`.

Usage: golden.py PAGE.html LOG.csv...    It shares no code with the program: the logs are read by names with Python's csv, the
means and spreads are those of Python's statistics. It also compares the class's CSV file beside the page, cell by cell."""
import csv
import html
import math
import re
import statistics
import sys
from pathlib import Path

page, logs = Path(sys.argv[1]), [Path(log) for log in sys.argv[2:]]


def number(row, name):
    return float(row[name]) if row[name] else None


def doppler(u, degrees):
    gamma = math.sqrt(1 + u * u)
    return 1 / (gamma - u * math.cos(math.radians(degrees)))


def straight(a, b):
    """The rules of docs/lab.md: one velocity within 0.2 %, and the way that belongs to it."""
    dtau = number(b, "ship_time_s") - number(a, "ship_time_s")
    if dtau <= 0 or a["aberration_on"] != "1" or b["aberration_on"] != "1":
        return False
    for axis in "xyz":
        u, was = number(b, f"gamma_beta_{axis}"), number(a, f"gamma_beta_{axis}")
        way = number(b, f"place_{axis}_light_s") - number(a, f"place_{axis}_light_s")
        most = 0.002 * number(b, "gamma")
        if abs(u - was) > most or abs(way - (u + was) / 2 * dtau) > most * dtau + 1e-8:
            return False
    return True


def deviations(rows):
    """(plot, kind) -> list of measured over theory, minus 1."""
    found = {}
    add = lambda plot, kind, measured, theory: found.setdefault((plot, kind), []).append(measured / theory - 1)
    for i, row in enumerate(rows):
        if row["aberration_on"] != "1":
            continue
        before = rows[i - 1] if i and straight(rows[i - 1], row) else None
        for spot in ("aim", "mark_1", "mark_2"):
            angle = number(row, f"{spot}_from_relative_motion_deg")
            if angle is not None:
                add("D", "read", number(row, f"{spot}_doppler"), doppler(number(row, f"{spot}_relative_gamma_beta"), angle))
        if before:
            dtau = number(row, "ship_time_s") - number(before, "ship_time_s")
            for mark in ("mark_1", "mark_2"):
                both = [[number(r, f"{mark}_{name}") for r in (before, row)]
                        for name in ("clock_s", "from_relative_motion_deg", "relative_gamma_beta")]
                same = row[f"{mark}_number"] and row[f"{mark}_number"] == before[f"{mark}_number"]
                if same and None not in both[0] + both[1] and abs(both[1][1] - both[1][0]) <= 10:
                    add("D", "seen", (both[0][1] - both[0][0]) / dtau, doppler(sum(both[2]) / 2, sum(both[1]) / 2))
            gamma = (number(row, "gamma") + number(before, "gamma")) / 2
            add("clock", "read", dtau / (number(row, "world_time_s") - number(before, "world_time_s")), 1 / gamma)
        rest, angle = number(row, "marks_rest_length_light_s"), number(row, "marks_from_motion_at_rest_deg")
        if rest and angle is not None and angle <= 60:
            along, across = rest * math.cos(math.radians(angle)), rest * math.sin(math.radians(angle))
            theory = 1 / math.sqrt(1 + number(row, "marks_relative_gamma_beta") ** 2)
            for kind, name in (("read", "contracted"), ("seen", "apparent")):
                length = number(row, f"marks_{name}_length_light_s")
                if length is not None:
                    add("length", kind, math.sqrt(length * length - across * across) / along, theory)
    return found


def shown(text):
    """A table's cell as a number."""
    text = text.replace("−", "-").replace(",", ".").replace("%", "").strip()
    return None if text == "—" else float(text)


in_page = {}
for plot, table in re.findall(r'<table class="seen (\w+)">(.*?)</table>', page.read_text(), re.S):
    for cells in re.findall(r"<tr><td>(.*?)</td></tr>", table, re.S):
        group, count, mean, spread = cells.split("</td><td>")
        group = html.unescape(re.sub(r"<svg.*?</svg>", "", group, flags=re.S)).strip()
        in_page[{"doppler": "D"}.get(plot, plot), group] = int(count), shown(mean), shown(spread)
# Logs of an older version have no columns of readings; the class has them, empty.
readings = dict.fromkeys(("reading_of", "reading", "reading_uncertainty", "reading_theory", "reading_sigmas"), "")

compared, all_rows = 0, []
for log in logs:
    with open(log, newline="") as file:
        rows = list(csv.DictReader(file))
    all_rows += [{**readings, "group": log.stem, **row} for row in rows]
    for (plot, kind), off in deviations(rows).items():
        if kind == "read": # the instruments compute these by the formula: no measurement, and in no table
            assert max(map(abs, off)) < 1e-4, (log, plot)
            continue
        count, mean, spread = in_page.pop((plot, log.stem))
        assert count == len(off), (log, plot, kind, count, len(off))
        # The page rounds to 0.001 %; the log's 12 digits are far below.
        assert abs(mean - 100 * statistics.fmean(off)) < 0.00051, (log, plot, kind, mean, 100 * statistics.fmean(off))
        if count > 1:
            assert abs(spread - 100 * statistics.stdev(off)) < 0.00051, (log, plot, kind, spread, 100 * statistics.stdev(off))
        compared += 1
assert not in_page, in_page
with open(page.with_suffix(".csv"), newline="") as file:
    assert list(csv.DictReader(file)) == all_rows
print(f"{compared} means and spreads of {len(logs)} groups are those of the page; {len(all_rows)} lines are in its CSV file")
