#!/usr/bin/env bash
# A simulated stick and throttle with an unmodified program. They are found by their profiles and flown to a given speed; one
# is unplugged in flight and plugged in at another port. It bears any load under which a frame takes at most a second.
# Usage: sticks_test.sh PROGRAM RIG_FOLDER
set -u
program=$1 tools=$2 here=$(cd "$(dirname "$0")/.." && pwd)
. "$here/rig/monitors.sh"
serve Xvfb -noreset -screen 0 800x600x24
export STARBOW_VALIDATION=1 XDG_CONFIG_HOME=$folder/own

# The lever's middle is half the rapidity of gamma 100: gamma 7.106.
cat >"$folder/exhibit.json" <<END
{ "layout": "desk", "tutorial": false, "flying": { "max_gamma": 100 } }
END

# watch_clock: wakes every 50 ms, as a device's reader does, and writes when it woke and how many milliseconds too late.
watch_clock() {
    local from until
    exec 9<> <(:)
    while :; do
        from=$EPOCHREALTIME
        read -r -t 0.05 -u 9
        until=$EPOCHREALTIME
        echo "$until $(((10#${until/./} - 10#${from/./}) / 1000 - 50))"
    done
}

# lateness FIRST SECOND: the worst lateness of that clock, milliseconds, from half a second before the first to half a second after
# the second line that `between` takes.
lateness() {
    awk -v first="$1" -v second="$2" 'FNR == NR { if (!from && $0 ~ first) from = $1; else if (from && !until && $0 ~ second) until = $1
            next }
        $1 > from - 0.5 && $1 < until + 0.5 && $2 > worst { worst = $2 } END { print worst + 0 }' "$folder/log" "$folder/clock"
}

# play SCRIPT_NAME: runs the program with a script; the log has each line with its time.
play() {
    timeout 600 umockdev-wrapper "$tools/fake_sticks" "$here/hid" "$folder/$1" \
        "$program" run --exhibit "$folder/exhibit.json" --record "$folder/record" 2>&1 </dev/null \
        | while IFS= read -r line; do echo "$EPOCHREALTIME $line"; done >"$folder/log"
}

# between FIRST SECOND: milliseconds from the first line that matches FIRST to the next line that matches SECOND.
between() {
    awk -v first="$1" -v second="$2" \
        '!from && $0 ~ first { from = $1; next } from && $0 ~ second { printf "%.0f", 1000 * ($1 - from); exit }' "$folder/log"
}

# The T.16000M's report has buttons in 2 bytes, hat and 4 bits in 1, x 2, y 2, twist 1, slider 1, then zeros. The TWCS throttle's
# has its number, then x, y, rz, rx, ry, slider and dial in 2 each, the lever in 2 (65535 is idle), and the hat.
stick() { # BUTTONS_HEX X_HEX(little-endian)
    printf '%s0f%s0020%s' "$1" "$2" 80ff
    printf '00%.0s' $(seq 55)
}
throttle() { # LEVER_HEX(little-endian)
    printf '01'
    printf '0002%.0s' $(seq 7)
    printf '%s0f' "$1"
    printf '00%.0s' $(seq 46)
}
cat >"$folder/visit" <<END
plug thrustmaster-t16000m 0
plug thrustmaster-twcs-throttle 1
start
run for i in \$(seq 200); do xdotool search --name '^Starbow' >/dev/null 2>&1 && break; sleep 0.1; done
wait 2
report thrustmaster-t16000m $(stick 0000 0020)
report thrustmaster-twcs-throttle $(throttle ffff)
wait 0.5
report thrustmaster-twcs-throttle $(throttle 0080)
report thrustmaster-t16000m $(stick 0000 ff3f)
run $here/rig/wait_flown.py $folder/record 6
say unplugs the throttle
unplug thrustmaster-twcs-throttle
wait 1
say unplugs the stick
unplug thrustmaster-t16000m
wait 1
say plugs in the throttle elsewhere
plug thrustmaster-twcs-throttle 5
wait 1
report thrustmaster-twcs-throttle $(throttle 0080)
wait 1
plug thrustmaster-t16000m 0
wait 0.5
report thrustmaster-t16000m $(stick 0000 0020)
$(for button in 4000 4000 4000 4000 4000 0800 0800; do # 7, the display, five times, and 4, the Doppler effect, twice
    echo "report thrustmaster-t16000m $(stick $button 0020)"; echo "report thrustmaster-t16000m $(stick 0000 0020)"; done)
