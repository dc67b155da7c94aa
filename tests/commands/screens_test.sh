#!/usr/bin/env bash
# The exhibit on four monitors without hardware. Each output shows its picture on the monitor that it names, even when monitors
# are unplugged or moved, windows minimised, or the layout edited. Needs root, as Xorg does.
# It bears any load under which a frame takes at most a second: it waits for
# pictures and lines of the log.
# Usage: screens_test.sh PROGRAM FOLDER-OF-THE-RIG
set -u
program=$1 tools=$2 rig=$(dirname "$0")/../rig
. "$rig/monitors.sh"
export STARBOW_VALIDATION=1
start_monitors 4 320x240
"$tools/set_edid" DUMMY2 'STARBOW WALL' W-0042 || fail "set_edid"

# The layout below names its monitors by the lines that `displays` prints for layouts.
"$program" displays >"$folder/displays-log" 2>&1 || fail "displays: exit $?"
grep -q '^monitor DUMMY3: 320 x 240 at \[960, 0\], 60.00 Hz' "$folder/displays-log" || fail "displays: DUMMY3"
ok
by_connector=$(grep -A1 '^monitor DUMMY0' "$folder/displays-log" | tail -n 1)
by_edid=$(grep 'STARBOW WALL.*W-0042' "$folder/displays-log" | tail -n 1)
[[ $by_edid == *'"serial": "W-0042"'* ]] || fail "displays: no line with the EDID's serial number"
ok

# Four pictures with different angles of view.
layout() { # ANGLE-OF-B
    local view='"viewports": [{ "projection": { "type": "planar", "fov_y_deg":'
    cat <<END
{ "outputs": [
    { "name": "a", "size": [320, 240], $by_connector, "whole_monitor": true, $view 30 } }] },
    { "name": "b", "size": [320, 240], "monitor": { "connector": "DUMMY1" }, "whole_monitor": true, $view $1 } }] },
    { "name": "c", "size": [320, 240], $by_edid, "whole_monitor": true, $view 90 } }] },
    { "name": "d", "size": [240, 180], "monitor": { "position": [960, 0] }, "place": [40, 30], $view 120 } }] }
] }
END
}
layout 50 >"$folder/wall.json"
layout 70 | sed 's/\[40, 30\]/[80, 60]/' >"$folder/changed.json"
echo '{ "exposure": { "automatic": false } }' >"$folder/exhibit.json" # the stills have a fixed exposure too
mkdir "$folder/small"
"$program" render --layout "$folder/wall.json" --shot start --out "$folder" >/dev/null || fail "render"
"$program" render --layout "$folder/wall.json" --shot start --out "$folder/small" --size 240x180 >/dev/null || fail "render"
"$program" render --layout "$folder/changed.json" --shot start --out "$folder/changed" >/dev/null || fail "render"

# psnr AREA PICTURE: prints the PSNR between a part of the desktop and a picture, in dB.
psnr() {
    import -window root -crop "$1" +repage "$folder/area.png" && compare -metric PSNR "$folder/area.png" "$2" null: 2>&1
}
# shows AREA PICTURE: true if the desktop shows the picture there. A window and a finer still agree to over 20 dB; pictures with
# different angles agree to at most 16 dB.
shows() {
    local alike
    alike=$(psnr "$1" "$2") && [ -n "$alike" ] || alike=$(psnr "$1" "$2")
    awk "BEGIN { exit !($alike > ${bound:-18}) }"
}
dark() { # AREA
    [ "$(import -window root -crop "$1" +repage png:- | identify -format '%[fx:maxima]' -)" = 0 ]
}
lit() { # AREA
    [ "$(import -window root -crop "$1" +repage png:- | identify -format '%[fx:maxima > 0.1]' -)" = 1 ]
}
a=320x240+0+0 b=320x240+320+0 c=320x240+640+0 d=240x180+1000+30
expect() { # WHAT AREA PICTURE
    until_true 60 shows "$2" "$3" || fail "$1: $2 does not show $(basename "$3"): $(psnr "$2" "$3") dB"
    ok
}
expect_all() { # WHAT
    expect "$1" $a "$folder/a.png"
    expect "$1" $b "$folder/b.png"
    expect "$1" $c "$folder/c.png"
    expect "$1" $d "$folder/d.png"
}
expect_dark() { # WHAT AREA
    until_true 60 dark "$2" || fail "$1: $2 is not dark"
    ok
}
expect_log() { # TEXT: the program's log must have it
    until_true 60 grep -q -- "$1" "$folder/log" || fail "not in the log: $1"
    ok
}

