#!/usr/bin/env bash
# boot.sh runs this as a service of the systemd that it has started: installs the packages and plays the exhibit's bad days.
set -u
passed=0
ok() { passed=$((passed + 1)) && echo "ok: $*"; }
finish() {
    journalctl --no-pager -o short-precise >/out/journal 2>&1
    echo "$1" >/out/status.part && mv /out/status.part /out/status
    exit 0
}
fail() {
    echo "FAILED: $*"
    systemctl status --no-pager -l starbow starbow-display 2>&1 | head -n 40
    finish 1
}
until_true() { # SECONDS COMMAND...
    local end=$((SECONDS + $1))
    shift
    until "$@" >/dev/null 2>&1; do
        [ $SECONDS -lt $end ] || return 1
        sleep 0.1
    done
}
property() { systemctl show -P "$1" "${2:-starbow}.service"; }
shows() { [ "$(property ActiveState)" = active ] && [[ $(property StatusText) == Shows* ]]; }
restarted() { [ "$(property NRestarts)" -gt "$restarts" ] && shows; }
process() { property MainPID; }
# Times since the machine's start, ms: now, and of the exhibit's present process.
now_ms() { awk '{ print int(1000 * $1) }' /proc/uptime; }
started_ms() { echo $(($(property ExecMainStartTimestampMonotonic) / 1000)); }

dpkg -i /out/starbow.deb /out/starbow-exhibit.deb >/out/dpkg.log 2>&1 || fail "dpkg: $(cat /out/dpkg.log)"
until_true 120 shows || fail "not started by its installation"
ok "installed, started: $(property StatusText)"
for unit in starbow-display.service starbow.service starbow-hours.timer; do
    systemctl -q is-enabled $unit || fail "$unit does not start with the machine"
done
[ "$(ps -o user= -p "$(process)")" = starbow ] || fail "not the user starbow"
for group in input video render; do id -nG starbow | grep -qw $group || fail "starbow is not in $group"; done
systemd-analyze verify starbow-display.service starbow.service starbow-hours.timer >/out/verify 2>&1 || fail "verify: $(cat /out/verify)"
grep starbow /out/verify && fail "verify says the lines above"
for unit in starbow starbow-display starbow-hours; do systemd-analyze security --no-pager $unit.service | tail -n 1; done
ok "enabled; user, groups and units are right"

restarts=$(property NRestarts)
kill -SEGV "$(process)"
until_true 60 restarted || fail "killed: not started again"
[ "$(ls /var/lib/starbow/crash | wc -l)" = 1 ] && grep -q SIGSEGV /var/lib/starbow/crash/* || fail "no trace of the crash"
ok "killed by SIGSEGV: started again, NRestarts $(property NRestarts), a trace is kept"

restarts=$(property NRestarts) began=$(now_ms)
kill -STOP "$(process)" # the program can't even end by itself
until_true 60 restarted || fail "stopped: the watchdog does not start it again"
took=$(($(started_ms) - began))
ok "stopped: the watchdog started it again after $took ms"
[ $took -le 7000 ] || fail "more than 7 s"

mkdir -p /run/systemd/system/starbow.service.d
printf '[Service]\nEnvironment=VK_LAYER_PATH=/opt/rig VK_INSTANCE_LAYERS=VK_LAYER_STARBOW_faults STARBOW_FAULTS=fence:60:HANG\n' \
    >/run/systemd/system/starbow.service.d/hang.conf
systemctl daemon-reload && systemctl restart starbow || fail "restart with a fault"
restarts=$(property NRestarts)
until_true 60 eval '[ "$(property NRestarts)" -gt "$restarts" ]' || fail "hung: not started again"
rm /run/systemd/system/starbow.service.d/hang.conf && systemctl daemon-reload
journalctl -u starbow -o cat | grep 'hang: the end of the frame' || fail "the wait is not named"
journalctl -u starbow STARBOW_LINE=hung -o cat | grep -q 'hang: the end of the frame' || fail "the line has no kind"
journalctl -u starbow -x | grep -q 'A wait for the graphics driver or the window system had no end' || fail "the journal does not explain the line"
journalctl -u starbow -o cat | grep -q 'status=4' || fail "not ended with 4"
until_true 60 shows || fail "hung: no picture again"
ok "hung: named, ended with 4, started again"

systemctl restart starbow && until_true 60 shows
old=$(process) server=$(property MainPID starbow-display)
kill -KILL "$server"
again() { # both with another process, for three seconds
    local now
    now=$(process)
    [ "$(property MainPID starbow-display)" != "$server" ] && [ "$now" != "$old" ] && shows && sleep 3 && shows && [ "$(process)" = "$now" ]
}
until_true 60 again || fail "the X server killed: no picture again"
ok "the X server killed: display and exhibit started again"

for i in 1 2 3 4 5 6; do
    restarts=$(property NRestarts)
    kill -KILL "$(process)"
    until_true 60 restarted || fail "killed $i times: not started again"
done
[[ $(property StatusText) == *'in safe mode'* ]] || fail "six ends: $(property StatusText)"
ok "killed six times: $(property StatusText)"
systemctl restart starbow && until_true 60 shows && [[ $(property StatusText) != *'in safe mode'* ]] || fail "restarted by hand: $(property StatusText)"
ok "restarted by hand: $(property StatusText)"

printf 'Mon 00:00 00:00\n' >/etc/starbow/hours
systemctl start starbow-hours.service || fail "hours: closed"
DISPLAY=:0 xset q | grep 'Monitor is Off' || echo "note: this X server has no DPMS"
: >/etc/starbow/hours
systemctl start starbow-hours.service || fail "hours: open"
DISPLAY=:0 xset q | grep 'Monitor is On' || echo "note: this X server has no DPMS"
ok "opening hours"

sed -i 's/"avenue"/"train"/' /etc/starbow/exhibit.json
dpkg --force-confdef --force-confold -i /out/starbow.deb /out/starbow-exhibit.deb >/out/dpkg.log 2>&1 || fail "upgrade: $(cat /out/dpkg.log)"
grep -q train /etc/starbow/exhibit.json || fail "the upgrade took the site's file"
until_true 60 shows || fail "upgraded: no picture"
ok "upgraded: the site's files are kept"
dpkg -r starbow-exhibit >/out/dpkg.log 2>&1 || fail "remove: $(cat /out/dpkg.log)"
[ -e /etc/starbow/exhibit.json ] && [ -d /var/lib/starbow/crash ] && ! systemctl -q is-active starbow || fail "removed: not as it should be"
ok "removed: /etc/starbow and /var/lib/starbow stay"
dpkg -P starbow-exhibit starbow >/out/dpkg.log 2>&1 || fail "purge: $(cat /out/dpkg.log)"
left=$(find /boot /etc /srv /usr /var -xdev -iname '*starbow*' -not -path '/etc/systemd/system/starbow-display.service.d*' \
    -not -path '/var/log/*' -not -path '/var/cache/man/*' 2>/dev/null | head)
[ -z "$left" ] || fail "purged, and left: $left"
getent passwd starbow && fail "purged: the user is left"
ok "purged: nothing is left"
echo "$passed passed, 0 failed"
finish 0
