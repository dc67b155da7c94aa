#!/usr/bin/env bash
# Opening hours: what packaging/exhibit/hours says of each hour of a week, against a table written by hand, and wrong lines.
# Usage: hours_test.sh
set -u
hours=$(dirname "$0")/../../packaging/exhibit/hours
file=$(mktemp)
trap 'rm -f "$file"' EXIT
unset DISPLAY
passed=0
fail() {
    echo "FAILED: $*"
    exit 1
}
says() { # STATE DAY HHMM
    local state
    state=$("$hours" "$file" "$2" "$3") || fail "$2 $3: exit $?"
    [ "$state" = "$1" ] || fail "$2 $3 is $state, not $1"
    passed=$((passed + 1))
}
printf '# of the house\n\nMon 09:00 17:30\nFri 22:00 02:00\nSat 10:00 12:00\nSat 22:00 02:00\nSun 20:00 24:00\nThu 23:00 00:00\n' >"$file"
while read -r day open closed; do
    for time in ${open//,/ }; do [ "$time" = - ] || says on "$day" "$time"; done
    for time in ${closed//,/ }; do says off "$day" "$time"; done
done <<'TABLE'
Mon 0900,1200,1729 0000,0200,0859,1730,2300
Tue - 0000,1200,2359
Wed - 0000,0100,2359
Thu 2300,2359 0000,0159,2259
Fri 2200,2359 0000,0159,2159
Sat 0000,0159,1000,1159,2200,2359 0200,0959,1200,2159
Sun 0000,0159,2000,2359 0200,1959
TABLE
: >"$file"
says on Tue 0300 # without a line it is always open
printf 'Mon 00:00 00:00\n' >"$file"
says off Mon 0000 # and this is never
for wrong in 'Mon 09:00' 'Monday 09:00 17:00' 'Mon 9:00 17:00' 'Mon 09:00 25:00' 'Mon 24:00 02:00' 'Mon 09:00 17:60' 'Mon 09:00 24:30'; do
    printf 'Tue 09:00 17:00\n%s\n' "$wrong" >"$file"
    said=$("$hours" "$file" Tue 1200 2>&1)
    [ $? = 2 ] && [[ $said == "$file:2: \"$wrong\" is not a day with two times; \"Mon 09:00 17:30\" is right" ]] || fail "'$wrong': $said"
    passed=$((passed + 1))
done
echo "$passed passed, 0 failed"
