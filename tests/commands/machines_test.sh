#!/usr/bin/env bash
# One exhibit on several machines, here three programs on the loopback interface under Xvfb: they show what one program would,
# in step, also while a builder changes the layout; nodes and the master are killed and come back; a second master
# stands back; a node with another file is refused.
# It bears any load under which a frame takes at most a second.
# Usage: machines_test.sh PROGRAM FOLDER_OF_THE_RIG
set -u
program=$(realpath "$1") tools=$(realpath "$2") rig=$(dirname "$0")/../rig
. "$rig/monitors.sh"
serve Xvfb -noreset -screen 0 800x400x24
export STARBOW_VALIDATION=1
domain=$((20 + $$ % 170))
prepare_remote

output() { # NAME NODE X YAW
    printf '{ "name": "%s", "node": "%s", "size": [160, 120], "place": [%s, 0], "monitor": { "position": [0, 0] }, "viewports": [ { "projection": { "type": "planar", "fov_y_deg": 50, "turn_deg": { "yaw": %s } } } ] }' "$@"
}
wall='{ "name": "four", "node": "right", "size": [160, 120], "place": [480, 0], "monitor": { "position": [0, 0] }, "viewports": [ { "projection": { "type": "wall", "lower_left_m": [1, -0.5, -0.7], "lower_right_m": [1, -0.5, 0.7], "upper_left_m": [1, 0.5, -0.7] } } ] }'
# The head-up display, whose frame rate differs, is behind the walls.
tracker=$((port + 1))
printf '{ "hud": { "azimuth_deg": 180, "width_deg": 10 }, "head_tracker": { "port": %s }, "outputs": [ %s, %s, %s, %s ] }\n' $tracker "$(output one left 0 -90)" "$(output two left 160 -30)" "$(output three middle 320 30)" "$wall" >"$folder/walls.json"
printf '{ "layout": "walls.json", "scene": "avenue", "tutorial": false, "exposure": { "automatic": false }, "remote": { "port": %s, "pins": "../pins" }, "machines": { "master": "left", "interface": "lo", "domain": %s } }\n' $port $domain >"$folder/exhibit.json"
for machine in one left middle right; do # each has its own copy of the exhibit
    mkdir "$folder/$machine"
    cp "$folder/walls.json" "$folder/exhibit.json" "$folder/$machine/"
done

declare -A at
begin() { # NODE OPTIONS...
    local node=$1
    shift
    "$program" run --exhibit "$folder/$node/exhibit.json" --node "$node" --frame-log "$folder/$node.csv" "$@" >"$folder/$node.log" 2>&1 &
    at[$node]=$!
    started+=($!)
}
stop() { { kill -9 ${at[$1]}; wait ${at[$1]}; } 2>/dev/null; } # NODE
says() { grep -q "$2" "$folder/$1.log"; } # NODE TEXT
shot() { import -window root -crop 640x120+0+0 +repage "$folder/$1.png"; }
lit() { [ "$(import -window root -crop "160x120+$1+0" -format '%[fx:mean>0.01]' info:)" = 1 ]; }
dark() { ! lit "$1"; }
press() { # KEY: in the window of the output one, the master's
    xdotool windowfocus "$(xdotool search --name '^Starbow one' | head -n 1)" key "$1"
}
press_until() { # KEY MARK TEXT NODE: one press for each of the node's lines with MARK, until one has TEXT; frames may be slow
    local before i
    more() { [ "$(grep -c "$2" "$folder/$3.log")" -gt "$1" ]; }
    for i in {1..40}; do
        before=$(grep -c "$2" "$folder/$4.log")
        press "$1"
        until_true 10 more "$before" "$2" "$4" || fail "$1 does nothing"
        grep "$2" "$folder/$4.log" | tail -n 1 | grep -q "$3" && return
    done
    fail "$1 never leads to '$3'"
}
head_at() { # CENTIMETRES to the right, from now on; 0: the tracker ends
    [ -n "${sender-}" ] && kill $sender 2>/dev/null
    sender=
    [ "$1" = 0 ] && return
    python3 -c '
import socket, struct, sys, time
to = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
while True:
    to.sendto(struct.pack("<6d", float(sys.argv[1]), 0, 0, 0, 0, 0), ("127.0.0.1", int(sys.argv[2])))
    time.sleep(0.02)' "$1" $tracker &
    sender=$!
    started+=($sender)
}
frames() { wc -l <"$folder/$1.csv"; } # NODE
more_frames() { # NODE COUNT: a key that was pressed before is read, and a node that is out of step has been missed
    local least=$(($(frames $1) + $2))
    shown() { [ "$(frames $1)" -ge "$2" ]; }
    until_true 60 shown $1 $least || fail "$1 stands still"
}
rests() { # PICTURE WINDOW-X: the one program shows the same some frames later, and something in that window
    shot $1
    "$rig/wait_flown.py" "$folder/one.jsonl" 0.3 || return 1
    shot again
    same $1 again && lit $2
}
changes() { # PICTURE: the one program comes to rest with another picture than the first
    until_true 60 eval "shot $1; ! same one $1" && until_true 60 rests $1 320 && ! same one $1
}
same() { compare -metric AE "$folder/$1.png" "$folder/$2.png" null: >/dev/null 2>&1; }

