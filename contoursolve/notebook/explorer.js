// The explorer's front end. It shows what Python says and sends what the reader does; between two answers it moves what
// is drawn along the derivatives that came with the last one, and works nothing else out.
// Texts are set as text, never as HTML; the picture is parsed as XML and comes from contoursolve's own painter.

const QUIET = 250; // ms without an action after which ranges are asked for
const SILENT = 2000; // ms without an answer after which the reader is told
const SETTLED = 700; // ms without a key after which the picture is fitted
const GLIDE = 200; // ms in which a picture is fitted
const COARSE = 2; // pixels between round numbers
const CATCH = 6; // pixels from which a value of interest catches
const [LETTER, LINE] = [3.6, 14]; // pixels: half a letter, and from one line to the next
const FAST = 10; // steps of a page key
const SVG = "http://www.w3.org/2000/svg";
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1], PageUp: [0, -FAST], PageDown: [0, FAST] };
const GONE = new Set(["dead", "terminating", "restarting", "autorestarting"]);
const IDLE = new Set(["range", "ghost", "section"]); // actions that nobody waits for
const SECTIONS = { equations: "The equations", calculation: "The calculation by hand" };
const FOCUSED = "button:not(:disabled), pre[tabindex], summary, [role=group][tabindex]";
const NAMES = ["word", "point", "element", "finding"];

function make(kind, properties = {}, ...children) {
  const element = document.createElement(kind);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null) continue;
    if (name === "text") element.textContent = value;
    else if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child));
  return element;
}

function draw(kind, properties, text) {
  const element = document.createElementNS(SVG, kind);
  for (const [name, value] of Object.entries(properties)) element.setAttribute(name, value);
  if (text !== undefined) element.textContent = text;
  return element;
}

function button(text, action, properties = {}) {
  return make("button", { type: "button", text, onclick: action, ...properties });
}

function picture(svg) {
  if (!svg) return null;
  const root = new DOMParser().parseFromString(svg, "image/svg+xml").documentElement;
  return root.localName === "svg" ? document.importNode(root, true) : null;
}

function page(html) {
  // Made by Python, with every text escaped; what is parsed so runs nothing.
  return document.importNode(new DOMParser().parseFromString(html, "text/html").body, true).childNodes;
}

function isDark(element) {
  // The colour that text has here tells the theme of any notebook, also from inside a shadow root.
  const numbers = getComputedStyle(element).color.match(/[\d.]+/g);
  if (!numbers) return false;
  const [red, green, blue] = numbers.map(Number);
  return 0.299 * red + 0.587 * green + 0.114 * blue > 140;
}

// Numbers ----------------------------------------------------------------------------------------------------

const minus = (a, b) => [a[0] - b[0], a[1] - b[1]];
const size = (a) => Math.hypot(a[0], a[1]);
const tidy = (value) => Number(value.toFixed(6)) + 0;

function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((each) => each * power).find((each) => each >= least * 0.999999);
}

function shift(place, slopes, steps) {
  // Where a place is when words have changed by so many units.
  let [x, y] = place;
  for (const [key, by] of Object.entries(steps)) {
    const slope = slopes[key];
    if (slope) [x, y] = [x + slope[0] * by, y + slope[1] * by];
  }
  return [x, y];
}

function pathOf(element, steps) {
  const [start, end, center] = element.places.map((place, number) => shift(place, element.slopes[number], steps));
  const from = `M${start[0]},${start[1]}`;
  if (!element.turn) return `${from}L${end[0]},${end[1]}`;
  const radius = size(minus(start, center));
  const angle = (at) => Math.atan2(at[1] - center[1], at[0] - center[0]);
  const swept = ((angle(end) - angle(start)) * element.turn + 4 * Math.PI) % (2 * Math.PI);
  return `${from}A${radius},${radius} 0 ${swept > Math.PI ? 1 : 0} ${element.turn > 0 ? 1 : 0} ${end[0]},${end[1]}`;
}

function stepsTo(handle, at, target) {
  // By how much the words of a handle change so that it comes as near to a place as they bring it.
  const keys = Object.keys(handle.moves);
  const way = minus(target, at);
  const [a, b] = keys.map((key) => handle.moves[key]);
  if (keys.length === 1) return { [keys[0]]: (way[0] * a[0] + way[1] * a[1]) / (a[0] ** 2 + a[1] ** 2) };
  const determinant = a[0] * b[1] - a[1] * b[0];
  return {
    [keys[0]]: (way[0] * b[1] - way[1] * b[0]) / determinant,
    [keys[1]]: (a[0] * way[1] - a[1] * way[0]) / determinant,
  };
}

function turned(center, from, to) {
  // Degrees counter-clockwise from one place to another, seen from a centre on a page where Y leads down.
  const angle = (at) => (Math.atan2(center[1] - at[1], at[0] - center[0]) * 180) / Math.PI;
  return ((angle(to) - angle(from) + 540) % 360) - 180;
}

// The widget -------------------------------------------------------------------------------------------------

