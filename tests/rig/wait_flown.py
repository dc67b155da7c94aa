#!/usr/bin/env python3
"""Waits until a flight that is being recorded has gone on for some seconds of its own time.

wait_flown.py RECORD SECONDS

A ship's clock goes slower than the wall's while frames take longer than a tenth of a second: a test that waits for the ship
passes under any load. After two minutes it gives up with exit status 1."""
import json
import sys
import time


def flown_s(record):
    total = 0
    try:
        with open(record, encoding="utf-8") as lines:
            for line in lines:
                if line.endswith("}\n"):  # the last line may not be whole
                    total += json.loads(line).get("dt_ns", 0)
    except FileNotFoundError:
        pass  # the program is still starting
    return total / 1e9


record, seconds = sys.argv[1], float(sys.argv[2])
end = time.monotonic() + 120
begin = flown_s(record)
while flown_s(record) < begin + seconds:
    if time.monotonic() > end:
        sys.exit(1)
    time.sleep(0.2)
