// The page without Python of its own: Python runs in a worker, and the explorer's front end shows what it answers.
// The block, the start and the control stand in the address, behind the #.

import explorer from "./explorer.js";

const form = document.getElementById("ask");
const { block, start, control, link } = form.elements;
const button = form.querySelector("button[type=submit]");
const said = document.getElementById("said");
const place = document.getElementById("explorer");

const PAUSE = 300; // ms without a change until the address follows; browsers forbid to write it often

let worker = null;
let pause = null;
let model = null; // of the contour that is shown
let close = null; // ends its front end
let asked = null; // the start and the control of the block that is being opened
let opened = null; // and of the one that is shown
let told = null; // what the address holds
let isReady = false; // whether Python has answered

// What the explorer's front end takes for the widget of a notebook.
class Model {
  constructor(state) {
    this.state = state;
    this.listeners = new Map();
  }

  get(name) {
    return this.state[name];
  }

  set(name, value) {
    this.state[name] = value;
  }

  save_changes() {
    worker?.postMessage({ do: "act", action: this.state.action });
  }

  on(event, listener) {
    this.listeners.set(event, [...(this.listeners.get(event) ?? []), listener]);
  }

  off(event, listener) {
    this.listeners.set(event, (this.listeners.get(event) ?? []).filter((each) => each !== listener));
  }

  tell(changed) {
    Object.assign(this.state, changed);
    for (const name of Object.keys(changed)) for (const listener of this.listeners.get(`change:${name}`) ?? []) listener();
  }
}

const hear = {
  progress: (text) => say(`${text} …`),
  failed: (why) => {
    worker.terminate();
    worker = null;
    button.disabled = false;
    say(`Python could not be loaded: ${why}. Is this computer online, and may it read from there? Then press the button again.`);
  },
  opened: (state) => {
    isReady = true;
    button.textContent = "Solve";
    button.disabled = link.hidden = false;
    block.parentElement.hidden = true; // the explorer has the block now
    close?.();
    model = new Model(state);
    opened = asked;
    close = explorer.render({ model, el: place });
    say("");
    writeAddress();
  },
  changed: (state) => {
    model.tell(state);
    clearTimeout(pause);
    pause = setTimeout(writeAddress, PAUSE);
  },
  refused: (why) => {
    isReady = true;
    button.textContent = "Solve";
    button.disabled = false;
    say(why);
  },
};

function say(text) {
  said.textContent = text;
}

function solve() {
  button.disabled = true;
  say("Solving …");
  if (!worker) {
    worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
    worker.onmessage = ({ data: [kind, value] }) => hear[kind](value);
    worker.onerror = (event) => hear.failed(event.message || "this browser is too old for it");
  }
  if (model && block.value === told?.block) block.value = model.get("view").text; // it may have moved since
  asked = { start: start.value, control: control.value };
  worker.postMessage({ do: "open", text: block.value, ...asked });
}

function writeAddress() {
  // What is shown, and what it was opened with: a start that was typed and not solved yet is not in the link.
  block.value = model.get("view").text;
  told = { block: block.value, ...opened };
  const parts = new URLSearchParams(Object.entries(told).filter(([, value]) => value));
  // A blank is %20, which every program that takes a link reads.
  history.replaceState(null, "", `#${parts.toString().replaceAll("+", "%20")}`);
}

// Whether the address holds a block.
function readAddress() {
  const told = new URLSearchParams(location.hash.slice(1).replaceAll("+", "%2B"));
  if (!told.get("block")) return false;
  block.value = told.get("block");
  start.value = told.get("start") ?? "";
  control.value = told.get("control") ?? "";
  if (control.selectedIndex < 0) control.value = "";
  return true;
}

function followTheme() {
  // The explorer looks at the theme again when this changes.
  document.body.dataset.theme = document.body.dataset.mdColorScheme === "slate" ? "dark" : "light";
}

form.addEventListener("submit", (event) => {
  event.preventDefault();
  if (!button.disabled) solve();
});
block.addEventListener("keydown", (event) => {
  if (event.key !== "Enter" || event.shiftKey) return;
  event.preventDefault();
  form.requestSubmit();
});
link.addEventListener("click", async () => {
  writeAddress();
  try {
    await navigator.clipboard.writeText(location.href);
    say("The link is copied.");
  } catch {
    say("The link stands in the address bar: copy it there.");
  }
});
addEventListener("hashchange", () => readAddress() && solve());
new MutationObserver(followTheme).observe(document.body, { attributes: true, attributeFilter: ["data-md-color-scheme"] });
followTheme();

if (location.protocol === "file:") {
  button.disabled = true;
  say("Browsers start no Python in a page that is opened as a file. Open this page from a web server.");
} else if (readAddress()) solve();
