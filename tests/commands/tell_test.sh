#!/usr/bin/env bash
# A docent leads a running exhibit with `starbow tell`: every kind of command, wrong ones, the record of it all and its replay.
# It bears any load under which a frame takes at most a second: tell waits for each command's picture.
# Usage: tell_test.sh PROGRAM
set -u
program=$(realpath "$1") rig=$(dirname "$0")/../rig
. "$rig/monitors.sh"
serve Xvfb -noreset -screen 0 800x600x24
export STARBOW_VALIDATION=1 XDG_STATE_HOME=$folder/state

prepare_remote
cat >"$folder/exhibit.json" <<END
{ "layout": "./small.json", "scene": "avenue", "quality": "draft", "textfile": "starbow.prom",
  "remote": { "port": $port, "pins": "pins" } }
END
timeout 300 "$program" run --exhibit "$folder/exhibit.json" --record "$folder/visit.jsonl" >"$folder/log" 2>&1 &
exhibit=$!
started+=($exhibit)

until_true 60 ask status || fail "the exhibit does not answer: $(ask status)"
applied() { # COMMAND [VALUE]: the exhibit must carry it out.
    local answer
    answer=$(ask "$@") || fail "$*: $answer"
    [[ $answer == applied:* ]] || fail "$*: $answer"
}
refused() { # TEXT COMMAND [VALUE]: one line with the text, and exit 2.
    local says=$1 answer
    shift
    answer=$(ask "$@") && fail "$*: is not refused: $answer"
    [ "$(wc -l <<<"$answer")" = 1 ] && [[ $answer == *"$says"* ]] || fail "$*: $answer"
}
brightest() { import -window root -format '%[fx:maxima]' info:; }
is_black() { [ "$(brightest)" = 0 ]; }

applied scene train && is scene train
applied doppler off && is doppler off
applied comparison galilean && is comparison galilean
applied false-colours on && is false-colours on
applied speed-limit 2.5 && is max-gamma 2.5
applied caption 'Grüße aus dem Zug' && is caption 'Grüße aus dem Zug'
applied hold on && is hold on
applied fade on
until_true 60 is_black || fail "faded, the screen's brightest point is $(brightest)"
applied fade off
ok
applied tour simultaneity && is tour simultaneity
applied language de && is language de
applied next && is step 2
applied pause on && is paused on
refused 'a tour shows its own effects' doppler on
applied back
applied shot gamma100 && is shot gamma100
refused 'no tour with steps is shown' next
refused 'There is no nowhere.json' scene nowhere
refused 'is not a name of a shipped file' scene ../../etc/passwd
is scene avenue
ok
applied pattern grid && is pattern grid
applied quality balanced && is quality balanced
applied layout stereo && is layout stereo
applied reset && is language en && is scene avenue && is quality draft && is pattern none && is caption - && is max-gamma 1000000
ok
# A docent may not do an engineer's work.
pin=271828
applied stop
refused '' layout desk
pin=111111
refused '' stop
pin=314159
ok
until_true 20 grep -q '^starbow_commands_total [1-9]' "$folder/starbow.prom" || fail "the counts are not in the textfile"
ok
until_true 60 grep -q '\["stop"\]' "$folder/visit.jsonl" || fail "the record does not reach the disk"
applied restart
wait $exhibit || fail "exit $? (an error of the validation layers, or a crash)"
grep -q validation "$folder/log" && fail "the validation layers report an error"
ok
grep -q '\["scene", *"train"\]' "$folder/visit.jsonl" || fail "the record lacks a command"
"$program" run --replay "$folder/visit.jsonl" >"$folder/replay-log" 2>&1 || fail "the replay exits with $?"
grep -q 'the same to the bit' "$folder/replay-log" || fail "the replay differs: $(tail -n 1 "$folder/replay-log")"
ok
"$program" render --replay "$folder/visit.jsonl" --out "$folder/pictures" >"$folder/render-log" 2>&1
[ $? = 2 ] && grep -q "has a remote's command, scene" "$folder/render-log" || fail "render --replay takes a record with commands"
ok
"$program" report --out "$folder/day.html" >"$folder/report-log" 2>&1 || fail "no report: $(cat "$folder/report-log")"
grep -q '<h2>Visits by the hour' "$folder/day.html" || fail "the day's page is not whole"
ok
echo "$passed passed, 0 failed"
