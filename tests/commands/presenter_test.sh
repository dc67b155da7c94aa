#!/usr/bin/env bash
# The guide's window beside the visitors' one: real keys and clicks through the X server, the state by `starbow tell`, and the
# record of all of it flown again.
# Usage: presenter_test.sh PROGRAM FOLDER_OF_THE_RIG
set -u
program=$(realpath "$1") x_client=$(realpath "$2")/x_client rig=$(dirname "$0")/../rig
. "$rig/monitors.sh"
serve Xvfb -noreset -screen 0 1400x1100x24
export STARBOW_VALIDATION=1 XDG_STATE_HOME=$folder/state
prepare_remote
patience=20
cat >"$folder/exhibit.json" <<END
{ "layout": "./small.json", "scene": "avenue", "quality": "draft", "presenter": {}, "programme": "evening", "tutorial": false,
  "remote": { "port": $port, "pins": "pins" } }
END
sed 's/"presenter": {}/"presenter": { "monitr": {} }/' "$folder/exhibit.json" >"$folder/wrong.json"
said=$("$program" run --exhibit "$folder/wrong.json" 2>&1)
[ $? = 2 ] && [[ $said == *"/presenter"*monitr* ]] && [ "$(wc -l <<<"$said")" = 1 ] || fail "a wrong member: $said"
ok

timeout 600 "$program" run --exhibit "$folder/exhibit.json" --record "$folder/guided.jsonl" >"$folder/log" 2>&1 &
exhibit=$!
started+=($exhibit)
until_true 60 ask status || fail "the exhibit does not answer: $(ask status)"
window_of() { xdotool search --name "^Starbow $1\$" 2>/dev/null | head -n 1; }
has_windows() { [ -n "$(window_of guide)" ] && [ -n "$(window_of a)" ]; }
until_true 60 has_windows || fail "there is no window of the guide beside the visitors'"
guide=$(window_of guide) visitors=$(window_of a)
drawn() { [ "$(import -window "$guide" -format '%[fx:maxima>0.8&&mean>0.03]' info:)" = 1 ]; }
until_true 60 drawn || fail "the guide's window has no picture"
ok
at_guides() { xdotool windowfocus "$guide" key "$@"; }
at_visitors() { xdotool windowfocus "$visitors" key "$@"; }

# Keys in the guide's window are commands, and W does not steer there.
at_guides h && is hold on
at_guides w && is gamma 1
at_guides h && is hold off
at_guides b && is fade on
at_guides b && is fade off
at_guides d && is doppler off
at_guides Up Up && is exposure 1
ok
# In the visitors' window they are none. H, which hides and shows the display there, has come last.
at_visitors b w h h
hidden_and_shown() { [ "$(grep -o '"hud": *true' "$folder/guided.jsonl" | wc -l)" = 2 ]; }
until_true 60 hidden_and_shown || fail "the visitors' window has no keys"
is hold off && is fade off
ok
# Scenes, tours and their steps, a limit, a caption.
at_guides w 4 && is scene clocks 60
at_guides t 2 && is tour rainbow 60 && is step 1
at_guides Right && is step 2
at_guides Next && is step 3
at_guides Left && is step 2
at_guides p && is paused on
at_guides p && is paused off
at_guides g 2 && is max-gamma 2.2942
at_guides k && xdotool type 'Hi h' && xdotool key Return
is caption 'Hi h' && is hold off
# The programme's items.
at_guides period && is item 1 60 && is shot start
at_guides period && is item 2 && is tour first-minute 60
at_guides comma && is item 1 && is shot start 60
at_guides l 1 && is language de
at_guides l 2 && is language en
ok
# A button by the mouse: the fourth of the first row is H. The place follows the window's size.
click() { # OF 1280 x 800 pixels
    eval "$(xdotool getwindowgeometry --shell "$guide" | grep -E 'X|Y|WIDTH|HEIGHT')"
    xdotool mousemove $((X + $1 * WIDTH / 1280)) $((Y + $2 * HEIGHT / 800)) click 1
}
click 890 520 && is hold on
xdotool windowsize "$guide" 900 620
"$rig/wait_flown.py" "$folder/guided.jsonl" 0.5 || fail "the flight stands still" # a picture is due every tenth of a second
click 890 520 && is hold off
until_true 20 drawn || fail "no picture after a change of the size"
ok
# The mouse on the visitors' picture points at what is seen there; the record has the direction.
pointed() { click 190 130; grep -q '\["pointer","' "$folder/guided.jsonl"; }
until_true 20 pointed || fail "the mouse does not point"
is hold off
ok

# Hold takes the stick away gently: a ship that speeds up comes to coasting while W stays down, and W counts again afterwards.
at_guides r && is item 0
is gamma 1
# Keys that are down at a reset count only when they are pressed again.
was_reset() { grep -q '"reset"' "$folder/guided.jsonl"; }
until_true 20 was_reset && "$rig/wait_flown.py" "$folder/guided.jsonl" 0.5 || fail "R does not reset"
xdotool windowfocus "$visitors" keydown w
fast() { awk -v g="$(now gamma)" -v least="$1" 'BEGIN { exit !(g > least) }'; }
until_true 60 fast 1.05 || fail "W has no effect"
ask hold on >/dev/null
"$rig/wait_flown.py" "$folder/guided.jsonl" 4 || fail "the flight stands still"
held=$(now gamma)
"$rig/wait_flown.py" "$folder/guided.jsonl" 2 || fail "the flight stands still"
awk -v a="$held" -v b="$(now gamma)" 'BEGIN { exit !(b / a < 1.002 && a / b < 1.002) }' || fail "held at gamma $held, it is $(now gamma)"
ask hold off >/dev/null
until_true 60 fast "$(awk -v g="$held" 'BEGIN { print 1 + 1.1 * (g - 1) }')" || fail "after the hold W has no effect: gamma $(now gamma)"
xdotool keyup w
ok

# The window is closed: the exhibit goes on.
"$x_client" close "$guide"
gone() { [ -z "$(window_of guide)" ]; }
until_true 20 gone || fail "the guide's window does not close"
"$rig/wait_flown.py" "$folder/guided.jsonl" 1 || fail "the flight stands still without the guide's window"
kill -0 $exhibit || fail "the exhibit has ended with the guide's window"
ok
[ "$(ask restart)" = "applied: restart" ] || fail "restart"
wait $exhibit || fail "exit $? (an error of the validation layers, or a crash)"
grep -q validation "$folder/log" && fail "the validation layers report an error"
ok
for command in '"hold","on"' '"tour","rainbow"' '"next"' '"back"' '"scene","clocks"' '"exposure","1"' '"caption","Hi h"' '"item","2"'; do
    grep -q "\[$command\]" "$folder/guided.jsonl" || fail "the record lacks $command"
done
ok
unset STARBOW_VALIDATION
timeout 600 "$program" run --replay "$folder/guided.jsonl" >"$folder/replay-log" 2>&1 || fail "the replay exits with $?"
grep -q 'the same to the bit' "$folder/replay-log" || fail "the replay differs: $(tail -n 1 "$folder/replay-log")"
ok
echo "$passed passed, 0 failed"
