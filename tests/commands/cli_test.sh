#!/usr/bin/env bash
# Wrong input at the command line ends with exit 2, one line, and no file written. Usage: cli_test.sh PROGRAM
set -u
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
. "$(dirname "$0")/../rig/refusals.sh"

# Writes a shot file with the given velocity and further members.
shot() { # FILE VELOCITY [MORE]
    printf '{ "scene": "avenue", "velocity": %s %s }\n' "$2" "${3:-}" > "$folder/$1.json"
}

refused 'there are:' render --shot no-such-shot
refused 'there are:' render --shot start --layout no-such-layout
refused 'no-such.json' render --shot "$folder/no-such.json"
refused 'None of --shot, --scene' render --size 8x8
refused 'there are:' render --scene no-such-scene
refused '--size' render --shot start --size 800
refused '--size' render --shot start --size 0x600
refused '--size' render --shot start --size 800x600x2
refused '--size' render --shot start --size 99999x99999
refused '--size' render --shot start --size -800x600
refused '8192x8192' render --shot start --size 16384x16384 --exr
refused '--samples' render --shot start --samples 4
shot fast '{ "direction": [0, 0, -1], "beta": 1 }'
refused '/velocity/beta' render --shot "$folder/fast.json"
shot slow '{ "direction": [0, 0, -1], "gamma": 0.5 }'
refused '/velocity/gamma' render --shot "$folder/slow.json"
shot nowhere '{ "direction": [0, 0, 0], "gamma": 2 }'
refused '/velocity/direction' render --shot "$folder/nowhere.json"
shot blind '{ "direction": [0, 0, -1], "gamma": 2 }' ', "look": [0, 0, 0]'
refused '/look' render --shot "$folder/blind.json"
shot nan '{ "direction": [0, 0, -1], "gamma": NaN }'
refused 'nan.json:1: column' render --shot "$folder/nan.json"
shot huge '{ "direction": [0, 0, -1], "gamma": 1e999 }'
refused 'huge.json' render --shot "$folder/huge.json"
shot word '{ "direction": [0, 0, -1], "gamma": "four" }'
refused '/velocity/gamma' render --shot "$folder/word.json"
mkdir "$folder/folder.json"
refused 'folder' render --shot "$folder/folder.json"
: > "$folder/empty.json"
refused 'empty.json' render --shot "$folder/empty.json"
echo '{ "scene": "atlantis" }' > "$folder/scene.json"
refused 'atlantis' render --shot "$folder/scene.json"
echo '{ "gltf": "missing.glb" }' > "$folder/world.json"
echo '{ "scene": "./world.json" }' > "$folder/world-shot.json"
refused 'missing.glb' render --shot "$folder/world-shot.json"
printf 'glTF\2\0\0\0\20\0\0\0' > "$folder/missing.glb"
refused 'missing.glb' render --shot "$folder/world-shot.json"
echo '{ "outputs": [ { "name": "a", "viewports": [ { "projection": { "type": "planar", "fov_y_deg": 190 } } ] } ] }' > "$folder/wide.json"
refused '/outputs/0/viewports/0/projection/fov_y_deg' render --shot start --layout "$folder/wide.json"
VK_DRIVER_FILES=/nonexistent VK_ICD_FILENAMES=/nonexistent refused 'install' render --shot start
STARBOW_GPU=Voodoo refused 'Voodoo' render --shot start
echo in the way > "$folder/out"
said=$("$program" render --shot start --size 8x8 --out "$folder/out" 2>&1 >/dev/null)
if [ $? != 2 ] || [ "$(cat "$folder/out")" != 'in the way' ]; then fail "a file where the output folder should be: $said"; else passed=$((passed + 1)); fi
rm "$folder/out"

mkdir -p "$folder/half/desk.exr"
said=$("$program" render --shot start --size 8x8 --exr --out "$folder/half" 2>&1 >/dev/null)
if [ $? != 2 ] || [ -e "$folder/half/desk.png" ]; then fail "a folder in the EXR's place: $said"; else passed=$((passed + 1)); fi
refused 'a?b?[31m' render --shot $'a\nb\e[31m'