$(for i in $(seq 40); do echo "report thrustmaster-t16000m $(stick 0000 ff3f)"; echo "report thrustmaster-t16000m $(stick 0000 0020)"; done)
run $here/rig/wait_flown.py $folder/record 1
run xdotool key Escape
END
watch_clock >"$folder/clock" &
clock=$!
play visit
kill $clock

grep -q 'T.16000M.*flown by the profile Thrustmaster T.16000M' "$folder/log" || fail "the stick was not found by its profile"
ok
grep -q 'TWCS.*flown by the profile Thrustmaster TWCS' "$folder/log" || fail "the throttle was not found by its profile"
ok
grep -q 'validation' "$folder/log" && fail "the validation layers report an error"
ok
# A reader waits 50 ms at most for a report. The line's way here wakes three more processes (the rig, the reader, the log's), each
# of which a busy machine delays as it delays the clock beside them.
for device in TWCS T.16000M; do
    unplugs="rig: unplugs the $([ $device = TWCS ] && echo throttle || echo stick)"
    gone=$(between "$unplugs" "$device.*is unplugged")
    late=$(lateness "$unplugs" "$device.*is unplugged")
    [ "${gone:-1000}" -le $((100 + 3 * late)) ] || fail "$device: noticed ${gone:-never} ms after it was unplugged, a clock $late ms late"
    echo "  $device unplugged: noticed after $gone ms, a clock at most $late ms late"
    ok
done
back=$(between 'rig: plugs in the throttle' 'TWCS.*is plugged in at /dev/hidraw5')
[ "${back:-10000}" -le 1000 ] || fail "the throttle on another port works after ${back:-no} ms"
echo "  plugged in again on another port: read after $back ms"
ok
# During all this the ship keeps the speed of the lever's last position.
grep -q ' γ 7.106 ' "$folder/log" || fail "the last speed is not that of half a lever, gamma 7.106"
ok
# The record's controls, frame by frame: the throttle is released first, the stick a second later, and nothing in between.
python3 - "$folder/record" <<'END' || fail "the record's axes are not neutral while the devices are unplugged"
import json, sys
now, frames = 0, []
for line in list(open(sys.argv[1]))[1:]:
    entry = json.loads(line)
    if "dt_ns" in entry:
        now += (entry["dt_ns"] + entry.get("skipped_ns", 0)) * 1e-9
        frames.append((now, "lever" in entry, "turn" in entry))
changes = [(b[0], b[1], b[2]) for a, b in zip(frames, frames[1:]) if a[1:] != b[1:]]
held = next(i for i, c in enumerate(changes) if c[1] and c[2])
(gone, *first), (let_go, *second), (back, *third) = changes[held + 1:held + 4]
print("  the throttle's axes neutral, the stick's %.2f s later, the throttle's back %.2f s after" % (let_go - gone, back - let_go))
sys.exit(not (first == [False, True] and second == [False, False] and third == [True, False]
    and abs(let_go - gone - 1) < 0.25 and 0.9 < back - let_go < 3))
END
ok
# Taps of 5 ms, several in a frame: the record has every one.
for taps in hud:5 doppler:2; do
    counted=$(tail -n +2 "$folder/record" | grep -o "\"${taps%:*}\": *true" | wc -l) # the first line has the start
    [ "$counted" = "${taps#*:}" ] || fail "of ${taps#*:} taps of ${taps%:*} on the stick, $counted count"
done
ok
grep -q 'T.16000M.*axis X jitters and is left out' "$folder/log" || fail "a jittering axis is not reported"
ok

