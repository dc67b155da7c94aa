#!/usr/bin/env bash
# Many visitors in a row, made of random numbers, with faults in between: the process is as large at the end as near the start.
# Usage: soak_test.sh PROGRAM RIG [VISITS [LOG]]
# With VISITS and LOG it is the long form: it goes on where an interrupted one ended.
set -u
program=$(realpath "$1") built=$(realpath "$2") visits=${3:-40} rig=$(dirname "$0")/../rig
. "$rig/monitors.sh"
serve Xvfb -noreset -screen 0 640x480x24
log=${4:-$folder/soak.csv}
# The device is lost now and then.
export VK_LAYER_PATH=$built VK_INSTANCE_LAYERS=VK_LAYER_STARBOW_faults
export STARBOW_FAULTS=submit:500:DEVICE_LOST,submit:2500:DEVICE_LOST
export XDG_CACHE_HOME=$folder/cache XDG_STATE_HOME=$folder/state
"$program" soak --visits "$visits" --log "$log" >"$folder/out" 2>"$folder/err-log"
code=$?
tail -n 9 "$folder/out"
[ $code = 0 ] || fail "exit $code: $(tail -n 3 "$folder/err-log")"
ok
[ "$(grep -c ': applied' "$folder/err-log")" -ge $((visits / 10 - 1)) ] || fail "layouts were not reloaded"
ok
grep -q 'is lost' "$folder/err-log" || fail "the device was never lost"
ok
[ "$(grep -c '^[0-9]' "$log")" -ge $((visits / 20)) ] || fail "samples are missing"
ok
# Wrong input writes nothing, and one use alone leaves the process as it was.
"$program" soak --as tour --tour nothing --log "$folder/never.csv" 2>"$folder/refused"
code=$?
[ $code = 2 ] && [ "$(wc -l <"$folder/refused")" = 1 ] && [ ! -e "$folder/never.csv" ] || fail "an unknown tour: exit $code, $(cat "$folder/refused")"
ok
unset VK_INSTANCE_LAYERS STARBOW_FAULTS
"$program" soak --as reloads --visits 20 --log "$folder/reloads.csv" >"$folder/out" 2>"$folder/err-log" || fail "reloads: exit $?: $(cat "$folder/out")"
[ "$(grep -c ': applied' "$folder/err-log")" = 19 ] || fail "not each visit after the first one has its layout reloaded"
ok
"$program" soak --as flight --visits 40 --log "$folder/reloads.csv" >"$folder/out" 2>"$folder/refused"
code=$?
[ $code = 2 ] && grep -q 'reloads.csv:1: ' "$folder/refused" || fail "another use's table: exit $code, $(cat "$folder/refused")"
ok
echo "$passed passed, 0 failed"