# `check` writes a layout's floor plan to the named file, and none for a wrong layout.
said=$("$program" check desk --svg "$folder/plans/desk.svg")
if [[ $said == *"desk: window, 60"* && $said == *"plans/desk.svg" ]] && grep -q '</svg>' "$folder/plans/desk.svg"; then passed=$((passed + 1)); else fail "check desk: $said"; fi
(cd "$folder" && "$program" check dome >/dev/null && [ -s dome-plan.svg ]) && passed=$((passed + 1)) || fail "check dome writes no dome-plan.svg"
for layout in "$folder/wide.json" no-such-layout; do
    said=$("$program" check "$layout" --svg "$folder/wrong.svg" 2>&1)
    if [ $? = 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" = 1 ] && [ ! -e "$folder/wrong.svg" ]; then passed=$((passed + 1)); else fail "check $layout: $said"; fi
done

# Warp files and imports.
warps=$(cd "$(dirname "$0")/.." && pwd)/warp
refused 'no-such.data' warp inspect "$folder/no-such.data"
echo 'Dear Sir' > "$folder/letter"
refused 'not a warp file that is known' warp inspect "$folder/letter"
head -c 300 "$warps/channel1_warp_u2.sgc" > "$folder/short.sgc"
refused 'byte 56' warp inspect "$folder/short.sgc"
refused '--size' warp inspect "$warps/channel1_warp_u2.sgc" --size 1x1
refused 'has no regions' warp inspect "$warps/channel1_warp_u2.sgc" --region left
refused 'lacks "nodes"' import sgct "$folder/scene.json"
refused 'no node 3' import sgct "$warps/sgct-configs/single.json" --node 3
said=$("$program" warp convert "$warps/channel1_warp_u2.sgc" "$folder/out.doc" 2>&1 >/dev/null)
if [ $? = 2 ] && [[ $said == *"ends in .data, .pfm or .csv"* ]]; then passed=$((passed + 1)); else fail "convert to .doc: $said"; fi
"$program" warp convert "$warps/channel1_warp_u2.sgc" "$folder/one.csv" >/dev/null 2>&1 && "$program" warp convert "$folder/one.csv" "$folder/two.csv" >/dev/null 2>&1
if cmp -s "$folder/one.csv" "$folder/two.csv" && cmp -s "$folder/one_frustum.csv" "$folder/two_frustum.csv"; then passed=$((passed + 1)); else fail "convert: a written warp file reads back differently"; fi
if "$program" warp inspect "$folder/one.csv" --out "$folder/one.png" | grep -q '^grid *33 columns x 33 rows$' && [ -s "$folder/one.png" ]; then passed=$((passed + 1)); else fail "warp inspect prints no grid or writes no picture"; fi
if "$program" import sgct "$warps/sgct-configs/single_fisheye.json" --out "$folder/imported.json" | grep -q '^/nodes/0/windows/0/size  -> size$' && [ -s "$folder/imported.json" ]; then passed=$((passed + 1)); else fail "import sgct does not list a mapped member or writes no layout"; fi

# The written file has the size of --size.
"$program" warp convert "$warps/channel1_warp_mesh.csv" "$folder/ten.data" --size 10x8 >/dev/null 2>&1
if [ "$(sed -n 2p "$folder/ten.data")" = '10 8' ] && "$program" warp inspect "$folder/ten.data" | grep -q '^grid *10 columns x 8 rows$'; then passed=$((passed + 1)); else fail "convert --size 10x8 to .data"; fi
"$program" warp convert "$warps/channel1_warp_mesh.csv" "$folder/ten.pfm" --size 10x8 >/dev/null 2>&1
if "$program" warp inspect "$folder/ten.pfm" | grep -q '^grid *10 columns x 8 rows$'; then passed=$((passed + 1)); else fail "convert --size 10x8 to .pfm"; fi

# A conversion warns of exactly what it loses.
printf 'v -2 0 0\nv 0 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n' > "$folder/three.obj"
loses() { # WHAT FROM TO: the expected words of the warning, "" for none
    local said
    said=$("$program" warp convert "$2" "$folder/$3" --force 2>&1 >/dev/null)
    if [ "$(printf '%s' "$said" | grep -oE 'outline|beyond the viewport|beyond the picture|brightness|frustum' | tr '\n' ' ')" = "$1" ]; then passed=$((passed + 1)); else fail "convert $2 to $3: $said"; fi
}
loses 'outline beyond the viewport ' "$folder/three.obj" lost.data
loses 'outline beyond the viewport ' "$folder/three.obj" lost.pfm
loses 'outline beyond the viewport ' "$folder/three.obj" lost.csv
loses '' "$warps/channel1_warp.simcad" lost.csv
loses 'outline beyond the viewport frustum ' "$warps/channel1_warp_mesh.csv" lost.pfm
loses 'frustum ' "$warps/channel1_warp_mesh.csv" lost.data
printf '2\n2 2\n-1 -1 0 0 1\n1 -1 1 0 0.5\n-1 1 0 1 1\n1 1 1 1 1\n' > "$folder/dim.data"
loses 'brightness ' "$folder/dim.data" lost.csv

# For a map of offsets, and for one with its rows in the other order, the program names a remedy that works.
refused '--offsets' warp inspect "$warps/correction_mesh.mpcdi"
said=$("$program" warp inspect "$warps/correction_mesh.mpcdi" --offsets 2>&1)
if [[ $said == *"rows in the other order"*" --first-row-on-top"*'"first_row": "top"'* ]] && ! "$program" warp inspect "$warps/correction_mesh.mpcdi" --offsets --first-row-on-top | grep -q 'other order'; then passed=$((passed + 1)); else fail "inspect of rows in the other order: $said"; fi

# A mesh that shows one direction is doubted, by inspect and by check.
{ printf 'PF\n2 2\n-1.0\n'; head -c 48 /dev/zero; } > "$folder/zero.pfm"
printf '{ "outputs": [{ "name": "a", "size": [64, 48], "viewports": [{ "projection": { "type": "planar" }, "warp": { "file": "zero.pfm" } }] }] }' > "$folder/zero.json"
if "$program" warp inspect "$folder/zero.pfm" | grep -q '^warning *every pixel shows one' && "$program" check "$folder/zero.json" --svg "$folder/zero.svg" | grep -q '^note: a, zero.pfm: every pixel shows one'; then passed=$((passed + 1)); else fail "a mesh of one direction is not doubted"; fi

# Input files are never overwritten, and others only with --force: exit 2, one line, and the file unchanged.
kept() { # FILE TEXT ARGUMENTS...
    local file=$1 text=$2 before said status
    shift 2
    before=$(md5sum "$file")
    said=$("$program" "$@" 2>&1 >/dev/null)
    status=$?
    if [ $status = 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" = 1 ] && [[ $said == *"$text"* ]] && [ "$before" = "$(md5sum "$file")" ]; then passed=$((passed + 1)); else fail "$*: exit $status: $said"; fi
}
own=$folder/own
mkdir "$own"
cp "$warps/standard_16x9.data" "$warps/channel1_warp_mesh.csv" "$warps/channel1_warp_frustum.csv" "$warps/sgct-configs/single.json" "$own/"
cp "$warps/../../config/layouts/desk.json" "$own/"
ln -s standard_16x9.data "$own/link.data"
kept "$own/single.json" 'is read' import sgct "$own/single.json" --out "$own/../own/single.json"
kept "$own/single.json" 'is read' import sgct "$own/single.json" --out "$own/single.json" --force
kept "$own/desk.json" '--force' import sgct "$own/single.json" --out "$own/desk.json"
kept "$own/desk.json" 'is read' check "$own/desk.json" --svg "$own/desk.json"
kept "$own/single.json" '.svg' check "$own/desk.json" --svg "$own/single.json"
kept "$own/standard_16x9.data" 'is read' warp inspect "$own/standard_16x9.data" --out "$own/standard_16x9.data"
kept "$own/single.json" '.png' warp inspect "$own/standard_16x9.data" --out "$own/single.json"
kept "$own/standard_16x9.data" 'is read' warp convert "$own/standard_16x9.data" "$own/standard_16x9.data" --size 10x10 --force
kept "$own/standard_16x9.data" 'is read' warp convert "$own/standard_16x9.data" "$own/link.data" --size 10x10 --force
kept "$own/standard_16x9.data" '--force' warp convert "$own/channel1_warp_mesh.csv" "$own/standard_16x9.data"
kept "$own/channel1_warp_frustum.csv" 'is read' warp convert "$own/channel1_warp_mesh.csv" "$own/channel1_warp.csv" --force
if "$program" warp convert "$own/channel1_warp_mesh.csv" "$own/link.data" --force >/dev/null 2>&1 && "$program" import sgct "$own/single.json" --out "$own/desk.json" --force >/dev/null; then passed=$((passed + 1)); else fail "--force does not replace"; fi
cp "$warps/../../config/layouts/desk.json" "$own/masked.json"
"$program" warp inspect "$own/channel1_warp_mesh.csv" --out "$own/desk.PNG" > /dev/null && mv "$own/desk.PNG" "$own/desk.png"
sed -i 's|"projection"|"alpha_mask": "desk.png", "projection"|' "$own/masked.json"
kept "$own/desk.png" 'is read' render --layout "$own/masked.json" --shot start --size 8x8 --out "$own"

# A SCISS mesh brings its own projection, which replaces the planar one.
mkdir -p "$folder/sciss"
cp "$warps/channel1_warp_u2.sgc" "$folder/sciss/"
cat > "$folder/sciss/sgct.json" << 'END'
{ "version": 1, "nodes": [ { "windows": [ { "name": "P1", "size": { "x": 64, "y": 40 }, "viewports": [
    { "mesh": "channel1_warp_u2.sgc", "projection": { "type": "PlanarProjection", "fov": { "hfov": 95, "vfov": 70 } } } ] } ] } ] }
END
said=$("$program" import sgct "$folder/sciss/sgct.json" --out "$folder/sciss/layout.json" 2>&1)
if [ $? = 0 ] && [[ $said == *"projection  not mapped: replaced by the mesh's own"* ]] && ! grep -q '"projection"' "$folder/sciss/layout.json"; then passed=$((passed + 1)); else fail "import of a SCISS mesh: $said"; fi
said=$("$program" check "$folder/sciss/layout.json" --svg "$folder/sciss/plan.svg" 2>&1)
if [[ $said == *"P1: the warp file's own; bent by channel1_warp_u2.sgc"* ]]; then passed=$((passed + 1)); else fail "check of a SCISS mesh: $said"; fi

# An imported layout names its source, and its schema for editors.
schema=$(sed -n 's/.*"$schema": "\(.*\)",$/\1/p' "$folder/imported.json")
if head -1 "$folder/imported.json" | grep -q '^// .*single_fisheye.json' && [ -n "$schema" ] && cmp -s "$folder/$schema" "$warps/../../config/schema/layout.schema.json" && ! grep -q '"hud"' "$folder/imported.json"; then passed=$((passed + 1)); else fail "import: $(head -5 "$folder/imported.json")"; fi

# The last line says what an imported layout lacks.
said=$("$program" import sgct "$warps/sgct-configs/spherical_mirror.json" --out "$folder/mirror.json" 2>&1)
if [ $? = 1 ] && [[ $(printf '%s\n' "$said" | tail -1) == "to mend: "*"/outputs/0/viewports/0/warp/file: "*" names no file in "* ]]; then passed=$((passed + 1)); else fail "import without its mesh: $said"; fi
mkdir "$folder/mirror"
sed 's|mesh/||' "$warps/sgct-configs/spherical_mirror.json" > "$folder/mirror/sgct.json"
cp "$warps/standard_16x9.data" "$folder/mirror/"
if "$program" import sgct "$folder/mirror/sgct.json" --out "$folder/mirror/layout.json" > "$folder/said" && ! grep -q 'to mend' "$folder/said" && "$program" check "$folder/mirror/layout.json" --svg "$folder/mirror/plan.svg" >/dev/null; then passed=$((passed + 1)); else fail "import with its mesh: $(cat "$folder/said")"; fi

# SGCT's older XML has a sentence of its own.
echo '<?xml version="1.0" ?><Cluster masterAddress="localhost"/>' > "$folder/old.xml"
refused 'is XML, which SGCT read until its version 2' import sgct "$folder/old.xml"

# Two small files of large images, 16384 x 8192 each, take less than 1 GiB of memory, and the log tells their new size.
mkdir "$folder/large"
python3 - "$folder/large" << 'END'
import base64, json, struct, sys, zlib
folder, width, height = sys.argv[1], 16384, 8192
def chunk(kind, data):
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
pack = zlib.compressobj(1)
rows = b''.join(pack.compress((b'\0' + b'\xc8' * width) * 64) for _ in range(height // 64)) + pack.flush()
for name in 'a.png', 'b.png':
    with open(folder + '/' + name, 'wb') as file:
        file.write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, 8, 0, 0, 0, 0)) + chunk(b'IDAT', rows) + chunk(b'IEND', b''))
data = struct.pack('<20f', -1, -1, -3, 1, -1, -3, 1, 1, -3, -1, 1, -3, 0, 1, 1, 1, 1, 0, 0, 0) + struct.pack('<6H', 0, 1, 2, 0, 2, 3)
json.dump({'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0, 1]}], 'nodes': [{'mesh': 0}, {'mesh': 1, 'translation': [2, 0, 0]}],
    'meshes': [{'primitives': [{'attributes': {'POSITION': 0, 'TEXCOORD_0': 1}, 'indices': 2, 'material': i}]} for i in (0, 1)],
    'materials': [{'pbrMetallicRoughness': {'baseColorTexture': {'index': i}}} for i in (0, 1)],
    'textures': [{'source': 0}, {'source': 1}], 'images': [{'uri': 'a.png'}, {'uri': 'b.png'}],
    'buffers': [{'byteLength': len(data), 'uri': 'data:application/octet-stream;base64,' + base64.b64encode(data).decode()}],
    'bufferViews': [{'buffer': 0, 'byteOffset': a, 'byteLength': b} for a, b in ((0, 48), (48, 32), (80, 12))],
    'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3', 'min': [-1, -1, -3], 'max': [1, 1, -3]},
        {'bufferView': 1, 'componentType': 5126, 'count': 4, 'type': 'VEC2'}, {'bufferView': 2, 'componentType': 5123, 'count': 6, 'type': 'SCALAR'}]},
    open(folder + '/world.gltf', 'w'))
