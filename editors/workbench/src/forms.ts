// The tool, and the variables of a subprogram, as fields.
import { button, labelled, make, newId, picture } from "./dom";
import type { ContourRow, Finding } from "./protocol";

export interface ToolState {
  radius: string;
  tip: string;
  side: string;
}

export interface Tooled {
  svg: string;
  findings: Finding[];
  runs: { line: number; last: number; title: string; fits: boolean; largest_mm: number | null }[];
  largest_mm: number | null;
}

export interface Varied {
  svg: string;
  fields: { name: string; line: number; set_on: number | null; number: number | null; value: number | null }[];
  left_out: number;
  findings: Finding[];
  contours: ContourRow[];
}

export const PROGRAM = "program"; // the tool that the program states
const TIPS = ["", "1", "2", "3", "4", "5", "6", "7", "8", "9"];
// The programmed point seen from the centre of the nose, Z to the right and X up.
const WAYS: Record<string, string> = { "1": "↗ Z+ X+", "2": "↖ Z- X+", "3": "↙ Z- X-", "4": "↘ Z+ X-", "5": "→ Z+", "6": "↑ X+", "7": "← Z-", "8": "↓ X-", "9": "• the centre" };
const SIDES: [string, string][] = [
  ["", "as the program says"],
  ["left", "left of the way (G41)"],
  ["right", "right of the way (G42)"],
];

export const decimal = (text: string): string => text.trim().replace(",", ".");

// A list of places in the program, each a button.
function places(title: string, go: (line: number) => void): { node: HTMLElement; show: (rows: { line: number; text: string; kind: string }[]) => void } {
  const node = make("ul", { class: "contours", "aria-label": title });
  const row = (each: { line: number; text: string; kind: string }) =>
    make("li", {}, make("button", { type: "button", class: each.kind, onclick: () => go(each.line) }, make("span", { class: "line", text: `line ${each.line}` }), ` ${each.text}`));
  return { node, show: (rows) => node.replaceChildren(...rows.slice(0, MOST).map(row)) };
}

const MOST = 100; // places that are listed
const placesOf = (findings: Finding[]) => findings.map((each) => ({ line: each.line, text: each.message, kind: each.severity === "error" ? "unsolved" : "several" }));
const drawn = (svg: string) => [picture(svg)].filter((each) => each !== null);

export interface ToolPanel {
  node: HTMLElement;
  show(tool: ToolState, unit: string, tooled: Tooled | null, trouble: string, plain: string | null): void; // plain: the drawing without the tool
}

export function toolPanel(set: (tool: ToolState) => void, go: (line: number) => void): ToolPanel {
  const radius = make("input", { type: "text", inputmode: "decimal", autocomplete: "off" });
  const slider = make("input", { type: "range", min: 0, max: 25, step: 0.1, "aria-label": "Radius of the tool, slider" });
  const tip = make("select", {}, ...TIPS.map((each) => make("option", { value: each, text: each ? `${each}  ${WAYS[each]}` : "none: a cutter" })));
  const side = make("select", {}, ...SIDES.map(([value, text]) => make("option", { value, text })));
  const unit = make("span", { class: "unit" });
  const said = make("p", { role: "status" });
  const paper = make("div", { class: "canvas contoursolve", tabindex: 0, role: "group", "aria-label": "Drawing of the contour" });
  const list = places("Ways of the tool and what is found about them", go);
  const state = (): ToolState => ({ radius: decimal(radius.value), tip: tip.value, side: side.value });
  const use = (value: string) => {
    radius.value = value;
    set(state());
  };
  const node = make(
    "form",
    { class: "fields", onsubmit: (event: Event) => event.preventDefault() },
    labelled("Radius of the tool", radius, unit),
    slider,
    labelled("Tip of a turning tool", tip),
    labelled("Side", side),
    make("div", { class: "answers" }, button("The tool of the program", () => use(PROGRAM)), button("Without tool", () => use(""))),
    said,
    paper,
    list.node,
  );
  let shown: Tooled | null = null;
  let shownSvg = "";
  const toldBefore = (trouble: string) => trouble || "With a radius, the drawing shows the way of the tool and what it cannot reach.";
  let due = 0;
  slider.addEventListener("input", () => {
    radius.value = slider.value;
    cancelAnimationFrame(due);
    due = requestAnimationFrame(() => set(state()));
  });
  for (const each of [radius, tip, side]) each.addEventListener("change", () => set(state()));
  return {
    node,
    show(tool, isIn, tooled, trouble, plain) {
      const active = (node.getRootNode() as Document).activeElement;
      if (active !== radius) radius.value = tool.radius;
      if (active !== slider) {
        const value = Number(tool.radius) || 0;
        slider.max = String(Math.max(isIn === "inch" ? 1 : 25, 2 * value));
        slider.step = isIn === "inch" ? "0.005" : "0.1";
        slider.value = String(value);
      }
      unit.textContent = isIn;
      said.className = trouble !== "" && !tooled ? "wrong" : "";
      const svg = tooled?.svg ?? plain ?? "";
      if (tooled === shown && (tooled || svg === shownSvg)) {
        said.textContent = tooled ? said.textContent : toldBefore(trouble);
        return;
      }
      shownSvg = svg;
      shown = tooled;
      const largest = tooled?.largest_mm;
      said.textContent = !tooled
        ? toldBefore(trouble)
        : largest === null || largest === undefined ? "" : `The largest radius that reaches all of it is ${largest.toFixed(3)} mm.`;
      paper.replaceChildren(...drawn(svg));
      const runs = tooled?.runs.map((each) => ({ line: each.line, text: each.title, kind: each.fits ? "fine" : "unsolved" })) ?? [];
      list.show([...runs, ...placesOf(tooled?.findings ?? [])]);
    },
  };
}

