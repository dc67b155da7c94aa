#!/usr/bin/env bash
# A network that comes late: an exhibit whose remote, OSC, head tracker and other machines are at an address that comes
# later, or at ports that another program has, shows its pictures, says what it waits for, and takes it up. It runs in a network
# namespace of its own, so it needs root or user namespaces. It bears any load under which a frame takes at most a second.
# Usage: network_test.sh PROGRAM
set -u
if [ "${2-}" != inside ]; then
    [ "$(id -u)" = 0 ] && exec unshare --net "$0" "$(realpath "$1")" inside
    exec unshare --net --map-root-user "$0" "$(realpath "$1")" inside
fi
program=$1 rig=$(dirname "$0")/../rig
. "$rig/monitors.sh"
ip link set lo up
ip link add show0 type veth peer name show1 || fail "no interface can be made"
ip link set show0 up && ip link set show1 up
serve Xvfb -noreset -screen 0 800x400x24
export STARBOW_VALIDATION=1 XDG_STATE_HOME=$folder/state
prepare_remote
osc=$((port + 1)) tracker=$((port + 2)) domain=$((20 + $$ % 170))
output() { # NAME NODE X
    printf '{ "name": "%s", "node": "%s", "size": [160, 120], "place": [%s, 0], "monitor": { "position": [0, 0] }, "viewports": [ { "projection": { "type": "wall", "lower_left_m": [-1, -0.75, -2], "lower_right_m": [1, -0.75, -2], "upper_left_m": [-1, 0.75, -2] } } ] }' "$@"
}
printf '{ "head_tracker": { "port": %s, "address": "192.168.77.20" }, "outputs": [ %s, %s ] }\n' $tracker "$(output a front 0)" "$(output b left 160)" >"$folder/walls.json"
printf '{ "layout": "walls.json", "scene": "avenue", "tutorial": false, "remote": { "port": %s, "address": "192.168.77.20", "pins": "pins", "osc": { "port": %s, "from": ["192.168.77.20"] } }, "machines": { "master": "front", "interface": "192.168.77.0/24", "domain": %s } }\n' \
    $port $osc $domain >"$folder/exhibit.json"

declare -A at
begin() { # NODE
    "$program" run --exhibit "$folder/exhibit.json" --node "$1" --quality fine >"$folder/$1.log" 2>&1 &
    at[$1]=$!
    started+=($!)
}
end() { # NODE
    kill -TERM ${at[$1]}
    wait ${at[$1]} || fail "$1: exit $?: $(cat "$folder/$1.log")"
    grep -q validation "$folder/$1.log" && fail "$1: the validation layers report an error"
}
says() { grep -q -- "$2" "$folder/$1.log"; } # NODE TEXT
count() { grep -c -- "$2" "$folder/$1.log"; } # NODE TEXT
lit() { [ "$(import -window root -crop "160x120+$1+0" -format '%[fx:mean>0.01]' info:)" = 1 ]; }
ask_there() { "$program" tell --host 192.168.77.20 --port "$port" --pin "$pin" "$@" 2>&1; }
waits=("the remote's port $port of 192.168.77.20" "OSC's UDP port $osc of 192.168.77.20" "the head tracker's port $tracker of 192.168.77.20" "the network of the exhibit's machines")

