#!/usr/bin/env python3
"""Recomputes the statistics of groups' lists of readings, and compares them with the page and the CSV file of `starbow class`.

Usage: readings_golden.py PAGE.html LIST.csv...    It shares no code with the program: the theory is by school formulas, means
and spreads are those of Python's statistics, and the probability of a chi-square is the integral of its density."""
import csv
import html
import math
import re
import statistics
import sys
from pathlib import Path

from theory import THEORY

page, lists = Path(sys.argv[1]), [Path(file) for file in sys.argv[2:]]


def probability(chi_square, degrees):
    """The integral of the density of chi from sqrt(chi_square) on, by Simpson's rule."""
    def density(r):
        if r == 0:
            return math.sqrt(2 / math.pi) if degrees == 1 else 0.0
        return math.exp((degrees - 1) * math.log(r) - r * r / 2 - (degrees / 2 - 1) * math.log(2) - math.lgamma(degrees / 2))

    low, high, pieces = math.sqrt(chi_square), math.sqrt(chi_square) + math.sqrt(degrees) + 12, 20000
    step = (high - low) / pieces
    return step / 3 * sum((1 if i in (0, pieces) else 4 if i % 2 else 2) * density(low + i * step) for i in range(pieces + 1))


def readings(file):
    text = file.read_bytes().decode("utf-8-sig")
    between = ";" if ";" in text.splitlines()[0] else ","
    for number, cells in enumerate(csv.reader(text.splitlines(), delimiter=between), 1):
        if number > 1 and cells and cells[2]:
            value, uncertainty = (float(cell.replace(",", ".")) for cell in cells[2:])
            yield cells[0], number, value, uncertainty, (value - THEORY[cells[0]]) / uncertainty


def cells_of(name):
    table = re.search(f'<table class="{name}">(.*?)</table>', page.read_text(), re.S).group(1)
    for row in re.findall(r"<tr><td>(.*?)</td></tr>", table, re.S):
        row = re.sub(r"<svg.*?</svg>", "", row, flags=re.S)
        yield [html.unescape(cell).strip() for cell in re.split(r"</td><td[^>]*>", row)]


def number(text):
    return float(text.replace("−", "-").replace(",", ".").lstrip("< "))


def same(shown, right, figures, what):
    """The page has `figures` significant figures, or a fixed number of decimals where it is negative."""
    unit = 10.0 ** figures if figures < 0 else 10 ** (math.floor(math.log10(max(abs(right), 1e-9))) - figures + 1)
    assert abs(number(shown) - right) <= 0.51 * unit + 1e-4 * abs(right), (what, shown, right)


def same_probability(shown, right, what):
    if shown.startswith("<"):
        assert right < 0.001, (what, shown, right)
    else:
        assert abs(number(shown) - right) < 0.00051, (what, shown, right)


groups = {file.stem: list(readings(file)) for file in lists}
of_groups = {cells[0]: cells[1:] for cells in cells_of("groups")}
assert of_groups.keys() == groups.keys(), of_groups
for name, all_of in groups.items():
    count, ratio, chance, outliers, _ = of_groups[name]
    chi_square = math.fsum(z * z for *_, z in all_of)
    assert int(count) == len(all_of), name
    same(ratio, chi_square / len(all_of), -2, name)
    same_probability(chance, probability(chi_square, len(all_of)), name)
    assert int(outliers) == sum(abs(z) > 3 for *_, z in all_of), name

compared, quantity = 0, ""
for label, name, count, mean, spread, error, ratio, chance, outliers in cells_of("readings"):
    quantity = label.split(":")[0] or quantity
    those = [one for one in groups[name] if one[0] == quantity]
    off = [value - THEORY[quantity] for _, _, value, _, _ in those]
    chi_square = math.fsum(z * z for *_, z in those)
    what = f"{name} {quantity}"
    assert int(count) == len(those) > 1, what
    same(mean, statistics.fmean(off), 3, what)
    same(spread, statistics.stdev(off), 3, what)
    same(error, statistics.stdev(off) / math.sqrt(len(off)), 3, what)
    same(ratio, chi_square / len(those), -2, what)
    same_probability(chance, probability(chi_square, len(those)), what)
    lines = [str(line) for _, line, _, _, z in those if abs(z) > 3]
    assert outliers == (", ".join(lines) or "—"), (what, outliers, lines)
    compared += 1
assert compared == sum(len({no for no, *_ in all_of}) for all_of in groups.values()), compared

with open(page.with_name(page.stem + "-readings.csv"), newline="") as file:
    in_file = list(csv.DictReader(file))
expected = [(name, *one) for name, all_of in groups.items() for one in all_of]
assert len(in_file) == len(expected)
for row, (name, no, line, value, uncertainty, z) in zip(in_file, expected):
    assert (row["group"], row["of"], int(row["line"])) == (name, no, line), row
    assert float(row["reading"]) == value and float(row["uncertainty"]) == uncertainty, row
    assert abs(float(row["sigmas"]) - z) < 1e-4, (row, z)
print(f"{compared} quantities of {len(lists)} groups are those of the page; {len(expected)} readings are in its CSV file")
