#!/usr/bin/env bash
# One exhibit on several machines, here three programs on the loopback interface under Xvfb: they show what one program would,
# in step; nodes and the master are killed and come back; a node with another file is refused.
# It bears any load under which a frame takes at most a second.
# Usage: machines_test.sh PROGRAM FOLDER_OF_THE_RIG
set -u
program=$(realpath "$1") rig=$(dirname "$0")/../rig
. "$rig/monitors.sh"
serve Xvfb -noreset -screen 0 800x400x24
export STARBOW_VALIDATION=1
domain=$((20 + $$ % 170))
prepare_remote

output() { # NAME NODE X YAW
    printf '{ "name": "%s", "node": "%s", "size": [160, 120], "place": [%s, 0], "monitor": { "position": [0, 0] }, "viewports": [ { "projection": { "type": "planar", "fov_y_deg": 50, "turn_deg": { "yaw": %s } } } ] }' "$@"
}
# The head-up display, whose frame rate differs, is behind the walls.
printf '{ "hud": { "azimuth_deg": 180, "width_deg": 10 }, "outputs": [ %s, %s, %s, %s ] }\n' "$(output one left 0 -90)" "$(output two left 160 -30)" "$(output three middle 320 30)" "$(output four right 480 90)" >"$folder/walls.json"
printf '{ "layout": "walls.json", "scene": "avenue", "tutorial": false, "exposure": { "automatic": false }, "remote": { "port": %s, "pins": "pins" }, "machines": { "master": "left", "interface": "lo", "domain": %s } }\n' $port $domain >"$folder/exhibit.json"

declare -A at
begin() { # NODE OPTIONS...
    local node=$1
    shift
    "$program" run --exhibit "$folder/exhibit.json" --node "$node" --frame-log "$folder/$node.csv" "$@" >"$folder/$node.log" 2>&1 &
    at[$node]=$!
    started+=($!)
}
stop() { { kill -9 ${at[$1]}; wait ${at[$1]}; } 2>/dev/null; } # NODE
says() { grep -q "$2" "$folder/$1.log"; } # NODE TEXT
shot() { import -window root -crop 640x120+0+0 +repage "$folder/$1.png"; }
lit() { [ "$(import -window root -crop "160x120+$1+0" -format '%[fx:mean>0.01]' info:)" = 1 ]; }
dark() { ! lit "$1"; }
same() { compare -metric AE "$folder/$1.png" "$folder/$2.png" null: >/dev/null 2>&1; }

# One program shows all outputs, without a network.
"$program" run --exhibit "$folder/exhibit.json" --quality fine >"$folder/one.log" 2>&1 &
one=$!
started+=($one)
until_true 60 lit 320 || fail "one program: no picture"
sleep 2
shot one
ask scene chart >/dev/null
is scene chart 60
sleep 3
shot chart
kill -INT $one
wait $one || fail "one program: exit $?"
ok

# Three programs show the same, bit for bit.
begin right --quality fine
begin middle --quality fine
begin left --quality fine
for node in middle right; do until_true 60 says left "node '$node' is in step" || fail "$node does not join: $(cat "$folder/left.log" "$folder/$node.log")"; done
ok
until_true 60 lit 480 || fail "right: no picture"
alike() { shot three && same "${1:-one}" three; }
until_true 20 alike || fail "three programs show something else than one: $(compare -metric AE "$folder/one.png" "$folder/three.png" null: 2>&1) pixels differ"
ok

# Another world, and back.
ask scene chart >/dev/null
until_true 60 alike chart || fail "three programs show something else than one in another world"
ask scene avenue >/dev/null
until_true 60 alike || fail "three programs show something else than one, back in the first world"
ok

# A node is killed: the others go on. It comes back, in step.
frames() { wc -l <"$folder/$1.csv"; }
stop right
until_true 20 says left "node 'right' was silent for 6 frames" || fail "left does not miss right"
is error 'not in step: right'
before=$(frames middle)
sleep 1
[ "$(frames middle)" -gt "$before" ] || fail "middle stands still without right"
ok
cp "$folder/right.csv" "$folder/right-first.csv"
begin right --quality fine
joined() { [ "$(grep -c "node 'right' is in step" "$folder/left.log")" = 2 ]; }
until_true 60 joined || fail "right does not come back"
ok
until_true 20 alike || fail "after a restart something else is shown"
ok

# The master is killed: the others fade, and take up with its first state.
stop left
until_true 10 dark 320 || fail "middle does not fade without a master"
until_true 10 dark 480 || fail "right does not fade without a master"
says middle 'no state from the master' || fail "middle does not say that the master is away"
ok
begin left --quality fine
until_true 60 lit 320 || fail "middle does not take up with the master's return"
until_true 60 lit 480 || fail "right does not take up with the master's return"
ok

# No frame was shown with two digests.
digests() { cat "$folder"/*.csv | grep -v frame | cut -d, -f2,3 | sort -u | cut -d, -f1 | uniq -d | wc -l; }
[ "$(digests)" = 0 ] || fail "$(digests) frames were shown with two digests"
ok

# They end in order, without a word of the validation layers.
for node in right middle left; do
    kill -INT ${at[$node]}
    wait ${at[$node]} || fail "$node: exit $?: $(cat "$folder/$node.log")"
    says "$node" validation && fail "$node: the validation layers report an error"
done
ok

# A node with another file is refused, with the file's name; and what is no node, with one sentence.
begin left --quality fine
until_true 60 lit 0 || fail "left: no picture"
mkdir "$folder/other"
sed 's/"yaw": 90/"yaw": 91/' "$folder/walls.json" >"$folder/other/walls.json"
cp "$folder/exhibit.json" "$folder/other/"
said=$(timeout 60 "$program" run --exhibit "$folder/other/exhibit.json" --node right --quality fine 2>&1)
[ $? = 2 ] || fail "a node with another layout is not refused: $said"
[[ $said == *"node 'right' has another walls.json ("*") than the master 'left' ("*"); the same file on both is right"* ]] || fail "'$said' does not name the file"
ok
until_true 10 says left "node 'right' has another walls.json" || fail "left does not say whom it refuses"
ok
refused() { # TEXT OPTIONS...
    local text=$1 said
    shift
    said=$(timeout 60 "$program" run "$@" 2>&1)
    [ $? = 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" = 1 ] && [[ $said == *"$text"* ]] || fail "'$text' is not the message: $said"
    ok
}
refused 'one of these is right: left, middle, right' --exhibit "$folder/exhibit.json" --node up
refused '"machines" in its file is right' --exhibit desk --node left
sed 's/"interface": "lo"/"interface": "none0"/' "$folder/exhibit.json" >"$folder/none.json"
refused 'interface "none0" is none of this machine; one of these is right: lo (127.0.0.1)' --exhibit "$folder/none.json" --node right
sed 's/"master": "left"/"master": "up"/' "$folder/exhibit.json" >"$folder/up.json"
refused 'is no node of the layout walls; one of these is right: left, middle, right' --exhibit "$folder/up.json" --node right
kill -INT ${at[left]}
wait ${at[left]} || fail "left: exit $?"

echo "$passed passed, 0 failed"
