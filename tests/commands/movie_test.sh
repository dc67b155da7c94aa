#!/usr/bin/env bash
# A tour's movie is made, interrupted, continued, begun anew and refused. Usage: movie_test.sh PROGRAM
set -u
program=$1
. "$(dirname "$0")/../rig/waiting.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
passed=0 failed=0
fail() {
    failed=$((failed + 1))
    echo "FAILED: $*"
}
ok() { if "$@"; then passed=$((passed + 1)); else fail "$*"; fi; }

tour() { # SECONDS TEXT
    printf '{ "scene": "avenue", "steps": [ { "seconds": %s, "caption": { "en": "%s" }, "cut": {} }, { "seconds": 1, "thrust": { "rapidity_per_s": 1 } } ] }\n' "$1" "$2" >"$folder/tour.json"
}
tour 1 "A short one"
movie="$folder/a movie of 100%.mp4"
frames="$movie.frames"
make() { "$program" render --tour "$folder/tour.json" --movie "$movie" --fps 15 --size 64x48 "$@"; }
count() { ffprobe -v error -count_frames -select_streams v:0 -show_entries stream=nb_read_frames,width,height,r_frame_rate -of csv=p=0 "$1"; }

# Starts a movie and interrupts it after some frames. Returns the program's exit status.
interrupt() {
    "$program" render --tour "$folder/tour.json" --movie "$movie" --fps 15 --size 64x48 --language de >"$folder/said" 2>"$folder/errors" &
    local child=$!
    begun() { [ "$(ls "$frames" | grep -c png)" -ge 3 ]; }
    until_true 60 begun || fail "no frames of a movie"
    kill -INT $child
    wait $child
}

# A movie made in one go has all frames and leaves no folder of frames.
make >"$folder/said" 2>"$folder/errors" || fail "making a movie: $(cat "$folder/errors")"
ok [ "$(count "$movie")" = 64,48,15/1,30 ]
ok [ ! -e "$frames" ]
ok grep -q '30 frames, 2.0 s' "$folder/said"
ok [ -z "$(grep -v '^starbow: frame [0-9]* of [0-9]*, about' "$folder/errors")" ] # a slow machine shows progress
# It shows the tour: at the end the ship has flown and the caption is gone. How alike two frames are, dB.
alike() { # FRAME FRAME
    for frame in "$1" "$2"; do ffmpeg -v error -y -i "$movie" -vf "select=eq(n\\,$frame)" -frames:v 1 "$folder/frame-$frame.png"; done
    ffmpeg -hide_banner -i "$folder/frame-$1.png" -i "$folder/frame-$2.png" -lavfi psnr -f null - 2>&1 | sed -n 's/.*average:\([0-9a-z]*\).*/\1/p'
}
ok [ "$(alike 2 13)" = inf -o "$(alike 2 13)" -gt 35 ]
ok [ "$(alike 2 29)" -lt 30 ]
ok [ "$(alike 20 29)" -lt 35 ]
"$program" render --tour "$folder/tour.json" --movie "$folder/odd.mp4" --fps 5 --size 63x47 >/dev/null || fail "a movie of odd size fails"
ok [ "$(count "$folder/odd.mp4")" = 64,48,5/1,10 ]