# A stick that falls silent while it is tilted turns its own visitor's ship, and not the next one's.
mkdir "$folder/visits"
cat >"$folder/visited.json" <<END
{ "layout": "desk", "quality": "draft", "tutorial": false, "visit": { "idle_s": 5, "ask_s": 5, "fade_s": 0.4 } }
END
cat >"$folder/left" <<END
plug thrustmaster-t16000m 0
start
run for i in \$(seq 200); do xdotool search --name '^Starbow' >/dev/null 2>&1 && break; sleep 0.1; done
wait 2
report thrustmaster-t16000m $(stick 0000 0020)
wait 0.5
report thrustmaster-t16000m $(stick 0000 ff3f)
run for i in \$(seq 900); do grep -q 'recorded in' $folder/left-log && break; sleep 0.1; done
run xdotool key w
run for i in \$(seq 200); do [ \$(ls $folder/visits | wc -l) = 2 ] && break; sleep 0.1; done
run $here/rig/wait_flown.py \$(ls $folder/visits/* | tail -n 1) 1
interrupt
END
timeout 600 umockdev-wrapper "$tools/fake_sticks" "$here/hid" "$folder/left" \
    "$program" run --exhibit "$folder/visited.json" --record "$folder/visits" >"$folder/left-log" 2>&1 </dev/null
turned() { grep -c '"turn"' "$1"; }
first=$(ls "$folder/visits"/* | head -n 1) second=$(ls "$folder/visits"/* | tail -n 1)
[ "$first" != "$second" ] || fail "the next visitor has no record: $(tail -n 3 "$folder/left-log")"
[ "$(turned "$first")" -gt 20 ] || fail "the stick does not turn its visitor's ship"
ok
[ "$(turned "$second")" = 0 ] || fail "the stick that was left tilted turns the next visitor's ship in $(turned "$second") frames"
ok

# Without permission to read a device, the udev rule is named. Only root can take the permission away.
if [ "$(id -u)" = 0 ]; then
    cat >"$folder/locked" <<END
plug thrustmaster-t16000m 0
run chmod -R go+rX \$UMOCKDEV_DIR; find \$UMOCKDEV_DIR -type s -exec chmod 777 {} +
run chmod 600 \$(readlink \$UMOCKDEV_DIR/dev/hidraw0)
start
END
    # A checkout may be closed to other users, so the test copies the program and its files.
    mkdir "$folder/open"
    cp -r "$program" "$here/../config" "$folder/open"
    chmod -R go+rX "$folder"
    (cd "$folder" && timeout 30 umockdev-wrapper "$tools/fake_sticks" "$here/hid" "$folder/locked" \
        setpriv --reuid=65534 --regid=65534 --clear-groups "$folder/open/starbow" devices) >"$folder/log" 2>&1 </dev/null
    grep -q "T.16000M.*can't be read by this user: copy config/udev/70-starbow.rules" "$folder/log" || fail "no permission: devices does not name the rule"
    ok
    advice='copy config/udev/70-starbow.rules'
    for rules in /etc/udev/rules.d /run/udev/rules.d /usr/lib/udev/rules.d /lib/udev/rules.d; do
        [ -e $rules/70-starbow.rules ] && advice='plug it in again' # Starbow is installed on this machine
    done
    (cd "$folder" && timeout 30 umockdev-wrapper "$tools/fake_sticks" "$here/hid" "$folder/locked" \
        setpriv --reuid=65534 --regid=65534 --clear-groups "$folder/open/starbow" doctor) >"$folder/log" 2>&1 </dev/null
    [ $? = 1 ] && grep -q '1 hidraw nodes, 1 of them not readable by this user' "$folder/log" \
        && grep -q "^- .*T.16000M.*/dev/hidraw0 can't be read by this user: $advice" "$folder/log" \
        || fail "no permission: the doctor does not report it: $(cat "$folder/log")"
    ok
fi
echo "$passed passed, 0 failed"
