#!/usr/bin/env bash
# starbow measure as a builder uses it: a chart and a table, a budget, what a scene asks for, and the ends of everything.
# measure_test.sh STARBOW
set -u
starbow=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
checks=0
# check NAME COMMAND...: the command must succeed.
check() {
    checks=$((checks + 1))
    local name=$1
    shift
    if ! "$@" >"$work/said" 2>&1; then
        echo "FAILED: $name"
        sed 's/^/    /' "$work/said" | head -20
        failed=1
    fi
}
has() { grep -q -e "$1" "$2"; }
hasnt() { ! has "$@"; }
refused() { # TEXT COMMAND...: exit status 2 and one line with the text
    local text=$1
    shift
    "$@" >"$work/out" 2>"$work/err"
    [ $? -eq 2 ] && [ "$(wc -l <"$work/err")" -eq 1 ] && has "$text" "$work/err"
}
measure() { timeout 300 "$starbow" measure "$@"; }

# Interrupted early, then begun again: the finished rows of the reference and the settings that were measured count.
small=(--shot starbow --size 240x180 --samples 9 --rounds 5 --out "$work/a")
timeout 4 "$starbow" measure "${small[@]}" >/dev/null 2>&1
check "what was done is kept" test -s "$work/a/reference-starbow-desk.rows"
check "all settings" measure "${small[@]}" --budget-ms 1000
cp "$work/said" "$work/table"
check "table" has "^ *setting," <(head -1 "$work/a/accuracy.csv" | sed 's/^/ /')
check "one row a setting" test "$(wc -l <"$work/a/accuracy.csv")" -gt 40
check "chart" has "<polyline" "$work/a/accuracy.svg"
check "page" has "<svg" "$work/a/accuracy.html"
check "page needs no network" hasnt "\(src\|href\)=" "$work/a/accuracy.html"
check "a budget's choice" has "within 1000 ms: " "$work/table"
check "that render takes" timeout 60 "$starbow" render --shot starbow --size 160x120 --quality "$work/a/quality.json" --out "$work/b"
# Margins for noise are in the command.
for name in draft balanced fine; do
    check "$name is not beaten" hasnt "^$name is beaten" "$work/table"
done
check "the default looks where it should" awk -F, '$1 == "\"balanced\"" { ok = $(NF - 2) < 0.01 && $(NF - 1) < 1e-4 } END { exit !ok }' "$work/a/accuracy.csv"
check "a ladder of several levels" test "$(grep -c '"ms"' "$work/a/ladder.json")" -ge 3
check "nothing within no time" bash -c "! timeout 100 '$starbow' measure --shot starbow --size 64x48 --samples 1 --rounds 1 --settings shipped --out '$work/c' --budget-ms 0.01"

check "what a scene asks for" measure --explain --scene clocks --shot clocks-passing --size 160x120 --rounds 3
cp "$work/said" "$work/explained"
check "and why" has "clocks, with light delay .* 1 dial" "$work/explained"
check "and what is off" has "what blinks .* nothing blinks" "$work/explained"

check "a shot of another scene" refused "is in the scene clocks; one in avenue is right" measure --shot clocks-rest --out "$work/d"
check "no folder" refused "--out is required here" measure
check "an unknown quality" refused "draft" measure --default none --out "$work/d"
echo '{ "cube_samples": 3 }' >"$work/wrong.json"
check "a wrong quality" refused "/cube_samples: 3 is no number of samples" "$starbow" render --shot start --quality "$work/wrong.json" --out "$work/d"
check "nothing was written" test ! -e "$work/d"

check "the ends of everything" measure --extremes --out "$work/e"
cp "$work/said" "$work/ends"
check "all hold" has "^0 of these fail" "$work/ends"
check "their table" has "30 days" "$work/e/extremes.md"

echo "$checks checks"
exit $failed
