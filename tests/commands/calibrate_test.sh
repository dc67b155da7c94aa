#!/usr/bin/env bash
# Calibrates a simulated stick as a person does. The profile must be right, and the program must use it afterwards.
# Usage: calibrate_test.sh PROGRAM RIG_FOLDER
set -u
starbow=$1 rig=$2
hid=$(dirname "${BASH_SOURCE[0]}")/../hid
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME=$folder/config
failed=0 passed=0
written=$folder/config/starbow/profiles/044f-b10a.json

fail() {
    failed=$((failed + 1))
    echo "FAILED: $*"
}

check() { # WHAT TEXT: $said must contain TEXT
    if [[ $said == *"$2"* ]]; then
        passed=$((passed + 1))
    else
        fail "$1: '$2' is missing in: $said"
    fi
}

# stick X Y TWIST SLIDER [BUTTONS]: prints one report of the T.16000M. Its 64 bytes are buttons, a released hat, X and Y with 14
# bits, twist and slider with 8, then zeros.
stick() {
    printf 'report thrustmaster-t16000m %02x000f%02x%02x%02x%02x%02x%02x%0110d\n' "${5:-0}" $(($1 & 255)) $(($1 >> 8)) \
        $(($2 & 255)) $(($2 >> 8)) "$3" "$4" 0
}

play() { # STATUS SCRIPT ARGUMENTS...: runs the program with a script, and puts its output into $said
    local expected=$1 script=$2 file=$folder/script$BASHPID status
    shift 2
    printf '%s\n' "$script" > "$file"
    said=$(timeout 600 umockdev-wrapper "$rig/fake_sticks" "$hid" "$file" "$starbow" "$@" 2>&1)
    status=$?
    [ $status = "$expected" ] || fail "$*: exit $status, not $expected: $said"
}

says() { # TEXT: waits until the program prints it
    echo "until $1"
}
enter() {
    echo "type $*"
}

# The middle of X trembles by 20 around 8000, not around 8192. The slider stays where it is put. Y reaches from 300 to 16000.
tremble() { # TENTHS_OF_A_SECOND SLIDER
    for ((i = 0; i < $1; ++i)); do
        stick 7980 8200 128 "$2"
        stick 8020 8200 128 "$2"
        echo wait 0.08
    done
}
press() { # BUTTONS
    stick 8000 8200 128 1 "$1"
    echo "wait 0.1"
    stick 8000 8200 128 1 0
}

middle_and_ends() { # of X alone
    says 'The middle.'
    stick 8100 8200 128 255
    enter
    says 'The ends.'
    for x in 50 16300 8100; do
        stick $x 8200 128 255
        echo "wait 0.04"
    done
    enter
}
quick() { # ANSWER: of two devices, the stick is the first in the list, which is in the ports' order
    echo "plug thrustmaster-twcs-throttle 1"
    echo "plug thrustmaster-t16000m 0"
    echo "start typed"
    says 'Which of them?'
    enter 1
    middle_and_ends
    says 'A name'
    enter
    says 'is there already'
    enter "$1"
}
by_serial() {
    echo "plug thrustmaster-t16000m 0"
    echo "start typed"
    middle_and_ends
    says 'A name'
    enter Mine
    says 'serial number A/12?'
    enter y
}

# An existing file is replaced only after a yes. The next tests run at the same time:
echo 'mine' > "$folder/there.json"
(
    failed=0
    play 2 "$(quick '')" calibrate --quick --out "$folder/there.json"
    check 'the chosen device' 'Calibrating Thrustmaster T.16000M flight stick (044f:b10a)'
    check 'the existing file is kept' 'is there already and was kept'
    check 'axes that were not moved' 'Not moved to any ends, so left as they were: Y axis, twist (Rz), slider.'
    [ "$(cat "$folder/there.json")" = mine ] || fail 'the file was changed without a yes'

    # A stick that reports its serial number may have a profile of its own, which goes before its model's.
    export XDG_CONFIG_HOME=$folder/serial
    mkdir "$folder/hid"
    sed 's/"vid"/"serial": "A\/12", "vid"/' "$hid/thrustmaster-t16000m.json" > "$folder/hid/thrustmaster-t16000m.json"
    hid=$folder/hid
    play 0 "$(by_serial)" calibrate --quick
    check 'a profile by serial number' "Written to $folder/serial/starbow/profiles/044f-b10a-A_12.json."
    play 0 $'plug thrustmaster-t16000m 0\nstart' devices
    check 'the profile that devices lists' 'profile: Mine'
    exit $failed
) &
beside=$!

