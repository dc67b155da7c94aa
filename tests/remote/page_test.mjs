// page_test.sh starts this: node page_test.mjs REMOTE_STAGE EXHIBIT.json FOLDER_OF_SCREENSHOTS
import { spawn } from "node:child_process";
import { once } from "node:events";
import fs from "node:fs";
import http from "node:http";
import { createRequire } from "node:module";
import { chromium } from "playwright-core";

const [program, exhibit, shots] = process.argv.slice(2);
const url = "http://127.0.0.1:18080/";
const pins = { look: "111111", docent: "222222", engineer: "333333" };
const sizes = [[360, 740], [768, 1024], [1280, 800]];
let checks = 0, failures = 0, stage = null;

function check(right, what) {
    ++checks;
    if (!right) {
        ++failures;
        console.log(`FAILED: ${what}`);
    }
}

async function startStage() {
    stage = spawn(program, [exhibit], { stdio: ["ignore", "pipe", "ignore"] });
    for await (const text of stage.stdout)
        if (String(text).includes("page "))
            return;
}

async function stopStage() {
    stage.kill("SIGTERM");
    await once(stage, "exit");
}

// One request outside the browser, which would not send these headers.
function ask(path, headers = {}, method = "GET", body = "") {
    return new Promise((resolve, reject) => {
        const request = http.request(url + path.slice(1), { method, headers }, (answer) => {
            answer.resume();
            answer.on("end", () => resolve(answer.statusCode));
        });
        request.on("upgrade", (answer, socket) => { socket.destroy(); resolve(101); });
        request.on("error", reject);
        request.end(body);
    });
}

const upgrade = { Connection: "Upgrade", Upgrade: "websocket", "Sec-WebSocket-Version": "13",
    "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==", "Sec-WebSocket-Protocol": "starbow" };

async function testStrangers() {
    check(await ask("/") === 200, "the page is there");
    check(await ask("/", { Host: "evil.example" }) === 421, "a foreign Host is refused");
    check(await ask("/", { Host: "127.0.0.1" }) === 421, "a Host without the port is refused");
    check(await ask("/", { Origin: "http://evil.example" }) === 403, "a foreign Origin is refused");
    check(await ask("/lists") === 401, "no cookie, no lists");
    check(await ask("/lists", { Cookie: `starbow=${"0".repeat(32)}` }) === 401, "a wrong cookie is refused");
    check(await ask("/", { ...upgrade, Origin: url.slice(0, -1) }) === 401, "no cookie, no socket");
    check(await ask("/", { ...upgrade, Origin: "http://evil.example" }) === 403, "a foreign page gets no socket");
    check(await ask("/", upgrade) === 403, "a socket without Origin is refused");
    check(await ask("/login", {}, "POST", '{"pin":"222222"}') === 403, "a login without Origin is refused");
    check(await ask("/login", { Origin: "http://evil.example" }, "POST", '{"pin":"222222"}') === 403, "a foreign page logs nobody in");
}

async function open(browser, [width, height], locale) {
    const context = await browser.newContext({ viewport: { width, height }, locale });
    const page = await context.newPage();
    page.on("console", (message) => {
        // The page learns from a 401 that it must show the login.
        if (message.type() === "error" && !/401|429|Failed to load resource|WebSocket connection/.test(message.text()))
            check(false, `console: ${message.text()}`);
    });
    page.on("pageerror", (error) => check(false, `script: ${error}`));
    await page.goto(url);
    await page.waitForSelector("#login:not([hidden])");
    return { context, page };
}

async function logIn(page, role) {
    await page.fill("#pin", pins[role]);
    await page.keyboard.press("Enter");
    await page.waitForSelector("#remote:not([hidden])");
    await page.waitForFunction(() => document.querySelector('[data-show="scene"]').textContent !== "");
    await page.waitForTimeout(role === "look" ? 100 : 1600); // for a live picture
}

async function testAccessibility(page, where) {
    const axe = createRequire(import.meta.url).resolve("axe-core");
    await page.evaluate(fs.readFileSync(axe, "utf8")); // the page's own policy lets no other script in
    const result = await page.evaluate(() => axe.run());
    check(result.violations.length === 0,
        `axe-core ${where}: ${result.violations.map((one) => `${one.id} (${one.nodes.map((node) => node.target).join(", ")})`).join("; ")}`);
    check(result.passes.length > 15, `axe-core ${where} has looked at the page`);
}

