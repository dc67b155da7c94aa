#!/usr/bin/env python3
"""Measures an exhibit of several nodes, here programs on one machine under Xvfb, of which one is killed now and then.

Usage: docs/machines/measure.py PROGRAM OUT [--seconds 60] [--kill-every 10] [--nodes 4] [--size 320x240] [--scene avenue]

Writes OUT.svg, each node's frame number over time, and prints: the skew between the nodes' words to show a frame, frames that were
shown with two states, how long the others stood still after a kill, how soon the killed node was in step again, and how much memory
the longest life has gained. With --kill-every 0 nobody is killed; --seconds 28800 is a night. Needs Xvfb."""
import argparse, json, os, random, shutil, signal, subprocess, sys, tempfile, time
from pathlib import Path


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--kill-every", type=float, default=10)
    parser.add_argument("--nodes", type=int, default=4)
    parser.add_argument("--size", default="320x240")
    parser.add_argument("--scene", default="avenue")
    parser.add_argument("--quality", default="draft")
    parser.add_argument("--display", default="", help="a running X server, such as :5, with a screen for all nodes side by side")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--logs", type=Path, help="a folder that keeps the logs of the frames")
    parser.add_argument("--namespaces", default="", help="network namespaces, as ip netns made them, one for each node: A,B,...")
    parser.add_argument("--interface", default="lo", help="the network of the namespaces, such as 10.77.0.0/24")
    return parser.parse_args()


class Nodes:
    """The programs, each with a log of frames for each of its lives."""

    def __init__(self, options, folder):
        self.options, self.folder = options, folder
        self.names = ["node%d" % i for i in range(options.nodes)]
        self.processes, self.logs = {}, {name: [] for name in self.names}
        self.memory = {}  # of each life: megabytes at each look
        width, height = map(int, options.size.split("x"))
        outputs = [
            {"name": name, "node": name, "size": [width, height], "place": [width * i, 0], "monitor": {"position": [0, 0]},
             "viewports": [{"projection": {"type": "planar", "fov_y_deg": 50, "turn_deg": {"yaw": 60 * i - 90}}}]}
            for i, name in enumerate(self.names)]
        (folder / "walls.json").write_text(json.dumps({"outputs": outputs}))
        (folder / "exhibit.json").write_text(json.dumps(
            {"layout": "walls.json", "scene": options.scene, "tutorial": False,
             "machines": {"master": self.names[0], "interface": options.interface, "domain": 20 + os.getpid() % 170}}))

    def begin(self, name):
        life = len(self.logs[name])
        log = self.folder / ("%s-%d.csv" % (name, life))
        self.logs[name].append(log)
        with open(self.folder / ("%s-%d.log" % (name, life)), "w") as said:
            there = self.options.namespaces.split(",") if self.options.namespaces else []
            self.processes[name] = subprocess.Popen(
                (["ip", "netns", "exec", there[self.names.index(name)]] if there else []) + [self.options.program, "run", "--exhibit", self.folder / "exhibit.json", "--node", name, "--frame-log", log,
                 "--quality", self.options.quality], stdout=said, stderr=said)

    def kill(self, name):
        self.processes[name].send_signal(signal.SIGKILL)
        self.processes[name].wait()

    def look_at_memory(self):
        for name, process in self.processes.items():
            status = Path("/proc/%d/status" % process.pid)
            kilobytes = [int(line.split()[1]) for line in status.read_text().splitlines() if line.startswith("VmRSS")]
            self.memory.setdefault((name, process.pid), []).append(sum(kilobytes) / 1024)

    def end(self):
        for process in self.processes.values():
            process.send_signal(signal.SIGINT)
        for process in self.processes.values():
            process.wait()

    def shown(self, name):
        """All that a node has shown: times in seconds, frames, digests."""
        rows = []
        for log in self.logs[name]:
            if log.exists():
                for line in log.read_text().splitlines()[1:]:
                    parts = line.split(",")
                    if len(parts) == 4 and "." in parts[3]:
                        rows.append((int(parts[0]) * 1e-9, int(parts[1]), parts[2]))
        return rows

    def lives_frame(self, name):
        log = self.logs[name][-1]
        return log.exists() and log.stat().st_size > 100


