#!/usr/bin/env bash
# The Debian packages: their contents, what apt and systemd would make of them, and the program in a folder of its own, from
# which it runs without the checkout. tests/packaging/boot.sh installs them under a real systemd.
# Usage: package_test.sh BUILD-FOLDER
set -u
build=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
passed=0
ok() { passed=$((passed + 1)); }
fail() {
    echo "FAILED: $*"
    exit 1
}

cpack -G DEB --config "$build/CPackConfig.cmake" -B "$folder/out" >"$folder/cpack.log" 2>&1 || fail "cpack: $(tail -n 20 "$folder/cpack.log")"
for package in starbow starbow-exhibit; do
    deb=$folder/out/$package.deb
    dpkg-deb -c "$deb" | awk '{ print $1, $2, substr($6, 2) }' >"$folder/$package.list" || fail "$package: no package"
    dpkg-deb -f "$deb" >"$folder/$package.control"
    grep -v ' root/root ' "$folder/$package.list" && fail "$package: files that are not root's"
    grep -E '^(.......w|-....w)' "$folder/$package.list" && fail "$package: files that others may write"
done
ok

# has PACKAGE PATH...: the package must have each file, and each with a mode that lets everybody read it.
has() {
    local package=$1 path
    shift
    for path in "$@"; do
        grep -Eq "^[-d]......r.. root/root $path$" "$folder/$package.list" || fail "$package has no $path that all may read"
    done
}
has starbow /usr/bin/starbow /usr/lib/starbow/starbow-tools /usr/share/starbow/config/layouts/dome2/left.data /usr/share/starbow/scenes/avenue/avenue.glb \
    /usr/share/starbow/config/words/de.json /usr/share/starbow/config/remote/page.html \
    /usr/share/starbow/config/remote/page.js /usr/share/starbow/config/remote/page.css /usr/share/doc/starbow/remote.png /usr/share/doc/starbow/README.md \
    /usr/share/doc/starbow/exhibit.md /usr/share/doc/starbow/operation.md /usr/share/doc/starbow/worlds/gamow.jpg /usr/share/doc/starbow/layouts/dome.svg \
    /usr/share/doc/starbow/physics/spectrum.svg \
    /usr/share/applications/starbow.desktop /usr/share/man/man1/starbow.1.gz /usr/share/doc/starbow/changelog.gz \
    /usr/share/doc/starbow/copyright /lib/udev/rules.d/70-starbow.rules
has starbow-exhibit /lib/systemd/system/starbow.service /lib/systemd/system/starbow-display.service \
    /lib/systemd/system/starbow-hours.timer /lib/systemd/system/starbow-hours.service /usr/lib/sysusers.d/starbow.conf \
    /usr/lib/tmpfiles.d/starbow.conf /lib/udev/rules.d/71-starbow-exhibit.rules /etc/starbow/exhibit.json /etc/starbow/hours /etc/starbow/layouts/site.json \
    /usr/lib/starbow/hours /usr/lib/starbow/display-ready /usr/lib/systemd/catalog/starbow.catalog
grep -E '\.(cpp|h|py)$|/(build|tests|\.git)' "$folder"/starbow*.list && fail "files that nobody needs there"
for file in $(cd "$(dirname "$0")/../.." && git ls-files 'config/*.json' 'scenes/*.glb' 'scenes/stars/*.txt' 'scenes/stars/*.json'); do
    grep -q " /usr/share/starbow/$file$" "$folder/starbow.list" || fail "starbow lacks $file"
done
grep -q '^Depends: .*libvulkan1.*' "$folder/starbow.control" && grep -q '^Depends: .*fonts-dejavu-core' "$folder/starbow.control" \
    || fail "starbow: $(grep ^Depends "$folder/starbow.control")"
# A software centre offers the program to whoever plugs in a device of a shipped profile.
devices=$(cd "$(dirname "$0")/../.." && for profile in config/profiles/*.json; do
    sed -n 's/.*"vendor": "\(....\)".*/usb:v\1/p; s/.*"product": "\(....\)".*/p\1d/p' "$profile" | paste -sd ''
done | tr a-z A-Z | sort -u)
[ -n "$devices" ] && [ "$devices" = "$(dpkg-deb --fsys-tarfile "$folder/out/starbow.deb" | tar -xO ./usr/share/metainfo/starbow.metainfo.xml \
    | sed -n 's/.*<modalias>\(.*\)\*<.*/\1/p' | tr a-z A-Z | sort -u)" ] || fail "starbow.metainfo.xml does not name the devices of config/profiles: $devices"
