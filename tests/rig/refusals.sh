# Sourced by tests of the command line: refused, begins_with and fail count in `passed` and `failed`. The script that sources it sets
# `program`, and `folder`, an empty folder.
passed=0 failed=0

fail() {
    failed=$((failed + 1))
    echo "FAILED: $*"
}

# refused TEXT ARGUMENTS...: the program must print one line that has TEXT, exit with 2 and write nothing.
refused() {
    local text=$1 said status
    shift
    said=$("$program" "$@" --out "$folder/out" 2>&1 >/dev/null)
    status=$?
    if [ $status != 2 ]; then
        fail "$*: exit $status, not 2: $said"
    elif [ "$(printf '%s\n' "$said" | wc -l)" != 1 ]; then
        fail "$*: more than one line: $said"
    elif [[ $said != *"$text"* ]]; then
        fail "$*: '$text' is missing in: $said"
    elif [ -e "$folder/out" ]; then
        fail "$*: wrote a file"
        rm -rf "$folder/out"
    else
        passed=$((passed + 1))
    fi
}

# The message for a misspelt or superfluous word begins with the text, which lists the right ones.
begins_with() { # TEXT ARGUMENTS...
    local text=$1 said
    shift
    said=$("$program" "$@" 2>&1 >/dev/null)
    if [ $? = 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" = 1 ] && [[ $said == "starbow: $text"* ]]; then passed=$((passed + 1)); else fail "'$*' does not begin with '$text': $said"; fi
}
