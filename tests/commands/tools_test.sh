#!/usr/bin/env bash
# The commands of starbow-tools, as starbow starts them: wrong arguments are refused in one line, help has examples, and the picture by
# rays needs no GPU. Usage: tools_test.sh PROGRAM
set -u
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
. "$(dirname "$0")/../rig/refusals.sh"

refused '8192x8192' render --shot start --size 16384x16384 --reference
refused '--samples' render --shot start --reference --samples 0
refused '--exposure' render --shot start --reference --exposure auto
refused '--hud' render --shot start --reference --hud
refused '--overlay' render --shot start --reference --overlay ring
refused '--spectra' render --shot start --reference --spectra fine
begins_with '--rounds: 0 is not' bench --rounds 0
said=$("$program" bench --json "$folder" 2>&1 >/dev/null)
if [ $? != 2 ] || [[ $said != *"not a file"* ]]; then fail "bench into a folder: $said"; else passed=$((passed + 1)); fi

for command in bench measure soak; do
    if "$program" $command --help | grep -q "starbow $command"; then passed=$((passed + 1)); else fail "$command --help has no example"; fi
done

begins_with '--family: ' bench --estimate --family geforce
"$program" bench --estimate --layout desk --family polaris10 2>/dev/null | grep -q '^surface' && passed=$((passed + 1)) || fail "bench --estimate has no row of surfaces"

# One pass alone has the figures of the whole table; against itself nothing has changed.
"$program" bench --shaders --scene warm-wall --json "$folder/shaders.json" >/dev/null 2>&1
said=$("$program" bench --shaders --scene warm-wall --pass warp 2>/dev/null | python3 -c '
import json, sys
whole = json.load(open(sys.argv[1]))["shaders"]["warp"]
alone = [line.split(None, 7) for line in sys.stdin.read().splitlines() if line[:13].strip().isdigit()]
assert len(whole) > 4 and len(alone) == len(whole), (len(whole), len(alone))
for *figures, variant in alone:
    assert [float(one) for one in figures] == list(whole[variant.strip()].values()), variant
print("same")' "$folder/shaders.json" 2>&1)
[ "$said" = same ] && passed=$((passed + 1)) || fail "bench --shaders --pass: $said"
said=$("$program" bench --shaders --scene warm-wall --against "$folder/shaders.json" 2>/dev/null | sed -n '/^changed/,$p' | wc -l)
[ "$said" = 1 ] && passed=$((passed + 1)) || fail "bench --shaders --against itself has $said lines of changes"
begins_with '--pass: ' bench --shaders --scene warm-wall --pass wrap

begins_with '--display: ' bench --card "$folder/card" --display wall
begins_with '/proc/card/card.json: ' bench --card /proc/card
"$program" bench --card "$folder/card" --display window --rounds 3 >/dev/null 2>&1
said=$(python3 -c '
import json, sys
card = json.load(open(sys.argv[1] + "/card.json"))
json.load(open(sys.argv[1] + "/trace.json"))
for one in card["displays"]:
    passes = sum(one["passes_ms"].values())
    assert 0 < passes <= 1.5 * one["device_ms"] and one["device_ms"] <= one["frame_ms"] <= one["slowest_ms"], one
print(len(card["displays"]), open(sys.argv[1] + "/card.html").read().count("<svg"))' "$folder/card")
[ "$said" = "6 1" ] && passed=$((passed + 1)) || fail "bench --card: $said"

# The reference needs no GPU, and a finished picture leaves no file to continue from.
for time in once twice; do
    VK_DRIVER_FILES=/nonexistent VK_ICD_FILENAMES=/nonexistent "$program" render --shot starbow --size 40x30 --reference \
        --samples 2 --out "$folder/rays-$time" --exr >/dev/null || fail "--reference needs a GPU"
done
cmp -s "$folder/rays-once/desk.png" "$folder/rays-twice/desk.png" && cmp -s "$folder/rays-once/desk.exr" "$folder/rays-twice/desk.exr" \
    && [ ! -e "$folder/rays-once/desk.rows" ] && passed=$((passed + 1)) || fail "--reference draws different bytes the second time, or leaves its rows"

echo "$passed passed, $failed failed"
[ $failed = 0 ]
