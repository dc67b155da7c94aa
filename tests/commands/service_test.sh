#!/usr/bin/env bash
# The exhibit under a service manager: signs of life, waits without an end, crashes, and careful starts. It bears any load under
# which a frame of two small windows takes less than three seconds: the exhibit's own limit is 4 s before the watchdog's. The
# manager is rig/service_manager.py.
# Usage: service_test.sh PROGRAM FOLDER-OF-THE-RIG
set -u
program=$1 tools=$2 rig=$(dirname "$0")/../rig
. "$rig/monitors.sh"
export VK_LAYER_PATH=$tools VK_INSTANCE_LAYERS=VK_LAYER_STARBOW_faults
serve Xvfb -noreset -screen 0 1280x800x24

cat >"$folder/two.json" <<'END2'
{ "outputs": [
    { "name": "a", "size": [160, 120], "place": [0, 0], "viewports": [{ "projection": { "type": "planar" } }] },
    { "name": "b", "size": [160, 120], "place": [200, 0], "viewports": [{ "projection": { "type": "planar" } }] }
] }
END2
sed 's/"place": \[0, 0\]/"monitor": { "connector": "NOWHERE" }/; s/"place": \[200, 0\]/"monitor": { "connector": "NOWHERE" }/' \
    "$folder/two.json" >"$folder/nowhere.json"

