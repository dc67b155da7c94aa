#!/usr/bin/env python3
"""Plants faults in a copy of the tree, one at a time, and says which test finds each. No GPU is needed.

  tests/planted_faults.py                        every fault; some minutes to build the copy, then about half a minute each
  tests/planted_faults.py --room input           the faults of one room
  tests/planted_faults.py --only 7               one fault; --list shows the numbers
  tests/planted_faults.py --own-room             quicker: only the tests of each fault's own room
  tests/planted_faults.py --copy build/faulty    keeps the copy and what is built in it for the next time

A fault is a slip that compiles: a sign, a < for a <=, a swapped index, a forgotten member, a wrong unit. The copy is a git
worktree of the last commit, and the folder is removed at the end unless --copy names it. For each fault the script changes one
text, builds starbow_test without sanitizers, and runs the tests until one fails: first those that are expected to find it, then
all of tests/ROOM, then all the others (not with --own-room). A fault is
  found         by the named test
  survived      all tests pass: a test is missing
  not compiled  the compiler finds it
  stale         its text stands in the file not exactly once: mend the list below
The results are a JSON file; a fault that has one there is not tried again unless --again is given. Exit status 1 if a fault
survived or is stale."""
import argparse
import fcntl
import fnmatch
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

# Room, file, text, text with the fault, tests that are expected to find it.
FAULTS = [
    # What the tests without a GPU missed once.
    ("config", "config/json/row_cache.cpp", 'sum.add(&row, sizeof row);', '', "RowCache.*"),
    ("config", "config/json/kept_file.cpp", 'if (hash.value() != header_.sum)', 'if (false)', "KeptFiles.*:MapCache.*"),
    ("config", "config/json/hash.h", 'lane = std::rotl((lane ^ word) * odd, 29);', 'lane = (lane ^ word) * odd;', "ContentHash.*"),
    ("images", "runtime/images/movie.cpp", 'return is_whole_png(file(output, frame));',
     'return !RegularFile(file(output, frame)).has_fault();', "MovieFrames.*"),
    ("images", "runtime/images/movie.cpp", 'has_sources = fs::exists(folder_ / sources_name, error);',
     'has_sources = !before.empty();', "MovieFrames.*"),
    ("operation", "runtime/operation/usage_statistics.cpp", '*sum->json != sum_of(date, *hours.json)', 'sum->json->is_null()', "KeptState.*"),
    ("config", "config/model/switches.h", '"false_colours", Leap::toggle', '"false_colours", Leap::none', "CalmTest.*"),
    ("config", "config/model/switches.h", '"look_ahead", Leap::press', '"look_ahead", Leap::none', "CalmTest.*"),
    ("config", "config/model/switches.h", '"overlay", Leap::press', '"overlay", Leap::none', "CalmTest.*"),
    ("config", "config/model/switches.h", '"why", Leap::press', '"why", Leap::none', "CalmTest.*"),
    ("input", "input/channels.h", 'Way::place, 4,', 'Way::place, 40,', "CalmTest.*"),
    ("input", "input/presence.cpp", 'c.any()', '(c - Switches{Switch::inset}).any()', "PresenceTest.*"),
    ("input", "input/hands.cpp", 'if (frame.held || !frame.in_hand)', 'if (frame.held)', "Hands.*"),
    ("input", "input/hands.cpp", '{"lock", &Hands::lock},\n    {"hold", &Hands::hold}', '{"hold", &Hands::hold},\n    {"lock", &Hands::lock}',
     "Hands.*"),
    ("input", "input/requests.h", 'made = (made - later.withheld) | later.made', 'made = made | later.made', "Requests.*"),
    ("input", "input/choices.cpp", 'choices.range ^= pressed[Switch::range];', 'choices.range |= pressed[Switch::range];',
     "ChoicesTest.*"),
    ("input", "input/presence.cpp", 'c.any()', '(c - Switches{Switch::reset}).any()', "PresenceTest.*"),
    ("light", "runtime/light/exposure.cpp", 'std::floor(14 - brightest_ev)', 'std::floor(13 - brightest_ev)', "PreExposure.*"),
    ("light", "runtime/light/exposure.cpp", '10 - exposure_ev + std::log2(most_gain)', 'std::log2(most_gain) - exposure_ev',
     "PreExposure.*"),
    ("light", "runtime/light/exposure.cpp", 'if (below <= bright_from * all)', 'if (below < bright_from * all)', "Metering.*"),
    ("displays", "displays/compile/bend.cpp", 'weight[1] += 2 * weight[0], weight[2] -= weight[0];', '', "BendTest.*"),
    ("displays", "displays/compile/bend.cpp", 'before[i] * doubled_area(result, triangle) < 0', 'before[i] > 0 && false', "BendTest.*"),
    ("displays", "displays/projections/wall.cpp", '0.5 * std::atan2(-2 * slip * height,', '0.5 * std::atan2(2 * slip * height,', "WallTest.*"),
    ("displays", "displays/compile/cone_hierarchy.cpp", 'if (!skew_ || inside == foot_)', 'if (true)', "ConeHierarchyTest.*"),
    ("displays", "displays/compile/compiled_view.cpp", 'content += bend_key(own);', 'content += "bent";', "CompiledTest.*:BendTest.*"),
    ("config", "config/model/adjust.cpp", 'return adjusted(std::move(layout), grip.numbers[0], right - down);',
     'return adjusted(std::move(layout), grip.numbers[0], right + down);', "Adjust.*"),
    ("displays", "displays/projections/equirectangular.cpp", 'pi / 2 - step_.y / 4', 'pi / 2', "PanoramaTest.*"),

    ("config", "config/model/describe_layout.h", 'Number{{-90, 90}, 0.5, "height"}', 'Number{{-180, 180}, 0.5, "height"}', "Adjust.*"),
    ("config", "config/model/turn.cpp", 'std::atan2(-ahead.y * axes[1].x, ahead.y * axes[1].z)',
     'std::atan2(ahead.y * axes[1].x, ahead.y * axes[1].z)', "ImportSgct*"),
    ("config", "config/model/quality.cpp", '|| level.quality.matrices != first.matrices)', ')', "QualityTest.*"),
    ("config", "config/model/solar_system.cpp", 'per_day + per_century / 36525', 'per_day + per_century / 36500', "SolarSystemTest.*"),
    ("config", "config/model/exhibit_file.cpp", ' || name.ends_with(".jsonl")', '', "ExhibitFileTest.*"),

    ("displays", "displays/projections/lens.cpp", 's * (3 * k1 + s * 5 * k2)', 's * (3 * k1 + s * 4 * k2)', "LensTest.*"),
    ("displays", "displays/projections/spherical_mirror.cpp", '/ 2) - 1e-12)', '/ 2) + 1e-12)', "SphericalMirrorTest.*"),
    ("displays", "displays/finish/shade.cpp", 'value(high.x, high.y), f.x), f.y)', 'value(high.x, low.y), f.x), f.y)', "ShadeTest.*"),
    ("displays", "displays/compile/inverse_map.cpp",
     'cell = {cell.x < 0 ? -1 - cell.x : 2 * side - 1 - cell.x, side - 1 - cell.y};',
     'cell = {cell.x < 0 ? -cell.x : 2 * side - 1 - cell.x, side - 1 - cell.y};', "InverseMapTest.*"),
    ("displays", "displays/finish/blend.cpp", '&& order(upper.view) > order(lower.view)', '&& order(upper.view) >= order(lower.view)',
     "BlendTest.*"),

    ("input", "input/health.cpp", 'if (started > most_at_once', 'if (started >= most_at_once', "ReportTest.*:DevicesTest.*"),
    ("input", "input/lever.cpp", 'return a.place < b.place;', 'return a.place > b.place;', "LeverTest.*"),
    ("input", "input/head_tracker.cpp", 'std::chrono::duration<double>(hold_s + return_s)', 'std::chrono::duration<double>(hold_s)',
     "HeadTrackerTest.*"),
    ("input", "input/pad.cpp", '''{std::pair(GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER),
             {GLFW_GAMEPAD_BUTTON_LEFT_THUMB, GLFW_GAMEPAD_BUTTON_RIGHT_THUMB}}''',
     '{std::pair(GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER)}', "PadTest.*"),
    ("input", "input/calibration.cpp", '(axis.usage == 0x36 || axis.usage == 0x37)', 'axis.usage == 0x36', "CalibrationTest.*"),

    ("light", "runtime/light/range_curve.cpp", 'whole, 1 - above_high)', 'whole, 1 - below_low)', "RangeCurve.*"),
    ("light", "runtime/light/spectrum.cpp", 'nm > points.back().first)', 'nm >= points.back().first)', "SpectrumTest.*"),
    ("light", "runtime/light/gloss.cpp", 'std::sqrt(1 + width * width * (1', 'std::sqrt(1 + width * (1', "GlossTable.*"),
    ("light", "runtime/light/light_bound.cpp", '3 * log2_D(middle + 1)', '3 * log2_D(middle)', "LightBound.*"),
    ("light", "runtime/light/colour_difference.h", '(mean_h - 275) / 25', '(mean_h - 257) / 25', "FalseColoursTest.*"),

    ("world", "runtime/world/clock.cpp", 'return part < 0 ? part + 1 : part;', 'return part;', "ClockTest.*"),
    ("world", "runtime/world/observer.cpp", 'was_aligned ? least_fast_E : most_slow_E', 'was_aligned ? most_slow_E : least_fast_E',
     "CubeAxes.*"),
    ("world", "runtime/world/ephemeris.cpp", '(days + ahead_of_utc_s / 86400)', '(days - ahead_of_utc_s / 86400)', "Ephemeris.*"),
    ("world", "runtime/world/shape.cpp", 'normal * (mirrored ? -1.0 : 1.0)', 'normal', "WorldDeforming.*"),
    ("world", "runtime/world/shrink.cpp", 'light[i] = numbers ? double(i) / 255 : light_of_srgb', 'light[i] = light_of_srgb',
     "WorldMaterialTest.*"),

    ("plan", "runtime/plan/bounding_cap.cpp", 'sinh * cap.axis.z + cosh * least)', 'cosh * cap.axis.z + sinh * least)',
     "BoundingCap.*"),
    ("plan", "runtime/plan/cube_map_plan.cpp", '&& same->levels >= image.levels && same->needed', '&& same->needed', "CubeMapPlan.*"),
    ("plan", "runtime/plan/demand.cpp", 'radius < 1.57 ? std::sin(radius)', 'radius < 3.14 ? std::sin(radius)', "CubeMapPlan.*"),
    ("plan", "runtime/plan/lit_pixels.cpp", 'lit = away + reach <= lit_angle;', 'lit = away <= lit_angle;', "LitPixels.*"),
    ("plan", "runtime/plan/painters_order.cpp", 'return side < 0;', 'return side > 0;', "Cull.*"),

    ("flight", "runtime/flight/boundary.cpp", 'glm::length(from) > edge * boundary.radius && glm::dot',
     'glm::length(from) > boundary.radius && glm::dot', "BoundaryTest.*"),
    ("flight", "runtime/flight/comfort.cpp", 'std::atan2(-right.z, right.x)', 'std::atan2(right.z, right.x)', "ComfortTest.*"),
    ("flight", "runtime/flight/goals.cpp", 'value < condition.below', 'value <= condition.below', "GoalsTest.*"),
    ("flight", "runtime/flight/history.cpp", 'then.frozen = now.frozen, then.time_scale = now.time_scale;', 'then.frozen = now.frozen;',
     "Flight.*:SlowMotionTest.*"),

    ("visit", "runtime/visit/visit.cpp", 'events.length_s = in_seconds(visit.touched_ns);',
     'events.length_s = in_seconds(visit.visit_ns);', "VisitTest.*"),
    ("visit", "runtime/visit/attendance.cpp", 'goes_home_ &= !events.ends;', '', "AttendanceTest.*"),
    ("visit", "runtime/visit/docent.cpp", '(fades_ ? dt_s : -dt_s) / to_black_s', '(fades_ ? dt_s : -1) / to_black_s',
     "DocentTest.*"),
    ("visit", "runtime/visit/shown_light.cpp", 'exposure_.locked ^= now.locks;', '', "ShownLightTest.*"),
    ("visit", "runtime/visit/shown_light.cpp", 'now.source.shown_ev(eye, rules) + now.directed_ev', 'now.source.shown_ev(eye, rules)',
     "ShownLightTest.*"),
    ("visit", "runtime/visit/shown_light.cpp", 'eye.offset_ev = 0, rules.automatic = true', 'rules.automatic = true', "ShownLightTest.*"),
    ("visit", "runtime/visit/shown_light.cpp", 'filtered_ && exposure_.ev', 'filtered_', "ShownLightTest.*"),
    ("visit", "runtime/visit/shown_light.cpp", 'begun_ev_ = source.begun_ev();', '', "ShownLightTest.*"),

    ("hud", "runtime/hud/hud_place.cpp", '{0, -1, half.y}', '{0, -1, half.x}', "HudPlaceTest.*"),
    ("hud", "runtime/hud/signs.cpp", 'behind_cosine * distance * speed', 'behind_cosine * distance', "Signs.*"),
    ("hud", "runtime/hud/why_sketch.cpp", 'part_of(-light_per_s * t_s / apart)', 'part_of(light_per_s * t_s / apart)', "WhySketch.*"),
    ("hud", "runtime/hud/lab_readings.cpp", "squares / double(all.count - 1)", "squares / double(all.count)", "LabReadings.*"),
    ("hud", "runtime/hud/lab_readings.cpp", "std::lgamma(a + 1)", "std::lgamma(a)", "LabReadings.*"),
    ("hud", "runtime/hud/lab_entry.cpp", "!(*number > 0)", "false", "LabEntry.*"),
    ("hud", "runtime/hud/lab_rows.cpp", "Q::wavelength, 635.0853", "Q::wavelength, 476.314", "LabRows.*"),
    ("hud", "runtime/hud/lab_panel.cpp", "page.numbers.clear()", "page.numbers.size()", "LabScales.*"),
    ("hud", "runtime/hud/challenges.cpp", '(!best->solved && (one.solved', '((one.solved', "Challenges.*"),
    ("hud", "runtime/hud/instruments.cpp", 'found = i, nearest = off;', 'found = i;', "Instruments.*"),
]

