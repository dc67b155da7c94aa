#!/usr/bin/env python3
"""Plays the service manager's part in sd_notify(3) for tests: binds a socket, starts a program with NOTIFY_SOCKET and
WATCHDOG_USEC, and starts it anew whenever it ends, as systemd would with Restart=always.

    service_manager.py [--watchdog S] [--abstract] [--runs N] [--until TEXT] SOCKET PROGRAM ARGUMENTS...

Each event is one line on standard output, after the seconds since the run's start: `start N PID`, every line of every message,
`silent` where the watchdog's time is over (the program then gets SIGABRT; one that ends already, of which a driver's thread of
low priority waits for a processor to free the memory, is not silent), and `end STATUS`, negative for a signal. It leaves after
N runs, or once a message has the line TEXT and a sign of life after it; then it ends the program with SIGTERM. A time that
STATUS=, READY=1 or a watchdog may still take is no limit here: only the watchdog ends a run."""
import argparse
import os
import select
import signal
import socket
import subprocess
import sys
import time


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--watchdog", type=float, default=5)
    options.add_argument("--abstract", action="store_true")
    options.add_argument("--runs", type=int, default=1)
    options.add_argument("--until")
    options.add_argument("socket")
    options.add_argument("command", nargs=argparse.REMAINDER)
    given = options.parse_args()
    inbox = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    inbox.bind("\0" + given.socket if given.abstract else given.socket)
    name = "@" + given.socket if given.abstract else given.socket
    for run in range(1, given.runs + 1):
        if follow(run, given, inbox, name):
            return


def ends_already(pid):
    """Whether the process' first thread has ended, and another one has not yet."""
    with open(f"/proc/{pid}/stat") as file:
        return file.read().rpartition(")")[2].split()[0] == "Z"


def follow(run, given, inbox, name):
    """One run of the program. Returns True once the awaited line has come."""
    began = time.monotonic()

    def say(text):
        print(f"{time.monotonic() - began:.3f} {text}", flush=True)

    environment = dict(os.environ, NOTIFY_SOCKET=name, WATCHDOG_USEC=str(int(1e6 * given.watchdog)))
    program = subprocess.Popen(given.command, env=environment)
    say(f"start {run} {program.pid}")
    signal.signal(signal.SIGTERM, lambda *_: program.terminate())
    limit_s, alive, ready, awaited = given.watchdog, began, False, False
    while True:
        if select.select([inbox], [], [], 0.02)[0]:
            for line in inbox.recv(65536).decode().splitlines():
                say(line)
                ready |= line == "READY=1"
                if line.startswith("WATCHDOG_USEC="):
                    limit_s, alive = 1e-6 * float(line.split("=")[1]), time.monotonic()
                if line in ("WATCHDOG=1", "READY=1"):
                    alive = time.monotonic()
                if awaited and line == "WATCHDOG=1":
                    program.terminate()
                awaited |= line == given.until
        elif program.poll() is not None:
            say(f"end {program.returncode}")
            return awaited
        if ready and time.monotonic() - alive > limit_s and not ends_already(program.pid):
            say("silent")
            alive = time.monotonic() + 60
            program.send_signal(signal.SIGABRT)


if __name__ == "__main__":
    sys.exit(main())