# Without the address: the picture, a line for each thing that is missing, and no second one.
begin front
begin left
until_true 60 lit 0 || fail "no picture without the address: $(cat "$folder/front.log")"
for what in "${waits[@]}"; do until_true 20 says front "network: $what can't be had" || fail "it does not say that it waits for $what"; done
says front 'interface "192.168.77.0/24" is none of this machine; one of these is right: lo (127.0.0.1)' || fail "the interface's reason is not named"
until_true 20 says left "network: the network of the exhibit's machines can't be had" || fail "the node does not wait for the network"
sleep 2.5 # seconds in which it tries again
for what in "${waits[@]}"; do [ "$(count front "network: $what can't be had")" = 1 ] || fail "it says more than once that it waits for $what"; done
kill -0 ${at[front]} ${at[left]} || fail "one of them has ended"
ok

# The address comes: all is taken up.
ip addr add 192.168.77.20/24 dev show0
for what in "${waits[@]}"; do until_true 20 says front "network: $what is there now" || fail "$what is not taken up"; done
answers() { ask_there status | grep -q '^scene: avenue'; }
until_true 60 answers || fail "the remote does not answer: $(ask_there status)"
until_true 60 says front "node 'left' is in step" || fail "the node does not join: $(cat "$folder/left.log")"
until_true 60 lit 160 || fail "the node shows no picture"
python3 -c '
import socket, struct, sys
to = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
to.bind(("192.168.77.20", 0))
to.sendto(b"/starbow/doppler\0\0\0\0,F\0\0", ("192.168.77.20", int(sys.argv[1])))
to.sendto(b"no head", ("192.168.77.20", int(sys.argv[2])))' $osc $tracker
off() { ask_there status | grep -q '^doppler: off'; }
until_true 20 off || fail "OSC is not heard"
until_true 20 says front "sends packets that hold no pose of a head" || fail "the head tracker's port is not read"
ok

# It goes and comes back: the machines find each other again.
joins=$(count front "node 'left' is in step")
ip addr del 192.168.77.20/24 dev show0
lost() { [ "$(count front "network: the network of the exhibit's machines can't be had")" = 2 ] && [ "$(count left "network: the network of the exhibit's machines can't be had")" = 2 ]; }
until_true 20 lost || fail "a lost interface is not noticed"
lit 0 || fail "the master's picture is gone with the interface"
ip addr add 192.168.77.20/24 dev show0
again() { [ "$(count front "node 'left' is in step")" -gt "$joins" ]; }
until_true 60 again || fail "the node does not come back: $(cat "$folder/front.log" "$folder/left.log")"
until_true 60 answers || fail "the remote is lost with the address"
end left
end front
ok

# Another program has the ports.
python3 -c '
import socket, sys, time
held = []
for kind, port in ((socket.SOCK_STREAM, sys.argv[1]), (socket.SOCK_DGRAM, sys.argv[2]), (socket.SOCK_DGRAM, sys.argv[3])):
    one = socket.socket(socket.AF_INET, kind)
    if kind == socket.SOCK_STREAM: # connections before may still be ending
        one.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    one.bind(("192.168.77.20", int(port)))
    if kind == socket.SOCK_STREAM:
        one.listen()
    held.append(one)
print("held", flush=True)
time.sleep(1000)' $port $osc $tracker >"$folder/holder" &
holder=$!
started+=($holder)
until_true 20 grep -q held "$folder/holder" || fail "the ports can't be held"
begin front
until_true 60 lit 0 || fail "no picture while the ports are in use: $(cat "$folder/front.log")"
for what in "${waits[@]:0:3}"; do until_true 20 says front "network: $what can't be had (Address already in use)" || fail "it does not say that it waits for $what"; done
{ kill -9 $holder; wait $holder; } 2>/dev/null
for what in "${waits[@]:0:3}"; do until_true 20 says front "network: $what is there now" || fail "$what is not taken up"; done
until_true 60 answers || fail "the remote does not answer on the port that was in use"
end front
ok

# A wrong file is refused at once, also while the address is missing.
ip addr del 192.168.77.20/24 dev show0
refused() { # TEXT
    local said
    said=$(timeout 600 "$program" run --exhibit "$folder/wrong.json" --node front 2>&1)
    [ $? = 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" = 1 ] && [[ $said == *"$1"* ]] || fail "'$1' is not the message: $said"
}
sed 's/"pins": "pins"/"pins": "none"/' "$folder/exhibit.json" >"$folder/wrong.json"
refused 'does not exist'
sed 's/"pins": "pins"/"pins": "pins", "certificate": "pins", "key": "pins"/' "$folder/exhibit.json" >"$folder/wrong.json"
refused 'a certificate with its key, if they are named, is right'
sed 's/192.168.77.0\/24/192.168.77.0\/99/' "$folder/exhibit.json" >"$folder/wrong.json"
refused 'is not a network'
ok

echo "$passed passed, 0 failed"
