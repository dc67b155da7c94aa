#!/usr/bin/env bash
# Runs clang-tidy on the C++ files that differ from a git base, with the checks in .clang-tidy. Exits with 1 if it finds
# something.
# Usage: tests/tidy.sh [BASE] [-- FILE...]     tests/tidy.sh main; tests/tidy.sh HEAD -- input/hid.cpp
# BASE is HEAD~1 by default. Files after -- replace the differing ones. STARBOW_BUILD names a configured build folder.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if ! command -v clang-tidy >/dev/null; then
    echo "clang-tidy is not installed, so nothing is checked; Debian's package is clang-tidy."
    exit 0
fi
base=HEAD~1
if [ $# -gt 0 ] && [ "$1" != -- ]; then
    base=$1
    shift
fi
if [ "${1:-}" = -- ]; then
    shift
    files=("$@")
elif git rev-parse --verify --quiet "$base^{commit}" >/dev/null; then
    mapfile -t files < <(git diff --name-only --diff-filter=d "$base" -- '*.cpp')
else
    echo "$base is not a commit of this repository; a branch, a tag or a commit is right." >&2
    exit 2
fi
if [ ${#files[@]} = 0 ]; then
    echo "No C++ file differs from $base."
    exit 0
fi

# Without unity builds and without precompiled headers: GCC makes those, and clang can't read them.
build=${STARBOW_BUILD:-build/tidy}
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >/dev/null
if printf '%s\n' "${files[@]}" | grep -qE '^runtime/(render|exhibit|commands)/|_gpu_test'; then
    ninja -C "$build" spirv >/dev/null # headers that these files include
fi
printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -n 1 clang-tidy -p "$build" --quiet --warnings-as-errors='*' 2> >(grep -vE \
    'warnings?( and [0-9]+ errors?)? generated|^Suppressed|^Use -header-filter|treated as error' >&2 || true)
echo "${#files[@]} files, nothing found."
