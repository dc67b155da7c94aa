#!/bin/sh
# Draws pictures of two programs side by side, the older one's on the left, as an exhibit on a desk and under a dome shows them:
# docs/before-after.jpg, with the part of each dome that is lit. Each program shows the shipped files of its own tree. ImageMagick
# must be installed. From the root:
#
#     docs/before_after.sh OLD/build/release/starbow build/release/starbow
set -eu
[ $# = 2 ] || { sed -n '2,6s/^# *//p' "$0" >&2 && exit 2; }
work=out/before-after
mkdir -p "$work"

exhibit() { # PROGRAM NAME: the file of a shipped exhibit
    echo "$(dirname "$1")/../../config/exhibits/$2.json"
}

still() { # PROGRAM SHOT OUT OPTION...
    program=$1 shot=$2 out=$3
    shift 3
    "$program" render --shot "$shot" --hud --information visitor --out "$work/still" "$@"
    mv "$work/still/"*.png "$out"
}

moment() { # PROGRAM TOUR SECOND OUT: a tour's picture after some seconds, with title and caption
    rm -rf "$work/movie.mp4.frames"
    "$1" render --tour "$2" --layout desk --size 480x300 --fps 1 --movie "$work/movie.mp4" --part "$(($3 + 1))/1000"
    mv "$work/movie.mp4.frames/"*.png "$4"
}

lit() { # PICTURE: the part of a dome's circle above 13/255, in per cent
    convert "$1" -colorspace Gray -threshold 5.1% -format '%[fx:round(100*mean*4/pi)]' info:
}

desks= domes=
while read -r kind name second; do
    pair= label="$name"
    for program in "$1" "$2"; do
        picture="$work/$name-$kind-$([ "$program" = "$1" ] && echo before || echo after).png"
        case $kind in
            desk) still "$program" "$name" "$picture" --size 480x300 ;;
            dome)
                mode=$(sed -n 's/.*"exposure": { "mode": "\([a-z]*\)".*/\1/p' "$(exhibit "$program" dome)")
                still "$program" "$name" "$picture" --layout dome --size 480x480 --exposure-mode "${mode:-eye}"
                label="$label, $(lit "$picture") %%"
                ;;
            attract)
                tour=$(sed -n 's/.*"attract": \["\([a-z-]*\)".*/\1/p' "$(exhibit "$program" museum)")
                moment "$program" "$tour" "$second" "$picture"
                ;;
            tour) moment "$program" "$name" "$second" "$picture" ;;
        esac
        pair="$pair $picture"
    done
    convert $pair -splice 4x0 +append -chop 4x0 -set label "$label" "$work/$name-$kind.png"
    case $kind in dome) domes="$domes $work/$name-$kind.png" ;; *) desks="$desks $work/$name-$kind.png" ;; esac
done <<'ROWS'
attract loop 4
desk earth-400km
desk earth-10km
desk earth-night
tour simultaneity 14
tour twins 14
dome avenue-rest
dome chart-rest
dome clocks-rest
dome earth-400km
dome gamow-cycling
dome saturn
dome train-tunnel
dome twins-turn
ROWS
sheet="montage -background #222 -fill white -pointsize 12 -label %[label]"
$sheet $desks -tile 2x -geometry 640x200+3+3 "$work/desks.png"
$sheet $domes -tile 2x -geometry 640x320+3+3 "$work/domes.png"
convert "$work/desks.png" "$work/domes.png" -background '#222' -append -quality 82 docs/before-after.jpg