# One program shows all outputs, without a network.
"$program" run --exhibit "$folder/one/exhibit.json" --quality fine --record "$folder/one.jsonl" >"$folder/one.log" 2>&1 &
one=$!
started+=($one)
until_true 60 rests one 320 || fail "one program: no picture that rests"
ask scene chart >/dev/null
is scene chart 60
changes chart || fail "one program: another world shows the same"
ask scene avenue >/dev/null
is scene avenue 60
back() { shot again && same one again; }
until_true 20 back || fail "one program: another picture after another world"
press F2
changes pattern || fail "one program: the pattern shows the same"
press_until F2 "test pattern" "test pattern: none" one
until_true 20 back || fail "one program: another picture after the patterns"
head_at 30
changes head || fail "the picture does not follow the head"
head_at 0
until_true 20 back || fail "one program: another picture after the head's moves"
sed -i 's/"yaw": 30 /"yaw": 31 /' "$folder/one/walls.json"
until_true 20 says one 'layout: .*applied' || fail "one program: the changed layout is not applied"
changes turned || fail "the changed layout shows the same"
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

# A test pattern, and a visitor's tracked head.
press F2
until_true 20 alike pattern || fail "three programs show another pattern than one"
says left '3 of 3 machines in step, at most one refresh apart; left' || fail "the builder is not told of the screens"
press_until F2 "test pattern" "test pattern: none" left
head_at 30
until_true 20 alike head || fail "three programs show something else than one to a head that moves"
head_at 0
until_true 20 alike || fail "after a pattern and a head's moves something else is shown"
ok

last_frame() { tail -n 1 "$folder/left.csv" | cut -d, -f2; }
edits_from=$(last_frame)
# A builder turns a number at the master: the node shows it at once. F5 keeps it in the files of all.
in_step() { [ "$(now error)" = - ]; }
press_until F3 "(Page Up, Page Down)" "three, yaw: 30" left
press shift+Page_Up
until_true 20 alike turned || fail "a turned number is not shown by the node: $(tail -n 3 "$folder/left.log")"
grep -q '"yaw": 30 ' "$folder/left/walls.json" || fail "the file has changed before F5"
press F5
kept() { for machine in left middle right; do grep -q '"yaw": 31 ' "$folder/$machine/walls.json" || return 1; done; }
until_true 20 kept || fail "F5 does not keep the number on all machines"
cmp -s "$folder/left/walls.json" "$folder/right/walls.json" || fail "the files of master and node differ after F5"
until_true 20 in_step || fail "after F5: $(now error)"
until_true 20 alike turned || fail "after F5 something else is shown"
ok
# A node that starts while a number is turned and not kept shows it as well.
press shift+Page_Down
until_true 20 alike || fail "the number is not turned back"
stop right
begin right --quality fine
again() { [ "$(grep -c "node 'right' is in step" "$folder/left.log")" -ge 3 ]; }
until_true 60 again || fail "right does not come back: $(cat "$folder/right.log")"
until_true 20 alike || fail "right does not show the turned number after its start"
press shift+Page_Up
until_true 20 alike turned || fail "the number is not turned again"
ok
# A builder edits the master's file: nodes whose file is another one go on, are named, and follow once they have it.
sed -i 's/"yaw": 31 /"yaw": 30 /' "$folder/left/walls.json"
until_true 20 says left "node 'middle' has a different walls.json" || fail "the master does not say whose file differs"
is error 'not in step: middle, right'
lit 320 || fail "middle does not go on with its last good layout"
for machine in middle right; do cp "$folder/left/walls.json" "$folder/$machine/walls.json"; done
until_true 20 in_step || fail "after the copies: $(now error)"
until_true 20 alike || fail "after the copies something else is shown"
ok