# An interrupted movie keeps its whole frames, and the earlier movie stays.
before=$(md5sum <"$movie")
interrupt
ok [ $? = 130 ]
ok grep -q 'interrupted with [0-9]* of 30 frames drawn; the same command goes on from there' "$folder/errors"
kept=$(ls "$frames" | grep -c 'png$')
ok [ "$kept" -ge 3 -a "$kept" -lt 30 ]
ok [ "$(md5sum <"$movie")" = "$before" ]
touch -d '2001-01-01' "$frames"/*-000001.png
cp "$frames"/*-000001.png "$folder/one.png"
make --language de >"$folder/said" 2>"$folder/errors" || fail "continuing the movie: $(cat "$folder/errors")"
ok grep -q "^$kept frames were there already, $((30 - kept)) more drawn$" "$folder/said"
ok [ "$(count "$movie")" = 64,48,15/1,30 ]
ok [ ! -e "$frames" ]

# Frames of another tour are dropped with a message. A frame that is missing is drawn again with the same bytes.
interrupt
ok cmp "$frames"/*-000001.png "$folder/one.png"
tour 1 "Another one"
make --language de >"$folder/said" 2>"$folder/errors" || fail "a changed tour: $(cat "$folder/errors")"
ok grep -q 'have changed; the movie begins again$' "$folder/errors"
ok [ "$(grep -c 'already' "$folder/said")" = 0 ]

# Parts make the same movie byte for byte, whether programs draw them at once into one folder or each into its own.
tour 1 "A short one"
fps=15 size=64x48
film() { # MOVIE OPTIONS...
    "$program" render --tour "$folder/tour.json" --fps $fps --size $size --movie "$folder/$1.mp4" "${@:2}"
}
film whole >/dev/null 2>&1 || fail "the whole movie"
for i in 1 2 3; do film parts --part $i/3 >"$folder/said-$i" 2>&1 & done
wait
ok grep -q 'part 2 of 3: 10 of 30 frames are in .*; once all parts are drawn, the same command with --join instead of --part makes the movie' "$folder/said-2"
ok [ ! -e "$folder/parts.mp4" ]
film parts --join >"$folder/said" 2>"$folder/errors" || fail "joining: $(cat "$folder/errors")"
ok cmp "$folder/whole.mp4" "$folder/parts.mp4"
ok [ ! -e "$folder/parts.mp4.frames" ]
film first --part 1/2 >/dev/null 2>&1 || fail "a part"
film second --part 2/2 >/dev/null 2>&1 || fail "a part"
film first --join >/dev/null 2>"$folder/errors" && fail "half a movie is joined"
ok grep -q '15 of 30 frames are missing, frame 1 the first of them' "$folder/errors"
film first --join --others "$folder/second.mp4.frames" >/dev/null || fail "joining two folders"
ok cmp "$folder/whole.mp4" "$folder/first.mp4"
# A machine that has drawn no part joins those of others.
film third --part 1/2 >/dev/null 2>&1 || fail "a part"
film head --join --others "$folder/second.mp4.frames" "$folder/third.mp4.frames" >/dev/null || fail "joining the folders of others alone"
ok cmp "$folder/whole.mp4" "$folder/head.mp4"

# refused TEXT COMMAND...: exit 2, one line, and nothing drawn.
refused() { # TEXT STATUS COMMAND...
    local text=$1 said
    shift
    said=$("$@" 2>&1 >/dev/null)
    if [ $? = 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" = 1 ] && [[ $said == *"$text"* ]]; then passed=$((passed + 1)); else fail "'$text' is not the message: $said"; fi
}
# A part of something else is refused, and the frames stay.
film mixed --part 1/2 >/dev/null 2>&1 || fail "a part"
size=32x32
refused 'its frames have another "sizes": ["64x48"] there, ["32x32"] here' film mixed --part 2/2
refused 'its frames have another "sizes"' film mixed --join
film small --part 1/2 >/dev/null 2>&1 || fail "a part"
refused 'its frames have another "sizes": ["64x48"] there, ["32x32"] here' film small --join --others "$folder/mixed.mp4.frames"
size=64x48
ok [ "$(ls "$folder/mixed.mp4.frames" | grep -c 'png$')" = 15 ]
refused 'holds no frames of a movie' film mixed --join --others "$folder"
refused 'there is nothing to join' film nowhere --join
ok [ ! -e "$folder/nowhere.mp4.frames" ]
refused 'holds no frames of a movie' film nowhere --join --others "$folder/third.mp4.frames" "$folder"
for part in 0/2 3/2 2 1/ a/b 1/2x; do refused "--part $part is not a part" film mixed --part $part; done
refused '--join' film mixed --part 1/2 --join
mkdir "$folder/empty"
refused "ffmpeg, which makes movies of pictures, can't be started (No such file or directory)" env PATH="$folder/empty" "$program" render --tour "$folder/tour.json" --movie "$folder/none.mp4"
ok [ ! -e "$folder/none.mp4.frames" ]
refused 'one that ends in .mp4 is right' "$program" render --tour first-minute --movie "$folder/none.avi"
refused 'there are: aurora, first-minute, rainbow, simultaneity' "$program" render --tour none --movie "$folder/none.mp4"
refused 'there are: de, en' "$program" render --tour rainbow --movie "$folder/none.mp4" --language xx
refused 'is not a folder' "$program" render --tour rainbow --movie "$folder/tour.json/none.mp4"
refused '--fps' "$program" render --tour rainbow --movie "$folder/none.mp4" --fps 0
refused '--movie' "$program" render --tour rainbow
refused '--shot' "$program" render --tour rainbow --movie "$folder/none.mp4" --shot start
mkdir -p "$folder/mine.mp4.frames" && echo mine >"$folder/mine.mp4.frames/letter"
refused 'holds no frames of a movie' "$program" render --tour "$folder/tour.json" --movie "$folder/mine.mp4"
ok [ "$(cat "$folder/mine.mp4.frames/letter")" = mine ]
# ffmpeg's own reason is reported, and the frames stay.
printf '#!/bin/sh\n[ "$1" = -version ] || { echo "first line" >&2; echo "no encoder today" >&2; exit 1; }\n' >"$folder/empty/ffmpeg"
chmod +x "$folder/empty/ffmpeg"
refused 'ffmpeg could not make it (no encoder today)' env PATH="$folder/empty:/usr/bin:/bin" "$program" render --tour "$folder/tour.json" --movie "$folder/broken.mp4" --fps 2 --size 32x32
ok [ "$(ls "$folder/broken.mp4.frames" | grep -c 'png$')" = 4 ]
ok [ ! -e "$folder/broken.mp4" ]
"$program" render --tour "$folder/tour.json" --movie "$folder/broken.mp4" --fps 2 --size 32x32 >/dev/null || fail "the movie can't be finished once ffmpeg works"
ok [ "$(count "$folder/broken.mp4")" = 32,32,2/1,4 ]

# Flashes are counted: five in a second are too many, and slow fades are none.
flicker() { # SECONDS: of each step, bright and dark in turn
    printf '{ "scene": "avenue", "steps": [ { "seconds": %s, "cut": { "exposure_ev": 0 } }' "$1"
    for i in $(seq 15); do printf ', { "seconds": %s, "cut": { "exposure_ev": %s } }' "$1" $((i % 2 * -12)); done
    printf ' ] }\n'
}
flicker 0.1 >"$folder/flicker.json"
flicker 1 | sed 's/ "cut": { "exposure_ev": -12 }/ "exposure_ev": -12, "glide": { "look": [0, 0, -1] }/g' >"$folder/fades.json"
said=$("$program" check --flashes "$folder/flicker.json" --layout stereo --out "$folder/flicker.png")
ok [ $? = 1 ]
ok eval '[ "$(printf "%s\n" "$said" | grep -c "^stereo, .* eye: most flashes in a second: general 5.0, over 0.02.* more than allowed")" = 2 ]'
ok eval 'file "$folder/flicker.png" | grep -q "PNG image data"'
said=$("$program" check --flashes "$folder/fades.json" --out "$folder/fades.png")
ok [ $? = 0 ]
ok eval 'printf "%s\n" "$said" | grep -q "this keeps to that limit"'
refused 'does not end in .png' "$program" check --flashes "$folder/flicker.json" --out "$folder/flicker.svg"
refused 'there are: aurora, first-minute' "$program" check --flashes none
refused 'none.jsonl' "$program" check --flashes "$folder/none.jsonl"
refused '--flashes' "$program" check desk --flashes first-minute

echo "$passed checks passed, $failed failed"
[ $failed = 0 ]
