#!/usr/bin/env bash
# The remote under load: 200 pages at ten states a second, and twenty commands a second, beside a frame thread that works 10 of its
# 16.7 ms. It takes some minutes, so ./test leaves it out. Usage: load_test.sh REMOTE_STAGE [PAIRS_OF_PHASES]
set -eu
stage=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
printf '{ "remote": { "port": 18090, "pins": "pins" } }\n' > "$folder/exhibit.json"
(umask 027 && printf 'docent 222222\n' > "$folder/pins")
cd "$(dirname "$0")/../.." # the page's files lie above the current folder
STATE_DIRECTORY="$folder/state" python3 tests/remote/load.py "$stage" "$folder/exhibit.json" "${2:-10}"
