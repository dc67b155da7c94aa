// The remote's page. Commands, their roles and the names to choose come from the exhibit; so do all words.
"use strict";

const find = (id) => document.getElementById(id);
const all = (selector) => [...document.querySelectorAll(selector)];
const roles = ["look", "docent", "engineer"];
const silent_ms = 4000; // the exhibit's state comes at least once a second
const longest_delay_ms = 15000; // between two tries to connect

let words = {}, language = "en";
let lists = null, grips = [], unkept = 0, role = "look", status = null, serverVersion = "";
let socket = null, delay_ms = 0, retry = 0, lastNews = 0, said = null;
let nextId = 1;
const waiting = new Map(); // by id: the button and the words to say

function remembered(key) {
    try { return localStorage.getItem(key); } catch { return null; }
}
function remember(key, value) {
    try { localStorage.setItem(key, value); } catch { /* a private window */ }
}

// ----- words

function word(key, values = {}) {
    let text = (words[language] || {})[key] || key;
    for (const [name, value] of Object.entries(values))
        text = text.replaceAll(`{${name}}`, value);
    return text;
}

function showNumber(value, digits) {
    return value.toLocaleString(language, { maximumSignificantDigits: digits });
}

// Choices that are no names of files.
const choiceWords = {
    information: { "visitor": "remote.display.visitor", "guide": "remote.display.guide", "laboratory": "remote.display.laboratory" },
    comparison: { "none": "remote.none", "galilean": "remote.galilean", "no-light-delay": "remote.no_light_delay" },
    pattern: {
        "none": "remote.no_pattern", "grid": "remote.grid", "rings": "remote.rings", "names": "remote.names",
        "wedges": "remote.wedges", "overlap": "remote.overlap",
    },
};
const moveSteps = [1, 10, 100];
const exposures = [3, 2.5, 2, 1.5, 1, 0.5, 0, -0.5, -1, -1.5, -2, -2.5, -3]; // EV

function choiceText(kind, name) {
    if (kind === "language" && words[name])
        return words[name]["remote.this_language"];
    const key = (choiceWords[kind] || {})[name];
    if (key)
        return word(key);
    const title = (words[language] || {})[`name.${kind}.${name}`];
    if (title)
        return title;
    const text = name.replaceAll("-", " ");
    return text.charAt(0).toUpperCase() + text.slice(1);
}

// A limit as a docent says it: a part of light's speed, with as many digits as tell it from light's.
function limitText(gamma) {
    if (gamma >= lists["speed-limits"].at(-1))
        return word("remote.no_limit");
    const speed = Math.sqrt((gamma - 1) * (gamma + 1)) / gamma;
    const maximumFractionDigits = Math.max(3, Math.ceil(-Math.log10(1 - speed)));
    return `${speed.toLocaleString(language, { maximumFractionDigits })} c`;
}

function exposureText(ev) {
    return `${ev.toLocaleString(language, { minimumFractionDigits: 1, signDisplay: "exceptZero" })} EV`;
}

// The small picture of a tour, a world or a view; where the exhibit has none, none is shown.
function showThumbnail(place, kind, name) {
    const image = document.querySelector(`[data-thumbnail="${place}"]`), source = name ? `thumbnail/${kind}/${name}` : "";
    if (image.dataset.source === source)
        return;
    image.dataset.source = source;
    image.hidden = true;
    if (source)
        image.src = source;
}

function showChosen() {
    for (const kind of ["tour", "scene", "shot"])
        showThumbnail(kind, kind, find(kind).value);
}

function fillSelect(select, values, textOf) {
    const chosen = select.value;
    select.replaceChildren(...values.map((value) => new Option(textOf(value), value)));
    if (values.map(String).includes(chosen))
        select.value = chosen;
}

function fillWords() {
    document.documentElement.lang = language;
    for (const element of all("[data-word]"))
        element.textContent = word(element.dataset.word);
    for (const element of all("[data-label]"))
        element.setAttribute("aria-label", word(element.dataset.label));
    for (const button of all("#languages button"))
        button.setAttribute("aria-pressed", String(button.lang === language));
    find("role").textContent = word("remote.you_are", { role: word(roleWords[role]) });
    if (lists) {
        for (const select of all("select[data-names]"))
            fillSelect(select, lists.names[select.dataset.names] || [], (name) => choiceText(select.dataset.names, name));
        fillSelect(find("speed-limit"), lists["speed-limits"], limitText);
    }
    fillSelect(find("exposure"), exposures, exposureText);
    fillSelect(find("steps"), moveSteps, (steps) => word("remote.steps_value", { number: String(steps) }));
    showLink();
    showStatus();
}