fly() {
    timeout 600 "$program" run --exhibit "$folder/exhibit.json" --layout "$folder/wall.json" >"$folder/log" 2>&1 &
    exhibit=$!
    started+=($exhibit)
    until_true 60 xdotool search --name '^Starbow a' || fail "no window"
    local window
    window=$(xdotool search --name '^Starbow a')
    until_true 60 lit $a || fail "no first picture" # keys count from then on
    xdotool windowfocus "$window"
    xdotool key h # hides the head-up display
}
leave() {
    xdotool windowfocus "$(xdotool search --name '^Starbow a')"
    xdotool key Escape
    wait $exhibit || fail "exit $?"
    grep -q validation "$folder/log" && fail "the validation layers report an error"
    ok
}

echo "without a window manager"
fly
expect_all "at the start"
expect_dark "beside a window with a place" 40x240+960+0

began=${EPOCHREALTIME/./}
xrandr --output DUMMY1 --off
expect_log "output 'b' is not shown: the monitor with connector \"DUMMY1\" is plugged in nowhere"
echo "an unplugged monitor's window was closed within $(((${EPOCHREALTIME/./} - began) / 1000)) ms, xrandr's own time included"
expect_dark "unplugged" $b
expect "unplugged" $a "$folder/a.png"
expect "unplugged" $c "$folder/c.png"
expect "unplugged" $d "$folder/d.png"
began=${EPOCHREALTIME/./}
xrandr --output DUMMY1 --mode 320x240 --pos 320x0
expect_log "output 'b' is shown again"
echo "plugged in again, it had its window within $(((${EPOCHREALTIME/./} - began) / 1000)) ms"
expect_all "plugged in again"

for i in 0 1 2 3; do xrandr --output DUMMY$i --off; done
expect_log "output 'c' is not shown"
expect_log "output 'd' is not shown"
kill -0 $exhibit 2>/dev/null || fail "the exhibit ended without a monitor"
plug=()
for i in 2 0 3 1; do plug+=(--output DUMMY$i --mode 320x240 --pos $((320 * i))x0); done
xrandr "${plug[@]}"
expect_all "all were unplugged"

xrandr --output DUMMY0 --mode 240x180
expect "another mode" 240x180+0+0 "$folder/small/a.png"
xrandr --output DUMMY0 --mode 320x240
xrandr --output DUMMY0 --pos 320x0 --output DUMMY1 --pos 0x0
expect "moved" $b "$folder/a.png"
expect "moved" $a "$folder/b.png"
xrandr --output DUMMY0 --pos 0x0 --output DUMMY1 --pos 320x0
expect_all "moved back"

