#!/usr/bin/env bash
# Measures the time from a device's report to the present call that shows it, in a real window under Xvfb, with a simulated
# device. It bears any load under which a frame takes at most half a second: its bounds are this machine's own frame times.
# Usage: latency_test.sh PROGRAM RIG_FOLDER
set -u
program=$1 built=$2 rig=$(dirname "$0")/../rig hid=$(dirname "$0")/../hid
. "$rig/monitors.sh"
serve Xvfb -noreset -screen 0 800x600x24
cat >"$folder/small.json" <<'LAYOUT'
{ "outputs": [ { "name": "small", "size": [160, 120], "viewports": [{ "projection": { "type": "planar", "fov_y_deg": 60 } }] } ] }
LAYOUT

# Without a device the program says so and measures nothing.
said=$(timeout 300 umockdev-wrapper "$built/fake_sticks" "$hid" <(echo start) "$program" bench --input --layout "$folder/small.json" --seconds 1 2>&1 >/dev/null)
[ $? = 2 ] && [[ $said == *"a keyboard does not count"* ]] || fail "without a device: $said"
ok

# A space mouse that moves all the time, with 200 reports a second.
name=3dconnexion-spacenavigator
cat >"$folder/script" <<SCRIPT
plug $name 0
start
wait 0.5
forever
report $name 020000e2ff0000 200
SCRIPT
timeout 300 umockdev-wrapper "$built/fake_sticks" "$hid" "$folder/script" "$program" bench --input --layout "$folder/small.json" --seconds 2 \
    >"$folder/table" 2>"$folder/log" || fail "exit $?: $(cat "$folder/table")"
ok
grep -q '^A device reports' "$folder/log" || fail "no line says that a device reports"
ok
row() { awk -v name="$1" 'index($0, name) == 1 { print $(NF - 2), $(NF - 1), $NF }' "$folder/table"; }
report=$(row "report's arrival") own=$(row 'own share') frame=$(row 'frame time') bound=$(row 'no report takes')
awk -v a="$report" -v o="$own" -v f="$frame" -v b="$bound" 'BEGIN {
    exit !(split(a, r) == 3 && split(o, s) == 3 && split(f, t) == 3 && split(b, u) == 3 &&
        r[1] > 0 && r[1] <= r[2] && r[2] <= r[3] && r[3] <= u[3])
}' || fail "a row's three numbers are missing or out of order: $(cat "$folder/table")"
ok
# The controls are read after the waiting, not before it: the own share is well below a frame. Had they been read before it, the
# share would be nearly the frame. A busy machine makes both longer; the medians bear that it stops one frame for long.
awk -v o="$own" -v f="$frame" 'BEGIN { split(o, s); split(f, t); exit !(s[1] < t[1] / 2) }' || fail "Starbow's own share is no small part of a frame: $(cat "$folder/table")"
ok
# An interrupted measurement prints its results so far.
(
    timeout 300 umockdev-wrapper "$built/fake_sticks" "$hid" "$folder/script" bash -c 'echo $$ >"$0/pid"; exec "$@"' "$folder" \
        "$program" bench --input --layout "$folder/small.json" --seconds 600 >"$folder/cut" 2>"$folder/cut-log"
    echo $? >"$folder/status"
) &
started+=($!)
until_true 60 grep -q '^A device reports' "$folder/cut-log" || fail "no device reports" # its first report counts from then on
kill -INT "$(cat "$folder/pid")"
until_true 60 test -s "$folder/status"
[ "$(cat "$folder/status" 2>/dev/null)" = 0 ] && grep -q "report's arrival" "$folder/cut" || fail "interrupted: $(cat "$folder/cut")"
ok
echo "$passed passed, 0 failed"