json.dump({'gltf': 'world.gltf', 'ambient': [1, 1, 1]}, open(folder + '/scene.json', 'w'))
json.dump({'scene': 'scene.json'}, open(folder + '/shot.json', 'w'))
END
said=$(python3 -c 'import resource, subprocess, sys
done = subprocess.run(sys.argv[1:], capture_output=True, text=True)
print(done.returncode, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss < 1 << 20, done.stdout + done.stderr)' "$program" render --layout desk --shot "$folder/large/shot.json" --size 32x24 --out "$folder/large/out")
if [[ $said == "0 True "*"2 images of 16384 x 8192 pixels (image 0 and others) are drawn with 4096 x 2048: "* ]]; then passed=$((passed + 1)); else fail "large images: $said"; fi

# Unknown and missing options are refused in one line, also with exit 2.
for arguments in '' 'fly' 'render' 'render --shot' 'run --frames -1' 'check' 'render --shot start --out x --colour' 'render --shot start --out x --spectra 7' 'warp' 'warp inspect' 'import sgct x'; do
    # shellcheck disable=SC2086
    said=$("$program" $arguments 2>&1 >/dev/null)
    if [ $? = 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" = 1 ]; then passed=$((passed + 1)); else fail "'$arguments' is not refused with exit 2 in one line: $said"; fi
done

begins_with 'fly is not a command; run, render, check, doctor, displays, devices, calibrate, warp, import, bench, measure, report, soak, tell, lab, challenges, class and help are' fly
begins_with 'look is not a command; inspect and convert are' warp look
begins_with "--ouput is not an option of 'starbow render'; --help, --layout, --shot, --scene, --out," render --shot start --ouput o1
begins_with "--sizes is not an option of 'starbow warp inspect'; " warp inspect x --sizes 3
begins_with "out is one argument too many for 'starbow run'" run out
begins_with '--frames: x is not a whole number; one from 0 to 1000000000 is right' run --frames x
begins_with '--frames: -1 is not a whole number that fits; one from 0 to 1000000000 is right' run --frames -1
begins_with '--node: one is not a whole number; ' import sgct x --out y --node one
begins_with '--out is required' render --shot start
refused 'no first row' warp inspect "$warps/standard_16x9.data" --first-row-on-top

begins_with 'no exhibit answers at 127.0.0.1:1' tell --pin 123456 --port 1 stop
begins_with 'no exhibit answers at 127.0.0.1:1' tell --pin 123456 --port 1 status
begins_with 'the command jump is not known; one of these is right: fade, stop' tell --pin 123456 jump
begins_with 'the command jump is not known; one of these is right: fade, stop' tell --pin-file nowhere jump
begins_with 'the command stop has 1 values; stop alone is right' tell --pin 123456 stop now
begins_with 'the command scene has the value ../secret, which is not a name of a shipped file' tell --pin 123456 scene ../secret
begins_with '--port: 0 is not a whole number that fits; one from 1 to 65535 is right' tell --port 0 stop
printf 'docent 123456\n' > "$folder/pins" && chmod 644 "$folder/pins"
begins_with "$folder/pins: has the rights 644, which opens it to more people" tell --pin-file "$folder/pins" stop

printf '{ "tour": "rainbow" }\n' > "$folder/touring.json"
begins_with "A tour's flight can't be recorded" run --exhibit "$folder/touring.json" --record "$folder/touring.jsonl"
begins_with '--record excludes --tour' run --tour rainbow --record "$folder/touring.jsonl"
begins_with 'There is no none.json in config/tours' run --tour none
begins_with 'There is no xx.json in config/words; there are: de, en' run --tour rainbow --language xx

# Every subcommand's help ends with an example, and the page of commands has its row. The help of starbow-tools' commands is
# tools_test.sh's: the quick form builds starbow alone.
commands=$("$program" --help | sed -n 's/^  \([a-z]\+\)  .*/\1/p')
[ "$(echo "$commands" | wc -l)" -ge 17 ] || fail "only these subcommands are found in --help: $commands"
for command in $commands; do
    case $command in bench | measure | soak) ;; *)
        if "$program" "$command" --help | grep -q "starbow $command"; then passed=$((passed + 1)); else fail "$command --help has no example"; fi ;;
    esac
    if grep -q "^| \`$command\` |" "$(dirname "$0")/../../docs/commands.md"; then passed=$((passed + 1)); else fail "docs/commands.md has no row for $command"; fi
