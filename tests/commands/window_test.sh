#!/usr/bin/env bash
# The exhibit in a real window under Xvfb with validation layers: flown by the keyboard, resized, ended.
# It bears any load under which a frame takes at most a second: it waits for pictures and lines, and its keys keep the
# exhibit's own pace.
# Usage: window_test.sh PROGRAM FOLDER_OF_THE_RIG
set -u
program=$(realpath "$1") x_client=$(realpath "$2")/x_client rig=$(dirname "$0")/../rig
. "$rig/monitors.sh"
serve Xvfb -noreset -screen 0 1280x800x24
export STARBOW_VALIDATION=1

drawn() { [ "$(import -window "$window" -format '%[fx:mean>0]' info:)" = 1 ]; }

fly() { # LAYOUT [MORE...]
    timeout 300 "$program" run --layout "$@" >"$folder/log" 2>&1 &
    exhibit=$!
    started+=($exhibit)
    window=
    for _ in $(seq 200); do
        window=$(xdotool search --name '^Starbow' 2>/dev/null | head -n 1)
        [ -n "$window" ] && break
        kill -0 $exhibit 2>/dev/null || fail "$1: ended before its window opened"
        sleep 0.1
    done
    [ -n "$window" ] || fail "$1: no window"
    xdotool windowfocus "$window"
    until_true 60 drawn || fail "$1: no picture"
}

# Speeds up, turns, resizes, switches an effect off, and ends. The last line of the log has the ship's state.
fly desk --record "$folder/desk.jsonl"
xdotool keydown w
"$rig/wait_flown.py" "$folder/desk.jsonl" 3 || fail "desk: the flight stands still"
xdotool keyup w
xdotool key 2 l 4
# Keys that are tapped several times within one frame: the program sleeps meanwhile. The record has every press.
pkill -STOP -P $exhibit
xdotool key --delay 20 h h h h h F1 F1 F1
pkill -CONT -P $exhibit
"$rig/wait_flown.py" "$folder/desk.jsonl" 2 || fail "desk: the flight stands still after taps"
for size in '500 300' '900 700'; do
    xdotool windowsize "$window" $size
    "$rig/wait_flown.py" "$folder/desk.jsonl" 0.5 || fail "desk: the flight stands still at $size"
done
xdotool key Escape
wait $exhibit || fail "desk: exit $? (an error of the validation layers, or a crash)"
ok
grep -q 'validation' "$folder/log" && fail "desk: the validation layers report an error"
ok
gamma=$(sed -n 's/.*γ \([0-9.]*\).*/\1/p' "$folder/log")
awk "BEGIN { exit !($gamma > 1.05) }" || fail "desk: W did not speed up: gamma $gamma"
ok
for tap in hud:5 why:3; do
    counted=$(grep -o "\"${tap%:*}\": *true" "$folder/desk.jsonl" | wc -l)
    [ "$counted" = "${tap#*:}" ] || fail "desk: of ${tap#*:} taps of ${tap%:*} in one frame, $counted count"
done
ok
grep -q 'Doppler off' "$folder/log" || fail "desk: 2 did not switch the Doppler effect off"
ok
grep -q 'light false colours.*unshifted' "$folder/log" || fail "desk: 4 did not switch to false colours, or the log does not name them"
ok
grep -q 'exposure [^ ]* EV locked' "$folder/log" || fail "desk: L did not hold the exposure"
ok