function render({ model, el }) {
  const rows = new Map(); // of words, by key
  const grips = new Map(); // buttons on the drawing, by the name of the handle
  let asked = 0; // number of the last action
  let answered = 0;
  let queue = []; // actions while one is under way
  let quiet = null;
  let silence = null;
  let known = new Set(); // words whose range is that of the present text
  let held = null; // what the reader holds
  let settling = null;
  let frame = {}; // how the picture that is shown shows the plane
  let wasHeld = false;
  let haunted = null; // the button whose contour is drawn over the picture
  let isGone = false; // the kernel
  let shownView = null;
  let shownGhost = null;

  const paper = make("div", { class: "paper" });
  const over = draw("svg", { class: "over", "aria-hidden": "true" });
  const tracks = over.appendChild(draw("g", { class: "tracks" }));
  const ghosts = over.appendChild(draw("g", { class: "ghosts" }));
  const handles = make("div", { class: "handles", tabindex: -1, role: "group", "aria-label": "Handles on the drawing: drag them, or press arrow keys" });
  const stage = make("div", { class: "stage" }, paper, over, handles);
  const hint = make("p", { class: "hint", role: "status" });
  const drawing = make("figure", { "aria-live": "off" }, stage, hint);
  const words = make("div", { class: "words", role: "group", "aria-label": "Words of the block" });
  const status = make("p", { class: "state", role: "status" });
  const trouble = make("p", { class: "trouble", role: "alert" });
  const text = make("textarea", { rows: 1, spellcheck: "false", autocomplete: "off", "aria-label": "Block" });
  const copied = make("span", { class: "copied", role: "status" });
  const copy = button("Copy", copyText, { class: "copy" });
  const undo = button("Undo", () => act({ do: "undo" }), { class: "undo", title: "Take the last change back (Ctrl+Z)" });
  const redo = button("Redo", () => act({ do: "redo" }), { class: "redo", title: "Make it again (Ctrl+Y)" });
  const again = button("Reset", () => act({ do: "reset" }), { class: "reset", title: "The block as it was first" });
  const findings = make("div", { class: "findings" });
  const solutions = make("div", { class: "solutions", role: "group", "aria-label": "All solutions" });
  const path = make("details", { class: "path" }, make("summary", { text: "The path as a table" }));
  const sections = new Map(Object.entries(SECTIONS).map(([name, title]) => [name, section(name, title)]));
  const view = make(
    "div",
    // JupyterLab keeps Enter and the arrow keys to itself elsewhere.
    { class: "contoursolve explorer", "data-lm-suppress-shortcuts": "true", onkeydown: pressed },
    trouble,
    make(
      "div",
      { class: "desk" },
      make("div", { class: "sheet" }, drawing, make("div", { class: "block" }, text, copy, undo, redo, again, copied)),
      make("div", { class: "panel" }, status, words, solutions, findings),
      make("div", { class: "below" }, path, ...[...sections.values()].map((each) => each.node)),
    ),
  );
  const theme = make("div", {}, view);
  el.replaceChildren(theme);

  let isTyping = false; // in the block's text
  const writeText = () => {
    isTyping = false;
    if (text.value !== model.get("view").text) act({ do: "write", text: text.value });
  };
  text.addEventListener("input", () => (isTyping = true));
  text.addEventListener("blur", writeText); // a change that was taken back is none for the browser
  text.addEventListener("keydown", (event) => {
    if (event.key === "Enter" && !event.shiftKey) {
      event.preventDefault();
      writeText();
    }
  });

  function pressed(event) {
    event.stopPropagation();
    if (!(event.ctrlKey || event.metaKey) || event.target === text) return;
    // What is being typed in a field is the browser's to take back.
    if ([...rows.values()].some((row) => row.number === event.target && row.isTyping)) return;
    const key = event.key.toLowerCase();
    if (key !== "z" && key !== "y") return;
    event.preventDefault();
    act({ do: key === "y" || event.shiftKey ? "redo" : "undo" });
  }

  // Actions --------------------------------------------------------------------------------------------------

  function act(action) {
    clearTimeout(quiet);
    const last = queue.at(-1);
    // Of words that are held, only the last values count; ghosts and ranges that nobody waits for any more do not.
    const isSame = last?.is_held && action.is_held && Object.keys(last.values).join() === Object.keys(action.values).join();
    if (last && (IDLE.has(last.do) || isSame)) queue.pop();
    queue.push(action);
    watch(action);
    send();
  }

  function send() {
    if (!queue.length || asked > answered) return;
    asked += 1;
    const action = queue.shift();
    model.set("action", { ...action, number: asked });
    model.save_changes();
    watch(action);
  }

  function watch(action) {
    // A range or a section may take long; but somebody waits for what is asked behind them.
    if (silence || IDLE.has(action.do)) return;
    silence = setTimeout(() => tell("Python has not answered for two seconds. It is busy, or it is gone: then run the cell, or load the page, again."), SILENT);
  }

  function tell(what) {
    trouble.textContent = what;
    view.classList.toggle("silent", Boolean(what));
  }

  async function copyText() {
    let done = true;
    try {
      await navigator.clipboard.writeText(text.value);
    } catch {
      // Without a secure context there is no clipboard but the old one.
      text.select();
      done = document.execCommand("copy");
    }
    copied.textContent = done ? "copied" : "press Ctrl+C";
    if (!done) text.select();
    setTimeout(() => (copied.textContent = ""), 2000);
  }

  function release(after = 0) {
    clearTimeout(settling);
    if (after) settling = setTimeout(release, after);
    else if (!held) act({ do: "release" });
  }

  // Words ----------------------------------------------------------------------------------------------------

  function aboutOf(field) {
    return `${field.unit} ${field.meaning}`;
  }

  function wordRow(field) {
    const name = `${field.key}: ${field.meaning}`;
    const slider = make("input", { type: "range", "aria-label": `${name}, slider` });
    const number = make("input", { type: "text", autocomplete: "off", spellcheck: "false", class: "value", "aria-label": field.unit ? `${name}, ${field.unit}` : name });
    const free = button("?", () => act({ do: "free", key: field.key }), {
      class: "free",
      title: "Free this word: let the others give its value",
      "aria-label": `free ${field.key}`,
    });
    const pin = button("pin", () => act({ do: "pin", key: field.key }), {
      class: "pin",
      title: "Pin this word: no handle on the drawing changes it",
      "aria-label": `pin ${field.key}`,
    });
    const band = make("div", { class: "band", "aria-hidden": "true" });
    const range = make("span", { class: "range" });
    const label = make("code", { class: "word" });
    const line = field.key.includes(":") ? `program line ${field.key.split(":")[0]}` : "";
    const meant = [field.meaning, line].filter(Boolean).join(", ");
    const meaning = make("span", { class: "meaning", text: meant, title: meant });
    const row = make(
      "div",
      { class: "row", "data-word": field.key },
      label,
      make("div", { class: "track" }, band, slider),
      number,
      make("span", { class: "unit", text: field.unit }),
      free,
      pin,
      make("div", { class: "note" }, meaning, range),
    );
    let isPointed = false;
    slider.addEventListener("pointerdown", () => (isPointed = true));
    slider.addEventListener("input", () => {
      clearTimeout(settling);
      number.value = slider.value;
      act({ do: "move", values: { [field.key]: slider.valueAsNumber }, is_held: true });
    });
    slider.addEventListener("change", () => {
      release(isPointed ? 0 : SETTLED);
      isPointed = false;
    });
    // A field for text: one for numbers drops a decimal comma, and a keyboard for decimals may lack the minus.
    const isEmpty = () => !number.value.trim();
    number.addEventListener("input", () => {
      shown.isTyping = true;
      const value = Number(number.value.trim().replace(",", "."));
      if (!isEmpty() && Number.isFinite(value)) slider.value = value;
    });
    // A value that is proposed is no change for the browser; Enter and Tab take it.
    const accept = () => {
      if (shown.isProposed && !isEmpty()) act({ do: "move", values: { [field.key]: number.value } });
      shown.isProposed = false;
    };
    number.addEventListener("keydown", (event) => {
      if (event.key === "Enter" || event.key === "Tab") accept();
      if (event.key === "Escape") shown.isProposed = false;
    });
    number.addEventListener("blur", () => (shown.isTyping = shown.isProposed = false));
    number.addEventListener("change", () => {
      shown.isTyping = shown.isProposed = false;
      if (!isEmpty()) act({ do: "move", values: { [field.key]: number.value } });
      else showWords(model.get("view").fields, false); // nothing changes nothing
    });
    const shown = { about: aboutOf(field), row, slider, number, free, pin, band, range, label, scale: null, text: "", isTyping: false };
    return shown;
  }

  function showWords(fields, isNew) {
    const active = el.getRootNode().activeElement;
    const isSeveral = model.get("view").solutions.items.length > 1;
    const gone = new Set(rows.keys());
    const order = [];
    for (const field of fields) {
      gone.delete(field.key);
      let row = rows.get(field.key);
      if (row?.about !== aboutOf(field)) rows.set(field.key, (row = wordRow(field)));
      const isInside = row.scale && field.value >= row.scale.low && field.value <= row.scale.high;
      if (!isInside || isNew) row.scale = { low: field.low, high: field.high, step: field.step };
      row.slider.min = row.scale.low;
      row.slider.max = row.scale.high;
      row.slider.step = row.scale.step;
      const isFree = field.state === "free";
      const isComputed = field.state === "computed";
      row.slider.disabled = isFree || isComputed;
      row.number.readOnly = isComputed;
      row.free.setAttribute("aria-pressed", String(isFree));
      row.pin.setAttribute("aria-pressed", String(field.is_pinned));
      for (const each of [row.free, row.pin]) each.style.visibility = field.state === "tool" || isComputed ? "hidden" : "";
      row.label.textContent = field.word;
      row.row.dataset.state = field.state;
      row.range.dataset.state = field.state;
      // What the reader is about to enter stays.
      const isMoving = queue.length && (active === row.slider || held);
      if (!isMoving && !row.isTyping && !row.isProposed) row.number.value = field.value ?? "";
      if (!isMoving && field.value !== null) row.slider.value = field.value;
      if (field.state === "free" && field.value !== null) row.text = "free; the others give its value";
      else if (field.state === "free") row.text = isSeveral ? "free; each solution gives its own" : "free; nothing gives its value";
      else if (field.state === "ignored") row.text = "ignored by the control";
      else row.text = field.reason ?? "";
      order.push(row.row);
    }
    for (const key of gone) rows.delete(key);
    if (order.length !== words.children.length || order.some((row, place) => row !== words.children[place])) {
      words.replaceChildren(...order);
    }
  }

  function freshRange(key) {
    const found = model.get("ranges")[key];
    return found && found.frame === model.get("view").frames[key] ? found : null;
  }

  function showRanges() {
    known = new Set();
    for (const [key, row] of rows) {
      const found = freshRange(key);
      if (found) known.add(key);
      row.band.replaceChildren();
      row.range.textContent = row.text || (found && found.note) || "";
      row.range.title = [found?.whole, found?.reason].filter(Boolean).join("; ");
      row.range.classList.toggle("nowhere", !row.text && Boolean(found && found.intervals?.length === 0));
      row.slider.setAttribute("aria-description", [row.range.textContent, row.range.title].filter(Boolean).join("; "));
      if (!found || !row.scale || !found.intervals) continue;
      row.scale.low = Math.min(row.scale.low, found.low);
      row.scale.high = Math.max(row.scale.high, found.high);
      row.slider.min = row.scale.low;
      row.slider.max = row.scale.high;
      const width = row.scale.high - row.scale.low;
      for (const [low, high] of found.intervals) {
        const begin = Math.max(0, (low - row.scale.low) / width);
        const end = Math.min(1, (high - row.scale.low) / width);
        if (end < 0 || begin > 1) continue;
        const part = make("span");
        part.style.left = `${100 * begin}%`;
        part.style.width = `${100 * Math.max(end - begin, 0.004)}%`;
        row.band.append(part);
      }
    }
    showTracks();
  }

  function askForMore() {
    if (queue.length || asked > answered || held) return;
    const lacking = [...sections.keys()].find((name) => sections.get(name).node.open && !freshSection(name));
    if (lacking !== undefined) return act({ do: "section", name: lacking });
    const next = [...rows.keys()].find((key) => !known.has(key) && model.get("view").frames[key] !== undefined);
    if (next !== undefined) act({ do: "range", key: next });
  }

  // Handles --------------------------------------------------------------------------------------------------

  function showHandles(list) {
    const gone = new Set(grips.keys());
    for (const handle of list) {
      const name = `${handle.kind} ${handle.name}`;
      gone.delete(name);
      let grip = grips.get(name);
      if (!grip) {
        grip = { node: make("button", { type: "button" }), handle };
        grip.node.addEventListener("pointerdown", (event) => take(event, grip));
        grip.node.addEventListener("pointermove", (event) => pull(event, grip));
        grip.node.addEventListener("pointerup", () => drop(grip));
        grip.node.addEventListener("pointercancel", () => drop(grip));
        grip.node.addEventListener("keydown", (event) => step(event, grip));
        for (const name of ["focus", "pointerenter", "blur", "pointerleave"]) grip.node.addEventListener(name, showTracks);
        grips.set(name, grip);
        handles.append(grip.node);
      }
      grip.handle = handle;
      grip.node.className = `handle ${handle.kind}`;
      grip.node.title = `${handle.text}. Drag it, or press arrow keys; Shift for fine steps.`;
      grip.node.setAttribute("aria-label", handle.text);
      for (const each of NAMES) delete grip.node.dataset[each];
      grip.node.dataset[handle.kind === "point" ? "point" : "word"] = handle.name;
      const values = valuesOf(handle);
      if (held?.grip === grip) held.base = { handle, values };
      else grip.node.disabled = handle.keys.some((key) => values[key] === null);
      put(grip, handle.at);
    }
    for (const name of gone) {
      if (held?.grip === grips.get(name)) continue; // there is no contour now; the next place may have one again
      // The keys that follow belong to the drawing still.
      if (grips.get(name).node.matches(":focus")) handles.focus();
      grips.get(name).node.remove();
      grips.delete(name);
    }
  }

  function put(grip, at) {
    grip.node.style.left = `${(100 * at[0]) / frame.width}%`;
    grip.node.style.top = `${(100 * at[1]) / frame.height}%`;
  }

  function valuesOf(handle) {
    const fields = new Map(model.get("view").fields.map((field) => [field.key, field]));
    return Object.fromEntries(handle.keys.map((key) => [key, fields.get(key)?.value ?? null]));
  }

  function placeOf(event) {
    const box = stage.getBoundingClientRect();
    return [((event.clientX - box.left) / box.width) * frame.width, ((event.clientY - box.top) / box.height) * frame.height];
  }

  function take(event, grip) {
    if (event.button !== 0 || grip.node.disabled) return;
    event.preventDefault();
    grip.node.focus({ preventScroll: true });
    grip.node.setPointerCapture(event.pointerId);
    clearTimeout(settling);
    const base = { handle: grip.handle, values: valuesOf(grip.handle) };
    held = { grip, base, first: base, seen: new Set(), off: minus(grip.handle.at, placeOf(event)), sent: base.values, target: null, due: 0 };
    view.classList.add("held");
    showTracks();
  }

  function pull(event, grip) {
    if (held?.grip !== grip) return;
    const at = placeOf(event);
    held.target = [at[0] + held.off[0], at[1] + held.off[1]];
    held.isFine = event.shiftKey;
    held.isBeyond = event.altKey;
    held.seen.clear();
    held.due ||= requestAnimationFrame(follow);
  }

  function drop(grip) {
    if (held?.grip !== grip) return;
    if (held.due) {
      cancelAnimationFrame(held.due);
      follow();
    }
    const { isMoved } = held;
    held = null;
    view.classList.remove("held");
    hint.textContent = "";
    if (isMoved || model.get("view").is_held || queue.length || asked > answered) act({ do: "release" });
    showTracks();
  }

  function cancel() {
    held = null;
    view.classList.remove("held");
    act({ do: "cancel" });
  }

  function follow() {
    // One frame of a drag: the words that bring the handle to the pointer, and at once what they move.
    held.due = 0;
    if (!held.target) return;
    const { handle, values } = held.base;
    // An angle is counted from where it was taken: its own centre may move with it.
    const first = held.first;
    const steps = handle.center
      ? { [handle.name]: first.values[handle.name] + turned(first.handle.center, first.handle.at, held.target) - values[handle.name] }
      : stepsTo(handle, handle.at, held.target);
    const told = [];
    const wanted = {};
    for (const [key, by] of Object.entries(steps)) {
      const pixels = handle.center ? (size(minus(held.target, handle.center)) * Math.PI) / 180 : size(handle.moves[key]);
      const found = allowed(handle, key, values[key], values[key] + by, pixels, held);
      wanted[key] = found.value;
      if (found.text) told.push(`${key}: ${found.text}`);
    }
    hint.textContent = told.join("; ") || Object.entries(wanted).map(([key, value]) => `${key} ${value}`).join(", ");
    move(held.grip, wanted);
  }

  function allowed(handle, key, from, value, pixels, { isFine, isBeyond }) {
    // A value near the one that is meant: one of interest, or a round one, where the word has a contour.
    const field = model.get("view").fields.find((each) => each.key === key);
    const range = handle.keys.length === 1 ? freshRange(key) : null;
    const least = field.increment;
    const interval = range?.intervals?.find(([low, high]) => from >= low && from <= high);
    const [first, last] = interval && !isBeyond ? range.stops[range.intervals.indexOf(interval)] : [-Infinity, Infinity];
    if (interval && !isBeyond) {
      const [low, high] = range.ends[range.intervals.indexOf(interval)];
      if (value <= first && low) return { value: tidy(first), text: `stops: ${low}` };
      if (value >= last && high) return { value: tidy(last), text: `stops: ${high}` };
    }
    const isNear = (snap) => Math.abs(snap.value - value) * pixels < CATCH && snap.value >= first && snap.value <= last;
    const caught = range?.snaps?.find(isNear);
    if (caught && !isFine) return { value: tidy(caught.value), text: `${tidy(caught.value)} ${caught.text}` };
    const step = isFine ? least : Math.max(least, roundStep(COARSE / pixels));
    const rounded = Math.round(value / step) * step;
    return { value: tidy(Math.min(Math.max(rounded, first), last)), text: "" };
  }

  function move(grip, wanted) {
    const { handle, values } = held ? held.base : { handle: grip.handle, values: valuesOf(grip.handle) };
    const changes = Object.fromEntries(Object.entries(wanted).map(([key, value]) => [key, value - values[key]]));
    put(grip, handle.center ? turnAbout(handle, changes) : shift(handle.at, handle.moves, changes));
    predict(changes);
    for (const [key, value] of Object.entries(wanted)) {
      const row = rows.get(key);
      if (row) row.number.value = row.slider.value = value;
    }
    const sent = held?.sent ?? values;
    if (Object.keys(wanted).every((key) => wanted[key] === sent[key])) return;
    if (held) {
      // Where the pointer rests, what was tried for it is not tried again.
      const name = JSON.stringify(wanted);
      if (held.seen.has(name)) return;
      held.seen.add(name);
      [held.sent, held.isMoved] = [wanted, true];
    }
    act({ do: "move", values: wanted, is_held: true, handle: handle.kind === "point" ? { [handle.name]: handle.keys } : {} });
  }

  function turnAbout(handle, changes) {
    const way = minus(handle.at, handle.center);
    const angle = (-changes[handle.name] * Math.PI) / 180;
    const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
    return [handle.center[0] + way[0] * cosine - way[1] * sine, handle.center[1] + way[0] * sine + way[1] * cosine];
  }

  function predict(changes) {
    for (const element of model.get("view").elements) {
      // Enlarged details stand outside the drawing, at another scale.
      for (const item of paper.querySelectorAll(`svg > g [data-element="${CSS.escape(element.name)}"]`)) {
        if (item.localName === "path") item.setAttribute("d", pathOf(element, changes));
        else {
          const ends = [0, 1].map((number) => minus(shift(element.places[number], element.slopes[number], changes), element.places[number]));
          item.setAttribute("transform", `translate(${(ends[0][0] + ends[1][0]) / 2},${(ends[0][1] + ends[1][1]) / 2})`);
        }
      }
    }
  }

  function step(event, grip) {
    if (event.key === "Escape" && held?.grip === grip) cancel();
    const way = ARROWS[event.key];
    if (!way || grip.node.disabled || held) return;
    event.preventDefault();
    const { handle } = grip;
    const values = grip.pending ?? valuesOf(handle); // what is under way counts
    const wanted = {};
    const told = [];
    for (const [key, by] of Object.entries(stepsBy(handle, way, event.shiftKey))) {
      const found = allowed(handle, key, values[key], values[key] + by, Infinity, { isFine: true });
      wanted[key] = found.value;
      if (found.text) told.push(`${key}: ${found.text}`);
    }
    if (!Object.keys(wanted).length) return;
    hint.textContent = told.join("; ");
    move(grip, { ...values, ...wanted });
    grip.pending = { ...values, ...wanted };
    release(SETTLED);
  }

  function stepsBy(handle, way, isFine) {
    // By how much an arrow key changes the words of a handle.
    const many = Math.max(...way.map(Math.abs));
    const least = Object.fromEntries(model.get("view").fields.map((field) => [field.key, field.increment]));
    const step = (key, pixels) => (isFine ? least[key] : Math.max(least[key], roundStep(COARSE / pixels))) * many;
    if (handle.center) {
      const pixels = (size(minus(handle.at, handle.center)) * Math.PI) / 180;
      return { [handle.name]: Math.sign(way[0] - way[1]) * step(handle.name, pixels) };
    }
    const keys = Object.keys(handle.moves);
    if (keys.length === 1) {
      const [slope] = Object.values(handle.moves);
      const along = (way[0] * slope[0] + way[1] * slope[1]) / (size(slope) * many);
      return Math.abs(along) < 0.2 ? {} : { [keys[0]]: Math.sign(along) * step(keys[0], size(slope)) }; // across it stays
    }
    // Two words together bring it along the arrow: the one that leads by a round step, the other by what that takes.
    const found = stepsTo(handle, [0, 0], way);
    const pixels = (key) => size(handle.moves[key]);
    const [lead, other] = keys.sort((a, b) => Math.abs(found[b]) * pixels(b) - Math.abs(found[a]) * pixels(a));
    const by = step(lead, pixels(lead));
    const rest = (found[other] / Math.abs(found[lead])) * by;
    return { [lead]: Math.sign(found[lead]) * by, [other]: Math.round(rest / least[other]) * least[other] };
  }

  function showTracks() {
    tracks.replaceChildren();
    const grip = held?.grip ?? [...grips.values()].find(({ node }) => node.matches(":hover, :focus-visible"));
    if (!grip || grip.node.disabled) return;
    const { handle } = grip;
    const values = valuesOf(handle);
    for (const key of handle.keys) {
      const range = freshRange(key);
      const at = range?.intervals?.findIndex(([low, high]) => values[key] >= low && values[key] <= high) ?? -1;
      if (at < 0) continue;
      const place = (value) => (handle.center ? turnAbout(handle, { [key]: value - values[key] }) : shift(handle.at, handle.moves, { [key]: value - values[key] }));
      const [low, high] = range.intervals[at];
      const count = handle.center ? 48 : 1;
      const points = Array.from({ length: count + 1 }, (_, number) => place(low + ((high - low) * number) / count));
      tracks.append(draw("polyline", { points: points.map((each) => each.join(",")).join(" ") }));
      range.ends[at].forEach((told, number) => {
        if (!told) return;
        const [x, y] = place([low, high][number]);
        tracks.append(draw("circle", { cx: x, cy: y, r: 3.5 }));
        const lines = told.split(": ").map((line, place, all) => (place < all.length - 1 ? `${line}:` : line));
        const half = Math.max(...lines.map((line) => line.length)) * LETTER;
        const left = Math.min(Math.max(x, half), frame.width - half);
        const isBelow = number && size(minus(place(low), place(high))) < 4 * LINE; // beside the other end
        const wanted = isBelow ? y + 20 : y - 9 - LINE * (lines.length - 1);
        const top = Math.min(Math.max(wanted, LINE), frame.height - LINE * lines.length);
        const label = draw("text", { "text-anchor": "middle" });
        lines.forEach((line, place) => label.append(draw("tspan", { x: left, y: top + LINE * place }, line)));
        tracks.append(label);
      });
    }
  }

  // What might be instead --------------------------------------------------------------------------------------

  function haunt(node, of) {
    const begin = () => {
      haunted = of;
      act({ do: "ghost", ...of, of: model.get("view").mark });
    };
    const end = () => {
      haunted = null;
      ghosts.replaceChildren();
      hint.textContent = "";
    };
    node.addEventListener("pointerenter", begin);
    node.addEventListener("focus", begin);
    node.addEventListener("pointerleave", end);
    node.addEventListener("blur", end);
    return node;
  }

  function showGhost() {
    const ghost = model.get("ghost");
    const isWanted = haunted && ghost.paths && Object.entries(haunted).every(([name, value]) => ghost[name] === value);
    ghosts.replaceChildren(...(isWanted ? ghost.paths.map((d) => draw("path", { d })) : []));
    if (isWanted) hint.textContent = ghost.text;
  }

  function showFindings(all, of, elsewhere) {
    const place = placeIn(findings);
    const items = all.map((finding) => {
      const lines = make("pre", { tabindex: "0" });
      for (const line of finding.lines) {
        // What quotes the block keeps its columns; the rest is broken where the page ends.
        const isQuoted = /^ *\d* *\|/.test(line.map(([piece]) => piece).join(""));
        const pieces = line.map(([piece, role]) => (role ? make("span", { class: role, text: piece }) : piece));
        lines.append(make("span", { class: isQuoted ? "quoted" : "told" }, ...pieces), "\n");
      }
      const fixes = finding.fixes.map((fix) =>
        haunt(
          button(`${fix.text} [${[fix.effect, fix.alone].filter(Boolean).join("; ")}]`, () => act({ do: "fix", finding: fix.finding, fix: fix.number, of }), {
            class: fix.is_safe ? "fix safe" : "fix",
          }),
          { finding: fix.finding, fix: fix.number },
        ),
      );
      const bar = fixes.length ? make("div", { class: "fixes", role: "group", "aria-label": "Fixes" }, ...fixes, finding.left && make("span", { text: finding.left })) : null;
      const about = { "data-finding": finding.name || null, "data-word": finding.words.join(" ") || null };
      return make("section", { class: `finding ${finding.kind}`, ...about }, lines, bar);
    });
    if (elsewhere) items.push(make("p", { class: "elsewhere", text: elsewhere }));
    findings.replaceChildren(...items);
    focusAgain(findings, place);
  }

  function showSolutions({ text: count, items }, of) {
    const place = placeIn(solutions);
    const choices = items.map((item) =>
      make(
        "li",
        {},
        haunt(
          button(item.name, () => act({ do: "select", solution: item.number, of }), {
            "aria-pressed": String(item.is_chosen),
            disabled: item.selects || item.is_chosen ? undefined : "",
          }),
          { solution: item.number },
        ),
        make("span", { text: [item.where, item.selects && `by ${item.selects}`].filter(Boolean).join("; ") }),
      ),
    );
    solutions.replaceChildren(...(items.length ? [make("p", { text: count }), make("ul", {}, ...choices)] : []));
    focusAgain(solutions, place);
  }

  // What is shown anew would lose the keys that follow to the page.
  function placeIn(part) {
    return [...part.querySelectorAll(FOCUSED)].findIndex((node) => node.matches(":focus"));
  }

  function focusAgain(part, place) {
    if (place < 0) return;
    const nodes = [...part.querySelectorAll(FOCUSED)];
    (nodes[Math.min(place, nodes.length - 1)] ?? handles).focus({ preventScroll: true });
  }

  function showPath(table) {
    path.hidden = table.length === 0;
    if (path.children.length > 1) path.lastElementChild.remove();
    if (!table.length) return;
    const [header, ...body] = table;
    const kind = (place) => (place > 1 ? "number" : undefined);
    const about = (row) => ({ [row[1] === "point" || row[0] === "start" ? "data-point" : "data-element"]: row[0] });
    path.append(
      make(
        "table",
        {},
        make("thead", {}, make("tr", {}, ...header.map((cell, place) => make("th", { scope: "col", text: cell, class: kind(place) })))),
        make(
          "tbody",
          {},
          ...body.map((row) =>
            make("tr", about(row), ...row.map((cell, place) => make(place ? "td" : "th", { text: cell, class: kind(place), scope: place ? undefined : "row" }))),
          ),
        ),
      ),
    );
  }

  // Sections that are made when they are opened --------------------------------------------------------------------

  function section(name, title) {
    const content = make("div", { class: "content" });
    const node = make("details", { class: `more ${name}` }, make("summary", { text: title }), content);
    node.addEventListener("toggle", () => {
      if (node.open && !freshSection(name)) askForMore();
    });
    return { node, content, shown: null };
  }

  function freshSection(name) {
    const made = model.get("sections")?.[name];
    return made && made.of === model.get("view").mark ? made : null;
  }

  function showSections() {
    for (const [name, each] of sections) {
      const made = model.get("sections")?.[name];
      const isFresh = Boolean(freshSection(name));
      each.content.classList.toggle("stale", Boolean(made) && !isFresh);
      each.content.setAttribute("aria-busy", String(!isFresh && each.node.open));
      if (!made || made === each.shown) continue;
      each.shown = made;
      const place = placeIn(each.content);
      const wereOpen = new Set([...each.content.querySelectorAll("details[open] > summary")].map((summary) => summary.textContent));
      each.content.replaceChildren(...page(made.html));
      for (const summary of each.content.querySelectorAll("details > summary")) {
        summary.parentElement.open = wereOpen.has(summary.textContent);
      }
      focusAgain(each.content, place);
    }
  }

  // One identity: what is pointed at is lit wherever it stands ---------------------------------------------------

  function namesOf(node, name) {
    const names = node.dataset[name];
    if (!names) return [];
    return name === "element" ? [names] : names.split(" ");
  }

  function light(event) {
    const node = event.target.closest?.(NAMES.map((name) => `[data-${name}]`).join(", "));
    for (const each of view.querySelectorAll(".lit")) each.classList.remove("lit");
    if (!node || held) return;
    for (const name of NAMES) {
      const wanted = new Set(namesOf(node, name));
      if (!wanted.size) continue;
      for (const each of view.querySelectorAll(`[data-${name}]`)) {
        if (namesOf(each, name).some((own) => wanted.has(own))) each.classList.add("lit");
      }
    }
  }
  for (const name of ["pointerover", "focusin"]) view.addEventListener(name, light);
  view.addEventListener("pointerleave", light);

  // All of it --------------------------------------------------------------------------------------------------

  function showPicture(now) {
    const drawn = picture(now.picture);
    const before = frame;
    frame = now.frame;
    paper.replaceChildren(...[drawn].filter(Boolean));
    stage.hidden = !drawn;
    if (!drawn) return;
    over.setAttribute("viewBox", `0 0 ${frame.width} ${frame.height}`);
    const group = drawn.querySelector(":scope > g");
    const isFitted = wasHeld && !now.is_held && before.scale && (before.scale !== frame.scale || String(before.origin) !== String(frame.origin));
    if (isFitted && group && !matchMedia("(prefers-reduced-motion: reduce)").matches) {
      const zoom = before.scale / frame.scale;
      const [x, y] = minus(before.origin, [frame.origin[0] * zoom, frame.origin[1] * zoom]);
      group.animate([{ transform: `translate(${x}px, ${y}px) scale(${zoom})` }, { transform: "none" }], { duration: GLIDE, easing: "ease-out" });
    }
    wasHeld = now.is_held;
  }

  function showView(now) {
    showPicture(now);
    showWords(now.fields, now.is_new);
    showHandles(now.handles);
    // What was typed and makes no sense stays, so that it can be mended.
    if (!isTyping && !now.trouble) text.value = now.text;
    text.rows = Math.min(12, now.text.split("\n").length);
    // A button that is disabled loses the keys that follow to the page.
    const ways = [[again, now.is_changed], [undo, now.can_undo], [redo, now.can_redo]];
    for (const [each, can] of ways) each.setAttribute("aria-disabled", String(!can));
    const line = [make("strong", { class: now.status.kind, text: now.status.text }), now.status.form ? ` ${now.status.form}` : ""];
    status.replaceChildren(...line.filter(Boolean));
    if (now.trouble) status.append(make("span", { class: "error", text: ` ${now.trouble}` }));
    showFindings(now.findings, now.mark, now.elsewhere);
    showSolutions(now.solutions, now.mark);
    showPath(now.path);
    if (held && held.target) held.due ||= requestAnimationFrame(follow);
    const ask = now.asks?.[0];
    const row = ask && rows.get(ask.key);
    if (row) {
      row.number.value = ask.value ?? "";
      row.isProposed = true;
      row.number.focus();
      row.number.select();
    }
  }

  function show() {
    answered = Math.max(answered, model.get("number"));
    asked = Math.max(asked, answered);
    clearTimeout(silence);
    silence = null;
    if (queue.length) watch(queue.at(-1));
    if (asked === answered) {
      for (const grip of grips.values()) if (!queue.length) grip.pending = null;
      if (view.classList.contains("silent")) tell("");
    }
    const now = model.get("view");
    if (now !== shownView) {
      shownView = now;
      showView(now);
    }
    if (model.get("ghost") !== shownGhost) {
      shownGhost = model.get("ghost");
      showGhost();
    }
    showRanges();
    showSections();
    clearTimeout(quiet);
    if (queue.length) send();
    else quiet = setTimeout(askForMore, QUIET);
  }

  function followTheme() {
    theme.dataset.theme = isDark(el) ? "dark" : "light";
  }

  function followKernel(_, state) {
    isGone ||= state === undefined || GONE.has(state); // no new kernel knows what the old one did
    if (isGone) tell("The kernel is gone, so nothing here moves any more. Run the cell again.");
    else if (state === "disconnected") tell("The connection to the kernel is lost. What is shown is what it was.");
    else if (state === "connected" && asked === answered) tell("");
  }

  const kernel = model.widget_manager?.kernel;
  const signals = [kernel?.statusChanged, kernel?.connectionStatusChanged, kernel?.disposed].filter(Boolean);
  for (const signal of signals) signal.connect(followKernel);
  const observer = new MutationObserver(followTheme);
  for (const element of [document.documentElement, document.body]) {
    observer.observe(element, { attributes: true, attributeFilter: ["class", "style", "data-theme", "data-jp-theme-light", "data-jp-theme-name", "data-vscode-theme-kind"] });
  }
  // What one answer changes comes in one event each, in any order: it is shown when all of it is there.
  const CHANGED = ["view", "ranges", "ghost", "sections", "number"].map((name) => `change:${name}`);
  let isDue = false;
  const changed = () => {
    if (isDue) return;
    isDue = true;
    queueMicrotask(() => {
      isDue = false;
      show();
    });
  };
  for (const name of CHANGED) model.on(name, changed);
  followTheme();
  requestAnimationFrame(followTheme);
  show();

  return () => {
    for (const timer of [quiet, silence, settling]) clearTimeout(timer);
    for (const signal of signals) signal.disconnect(followKernel);
    observer.disconnect();
    for (const name of CHANGED) model.off(name, changed);
  };
}

export default { render };
