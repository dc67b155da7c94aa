#!/usr/bin/env bash
# An exhibit that nobody attends to: tours while nobody is there, a visit from the first touch on, the question, and everything as
# at the start. Keys go through the X server, the state comes from `starbow tell`. A frame counts a tenth of a second at most, so that
# the five seconds of an idle visitor last longer on a busy machine.
# Usage: visit_test.sh PROGRAM
set -u
program=$(realpath "$1") rig=$(dirname "$0")/../rig
. "$rig/monitors.sh"
serve Xvfb -noreset -screen 0 800x600x24
export STARBOW_VALIDATION=1 XDG_STATE_HOME=$folder/state
prepare_remote
patience=20
mkdir "$folder/visits"
tour() { # NAME Z: of some seconds, from that place
    echo "{ \"scene\": \"avenue\", \"steps\": [{ \"seconds\": 2, \"caption\": { \"en\": \"$1\" }, \"cut\": { \"position\": [0, 0, $2], \"look\": [0, 0, -1] } }] }" >"$folder/$1.json"
}
tour one 0
tour two -20
cat >"$folder/exhibit.json" <<END
{ "layout": "./small.json", "scene": "avenue", "quality": "draft", "textfile": "starbow.prom",
  "visit": { "idle_s": 5, "ask_s": 5, "fade_s": 0.4, "unlock": "red5", "attract": ["./one.json", "./two.json"] },
  "remote": { "port": $port, "pins": "pins" } }
END
sed 's/two.json/never.json/' "$folder/exhibit.json" >"$folder/wrong.json"
"$program" run --exhibit "$folder/wrong.json" >"$folder/wrong-log" 2>&1
[ $? = 2 ] && [ "$(wc -l <"$folder/wrong-log")" = 1 ] && grep -q 'never.json' "$folder/wrong-log" || fail "an attraction that is not there: $(cat "$folder/wrong-log")"
"$program" run --exhibit "$folder/exhibit.json" --record "$folder/one.jsonl" >"$folder/wrong-log" 2>&1
[ $? = 2 ] && grep -q 'a folder is right' "$folder/wrong-log" || fail "a record in one file: $(cat "$folder/wrong-log")"
ok
timeout 300 "$program" run --exhibit "$folder/exhibit.json" --record "$folder/visits" >"$folder/log" 2>&1 &
exhibit=$!
started+=($exhibit)
until_true 60 ask status || fail "the exhibit does not answer: $(ask status)"
press() {
    xdotool windowfocus "$(xdotool search --name '^Starbow a')" 2>/dev/null
    xdotool key "$@"
}
flown() { # SECONDS: the present visit goes on for so long, by the exhibit's time
    "$rig/wait_flown.py" "$(ls "$folder/visits"/*.jsonl | tail -n 1)" "$1" || fail "the visit stands still"
}
above_1() { awk -v gamma="$(now gamma)" 'BEGIN { exit !(gamma > 1.0001) }'; }

# Nobody is there: the tours follow each other.
is visit attract && is tour one && is tour two 60 && is tour one 60
[ -z "$(ls "$folder/visits")" ] || fail "something is recorded while nobody is there"
ok
# Any key begins a visit, one without a role too.
press j
is visit flying && is tour - && is gamma 1
until_true 5 ls "$folder/visits"/*.jsonl || fail "the visit is not recorded"
ok
# Builder's keys and the way out are locked; the visitor's own are not.
press F2; press Escape; press 3; press m
is headlight off && is pattern none
xdotool keydown w
until_true 10 above_1 || fail "W has no effect"
flown 2
xdotool keyup w
# Home from anywhere within five seconds of the visitor, which are more of a busy machine: a late frame counts a tenth of one.
press r
until_true 20 eval '[ "$(now gamma)" = 1 ]' || fail "R does not lead home: gamma $(now gamma)"
kill -0 $exhibit || fail "Escape ends the exhibit"
ok
xdotool type red5
press F2
is pattern grid
ok
# Nobody touches: the question, a touch, the question, the end; then all is as at the start.
is visit asking 120
press h
is visit flying
is visit asking 120
is visit attract 120
is tour one && is pattern none
press j
is visit flying && is gamma 1 && is headlight on && is language en
ok
# A docent's world is a visit of its own, and a hold is no idle time.
[ "$(ask scene clocks)" = "applied: scene clocks" ] && is scene clocks
ask hold on >/dev/null
flown 6
is visit flying
ask hold off >/dev/null
is visit asking 120 && is visit attract 120 && is scene avenue
ok
until_true 60 grep -q '^starbow_visits_total 2' "$folder/starbow.prom" || fail "visits: $(grep '^starbow_visits' "$folder/starbow.prom")"
ok
[ "$(ask restart)" = "applied: restart" ] || fail "restart"
wait $exhibit || fail "exit $? (an error of the validation layers, or a crash)"
grep -q validation "$folder/log" && fail "the validation layers report an error"
ok
# Each visit's record flies again.
[ "$(ls "$folder/visits" | wc -l)" = 2 ] || fail "two visits have these records: $(ls "$folder/visits")"
first=$(ls "$folder/visits"/*.jsonl | head -n 1)
"$program" run --replay "$first" >"$folder/replay-log" 2>&1 || fail "the replay exits with $?"
grep -q 'the same to the bit' "$folder/replay-log" || fail "the replay differs: $(tail -n 1 "$folder/replay-log")"
ok
# After many disorderly ends it starts with care: in a plain world, without the tours, and still by itself.
mkdir "$folder/care"
seconds=$(date +%s)
printf '%s\n' $((seconds - 50)) $((seconds - 45)) $((seconds - 40)) $((seconds - 35)) $((seconds - 30)) running >"$folder/care/ends"
STATE_DIRECTORY=$folder/care timeout 120 "$rig/service_manager.py" --watchdog 60 --until never "$folder/socket" \
    "$program" run --exhibit "$folder/exhibit.json" --warm-up never >"$folder/events-log" 2>"$folder/care-log" &
started+=($!)
until_true 60 ask status || fail "with care: the exhibit does not answer: $(ask status)"
is scene chart && is visit attract && is tour -
press j
is visit flying
ok
echo "$passed passed, 0 failed"
