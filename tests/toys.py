#!/usr/bin/env python3
"""Adds a toy of each kind of thing that grows here, tests it, and takes it away again: what does a new one touch?

  tests/toys.py                      all toys in one copy of the last commit; a build and some tests, about ten minutes
  tests/toys.py --copy build/toys    keeps the copy and what is built in it for the next time
  tests/toys.py --list               each toy's files, and whether its changes find their places, without building

A toy is a list of files and changes. The copy is a git worktree of the last commit. The script adds all toys, builds the tests and
the program, runs the tests that know a toy, and prints how many files each touches: in the program, and with words, tests and pages.
Exit status 1 if a change finds no place, if the copy does not build, or if a test fails."""
import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent


def before(text, new):
    return lambda old: put(old, text, new + text)


def after(text, new):
    return lambda old: put(old, text, text + new)


def instead(text, new):
    return lambda old: put(old, text, new)


def put(old, text, new):
    if old.count(text) != 1:
        raise LookupError(f"{text!r} stands there {old.count(text)} times, not once")
    return old.replace(text, new)


def all_of(*changes):
    def change(old):
        for one in changes:
            old = one(old)
        return old
    return change


def whole(content):
    return lambda old: content


def with_column(csv, name):
    """A log with one more column, which is empty."""
    head, *lines = csv.split("\r\n")
    return "\r\n".join([f"{head},{name}"] + [line and line + "," for line in lines])


TEXTS = {}  # the changed files' texts by now

