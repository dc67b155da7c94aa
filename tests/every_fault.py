#!/usr/bin/env python3
"""Lets every Vulkan call of a flight fail with every error that Vulkan's registry names for it, and says what was wrong.

every_fault.py PROGRAM FOLDER-OF-THE-RIG [--only TEXT] [--sample N] [--allocations N]

Each failure is one flight of 40 frames, in which the window's size and the layout change. A call fails
  start   at its first call: the program ends with one line and exit status 2, or goes on
  flight  at its first call after ten pictures: all frames are shown. A lack of memory while the new layout's or size's objects
          are made keeps the device; all else opens it anew
  lost    at its first call while a lost device is opened anew: all frames are shown
The starts of threads and about so many allocations of the program fail, too, at the start and in flight.
--only: those whose name has the text. --sample: every Nth. Exit status 1 if any misbehaves. The registry is libvulkan-dev's
vk.xml. It needs Xvfb."""
import argparse
import concurrent.futures
import json
import os
import subprocess
import tempfile
import time
import xml.etree.ElementTree

frames = 40
# Errors of extensions that no flight uses.
foreign = {"VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS_KHR", "VK_ERROR_FULL_SCREEN_EXCLUSIVE_MODE_LOST_EXT",
           "VK_ERROR_INVALID_SHADER_NV", "VK_ERROR_COMPRESSION_EXHAUSTED_EXT", "VK_ERROR_FRAGMENTATION", "VK_ERROR_FRAGMENTATION_EXT",
           "VK_ERROR_INVALID_EXTERNAL_HANDLE"}


def layout(folder, width):
    path = os.path.join(folder, "layout.json")
    with open(path + ".new", "w", encoding="utf-8") as file:
        json.dump({"outputs": [{"name": "a", "size": [width, 120], "place": [0, 0],
                                "viewports": [{"projection": {"type": "fisheye", "aperture_deg": 180}}]}]}, file)
    os.replace(path + ".new", path)
    return path


def serve():
    read, write = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-noreset", "-screen", "0", "1280x800x24"], pass_fds=[write],
                              stderr=subprocess.DEVNULL)
    return server, ":" + os.read(read, 20).decode().strip()


def fly(program, rig, display, fault, count=False):
    """The exit status and the lines of one flight."""
    with tempfile.TemporaryDirectory() as folder:
        # Mesa's layer that sorts devices crashes where their extensions can't be listed.
        environment = os.environ | {"NODEVICE_SELECT": "1", "DISPLAY": display, "VK_LAYER_PATH": rig, "VK_INSTANCE_LAYERS": "VK_LAYER_STARBOW_faults",
                                    "STARBOW_FAULTS": fault,
                                    "LD_PRELOAD": os.path.join(rig, "libstarbow_no_memory.so"), "STATE_DIRECTORY": os.path.join(folder, "state")}
        if count:
            environment["STARBOW_COUNT_CALLS"] = "1"
        lines = []
        flight = subprocess.Popen([program, "run", "--layout", layout(folder, 160), "--scene", "chart", "--trace",
                                   os.path.join(folder, "trace"), "--frames", str(frames)], env=environment,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        began = time.monotonic()
        for line in flight.stderr:
            lines.append(line.rstrip())
            if line.startswith("fault: 10 pictures"):
                layout(folder, 200)
            if time.monotonic() - began > 120:
                flight.kill()
        status = flight.wait()
        crashes = os.path.join(folder, "state", "crash")
        if os.path.isdir(crashes):
            lines.append("crash trace written")
        return status, lines


def wrong(when, fault, status, lines):
    """The reason why a flight misbehaved, or ''."""
    happened = any(line == "fault: " + fault.split(",")[-1] for line in lines)
    said = [line for line in lines if not line.startswith(("fault:", "call:"))]
    if not happened and not fault.startswith(("new", "thread")):  # a later flight has some allocations less
        return "the fault did not happen"
    if "crash trace written" in lines:
        return "it crashed"
    if status == 0:
        shown = sum(int(line.split()[2]) for line in lines if line.startswith("fault: shown"))
        if shown < frames - 3:
            return f"only {shown} pictures of {frames}"
        anew = any("it is opened again" in line for line in said)
        # Some happen whenever a window changes; on two nothing depends.
        usual = ("new", "thread", "SURFACE_LOST", "OUT_OF_DATE", "NATIVE_WINDOW_IN_USE", "vkDeviceWaitIdle", "vkGetPipelineCacheData")
        if when == "flight" and not anew and not any(one in fault for one in usual) and not any(
                "stays as it was" in line or "is drawn smaller" in line or "is not shown" in line for line in said):
            return "silent"
        return ""
    ends = [line for line in said if line.startswith("starbow: ")]
    if when == "start" and status == 2 and len(ends) == 1:
        return ""
    return f"exit {status}"


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("program")
    arguments.add_argument("rig")
    arguments.add_argument("--only", default="")
    arguments.add_argument("--sample", type=int, default=1, metavar="N")
    arguments.add_argument("--allocations", type=int, default=100)
    arguments.add_argument("--verbose", action="store_true")
    chosen = arguments.parse_args()
    registry = xml.etree.ElementTree.parse("/usr/share/vulkan/registry/vk.xml")
    errors = {command.findtext("proto/name"): command.get("errorcodes", "").split(",")
              for command in registry.iter("command") if command.find("proto") is not None}
    aliases = {command.get("name"): command.get("alias") for command in registry.iter("command") if command.get("alias")}
    server, display = serve()
    try:
        status, lines = fly(chosen.program, chosen.rig, display, "", count=True)
        calls = {line.split()[1]: [int(n) for n in line.split()[2:]] for line in lines if line.startswith("call:")}
        assert status == 0 and calls, (status, lines)
        faults = []
        memory = {name: calls.pop(name) for name in ("new", "thread")}
        for name, (before, after) in memory.items():
            for when, count in (("start", before), ("flight", after)):
                step = max(count // chosen.allocations, 1)
                faults += [(when, f"{name}{'@2' if when == 'flight' else ''}:{n}:OUT_OF_MEMORY")
                           for n in range(step // 2 + 1, count + 1, step)]
        for name, (before, after) in sorted(calls.items()):
            for error in errors[aliases.get(name, name)]:
                if error in foreign:
                    continue
                result = error.removeprefix("VK_ERROR_")
                faults.append(("start", f"{name}:1:{result}"))
                if after:
                    faults.append(("flight", f"{name}@10:1:{result}"))
                faults.append(("lost", f"submit@10:3:DEVICE_LOST,{name}@lost:1:{result}"))
        faults = [one for one in faults if chosen.only in one[1]][:: chosen.sample]
        began = time.monotonic()
        bad = 0

        def attempt(one):
            return one, *fly(chosen.program, chosen.rig, display, one[1])

        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for (when, fault), status, lines in pool.map(attempt, faults):
                why = wrong(when, fault, status, lines)
                bad += bool(why)
                if why or chosen.verbose:
                    print(f"{when} {fault}: {why or 'as it should'}", flush=True)
                    for line in lines[-6:] if why else [line for line in lines if not line.startswith("fault: shown")]:
                        print("    " + line)
        print(f"{len(faults)} failures, {bad} misbehave; {time.monotonic() - began:.0f} s")
    finally:
        server.terminate()
        server.wait()
    return 1 if bad or not faults else 0


if __name__ == "__main__":
    raise SystemExit(main())
