"""exhibit_load.py STARBOW [PAIRS] [WIDTHxHEIGHT]: the whole exhibit under load, some minutes long.

It flies in a window of an Xvfb of its own. Phases of ten seconds without and with 200 pages follow each other, so that both see
the same noise of the machine; the program's trace tells each frame's time. Then an engineer's page switches a test pattern on
and off, and the time until the screen's pixels differ is the time from command to picture."""
import json
import math
import mmap
import os
import random
import subprocess
import sys
import tempfile
import time

from load import PAGES, PORT, frame, log_in, open_page, phase

PHASE_S, SWITCHES = 10.0, 100
LIMIT_FRAMES, LIMIT_MS = 2, 5


class Screen:
    """The middle of the window at (0, 0) of an Xvfb's frame buffer, an XWD file of four bytes a pixel."""

    def __init__(self, file, width, height):
        self.file = open(file, "rb")
        self.bytes = mmap.mmap(self.file.fileno(), 0, prot=mmap.PROT_READ)
        word = lambda k: int.from_bytes(self.bytes[4 * k:4 * k + 4], "big")
        header, self.stride, colours = word(0), word(12), word(19)
        self.first = header + 12 * colours + (height // 2) * self.stride + 4 * (width // 4)
        self.length = 4 * (width // 2)

    def row(self):
        return self.bytes[self.first:self.first + self.length]


def difference(a, b):
    return sum(abs(x - y) for x, y in zip(a[::8], b[::8])) / max(1, len(a[::8]))


def commands_to_pictures(screen):
    """Milliseconds from sending a command to another picture."""
    cookie = log_in("333333")
    times, names = [], ["grid", "none"]
    for turn in range(2 + SWITCHES):
        page = open_page(cookie)  # a new one each time, because this client answers no ping
        before = screen.row()
        time.sleep(random.uniform(0.2, 0.3))  # at any moment of a frame
        page.sendall(frame(json.dumps({"id": turn + 1, "command": ["pattern", names[turn % 2]]})))
        sent = time.monotonic()
        while difference(screen.row(), before) < 5:
            if time.monotonic() > sent + 5:
                raise SystemExit(f"no other picture for command {turn} within five seconds; the page got {page.recv(4096)[-300:]!r}")
            time.sleep(0.0002)
        if turn >= 2:  # the first ones make pipelines
            times.append(1e3 * (time.monotonic() - sent))
        page.close()
    return sorted(times)


def percentile(values, part):
    return sorted(values)[math.ceil(part * len(values)) - 1]


def main():
    program = os.path.abspath(sys.argv[1])
    pairs = int(sys.argv[2]) if len(sys.argv) > 2 else 6
    size = [int(n) for n in (sys.argv[3] if len(sys.argv) > 3 else "160x120").split("x")]
    os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))  # shipped files lie above the current folder
    with tempfile.TemporaryDirectory() as folder:
        with open(folder + "/layout.json", "w", encoding="utf-8") as file:
            json.dump({"outputs": [{"name": "a", "size": size, "place": [0, 0],
                                    "viewports": [{"projection": {"type": "planar"}}]}]}, file)
        with open(folder + "/exhibit.json", "w", encoding="utf-8") as file:
            json.dump({"layout": folder + "/layout.json", "scene": "avenue", "remote": {"port": PORT, "pins": "pins"}}, file)
        with open(os.open(folder + "/pins", os.O_WRONLY | os.O_CREAT, 0o640), "w", encoding="utf-8") as file:
            file.write("docent 222222\nengineer 333333\n")
        read, write = os.pipe()
        server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-noreset", "-screen", "0", "640x480x24", "-fbdir", folder],
                                  pass_fds=[write], stderr=subprocess.DEVNULL)
        display = ":" + os.read(read, 20).decode().strip()
        exhibit = subprocess.Popen([program, "run", "--exhibit", folder + "/exhibit.json", "--trace", folder + "/trace.json"],
                                   env=os.environ | {"DISPLAY": display, "STATE_DIRECTORY": folder + "/state"},
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            for _ in range(100):
                try:
                    cookie = log_in()
                    break
                except OSError:
                    time.sleep(0.2)
            else:
                raise SystemExit("the exhibit serves no page within twenty seconds")
            time.sleep(3)  # the first pictures
            spans, states = [], []
            for _ in range(pairs):
                for count in (0, PAGES):
                    pages = [open_page(cookie) for _ in range(count)]
                    phase(pages, 0.5)
                    began = time.monotonic()
                    rate = phase(pages, PHASE_S)
                    if count:
                        states.append(rate)
                    spans.append((count, began, time.monotonic()))
                    for page in pages:
                        page.close()
                    time.sleep(0.5)
            times = commands_to_pictures(Screen(folder + "/Xvfb_screen0", *size))
        finally:
            ended_at = time.monotonic()
            exhibit.terminate()
            exhibit.wait()
            server.terminate()
        with open(folder + "/trace.json", encoding="utf-8") as file:
            events = [e for e in json.load(file) if e.get("ph") == "X" and e["name"] == "controls"]
    # The trace's clock begins with the program; the program ended at the trace's last frame.
    begins = [e["ts"] * 1e-6 + ended_at - events[-1]["ts"] * 1e-6 for e in events]
    p99 = {0: [], PAGES: []}
    print("pages  frames/s  frame p50, p99, greatest (ms)")
    for count, began, ended in spans:
        own = [1e3 * (b - a) for a, b in zip(begins, begins[1:]) if began <= a and b <= ended]
        p99[count].append(percentile(own, 0.99))
        print(f"{count:5} {len(own) / (ended - began):9.1f}  {percentile(own, 0.5):.2f} {p99[count][-1]:.2f} {max(own):.2f}")
    ratios = sorted(b / a for a, b in zip(p99[0], p99[PAGES]))
    print(f"{min(states):.2f} states a second and page at least")
    print(f"p99 with {PAGES} pages / p99 without: median {ratios[len(ratios) // 2]:.4f}, {ratios[0]:.4f} to {ratios[-1]:.4f}")
    whole = percentile([1e3 * (b - a) for a, b in zip(begins, begins[1:])], 0.5)
    limit = LIMIT_FRAMES * whole + LIMIT_MS
    print(f"command to picture: p50 {percentile(times, 0.5):.1f}, p99 {percentile(times, 0.99):.1f}, greatest {times[-1]:.1f} ms of "
          f"{limit:.1f} ({LIMIT_FRAMES} frames of {whole:.2f} ms, and {LIMIT_MS} ms)")
    return 0 if percentile(times, 0.99) <= limit else 1


sys.exit(main())