for package in starbow starbow-exhibit; do
    for file in copyright NOTICE; do
        dpkg-deb --fsys-tarfile "$folder/out/$package.deb" | tar -xO "./usr/share/doc/$package/$file" \
            | cmp - "$(dirname "$0")/../../$([ $file = NOTICE ] || echo packaging/)$file" || fail "$package has another $file than the source"
    done
done
# NOTICE's last column names each library that the program asks for, and no source file tells all of them.
libraries=$(dpkg-deb --fsys-tarfile "$folder/out/starbow.deb" | tar -xO ./usr/bin/starbow >"$folder/program" \
    && readelf -d "$folder/program" | sed -n 's/.*(NEEDED).*\[lib\(.*\)\.so.*/\1/p')
[ "$(wc -w <<<"$libraries")" -ge 20 ] || fail "readelf: $libraries"
for library in $libraries; do
    sed -n '/^3\. /,$ s/.*  //p' "$(dirname "$0")/../../NOTICE" | tr ',' '\n' | tr -d ' ' | grep -Fxq "$library" || fail "NOTICE names no library $library"
done
grep -q '^Architecture: all' "$folder/starbow-exhibit.control" || fail "starbow-exhibit is not for all machines"
ok

# Debian's own checks, where they are installed: no error, no warning.
if command -v lintian >/dev/null; then
    lintian --allow-root --no-cfg "$folder"/out/*.deb >"$folder/lintian.log" 2>&1
    grep '^[EW]: ' "$folder/lintian.log" && fail "lintian: the lines above"
    ok
fi

# The journal explains each kind of line.
dpkg-deb --fsys-tarfile "$folder/out/starbow-exhibit.deb" | tar -xO ./usr/lib/systemd/catalog/starbow.catalog >"$folder/starbow.catalog"
kinds=$(grep -Ec '"[0-9a-f]{32}"' "$(dirname "$0")/../../config/model/log_kinds.h")
for line in '-- [0-9a-f]{32}$' 'Subject: .' 'What to do: .'; do
    [ "$(grep -Ec "^$line" "$folder/starbow.catalog")" = "$kinds" ] || fail "the catalog does not have $kinds lines '$line'"
done
if command -v journalctl >/dev/null; then
    mkdir -p "$folder/catalog/usr/lib/systemd/catalog" "$folder/catalog/var/lib/systemd/catalog"
    cp "$folder/starbow.catalog" "$folder/catalog/usr/lib/systemd/catalog"
    journalctl --root="$folder/catalog" --update-catalog 2>"$folder/catalog.log" || fail "journalctl: $(cat "$folder/catalog.log")"
    [ "$(journalctl --root="$folder/catalog" --list-catalog | wc -l)" = "$kinds" ] \
        || fail "journalctl does not read the whole catalog: $(cat "$folder/catalog.log")"
fi
ok

# Without the checkout, in a root of its own and from another folder, the program finds its files, the site's first.
root=$folder/root
dpkg-deb -x "$folder/out/starbow.deb" "$root" && dpkg-deb -x "$folder/out/starbow-exhibit.deb" "$root" || fail "unpacking"
export STARBOW_CACHE=$folder/cache HOME=$folder/home
mkdir -p "$HOME" && cd "$HOME" || fail "folders"
"$root/usr/bin/starbow" --version | grep -q '^starbow [0-9]' || fail "no version"
cat >"$root/etc/starbow/layouts/desk.json" <<'END2'
{ "outputs": [ { "name": "of-the-site", "size": [64, 48], "viewports": [ { "projection": { "type": "planar" } } ] } ] }
END2
"$root/usr/bin/starbow" check site >"$folder/said" 2>&1 || fail "the exhibit's first layout: $(cat "$folder/said")"
said=$(env -u DISPLAY -u WAYLAND_DISPLAY "$root/usr/bin/starbow" doctor)
[[ $said == *"files     $root/usr/share/starbow: "*" layouts, "*"read before these, are in $root/etc/starbow"* ]] \
    || fail "doctor: $said"
VK_DRIVER_FILES=$(ls /usr/share/vulkan/icd.d/lvp_icd.*.json | head -n 1) \
    "$root/usr/bin/starbow" render --shot chart-rest --out "$folder/picture" >"$folder/render.log" 2>&1 \
    || fail "render: $(cat "$folder/render.log")"
ls "$folder"/picture* | grep -q . || fail "render: no picture"
[ "$(cat "$folder"/picture*/*.png "$folder"/picture*.png 2>/dev/null | head -c 24 | od -An -tu1 -j16 | awk '{ print $3 * 256 + $4, $7 * 256 + $8; exit }')" = "64 48" ] \
    || fail "render: not on the site's layout: $(ls "$folder"/picture*)"