export interface VariablesPanel {
  node: HTMLElement;
  show(varied: Varied): void;
}

const PAUSE = 200; // ms without a key after which values count

export function variablesPanel(set: (values: Record<string, number>, start: string) => void, go: (line: number) => void): VariablesPanel {
  const list = make("div", { class: "variables" });
  const said = make("p", { role: "status" });
  const paper = make("div", { class: "canvas contoursolve", tabindex: 0, role: "group", "aria-label": "Drawing of the contour" });
  const rows = places("What it comes to", go);
  const start = make("input", { type: "text", autocomplete: "off", spellcheck: "false", placeholder: "where the program says it", title: "Words such as X60. Z2." });
  const starts = labelled("Start point, in words such as X60. Z2.", start);
  const node = make("form", { class: "fields", onsubmit: (event: Event) => event.preventDefault() }, said, list, starts, paper, rows.node);
  let names = "";
  let timer = 0;
  const inputs = new Map<string, HTMLInputElement>();
  const read = () => {
    clearTimeout(timer);
    const values = [...inputs].map(([name, input]) => [name, decimal(input.value)] as const).filter(([, value]) => value);
    const wrong = values.find(([, value]) => !Number.isFinite(Number(value)));
    for (const [name, input] of inputs) input.setAttribute("aria-invalid", String(name === wrong?.[0]));
    if (wrong) said.textContent = `${wrong[0]}: ${wrong[1]} is no number; write one such as 12.5.`;
    else set(Object.fromEntries(values.map(([name, value]) => [name, Number(value)])), start.value.trim());
  };
  node.addEventListener("input", () => {
    clearTimeout(timer);
    timer = setTimeout(read, PAUSE);
  });
  node.addEventListener("change", read);
  return {
    node,
    show(varied) {
      const { fields, left_out } = varied;
      const more = left_out ? ` ${left_out} more are not shown.` : "";
      said.textContent = fields.length ? `Give values, and the contours follow. The text stays as it is, and the findings beside it are without them.${more}` : "This program has no variables.";
      starts.hidden = !fields.length;
      const now = fields.map((each) => each.name).join(" ");
      if (now !== names) {
        names = now;
        inputs.clear();
        for (const { name } of fields) inputs.set(name, make("input", { type: "text", inputmode: "decimal", autocomplete: "off", id: newId() }));
        const told = (each: Varied["fields"][number]) => `${each.name}: ${each.set_on === null ? "given by the call" : `set on line ${each.set_on}`}`;
        list.replaceChildren(...fields.map((each) => labelled(told(each), inputs.get(each.name)!)));
      }
      for (const { name, number } of fields) inputs.get(name)!.placeholder = number === null ? "" : String(number);
      paper.replaceChildren(...(fields.length ? drawn(varied.svg) : []));
      const contours = fields.length ? varied.contours.map((each) => ({ line: each.line, text: `${each.title}: ${each.told}`, kind: each.status === "solved" ? "fine" : "unsolved" })) : [];
      rows.show([...contours, ...(fields.length ? placesOf(varied.findings) : [])]);
    },
  };
}