done

for command in '' 'warp inspect' 'warp convert' 'import sgct'; do
    # shellcheck disable=SC2086
    if "$program" $command --help | grep -A1 '^Examples\?:' | grep -q "starbow ${command:-run} "; then passed=$((passed + 1)); else fail "$command --help has no example"; fi
done

# Every kind of file is described on one screen or two.
if "$program" help quality | grep -q '^  clip_levels: a whole number from 0 to 42; usual: 42$'; then passed=$((passed + 1)); else fail 'help quality does not say clip_levels'; fi
begins_with 'the kind of file stick is not known; "exhibit", "layout", "profile", "programme", "quality", "ladder", "scene", "shot" or "tour" is right' help stick

# Lengths are printed to the millimetre.
printf '{ "outputs": [ { "name": "a", "viewports": [ { "projection": { "type": "wall", "lower_left_m": [-1, 0, -2], "lower_right_m": [1, 0, -2], "upper_left_m": [-1, 1.125, -2] } } ] } ] }' > "$folder/wall.json"
if "$program" check "$folder/wall.json" --svg "$folder/wall.svg" | grep -q 'wall, 2.000 x 1.125 m'; then passed=$((passed + 1)); else fail "check does not print a wall's size to the millimetre"; fi

# `check` shows a world that has no scene file, and writes a scene for it that draws; a file of another kind is named.
cp "$(dirname "$0")/../../scenes/light-clock/light-clock.glb" "$folder/my.glb"
said=$("$program" check "$folder/my.glb" --page "$folder/pages/my.html" --write "$folder/pages/my.json" 2>&1)
if [[ $? = 0 && $said == *"triangles: "*"a frame of 800 x 600: "*"it has no scene file"* ]] && [ "$(grep -c 'data:image/png' "$folder/pages/my.html")" = 3 ] && grep -q '</svg>' "$folder/pages/my.html"; then passed=$((passed + 1)); else fail "check of a glTF: $said"; fi
printf '{ "scene": "pages/my.json", "position": [0, 0, 5], "look": [0, 0, -1] }' > "$folder/own-shot.json"
said=$("$program" render --shot "$folder/own-shot.json" --size 64x48 --out "$folder/own" 2>&1) && passed=$((passed + 1)) || fail "the written scene is not drawn: $said"
printf '{ "scene": "my.glb", "position": [0, 0, 5], "look": [0, 0, -1] }' > "$folder/bare-shot.json"
said=$("$program" render --shot "$folder/bare-shot.json" --size 64x48 --out "$folder/own" 2>&1)
if [[ $? = 0 && $said == *"it has no scene file"* ]]; then passed=$((passed + 1)); else fail "a shot in a glTF: $said"; fi
begins_with "$folder/pages/my.json: " check "$folder/my.glb" --page "$folder/never.html" --write "$folder/pages/my.json"
begins_with "--write is for a glTF file without a scene" check "$folder/pages/my.json" --page "$folder/never.html" --write "$folder/never.json"
begins_with "$folder/wall.json: is a layout; a scene is right here" run --scene "$folder/wall.json"
begins_with "$folder/my.glb: is a glTF world; a layout is right here" run --layout "$folder/my.glb"
begins_with '--svg "'"$folder/never.html"'" is for a layout or an exhibit' check "$folder/pages/my.json" --svg "$folder/never.html"
begins_with '--write "'"$folder/never.json"'" is for a glTF world' check "$folder/wall.json" --write "$folder/never.json"
begins_with '--page "'"$folder/never.html"'" is for a world' check desk --page "$folder/never.html"
begins_with "$folder/nowhere.glb: does not exist; a .gltf or .glb file is right" check "$folder/nowhere.glb" --page "$folder/never.html"
[ ! -e "$folder/never.html" ] && [ ! -e "$folder/never.json" ] && passed=$((passed + 1)) || fail "a refused check of a world has written something"

