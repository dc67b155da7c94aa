#!/usr/bin/env python3
"""Draws a few frames of a trace as docs/trace.svg:  python3 docs/trace.py out/trace.json [first frame] [frames]"""
import json
import pathlib
import sys

text = pathlib.Path(sys.argv[1]).read_text().rstrip().rstrip(",")
events = [e for e in json.loads(text if text.endswith("]") else text + "]") if e.get("ph") == "X"]
first, frames = int(sys.argv[2]) if len(sys.argv) > 2 else 20, int(sys.argv[3]) if len(sys.argv) > 3 else 3
begins = sorted(e["ts"] for e in events if e["name"] == "wait")
start, end = begins[first], begins[first + frames]
colours = {"wait": "#d9dee5", "controls": "#f2b134", "plan": "#3c78b4", "cull": "#5aa469", "upload": "#8e6bbf",
           "record": "#d1495b", "present": "#9aa7b5", "cube pass": "#3c78b4", "meter": "#f2b134", "warp": "#d1495b",
           "stars": "#8e6bbf", "overlay": "#5aa469", "HUD": "#e07a3f", "finish": "#48909b", "bloom": "#c76b98"}
width, left, row = 1000, 90, 30
scale = (width - left - 20) / (end - start)
out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} 196" font-family="DejaVu Sans, sans-serif" font-size="12">',
       f'<rect width="{width}" height="196" fill="#ffffff"/>']
inner = {"stars", "bloom"}  # drawn within the warp, on a row of their own
rows = {("processor", 0): 30, ("GPU", 0): 74, ("GPU", 1): 104}
for label, y in (("processor", 30), ("GPU", 74)):
    out.append(f'<text x="{left - 10}" y="{y + 19}" text-anchor="end" fill="#222222">{label}</text>')
used = {}
for e in sorted(events, key=lambda e: e["ts"]):
    if e["ts"] + e["dur"] < start or e["ts"] > end:
        continue
    gpu = e["name"] in ("cube pass", "meter", "probes", "warp", "stars", "bloom", "overlay", "HUD", "finish")
    y = rows[("GPU", 1) if e["name"] in inner else ("GPU", 0) if gpu else ("processor", 0)]
    x0 = left + max(0, e["ts"] - start) * scale
    x1 = left + min(end - start, e["ts"] + e["dur"] - start) * scale
    fill = colours.get(e["name"], "#888888")
    used[e["name"]] = fill
    out.append(f'<rect x="{x0:.1f}" y="{y}" width="{max(0.8, x1 - x0):.1f}" height="{row - 4}" fill="{fill}"/>')
    if x1 - x0 > 7.5 * len(e["name"]):
        dark = e["name"] in ("wait", "present", "controls", "meter")
        out.append(f'<text x="{(x0 + x1) / 2:.1f}" y="{y + 17}" text-anchor="middle" fill="{"#222222" if dark else "#ffffff"}">{e["name"]}</text>')
for ms in range(0, int((end - start) / 1000) + 1, 10):
    x = left + 1000 * ms * scale
    out.append(f'<line x1="{x:.1f}" y1="22" x2="{x:.1f}" y2="134" stroke="#222222" stroke-opacity="0.25"/>'
               f'<text x="{x:.1f}" y="16" text-anchor="middle" fill="#444444">{ms} ms</text>')
x = left
for name, fill in used.items():
    out.append(f'<rect x="{x}" y="152" width="12" height="12" fill="{fill}"/><text x="{x + 17}" y="163" fill="#222222">{name}</text>')
    x += 34 + 8 * len(name)
    if x > width - 120:
        break
out.append("</svg>")
(pathlib.Path(__file__).parent / "trace.svg").write_text("\n".join(out) + "\n")
