#!/usr/bin/env bash
# Installs both packages under a systemd of its own and starts, kills and hangs the exhibit there: namespaces and an overlay over
# this machine's files, which nothing outlives. It needs root, takes some minutes, and is no part of ./test.
# Usage: tests/packaging/boot.sh BUILD-FOLDER [KEPT-LOG]
set -eu
build=$(realpath "${1:?the build folder}")
here=$(dirname "$(realpath "$0")")
log=${2:-}

# The groups of systemd's own hierarchy, which outlives a namespace: cgroups PLACE lists them, cgroups PLACE remove LIST removes those
# that are not in the list.
cgroups() {
    unshare -m bash -c 'mount -t cgroup -o none,name=systemd cgroup "$0" && cd "$0" || exit
        find . -depth -mindepth 1 -type d | if [ "${1:-}" = remove ]; then grep -vxFf "$2" | xargs -r rmdir; else cat; fi' "$@" 2>/dev/null || true
}

if [ "${3:-}" != inside ]; then
    [ "$(id -u)" = 0 ] || { echo "This needs root, for namespaces." >&2 && exit 2; }
    folder=$(mktemp -d)
    mkdir "$folder/out" "$folder/space"
    cpack -G DEB --config "$build/CPackConfig.cmake" -B "$folder/packages" >"$folder/cpack.log" 2>&1 || { cat "$folder/cpack.log" && exit 1; }
    cp -r "$folder/packages/starbow.deb" "$folder/packages/starbow-exhibit.deb" "$build/rig" "$here/boot_inside.sh" "$here/../rig/xorg.conf" "$folder/out"
    : >"$folder/out/log"
    cgroups "$folder/space" >"$folder/cgroups"
    # No network: its abstract sockets are the namespace's own, so that display :0 is free.
    setsid unshare -m -p -f -u -i -n -C --kill-child "$0" "$build" "$folder" inside >"$folder/systemd.log" 2>&1 &
    space=$!
    tail -n +1 -f "$folder/out/log" &
    reader=$!
    for ((i = 0; i < 6000; i++)); do
        [ -e "$folder/out/status" ] || ! kill -0 $space 2>/dev/null || { sleep 0.1 && continue; }
        break
    done
    status=$(cat "$folder/out/status" 2>/dev/null || echo 1)
    sleep 0.2
    kill -KILL $space || true # unshare ignores SIGTERM; with it goes every process of the namespace
    kill $reader || true
    wait 2>/dev/null || true
    cgroups "$folder/space" remove "$folder/cgroups"
    [ "$status" = 0 ] || tail -n 40 "$folder/systemd.log" "$folder/out/journal" 2>/dev/null || true
    [ -z "$log" ] || cp "$folder/out/journal" "$log"
    rm -rf "$folder" # its mounts were the namespace's and ended with it
    exit "$status"
fi

# Inside: process 1 of the new namespaces. Nothing of the machine's own /dev is mounted here.
folder=$2
mount --make-rprivate /
mount -t tmpfs -o mode=755 tmpfs "$folder/space"
cd "$folder/space"
mkdir upper work root
mount -t overlay overlay -o lowerdir=/,upperdir=upper,workdir=work root
mount -t proc proc root/proc
mount -o remount,bind,ro root/proc/sys 2>/dev/null || { mount --bind root/proc/sys root/proc/sys && mount -o remount,bind,ro root/proc/sys; }
mount -t sysfs -o ro sysfs root/sys
mount -t tmpfs tmpfs root/sys/fs/cgroup
mkdir root/sys/fs/cgroup/systemd
mount -t cgroup -o none,name=systemd cgroup root/sys/fs/cgroup/systemd
mount -t tmpfs -o mode=755 tmpfs root/dev
for node in 'null 1 3' 'zero 1 5' 'full 1 7' 'random 1 8' 'urandom 1 9' 'tty 5 0'; do
    read -r name major minor <<<"$node"
    mknod -m 666 "root/dev/$name" c "$major" "$minor"
done
mkdir root/dev/pts root/dev/shm
mount -t devpts -o newinstance,ptmxmode=0666 devpts root/dev/pts
ln -s pts/ptmx root/dev/ptmx
ln -s /proc/self/fd root/dev/fd
mount -t tmpfs -o mode=1777 tmpfs root/dev/shm
mount -t tmpfs -o mode=755 tmpfs root/run
mount -t tmpfs -o mode=1777 tmpfs root/tmp
mkdir -p root/out root/opt/rig
mount --bind "$folder/out" root/out
cp -r root/out/rig/. root/opt/rig
rm -f root/usr/sbin/policy-rc.d
mkdir -p root/etc/systemd/system
for unit in systemd-udevd systemd-udev-trigger systemd-networkd systemd-timesyncd systemd-logind getty@tty1 console-getty \
    systemd-sysctl systemd-modules-load systemd-binfmt systemd-remount-fs systemd-hwdb-update e2scrub_reap; do
    ln -sf /dev/null "root/etc/systemd/system/$unit.service"
done
cat >root/etc/systemd/system/boot-test.service <<'UNIT'
[Unit]
After=basic.target systemd-journald.service
[Service]
Type=oneshot
ExecStart=/bin/bash /out/boot_inside.sh
StandardOutput=append:/out/log
StandardError=append:/out/log
ExecStopPost=/bin/sh -c '[ -e /out/status ] || echo 1 >/out/status'
TimeoutStartSec=infinity
UNIT
# Xorg without a monitor and without a console.
mkdir -p root/etc/systemd/system/starbow-display.service.d
cat >root/etc/systemd/system/starbow-display.service.d/dummy.conf <<'UNIT'
[Service]
ExecStart=
ExecStart=/usr/bin/Xorg :0 -nolisten tcp -noreset -novtswitch -sharevts -s 0 -config /out/xorg.conf -logfile /dev/null -verbose 2
UNIT
exec env -i container=lxc PATH="$PATH" chroot root /lib/systemd/systemd --system --unit=boot-test.service --log-target=journal --show-status=no
