// The explorer's front end. It shows what Python says and sends what the reader does; it works nothing out.
// Texts are set as text, never as HTML; the picture is parsed as XML and comes from contoursolve's own painter.

const QUIET = 250; // ms without an action after which ranges are asked for

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

function button(text, action, properties = {}) {
  return make("button", { type: "button", text, onclick: action, ...properties });
}

function picture(svg) {
  if (!svg) return null;
  const root = new DOMParser().parseFromString(svg, "image/svg+xml").documentElement;
  return root.localName === "svg" ? document.importNode(root, true) : null;
}

function isDark(element) {
  // The colour that text has here tells the theme of any notebook, also from inside a shadow root.
  const numbers = getComputedStyle(element).color.match(/[\d.]+/g);
  if (!numbers) return false;
  const [red, green, blue] = numbers.map(Number);
  return 0.299 * red + 0.587 * green + 0.114 * blue > 140;
}

function render({ model, el }) {
  const rows = new Map(); // of words, by key
  let asked = 0; // number of the last action
  let answered = 0;
  let waiting = null; // the newest action while one is under way
  let quiet = null;
  let known = new Set(); // words whose range is that of the present text

  const drawing = make("figure", { "aria-live": "off" });
  const words = make("div", { class: "words", role: "group", "aria-label": "Words of the block" });
  const status = make("p", { class: "state", role: "status" });
  const text = make("textarea", { rows: 1, spellcheck: "false", autocomplete: "off", "aria-label": "Block" });
  const copied = make("span", { class: "copied", role: "status" });
  const copy = button("Copy", copyText, { class: "copy" });
  const again = button("Reset", () => act({ do: "reset" }), { class: "reset", title: "The block as it was first" });
  const findings = make("div", { class: "findings" });
  const solutions = make("div", { class: "solutions", role: "group", "aria-label": "All solutions" });
  const path = make("details", { class: "path" }, make("summary", { text: "The path as a table" }));
  const view = make(
    "div",
    // JupyterLab keeps Enter and the arrow keys to itself elsewhere.
    { class: "contoursolve explorer", "data-lm-suppress-shortcuts": "true", onkeydown: (event) => event.stopPropagation() },
    make("div", { class: "desk" }, drawing, make("div", { class: "panel" }, status, words)),
    make("div", { class: "block" }, text, copy, again, copied),
    solutions,
    findings,
    path,
  );
  const theme = make("div", {}, view);
  el.replaceChildren(theme);

  let isTyping = false; // in the block's text
  const writeText = () => {
    isTyping = false;
    if (text.value !== model.get("view").text) act({ do: "write", text: text.value });
  };
  text.addEventListener("input", () => (isTyping = true));
  text.addEventListener("change", writeText);
  text.addEventListener("keydown", (event) => {
    if (event.key === "Enter" && !event.shiftKey) {
      event.preventDefault();
      writeText();
    }
  });

  function act(action) {
    clearTimeout(quiet);
    waiting = action;
    send();
  }

  function send() {
    if (!waiting || asked > answered) return;
    asked += 1;
    model.set("action", { ...waiting, number: asked });
    waiting = null;
    model.save_changes();
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

  function wordRow(field) {
    const name = `${field.key}: ${field.meaning}`;
    const slider = make("input", { type: "range", "aria-label": `${name}, slider` });
    const number = make("input", { type: "number", step: "any", "aria-label": field.unit ? `${name}, ${field.unit}` : name });
    const free = button("?", () => act({ do: "free", key: field.key }), {
      class: "free",
      title: "Free this word: let the others give its value",
      "aria-label": `free ${field.key}`,
    });
    const band = make("div", { class: "band", "aria-hidden": "true" });
    const range = make("span", { class: "range" });
    const label = make("code", { class: "word" });
    const meaning = make("span", { class: "meaning", text: field.meaning, title: field.meaning });
    const row = make(
      "div",
      { class: "row" },
      label,
      make("div", { class: "track" }, band, slider),
      number,
      make("span", { class: "unit", text: field.unit }),
      free,
      make("div", { class: "note" }, meaning, range),
    );
    slider.addEventListener("input", () => {
      number.value = slider.value;
      act({ do: "move", key: field.key, value: slider.valueAsNumber });
    });
    number.addEventListener("input", () => (shown.isTyping = true));
    number.addEventListener("blur", () => (shown.isTyping = false));
    number.addEventListener("change", () => {
      shown.isTyping = false;
      if (number.value !== "") act({ do: "move", key: field.key, value: number.value });
      else showWords(model.get("view").fields, false); // what is no number changes nothing
    });
    const shown = { row, slider, number, free, band, range, label, scale: null, text: "", isTyping: false };
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
      if (!row) rows.set(field.key, (row = wordRow(field)));
      const isInside = row.scale && field.value >= row.scale.low && field.value <= row.scale.high;
      if (!isInside || isNew) row.scale = { low: field.low, high: field.high, step: field.step };
      row.slider.min = row.scale.low;
      row.slider.max = row.scale.high;
      row.slider.step = row.scale.step;
      const isFree = field.state === "free";
      row.slider.disabled = isFree;
      row.free.setAttribute("aria-pressed", String(isFree));
      row.label.textContent = field.word;
      row.row.dataset.state = field.state;
      row.range.dataset.state = field.state;
      // What the reader is about to enter stays.
      const isMoving = waiting && active === row.slider;
      if (!isMoving && !row.isTyping) row.number.value = field.value ?? "";
      if (!isMoving && field.value !== null) row.slider.value = field.value;
      if (field.state === "free" && field.value !== null) row.text = "free; the others give its value";
      else if (field.state === "free") row.text = isSeveral ? "free; each solution gives its own" : "free; nothing gives its value";
      else if (field.state === "ignored") row.text = "ignored by the control";
      else row.text = "";
      order.push(row.row);
    }
    for (const key of gone) rows.delete(key);
    if (order.length !== words.children.length || order.some((row, place) => row !== words.children[place])) {
      words.replaceChildren(...order);
    }
  }

  function showRanges() {
    const ranges = model.get("ranges");
    known = new Set();
    for (const [key, row] of rows) {
      const found = ranges[key];
      const isFresh = found && found.frame === model.get("view").frames[key];
      if (isFresh) known.add(key);
      row.band.replaceChildren();
      row.range.textContent = row.text || (isFresh && found.note) || "";
      row.range.title = (isFresh && found.reason) || "";
      row.range.classList.toggle("nowhere", !row.text && Boolean(isFresh && found.intervals?.length === 0));
      row.slider.setAttribute("aria-description", [row.range.textContent, row.range.title].filter(Boolean).join("; "));
      if (!isFresh || !row.scale || !found.intervals) continue;
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
  }

  function askForRange() {
    if (waiting || asked > answered) return;
    const next = [...rows.keys()].find((key) => !known.has(key) && model.get("view").frames[key] !== undefined);
    if (next !== undefined) act({ do: "range", key: next });
  }

  function showFindings(all) {
    const items = all.map((finding) => {
      const lines = make("pre", { tabindex: "0" });
      for (const line of finding.lines) {
        for (const [piece, role] of line) lines.append(role ? make("span", { class: role, text: piece }) : piece);
        lines.append("\n");
      }
      const fixes = finding.fixes.map((fix) =>
        button(`${fix.text} [${fix.effect}]`, () => act({ do: "fix", finding: fix.finding, fix: fix.number }), {
          class: fix.is_safe ? "fix safe" : "fix",
        }),
      );
      const bar = fixes.length ? make("div", { class: "fixes", role: "group", "aria-label": "Fixes" }, ...fixes) : null;
      return make("section", { class: `finding ${finding.kind}` }, lines, bar);
    });
    findings.replaceChildren(...items);
  }

  function showSolutions({ text: count, items }) {
    const choices = items.map((item) =>
      make(
        "li",
        {},
        button(item.name, () => act({ do: "select", solution: item.number }), {
          "aria-pressed": String(item.is_chosen),
          disabled: item.selects || item.is_chosen ? undefined : "",
        }),
        make("span", { text: [item.where, item.selects && `by ${item.selects}`].filter(Boolean).join("; ") }),
      ),
    );
    solutions.replaceChildren(...(items.length ? [make("p", { text: count }), make("ul", {}, ...choices)] : []));
  }

  function showPath(table) {
    path.hidden = table.length === 0;
    if (path.children.length > 1) path.lastElementChild.remove();
    if (!table.length) return;
    const [header, ...body] = table;
    const kind = (place) => (place > 1 ? "number" : undefined);
    path.append(
      make(
        "table",
        {},
        make("thead", {}, make("tr", {}, ...header.map((cell, place) => make("th", { scope: "col", text: cell, class: kind(place) })))),
        make(
          "tbody",
          {},
          ...body.map((row) =>
            make("tr", {}, ...row.map((cell, place) => make(place ? "td" : "th", { text: cell, class: kind(place), scope: place ? undefined : "row" }))),
          ),
        ),
      ),
    );
  }

  function show() {
    const now = model.get("view");
    answered = Math.max(answered, now.number);
    asked = Math.max(asked, answered);
    drawing.replaceChildren(...[picture(now.picture)].filter(Boolean));
    showWords(now.fields, now.is_new);
    if (!isTyping) text.value = now.text;
    text.rows = Math.min(12, now.text.split("\n").length);
    again.disabled = !now.is_changed;
    const line = [make("strong", { class: now.status.kind, text: now.status.text }), now.status.form ? ` ${now.status.form}` : ""];
    status.replaceChildren(...line.filter(Boolean));
    if (now.trouble) status.append(make("span", { class: "error", text: ` ${now.trouble}` }));
    showFindings(now.findings);
    showSolutions(now.solutions);
    showPath(now.path);
    showRanges();
    finish();
  }

  function finish() {
    clearTimeout(quiet);
    if (waiting) send();
    else quiet = setTimeout(askForRange, QUIET);
  }

  function showRange() {
    answered = Math.max(answered, model.get("ranges_number"));
    asked = Math.max(asked, answered);
    showRanges();
    finish();
  }

  function followTheme() {
    theme.dataset.theme = isDark(el) ? "dark" : "light";
  }

  const observer = new MutationObserver(followTheme);
  for (const element of [document.documentElement, document.body]) {
    observer.observe(element, { attributes: true, attributeFilter: ["class", "style", "data-theme", "data-jp-theme-light", "data-jp-theme-name", "data-vscode-theme-kind"] });
  }
  model.on("change:view", show);
  model.on("change:ranges_number", showRange);
  followTheme();
  requestAnimationFrame(followTheme);
  show();

  return () => {
    clearTimeout(quiet);
    observer.disconnect();
    model.off("change:view", show);
    model.off("change:ranges_number", showRange);
  };
}

export default { render };