const roleWords = { look: "remote.role_look", docent: "remote.role_docent", engineer: "remote.role_engineer" };

function chooseLanguage(code) {
    language = code;
    remember("language", code);
    fillWords();
}

// ----- what is shown

function show(name, text) {
    for (const element of all(`[data-show="${name}"]`))
        if (element.textContent !== text)
            element.textContent = text;
}

function duration(seconds) {
    const hours = Math.floor(seconds / 3600), minutes = Math.floor(seconds / 60) % 60;
    return hours > 48 ? word("remote.days", { number: showNumber(Math.floor(hours / 24), 6) })
        : word("remote.hours", { hours: String(hours), minutes: String(minutes) });
}

function clock(seconds) {
    return { minutes: String(Math.floor(seconds / 60)), seconds: String(seconds % 60).padStart(2, "0") };
}

// A sentence about the visit, then the tour's step, then what else is so.
function doesText() {
    const parts = [word(`does.${status.doing}`)];
    if (status.steps > 0)
        parts.push(choiceText("tour", status.tour), word("remote.step", { step: String(status.step), steps: String(status.steps) }),
            word("does.left", clock(status["left-s"])));
    if (status.coming)
        parts.push(word("does.coming", { world: choiceText("scene", status.coming) }));
    for (const [name, key] of [["paused", "does.paused"], ["fade", "does.dark"], ["hold", "does.held"], ["calm", "does.calm"]])
        if (status[name])
            parts.push(word(key));
    return parts.join(" · ");
}

// Of a text in several languages that of the page's, or another.
function inLanguage(texts) {
    return texts[language] || texts.en || Object.values(texts)[0] || "";
}

function showProgramme() {
    const items = lists.programme, { item } = status, now = items[item - 1], then = items[item];
    const title = ({ kind, name }) => choiceText(kind, name);
    find("programme").hidden = items.length === 0 || role === "look";
    if (items.length === 0)
        return;
    show("item", !now ? word("remote.not_begun")
        : `${word("remote.item", { item: String(item), items: String(items.length) })} · ${title(now)}`);
    show("item-time", !now ? ""
        : word("remote.item_time", { ...clock(status["item-s"]), planned: now.minutes.toLocaleString(language) }));
    showThumbnail("item", ...now ? [now.kind, now.name] : ["", ""]);
    show("notes", now ? inLanguage(now.notes) : "");
    show("then", then ? word("remote.then", { item: title(then) }) : "");
    find("item-back").disabled = item <= 1;
    find("item-next").disabled = !then;
}

function showStatus() {
    if (!status || !lists)
        return;
    show("scene", status.shot ? `${choiceText("scene", status.scene)}, ${choiceText("shot", status.shot)}`
        : choiceText("scene", status.scene));
    show("does", doesText());
    const next = inLanguage(status["next-caption"]);
    show("next-caption", next);
    find("coming").hidden = !next;
    showProgramme();
    const digits = status.speed > 0.999 ? 9 : 3;
    show("speed", `${status.speed.toLocaleString(language, { minimumFractionDigits: digits, maximumFractionDigits: digits })} c`);
    show("gamma", status.gamma.toLocaleString(language, { minimumSignificantDigits: 4, maximumSignificantDigits: 4 }));
    if (role === "engineer") {
        show("frames", word("remote.frames_value",
            { rate: showNumber(status["frames-per-s"], 3), ms: showNumber(status["frame-ms"], 3) }));
        show("runs", `${duration(status["uptime-s"])}, ${serverVersion}`);
        show("machines", status.machines || word("remote.one_machine"));
        show("error", status.error || word("remote.no_error"));
        showGrip();
    }
    for (const button of all("[data-switch]")) {
        const name = button.dataset.switch;
        button.setAttribute("aria-pressed", String(Boolean(status[name === "pause" ? "paused" : name])));
    }
    for (const select of all("[data-live]"))
        if (document.activeElement !== select && !select.dataset.sent)
            showChoice(select, select.dataset.live);
    // The choices with a button begin at what is shown, and are left alone from then on.
    for (const select of all("[data-choose]").map((button) => find(button.dataset.choose)))
        if (!select.dataset.begun && status[select.id]) {
            select.value = status[select.id];
            select.dataset.begun = "1";
        }
    find("caption-clear").disabled = !status.caption;
    if (role !== "look")
        showChosen();
}