# Name; files with their changes; tests that know the toy (of starbow_test), and shell commands in the copy.
TOYS = {
    "effect": ({
        "config/model/effects.h": all_of(
            after("    false_colours, ///< infrared as red, the visible as green, ultraviolet as blue\n", "    dusk, ///< half of the light\n"),
            before("};\nstatic_assert(has_each_in_order(all_effects",
                   '    EffectEntry{Effect::dusk, "dusk", Switch::dusk, false, \'Y\', "true: half of the light."},\n')),
        "config/model/switches.h": all_of(
            after("    save, ///< the layout\n", "    dusk,\n"),
            before("};\nstatic_assert(has_each_in_order(all_switches",
                   '    SwitchEntry{Switch::dusk, "dusk", Leap::toggle, Presser::visitor, "half of the light, on and off", {\'J\'}},\n')),
        "config/words/en.json": after('"remote.false_colours": "False colours",\n', '    "remote.dusk": "Dusk",\n'),
        "config/words/de.json": after('"remote.false_colours": "Falschfarben",\n', '    "remote.dusk": "Dämmerung",\n'),
        "shaders/constants.h": after("    CONSTANT(33, bool, HEADLIGHT, headlight, false) \\\n", "    CONSTANT(75, bool, DUSK, dusk, false) \\\n"),
        "shaders/received_light.glsl": before("    if (BY_TABLE)\n        return shifted(coefficients,", "    if (DUSK)\n        stops -= 1.0;\n"),
        "runtime/render/view_constants.cpp": instead("&WarpVariant::headlight, nullptr}", "&WarpVariant::headlight, nullptr, &WarpVariant::dusk}"),
        "runtime/reference/eye.cpp": before("    out.light = ray.light + ray.left * out.light;\n", "    if (effects[Effect::dusk])\n        out.light *= 0.5;\n"),
        "tests/input/calm_test.cpp": instead('"menu", "full_screen", "freeze"};', '"menu", "full_screen", "freeze", "dusk"};'),
        "docs/flying.md": after("| button 7 | back | H | head-up display |\n", "| | | J | half of the light |\n"),
        "docs/sticks.md": instead("`headlight`, `false-colours`,", "`headlight`, `false-colours`, `dusk`,"),
        "tests/reference/toy_test.cpp": whole("""// A toy effect: half of the light, by rays.
#include "input/exhibit_state.h"
#include <gtest/gtest.h>

namespace toy_test {

using namespace starbow;

TEST(Toy, AnEffectIsSwitchedByItsCommand)
{
    const std::vector<std::string> words{"dusk", "on"};
    ExhibitState state;
    EXPECT_FALSE(state.effects[Effect::dusk]);
    EXPECT_TRUE(after(state, command_of(words)).effects[Effect::dusk]);
}

} // namespace toy_test
"""),
    }, "Toy.*:CalmTest.*:Presence*:Words.*:Docs.*:Presenter.*:Describe*"),
    "projection": ({
        "config/model/layout.h": all_of(
            before("using Projection = std::variant<", "/// A toy: elevation by Mercator's law.\nstruct Mercator {\n    double width_deg = 180;\n};\n"),
            instead("SphericalMirror, Lens>;", "SphericalMirror, Lens, Mercator>;")),
        "config/model/describe_layout.h": after("static_assert(is_complete<Cylinder>());\n", """template <>
inline constexpr auto description<Mercator> = describe<Mercator>("mercator", "A toy: a map by Mercator's law.",
    field("width_deg", Number{{1, 360}, 1, "width"}, "The angle across the picture, degrees.", &Mercator::width_deg));
static_assert(is_complete<Mercator>());
"""),
        "displays/projections/mercator.h": whole("""#pragma once
#include "config/model/angles.h"
#include "config/model/layout.h"
#include <cmath>
#include <optional>

namespace starbow {

/// A toy: elevation by Mercator's law.
class MercatorRays {
public:
    MercatorRays(const Mercator& mercator, glm::ivec2 size)
        : step_(mercator.width_deg * degree / size.x)
        , middle_(0.5 * glm::dvec2(size))
    {
    }
    std::optional<glm::dvec3> direction(glm::dvec2 pixel) const
    {
        const double azimuth = (pixel.x - middle_.x) * step_, y = (middle_.y - pixel.y) * step_;
        return glm::dvec3(std::sin(azimuth) / std::cosh(y), std::tanh(y), -std::cos(azimuth) / std::cosh(y));
    }
    std::optional<glm::dvec2> pixel(const glm::dvec3& d) const
    {
        const double up = d.y / glm::length(d);
        if (std::abs(up) >= 1)
            return {};
        return middle_ + glm::dvec2(std::atan2(d.x, -d.z), -std::atanh(up)) / step_;
    }
    double pixel_angle(glm::dvec2 pixel) const { return step_ / std::cosh((middle_.y - pixel.y) * step_); }

private:
    double step_; ///< radians a pixel
    glm::dvec2 middle_;
};

} // namespace starbow
"""),
        "displays/projections/picture.h": all_of(
            after('#include "lens.h"\n', '#include "mercator.h"\n'),
            instead("SphericalMirrorRays, Lenses>;", "SphericalMirrorRays, MercatorRays, Lenses>;")),
        "displays/projections/picture.cpp": before("            [&](const Equirectangular& equirectangular)",
            "            [&](const Mercator& mercator) -> Rays { return MercatorRays(mercator, size); },\n"),
        "displays/check/floor_plan_table.cpp": before("std::string words(const Cylinder& cylinder)",
            'std::string words(const Mercator& mercator) { return "Mercator, " + degrees(mercator.width_deg) + " across"; }\n\n'),
        "tests/displays/picture_test.cpp": before('        {"part of a cylinder",', '        {"mercator", {Mercator{}, {800, 600}}, 1e-6 + step2(180, 800)},\n'),
        "docs/displays.md": after("| another program that wants a cube map | | `cube`", ", `mercator`"),
    }, "PictureTest.*:Adjust.*:DescribeTest.*:FileMembers.*:SchemaTest.*:LayoutTest.*"),
    "format": ({
        "displays/warp/toy.cpp": whole("""#include "parts.h"

namespace starbow {

/// A toy: columns, rows, then u and v of each vertex.
static WarpMesh read_toy(const WarpFile& file)
{
    Lines lines(file);
    WarpMesh mesh;
    mesh.format = "toy mesh";
    lines.want("toy");
    lines.want("columns and rows");
    const auto counts = lines.fields(2, "columns and rows");
    mesh.grid = {lines.integer(counts[0], 2, 100), lines.integer(counts[1], 2, 100)};
    for (int i = 0; i < mesh.grid.x * mesh.grid.y; ++i) {
        lines.want("u v");
        const auto& f = lines.fields(2, "u v");
        const glm::dvec2 at(double(i % mesh.grid.x) / (mesh.grid.x - 1), double(i / mesh.grid.x) / (mesh.grid.y - 1));
        mesh.vertices.push_back({at, 1, {glm::dvec3(lines.number(f[0], picture_range), lines.number(f[1], picture_range), 0)}});
    }
    join_grid(mesh, std::vector<char>(mesh.vertices.size()));
    check_mesh(mesh, file);
    return mesh;
}

extern const WarpFormat toy_format{.name = "toy mesh",
    .endings = {".toy"},
    .begins = [](const WarpStart& start) { return start.line == "toy"; },
    .read = [](const WarpFile& file, const WarpReading&) { return read_toy(file); }};

} // namespace starbow
"""),
        "displays/warp/formats.cpp": lambda old: re.sub(r"headset_format;", "headset_format, toy_format;", re.sub(r"&headset_format\}", "&toy_format, &headset_format}", old)),
        "tests/support/warp_fixture.h": before('{"headset mesh", headset}', '{"toy mesh", "toy\\n2 2\\n0 0\\n1 0\\n0 1\\n1 1\\n"}, '),
    }, "WarpFormatsTest.*"),
    "spectrum": ({
        "config/model/emission.h": all_of(
            before("using Emission = std::variant<", """/// A toy: the same radiance at all wavelengths up to one.
struct FlatSpectrum {
    static constexpr const char *scene_member = "flat_to_nm", *gltf_member = "flat_to_nm";
    double nm;
    bool operator==(const FlatSpectrum&) const = default;
};

"""),
            instead("SpectralTable>;", "SpectralTable, FlatSpectrum>;")),
        "config/model/describe_scene.h": before("/// The schema's rule that at most one of some members stands there", """template <> struct EmissionForm<FlatSpectrum> {
    static constexpr const char* says = "A toy: flat up to this wavelength, nm.";
    Emission read(const Place& place, const Folder&) const { return FlatSpectrum{number(place, {shortest_nm, longest_nm})}; }
    Json schema(Json& definitions) const { return Number{{shortest_nm, longest_nm}}.schema(definitions); }
};
"""),
        "runtime/world/gltf/guard_surface.cpp": before("Emission read(const JsonSpot& spot, const SpectralTable*)",
            "Emission read(const JsonSpot& spot, const FlatSpectrum*) { return FlatSpectrum{number(spot, shortest_nm, longest_nm)}; }\n"),
        "runtime/light/spectrum.cpp": before("EmissionLaw law(const SpectralTable& table)\n", """EmissionLaw law(const FlatSpectrum& flat)
{
    return {.spectrum = [nm = flat.nm](double at) { return at < nm ? 1.0 : 0.0; }};
}
std::string name(const FlatSpectrum&) { return "a flat lamp"; }
"""),
        "tests/light/spectrum_test.cpp": before("TEST(SpectrumTest, ABaseColourHasItsColourUnderTheSun)", """TEST(SpectrumTest, AFlatSpectrumIsFlat)
{
    EXPECT_EQ(law_of(FlatSpectrum{500}).spectrum(400), 1);
    EXPECT_EQ(law_of(FlatSpectrum{500}).spectrum(600), 0);
}

"""),
        "tests/world/world_material_test.cpp": lambda old: old.replace('\\"line_nm\\", \\"table\\"', '\\"line_nm\\", \\"table\\", \\"flat_to_nm\\"'),
        "docs/scenes.md": before("| `spectrum` | a table:", "| `flat_to_nm` | a toy | nm | |\n"),
    }, "SpectrumTest.*:SceneFile*:WorldMaterial*:SchemaTest.*"),
    "command": ({
        "input/command.h": after("    range, ///< on: everything visible at once; off: one exposure\n", "    toy, ///< on: nothing happens\n"),
        "input/command.cpp": after('    CommandRule{range, "range", Role::docent, Value::on},', ' CommandRule{toy, "toy", Role::docent, Value::on},'),
        "input/exhibit_state.h": all_of(
            after("    bool slow_motion = false;\n", "    bool toy = false;\n"),
            instead('{CommandKind::as_saved, &ExhibitState::as_saved, "as-saved"}};', '{CommandKind::as_saved, &ExhibitState::as_saved, "as-saved"}, {CommandKind::toy, &ExhibitState::toy, "toy"}};')),
        "runtime/exhibit/session_commands.cpp": before("    case CommandKind::range:\n", "    case CommandKind::toy:\n        break;\n"),
        "runtime/hud/presenter_sheet.cpp": after("    toggle('U', \"remote.range\", {.kind = Order::range}, state.range);\n",
                                                 "    toggle('Q', \"remote.toy\", {.kind = Order::toy}, state.toy);\n"),
        "config/words/en.json": after('"remote.range": "Everything at once",\n', '    "remote.toy": "Toy",\n'),
        "config/words/de.json": after('"remote.range": "Alles auf einmal",\n', '    "remote.toy": "Spielzeug",\n'),
        "tests/input/command_test.cpp": before('{{"slow-motion", "on"}, {', '{{"toy", "on"}, {CommandKind::toy, true, 0, ""}}, '),
        "docs/remote.md": after("starbow tell range on                                 # everything visible at once\n", "starbow tell toy on                                   # nothing\n"),
    }, "Words.*:Presenter.*"),
    "instrument": ({
        "runtime/hud/instruments.h": after("    std::optional<double> clocks_s; ///< the second's reading minus the first's\n",
                                           "    std::optional<double> relative_rapidity; ///< a toy: that of relative_u\n"),
        "runtime/hud/instruments.cpp": after("        pair.relative_u = glm::length(u);\n",
                                             "        pair.relative_rapidity = std::asinh(*pair.relative_u);\n"),
        "runtime/hud/lab_log.cpp": instead('{"marks_clock_2_minus_1_s", csv_number(pair.clocks_s)}});',
            '{"marks_clock_2_minus_1_s", csv_number(pair.clocks_s)}, {"marks_relative_rapidity", csv_number(pair.relative_rapidity)}});'),
        **{f"tests/lab/{name}.csv": lambda old: with_column(old, "marks_relative_rapidity") for name in ("einstein", "newton", "noether")},
        "tests/hud/toy_instrument_test.cpp": whole("""// A toy instrument: the rapidity past two marks.
#include "runtime/hud/lab_log.h"
#include <gtest/gtest.h>

namespace toy_instrument_test {

TEST(Toy, AnInstrumentIsInTheLog)
{
    EXPECT_NE(starbow::log_header().find(",marks_relative_rapidity"), std::string::npos);
}

} // namespace toy_instrument_test
"""),
    }, "Toy.*:Lab*:Class*:Instruments*:StatedNumbers*:Challenges*"),
    "language": ({
        "config/words/eo.json": lambda old: TEXTS["config/words/en.json"].replace('"decimal_sign": "."', '"decimal_sign": ","'),
    }, "Words.*:TourFile*"),
    "subcommand": ({
        "runtime/commands/toy.cpp": whole("""#include "commands.h"
#include "options/command_line.h"
#include <cstdio>

namespace starbow {

static void add_toy(Subcommand& app, std::function<int()>& chosen)
{
    Subcommand* command = app.add_subcommand("toy", "Say hello.");
    command->footer("Example:\\n  starbow toy");
    command->callback([&chosen] { chosen = [] { return std::puts("hello") < 0; }; });
}
static const Registered toy_command{18, add_toy};

} // namespace starbow
"""),
        "docs/commands.md": after("| `soak` | shows the exhibit to thousands of random visitors, and compares the process before and after | [exhibit](exhibit.md#the-same-after-thirty-days) |\n",
                                  "| `toy` | says hello | |\n"),
    }, "Docs.*"),
}