# The layout is edited: first wrongly, then correctly.
sed 's/"fov_y_deg": *50/"fov_y_deg": 500/' "$folder/wall.json" >"$folder/edit.json"
mv "$folder/edit.json" "$folder/wall.json"
expect_log '/outputs/1/viewports/0/projection/fov_y_deg: 500'
expect_log 'the exhibit stays as it was'
expect_all "a wrong edit"
began=${EPOCHREALTIME/./}
cp "$folder/changed.json" "$folder/wall.json"
expect_log 'wall.json: applied'
took=$(((${EPOCHREALTIME/./} - began) / 1000))
expect "a right edit" $b "$folder/changed/b.png"
expect "a right edit" $a "$folder/a.png"
expect "a right edit" 240x180+1040+60 "$folder/d.png"
expect_dark "a right edit" 320x60+960+0
# A second is promised, and half of one more for a test's machine. A busy one shows by the time of another program, which reads
# the same layout and draws it.
began=${EPOCHREALTIME/./}
"$program" check "$folder/wall.json" --svg "$folder/plan.svg" >"$folder/check-log" 2>&1 || fail "check: exit $?"
read_alone=$(((${EPOCHREALTIME/./} - began) / 1000))
echo "an edit was taken up after $took ms, and is read alone in $read_alone ms"
[ $took -lt $((1500 + 3 * read_alone)) ] || fail "an edit was taken up after $took ms, and is read alone in $read_alone ms"
ok
leave
grep -q 'outputs handed over together within' "$folder/log" || fail "the skew is not reported"
ok

echo "with a window manager"
layout 50 >"$folder/wall.json"
xrandr --output DUMMY3 --off
openbox >"$folder/openbox-log" 2>&1 &
manager=$!
started+=($manager)
until_true 10 sh -c "xprop -root _NET_SUPPORTING_WM_CHECK | grep -q 0x" || fail "openbox does not start"
fly
expect_log "output 'd' is not shown: the monitor with position \[960, 0\]"
xrandr --output DUMMY3 --mode 320x240 --pos 960x0
expect_all "with openbox"

xrandr --output DUMMY1 --off
expect_dark "unplugged with openbox" $b
expect "unplugged with openbox" $a "$folder/a.png"
xrandr --output DUMMY1 --mode 320x240 --pos 320x0
expect_all "plugged in again with openbox"

xdotool search --name '^Starbow d' windowmove 100 100
expect_all "moved by hand"
xdotool search --name '^Starbow c' windowminimize
expect_dark "minimised" $c
expect "minimised" $b "$folder/b.png"
for window in a b d; do xdotool search --name "^Starbow $window" windowminimize; done
expect_dark "all minimised" 1280x240+0+0
for window in a b c d; do xdotool search --name "^Starbow $window" windowmap; done
expect_all "no longer minimised"
leave

# F11 fills the monitor that shows the window, and gives the window back.
geometry() { # X,Y WIDTHxHEIGHT
    xdotool getwindowgeometry "$window" | tr '\n' ' ' | grep -q "Position: $1 .*Geometry: $2"
}
f11() { # WHAT
    placed() { geometry '\(64[0-9]\|6[5-9][0-9]\|7[0-9][0-9]\),[0-9]*' "$size"; }
    local size
    size=$(xdotool getwindowgeometry "$window" | sed -n 's/.*Geometry: //p')
    xdotool windowmove "$window" 650 20
    until_true 60 placed || fail "$1: the window does not move: $(xdotool getwindowgeometry "$window")"
    xdotool key F11
    until_true 60 geometry 640,0 320x240 || fail "$1: F11 leads elsewhere: $(xdotool getwindowgeometry "$window")"
    ok
    xdotool key F11
    until_true 60 placed || fail "$1: F11 does not lead back: $(xdotool getwindowgeometry "$window")"
    ok
}