// The layout's grips, of which the arrows move the chosen one.
function showGrip() {
    const select = find("grip");
    if (select.options.length !== grips.length + 1 || grips.some((name, i) => select.options[i + 1].value !== name))
        fillSelect(select, ["", ...grips], (name) => name || word("remote.no_grip"));
    if (document.activeElement !== select && !select.dataset.sent)
        select.value = status.grip;
    show("grip-says", status["grip-says"]);
    show("unkept", unkept > 0 ? word("remote.unkept", { number: String(unkept) }) : "");
    for (const button of all("[data-move]"))
        button.disabled = !status.grip;
}

function showChoice(select, name) {
    let value = status[name === "speed-limit" ? "max-gamma" : name];
    if (value === undefined || value === "")
        return;
    if (name === "speed-limit") {
        // The exhibit's own limit stands in the list, too.
        const offered = lists["speed-limits"], near = offered.find((limit) => Math.abs(limit / value - 1) < 1e-3);
        if (near === undefined && ![...select.options].some((option) => Number(option.value) === value))
            fillSelect(select, [...offered, value].sort((a, b) => a - b), limitText);
        value = near === undefined ? value : near;
    }
    if (name === "exposure" && ![...select.options].some((option) => Number(option.value) === value))
        fillSelect(select, [...exposures, value].sort((a, b) => b - a), exposureText); // from a script, or the guide's window
    select.value = String(value);
}

function say(text, bad = false) {
    clearTimeout(said);
    find("said").textContent = text;
    find("said").classList.toggle("bad", bad);
    if (!bad)
        said = setTimeout(() => { find("said").textContent = ""; }, 6000);
}

function showLink() {
    const open = socket && socket.readyState === WebSocket.OPEN && lists;
    const silent = open && Date.now() - lastNews > silent_ms;
    const text = !lists ? "" : silent ? word("remote.silent") : open ? word("remote.connected") : word("remote.reconnecting");
    if (find("link").textContent !== text)
        find("link").textContent = text;
    find("link").classList.toggle("bad", Boolean(lists) && (!open || silent));
}

function showRole() {
    for (const element of all("[data-role]"))
        element.hidden = roles.indexOf(element.dataset.role) > roles.indexOf(role);
}

function showPage(page) {
    find("login").hidden = page !== "login";
    find("remote").hidden = page !== "remote";
    if (page === "login")
        find("pin").focus();
}

async function showPicture(blob) {
    const picture = await createImageBitmap(blob);
    const canvas = find("picture");
    canvas.width = picture.width;
    canvas.height = picture.height;
    canvas.getContext("2d").drawImage(picture, 0, 0);
    picture.close();
}

// ----- the connection

function send(message) {
    if (!socket || socket.readyState !== WebSocket.OPEN)
        return 0;
    const id = nextId++;
    socket.send(JSON.stringify({ id, ...message }));
    return id;
}

function command(element, name, value) {
    const id = send({ command: [name, ...(value === undefined ? [] : [value].flat().map(String))] });
    if (!id) {
        say(word("remote.not_connected"), true);
        return;
    }
    element.setAttribute("aria-busy", "true");
    element.dataset.sent = "1";
    const choice = element.dataset.choose && find(element.dataset.choose).selectedOptions[0];
    waiting.set(id, { element, text: choice ? choice.text
        : element.getAttribute("aria-label") || (element.labels && element.labels[0] || element).textContent });
}

function answered({ id, applied, refused }) {
    const sent = waiting.get(id);
    if (!sent)
        return;
    waiting.delete(id);
    settle(sent.element);
    if (sent.quiet && applied)
        return;
    say(applied ? word("remote.done", { command: sent.text })
        : word("remote.refused", { command: sent.text, reason: refused }), !applied);
}

function settle(element) {
    element.removeAttribute("aria-busy");
    delete element.dataset.sent;
}

