#!/usr/bin/env bash
# The remote's page in Chromium: PINs, roles, keyboard, widths, languages, axe-core, a connection that comes back. It needs the Debian
# packages chromium and npm and the network, so ./test leaves it out. Usage: page_test.sh REMOTE_STAGE [FOLDER_OF_SCREENSHOTS]
set -eu
stage=$(realpath "$1")
shots=${2:-}
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$here/package.json" "$here/page_test.mjs" "$folder/"
npm install --prefix "$folder" --no-audit --no-fund --silent
printf '{ "programme": "evening", "remote": { "port": 18080, "pins": "pins" } }\n' > "$folder/exhibit.json"
(umask 027 && printf 'look 111111\ndocent 222222\nengineer 333333\n' > "$folder/pins")
[ -z "$shots" ] || { mkdir -p "$shots" && shots=$(realpath "$shots"); }
cd "$here/../.." # the page's files lie above the current folder
STATE_DIRECTORY="$folder/state" node "$folder/page_test.mjs" "$stage" "$folder/exhibit.json" "$shots"
