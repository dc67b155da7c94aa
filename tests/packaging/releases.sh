#!/usr/bin/env bash
# Starbow on each release of Debian, from nothing: a bare root by debootstrap, a fresh clone, `./run` to its first picture,
# `./test`, the packages, their installation there, and the installed program's pictures of the shipped shots. They are
# compared with those of the release named first: at least 80 dB where every triangle is drawn. With fewer triangles, as shots are
# drawn by default, pictures differ more, as each release's meshoptimizer leaves other triangles out; that figure is printed alone.
# As root. A FOLDER keeps the roots, and after an interruption a release that has passed with the same commit is not tried again.
# Usage: releases.sh [--folder FOLDER] [--without-test] RELEASE...      Example: releases.sh bookworm trixie
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder= with_test=1
while [[ ${1:-} == --* ]]; do
    case $1 in
        --folder) folder=$2 && shift 2 ;;
        --without-test) with_test= && shift ;;
        *) sed -n '2,7s/^# //p' "${BASH_SOURCE[0]}" && exit 0 ;;
    esac
done
[ $# -gt 0 ] || { echo "releases.sh: no release is named; 'releases.sh bookworm trixie' is right" >&2 && exit 2; }
[ "$(id -u)" = 0 ] || { echo "releases.sh: a root of another release can be made by root alone; run it as root" >&2 && exit 2; }
command -v debootstrap >/dev/null || { echo "releases.sh: debootstrap is missing; 'apt-get install debootstrap' brings it" >&2 && exit 2; }
if [ -z "$folder" ]; then
    folder=$(mktemp -d)
    trap 'rm -rf --one-file-system "$folder"' EXIT
fi
mkdir -p "$folder"
# The machine's own mirror; one of the two files is missing on most machines.
mirror=$({ sed -n 's/^URIs: *//p; s/^deb \(\[[^]]*\] \)\?\([^ ]*\) .*/\2/p' /etc/apt/sources.list.d/*.sources /etc/apt/sources.list 2>/dev/null || true; } |
    head -n 1)
: "${mirror:=http://deb.debian.org/debian}"

# inside ROOT COMMAND...: runs a command in a root, with the kernel's file systems there until it ends.
inside() {
    local root=$1
    shift
    unshare --mount --propagation private bash -c '
        root=$1 && shift
        mount --rbind /dev "$root/dev" && mount -t proc proc "$root/proc" && mount -t sysfs sys "$root/sys"
        exec chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 "$@"' inside "$root" "$@"
}

# stage NAME COMMAND...: prints the seconds that a command took, or the end of its output where it fails.
stage() {
    local name=$1 began status=0
    shift
    began=$(date +%s.%N)
    "$@" >"$folder/$release-$name.log" 2>&1 || status=$?
    printf '%s: %s %s, %.0f s\n' "$release" "$name" "$([ $status = 0 ] && echo passed || echo FAILED)" \
        "$(echo "$(date +%s.%N) $began" | awk '{ print $1 - $2 }')"
    [ $status = 0 ] || { tail -n 20 "$folder/$release-$name.log" && exit 1; }
}

# Until `./run` has drawn its first picture; then it is stopped, as the other pictures are drawn by the installed program.
first_picture() {
    inside "$root" bash -c 'cd /starbow || exit 1; ./run & run=$!
        until [ -e /starbow/out/starbow/desk.png ]; do kill -0 $run 2>/dev/null || exit 1; sleep 0.2; done
        kill $run; wait $run; true'
}

install_packages() {
    inside "$root" bash -c 'cd /starbow && tests=yes && . ./prepare && build build/release "all" -DCMAKE_BUILD_TYPE=Release -DSTARBOW_ALL_TESTS=OFF
        cd build/release && cpack -G DEB -B /packages && apt-get install -q -y --no-install-recommends /packages/starbow.deb /packages/starbow-exhibit.deb'
}

draw_shots() {
    inside "$root" bash -c 'set -e; cd /root
        sed "s/\(\"lod_[a-z]*_texels\": *\)[0-9.]*/\10/" /usr/share/starbow/config/qualities/fine.json >every-triangle.json
        for shot in /usr/share/starbow/config/shots/*.json; do
            name=$(basename "$shot" .json)
            starbow render --shot "$name" --size 320x240 --out "/shots/$name"
            starbow render --shot "$name" --size 320x240 --quality every-triangle.json --out "/shots-every-triangle/$name"
        done'
}

# least_psnr SHOTS: the least PSNR of a release's pictures against those of the first one, in dB; 999 where all are the same.
least_psnr() {
    local least=999 picture db
    for picture in "$folder/$first/$1"/*/desk.png; do
        db=$({ compare -metric PSNR "$picture" "$root/$1/$(basename "$(dirname "$picture")")/desk.png" null: 2>&1 || true; } | awk '{ print $1 == "inf" || $1 == "0" ? 999 : $1 }')
        echo "$picture $db" >&2
        least=$(echo "$least $db" | awk '{ print $1 < $2 ? $1 : $2 }')
    done
    echo "$least"
}

compare_shots() {
    local least
    least=$(least_psnr shots-every-triangle)
    echo "$least $(least_psnr shots)" >"$folder/$release-least"
    awk "BEGIN { exit !($least >= 80) }"
}

first=$1
commit=$(git -C "$source" rev-parse HEAD)
for release in "$@"; do
    root=$folder/$release
    if [ "$(cat "$folder/$release-passed" 2>/dev/null)" = "$commit $with_test" ]; then
        echo "$release: passed before"
        continue
    fi
    [ -e "$root/etc/os-release" ] || stage root debootstrap --variant=minbase "$release" "$root" "$mirror"
    cp /etc/resolv.conf "$root/etc/resolv.conf"
    cp /etc/apt/apt.conf.d/*prox* "$root/etc/apt/apt.conf.d/" 2>/dev/null || true
    rm -rf "$root/starbow" "$root/shots" "$root/shots-every-triangle" "$root/packages"
    git clone -q "$source" "$root/starbow"
    stage first-picture first_picture
    if [ -n "$with_test" ]; then
        stage test inside "$root" bash -c 'cd /starbow && ./test'
    fi
    stage packages install_packages
    stage shots draw_shots
    if [ "$release" != "$first" ]; then
        stage comparison compare_shots
        read -r every fewer <"$folder/$release-least"
        echo "$release: every shot has at least $every dB against $first's with every triangle (999: the same), $fewer dB by default"
    fi
    echo "$commit $with_test" >"$folder/$release-passed"
done