def drawn(folder, build, rays, dusk, exposure_ev):
    """The bytes of a picture."""
    shot, out = folder / "toy-shot.json", folder / "out/toy"
    shutil.rmtree(out, ignore_errors=True)
    shot.write_text(json.dumps({"scene": "chart", "position": [0, 0, 3], "velocity": {"direction": [0, 0, -1], "beta": 0.5},
                                "effects": {"dusk": dusk}, "exposure_ev": exposure_ev}))
    subprocess.run([build / "starbow", "render", "--shot", shot, "--size", "64x48", "--out", out, *rays], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL)
    return b"".join(file.read_bytes() for file in sorted(out.glob("*.png")))


def changed_texts(text_of):
    """Puts all toys into the texts; false if a change finds no place."""
    found = True
    for name, (files, _) in TOYS.items():
        for file, change in files.items():
            try:
                TEXTS[file] = change(TEXTS[file] if file in TEXTS else text_of(file))
            except LookupError as error:
                print(f"{name}: {file}: {error}; mend the list in tests/toys.py", file=sys.stderr)
                found = False
    return found


def is_program(file):
    return not file.startswith(("tests/", "docs/", "config/words/"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--copy", help="keep the copy here")
    parser.add_argument("--list", action="store_true", help="the files alone")
    arguments = parser.parse_args()
    if arguments.list:
        for name, (files, _) in TOYS.items():
            print(f"{name}: {len(files)} files\n  " + "\n  ".join(files))
        return 0 if changed_texts(lambda file: (root / file).read_bytes().decode() if (root / file).exists() else "") else 1
    folder = pathlib.Path(arguments.copy or tempfile.mkdtemp()).resolve()
    changed = {file for files, _ in TOYS.values() for file in files}
    head = subprocess.check_output(["git", "rev-parse", "HEAD"], cwd=root, text=True).strip()
    if not (folder / ".git").exists():
        subprocess.run(["git", "worktree", "add", "--detach", "--quiet", str(folder), head], cwd=root, check=True)
    else:  # files that stay as they are keep their times, and need no building
        subprocess.run(["git", "reset", "--quiet", head], cwd=folder, check=True)
        subprocess.run(["git", "checkout", "--force", "--", ".", *(":!" + file for file in changed)], cwd=folder, check=True)
    try:
        def committed(file):
            said = subprocess.run(["git", "show", f"{head}:{file}"], cwd=root, capture_output=True)
            return said.stdout.decode() if said.returncode == 0 else ""

        failed = not changed_texts(committed)
        for file, text in TEXTS.items():
            path = folder / file
            if not path.exists() or path.read_bytes().decode() != text:  # the logs' lines end in CR LF
                path.write_bytes(text.encode())
        if failed:
            return 1
        build = folder / "build/toys"
        print("builds the copy with all toys, eight minutes on two cores", flush=True)
        subprocess.run(["cmake", "-S", folder, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON"],
                       check=True, stdout=subprocess.DEVNULL)
        built = subprocess.run(["ninja", "-C", build, "starbow_test", "starbow", "starbow-tools"], capture_output=True, text=True)
        if built.returncode != 0:
            errors = [line for line in built.stdout.splitlines() if "error:" in line]
            print("the copy with the toys does not build:\n" + "\n".join(errors or built.stdout.splitlines()[-20:]), file=sys.stderr)
            return 1
        for name, (files, tests) in TOYS.items():
            passed = subprocess.run([build / "starbow_test", "--gtest_brief=1", "--gtest_filter=" + tests], cwd=folder).returncode == 0
            failed |= not passed
            program = sum(map(is_program, files))
            print(f"{name:12} {program} files of the program, {len(files)} with words, tests and pages: {'passed' if passed else 'FAILED'}", flush=True)
        said = subprocess.run([build / "starbow", "toy"], capture_output=True, text=True)
        failed |= said.stdout != "hello\n"
        # Half of the light is a step of the exposure, live and by rays.
        for rays in ([], ["--reference"]):
            whole_light, dusk, darker = (drawn(folder, build, rays, *shot) for shot in ((False, 0), (True, 0), (False, -1)))
            shown = dusk == darker != whole_light
            print(f"the toy effect {'by rays' if rays else 'live'}: {'shown' if shown else 'NOT SHOWN'}")
            failed |= not shown
        return int(failed)
    finally:
        if not arguments.copy:
            subprocess.run(["git", "worktree", "remove", "--force", str(folder)], cwd=root)
            shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())
