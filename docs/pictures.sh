#!/bin/sh
# Draws the pictures and films of README.md and docs/*.md again. From the repository's root, with ffmpeg and ImageMagick
# installed:
#
#     docs/pictures.sh build/release/starbow
set -eu
starbow=$1
work=out/pictures
mkdir -p "$work" docs/worlds docs/layouts

# still NAME OPTION...: draws $work/NAME/OUTPUT.png
still() {
    name=$1
    shift
    "$starbow" render --out "$work/$name" "$@"
}

# The take-off: a tour as a movie, and the movie as a moving picture.
"$starbow" render --tour docs/take-off.json --movie "$work/take-off.mp4" --fps 15 --size 640x360 --quality balanced
ffmpeg -v error -y -i "$work/take-off.mp4" -c:v libwebp_anim -loop 0 -quality 70 -compression_level 6 docs/take-off.webp

# One street at rest and at gamma 4, shapes alone: the same place, time and view.
cat >"$work/street-gamma4.json" <<'END'
{
    "scene": "gamow", "time": 8.0, "position": [1.0, 1.7, 17.0], "look": [0, 0, -1],
    "velocity": { "direction": [0, 0, -1], "gamma": 4 },
    "effects": { "aberration": true, "doppler": false, "headlight": false }
}
END
still rest --shot gamow-rest --size 640x480
still gamma4 --shot "$work/street-gamma4.json" --size 640x480
convert "$work/rest/desk.png" "$work/gamma4/desk.png" -splice 4x0+0+0 +append -chop 4x0 -quality 88 docs/rest-gamma4.jpg

# A wall of three screens with the display for visitors, a domemaster, and the laboratory's instruments.
still wall --layout wall3 --shot gamow-cycling --size 640x400 --hud --information visitor
convert "$work/wall/left.png" "$work/wall/middle.png" "$work/wall/right.png" -background '#222' -splice 10x0 +append \
    -chop 10x0 -resize 1280x -quality 85 docs/museum.jpg
still dome --layout dome --shot gamow-cycling --size 1024x1024
convert "$work/dome/domemaster.png" -resize 512x512 -quality 88 docs/dome.jpg
still class --shot gamow-walking --size 800x500 --overlay ring --measure "0deg,2deg; 17deg,8deg" --why doppler
convert "$work/class/desk.png" -quality 88 docs/class.jpg

# The names of Orion's neighbourhood at rest, and flying towards it.
still names-rest --shot orion --size 640x480 --sky-names
cat >"$work/names-flight.json" <<'END'
{
    "scene": "avenue", "position": [0, 12, 20], "look": [0, 0.2, -1], "velocity": { "direction": [0, 0.2, -1], "gamma": 2 },
    "effects": { "aberration": true, "doppler": false, "headlight": false }
}
END
still names-flight --shot "$work/names-flight.json" --size 640x480 --sky-names
convert "$work/names-rest/desk.png" "$work/names-flight/desk.png" -splice 4x0+0+0 +append -chop 4x0 -quality 85 docs/sky-names.jpg

# The Earth by day and by night: clouds from the height of an airliner, aurora from a space station's.
still clouds --shot earth-10km --size 640x400
still aurora --shot aurora --size 640x400
convert "$work/clouds/desk.png" "$work/aurora/desk.png" -splice 4x0+0+0 +append -chop 4x0 -quality 88 docs/earth.jpg

# The worlds.
while read -r world shot; do
    still "world-$world" --shot "$shot" --size 640x400
    convert "$work/world-$world/desk.png" -resize 480x300 -quality 82 "docs/worlds/$world.jpg"
done <<'END'
avenue avenue-rest
rainbow rainbow-line
solar-system earth-400km
warm-wall warm-wall-1.5
clocks clocks-rest
chart chart-rest
train train-tunnel
twins twins-turn
light-clock light-clock
alice-and-bob alice
gamow gamow-rest
END

# Every shot on a dome, on a dome of two projectors and for two eyes, by the range curve: docs/domes.jpg.
domes= pairs= eyes=
for file in config/shots/*.json; do
    shot=$(basename "$file" .json)
    for layout in dome dome2 stereo; do
        size=480x300
        [ $layout = dome ] && size=480x480
        still "$layout/$shot" --layout $layout --shot "$shot" --size $size --exposure-mode range --hud --information visitor
    done
    convert "$work/dome2/$shot/left.png" "$work/dome2/$shot/right.png" +append "$work/dome2/$shot/both.png"
    domes="$domes -label $shot $work/dome/$shot/domemaster.png"
    pairs="$pairs -label $shot $work/dome2/$shot/both.png"
    eyes="$eyes -label $shot $work/stereo/$shot/stereo.png"
done
montage="montage -background #222 -fill white -pointsize 11"
$montage $domes -tile 11x -geometry 150x150+2+2 "$work/domes.png"
$montage $pairs -tile 8x -geometry 208x65+2+2 "$work/pairs.png"
$montage $eyes -tile 11x -geometry 150x94+2+2 "$work/eyes.png"
convert "$work/domes.png" "$work/pairs.png" "$work/eyes.png" -background '#222' -gravity center -append -quality 82 docs/domes.jpg

# Six moments of each tour on the desk, on a dome and for two eyes, with titles and captions: docs/storyboards.jpg.
rows=
while read -r tour; do
    for view in desk:480x270 dome:270x270 stereo:480x240; do
        layout=${view%%:*} movie="$work/$tour-${view%%:*}.mp4"
        moments() { # PART: draws some frames of the movie, one a second
            "$starbow" render --tour "$tour" --layout "$layout" --size "${view##*:}" --fps 1 --movie "$movie" --part "$1"
        }
        seconds=$(moments 4/1000 | sed -n 's/.* of \([0-9]*\) frames are in .*/\1/p')
        moments "4/$(((seconds + 5) / 6))" >"$work/moments.txt"
        montage "$movie.frames/"*.png -background '#222' -tile 6x1 -geometry 320x180+2+2 "$work/$tour-$layout.png"
        rows="$rows $work/$tour-$layout.png"
    done
done <<'END'
first-minute
street
rainbow
aurora
simultaneity
twins
solar-system
voyage
END
convert $rows -background '#222' -append -quality 80 docs/storyboards.jpg

# What a passer-by sees: the museum's attract loop with its titles and captions, docs/attract.webm.
for tour in $(sed -n 's/.*"attract": \[\(.*\)\].*/\1/p' config/exhibits/museum.json | tr -d '",'); do
    "$starbow" render --tour "$tour" --layout screen --size 480x270 --fps 10 --movie "$work/attract-$tour.mp4" >&2
    echo "file 'attract-$tour.mp4'"
done >"$work/attract.txt"
ffmpeg -v error -y -f concat -i "$work/attract.txt" -an -c:v libvpx-vp9 -crf 42 -b:v 0 -row-mt 1 docs/attract.webm

# A layout of each projection, as `starbow check` draws it.
for layout in desk wall3 cave5 dome dome2 mirror headset stereo; do
    "$starbow" check "$layout" --svg "docs/layouts/$layout.svg"
done
while read -r name size projection; do
    echo "{ \"outputs\": [{ \"name\": \"$name\", \"size\": $size, \"viewports\": [{ \"projection\": $projection }] }] }" >"$work/$name.json"
    "$starbow" check "$work/$name.json" --svg "docs/layouts/$name.svg"
done <<'END'
cylinder [4096,1024] { "type": "cylinder", "sides_deg": { "left": -100, "right": 100, "down": -20, "up": 25 } }
equirectangular [4096,2048] { "type": "equirectangular" }
cube [6144,1024] { "type": "cube" }
END
