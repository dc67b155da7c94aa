#!/bin/sh
# Draws docs/remote.png again: the remote's page of a running exhibit in Chromium. From the repository's root, with the packages
# chromium, npm, xvfb, xauth and imagemagick, and the network:
#
#     docs/remote.sh build/release/starbow
set -eu
program=$(realpath "$1") here=$(pwd) folder=$(mktemp -d)
trap 'pkill -f "$folder/exhibit.json" || true; rm -rf "$folder"' EXIT
cp tests/remote/package.json "$folder/"
npm install --prefix "$folder" --no-audit --no-fund --silent
echo '{ "tour": "first-minute", "programme": "evening", "remote": { "port": 18081, "pins": "pins" } }' >"$folder/exhibit.json"
(umask 077 && printf 'look 111111\ndocent 222222\nengineer 333333\n' >"$folder/pins")
XDG_STATE_HOME=$folder/state xvfb-run -a -s '-screen 0 960x540x24' "$program" run --exhibit "$folder/exhibit.json" >"$folder/log" 2>&1 &
cat >"$folder/picture.mjs" <<'END'
import { chromium } from "playwright-core";
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
const page = await (await browser.newContext({ viewport: { width: 1024, height: 900 }, locale: "en-GB" })).newPage();
for (let tries = 0; tries < 120; ++tries)
    try {
        await page.goto("http://127.0.0.1:18081/");
        break;
    } catch {
        await new Promise((after) => setTimeout(after, 1000));
    }
await page.fill("#pin", "222222");
await page.keyboard.press("Enter");
await page.waitForFunction(() => document.querySelector('[data-show="next-caption"]').textContent !== "", null, { timeout: 120000 });
await page.waitForTimeout(8000);
await page.screenshot({ path: process.argv[2], fullPage: true });
await browser.close();
END
(cd "$folder" && node picture.mjs "$folder/page.png")
convert "$folder/page.png" -colors 128 "$here/docs/remote.png"