edits_to=$(last_frame)

# The instruments' page reaches the nodes: without it they would not be in step. A tour runs on all.
press o
more_frames left 20
until_true 20 in_step || fail "with instruments: $(now error)"
press o
more_frames left 20
until_true 20 in_step || fail "with other instruments: $(now error)"
ask tour first-minute >/dev/null
is tour first-minute 60
more_frames left 40
until_true 60 in_step || fail "in a tour: $(now error)"
ask scene avenue >/dev/null
is scene avenue 60
ask reset >/dev/null
until_true 60 alike || fail "after instruments and a tour something else is shown"
ok

# A node is killed: the others go on. It comes back, in step.
stop right
until_true 20 says left "node 'right' was silent for 6 frames" || fail "left does not miss right"
is error 'not in step: right'
[[ $(now machines) =~ ^'left '[0-9.]+' ms, middle '[0-9.]+' ms, right away'$ ]] || fail "the machines are: $(now machines)"
more_frames middle 2
ok
cp "$folder/right.csv" "$folder/right-first.csv"
joins=$(grep -c "node 'right' is in step" "$folder/left.log")
begin right --quality fine
joined() { [ "$(grep -c "node 'right' is in step" "$folder/left.log")" -gt "$joins" ]; }
until_true 60 joined || fail "right does not come back"
ok
until_true 20 alike || fail "after a restart something else is shown"
ok

# A second master hears the first one, says so, and stands back. Its windows cover the first one's; the nodes go on as before.
cp -r "$folder/left" "$folder/second"
sed -i "s/\"port\": $port/\"port\": $((port + 2))/" "$folder/second/exhibit.json"
"$program" run --exhibit "$folder/second/exhibit.json" --node left --scene chart --quality fine >"$folder/second.log" 2>&1 &
second=$!
started+=($second)
until_true 60 says second "another master of this exhibit, 'walls: left, middle, right', sends states; this one shows its own outputs alone" ||
    fail "a second master does not stand back: $(cat "$folder/second.log")"
until_true 20 says middle 'it comes from a second master of this exhibit' || fail "middle does not say that there is a second master"
more_frames middle 20
until_true 20 in_step || fail "with a second master: $(now error)"
kill -INT $second
wait $second || fail "the second master: exit $?"
until_true 20 alike || fail "after a second master something else is shown"
ok

# The master is killed: the others fade, and take up with its first state.
stop left
cp "$folder/left.csv" "$folder/left-first.csv"
until_true 10 dark 320 || fail "middle does not fade without a master"
until_true 10 dark 480 || fail "right does not fade without a master"
says middle 'no state from the master' || fail "middle does not say that the master is away"
ok
begin left --quality fine
until_true 60 lit 320 || fail "middle does not take up with the master's return"
until_true 60 lit 480 || fail "right does not take up with the master's return"
ok

