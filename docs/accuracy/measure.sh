#!/usr/bin/env bash
# Measures every shipped scene, and the avenue on the displays that docs/accuracy.md advises on: draws the charts beside this
# file anew and prints the rows of its table. Takes half an hour without a GPU; when it is interrupted, it goes on.
#
#     docs/accuracy/measure.sh              all of it
#     docs/accuracy/measure.sh clocks dome  only these
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
starbow=$root/build/release/starbow
work=$root/build/accuracy

# name, scene, layout, pixels, shots
views="
alice-and-bob alice-and-bob desk 800x600 alice-and-bob
chart chart desk 800x600 chart-0.5
clocks clocks desk 800x600 clocks-passing
gamow gamow desk 800x600 gamow-cycling
light-clock light-clock desk 800x600 light-clock-flying
rainbow rainbow desk 800x600 rainbow-line
train train desk 800x600 train-aboard-long
twins twins desk 800x600 twins-turn
warm-wall warm-wall desk 800x600 warm-wall-4
wall avenue wall3 640x400 avenue-gamma4
dome avenue dome 1024x1024 avenue-gamma4
headset avenue headset 1080x600 avenue-gamma4
avenue avenue desk 800x600 avenue-rest avenue-gamma4
"

while read -r name scene layout size shots; do
    [ -n "$name" ] || continue
    [ $# = 0 ] || [[ " $* " = *" $name "* ]] || continue
    options=()
    for shot in $shots; do
        options+=(--shot "$shot")
    done
    "$starbow" measure --scene "$scene" --layout "$layout" --size "$size" "${options[@]}" --samples 16 --rounds 7 \
        --out "$work/$name" >&2 </dev/null
    cp "$work/$name/accuracy.svg" "$here/$name.svg"
    awk -F, -v name="$name" '
        NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
        { gsub(/"/, "", $1) }
        $1 == "draft" || $1 == "balanced" || $1 == "fine" {
            cell[$1] = sprintf("%.0f ms, %.1f dB, %.3f", $column["ms"], $column["psnr_dB"], $column["flip"])
        }
        END { printf "| %s | %s | %s | %s |\n", name, cell["draft"], cell["balanced"], cell["fine"] }
    ' "$work/$name/accuracy.csv"
done <<<"$views"
