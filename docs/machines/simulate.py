#!/usr/bin/env python3
"""How the gate would do with more nodes: replays measured times of drawing a frame.

Usage: docs/machines/simulate.py LOG.csv... [--refresh-hz 60] [--network-ms 0.2] [--frames 200000]

The logs are those of starbow run --frame-log. Each simulated node draws times from one log, in its own order, a block of 100 frames at a
time, so that slow spells stay together. A frame goes when the slowest node has drawn it and the network has carried its word and the
master's; it is shown at the next refresh. A frame is dropped where it misses the refresh that its state was made for."""
import argparse, random, sys


def times_of(path):
    with open(path) as file:
        rows = [line.rstrip("\n").split(",") for line in file][1:]
    times = [float(row[3]) for row in rows if len(row) == 4][20:]  # the first frames compile pipelines
    if len(times) < 200:
        sys.exit("simulate: %s has %d frames; some hundred are right" % (path, len(times)))
    return times


def replay(times, random_):
    block = 100
    while True:
        first = random_.randrange(len(times) - block)
        yield from times[first:first + block]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("logs", nargs="+")
    parser.add_argument("--refresh-hz", type=float, default=60)
    parser.add_argument("--network-ms", type=float, default=0.2)
    parser.add_argument("--frames", type=int, default=200000)
    options = parser.parse_args()
    measured = [times_of(log) for log in options.logs]
    refresh_ms = 1000 / options.refresh_hz
    print("nodes   gate p50   p99   p99.9 (ms)   dropped frames of %d at %g Hz" % (options.frames, options.refresh_hz))
    for nodes in (1, 4, 8, 16, 64):
        random_ = random.Random(nodes)
        drawing = [replay(measured[i % len(measured)], random_) for i in range(nodes)]
        frames = max(options.frames // nodes, 5000)
        gates = sorted(max(map(next, drawing)) + (2 * options.network_ms if nodes > 1 else 0) for _ in range(frames))
        late = sum(gate > refresh_ms for gate in gates) / frames
        print("%5d   %8.2f %7.2f %7.2f      %9.0f (%.3f %%)" % (
            nodes, gates[frames // 2], gates[int(0.99 * frames)], gates[int(0.999 * frames)], late * options.frames, 100 * late))


main()
