#!/usr/bin/env bash
# Measures Starbow on a graphics card that this machine lacks. `pack` builds programs and packs them, their libraries and all files
# into a folder. There, on a bare x86-64 machine with the card's driver, without a network and within eight minutes, the folder's
# run.sh runs the tests with Vulkan in four parts and `starbow bench --card`, and leaves card.json, card.html, trace.json and the
# tests' results in FOLDER/results (or in RESULTS). DISPLAY: this display of `bench --card` alone, and no tests.
# Usage:    tests/device/run.sh pack FOLDER, then FOLDER/run.sh [RESULTS [DISPLAY]]
# Example:  tests/device/run.sh pack out/device && out/device/run.sh
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

pack() { # FOLDER
    mkdir -p "$1"
    local to
    to=$(cd "$1" && pwd)
    cd "$here/../.."
    . ./prepare
    build build/release "starbow starbow-tools starbow_gpu_test" -DCMAKE_BUILD_TYPE=Release
    local programs=(build/release/starbow build/release/starbow-tools build/release/starbow_gpu_test) stage
    stage=$(mktemp -d)
    # shellcheck disable=SC2064 # the folder of now
    trap "rm -rf '$stage'" EXIT
    mkdir -p "$stage/lib" "$stage/layers"
    git ls-files -z -- . ':!docs' | xargs -0 cp --parents -t "$stage"
    cp --parents -t "$stage" "${programs[@]}"
    cp -r --parents -t "$stage" config/schema
    strip "${programs[@]/#/$stage/}"
    # All libraries but the C library's own, which belong to the machine's kernel and driver.
    local layer=/usr/lib/x86_64-linux-gnu/libVkLayer_khronos_validation.so
    ldd "${programs[@]}" "$layer" | awk '$2 == "=>" && $3 ~ /^\// { print $3 }' | sort -u \
        | grep -vE '/(libc|libm|libdl|librt|libpthread|libresolv|ld-linux[^/]*)\.so' | xargs cp -L -t "$stage/lib"
    cp "$layer" "$stage/lib"
    cp /usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json "$stage/layers"
    tar -C "$stage" -czf "$to/starbow.tar.gz" .
    cp "$here/run.sh" "$to"
    echo "$to: $(du -m "$to/starbow.tar.gz" | cut -f1) MiB; copy it to the card's machine, and run $(basename "$to")/run.sh there"
}

if [ "${1:-}" = pack ] && [ $# = 2 ]; then
    pack "$2"
    exit
elif [ $# -gt 2 ] || [[ ${1:-} == -* ]] || [ ! -e "$here/starbow.tar.gz" ]; then
    sed -n '2,7s/^# //p' "${BASH_SOURCE[0]}" >&2
    exit 2
fi

mkdir -p "${1:-$here/results}"
results=$(cd "${1:-$here/results}" && pwd)
display=${2:-}
most_s=480 tests_s=200
mkdir -p "$here/unpacked"
tar -C "$here/unpacked" -xzf "$here/starbow.tar.gz"
cd "$here/unpacked"
export LD_LIBRARY_PATH=$PWD/lib VK_LAYER_PATH=$PWD/layers STARBOW_SOURCE=$PWD XDG_CACHE_HOME=$PWD/cache
program=build/release/starbow
if ! said=$($program --version 2>&1); then
    echo "the program does not start here: $said" >&2
    exit 2
fi
# Containers have NVIDIA's driver in places of their own.
if ! compgen -G "/usr/share/vulkan/icd.d/*.json" >/dev/null && ! compgen -G "/etc/vulkan/icd.d/*.json" >/dev/null; then
    driver=$(find / -xdev -name nvidia_icd.json -print -quit 2>/dev/null || true)
    [ -z "$driver" ] || export VK_DRIVER_FILES=$driver
fi
$program doctor >"$results/doctor.txt" 2>&1 || true
failed=
if [ -z "$display" ]; then
    echo "the tests with Vulkan, at most $tests_s s"
    parts=()
    for part in 0 1 2 3; do
        GTEST_TOTAL_SHARDS=4 GTEST_SHARD_INDEX=$part timeout $tests_s build/release/starbow_gpu_test --gtest_brief=1 \
            --gtest_output="json:$results/tests-$part.json" >"$results/tests-$part.txt" 2>&1 &
        parts+=($!)
    done
    for part in 0 1 2 3; do
        wait "${parts[$part]}" || { failed=yes && echo "part $part of the tests failed or ran too long: $results/tests-$part.txt" >&2; }
    done
fi
timeout $((most_s - SECONDS)) $program bench --card "$results" ${display:+--display "$display"} || failed=yes
echo "$SECONDS s; the figures are in $results/card.json, a page in card.html"
[ -z "$failed" ]
