// The words of a sketch for a control: the shortest first, and the same for all controls as a table.
import { button, copyText, download, make } from "./dom";
import { AXES, type Sketch } from "./chainSketch";
import type { ControlName } from "./protocol";

interface Word {
  text: string;
  rests: string; // drawing, round, computed
}

interface Candidate {
  title?: string;
  block: string;
  program: string;
  words?: Word[];
}

interface Written {
  title: string;
  candidates: Candidate[];
  reason: string;
  ending: string; // of the files of its programs
}

interface Row {
  control: string;
  title: string;
  block: string;
  reason: string;
}

const RESTS: Record<string, string> = { drawing: "from the drawing", round: "exact, but not from the drawing", computed: "computed and rounded" };

export interface WordsPanel {
  node: HTMLElement;
  show(sketch: Sketch, isWanted: boolean): void;
}

export function wordsPanel(controls: () => ControlName[], open: (name: string, text: string) => void): WordsPanel {
  let sketch: Sketch | null = null;
  let made = ""; // for which sketch and control
  let offered = ""; // the kind of machine whose controls are offered
  const control = make("select", { onchange: () => void ask() });
  const said = make("p", { role: "status", class: "muted" });
  const list = make("div", { class: "candidates" });
  const table = make("div", {});
  const all = button("The same for all controls", () => void askAll());
  const node = make("div", { class: "result words" }, make("div", { class: "bar" }, make("label", {}, make("span", { text: "Write it for" }), control), all), said, list, table);

  async function ask(): Promise<void> {
    const asked = sketch;
    if (!asked) return;
    const mark = `${control.value} ${asked.trouble} ${asked.text}`;
    if (mark === made) return;
    made = mark;
    table.replaceChildren();
    const isReady = !asked.isBehind && asked.view?.is_finished === true;
    all.setAttribute("aria-disabled", String(!isReady));
    if (!isReady) {
      said.textContent = asked.trouble || "The contour is not finished yet: enter what is missing, then its words are written here.";
      list.replaceChildren();
      return;
    }
    said.textContent = "Writing …";
    const written = await asked.words<Written>(control.value);
    if (mark !== made) return;
    said.textContent = written?.reason ?? "";
    list.replaceChildren(...(written?.candidates ?? []).map((each, number) => candidate(each, number, asked, written?.ending ?? "")));
    const start = AXES[asked.chain.part].map((axis) => `${axis}${asked.chain.start[axis] || "0"}`).join(" ");
    if (written?.candidates.length) list.prepend(make("p", { class: "muted", text: `The blocks begin at ${start}. Tool, speed, feed, approach and retract are yours to add.` }));
  }

  function candidate(each: Candidate, number: number, asked: Sketch, ending: string): HTMLElement {
    const copied = make("span", { role: "status" });
    const name = `${asked.name.replace(/\.[^.]*$/, "") || "contour"}-${control.value}${ending}`;
    const words = (each.words ?? []).map((word) => make("span", { class: `word ${word.rests}`, text: word.text, title: RESTS[word.rests] ?? word.rests }));
    const counts = Object.entries(RESTS).map(([kind, text]) => [text, (each.words ?? []).filter((word) => word.rests === kind).length] as const).filter(([, count]) => count);
    return make(
      "section",
      { class: "candidate", "aria-label": each.title ?? `Way ${number + 1}` },
      make("h2", { text: each.title ?? (number ? `Way ${number + 1}` : "The shortest") }),
      make("pre", { tabindex: 0, role: "group", "aria-label": "Words", text: each.block }),
      counts.length ? make("p", { class: "muted", text: counts.map(([text, count]) => `${count} ${count === 1 ? "word" : "words"} ${text}`).join(", ") }) : null,
      words.some((word) => word.className.includes("computed")) ? make("p", { class: "muted" }, "Computed: ", ...words.filter((word) => word.className.includes("computed")).flatMap((word) => [word, " "])) : null,
      make(
        "div",
        { class: "bar" },
        button("Copy", async () => (copied.textContent = (await copyText(each.block)) ? "copied" : "press Ctrl+C")),
        button("Open as a program", () => open(name, each.program)),
        button("Download", () => download(name, each.program)),
        copied,
      ),
    );
  }

  async function askAll(): Promise<void> {
    const asked = sketch;
    if (!asked?.view?.is_finished || asked.isBehind) return;
    said.textContent = "Writing for all controls …";
    const reply = await asked.words<{ rows: Row[] }>(null);
    said.textContent = "";
    if (!reply || asked !== sketch) return;
    const row = (each: Row) => make("tr", {}, make("th", { scope: "row", text: each.title }), make("td", {}, make("pre", { text: each.block || "-" }), each.reason ? make("p", { class: "muted", text: each.reason }) : null));
    const head = make("tr", {}, make("th", { scope: "col", text: "Control" }), make("th", { scope: "col", text: "Words" }));
    table.replaceChildren(make("div", { class: "scroll", tabindex: 0, role: "group", "aria-label": "The same for all controls" }, make("table", {}, make("thead", {}, head), make("tbody", {}, ...reply.rows.map(row)))));
    table.firstElementChild?.scrollIntoView({ block: "nearest" });
  }

  return {
    node,
    show(now, isWanted) {
      sketch = now;
      const machine = sketch.chain.part === "turned" ? "lathe" : "mill";
      if (machine !== offered) {
        const { value } = control;
        const alike = controls().filter((each) => each.machines?.includes(machine) !== false);
        control.replaceChildren(...alike.map((each) => make("option", { value: each.name, text: each.title })));
        if (alike.some((each) => each.name === value)) control.value = value;
        if (alike.length) offered = machine;
      }
      if (isWanted) void ask();
    },
  };
}