# Test files are compiled several as one, and the rooms' files alone, so that a fault compiles one file.
UNITY_OF_TESTS = "cmake_language(DEFER CALL set_target_properties starbow_test PROPERTIES UNITY_BUILD ON)\n"


class Copy:
    """A copy of the tree with its build."""

    def __init__(self, folder, jobs):
        self.folder, self.jobs = folder, str(jobs)
        self.build_folder = os.path.join(folder, "build", "work")
        self.program = os.path.join(self.build_folder, "starbow_test")
        self.sound = os.path.join(folder, "build", "sound")

    def built(self):
        """What a fault can change in the build: objects, libraries and the program, by their paths in the folder."""
        for at, _, names in os.walk(self.build_folder):
            for name in names:
                if name.endswith((".o", ".a")) or name == "starbow_test":
                    yield os.path.relpath(os.path.join(at, name), self.build_folder)

    def keep_sound(self):
        """Keeps the build without a fault."""
        for name in self.built():
            to, of = os.path.join(self.sound, name), os.path.join(self.build_folder, name)
            if not os.path.exists(to) or os.stat(to).st_mtime_ns != os.stat(of).st_mtime_ns:
                os.makedirs(os.path.dirname(to), exist_ok=True)
                shutil.copy2(of, to)

    def put_back_sound(self):
        """Puts the build without a fault back, with its files' times: nothing is compiled again."""
        for name in self.built():
            to, of = os.path.join(self.build_folder, name), os.path.join(self.sound, name)
            if os.path.exists(of) and os.stat(to).st_mtime_ns != os.stat(of).st_mtime_ns:
                shutil.copy2(of, to)

    def build(self, most_s=None):
        """The compiler's last lines; empty when it was built."""
        if not os.path.exists(os.path.join(self.build_folder, "build.ninja")):
            os.makedirs(self.build_folder, exist_ok=True)
            unity = os.path.join(self.folder, "build", "unity_of_tests.cmake")
            with open(unity, "w", encoding="utf-8") as file:
                file.write(UNITY_OF_TESTS)
            subprocess.run(["cmake", "-S", self.folder, "-B", self.build_folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DCMAKE_PROJECT_starbow_INCLUDE=" + unity], check=True,
                           stdout=subprocess.DEVNULL)
        done = subprocess.run(["nice", "ninja", "-C", self.build_folder, "-j", self.jobs, "starbow_test"], capture_output=True,
                              text=True, timeout=most_s)
        return "" if done.returncode == 0 else done.stdout[-2000:]

    def tests(self):
        """The folder of each test, by its name."""
        with tempfile.NamedTemporaryFile(suffix=".json") as file:
            subprocess.run([self.program, "--gtest_list_tests", "--gtest_output=json:" + file.name], check=True,
                           stdout=subprocess.DEVNULL)
            suites = json.load(file)["testsuites"]
        return {suite["name"] + "." + test["name"]: os.path.basename(os.path.dirname(test["file"]))
                for suite in suites for test in suite["testsuite"]}

    def first_failure(self, tests, most_s):
        """The first test that fails, crashes or hangs; empty when all pass."""
        command = ["nice", self.program, "--gtest_fail_fast", "--gtest_filter=" + ":".join(tests)]
        try:
            run = subprocess.run(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=most_s)
            out, end = run.stdout.decode(errors="replace"), "" if run.returncode >= 0 else " crashes"
            if run.returncode == 0:
                return ""
        except subprocess.TimeoutExpired as late:
            out, end = (late.stdout or b"").decode(errors="replace"), " hangs"
        failed = [line[len("[  FAILED  ] "):].split(" ")[0].rstrip(",") for line in out.splitlines() if line.startswith("[  FAILED  ] ")]
        begun = [line[len("[ RUN      ] "):] for line in out.splitlines() if line.startswith("[ RUN      ] ")]
        return failed[0] if failed else (begun[-1] if begun else "the program") + end


def matches(name, pattern):
    return any(fnmatch.fnmatchcase(name, one) for one in pattern.split(":"))


def stages(fault, tests):
    """The names of the tests that are expected to find a fault, of its room's others, and of all others."""
    room, expected = fault[0], fault[4]
    first = [name for name in tests if matches(name, expected)]
    second = [name for name, folder in tests.items() if folder == room and name not in first]
    taken = set(first) | set(second)
    return [first, second, [name for name in tests if name not in taken]]


def attempt(copy, fault, tests, durations, own_room):
    path, text, faulty = fault[1:4]
    path = os.path.join(copy.folder, path)
    with open(path, encoding="utf-8") as file:
        whole = file.read()
    times = os.stat(path)
    if whole.count(text) != 1:
        return {"result": "stale", "by": "", "detail": "its text stands %d times in the file" % whole.count(text)}
    try:
        with open(path, "w", encoding="utf-8") as file:
            file.write(whole.replace(text, faulty))
        problem = copy.build()
        if problem:
            return {"result": "not compiled", "by": "the compiler", "detail": problem}
        for stage, names in enumerate(stages(fault, tests)):
            if not names or (own_room and stage == 2):
                continue
            # A machine that others use may be much slower than it was.
            by = copy.first_failure(names, 60 + 10 * sum(durations.get(name, 0) for name in names))
            if by:
                return {"result": "found", "by": by, "where": ["as expected", "in its room", "elsewhere"][stage]}
        return {"result": "survived", "by": "", "where": "in its room" if own_room else "everywhere"}
    finally:
        with open(path, "w", encoding="utf-8") as file:
            file.write(whole)
        os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
        copy.put_back_sound()


def durations_of(copy, names):
    """The tests' seconds; ends the script when one fails without any fault."""
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        run = subprocess.run(["nice", copy.program, "--gtest_brief=1", "--gtest_output=json:" + file.name,
                              "--gtest_filter=" + ":".join(names)], cwd=copy.folder, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True)
        if run.returncode != 0:
            sys.exit("without any fault tests fail:\n" + run.stdout[-2000:])
        suites = json.load(file)["testsuites"]
    return {suite["name"] + "." + test["name"]: float(test["time"].rstrip("s")) for suite in suites for test in suite["testsuite"]}


def times_in(root, fault):
    path = os.path.join(root, fault[1])
    if not os.path.exists(path):
        return 0
    with open(path, encoding="utf-8") as file:
        return file.read().count(fault[2])


def minutes(seconds):
    return "%d:%02d" % (seconds // 60, seconds % 60)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", type=int, nargs="+", metavar="N", help="the faults with these numbers")
    parser.add_argument("--room", help="the faults of one room")
    parser.add_argument("--list", action="store_true", help="show the faults, and whether their texts stand in the files; try none")
    parser.add_argument("--own-room", action="store_true", help="try only the tests of each fault's room; what survives them may be found elsewhere")
    parser.add_argument("--again", action="store_true", help="also those that have a result")
    parser.add_argument("--results", default="build/planted_faults.json", help="the file of results (build/planted_faults.json)")
    parser.add_argument("--copy", metavar="FOLDER", help="the copy of the tree, kept; made if it is not there")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="compilers at once (one for each core)")
    given = parser.parse_args()
    for end in (signal.SIGINT, signal.SIGTERM):  # both also where it runs in the background: the fault is taken back
        signal.signal(end, lambda number, frame: sys.exit("interrupted"))
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    chosen = [n for n, fault in enumerate(FAULTS) if (not given.only or n in given.only) and (not given.room or fault[0] == given.room)]
    if given.list:
        for n in chosen:
            print("%3d  %-9s %s: %s" % (n, FAULTS[n][0], FAULTS[n][1], " ".join(FAULTS[n][3].split()) or "(nothing)"))
        stale = [(n, count) for n in chosen for count in [times_in(root, FAULTS[n])] if count != 1]
        for n, count in stale:
            print("%d: its text stands %d times in %s" % (n, count, FAULTS[n][1]), file=sys.stderr)
        return 1 if stale else 0
    if not chosen:
        sys.exit("no fault is chosen; --list shows them")
    results_file = os.path.join(root, given.results)
    results = {}
    if os.path.exists(results_file):
        with open(results_file, encoding="utf-8") as file:
            results = json.load(file)
    # A fault is known by its texts, so that a new one in the list does not take another's result.
    key = lambda n: " | ".join([FAULTS[n][1], FAULTS[n][2], FAULTS[n][3]])
    known = lambda n: key(n) in results and (given.own_room or results[key(n)].get("where") != "in its room"
                                             or results[key(n)]["result"] != "survived")
    left = [n for n in chosen if given.again or not known(n)]

    folder = os.path.abspath(given.copy) if given.copy else tempfile.mkdtemp(prefix="planted_faults_")
    made = not os.path.exists(os.path.join(folder, "CMakeLists.txt"))
    try:
        if left:
            if made:
                subprocess.run(["git", "-C", root, "worktree", "add", "--quiet", "--force", "--detach", folder, "HEAD"], check=True)
            # Two runs would plant their faults in each other's builds.
            lock = open(os.path.join(folder, ".git"), encoding="utf-8")
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                sys.exit("another run uses the copy in %s" % folder)
            if not made:  # it may be of an older commit, and hold the fault of a run that was killed
                head = subprocess.run(["git", "-C", root, "rev-parse", "HEAD"], check=True, capture_output=True, text=True).stdout.strip()
                subprocess.run(["git", "-C", folder, "checkout", "--quiet", "--force", "--detach", head], check=True)
            copy = Copy(folder, given.jobs)
            print("Building the copy in %s" % folder, flush=True)
            problem = copy.build()
            if problem:
                sys.exit("the copy can't be built:\n" + problem)
            copy.keep_sound()
            tests = copy.tests()
            names = {name for n in left for stage in stages(FAULTS[n], tests)[:2 if given.own_room else 3] for name in stage}
            print("Running %d tests without a fault" % len(names), flush=True)
            durations = durations_of(copy, sorted(names))
            began = time.monotonic()
            for done, n in enumerate(left):
                if done > 0:
                    rest = (time.monotonic() - began) / done * (len(left) - done)
                    print("  %d of %d, about %s min left" % (done, len(left), minutes(rest)), flush=True)
                results[key(n)] = attempt(copy, FAULTS[n], tests, durations, given.own_room)
                os.makedirs(os.path.dirname(results_file), exist_ok=True)
                with open(results_file, "w", encoding="utf-8") as file:
                    json.dump(results, file, indent=1)
                show(n, results[key(n)])
    finally:
        if not given.copy:
            subprocess.run(["git", "-C", root, "worktree", "remove", "--force", folder], stderr=subprocess.DEVNULL)
            subprocess.run(["rm", "-rf", folder])

    print()
    for n in chosen:
        show(n, results[key(n)])
    counts = {}
    for n in chosen:
        counts[results[key(n)]["result"]] = counts.get(results[key(n)]["result"], 0) + 1
    print("%d faults: %s" % (len(chosen), ", ".join("%d %s" % (count, result) for result, count in sorted(counts.items()))))
    return 1 if counts.get("survived") or counts.get("stale") else 0


def show(n, result):
    print("%3d  %-9s %-12s %s: %s  %s" % (n, FAULTS[n][0], result["result"], FAULTS[n][1],
                                         " ".join(FAULTS[n][3].split()) or "(nothing)", result["by"]), flush=True)


if __name__ == "__main__":
    sys.exit(main())
