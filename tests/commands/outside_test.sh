#!/usr/bin/env bash
# What happens outside the program ends no flight: files that are none, a reader that does not read, a disk without room, a
# home that may not be written, a clock that is set back. Each flight has a few small frames; none may take a minute.
# Usage: outside_test.sh PROGRAM FOLDER-OF-THE-RIG
set -u
program=$(realpath "$1") tools=$(realpath "$2") rig=$(dirname "$0")/../rig
. "$rig/monitors.sh"
serve Xvfb -noreset -screen 0 640x480x24
export STARBOW_CACHE=$folder/cache STATE_DIRECTORY=$folder/state
mkdir "$folder/cache" "$folder/state"
cat >"$folder/small.json" <<'END'
{ "outputs": [ { "name": "a", "size": [160, 120], "viewports": [{ "projection": { "type": "planar" } }] } ] }
END

# fly FRAMES [MORE...]: a flight of so many frames; the caller directs its messages.
fly() {
    local frames=$1
    shift
    timeout 600 "$program" run --layout "$folder/small.json" --scene chart --frames "$frames" "$@"
}
frames() { grep -c '"dt_ns"' "$1"; }

# Files that are none end the program with one line and exit 2, at once: the processor's time is bounded, which a busy machine
# does not change. A program that waits for a writer, or reads on and on, is ended and has not said its line.
none() { # WHAT ARGUMENTS...
    local what=$1 said used status
    shift
    TIMEFORMAT='%U %S'
    used=$({ time timeout 600 "$program" "$@" 2>"$folder/said" >/dev/null; } 2>&1; exit $?)
    status=$?
    said=$(<"$folder/said")
    [ $status = 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" = 1 ] && [[ $said == *"$what"*" is right"* || $said == *"$what"*"should be"* ]] || fail "$*: $said"
    awk -v used="$used" 'BEGIN { split(used, parts); exit !(parts[1] + parts[2] < 4) }' || fail "$*: took $used s of the processor"
    ok
}
"$program" render --shot chart-0.5 --size 64x64 --out "$folder/chart.png" >"$folder/log" 2>&1 || fail "no picture: exit $?" # makes shadows
fifo=$folder/fifo.json
mkfifo "$fifo"
truncate -s 30G "$folder/vast.data"
for warp in "fifo.json" "vast.data"; do
    sed 's/{ "type": "planar" } }/{ "type": "planar" }, "warp": { "file": "'$warp'" } }/' "$folder/small.json" >"$folder/warp-$warp.json"
done
for kind in exhibit layout scene shot tour replay; do
    none 'is a FIFO, not a file' run --$kind "$fifo"
done
none 'is a device, not a file' run --layout /dev/zero
none 'names no file' run --layout "$folder/warp-fifo.json.json"
none 'is larger than 512 MiB' run --layout "$folder/warp-vast.data.json" --scene chart
none 'is larger than 1 GiB' run --layout "$folder/warp-vast.data.json" --scene chart --record "$folder/vast.jsonl"
none 'is larger than 512 MiB' warp inspect "$folder/vast.data"
none 'is a FIFO, not a file' warp inspect "$fifo"
none 'is a FIFO, not a file' check "$fifo"
none 'is a FIFO, not a file' import sgct "$fifo" --out "$folder/imported.json"
none 'is a FIFO, not a file' devices --describe "$fifo"
for output in log record trace; do
    none 'is a FIFO, not a file' run --layout "$folder/small.json" --$output "$fifo"
done
none 'is not a folder' render --shot start --size 64x64 --out "$fifo"

# A full pipe that nobody reads, and closed streams, hold no frame.
mkfifo "$folder/pipe"
exec 7<>"$folder/pipe"
dd if=/dev/zero of="$folder/pipe" bs=4096 oflag=nonblock conv=notrunc 2>/dev/null
fly 40 --verbose --record "$folder/full.jsonl" 1>&7 2>&7 || fail "a full pipe: exit $?"
[ "$(frames "$folder/full.jsonl")" = 40 ] || fail "a full pipe: $(frames "$folder/full.jsonl") of 40 frames"
exec 7>&-
ok
fly 20 --verbose --record "$folder/closed.jsonl" --log "$folder/closed.csv" --log-every 0.02 0>&- 1>&- 2>&- || fail "closed streams: exit $?"
[ "$(frames "$folder/closed.jsonl")" = 20 ] || fail "closed streams: $(frames "$folder/closed.jsonl") of 20 frames"
grep -Eqv '^("dt_ns|\{|$)' "$folder/closed.jsonl" && fail "closed streams: messages are in the record"
[ "$(head -c 4 "$folder/closed.csv")" = "$(head -c 4 <(sed 1q "$folder/closed.csv"))" ] && grep -q exhibit: "$folder/closed.csv" && fail "closed streams: messages are in the log"
ok

# A disk without room, and a home that may not be written: the flight goes on, and each file's end is said once.
if [ "$(id -u)" = 0 ] && unshare -m true 2>/dev/null; then
    # The service manager, for which ends are counted, does not read either.
    python3 -c 'import socket, sys, time
manager = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
manager.bind(sys.argv[1])
time.sleep(300)' "$folder/manager" &
    started+=($!)
    until_true 10 test -S "$folder/manager" || fail "no service manager"
    cat >"$folder/inside" <<'END'
mkdir -p "$folder/disk"
mount -t tmpfs -o size=64k none "$folder/disk"
mkdir "$folder/disk/cache" "$folder/disk/state"
dd if=/dev/zero of="$folder/disk/rest" bs=4096 2>/dev/null
export STARBOW_CACHE=$folder/disk/cache STATE_DIRECTORY=$folder/disk/state NOTIFY_SOCKET=$folder/manager
timeout 600 "$program" run --layout "$folder/small.json" --scene chart --frames 30 --log "$folder/disk/a.csv" --log-every 0.02 --record "$folder/disk/a.jsonl" 2>"$folder/disk-log"
echo "full $?"
mount -o remount,ro "$folder/disk"
HOME=$folder/disk timeout 600 "$program" run --layout "$folder/small.json" --scene chart --frames 10 2>"$folder/read-only-log"
echo "read-only $?"
umount "$folder/disk"
END
    export folder program
    unshare -m bash "$folder/inside" >"$folder/inside-log" 2>&1
    grep -q '^full 0' "$folder/inside-log" || fail "a full disk: $(grep full "$folder/inside-log")"
    for line in 'a.csv: can.t be written (No space' 'a.jsonl: .*the record ends here' 'crashes are not counted'; do
        [ "$(grep -c "$line" "$folder/disk-log")" = 1 ] || fail "a full disk: '$line' is said $(grep -c "$line" "$folder/disk-log") times"
    done
    ok
    grep -q '^read-only 0' "$folder/inside-log" || fail "a read-only home: $(grep read-only "$folder/inside-log")"
    [ "$(grep -c 'crashes are not counted' "$folder/read-only-log")" = 1 ] || fail "a read-only home: no line, or more than one"
    ok
fi

# The clock is set back by a day in flight, and right again: no frame stalls or leaps.
LD_PRELOAD=$tools/libstarbow_clock.so fly 240 --record "$folder/clock.jsonl" --log "$folder/clock.csv" --log-every 0.1 2>"$folder/log" || fail "the clock: exit $?"
python3 - "$folder/clock.jsonl" "$folder/clock.csv" <<'CHECK' || fail "the clock set back a day changes the flight"
import csv, json, sys
steps = [json.loads(line) for line in open(sys.argv[1]) if '"dt_ns"' in line]
assert len(steps) == 240 and all(0 < s["dt_ns"] <= 1e8 and s.get("skipped_ns", 0) < 3e10 for s in steps)
column = list(csv.reader(open(sys.argv[2], newline="")))
days = {row[0][:10] for row in column[1:]}
assert len(days) == 2, days
CHECK
ok
echo "$passed passed, 0 failed"