def wait_until(condition, seconds, what):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            sys.exit("measure: %s has not come for %g s" % (what, seconds))
        time.sleep(0.02)


def part(values, share):
    ordered = sorted(values)
    return ordered[min(int(share * len(ordered)), len(ordered) - 1)] if ordered else float("nan")


def picture(nodes, rows, kills):
    width, height, left, low = 1000, 420, 70, 380
    begin = min(row[0] for one in rows.values() for row in one)
    end = max(row[0] for one in rows.values() for row in one)
    x = lambda t: left + (t - begin) / max(end - begin, 1e-9) * (width - left - 20)
    # Each master counts on from the time of its start, so a frame's place in the order is drawn.
    order = {frame: i for i, frame in enumerate(sorted({row[1] for one in rows.values() for row in one}))}
    last = len(order) - 1
    y = lambda place: low - place / max(last, 1) * (low - 60)
    colours = ["#c0392b", "#2471a3", "#1e8449", "#b7950b", "#6c3483", "#117a65", "#884ea0", "#935116"]
    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" font-family="sans-serif" font-size="14">' % (width, height),
           '<rect width="100%" height="100%" fill="white"/>']
    for when, name in kills:
        out.append('<line x1="%.1f" y1="50" x2="%.1f" y2="%d" stroke="#999" stroke-dasharray="3 3"/>' % (x(when), x(when), low))
        out.append('<text x="%.1f" y="45" text-anchor="middle" font-size="11" fill="#666">%s</text>' % (x(when), "end of " + name))
    for i, name in enumerate(nodes.names):
        colour, before = colours[i % len(colours)], None
        lift = 6 * (i - (len(nodes.names) - 1) / 2)  # beside each other: the lines would hide each other
        points = []
        def flush():
            if len(points) > 1:
                out.append('<polyline fill="none" stroke="%s" stroke-width="2.5" points="%s"/>' % (colour, " ".join(points)))
            points.clear()
        step = max(len(rows[name]) // 600, 1)
        for k, (when, frame, _) in enumerate(rows[name]):
            if before and when - before > 0.4:
                flush()
            if k % step == 0 or (before and when - before > 0.2):
                points.append("%.1f,%.1f" % (x(when), y(order[frame]) + lift))
            before = when
        flush()
        out.append('<text x="%d" y="20" fill="%s">%s%s</text>' % (left + 150 * i, colour, name, " (master)" if i == 0 else ""))
    out.append('<line x1="%d" y1="%d" x2="%d" y2="%d" stroke="black"/>' % (left, low, width - 20, low))
    for k in range(6):
        when = begin + (end - begin) * k / 5
        out.append('<text x="%.1f" y="%d" text-anchor="middle">%.0f s</text>' % (x(when), low + 20, when - begin))
        frame = last * k / 5
        out.append('<text x="%d" y="%.1f" text-anchor="end">%d</text>' % (left - 8, y(frame) + 5, frame))
    out.append('<text x="16" y="%d" transform="rotate(-90 16 %d)" text-anchor="middle">frame</text></svg>' % (low / 2, low / 2))
    return "\n".join(out) + "\n"


def begin_server(options):
    """An X server with room for all nodes; sets DISPLAY."""
    read, write = os.pipe()
    width, height = map(int, options.size.split("x"))
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-noreset", "-screen", "0", "%dx%dx24" % (width * options.nodes, height)],
                              pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    os.environ["DISPLAY"] = ":" + os.read(read, 16).decode().strip()
    return server


def main():
    options = arguments()
    random.seed(options.seed)
    server = None if options.display else begin_server(options)
    if options.display:
        os.environ["DISPLAY"] = options.display
    with tempfile.TemporaryDirectory() as name:
        nodes = Nodes(options, Path(name))
        for node in nodes.names:
            nodes.begin(node)
        for node in nodes.names:
            wait_until(lambda: nodes.lives_frame(node), 120, "a frame of " + node)
        began, kills, backs = time.monotonic(), [], []
        next_kill, next_look, look_every = began + options.kill_every, began, options.seconds / 200
        while (now := time.monotonic()) < began + options.seconds:
            if sys.stderr.isatty():
                print("\r%.0f of %.0f s, %d kills" % (now - began, options.seconds, len(kills)), end="", file=sys.stderr)
            if options.kill_every > 0 and now >= next_kill:
                victim = random.choice(nodes.names)
                nodes.kill(victim)
                kills.append((time.monotonic(), victim))
                nodes.begin(victim)
                next_kill += options.kill_every
            if now >= next_look:
                nodes.look_at_memory()
                next_look += look_every
            if any(p.poll() is not None for p in nodes.processes.values()):
                sys.exit("measure: a node has ended by itself; its log is:\n" + "\n".join(
                    log.read_text() for log in sorted(nodes.folder.glob("*.log"))))
            time.sleep(0.05)
        nodes.end()
        rows = {node: nodes.shown(node) for node in nodes.names}
        if options.logs:
            options.logs.mkdir(parents=True, exist_ok=True)
            for log in nodes.folder.glob("*.csv"):
                shutil.copy(log, options.logs)
    if server:
        server.terminate()
        server.wait()

    master = rows[nodes.names[0]]
    by_frame = {}
    for node in nodes.names:
        for when, frame, digest in rows[node]:
            by_frame.setdefault(frame, []).append((node, when, digest))
    together = [shows for shows in by_frame.values() if len({node for node, _, _ in shows}) == options.nodes]
    skews = [max(w for _, w, _ in shows) - min(w for _, w, _ in shows) for shows in together]
    mixed = sum(len({digest for _, _, digest in shows}) > 1 for shows in by_frame.values())
    period = part([b[0] - a[0] for a, b in zip(master, master[1:])], 0.5)
    print("%d frames of the master, one each %.1f ms; %d of them shown by all %d nodes" % (len(master), 1e3 * period, len(together), options.nodes))
    print("skew between the nodes: p50 %.3f ms, p99 %.3f ms, most %.1f ms" % (1e3 * part(skews, 0.5), 1e3 * part(skews, 0.99), 1e3 * max(skews, default=0)))
    print("frames shown with two states: %d of %d" % (mixed, len(by_frame)))
    still, back = [], []
    for when, victim in kills:
        for node in nodes.names:
            times = [row[0] for row in rows[node] if when - 0.5 < row[0] < when + 2]
            if node != victim and victim != nodes.names[0]:
                still += [max((b - a for a, b in zip(times, times[1:])), default=float("nan")) / period]
        shows = sorted(row for row in rows[victim] if row[0] > when)
        if victim != nodes.names[0] and shows:
            first = shows[0][0]
            close = [row[0] for row in shows if any(abs(row[0] - w) < period for n, w, _ in by_frame[row[1]] if n != victim)]
            back += [close[0] - first if close else float("nan")]
    if kills:
        print("%d kills; after those of a node the others stood still for at most %.1f frames (p50 %.1f)" % (len(kills), max(still, default=0), part(still, 0.5)))
        print("a killed node was in step %.0f ms (at most %.0f ms) after its first picture" % (1e3 * part(back, 0.5), 1e3 * max(back, default=0)))
    (name, _), life = max(nodes.memory.items(), key=lambda one: len(one[1]))
    print("memory of the longest life, %s's of %.0f s: %.0f MB after a tenth of it, %.0f MB at its end" % (
        name, len(life) * look_every, life[len(life) // 10], life[-1]))
    options.out.with_suffix(".svg").write_text(picture(nodes, rows, kills))
    print(options.out.with_suffix(".svg"))


main()