session=$(
    echo "plug thrustmaster-t16000m 0"
    echo "start typed"
    says 'The middle.'
    stick 8000 8200 128 255
    enter
    says 'Hands off'
    echo "wait 0.3"
    stick 15000 8200 128 255 # a hand on the stick: the step repeats
    echo "wait 0.1"
    stick 8000 8200 128 255
    says 'Moved meanwhile: X axis.'
    tremble 8 255
    says 'The ends.'
    for ends in '100 8200 128 255' '16200 8200 128 255' '8000 300 128 255' '8000 16000 128 255' '8000 8200 10 255' \
        '8000 8200 250 255' '8000 8200 128 0' '8000 8200 128 255' '8000 8200 128 40'; do
        stick $ends
        echo "wait 0.04"
    done
    enter
    tremble 5 40
    # Nose up by X to its low end; to the right by Y to its high end; roll by the twist to its low end; full by the slider's 0.
    says 'Nose up'
    stick 120 8300 128 40
    enter
    says 'Nose to the right'
    stick 8000 15900 12 40 # moving two axes at once is refused
    enter
    says 'Several moved'
    says 'Nose to the right'
    stick 8010 15900 128 40
    enter
    says 'Roll'
    stick 8000 8200 12 40
    enter
    says 'Throttle'
    stick 8000 8200 128 255
    enter
    says 'full'
    stick 8000 8200 128 1
    enter
    # Full stop is button 4; home stays; "ten seconds back" is removed; next mode is button 2.
    says 'Full stop'
    press 8
    enter
    says 'Back to the start'
    enter
    says 'Ten seconds back'
    enter none
    says 'Next way'
    press 2
    enter
    says 'A name'
    enter Left stick
)
play 0 "$session" calibrate
check 'the first step' 'The middle.'
check 'two axes at once' 'Several moved: Y axis and twist (Rz).'
check 'the last line' "Written to $written."
[[ $said == *'counts before it'* ]] && fail "another profile goes before it: $said"
python3 - "$written" << 'END' || fail "the written profile is wrong: $(cat "$written")"
import json, sys
profile = json.load(open(sys.argv[1]))
axes = {axis["usage"]: axis for axis in profile["axes"]}
assert (profile["name"], profile["vendor"], profile["product"]) == ("Left stick", "044f", "b10a")
assert "serial" not in profile
assert {usage: axis["role"] for usage, axis in axes.items()} == {48: "nose-up", 49: "nose-right", 53: "roll-right", 54: "throttle"}
assert {usage for usage, axis in axes.items() if axis.get("inverted")} == {48, 53, 54}
low, middle, high = axes[48]["range"]
assert (low, high) == (100, 16200) and 7980 <= middle <= 8020
assert axes[49]["range"] == [300, 8200, 16000]
assert axes[53]["range"] == [10, 128, 250]
assert axes[54]["range"] == [0, 127.5, 255]
# Axes without noise get the least dead zone. X trembles by up to 40 of 7880; one and a half times that is 0.0076, still below.
assert [axes[usage].get("dead_zone", 0.06) for usage in (48, 49, 53, 54)] == [0.03, 0.03, 0.03, 0.02]
buttons = {button["role"]: button["button"] for button in profile["buttons"]}
# The shipped profile had home on 2, now next mode, and doppler on 4, now full stop.
assert buttons == {"stop": 4, "next-mode": 2, "headlight": 5, "aberration": 6, "hud": 7}
assert profile["hat"] == {"x": "look-right", "y": "look-up"}
END
[ -z "$(find "$folder/config" -name '*.part')" ] || fail 'a temporary file is left'

play 0 $'plug thrustmaster-t16000m 0\nstart' devices
check 'the profile in use afterwards' 'profile: Left stick'

# A calibration that is broken off leaves the file unchanged.
before=$(cat "$written")
alone=$'plug thrustmaster-t16000m 0\nstart typed\nuntil The middle.'
play 2 "$alone"$'\ntype' calibrate --device 044f:b10a
check 'the end of the input' 'stopped early; nothing was written'
play 2 "$alone"$'\ninterrupt' calibrate --device 1
check 'Ctrl-C' 'stopped early; nothing was written'
play 2 "$alone"$'\nunplug thrustmaster-t16000m\nwait 0.3' calibrate
check 'a device unplugged meanwhile' 'unplugged; nothing was written'
play 2 'start typed' calibrate
check 'no stick' 'No stick, throttle, pad or space mouse that this user can read is plugged in'
play 2 $'plug thrustmaster-t16000m 0\nstart typed' calibrate --device 1234:5678
check 'another device' '1234:5678 is not plugged in'
[ "$(cat "$written")" = "$before" ] || fail 'the file was changed'

# Quick calibration with two devices plugged in: roles stay, and axes that were not moved keep their range.
play 0 "$(quick y)" calibrate --quick
python3 - "$written" << 'END' || fail "the profile of the quick calibration is wrong: $(cat "$written")"
import json, sys
axes = {axis["usage"]: axis for axis in json.load(open(sys.argv[1]))["axes"]}
assert axes[48]["role"] == "nose-up" and axes[48]["inverted"] and axes[48]["range"] == [50, 8100, 16300]
assert axes[49]["range"] == [300, 8200, 16000] and axes[54]["range"] == [0, 127.5, 255]
END

wait $beside || failed=$((failed + 1))
echo "calibrate_test: $passed checks passed, $failed failed"
[ $failed = 0 ]