async function testWidth(page, where) {
    const wide = await page.evaluate(() => [...document.querySelectorAll("main:not([hidden]) *")].filter((one) => {
        const box = one.getBoundingClientRect();
        return box.width > 0 && (box.right > innerWidth - 8 || one.scrollWidth > one.clientWidth + 2 && one.matches("button,label,dt,h2"));
    }).map((one) => `${one.tagName} ${one.textContent.slice(0, 30)}`));
    check(wide.length === 0, `${where}: something is too wide: ${wide.join("; ")}`);
    check(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${where}: no scrolling sideways`);
    const broken = await page.evaluate(() => [...document.querySelectorAll("button, .button, label, dt, h2")].flatMap((one) => {
        const text = one.firstChild, found = [];
        for (const { 0: word, index } of text && text.nodeType === 3 ? text.data.matchAll(/[^\s-]+/g) : []) {
            const range = document.createRange();
            range.setStart(text, index);
            range.setEnd(text, index + word.length);
            if (range.getClientRects().length > 1)
                found.push(word);
        }
        return found;
    }));
    check(broken.length === 0, `${where}: a word is broken: ${broken.join(", ")}`);
    const small = await page.evaluate(() => [...document.querySelectorAll("button, select, input, .button, summary")]
        .map((one) => [one, one.getBoundingClientRect()]).filter(([, box]) => box.width > 0 && (box.height < 44 || box.width < 44))
        .map(([one]) => one.id || one.textContent));
    check(small.length === 0, `${where}: too small for a finger: ${small.join(", ")}`);
}

async function testWords(page, where) {
    const bare = await page.evaluate(() => document.body.innerText.match(/remote\.[a-z_]+|\{\w+\}|undefined|NaN/g));
    check(!bare, `${where}: not a word: ${bare}`);
}

async function testLooks(browser) {
    for (const size of sizes)
        for (const locale of ["en-GB", "de-DE"]) {
            const { context, page } = await open(browser, size, locale);
            const language = locale.slice(0, 2), where = `${size[0]} ${language}`;
            check(await page.evaluate(() => document.documentElement.lang) === language, `${where}: the browser's language`);
            await testAccessibility(page, `${where} login`);
            await testWidth(page, `${where} login`);
            if (shots)
                await page.screenshot({ path: `${shots}/login-${size[0]}-${language}.png` });
            for (const role of ["look", "docent", "engineer"]) {
                if (role !== "look") {
                    await page.click("#log-out");
                    await page.waitForSelector("#login:not([hidden])");
                }
                await logIn(page, role);
                await testAccessibility(page, `${where} ${role}`);
                await testWidth(page, `${where} ${role}`);
                await testWords(page, `${where} ${role}`);
                if (shots)
                    await page.screenshot({ path: `${shots}/${role}-${size[0]}-${language}.png`, fullPage: true });
            }
            await context.close();
        }
}

async function testRoles(browser) {
    const { context, page } = await open(browser, sizes[1], "en-GB");
    await logIn(page, "look");
    check(!await page.isVisible('[data-do="stop"]'), "look has no stop");
    check(!await page.isVisible("#picture"), "look has no picture");
    // A command from a role that may not give it, past the page's own elements.
    const answer = await page.evaluate(() => new Promise((resolve) => {
        const other = new WebSocket(`ws://${location.host}/`, "starbow");
        other.onopen = () => other.send('{"id":5,"command":["stop"]}');
        other.onmessage = ({ data }) => { const { answer } = JSON.parse(data); if (answer) resolve(answer); };
    }));
    check(answer.applied === false && answer.refused.includes("not for the role look"), "look may not stop");
    await page.click("#log-out");
    await page.waitForSelector("#login:not([hidden])");
    check(await page.evaluate(async () => (await fetch("/lists")).status) === 401, "a token ends with its login");
    await logIn(page, "docent");
    check(await page.isVisible('[data-do="stop"]') && !await page.isVisible("#restart"), "a docent stops, and does not restart");
    check(await page.evaluate(async () => (await fetch("/metrics")).status) === 200, "metrics are there for this machine");
    check(await page.evaluate(() => document.cookie) === "", "no script sees the token");
    await context.close();
}