# A key that is let go while another program has the keyboard, by a grab or by the focus, is let go. So is one that is held
# meanwhile, and a new press counts. The screen saver, due after a second without input, stays off, and the desktop's own too.
dbus-daemon --session --nofork --print-address=1 >"$folder/bus" 2>"$folder/bus-log" &
started+=($!)
until_true 10 test -s "$folder/bus" || fail "no session's bus starts"
DBUS_SESSION_BUS_ADDRESS=$(cat "$folder/bus")
export DBUS_SESSION_BUS_ADDRESS
"$(dirname "$x_client")/screen_saver" "$folder/saver" &
started+=($!)
until_true 10 grep -q ready "$folder/saver" || fail "the desktop's screen saver does not start"
fly desk --record "$folder/grab.jsonl"
xset s 1 1
turning() { tail -n 8 "$folder/grab.jsonl" | grep -q '"turn"'; }
still() { "$rig/wait_flown.py" "$folder/grab.jsonl" 1.5 && ! turning; } # the record is written each second
"$rig/wait_flown.py" "$folder/grab.jsonl" 0.1
xdotool keydown Left
until_true 60 turning || fail "grab: the key does not turn the ship"
"$x_client" grab 1 >"$folder/grabbed" &
until_true 10 grep -q grabbed "$folder/grabbed" || fail "grab: the keyboard can't be grabbed"
xdotool keyup Left
wait $!
still || fail "grab: the ship turns on after the key was let go"
ok
xdotool keydown Left
until_true 60 turning || fail "grab: the key does not turn the ship again"
xdotool keyup Left
still || fail "grab: the ship turns on"
ok
xdotool keydown Left
until_true 60 turning || fail "focus: the key does not turn the ship"
"$x_client" focus
xdotool keyup Left
still || fail "focus: the ship turns on after the key was let go"
ok
[ "$("$x_client" saver)" = off ] || fail "the screen saver is $("$x_client" saver)"
[ "$(cat "$folder/saver")" = "ready
kept away by Starbow: an exhibit is shown" ] || fail "the desktop's own screen saver: $(cat "$folder/saver")"
ok
xdotool windowfocus "$window" key Escape
wait $exhibit || fail "grab: exit $?"
ok
saver_is_on() { [ "$("$x_client" saver)" = on ]; }
until_true 10 saver_is_on || fail "the screen saver stays off after the exhibit"
until_true 10 grep -q 'free again' "$folder/saver" || fail "the desktop's screen saver stays away after the exhibit"
unset DBUS_SESSION_BUS_ADDRESS
ok
xset s 0 0 s reset

# The instruments: marks, log, explanation, plots and overlays. Each K writes a line to the log.
fly desk --scene clocks --log "$folder/lab.csv"
lines() { [ "$(wc -l <"$folder/lab.csv")" -ge "$1" ]; }
xdotool key o x
began=${EPOCHREALTIME/./}
xdotool key k
until_true 30 lines 2 || fail "instruments: no line in the log"
pace=$(awk -v us=$((${EPOCHREALTIME/./} - began)) 'BEGIN { print 0.1 + 2e-6 * us }') # a frame lies between two keys
for key in x k F1 o o g k g o o g F1 o g; do
    xdotool key $key
    sleep "$pace"
done
xdotool key Escape
wait $exhibit || fail "instruments: exit $? (an error of the validation layers, or a crash)"
ok
[ "$(wc -l <"$folder/lab.csv")" = 4 ] || fail "instruments: the log has not three measurements: $(wc -l <"$folder/lab.csv")"
ok
python3 - "$folder/lab.csv" <<'CHECK' || fail "instruments: the log is wrong: $(cat "$folder/lab.csv")"
import csv, sys
rows = list(csv.DictReader(open(sys.argv[1], newline="")))
assert rows[0]["overlay"] == "aim" and rows[2]["overlay"] == "ring", rows
assert abs(float(rows[0]["aim_distance_light_s"]) - 31) < 0.1, rows[0]
assert abs(float(rows[0]["world_time_s"]) - 31 - float(rows[0]["aim_clock_s"])) < 0.1, rows[0]
assert rows[0]["mark_1_clock_s"] and not rows[0]["mark_2_clock_s"] and rows[1]["mark_2_clock_s"], rows
assert float(rows[1]["marks_angle_deg"]) == 0 and float(rows[1]["ship_time_s"]) > float(rows[0]["ship_time_s"])
CHECK
ok
# By eye K asks for a reading: the keys write it and neither steer nor switch, and the theory comes with the whole line. Esc
# gives up once, and then leaves.
fly desk --shot clocks-passing --by-eye --log "$folder/eye.csv" --record "$folder/eye.jsonl"
xdotool key o
"$rig/wait_flown.py" "$folder/eye.jsonl" 0.2 || fail "by eye: the flight stands still"
for key in k 1 6 3 w BackSpace 3 period 5 Return space 4 Return; do
    xdotool key $key
    sleep "$pace"
done
written() { [ "$(wc -l <"$folder/eye.csv")" = 2 ]; }
until_true 30 written || fail "by eye: no reading in the log"
xdotool keydown w
for key in k 2 7 Escape; do
    xdotool key $key
    sleep "$pace"
done
xdotool keyup w
xdotool key Escape
wait $exhibit || fail "by eye: exit $?"
ok
python3 - "$folder/eye.csv" "$folder/eye.jsonl" <<'CHECK' || fail "by eye: the log is wrong: $(cat "$folder/eye.csv")"
import csv, json, sys
rows = list(csv.DictReader(open(sys.argv[1], newline="")))
assert len(rows) == 1, rows
row = rows[0]
assert (row["reading_of"], row["reading"], row["reading_uncertainty"]) == ("wavelength_nm", "63.5", "4"), row
assert row["aberration_on"] == "1" and row["headlight_on"] == "0" and abs(float(row["beta"]) - 0.5) < 1e-9, row
assert abs(float(row["reading_theory"]) - float(row["aim_550_nm_seen_as_nm"])) < 1e-6, row
assert abs(float(row["reading_sigmas"]) - (63.5 - float(row["reading_theory"])) / 4) < 1e-6, row
flown = [json.loads(line) for line in open(sys.argv[2])]
frames = [entry for entry in flown if "dt_ns" in entry]
assert any(frame.get("log") for frame in frames)
for switch in ("aberration", "doppler", "headlight", "stop", "menu", "undo", "quit"):
    pressed = sum(bool(frame.get(switch)) for frame in frames)
    assert pressed <= (switch == "quit"), switch
CHECK
ok
printf 'date,weather\n' >"$folder/other.csv"
said=$(timeout 600 "$program" run --log "$folder/other.csv" 2>&1 >/dev/null)
[ $? = 2 ] && [[ $said == *"other.csv: 1: begins otherwise"* ]] || fail "a file that is not a log: $said"
ok

# A tour flies by itself. Two keys skip to its third step, which speeds up from rest for 14 s to a gamma of 4 and ends while
# it still does. The ship is at rest in the steps before.
fly desk --tour first-minute --log "$folder/tour.csv" --log-every 0.1
xdotool key r
sleep "$pace"
xdotool key r
sped_up() { awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "gamma") column = i } END { exit !($column > 1.02) }' "$folder/tour.csv"; }
until_true 120 sped_up || fail "a tour: the third step does not speed up"
xdotool key Escape
wait $exhibit || fail "a tour: exit $?"
ok
gamma=$(sed -n 's/.*γ \([0-9.]*\).*/\1/p' "$folder/log")
awk "BEGIN { exit !($gamma > 1.01 && $gamma < 2.2) }" || fail "a tour: gamma $gamma"
ok