# No frame was shown with two digests, but while the machines' files differed.
digests() {
    python3 - "$edits_from" "$edits_to" "$folder"/*.csv <<'COUNT'
import sys
first, last, seen = int(sys.argv[1]), int(sys.argv[2]), {}
for log in sys.argv[3:]:
    for line in open(log).read().split("\n")[1:-1]:
        parts = line.split(",")
        if len(parts) == 4 and not first <= int(parts[1]) <= last:
            seen.setdefault(int(parts[1]), set()).add(parts[2])
print(sum(len(digests) > 1 for digests in seen.values()) if len(seen) > 100 else "too few")
COUNT
}
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
sed 's/"yaw": -30/"yaw": -31/' "$folder/walls.json" >"$folder/other/walls.json"
cp "$folder/exhibit.json" "$folder/other/"
said=$(timeout 600 "$program" run --exhibit "$folder/other/exhibit.json" --node right --quality fine 2>&1)
[ $? = 2 ] || fail "a node with another layout is not refused: $said"
[[ $said == *"node 'right' has a different walls.json ("*") from the master 'left' ("*"); the same file on both is right"* ]] || fail "'$said' does not name the file"
ok
until_true 10 says left "node 'right' has a different walls.json" || fail "left does not say whom it refuses"
ok
refused() { # TEXT OPTIONS...
    local text=$1 said
    shift
    said=$(timeout 600 "$program" run "$@" 2>&1)
    [ $? = 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" = 1 ] && [[ $said == *"$text"* ]] || fail "'$text' is not the message: $said"
    ok
}
sed 's/"interface": "lo"/"interface": "10.0.0.0\/99"/' "$folder/exhibit.json" >"$folder/no-network.json"
said=$(timeout 600 "$program" check "$folder/no-network.json" --svg "$folder/none.svg" 2>&1)
[ $? = 2 ] && [[ $said == *'interface "10.0.0.0/99" is not a network; one such as "192.168.7.0/24" is right'* ]] && [ ! -e "$folder/none.svg" ] || fail "check of what is not a network: $said"
ok
# check reads an exhibit, and says who shows what on which network.
said=$("$program" check "$folder/exhibit.json" --svg "$folder/plan.svg") || fail "check: $said"
for line in 'exhibit exhibit: layout walls, world avenue, words en' 'machine left, the master: one, two' 'machine right: four' "exhibit's identity on the network: walls: left, middle, right" \
    "network: interface lo, 127.0.0.1 here, domain $domain" 'note: interface lo reaches no other machine'; do
    [[ $said == *"$line"* ]] || fail "check does not say '$line': $said"
done
ok
refused 'one of these is right: left, middle, right' --exhibit "$folder/exhibit.json" --node up
refused '"machines" in its file is right' --exhibit desk --node left
sed 's/"interface": "lo"/"interface": "none0"/' "$folder/exhibit.json" >"$folder/none.json"
sed 's/"master": "left"/"master": "up"/' "$folder/exhibit.json" >"$folder/up.json"
refused 'is not a node of the layout walls; one of these is right: left, middle, right' --exhibit "$folder/up.json" --node right
said=$(timeout 600 "$program" check "$folder/up.json" 2>&1)
[ $? = 2 ] && [[ $said == *'is not a node of the layout walls'* ]] || fail "check of a wrong master: $said"
"$program" check "$folder/none.json" --svg "$folder/plan.svg" | grep -q 'note: interface "none0" is none of this machine' || fail "check at a desk"
ok
kill -INT ${at[left]}
wait ${at[left]} || fail "left: exit $?"

# Graphics cards that let all screens change together are used, and the display says so; not where a screen can't.
export VK_LAYER_PATH=$tools VK_INSTANCE_LAYERS=VK_LAYER_STARBOW_faults STARBOW_VALIDATION=0
for machine in left middle right; do cp "$folder/walls.json" "$folder/$machine/"; done
for kind in all none; do
    for node in right middle left; do STARBOW_BARRIER=$kind begin $node --quality fine; done
    for node in middle right; do until_true 60 says left "node '$node' is in step" || fail "barrier $kind: $node does not join"; done
    until_true 60 in_step || fail "barrier $kind: $(now error)"
    press F2
    [ $kind = all ] && text='3 of 3 machines in step, in the same refresh (present barrier)' || text='at most one refresh apart'
    until_true 10 says left "$text" || fail "barrier $kind: the display does not say '$text'"
    for node in right middle left; do
        kill -INT ${at[$node]}
        wait ${at[$node]} || fail "barrier $kind: $node: exit $?"
        says $node 'fault: in the barrier' && took=all || took=none
        [ $took = $kind ] || fail "barrier $kind: $node takes part: $took"
    done
    ok
done

echo "$passed passed, 0 failed"