async function testCommands(browser) {
    const { context, page } = await open(browser, sizes[2], "en-GB");
    await logIn(page, "engineer");
    const shows = (name, text) => page.waitForFunction(([name, text]) =>
        document.querySelector(`[data-show="${name}"]`).textContent.includes(text), [name, text], { timeout: 3000 })
        .then(() => check(true, ""), () => check(false, `${name} does not show ${text}`));
    await page.click('[data-switch="fade"]');
    await shows("does", "the picture is dark");
    check(await page.getAttribute('[data-switch="fade"]', "aria-pressed") === "true", "fade is pressed");
    await page.click('[data-switch="fade"]');
    await page.selectOption("#tour", "rainbow");
    await page.click('[data-choose="tour"]');
    await shows("does", "A tour is running · The rainbow · step 1 of 12 · 0:42 left");
    await shows("next-caption", "Soon we fly past it");
    await page.click('#languages button[lang="de"]');
    await shows("next-caption", "Gleich fliegen wir");
    await page.click('#languages button[lang="en"]');
    await page.waitForFunction(() => document.getElementById("said").textContent === "The rainbow: done");
    await page.click('[data-do="next"]');
    await shows("does", "step 2");
    await page.click('[data-switch="pause"]');
    await shows("does", "paused");
    await page.selectOption("#scene", "twins");
    await page.click('[data-choose="scene"]');
    await shows("scene", "The twins");
    await page.selectOption("#language", "de");
    await page.waitForFunction(() => document.getElementById("said").textContent.includes("done"));
    await page.fill("#caption", "Grüße ☺");
    await page.click("#caption-show");
    await page.waitForFunction(() => !document.getElementById("caption-clear").disabled);
    await page.fill("#caption", "x".repeat(500));
    await page.click("#caption-show");
    await page.waitForFunction(() => document.getElementById("said").textContent.includes(" refused: "));
    await page.click('[data-do="reset"]');
    await shows("scene", "The avenue");
    const bright = await page.evaluate(() => {
        const canvas = document.getElementById("picture");
        return [canvas.width, canvas.getContext("2d").getImageData(240, 200, 1, 1).data[2] > 60];
    });
    check(bright[0] === 480 && bright[1], `a live picture is drawn: ${bright}`);
    const box = await page.locator("#picture").boundingBox();
    check(Math.abs(box.width / box.height - 480 / 270) < 0.01, "the live picture has its own shape");
    check(await page.isDisabled("#item-back"), "before the first item there is none");
    await page.click("#item-next");
    await shows("item", "item 1 of 6 · The avenue, as visits begin");
    await page.click("#item-next");
    await shows("item", "item 2 of 6 · The first minute");
    await shows("notes", "Let the audience vote");
    await shows("then", "Then: A ride through the street");
    await page.evaluate(() => scrollTo(0, 0)); // else the first row of buttons lies over the picture
    const pad = await page.locator("#point").boundingBox();
    await page.mouse.move(pad.x + 0.25 * pad.width, pad.y + 0.5 * pad.height);
    await page.mouse.down();
    await page.mouse.move(pad.x + 0.75 * pad.width, pad.y + 0.5 * pad.height, { steps: 40 });
    await page.mouse.up();
    const spot = await page.evaluate(() => [document.getElementById("spot").hidden, parseFloat(document.getElementById("spot").style.left)]);
    check(!spot[0] && Math.abs(spot[1] - 75) < 1, `the pointer follows the finger: ${spot}`);
    check(!await page.evaluate(() => document.getElementById("said").classList.contains("bad")), "no message of a drag is refused");
    await page.focus("#point");
    await page.keyboard.press("ArrowLeft");
    check(Math.abs(await page.evaluate(() => parseFloat(document.getElementById("spot").style.left)) - 73) < 1, "arrow keys point, too");
    check(await page.isDisabled('[data-move="1 0"]'), "without a grip no arrow moves");
    await page.selectOption("#grip", "left, upper left corner");
    await shows("grip-says", "0.9, 0.1");
    await page.selectOption("#steps", "10");
    await page.click('[data-move="-1 0"]');
    await shows("grip-says", "-10 and 0");
    await page.click('[data-move="0 1"]');
    await shows("grip-says", "0 and 10");
    await shows("unkept", "Not in the file yet: 1");
    await page.click('[data-switch="as-saved"]');
    await page.waitForFunction(() => document.querySelector('[data-switch="as-saved"]').getAttribute("aria-pressed") === "true");
    await page.click("#restart");
    await page.click("#sure-no");
    check(!await page.isVisible("#sure"), "a restart can be thought over");
    await context.close();
}