# manage NAME [OPTIONS OF THE MANAGER...] [-- OPTIONS OF THE PROGRAM...]: one supervised exhibit with a state folder of its own;
# its events are in NAME-events-log, its own lines in NAME-log.
manage() {
    local name=$1 options=()
    shift
    while [ $# -gt 0 ] && [ "$1" != -- ]; do options+=("$1") && shift; done
    [ $# -gt 0 ] && shift
    mkdir -p "$folder/$name"
    STATE_DIRECTORY=$folder/$name timeout 120 "$rig/service_manager.py" "${options[@]}" "$folder/$name-socket" \
        "$program" run --layout "$folder/${layout:-two}.json" --scene "${scene:-chart}" --warm-up never "$@" >"$folder/$name-events-log" 2>"$folder/$name-log"
}
# says NAME TEXT / logs NAME TEXT: an event, or the program's own line, must have the text.
says() { grep -q -- "$2" "$folder/$1-events-log" || fail "$1: no event has '$2'"; }
logs() { grep -q -- "$2" "$folder/$1-log" || fail "$1: the log does not say '$2'"; }
at() { awk -v text="$2" 'index($0, text) { print $1; exit }' "$folder/$1-events-log"; } # the time of the first event with TEXT

# A good day. READY=1 comes after loading; signs of life follow; SIGTERM ends the flight in order.
manage good --until 'STATUS=Shows 2 of 2 outputs.'
says good 'EXTEND_TIMEOUT_USEC=' && says good 'STATUS=Loads the world chart.json.' && says good 'STOPPING=1' && says good 'end 0'
awk '/EXTEND_TIMEOUT_USEC/ && !ready { extended = 1 } /READY=1/ { ready = extended } /WATCHDOG=1/ { ticks += ready } END { exit !(ticks >= 2) }' \
    "$folder/good-events-log" || fail "good: READY=1 after loading, then WATCHDOG=1 twice, in this order"
[ -e "$folder/good/ends" ] && fail "good: an end in order is counted"
ok

# Everything that follows runs at once: most of it waits.
(manage abstract --abstract --until 'STATUS=Shows 2 of 2 outputs.') &
(layout=nowhere manage monitors --watchdog 3 --until 'STATUS=Waits for a monitor.') &
(STARBOW_FAULTS=fence:20:HANG manage fence --watchdog 20 -- --record "$folder/fence.jsonl") &
(STARBOW_FAULTS=fence:20:BLOCK manage fence-blocks --watchdog 20) &
(STARBOW_FAULTS=present:20:BLOCK manage present --watchdog 20) &
(STARBOW_FAULTS=present:1:BLOCK manage first --watchdog 8) &
(STARBOW_FAULTS=acquire:21:HANG,acquire:22:HANG manage acquire --watchdog 20) &
for case in $(jobs -p); do [ "$case" = "${started[0]}" ] || wait "$case"; done

says abstract 'READY=1' && says abstract 'end 0' && ok
# Without a monitor the exhibit is not ready, and lives.
grep -q 'READY=1\|silent' "$folder/monitors-events-log" && fail "monitors: READY=1 without a picture, or a silence"
says monitors 'WATCHDOG=1' && says monitors 'EXTEND_TIMEOUT_USEC=10000000' && says monitors 'end 0' && ok

# hangs NAME WAIT: the program must end with 4 by itself, before the manager's watchdog, and name the wait.
hangs() {
    says "$1" 'end 4' && logs "$1" "error hang: .*$2.* has not come for ${3:-16\.[0-4]} s; the program ends with 4"
    grep -q silent "$folder/$1-events-log" && fail "$1: the watchdog was faster"
    ok
}
hangs fence 'the end of the frame.s drawing'
hangs fence-blocks 'the end of the frame.s drawing'
hangs present 'vkQueuePresentKHR'
hangs first 'vkQueuePresentKHR' '25\.[6-9]' # four times 6.4 s, and as late as the others may be: drivers compile shaders in the first frame
hangs acquire 'vkAcquireNextImageKHR'
grep -q 'READY=1' "$folder/first-events-log" && fail "first: READY=1 before the first picture was presented"
for name in fence present; do # the limit is 16 s after the last frame; the last sign of life may come .8 s after it
    awk '/WATCHDOG=1/ { alive = $1 } / end / { exit !($1 - alive >= 15.2) }' "$folder/$name-events-log" \
        || fail "$name: ended earlier than 16 s after the last frame"
done
[ "$(tail -n 1 "$folder/fence.jsonl" | tail -c 2)" = '}' ] && [ "$(wc -l <"$folder/fence.jsonl")" -ge 10 ] \
    || fail "fence: the record of the last frames is not whole"
ok

# A crash leaves a trace, the last 20 are kept, and the next start is counted.
mkdir -p "$folder/crash/crash"
for i in $(seq 100 130); do : >"$folder/crash/crash/1000000$i-1.txt"; done
for i in 1 2 3; do : >"$folder/crash/crash/900000000$i-1.txt"; done # before the clock was set back
(manage crash --runs 2 --until 'STATUS=never') &
manager=$!
flying() { sed -n "/start $1/,\$p" "$folder/crash-events-log" | grep -q READY=1; }
process() { sed -n "s/.* start $1 //p" "$folder/crash-events-log"; }
until_true 60 flying 1 || fail "crash: no picture"
kill -SEGV "$(process 1)" || fail "crash: no process"
until_true 60 flying 2 || fail "crash: not started anew"
grep -q running "$folder/crash/ends" && [ "$(wc -l <"$folder/crash/ends")" = 2 ] || fail "crash: the end is not counted"
kill "$(process 2)"
wait $manager
says crash 'end -11' && says crash 'end 0'
trace=$(ls "$folder"/crash/crash/*.txt | tail -n 1)
[ "$(ls "$folder/crash/crash" | wc -l)" = 20 ] || fail "crash: $(ls "$folder/crash/crash" | wc -l) traces are kept"
for text in 'ended by SIGSEGV at Unix time' 'sent by process' '_ZN7starbow11fly_exhibitE' 'r-xp'; do
    grep -q "$text" "$trace" || fail "crash: the trace lacks '$text': $(head -n 20 "$trace")"
done
ok

# After five disorderly ends within ten minutes the exhibit starts with care, and an end in order makes that forgotten.
mkdir -p "$folder/care"
now=$(date +%s)
printf '%s\n' $((now - 700)) $((now - 590)) $((now - 50)) $((now - 40)) $((now - 30)) running >"$folder/care/ends"
scene=train manage care --until 'STATUS=Shows 2 of 2 outputs, in safe mode after repeated crashes.'
logs care 'warn exhibit: it has crashed or hung 5 times within 10 minutes; it starts in safe mode'
says care 'STATUS=Loads the world chart.json.' && says care 'end 0'
[ -e "$folder/care/ends" ] && fail "care: an end in order does not forget the others"
ok
echo "$passed passed, 0 failed"