echo '{ "outputs": [] }' >"$root/etc/starbow/layouts/wrong.json"
env -u DISPLAY -u WAYLAND_DISPLAY "$root/usr/bin/starbow" doctor | grep -q -- "- $root/etc/starbow/layouts/wrong.json:" \
    || fail "doctor does not name the site's wrong file"
ok

# Opening hours: HOURS-FILE DAY TIME gives on or off.
hours=$root/usr/lib/starbow/hours
unset DISPLAY
printf 'Mon 09:00 17:30\n# Tue 09:00 10:00\nSun 00:00 24:00\n' >"$folder/hours"
for case in 'Mon 0859 off' 'Mon 0900 on' 'Mon 1729 on' 'Mon 1730 off' 'Tue 0930 off' 'Sun 0000 on' 'Sun 2359 on'; do
    read -r day time state <<<"$case"
    [ "$("$hours" "$folder/hours" "$day" "$time")" = "$state" ] || fail "hours: $case: $("$hours" "$folder/hours" "$day" "$time")"
done
[ "$("$hours" "$root/etc/starbow/hours" Mon 0300)" = on ] || fail "hours: the shipped file is not always open"
# On a display that is on, in standby or without DPMS, only what differs is switched.
mkdir "$folder/bin"
printf '#!/bin/sh\n[ "$1" = q ] && echo "  $MONITOR" || echo "$@" >>"%s/switched"\n' "$folder" >"$folder/bin/xset"
chmod +x "$folder/bin/xset"
for case in '0800 Monitor is On:dpms force off' '0800 Monitor is Off:' '0900 Monitor is On:' '0900 Monitor is in Standby:dpms force on' '0800 none:' '0900 none:'; do
    : >"$folder/switched"
    monitor=${case#* }
    MONITOR=${monitor%:*} DISPLAY=:0 PATH=$folder/bin:$PATH "$hours" "$folder/hours" Mon "${case%% *}" >"$folder/said" || fail "hours: $case: exit $?"
    [ "$(cat "$folder/switched")" = "${case#*:}" ] || fail "hours: $case: $(cat "$folder/switched")"
done
grep -q 'no DPMS' "$folder/said" && fail "hours: an open exhibit without DPMS complains"
printf 'Monday 9-17\n' >"$folder/hours"
"$hours" "$folder/hours" Mon 0900 >"$folder/said" 2>&1 && fail "hours: a wrong line is not refused"
grep -q "hours:1: \"Monday 9-17\"" "$folder/said" || fail "hours: $(cat "$folder/said")"
ok

# What systemd says of the units, where it is installed. The paths of the units are those of the root.
if command -v systemd-analyze >/dev/null; then
    cp -r "$root/lib/systemd/system" "$folder/units"
    sed -i "s,=/usr/lib/starbow/,=$root/usr/lib/starbow/,; s,=/usr/bin/starbow,=$root/usr/bin/starbow," "$folder"/units/*
    systemd-analyze verify --man=no "$folder"/units/starbow* >"$folder/verify.log" 2>&1 || fail "verify: $(cat "$folder/verify.log")"
    grep -v '^$' "$folder/verify.log" | grep starbow && fail "verify: the lines above"
    for unit in starbow starbow-display starbow-hours; do
        exposure=$(systemd-analyze security --offline=yes "$folder/units/$unit.service" 2>/dev/null | sed -n 's/.*exposure level for .*: \([0-9.]*\) .*/\1/p')
        awk "BEGIN { exit !(\"$exposure\" != \"\" && $exposure <= 4) }" || fail "$unit: an exposure of $exposure, not at most 4"
    done
    ok
fi
echo "$passed passed, 0 failed"