# Space stops the ship at once. A replay of the recorded flight ends in the same state.
fly stereo --record "$folder/flight.jsonl"
flown() { "$rig/wait_flown.py" "$folder/flight.jsonl" "$1" || fail "stereo: the flight stands still"; }
xdotool keydown w
flown 2
xdotool keyup w
flown 0.2 # a frame without either key
xdotool key space
flown 0.5
xdotool key Escape
wait $exhibit || fail "stereo: exit $?"
ok
grep -q 'γ 1.000' "$folder/log" || fail "stereo: Space did not stop the ship"
ok
timeout 600 "$program" run --replay "$folder/flight.jsonl" >"$folder/replay-log" 2>&1 || fail "replay: exit $?"
ok
grep -q '^the same to the bit at 1 check$' "$folder/replay-log" || fail "replay: not the same"
ok
[ "$(grep γ "$folder/log")" = "$(grep γ "$folder/replay-log")" ] || fail "replay: it ended elsewhere"
ok
# Its movie has a frame for each tenth of its seconds, at a standstill in the end.
"$program" render --replay "$folder/flight.jsonl" --movie "$folder/flight.mp4" --fps 10 --size 64x48 --hud >"$folder/movie-log" 2>&1 \
    || fail "the movie of a flight: exit $?"
wanted=$(python3 -c 'import json, sys; print(sum(json.loads(line).get("dt_ns", 0) for line in open(sys.argv[1])) // 10**8)' "$folder/flight.jsonl")
counted=$(ffprobe -v error -count_frames -select_streams v:0 -show_entries stream=nb_read_frames -of csv=p=0 "$folder/flight.mp4")
[ "$counted" = "$wanted" ] && grep -q 'the same to the bit' "$folder/movie-log" || fail "the movie of a flight has $counted frames, not $wanted"
ok
"$program" render --replay "$folder/flight.jsonl" --movie "$folder/flight.avi" >"$folder/movie-log" 2>&1
[ $? = 2 ] && [ ! -e "$folder/flight.avi" ] && grep -q 'ends in .mp4 is right' "$folder/movie-log" || fail "a movie with another ending"
ok