# Without a display server the GPUs are listed too.
said=$(env -u DISPLAY -u WAYLAND_DISPLAY "$program" displays 2>&1)
if [ $? = 0 ] && [[ $said == *"GPU "*": is used"*"no display server"* ]]; then passed=$((passed + 1)); else fail "displays: $said"; fi

# --version prints the version alone on one line.
said=$("$program" --version 2>&1)
if [ $? = 0 ] && [[ $said =~ ^starbow\ [0-9]+\.[0-9]+\.[0-9]+$ ]]; then passed=$((passed + 1)); else fail "--version: $said"; fi

# The doctor needs no display, and examines each part even if others fail.
doctor() { env -u DISPLAY -u WAYLAND_DISPLAY STARBOW_CACHE="$folder/cache" "$@" 2>&1; }
said=$(doctor "$program" doctor)
status=$?
if [[ $said == Starbow\ *"system "*"GPU "*": is used"*"driver "*"Vulkan 1."*"samplers"*"no display server"*"sticks "*"udev rule"*"font "*"$folder/cache: 0 B in 0 files; can be written"*"disk "*"files "*"layouts"* ]]; then passed=$((passed + 1)); else fail "doctor: $said"; fi
if [ "$(printf '%s\n' "$said" | wc -l)" -le 40 ] && [ ! -e "$folder/cache" ]; then passed=$((passed + 1)); else fail "doctor prints more than 40 lines, or leaves a cache folder"; fi
if { [ $status = 0 ] && [[ $said == *$'\n\nNothing is wrong.' ]]; } || { [ $status = 1 ] && [[ $said == *$'\n\nWrong:\n- '*'.' ]]; }; then passed=$((passed + 1)); else fail "doctor: exit $status: $said"; fi
said=$(VK_DRIVER_FILES=/nonexistent VK_ICD_FILENAMES=/nonexistent doctor env STARBOW_CACHE=/dev/null/cache "$program" doctor)
if [ $? = 1 ] && [[ $said == *"Vulkan finds none"*"font "*"files "*"Wrong:"*$'\n- Vulkan finds no GPU: install '*$'\n- The cache folder /dev/null/cache can\'t be written'* ]]; then passed=$((passed + 1)); else fail "doctor without a GPU and a cache: $said"; fi
said=$(doctor env DISPLAY=:4711 "$program" doctor)
if [ $? = 1 ] && [[ $said == *"- The display server that DISPLAY=:4711 names does not answer: "* ]]; then passed=$((passed + 1)); else fail "doctor with a dead display: $said"; fi
# Of an installed exhibit it says which addresses the machine lacks (192.0.2.0/24 is nobody's).
house=$folder/house
mkdir -p "$house/usr/bin" "$house/usr/share/starbow" "$house/etc/starbow"
cp "$program" "$house/usr/bin/starbow"
ln -s "$(realpath "$(dirname "$0")/../../config")" "$house/usr/share/starbow/config"
cat >"$house/etc/starbow/exhibit.json" <<'END'
{ "layout": "desk", "remote": { "port": 8080, "address": "192.0.2.7" }, "machines": { "master": "a", "interface": "lo" } }
END
said=$(cd / && doctor "$house/usr/bin/starbow" doctor)
if [ $? = 1 ] && [[ $said == *"network   remote: 192.0.2.7, which this machine lacks"*"machines: interface lo"*"- The exhibit's remote waits for 192.0.2.7, which this machine lacks: look at "* ]] && [[ $said != *"interface lo, which"* ]]; then passed=$((passed + 1)); else fail "doctor of an exhibit without its address: $said"; fi
rm -r "$house"
mkdir -p "$folder/own/starbow/profiles"
echo '{ "name": 7 }' > "$folder/own/starbow/profiles/mine.json"
said=$(doctor env XDG_CONFIG_HOME="$folder/own" STARBOW_GPU=Voodoo "$program" doctor --json)
if [ $? = 1 ] && python3 -c '
import json, sys
report = json.loads(sys.argv[1])
problems = [wrong["problem"] for wrong in report["wrong"]]
assert list(report) == ["version", "build", "system", "gpus", "monitors", "sticks", "font", "cache", "disk", "files", "wrong"], list(report)
assert report["gpus"][0]["vulkan_version"].startswith("1.") and report["gpus"][0]["max_image_dimension_2d"] >= 4096
assert not report["monitors"]["display_server"] and report["files"]["layouts"] >= 10 and report["files"]["own_profiles"] == 1
assert any("mine.json" in problem for problem in problems) and any("Voodoo" in problem for problem in problems), problems' "$said"; then passed=$((passed + 1)); else fail "doctor --json: $said"; fi

