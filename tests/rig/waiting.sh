# Shell tests source this file: they wait for what they need, and not for a time.

# until_true SECONDS COMMAND...: repeats the command until it succeeds or the time is over.
until_true() {
    local end=$((${EPOCHREALTIME/./} + $1 * 1000000))
    shift
    until "$@" >/dev/null 2>&1; do
        [ "${EPOCHREALTIME/./}" -lt "$end" ] || return 1
        sleep 0.05
    done
}
