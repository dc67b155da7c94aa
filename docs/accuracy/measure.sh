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

# name, scene, layout, pixels, rays for a pixel, rounds, shots
views="
alice-and-bob alice-and-bob desk 800x600 16 7 alice-and-bob
chart chart desk 800x600 16 7 chart-0.5
clocks clocks desk 800x600 16 7 clocks-passing
gamow gamow desk 800x600 16 5 gamow-cycling
light-clock light-clock desk 480x360 16 3 light-clock-flying
rainbow rainbow desk 480x360 16 3 rainbow-line
train train desk 480x360 16 3 train-aboard-long
twins twins desk 480x360 16 3 twins-turn
warm-wall warm-wall desk 480x360 16 3 warm-wall-4
wall avenue wall3 640x400 16 3 avenue-gamma4
dome avenue dome 1024x1024 16 3 avenue-gamma4
headset avenue headset 1080x600 16 3 avenue-gamma4
avenue avenue desk 800x600 25 9 avenue-rest avenue-gamma4
"

while read -r name scene layout size samples rounds shots; do
    [ -n "$name" ] || continue
    [ $# = 0 ] || [[ " $* " = *" $name "* ]] || continue
    options=()
    for shot in $shots; do
        options+=(--shot "$shot")
    done
    "$starbow" measure --scene "$scene" --layout "$layout" --size "$size" "${options[@]}" --samples "$samples" --rounds "$rounds" \
        --out "$work/$name" >&2 </dev/null
    cp "$work/$name/accuracy.svg" "$here/$name.svg"
    awk -F, -v name="$name" '
        NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
        { gsub(/"/, "", $1) }
        $1 == "draft" || $1 == "balanced" || $1 == "fine" {
            cell[$1] = sprintf("%.0f ms, %.1f dB, %.3f", $column["ms"], $column["psnr_dB"], $column["flip"])
        }
        END { printf "| %s | %s | %s | %s | [chart](accuracy/%s.svg) |\n", name, cell["draft"], cell["balanced"], cell["fine"], name }
    ' "$work/$name/accuracy.csv"
done <<<"$views"