# A window with a frame changes its size faster than pictures are drawn.
timeout 600 "$program" run --layout desk --trace "$folder/trace.json" >"$folder/log" 2>&1 &
exhibit=$!
started+=($exhibit)
until_true 60 xdotool search --name '^Starbow desk' || fail "no window"
window=$(xdotool search --name '^Starbow desk')
pictured() { # true if the window has a picture
    [ "$(import -window "$window" png:- | identify -format '%[fx:maxima > 0.1]' -)" = 1 ]
}
until_true 60 pictured || fail "no first picture"
for i in $(seq 60); do xdotool windowsize "$window" $((100 + i * 37 % 500)) $((60 + i * 23 % 150)); done
xdotool windowsize "$window" 1 1 windowsize "$window" 300 200
until_true 60 sh -c "xdotool getwindowgeometry $window | grep -q 300x200" || fail "resized: $(xdotool getwindowgeometry "$window")"
xdotool windowfocus "$window"
f11 "with openbox"
xdotool windowminimize "$window"
steps() { grep -o '"controls"' "$folder/trace.json" | wc -l; } # of the frame loop, with or without a picture
least=$(($(steps) + 15))
stepped() { [ "$(steps)" -ge $least ]; }
until_true 60 stepped || fail "minimised: the frame loop stands still"
xdotool windowmap "$window"
until_true 60 pictured || fail "no picture after the window was minimised"
xdotool windowfocus "$window"
xdotool key Escape
wait $exhibit || fail "resized: exit $?"
grep -q validation "$folder/log" && fail "resized: the validation layers report an error"
ok
# While the window is minimised nothing is drawn, and no frame's times count again. A picture was seen before it and after it.
drawn=$(grep -o '"cube pass"' "$folder/trace.json" | wc -l) presented=$(grep -o '"present"' "$folder/trace.json" | wc -l)
[ "$drawn" -ge 2 ] && [ "$drawn" -le "$presented" ] || fail "the device's times of $drawn frames, and $presented were presented"
ok

# Where the driver does not wait for the screen, the exhibit paces its frames: 150 at 50 Hz take 3 s. Its period is a hundredth
# shorter. The first frames take longer, but a frame's step in the flight is at most 0.1 s.
xrandr --output DUMMY0 --mode 240x180
cat >"$folder/one.json" <<'END'
{ "outputs": [{ "name": "a", "monitor": { "connector": "DUMMY0" }, "size": [40, 30], "viewports": [{ "projection": { "type": "planar" } }] }] }
END
STARBOW_VALIDATION=0 timeout 300 "$program" run --layout "$folder/one.json" --frames 150 >"$folder/log" 2>&1 || fail "paced: exit $?"
flown=$(sed -n 's/.*ship \([0-9.]*\) s.*/\1/p' "$folder/log")
awk "BEGIN { exit !($flown >= 2.8) }" || fail "paced: 150 frames in $flown s"
ok
echo "150 frames at 50 Hz took $flown s"

# A window manager that was killed must not keep the next exhibit from starting.
kill -9 $manager
wait $manager 2>/dev/null
xprop -root _NET_SUPPORTING_WM_CHECK | grep -q 0x || fail "the killed window manager left no property behind, so that nothing is tested"
timeout 300 "$program" run --layout "$folder/wall.json" --frames 3 >"$folder/log" 2>&1 || fail "after a killed window manager: exit $?"
ok

# Without a window manager the program alone decides where a window goes.
xrandr --output DUMMY0 --mode 320x240
timeout 300 "$program" run --layout desk >"$folder/log" 2>&1 &
exhibit=$!
started+=($exhibit)
until_true 60 xdotool search --name '^Starbow desk' || fail "no window"
window=$(xdotool search --name '^Starbow desk')
xdotool windowsize "$window" 300 200
until_true 60 sh -c "xdotool getwindowgeometry $window | grep -q 300x200" || fail "F11: $(xdotool getwindowgeometry "$window")"
xdotool windowfocus "$window"
f11 "without a window manager"
xdotool key Escape
wait $exhibit || fail "F11: exit $?"
ok

# For an X server without RandR, the monitor that GLFW reports is enough.
serve Xvfb -noreset -screen 0 800x500x24 -extension RANDR
"$program" displays >"$folder/displays-log" 2>&1 || fail "displays without RandR: exit $?"
grep -q '^monitor .*: 800 x 500 at \[0, 0\]' "$folder/displays-log" || fail "displays without RandR"
ok
echo "$passed passed, 0 failed"
