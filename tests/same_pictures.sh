#!/usr/bin/env bash
# Compares the pictures of two builds of starbow byte for byte: every shipped shot on every shipped layout, PNG and EXR.
#
#   tests/same_pictures.sh hashes STARBOW FILE    writes a line for each picture: SHA-256, layout, shot, file; after an
#                                                 interruption it continues with the pictures that FILE lacks
#   tests/same_pictures.sh compare FILE FILE      exits 0 if both files hold the same pictures, and 1 with the differing ones
#   tests/same_pictures.sh STARBOW STARBOW        both steps, for two programs, in a temporary folder
#
# The environment narrows the work: LAYOUTS and SHOTS name some instead of all, SIZE=WIDTHxHEIGHT replaces the layouts' sizes.
#   SIZE=320x240 tests/same_pictures.sh old/build/release/starbow build/release/starbow
set -euo pipefail

names() { for file in "$1"/*.json; do basename "$file" .json; done; }

hashes() {
    local starbow=$1 file=$2 home layout shot picture total done_=0 began=$SECONDS
    # The program finds its shipped files in the nearest folder above it; so does this script.
    home=$(cd "$(dirname "$starbow")" && pwd)
    while [ "$home" != / ] && [ ! -d "$home/config/shots" ]; do home=$(dirname "$home"); done
    [ -d "$home/config/shots" ] || { echo "same_pictures: no config/shots in a folder above $starbow" >&2; exit 2; }
    local layouts=${LAYOUTS:-$(names "$home/config/layouts")} shots=${SHOTS:-$(names "$home/config/shots")}
    local size=(); [ -z "${SIZE:-}" ] || size=(--size "$SIZE")
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    touch "$file"
    total=$(($(wc -w <<<"$layouts") * $(wc -w <<<"$shots")))
    for layout in $layouts; do
        for shot in $shots; do
            done_=$((done_ + 1))
            grep -q " $layout $shot end\$" "$file" && continue
            rm -rf "$work/out"
            "$starbow" render --layout "$layout" --shot "$shot" --out "$work/out" --exr "${size[@]}" >"$work/log" 2>&1 \
                || { cat "$work/log" >&2; echo "same_pictures: $layout, $shot: not drawn" >&2; exit 1; }
            (
                cd "$work/out"
                for picture in *; do
                    printf '%s %s %s %s\n' "$(sha256sum <"$picture" | cut -d' ' -f1)" "$layout" "$shot" "$picture"
                done
            ) >"$work/lines"
            cat "$work/lines" >>"$file"
            echo "- $layout $shot end" >>"$file"
            [ ! -t 2 ] || printf '\r%d of %d, %d s\033[K' "$done_" "$total" $((SECONDS - began)) >&2
        done
    done
    echo "$(grep -vc '^-' "$file") pictures of $total shots on layouts in $file" >&2
}

compare() {
    local a b
    a=$(grep -v '^-' "$1" | sort -k2) b=$(grep -v '^-' "$2" | sort -k2)
    [ -n "$a" ] || { echo "same_pictures: $1 holds no picture" >&2; exit 2; }
    if [ "$a" = "$b" ]; then
        echo "$(wc -l <<<"$a") pictures are the same, byte for byte"
    else
        diff <(echo "$a") <(echo "$b") | grep '^[<>]' | cut -d' ' -f1,3- | sort -u -k2 | head -40
        echo "same_pictures: $1 and $2 differ in the pictures above (at most 40 are shown)" >&2
        exit 1
    fi
}

case "${1:-}" in
    hashes) [ $# = 3 ] || { sed -n 2,10p "$0" >&2; exit 2; }; hashes "$2" "$3" ;;
    compare) [ $# = 3 ] || { sed -n 2,10p "$0" >&2; exit 2; }; compare "$2" "$3" ;;
    *)
        [ $# = 2 ] || { sed -n 2,10p "$0" >&2; exit 2; }
        both=$(mktemp -d)
        (hashes "$1" "$both/a") && (hashes "$2" "$both/b")
        compare "$both/a" "$both/b"
        ;;
esac