# --trace without a file is refused before the flight begins.
begins_with '--trace: 1 required' run --trace

# Two renders give the same bytes, and --exr writes the numbers beside the picture.
"$program" render --shot starbow --size 160x120 --out "$folder/once" --exr >/dev/null || fail "a valid shot is refused"
"$program" render --shot starbow --size 160x120 --out "$folder/twice" --exr >/dev/null
for file in desk.png desk.exr; do
    if cmp -s "$folder/once/$file" "$folder/twice/$file"; then passed=$((passed + 1)); else fail "$file differs the second time"; fi
done

# Sticks: a descriptor is read as raw bytes, hexadecimal text and JSON, with the fields that its JSON file lists.
hid=$(cd "$(dirname "$0")/.." && pwd)/hid
python3 - "$hid" "$folder" << 'END'
import json, sys
device = json.load(open(sys.argv[1] + "/thrustmaster-t16000m.json"))
raw = bytes.fromhex(device["descriptor_hex"])
open(sys.argv[2] + "/t16000m.bin", "wb").write(raw)
open(sys.argv[2] + "/t16000m.txt", "w").write("# as usbhid-dump prints\n" + " ".join("%02X" % b for b in raw) + "\n")
open(sys.argv[2] + "/lines.json", "w").write('{ "descriptor_hex": "zz" }')
open(sys.argv[2] + "/empty.bin", "w").write("")
END
for file in "$hid/thrustmaster-t16000m.json" "$folder/t16000m.bin" "$folder/t16000m.txt"; do
    if "$program" devices --describe "$file" | python3 -c '
