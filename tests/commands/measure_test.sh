#!/usr/bin/env bash
# starbow measure as a builder uses it: a chart and a table, a budget, the cost of a scene's parts, and the extremes. It bears
# any load that is even over some seconds: settings take turns, and the program allows a margin for noise.
# measure_test.sh STARBOW
set -u
starbow=$1
. "$(dirname "$0")/../rig/waiting.sh"
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

# An interrupted measurement continues: it reuses the reference's finished rows and the settings already measured.
small=(--shot starbow --size 240x180 --samples 9 --rounds 5 --out "$work/a")
rows=$work/a/reference-starbow-desk.rows
"$starbow" measure "${small[@]}" >/dev/null 2>&1 &
made() { [ -s "$rows" ] || ! kill -0 $! 2>/dev/null; }
until_true 300 made
kill $! && wait $! 2>/dev/null
check "finished rows of the reference are kept" test -s "$rows"
check "a second run measures all settings" measure "${small[@]}" --budget-ms 1000
cp "$work/said" "$work/table"
check "the table has its header" has "^ *setting," <(head -1 "$work/a/accuracy.csv" | sed 's/^/ /')
check "the table has a row for each setting" test "$(wc -l <"$work/a/accuracy.csv")" -gt 40
check "the chart has a line" has "<polyline" "$work/a/accuracy.svg"
check "the page has the chart" has "<svg" "$work/a/accuracy.html"
check "the page loads nothing from elsewhere" hasnt "\(src\|href\)=" "$work/a/accuracy.html"
check "a quality is chosen for the budget" has "within 1000 ms: " "$work/table"
check "render accepts the chosen quality" timeout 600 "$starbow" render --shot starbow --size 160x120 --quality "$work/a/quality.json" --out "$work/b"
# The program itself allows a margin for noise.
for name in draft balanced fine; do
    check "no setting beats $name in both time and error" hasnt "^$name is beaten" "$work/table"
done
check "the default's errors are small" awk -F, '$1 == "balanced" { ok = $(NF - 2) < 0.01 && $(NF - 1) < 1e-4 } END { exit !ok }' "$work/a/accuracy.csv"
check "the ladder has several levels" test "$(grep -c '"ms"' "$work/a/ladder.json")" -ge 3
check "no quality fits a budget of 0.01 ms" bash -c "! timeout 600 '$starbow' measure --shot starbow --size 64x48 --samples 1 --rounds 1 --settings shipped --out '$work/c' --budget-ms 0.01"

check "explain lists a scene's costs" measure --explain --scene clocks --shot clocks-passing --size 160x120 --rounds 3
cp "$work/said" "$work/explained"
check "explain lists the number of dials" has "clocks, with light delay .* 1 dial" "$work/explained"
check "explain lists unused features" has "what blinks .* nothing blinks" "$work/explained"

if [ -n "${STARBOW_ALL_CASES:-}" ]; then # most of its 40 s are pipelines
    check "slow motions shimmer within their bounds" measure --shimmer --shot starbow --size 160x120 --samples 9 --out "$work/f"
    check "the table of shimmer is written" has "1e-6 c" "$work/f/shimmer.md"
fi
# What has light shows on a dome, and fills at least half of it. The warm wall's court is dark but for the wall.
for layout in dome dome2 stereo; do
    measure --shown --layout $layout --size 128x128 >"$work/shown"
    check "every shot was drawn on $layout" test "$(grep -c '^[a-z].* [01]\.[0-9][0-9]' "$work/shown")" -eq "$(ls "$(dirname "$0")/../../config/shots" | wc -l)"
    check "what has light shows on $layout" awk '/FAILS/ { exit 1 }' "$work/shown"
    check "every shot fills half of $layout" awk '/[01]\.[0-9][0-9]$/ && $4 < 0.5 && $1 !~ /^warm-wall/ { exit 1 }' "$work/shown"
done
check "a shot that is not in the scene is refused" refused "No such shot is in the scene clocks" measure --shown --scene clocks --shot orion
check "a shot of another scene is refused" refused "is in the scene clocks; one in avenue is right" measure --shot clocks-rest --out "$work/d"
check "a missing --out is refused" refused "--out is required here" measure
check "an unknown quality is refused" refused "draft" measure --default none --out "$work/d"
echo '{ "cube_samples": 3 }' >"$work/wrong.json"
check "a quality with a wrong value is refused" refused "/cube_samples: 3 is not a number of samples" "$starbow" render --shot start --quality "$work/wrong.json" --out "$work/d"
check "a refused command writes nothing" test ! -e "$work/d"

check "the extremes are measured" measure --extremes --out "$work/e"
cp "$work/said" "$work/ends"
check "all extremes hold" has "^0 of these fail" "$work/ends"
check "the table of extremes is written" has "30 days" "$work/e/extremes.md"

echo "$checks checks"
exit $failed
