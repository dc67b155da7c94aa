# Shell tests source this file: it starts X servers without hardware, and ends every process it started with the test.

. "$(dirname "${BASH_SOURCE[0]}")/waiting.sh"
folder=$(mktemp -d)
started=()
finish() {
    for process in "${started[@]}"; do kill "$process" 2>/dev/null; done
    for process in "${started[@]}"; do wait "$process" 2>/dev/null; done
    rm -rf "$folder"
}
trap finish EXIT

passed=0
ok() { passed=$((passed + 1)); }
fail() {
    echo "FAILED: $*"
    for log in "$folder"/*log; do [ -s "$log" ] && echo "--- $(basename "$log")" && tail -n 30 "$log"; done
    exit 1
}

serve() { # COMMAND...: starts an X server that chooses its own number, and sets DISPLAY.
    : >"$folder/number"
    "$@" -displayfd 9 9>"$folder/number" >"$folder/server-log" 2>&1 &
    started+=($!)
    until_true 20 test -s "$folder/number" || fail "no X server starts ($1; Xorg must run as root)"
    DISPLAY=:$(cat "$folder/number")
    export DISPLAY
}

# start_monitors COUNT WIDTHxHEIGHT: starts Xorg with the monitors DUMMY0, DUMMY1, ... from left to right.
start_monitors() {
    serve Xorg -noreset -nolisten tcp -novtswitch -sharevts -config "$rig/xorg.conf" -logfile "$folder/xorg-log"
    xrandr --output DUMMY0 --mode "$2" --pos 0x0 --primary || fail "xrandr"
    local i
    for ((i = 1; i < $1; i++)); do
        xrandr --addmode DUMMY$i "$2" && xrandr --output DUMMY$i --mode "$2" --right-of DUMMY$((i - 1)) || fail "xrandr DUMMY$i"
    done
    xrandr -q >/dev/null # without this query the server hides all but one monitor
}

# prepare_remote: sets $port, and writes the PINs of a docent and an engineer, and the layout of one small window.
prepare_remote() {
    port=$((20000 + RANDOM % 20000))
    printf 'docent 271828\nengineer 314159\n' >"$folder/pins"
    chmod 640 "$folder/pins"
    cat >"$folder/small.json" <<'END'
{ "outputs": [{ "name": "a", "size": [320, 240], "viewports": [{ "projection": { "type": "planar" } }] }] }
END
}

# ask COMMAND [VALUE]: what the running exhibit ($program, $port) answers its engineer, or the role of another $pin.
pin=314159
ask() { "$program" tell --port "$port" --pin "$pin" "$@" 2>&1; }
now() { ask status | sed -n "s/^$1: //p"; } # NAME: its value in the exhibit's state
patience=10
is() { # NAME VALUE [SECONDS]: waits until the state has the value, by default for $patience seconds
    until_true "${3:-$patience}" eval "[ \"\$(now $1)\" = '$2' ]" || fail "$1 is $(now "$1"), not $2"
}