import json, sys
described, listed = json.load(sys.stdin), json.load(open(sys.argv[1]))
sys.exit(described["fields"] != listed["fields"] or described["input_report_bits"] != listed["input_report_bits"])' \
        "$hid/thrustmaster-t16000m.json"; then passed=$((passed + 1)); else fail "devices --describe $(basename "$file")"; fi
done
# says TEXT ARGUMENTS...: the program must print one line that has TEXT, and exit with 2.
says() {
    local text=$1 said
    shift
    said=$("$program" "$@" 2>&1 >/dev/null)
    if [ $? = 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" = 1 ] && [[ $said == *"$text"* ]]; then passed=$((passed + 1)); else fail "'$*' does not report '$text': $said"; fi
}
says 'is empty' devices --describe "$folder/empty.bin"
says "does not exist" devices --describe "$folder/no-such.bin"
says "is a folder" devices --describe "$folder"
says '/descriptor_hex' devices --describe "$folder/lines.json"
printf 'hello' > "$folder/hello.bin"
says 'declares no input' devices --describe "$folder/hello.bin"

# Measurements.
refused 'has one number' render --shot start --measure 400
refused 'is not a point' render --shot start --measure '1deg,2'
refused 'lies outside the picture' render --shot start --measure '100,100;800,5'
refused 'overlay' render --shot start --overlay none
said=$("$program" render --shot clocks-passing --size 200x150 --out "$folder/lab" --measure '-14.7deg,0deg; 16.8deg,0deg' --overlay ring --why delay)
if [[ $said == *"ahead: D 0.866"* && $said == *"length 17.49 (rest 20.00 light-s), ◇ minus ○ 9.71 s"* ]]; then passed=$((passed + 1)); else fail "render --measure: $said"; fi
says '--log-every' run --log-every 1

# Exhibit files.
exhibit() { # EXHIBIT_JSON
    printf '%s\n' "$1" > "$folder/exhibit.json"
}
exhibit '{ "flying": { "turn_deg_per_s": 0 } }'
says 'exhibit.json:1: /flying/turn_deg_per_s: 0' run --exhibit "$folder/exhibit.json"
exhibit '{ "layout": "no-such" }'
says 'there are:' run --exhibit "$folder/exhibit.json"
exhibit '{ "scene": "sub/no-such.json" }'
says 'no-such.json' run --exhibit "$folder/exhibit.json"
exhibit '{ "profiles": "no-such" }'
says 'is not a folder' run --exhibit "$folder/exhibit.json"

echo "$passed passed, $failed failed"
[ $failed = 0 ]
