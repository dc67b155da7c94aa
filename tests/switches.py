#!/usr/bin/env python3
"""Flies a minute through the switches by which a visitor changes the picture, and prints the longest frames, with and without a
warm-up before.

    tests/switches.py STARBOW [SECONDS] [-- OPTIONS FOR starbow run]      (needs a display: xvfb-run works)

The script writes a record and replays it: the lever goes up to its end and back, and four times a second another switch is
pressed. A frame's time in the trace is from its reading of the controls to the next frame's.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

starbow, seconds = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 and sys.argv[2] != "--" else 60.0
options = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
# Every switch that changes the picture, but for those that change the flight's place, the window or the exhibit.
table = (pathlib.Path(__file__).parent.parent / "config/model/switches.h").read_text()
left_out = ["stop", "home", "undo", "reset", "full_screen", "menu"]
switches = [name for name in re.findall(r'SwitchEntry\{\s*Switch::\w+, "(\w+)", Leap::(?:press|toggle)', table) if name not in left_out]
presses = {"comparison": 3, "overlay": 6, "why": 7, "plot": 4, "next_mode": 3, "slow_motion": 3, "information": 3, "beside": 6,
           "pattern": 6}  # presses until the first state is back; the others need two
sequence = [name for name in switches for _ in range(presses.get(name, 2))]


def flown(work, warm_up, cache):
    """Frame times in ms of the flight."""
    first, record, trace = work / "first.jsonl", work / "record.jsonl", work / "trace.json"
    for file in (first, record, trace):
        file.unlink(missing_ok=True)
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    subprocess.run([starbow, "run", "--frames", "1", "--record", str(first), *options], check=True, **quiet)
    header = first.read_text().splitlines()[0]
    frame_s, lines = 1 / 15, [header]
    for i in range(int(seconds / frame_s)):
        t = i * frame_s
        frame = {"dt_ns": int(1e9 * frame_s), "lever": round(1 - abs(2 * t / seconds - 1), 4)}
        press = int(4 * t)
        if int(4 * (t - frame_s)) != press:
            frame[sequence[press % len(sequence)]] = True
        lines.append(json.dumps(frame))
    record.write_text("\n".join(lines) + "\n")
    environment = dict(__import__("os").environ, STARBOW_CACHE=str(cache), MESA_SHADER_CACHE_DIR=str(cache))
    subprocess.run(
        [starbow, "run", "--replay", str(record), "--warm-up", warm_up, "--trace", str(trace)], env=environment, **quiet
    )
    text = trace.read_text().rstrip().rstrip(",")
    events = json.loads(text if text.endswith("]") else text + "]")
    begins = sorted(e["ts"] for e in events if e.get("ph") == "X" and e["name"] == "controls")
    return [(b - a) / 1000 for a, b in zip(begins, begins[1:])]


def line(name, times):
    ordered = sorted(times)
    late = sum(t > 3 * ordered[len(ordered) // 2] for t in times)
    print(f"{name:32} {len(times):6} frames  median {ordered[len(ordered) // 2]:7.1f} ms  longest {ordered[-1]:8.1f} ms  "
          f"above three medians: {late}")


with tempfile.TemporaryDirectory() as folder:
    work = pathlib.Path(folder)
    for name, warm_up, cache in (("without warm-up, cold cache", "never", "a"), ("without warm-up, warm cache", "never", "a"),
                                 ("with warm-up, cold cache", "always", "b"), ("with warm-up, warm cache", "always", "b")):
        (work / cache).mkdir(exist_ok=True)
        line(name, flown(work, warm_up, work / cache))
