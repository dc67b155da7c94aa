#!/usr/bin/env bash
# Many visitors in a row, made of random numbers, with faults in between: the process is as large at the end as near the start.
# Usage: soak_test.sh PROGRAM RIG [VISITS [LOG]]
# With VISITS and LOG it is the long form: it goes on where an interrupted one ended.
set -u
program=$(realpath "$1") built=$(realpath "$2") visits=${3:-60} rig=$(dirname "$0")/../rig
. "$rig/monitors.sh"
serve Xvfb -noreset -screen 0 640x480x24
log=${4:-$folder/soak.csv}
# The device is lost now and then; a stick and a throttle are plugged in, unplugged and plugged in at another port; the wall
# clock is set back by a day every other second; the disk of the counts, of the layout and of the caches is full after each
# second layout, while both sticks are unplugged once.
export VK_LAYER_PATH=$built VK_INSTANCE_LAYERS=VK_LAYER_STARBOW_faults
export STARBOW_FAULTS=submit:500:DEVICE_LOST,submit:2500:DEVICE_LOST
export XDG_CONFIG_HOME=$folder/own STARBOW_CACHE=$folder/disk/cache folder
mkdir "$folder/disk"
cat >"$folder/visitor" <<END
#!/bin/sh
export LD_PRELOAD="\$LD_PRELOAD:$built/libstarbow_clock.so" TMPDIR=$folder/disk
exec "$program" "\$@"
END
chmod +x "$folder/visitor"
cat >"$folder/plugging" <<'END'
plug thrustmaster-t16000m 0
plug thrustmaster-twcs-throttle 1
start
wait 4
forever
unplug thrustmaster-twcs-throttle
wait 1
unplug thrustmaster-t16000m
wait 1
plug thrustmaster-twcs-throttle 5
plug thrustmaster-t16000m 0
wait 1
unplug thrustmaster-twcs-throttle
plug thrustmaster-twcs-throttle 1
wait 1
END
# on_a_full_disk COMMAND...
cat >"$folder/on_a_full_disk" <<'END'
mount -t tmpfs -o size=16m none "$folder/disk" || exit 3
more() { # COUNT TEXT: waits for so many more lines of the log
    local least=$(($(grep -c "$2" "$folder/err-log") + $1))
    while [ "$(grep -c "$2" "$folder/err-log")" -lt $least ]; do sleep 0.2; done
}
while more 2 ': applied'; do
    dd if=/dev/zero of="$folder/disk/rest" bs=4096 2>/dev/null
    echo full >>"$folder/filled"
    more 2 'is unplugged'
    rm "$folder/disk/rest"
done &
"$@"
code=$?
kill $!
exit $code
END
disk=()
# A disk of its own needs a namespace of mounts.
[ "$(id -u)" = 0 ] && unshare -m true 2>/dev/null && disk=(unshare -m bash "$folder/on_a_full_disk")
"${disk[@]}" umockdev-wrapper "$built/fake_sticks" "$rig/../hid" "$folder/plugging" "$folder/visitor" \
    soak --visits "$visits" --devices 2 --log "$log" >"$folder/out" 2>"$folder/err-log"
code=$?
tail -n 9 "$folder/out"
[ $code = 0 ] || fail "exit $code: $(tail -n 3 "$folder/err-log")"
ok
# Each tenth visit saves one. The first is there from the start, and the last may fall on the full disk.
[ "$(grep -c ': applied' "$folder/err-log")" -ge $((visits / 10 - 2)) ] || fail "layouts were not reloaded"
ok
grep -q 'is lost' "$folder/err-log" || fail "the device was never lost"
ok
[ "$(grep -c 'is unplugged' "$folder/err-log")" -ge $((visits / 10)) ] || fail "sticks were not plugged in"
ok
[ ${#disk[@]} = 0 ] || [ -s "$folder/filled" ] || fail "the disk was never full"
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