function received(event) {
    lastNews = Date.now();
    delay_ms = 0;
    if (event.data instanceof Blob) {
        showPicture(event.data).catch(() => {});
        return;
    }
    const message = JSON.parse(event.data);
    if (message.hello) {
        role = message.hello.role;
        serverVersion = message.hello.version;
        showRole();
        fillWords();
        wantPicture();
    } else if (message.status) {
        status = message.status;
        showStatus();
    } else if (message.answer) {
        answered(message.answer);
    } else if (message.log) {
        const log = find("log"), atEnd = log.scrollTop + log.clientHeight > log.scrollHeight - 20;
        log.textContent = message.log.join("\n");
        if (atEnd)
            log.scrollTop = log.scrollHeight;
        grips = message.grips;
        unkept = message.unkept;
    }
    showLink();
}

function wantPicture() {
    if (role !== "look")
        send({ picture: !document.hidden });
}

// The lists come only with a valid login; then the socket is opened. After a failure it is tried again, each time
// after a longer while, so that many tablets do not come back in one moment.
async function connect() {
    clearTimeout(retry);
    let answer;
    try {
        answer = await fetch("/lists");
        if (answer.status === 401) {
            lists = null;
            showLink();
            showPage("login");
            return;
        }
        lists = await answer.json();
        addSwitches();
    } catch {
        later();
        return;
    }
    const old = socket;
    socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/`, "starbow");
    if (old)
        old.close();
    const mine = socket;
    mine.onopen = () => {
        lastNews = Date.now();
        showPage("remote");
        showLink();
    };
    mine.onmessage = (event) => { if (mine === socket) received(event); };
    mine.onclose = () => { if (mine === socket) later(); };
}

function later() {
    socket = null;
    for (const { element } of waiting.values())
        settle(element);
    waiting.clear();
    showLink();
    delay_ms = Math.min(longest_delay_ms, Math.max(500, delay_ms * 2));
    clearTimeout(retry);
    retry = setTimeout(connect, delay_ms * (0.5 + Math.random() / 2));
}

function hurry() {
    wantPicture();
    if (!document.hidden && lists && !socket) {
        delay_ms = 0;
        connect();
    }
}

async function logIn(event) {
    event.preventDefault();
    const pin = find("pin"), error = find("login-error");
    error.textContent = "";
    try {
        const answer = await fetch("/login", { method: "POST", body: JSON.stringify({ pin: pin.value }) });
        pin.value = "";
        if (answer.status === 429) {
            const { locked_s } = await answer.json();
            error.textContent = word("remote.locked", { minutes: String(Math.ceil(locked_s / 60)) });
        } else if (!answer.ok) {
            error.textContent = word("remote.wrong_pin");
        } else {
            await connect();
            return;
        }
    } catch {
        error.textContent = word("remote.not_connected");
    }
    pin.focus();
}

async function logOut() {
    const old = socket;
    socket = null;
    lists = null;
    status = null;
    try {
        await fetch("/logout", { method: "POST" });
    } finally {
        if (old)
            old.close();
        showLink();
        showPage("login");
    }
}

// ----- pointing: a finger, the mouse or the arrow keys on the live picture

const pointer = { down: false, at: [0.5, 0.5], sent: 0, late: 0 };

function point([x, y]) {
    pointer.at = [Math.min(1, Math.max(0, x)), Math.min(1, Math.max(0, y))];
    find("spot").style.left = `${100 * pointer.at[0]}%`;
    find("spot").style.top = `${100 * pointer.at[1]}%`;
    const wait_ms = pointer.sent + 120 - Date.now(); // the exhibit takes at most twenty messages a second
    clearTimeout(pointer.late);
    if (wait_ms > 0) {
        pointer.late = setTimeout(() => point(pointer.at), wait_ms);
        return;
    }
    pointer.sent = Date.now();
    const id = send({ command: ["touch", ...pointer.at.map((part) => part.toFixed(4))] });
    if (!id)
        say(word("remote.not_connected"), true);
    else
        waiting.set(id, { element: find("point"), text: word("remote.pointer"), quiet: true });
    find("spot").hidden = false;
    clearTimeout(pointer.gone);
    pointer.gone = setTimeout(() => { find("spot").hidden = true; }, 4000); // as long as the exhibit shows it
}

function listenToPointing() {
    const pad = find("point");
    const place = (event) => {
        const box = pad.getBoundingClientRect();
        return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    };
    pad.addEventListener("pointerdown", (event) => {
        pad.setPointerCapture(event.pointerId);
        pointer.down = true;
        point(place(event));
    });
    pad.addEventListener("pointermove", (event) => { if (pointer.down) point(place(event)); });
    for (const end of ["pointerup", "pointercancel"])
        pad.addEventListener(end, () => { pointer.down = false; });
    const steps = { ArrowLeft: [-0.02, 0], ArrowRight: [0.02, 0], ArrowUp: [0, -0.02], ArrowDown: [0, 0.02] };
    pad.addEventListener("keydown", (event) => {
        const step = steps[event.key];
        if (!step)
            return;
        event.preventDefault();
        point([pointer.at[0] + step[0], pointer.at[1] + step[1]]);
    });
}

// ----- the page's own elements

function listenToSwitch(button) {
    button.addEventListener("click", () =>
        command(button, button.dataset.switch, button.getAttribute("aria-pressed") === "true" ? "off" : "on"));
}

// A button for each switch that has no place of its own: the effects and the like.
function addSwitches() {
    const placed = (name) => all(`[data-switch="${name}"]`).length > 0;
    const switches = Object.keys(lists.commands).filter((name) => lists.commands[name].value === "on" && !placed(name));
    find("switches").append(...switches.map((name) => {
        const button = document.createElement("button");
        button.type = "button";
        button.dataset.switch = name;
        button.dataset.word = `remote.${name.replaceAll("-", "_")}`;
        listenToSwitch(button);
        return button;
    }));
}

function listen() {
    find("login-form").addEventListener("submit", logIn);
    find("log-out").addEventListener("click", logOut);
    for (const button of all("[data-do]"))
        button.addEventListener("click", () => command(button, button.dataset.do));
    for (const button of all("[data-switch]"))
        listenToSwitch(button);
    for (const button of all("[data-choose]"))
        button.addEventListener("click", () => command(button, button.dataset.choose, find(button.dataset.choose).value));
    for (const select of all("[data-live]")) {
        select.addEventListener("change", () => command(select, select.dataset.live, select.value));
        select.addEventListener("blur", showStatus);
    }
    find("grip").addEventListener("change", () => { if (find("grip").value) command(find("grip"), "grip", find("grip").value); });
    for (const button of all("[data-move]"))
        button.addEventListener("click", () =>
            command(button, "move", button.dataset.move.split(" ").map((step) => step * find("steps").value)));
    listenToPointing();
    for (const image of all("[data-thumbnail]"))
        image.addEventListener("load", () => { image.hidden = false; });
    for (const kind of ["tour", "scene", "shot"])
        find(kind).addEventListener("change", showChosen);
    find("item-back").addEventListener("click", (event) => command(event.currentTarget, "item", status.item - 1));
    find("item-next").addEventListener("click", (event) => command(event.currentTarget, "item", status.item + 1));
    find("caption-show").addEventListener("click", (event) => command(event.currentTarget, "caption", find("caption").value));
    find("caption-clear").addEventListener("click", (event) => command(event.currentTarget, "caption", ""));
    find("restart").addEventListener("click", () => find("sure").showModal());
    find("sure-no").addEventListener("click", () => find("sure").close());
    find("sure-yes").addEventListener("click", () => {
        find("sure").close();
        command(find("restart"), "restart");
    });
    document.addEventListener("visibilitychange", hurry);
    window.addEventListener("online", hurry);
    setInterval(() => {
        showLink();
        if (socket && socket.readyState === WebSocket.OPEN && Date.now() - lastNews > 3 * silent_ms)
            socket.close(); // a connection that nobody has ended, and that has ended all the same
    }, 1000);
}

async function start() {
    try {
        words = await (await fetch("/words")).json();
    } catch {
        setTimeout(start, 2000);
        return;
    }
    const codes = Object.keys(words);
    find("languages").replaceChildren(...codes.map((code) => {
        const button = document.createElement("button");
        button.type = "button";
        button.lang = code;
        button.textContent = words[code]["remote.this_language"];
        button.addEventListener("click", () => chooseLanguage(code));
        return button;
    }));
    const wanted = [remembered("language"), ...navigator.languages.map((name) => name.split("-")[0]), "en", ...codes];
    language = wanted.find((code) => codes.includes(code));
    listen();
    showRole();
    fillWords();
    await connect();
}

start();
