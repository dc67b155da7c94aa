#!/usr/bin/env bash
# Somebody presses all keys, mouse buttons and stick's buttons at random, tilts the stick and moves the throttle anyhow, and walks
# away with the throttle half open. The exhibit comes home by itself, and the next visitor finds all as the first one did.
# Usage: mash_test.sh PROGRAM RIG_FOLDER [SECONDS [SEED]]
set -u
program=$(realpath "$1") built=$(realpath "$2") seconds=${3:-15} rig=$(realpath "$(dirname "$0")/../rig")
RANDOM=${4:-1}
. "$rig/monitors.sh"
serve Xvfb -noreset -screen 0 800x600x24
export STARBOW_VALIDATION=1 XDG_CONFIG_HOME=$folder/own XDG_STATE_HOME=$folder/state
prepare_remote
mkdir "$folder/visits" "$folder/cwd"
cat >"$folder/exhibit.json" <<END
{ "layout": "./small.json", "scene": "avenue", "information": "visitor", "quality": "draft", "flying": { "max_gamma": 100, "paced": true },
  "visit": { "idle_s": 5, "ask_s": 5, "fade_s": 0.4, "unlock": "k7qz0x", "attract": ["first-minute", "rainbow"] },
  "remote": { "port": $port, "pins": "pins" } }
END

# The reports' bytes are described in sticks_test.sh.
stick() { # BUTTONS HAT X Y
    printf '%02x%02x0%x%02x%02x%02x%02x80%02x' $(($1 & 255)) $(($1 >> 8)) "$2" $(($3 & 255)) $(($3 >> 8)) $(($4 & 255)) $(($4 >> 8)) 255
    printf '00%.0s' $(seq 55)
}
throttle() { # LEVER, 0 is full
    printf '01'
    printf '0002%.0s' $(seq 7)
    printf '%02x%02x0f' $(($1 & 255)) $(($1 >> 8))
    printf '00%.0s' $(seq 46)
}
keys=(a b c d e f g h i j k l m n o p q r s t u v w x y z 0 1 2 3 4 5 6 7 8 9 F1 F2 F3 F4 F5 F6 F7 F8 F9 F10 F11 F12 Escape Tab
    Return space BackSpace Delete Insert Home End Page_Up Page_Down Up Down Left Right comma period minus plus slash bracketleft
    bracketright semicolon apostrophe grave equal shift+a ctrl+c ctrl+z alt+F4 super shift ctrl KP_Add KP_Subtract KP_5 Pause Print)
any() { echo "${keys[RANDOM % ${#keys[@]}]}"; }
# The script of the devices can't call this shell's functions.
cat >"$folder/home.sh" <<END
. "$rig/monitors.sh"
trap - EXIT
program="$program" port=$port
fail() { echo "\$*" >"$folder/trouble"; exit 1; }
# begins_anew FILE: a touch begins a visit; FILE receives the state, without the lines that differ from moment to moment
begins_anew() {
    xdotool windowfocus "\$(xdotool search --name '^Starbow a')"
    xdotool key j
    is visit flying 30
    ask status | grep -Ev '^(frame|uptime|quality|visit|caption|step)' >"\$1"
}
case \$1 in
first) until_true 120 ask status; is visit attract 60; begins_anew "$folder/first"; is visit asking 90 ;;
again) is visit attract 120; begins_anew "$folder/again"; ask restart ;;
esac
END
{
    echo "plug thrustmaster-t16000m 0"
    echo "plug thrustmaster-twcs-throttle 1"
    echo start
    echo "run bash $folder/home.sh first"
    echo "say the mashing begins"
    held=
    for ((i = 0; i < seconds * 4; i++)); do
        buttons=0
        [ $((RANDOM % 3)) = 0 ] && buttons=$((1 << RANDOM % 16))
        echo "report thrustmaster-t16000m $(stick $buttons $((RANDOM % 9 == 0 ? RANDOM % 8 : 15)) $((RANDOM % 16384)) $((RANDOM % 16384)))"
        [ $((RANDOM % 4)) = 0 ] && echo "report thrustmaster-twcs-throttle $(throttle $((RANDOM * 2)))"
        case $((RANDOM % 8)) in
        0) [ -z "$held" ] && held=${keys[RANDOM % 36]} && echo "run xdotool keydown $held" ;;
        1) [ -n "$held" ] && echo "run xdotool keyup $held" && held= ;;
        2) echo "run xdotool mousemove $((RANDOM % 320)) $((RANDOM % 240)) click $((1 + RANDOM % 5))" ;;
        *) echo "run xdotool key $(any) $(any)" ;;
        esac
        echo "wait 0.1"
    done
    [ -n "$held" ] && echo "run xdotool keyup $held"
    echo "report thrustmaster-t16000m $(stick 0 15 8192 8192)"
    echo "report thrustmaster-twcs-throttle $(throttle 32768)"
    echo "say the hands are off"
    echo "run bash $folder/home.sh again"
} >"$folder/hands"
(cd "$folder/cwd" && timeout $((seconds * 20 + 600)) umockdev-wrapper "$built/fake_sticks" "$rig/../hid" "$folder/hands" \
    "$program" run --exhibit "$folder/exhibit.json" --record "$folder/visits" >"$folder/log" 2>&1 </dev/null)
code=$?
[ -e "$folder/trouble" ] && fail "$(cat "$folder/trouble")"
[ $code = 0 ] || fail "exit $code (an error of the validation layers, or a crash)"
ok
grep -q validation "$folder/log" && fail "the validation layers report an error"
ok
[ -s "$folder/first" ] && cmp -s "$folder/first" "$folder/again" || fail "the next visitor finds another exhibit: $(diff "$folder/first" "$folder/again")"
ok
[ -z "$(ls -A "$folder/cwd")" ] || fail "hands wrote files: $(ls -A "$folder/cwd")"
ok
# What was pressed is in the records, and flies again the same to the bit.
touched=0
for record in "$folder/visits"/*.jsonl; do
    timeout 900 "$program" run --replay "$record" >"$folder/replay-log" 2>&1 || fail "the replay of $(basename "$record") exits with $?"
    grep -q 'the same to the bit' "$folder/replay-log" || fail "the replay differs: $(tail -n 1 "$folder/replay-log")"
    touched=$((touched + $(grep -c '"turn"\|"lever"' "$record")))
done
[ $touched -gt 20 ] || fail "the hands moved nothing: $touched frames"
ok
echo "  $(ls "$folder/visits" | wc -l) visits; $touched frames with the stick or the throttle; home as at the start"
echo "$passed passed, 0 failed"
