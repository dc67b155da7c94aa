#!/usr/bin/env bash
# The laboratory's commands without a window: papers, open questions, and the class. Usage: lab_test.sh PROGRAM
set -u
program=$1
tests=$(cd "$(dirname "$0")/.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
passed=0 failed=0

fail() {
    failed=$((failed + 1))
    echo "FAILED: $*"
}
ok() { passed=$((passed + 1)); }

# refused TEXT ARGUMENTS...: one line that has TEXT, exit 2, and the folder as it was.
refused() {
    local text=$1 before said status
    shift
    before=$(find "$folder" -type f -exec md5sum {} + | sort)
    said=$(cd "$folder" && "$program" "$@" 2>&1 >/dev/null)
    status=$?
    if [ $status != 2 ] || [ "$(printf '%s\n' "$said" | wc -l)" != 1 ] || [[ $said != *"$text"* ]]; then
        fail "$*: exit $status: $said"
    elif [ "$before" != "$(find "$folder" -type f -exec md5sum {} + | sort)" ]; then
        fail "$*: wrote a file"
    else
        ok
    fi
}

cp "$tests"/lab/*.csv "$folder/"

# The class: the page's figures are those of a computation that shares no code with the program, in both languages.
for language in en de; do
    said=$(cd "$folder" && "$program" class newton.csv einstein.csv noether.csv --out "$language/class.html" --language $language 2>&1)
    if [ $? = 0 ] && [[ $said == "3 groups, "*" lines: the page is $language/class.html, all lines are in $language/class.csv" ]]; then ok; else fail "class: $said"; fi
    said=$(cd "$folder" && python3 "$tests/lab/golden.py" $language/class.html newton.csv einstein.csv noether.csv 2>&1) && ok || fail "golden, $language: $said"
done
# Readings of three invented groups: every statistic is that of a computation that shares no code with the program.
for language in en de; do
    said=$(cd "$folder" && "$program" class hertz.csv kirchhoff.csv noddack.csv --out "$language/readings.html" --language $language 2>&1)
    if [ $? = 0 ] && [[ $said == "3 groups, 117 lines: the page is $language/readings.html, 117 readings are in $language/readings-readings.csv" ]]; then ok; else fail "class of readings: $said"; fi
    said=$(cd "$folder" && PYTHONDONTWRITEBYTECODE=1 python3 "$tests/lab/readings_golden.py" $language/readings.html hertz.csv kirchhoff.csv noddack.csv 2>&1) && ok || fail "readings, $language: $said"
done
[ ! -e "$folder/en/readings.csv" ] && ok || fail "a class of lists has a CSV file of logs"
mkdir "$folder/invented" && PYTHONDONTWRITEBYTECODE=1 python3 "$tests/lab/invent.py" "$folder/invented" && diff -r -q "$folder/invented" "$tests/lab" | grep -q differ && fail "the invented groups differ from those of invent.py" || ok

# The papers.
for language in en de; do
    for reader in student teacher; do
        (cd "$folder" && "$program" lab --sheet $reader --language $language --out $language/$reader.pdf >/dev/null) && [ "$(pdftotext -layout "$folder/$language/$reader.pdf" - | tr -d '\f' | grep -cE '^ *[A-Z][0-9]( |$)')" = 36 ] && [ "$(pdffonts "$folder/$language/$reader.pdf" | tail -n +3 | grep -vc ' yes yes yes ')" = 0 ] && ok || fail "PDF sheet: $reader, $language"
        (cd "$folder" && "$program" lab --sheet $reader --language $language --out $language/$reader.html >/dev/null) && [ "$(grep -c '<tr><td>[A-Z][0-9]</td>' "$folder/$language/$reader.html")" = 36 ] && ok || fail "sheet: $reader, $language"
    done
done
(cd "$folder" && "$program" lab --readings list.csv >/dev/null) && [ "$(wc -l <"$folder/list.csv")" = 37 ] && ok || fail "no list"
refused 'list.csv is there already' lab --readings list.csv
refused 'neither --sheet nor --readings' lab
refused 'ends in neither .html nor .pdf' lab --sheet student --out sheet.odt
mkdir "$folder/nothing"
said=$(PATH=$folder/nothing "$program" lab --sheet student --out "$folder/nothing/sheet.pdf" 2>&1)
[ $? = 2 ] && [[ $said == *"Debian's package weasyprint, installed, is right"* ]] && [ -z "$(ls "$folder/nothing")" ] && ok || fail "a PDF file without weasyprint: $said"
refused 'does not end in .csv' lab --readings list.ods
refused '--sheet' lab --sheet pupil
refused 'the effect brightness is not known; "aberration"' render --shot clocks-rest --effects aberration,brightness --out still
refused '--by-eye' render --reference --by-eye --shot clocks-rest --out still
refused 'list.csv: has no reading' class newton.csv list.csv
printf 'no,quantity,reading,uncertainty\r\nA1,,35.7,0\r\n' >"$folder/sure.csv"
refused 'sure.csv:2: uncertainty: "0" is out of range' class sure.csv

# Another time it is replaced.
(cd "$folder" && "$program" class newton.csv --out en/class.html >/dev/null) && [ "$(sort -u -t, -k1,1 "$folder/en/class.csv" | wc -l)" = 2 ] && ok || fail "class: another time"

# Wrong logs.
: >"$folder/empty.csv"
printf 'date,weather\r\n1,2\r\n' >"$folder/weather.csv"
head -n 1 "$folder/newton.csv" >"$folder/names.csv"
head -c 3000 "$folder/newton.csv" >"$folder/cut.csv"
sed '3s/,[01],[01],[01],/,1,maybe,1,/' "$folder/newton.csv" >"$folder/switch.csv"
head -c 4096 /dev/urandom >"$folder/noise.csv"
mkdir "$folder/sub" "$folder/folder.csv"
cp "$folder/newton.csv" "$folder/sub/newton.csv"
refused 'empty.csv is empty; a log' class newton.csv empty.csv
refused 'weather.csv:1: column 1: "date" is not' class newton.csv weather.csv
refused 'names.csv:1: has the names of a log and no line' class newton.csv names.csv
refused 'cells; a line as starbow run --log writes it' class cut.csv newton.csv
refused 'switch.csv:3: doppler_on: "maybe" is not a switch; 0 or 1 is right' class switch.csv
refused 'noise.csv:1: column 1: ' class noise.csv
refused 'no-such.csv' class newton.csv no-such.csv
refused 'is a folder' class folder.csv
refused 'given twice' class newton.csv ./newton.csv
refused 'logs is required' class
refused 'does not end in .html' class newton.csv --out class.png
refused 'would replace newton.csv' class newton.csv einstein.csv --out newton.html
refused "which is not a class's file" class newton.csv einstein.csv --out noether.html
refused 'no-such' class newton.csv --language no-such
# Groups whose files are called alike have their folders' names.
(cd "$folder" && "$program" class newton.csv sub/newton.csv --out two.html >/dev/null) && grep -q '^sub/newton.csv,' "$folder/two.csv" && grep -q '^newton.csv,' "$folder/two.csv" && ok || fail "class: two files of one name"

# The questions.
[ "$("$program" challenges | wc -l)" = 10 ] && ok || fail "challenges: not ten"
[[ $("$program" challenges slow-clock) != *"Hint 1"* ]] && ok || fail "a hint is open"
said=$("$program" challenges slow-clock --hints 2 --language de)
[[ $said == *"Hinweis 2"* && $said != *"Hinweis 3"* ]] && ok || fail "hints: $said"
(cd "$folder" && "$program" challenges --sheet out/questions.html --language de >/dev/null) && grep -q '<details><summary>Hinweis 3' "$folder/out/questions.html" && ok || fail "no sheet"
said=$(cd "$folder" && "$program" challenges --check noether.csv)
[ "$(grep -c . <<<"$said")" = 10 ] && grep -q '^own-colour *not yet; nearest is line [0-9]*: [0-9.]*°$' <<<"$said" && ok || fail "check: $said"
said=$(cd "$folder" && "$program" challenges own-colour --check einstein.csv)
[ "$said" = 'own-colour    done in line 6: 39.88°; 39.23° ± 1.00° is right' ] && ok || fail "check: $said"
refused 'there are: slow-clock, own-colour' challenges no-such
refused 'weather.csv:1: ' challenges --check weather.csv
refused 'empty.csv is empty' challenges --check empty.csv
refused '--hints' challenges slow-clock --hints 4
refused '--hints' challenges --hints 1

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