# SIGTERM, SIGINT and SIGHUP end the flight as Esc does: the record and the log have their last lines.
for signal in TERM INT HUP; do
    rm -f "$folder/ended.jsonl" "$folder/ended.csv"
    fly desk --scene clocks --record "$folder/ended.jsonl" --log "$folder/ended.csv" --log-every 0.1
    xdotool key o
    "$rig/wait_flown.py" "$folder/ended.jsonl" 0.5 || fail "$signal: the flight stands still"
    kill -$signal "$(pgrep -P $exhibit -x starbow)"
    wait $exhibit
    status=$?
    [ $status = 0 ] || fail "$signal: exit $status"
    tail -n 1 "$folder/ended.jsonl" | grep -q '"last":true' || fail "$signal: the record has no last line"
    tail -c 1 "$folder/ended.csv" | od -c | grep -q '\\n' || fail "$signal: the log's last line is cut off"
    grep -q 'γ 1.000' "$folder/log" || fail "$signal: no closing line"
    ok
done

# A head tracker's packets move the window's view through a wall. When it falls silent, the picture goes back after a while.
cat >"$folder/tracked.json" <<'LAYOUT'
{
    "head_tracker": { "port": 42719 },
    "outputs": [
        {
            "name": "wall", "size": [400, 300],
            "viewports": [{ "projection": { "type": "wall", "lower_left_m": [-1, -0.75, -1], "lower_right_m": [1, -0.75, -1], "upper_left_m": [-1, 0.75, -1] } }]
        }
    ]
}
LAYOUT
send_head() { # CENTIMETRES to the right
    python3 - "$1" <<'SEND'
import socket, struct, sys
socket.socket(socket.AF_INET, socket.SOCK_DGRAM).sendto(struct.pack("<6d", float(sys.argv[1]), 0, 0, 0, 0, 0), ("127.0.0.1", 42719))
SEND
}
view() { import -window "$window" -crop 400x200+0+0 rgb:"$folder/$1"; }
echo '{ "exposure": { "automatic": false } }' >"$folder/even.json" # automatic exposure would take seconds to return
fly "$folder/tracked.json" --exhibit "$folder/even.json"
xdotool key h # hides the figures, which change by themselves
still() { view rest; sleep "$pace"; view again; cmp -s "$folder/rest" "$folder/again"; }
until_true 20 still || fail "tracked: the picture does not come to rest"
moved() { send_head 60; view right; ! cmp -s "$folder/rest" "$folder/right"; }
until_true 20 moved
returned() { view back; cmp -s "$folder/rest" "$folder/back"; }
until_true 20 returned
xdotool key Escape
wait $exhibit || fail "tracked: exit $?"
ok
cmp -s "$folder/rest" "$folder/right" && fail "tracked: the picture did not follow the head"
ok
cmp -s "$folder/rest" "$folder/back" || fail "tracked: the picture did not come back when the tracker fell silent"
ok

# Warm-up compiles every pipeline before the first frame, with the validation layers on. The trace names all passes.
timeout 600 "$program" run --layout desk --warm-up always --frames 5 --trace "$folder/trace.json" >"$folder/log" 2>&1 \
    || fail "warm-up: exit $?"
ok
grep -q 'pipelines are ready after' "$folder/log" || fail "warm-up: no line says that the pipelines are ready"
ok
for name in controls plan cull upload record wait present 'cube pass' warp stars HUD; do
    grep -q "\"$name\"" "$folder/trace.json" || fail "trace: no $name"
done
ok

# Without a display the program says so and renders stills; the first shot is enough here.
: >"$folder/log"
(unset DISPLAY; cd "$folder" && exec "$program" run >"$folder/log" 2>&1) &
started+=($!)
until_true 60 grep -q 'no display server' "$folder/log" || fail "the missing display is not reported"
kill $!
ok
# A layout can't run without a display: the program says so and draws nothing.
said=$(unset DISPLAY; cd "$folder" && "$program" run --layout desk 2>&1)
[ $? = 2 ] && [[ $said == *"no display server"*"starbow render"* ]] || fail "a layout without a display is not refused: $said"
ok
echo "$passed passed, 0 failed"