async function testKeyboard(browser) {
    const { context, page } = await open(browser, sizes[0], "de-DE");
    await page.keyboard.type(pins.docent); // the field has the focus
    await page.keyboard.press("Enter");
    await page.waitForSelector("#remote:not([hidden])");
    await page.waitForTimeout(500);
    const visited = [];
    for (let i = 0; i < 60; ++i) {
        await page.keyboard.press("Tab");
        const at = await page.evaluate(() => {
            const one = document.activeElement, style = getComputedStyle(one), box = one.getBoundingClientRect();
            const over = document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
            return { name: one.id || one.dataset.switch || one.dataset.do || one.dataset.choose && `go-${one.dataset.choose}`
                || one.lang || one.tagName, ring: style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 2,
                seen: over === one || one.contains(over) || one === document.body };
        });
        if (at.name === "BODY")
            break;
        visited.push(at.name);
        check(at.ring, `${at.name} shows the focus`);
        check(at.seen, `${at.name} is not hidden while it has the focus`);
        if (at.name === "fade")
            await page.keyboard.press("Space");
        if (at.name === "stop")
            await page.waitForFunction(() => document.querySelector('[data-switch="fade"]').getAttribute("aria-pressed") === "true");
        if (at.name === "scene")
            await page.keyboard.press("End"); // the last one in the list
        if (at.name === "go-scene")
            await page.keyboard.press("Enter");
    }
    for (const name of ["fade", "stop", "reset", "point", "item-next", "tour", "go-tour", "back", "pause", "next", "scene", "go-scene", "shot", "go-shot",
        "hold", "speed-limit", "exposure", "language", "aberration", "doppler", "headlight", "false-colours", "range", "sky-names", "slow-motion", "one-button", "left-handed", "information", "comparison", "caption",
        "caption-show", "log-out"])
        check(visited.includes(name), `Tab reaches ${name}`);
    check(visited.indexOf("fade") < visited.indexOf("tour") && visited.indexOf("fade") >= 0, "fade comes before the tours");
    await page.waitForFunction(() => document.querySelector('[data-show="scene"]').textContent === "Der warme Hof", undefined, { timeout: 3000 })
        .then(() => check(true, ""), () => check(false, "Enter goes to a world"));
    await context.close();
}

async function testReconnection(browser) {
    const { context, page } = await open(browser, sizes[0], "en-GB");
    await logIn(page, "docent");
    await stopStage();
    await page.waitForFunction(() => document.getElementById("link").textContent.includes("reconnecting"));
    await page.click('[data-do="stop"]');
    check((await page.textContent("#said")).includes("No connection"), "a press without a connection is not lost in silence");
    await page.waitForTimeout(3000);
    await startStage();
    await page.waitForFunction(() => document.getElementById("link").textContent === "Connected", undefined, { timeout: 16000 });
    check(await page.isVisible("#remote"), "the login outlasts a restart");
    await page.click('[data-do="stop"]');
    await page.waitForFunction(() => document.getElementById("said").textContent.includes("done"));
    await context.close();
}

async function testWrongPins(browser) {
    const { context, page } = await open(browser, sizes[0], "en-GB");
    for (let i = 1; i <= 5; ++i) {
        await page.fill("#pin", "999999");
        await page.keyboard.press("Enter");
        await page.waitForFunction(() => document.getElementById("login-error").textContent !== "");
        check((await page.textContent("#login-error")).includes(i < 5 ? "wrong" : "5 min"), `wrong PIN ${i}`);
    }
    await page.fill("#pin", pins.docent);
    await page.keyboard.press("Enter");
    await page.waitForTimeout(500);
    check(await page.isVisible("#login"), "the right PIN is of no use while logins are refused");
    await context.close();
}

await startStage();
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
for (const test of [testStrangers, testLooks, testRoles, testCommands, testKeyboard, testReconnection, testWrongPins])
    try {
        const start = Date.now();
        await test(browser);
        console.log(`${test.name}: ${((Date.now() - start) / 1000).toFixed(1)} s`);
    } catch (error) {
        check(false, `${test.name}: ${error}`);
    }
await browser.close();
await stopStage();
console.log(`${checks - failures} of ${checks} checks passed`);
process.exit(failures ? 1 : 0);
