#!/usr/bin/env bash
# Vulkan calls fail on purpose (rig/faults.cpp), and the exhibit must fly on. It bears any load under which a run of 130 frames
# takes less than a minute: it counts frames and bounds times from below only.
# Usage: fault_test.sh PROGRAM FOLDER-OF-THE-RIG
set -u
program=$1 tools=$2 rig=$(dirname "$0")/../rig
. "$rig/monitors.sh"
export VK_LAYER_PATH=$tools VK_INSTANCE_LAYERS=VK_LAYER_STARBOW_faults
serve Xvfb -noreset -screen 0 1280x800x24

cat >"$folder/two.json" <<'END'
{ "outputs": [
    { "name": "a", "size": [160, 120], "place": [0, 0], "viewports": [{ "projection": { "type": "planar" } }] },
    { "name": "b", "size": [160, 120], "place": [200, 0], "viewports": [{ "projection": { "type": "planar" } }] }
] }
END

# fly FAULTS [FRAMES]: runs the exhibit; each fault must have happened. The caller checks $status.
fly() {
    STARBOW_FAULTS=$1 timeout 300 "$program" run --layout "$folder/two.json" --frames "${2:-40}" >"$folder/log" 2>&1
    status=$?
    local fault
    for fault in ${1//,/ }; do
        grep -q "^fault: $fault" "$folder/log" || fail "$1: $fault did not happen (exit $status)"
    done
}
# survives FAULTS [FRAMES [MISSED]]: both windows must show all frames but MISSED.
survives() {
    fly "$@"
    [ $status = 0 ] || fail "$1: exit $status"
    local shown
    shown=$(awk '/^fault: shown/ { sum += $3 } END { print sum }' "$folder/log")
    [ "$shown" -ge $((2 * ${2:-40} - ${3:-2})) ] || fail "$1: two windows showed only $shown pictures of ${2:-40} frames each"
    grep -q 'lost' <(grep -v '^fault:' "$folder/log") && [[ $1 != *DEVICE* ]] && fail "$1: a loss of the device is reported"
    ok
}

for result in OUT_OF_DATE SURFACE_LOST SUBOPTIMAL; do
    survives "acquire:7:$result"
    survives "acquire:1:$result"
done
survives acquire:7:FROZEN 130 102 # the other window goes on meanwhile, and this one afterwards
for result in OUT_OF_DATE SURFACE_LOST SUBOPTIMAL; do
    survives "present:8:$result"
    survives "present:1:$result,present:2:$result"
done
survives "acquire:5:OUT_OF_DATE,acquire:6:SURFACE_LOST,present:9:SURFACE_LOST,swapchain:3:SURFACE_LOST" 40 6

# After the loss of the device, the program opens it anew and the flight continues from where it was.
# A world of large textures takes many submits before its first frame.
for call in acquire:20 present:20 submit:60; do
    survives "$call:DEVICE_LOST" 90
    [ "$(grep -c 'it is opened again' "$folder/log")" = 1 ] || fail "$call: the new device is not reported exactly once"
    # 90 frames take 1.5 s at 60 Hz, at most a hundredth more. The 70 frames after the loss alone would take 1.16 s.
    flown=$(sed -n 's/.*ship \([0-9.]*\) s.*/\1/p' "$folder/log")
    awk "BEGIN { exit !($flown >= 1.35) }" || fail "$call: the flight began anew: $flown s"
    ok
done

# So it does where the device is lost while the world loads.
survives submit:1:DEVICE_LOST
[ "$(grep -c 'it is opened again' "$folder/log")" = 1 ] || fail "lost in loading: the new device is not reported exactly once"
ok

# A device without memory is opened anew, too. Before the first picture the program ends with one line and exit 2.
survives submit:60:OUT_OF_MEMORY 90
[ "$(grep -c 'OutOfDeviceMemory.*it is opened again' "$folder/log")" = 1 ] || fail "no memory in flight: no line says so"
ok
fly submit:1:OUT_OF_MEMORY
[ $status = 2 ] || fail "no memory at the start: exit $status"
[ "$(grep -c '^starbow: The graphics driver has failed: .*OutOfDeviceMemory' "$folder/log")" = 1 ] || fail "no memory at the start: no line says so"
ok

# A level of quality that has no room is left at once for one that has it, and is not tried again. The machine's speed decides
# which level is tried first: the highest, or one that a slow frame allows.
STARBOW_LARGEST_KIB=40000 timeout 600 "$program" run --layout desk --scene warm-wall --frame-budget-ms 1000 --frames 60 >"$folder/log" 2>&1 \
    || fail "a level without room: exit $?"
refused=$(grep -o 'quality: level [0-9]* of 16 has no room' "$folder/log")
[ -n "$refused" ] || fail "a level without room: no line says so"
[ -z "$(sort <<<"$refused" | uniq -d)" ] || fail "a level without room: tried again: $refused"
[ "$(grep -c '^fault: no room' "$folder/log")" = "$(wc -l <<<"$refused")" ] || fail "a level without room: tried $(grep -c '^fault: no room' "$folder/log") times"
grep -q 'is lost' "$folder/log" && fail "a level without room: a loss of the device is reported"
ok

# A use of memory beyond the driver's budget, which no call refuses: the governor leaves levels until one fits, and with a fixed
# quality one line says so.
STARBOW_BUDGET_KIB=60000 timeout 600 "$program" run --layout desk --scene warm-wall --frame-budget-ms 1000 --frames 700 >"$folder/log" 2>&1 \
    || fail "beyond the budget: exit $?"
grep -q 'quality: level [0-9]* of 16 has no room on the GPU (.* of the GPU.s memory are used' "$folder/log" || fail "beyond the budget: no level is left"
grep -q 'pictures may come slowly' "$folder/log" && fail "beyond the budget: no level was small enough"
STARBOW_BUDGET_KIB=20000 timeout 600 "$program" run --layout desk --scene warm-wall --quality balanced --frames 300 >"$folder/log" 2>&1 \
    || fail "far beyond the budget: exit $?"
[ "$(grep -c 'quality: .* of the GPU.s memory are used, and its driver gives this program 20 MiB now: pictures may' "$folder/log")" = 1 ] \
    || fail "far beyond the budget: not one line"
STARBOW_BUDGET_KIB=20000 "$program" doctor 2>/dev/null | grep -q 'of which this program can have 20 MiB now' || fail "doctor does not show the budget"
ok

# Shadows without room are left out, and the world is shown.
STARBOW_LARGEST_KIB=60000 timeout 600 "$program" run --layout desk --scene gamow --frame-budget-ms 1000 --frames 20 >"$folder/log" 2>&1 \
    || fail "shadows without room: exit $?"
grep -q 'its shadows have no room on the GPU: it is drawn without them' "$folder/log" || fail "shadows without room: no line says so"
ok

# A device that can't be opened at once is tried again, and why is said once.
fly submit:20:DEVICE_LOST,vkCreateDevice@lost:1:INITIALIZATION_FAILED,vkCreateDevice@lost:2:INITIALIZATION_FAILED,vkCreateInstance@lost:3:OUT_OF_HOST_MEMORY 60
[ $status = 0 ] || fail "opened in vain: exit $status"
[ "$(grep -c 'it is opened again' "$folder/log")" = 3 ] || fail "opened in vain: not one line a reason"
ok

# A window grows, and the device has no memory for its larger picture: a smaller one is drawn, the device stays, and the flight
# goes on. So it is where a window is to be larger than the device's pictures can be. Where a changed layout has no room, the
# old one stays.
# grow NAME WxH FAULTS [WARM-UP]: flies in a window that grows, for a moment. A warm-up at rest would meet the faults first.
grow() {
    rm -f "$folder/flight.jsonl"
    STARBOW_FAULTS=$3 timeout 600 "$program" run --layout "$folder/sizes.json" --warm-up "${4:-never}" --record "$folder/flight.jsonl" >"$folder/log" 2>&1 &
    exhibit=$!
    "$rig/wait_flown.py" "$folder/flight.jsonl" 0.3 || fail "$1: no flight"
    xdotool windowsize "$(xdotool search --name '^Starbow a' | head -n 1)" ${2/x/ }
}
# stays NAME TEXT: the flight that grow began goes on, with the text in one line and without a new device, and ends in order.
stays() {
    until_true 30 grep -q "$2" "$folder/log" || fail "$1: no line says so"
    "$rig/wait_flown.py" "$folder/flight.jsonl" 0.5 || fail "$1: the flight stands still"
    kill -INT "$(pgrep -P $exhibit)"
    wait $exhibit || fail "$1: exit $?"
    [ "$(grep -c "$2" "$folder/log")" = 1 ] || fail "$1: more than one line says so"
    grep -q 'opened again' "$folder/log" && fail "$1: the device is opened anew"
    ok
}
# The colours' gamma needs pictures of the window's size.
sed 's/"place": \[[02]*, 0\]/"resizable": true, "colour": { "gamma": 2.2 }/' "$folder/two.json" >"$folder/sizes.json"
grow "no memory for a larger window" 900x700 resize:1:OUT_OF_MEMORY
stays "no memory for a larger window" "output 'a' is drawn smaller, 450x350 pixels scaled up to 900x700: The GPU has no [0-9]* MiB"
grow "a window of 32,000 pixels" 32000x200 ''
stays "a window of 32,000 pixels" "the window of output 'a' is to have 32000x200 pixels, more than the GPU's 16384 on a side; it becomes 16384x102"
grow "no memory for a changed layout" 160x120 vkCreateImage@10:1:OUT_OF_DEVICE_MEMORY
sed -i 's/2.2/2.1/' "$folder/sizes.json"
stays "no memory for a changed layout" 'layout: The GPU.s memory is used up (.*OutOfDeviceMemory); the exhibit stays as it was'
# Without room for the warm-up at rest, the flight goes on without one.
for fault in vkCreateImage@10:1:OUT_OF_DEVICE_MEMORY vkCreateGraphicsPipelines@10:1:OUT_OF_HOST_MEMORY; do
    grow "no memory for the warm-up" 160x120 $fault auto
    stays "no memory for the warm-up" "fault: $fault"
done

# If the device is lost again and again, the exhibit ends with a message and exit 1.
fly acquire:20:DEVICE_LOST,acquire:30:DEVICE_LOST,acquire:40:DEVICE_LOST,acquire:50:DEVICE_LOST,acquire:60:DEVICE_LOST,acquire:70:DEVICE_LOST
[ $status = 1 ] || fail "lost again and again: exit $status"
grep -q 'lost again and again' "$folder/log" || fail "lost again and again: no message"
ok

# Where the driver reports when pictures are shown, the skew is measured: here the second window shows them 7 ms later.
export STARBOW_SHOWN_LATE_MS=7
fly '' 60
[ $status = 0 ] || fail "present wait: exit $status"
skew=$(sed -n 's/^outputs shown together within \([0-9.]*\) ms.*/\1/p' "$folder/log")
# A sleep takes at least its time; the driver's own clock tells how much more it took on this machine.
read -r least most <<<"$(sed -n 's/^fault: reported \([0-9.]*\) to \([0-9.]*\) ms apart$/\1 \2/p' "$folder/log")"
awk "BEGIN { exit !($least >= 6.5 && $skew > $least - 0.5 && $skew < $most + 0.5) }" \
    || fail "present wait: a skew of $skew ms, and the pictures were shown $least to $most ms apart, at least 7"
ok
# Nothing frees a fence of lavapipe while its rasterizer still unlocks it (runtime/render/scene_keeper.h): the cube map in one
# image and in many with coarser levels, textures, stars, bodies, glow, head-up display, and viewports over each other.
unset VK_INSTANCE_LAYERS
cat >"$folder/over.json" <<'END'
{ "outputs": [ { "name": "a", "size": [320, 240], "viewports": [
    { "projection": { "type": "planar" } },
    { "rect": [0.6, 0.6, 0.3, 0.3], "order": 1, "projection": { "type": "planar" } }
] } ] }
END
for flight in "--shot avenue-gamma4" "--shot gamma100" "--shot twins-meeting" "--layout $folder/over.json"; do
    LD_PRELOAD=$tools/libstarbow_early_free.so timeout 600 "$program" run $flight --frames 12 >"$folder/log" 2>&1 ||
        fail "early frees, $flight: exit $?"
    grep -Eq '^early frees: 0 in [0-9]{4,} unlocks' "$folder/log" || fail "$flight: $(grep '^early frees' "$folder/log")"
    ok
done

# Every kind of error of Vulkan, here and there in a flight; without --sample it takes half an hour.
"$(dirname "$0")/../every_fault.py" "$program" "$tools" --sample ${STARBOW_ALL_CASES:-40} >"$folder/log" || fail "Vulkan's failures"
ok

# A command that is refused memory says so in one line, also where a library asks for it inside a function that may not throw.
refused=0
for ((n = 1; n < 5000; n += 23)); do
    STARBOW_FAULTS=new:$n:OUT_OF_MEMORY LD_PRELOAD=$tools/libstarbow_no_memory.so \
        "$program" check "$rig/../../config/layouts/desk.json" --svg "$folder/plan.svg" >"$folder/out" 2>"$folder/log"
    status=$?
    grep -q '^fault: new' "$folder/log" || break
    [ $status = 0 ] || { [ $status = 2 ] && [ "$(grep -c '^starbow: ' "$folder/log")" = 1 ]; } || fail "allocation $n: exit $status"
    refused=$((refused + 1))
done
[ $refused -gt 100 ] || fail "only $refused allocations were refused"
ok

# The X server ends: so does the program, in order, with a status of its own, and without a crash's trace. The service manager
# starts both anew.
STATE_DIRECTORY=$folder/state timeout 600 "$program" run --layout "$folder/two.json" --record "$folder/end.jsonl" --trace "$folder/end.json" \
    >"$folder/log" 2>&1 &
exhibit=$!
"$rig/wait_flown.py" "$folder/end.jsonl" 0.3 || fail "the X server ends: no flight"
kill -KILL "${started[0]}"
wait "${started[0]}" 2>/dev/null
wait $exhibit
status=$?
[ $status = 5 ] || fail "the X server ends: exit $status"
[ "$(grep -c ' error exhibit: the X server has ended' "$folder/log")" = 1 ] || fail "the X server ends: no line says so"
[ "$(grep -vc '^recorded in\|^light in\|the X server has ended' "$folder/log")" = 0 ] || fail "the X server ends: more lines than that"
grep -q '"last":true' <(tail -n 1 "$folder/end.jsonl") || fail "the X server ends: the record has no end"
[ "$(tail -c 2 "$folder/end.json")" = ']' ] || fail "the X server ends: the trace has no end"
[ ! -e "$folder/state/crash" ] || fail "the X server ends: a crash's trace"
ok
echo "$passed passed, 0 failed"
