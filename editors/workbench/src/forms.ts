// The tool, and the variables of a subprogram, as fields.
import { activeIn, button, decimal, keepFocus, labelled, make, newId, numberField, picture, renew, scroller, select, textField } from "./dom";
import { type Place, placeList, placeOf } from "./drawing";
import type { ContourRow, Finding } from "./protocol";

export type ToolState = { radius: string; tip: string; side: string };
type Run = { line: number; title: string; fits: boolean };
export type Tooled = { svg: string; findings: Finding[]; runs: Run[]; largest_mm: number | null };
type Variable = { name: string; set_on: number | null; number: number | null; value: number | null };
export type Varied = { svg: string; fields: Variable[]; left_out: number; findings: Finding[]; contours: ContourRow[] };

export const PROGRAM = "program"; // the tool that the program states
// The programmed point seen from the centre of the nose, Z to the right and X up.
const WAYS = ["↗ Z+ X+", "↖ Z- X+", "↙ Z- X-", "↘ Z+ X-", "→ Z+", "↑ X+", "← Z-", "↓ X-", "• the centre"];
const TIPS = [["", "not chosen"] as const, ...WAYS.map((way, place) => [String(place + 1), `${place + 1}  ${way}`] as const)];
const SIDES = [["", "as the program says"], ["left", "left of the way (G41)"], ["right", "right of the way (G42)"]] as const;
const PAUSE = 200; // ms without a key after which values count

const foundAt = (findings: Finding[]): Place[] => findings.map((each) => ({ line: each.line, text: each.message, kind: each.severity === "error" ? "unsolved" : "several" }));
const drawing = () => scroller("div", "Drawing of the contour", { class: "canvas contoursolve" });
const fields = (...own: HTMLElement[]) => make("form", { class: "fields", onsubmit: (event: Event) => event.preventDefault() }, ...own);

// `plain` is the drawing without the tool; a turned part needs a tip.
export type ToolShown = { tool: ToolState; unit: string; isTurned: boolean; tooled: Tooled | null; trouble: string; plain: string | null };

export function toolPanel(set: (tool: ToolState) => void, go: (line: number) => void) {
  const radius = numberField();
  const slider = make("input", { type: "range", min: 0, max: 25, step: 0.1, "aria-label": "Radius of the tool, slider" });
  const [tip, side] = [select(TIPS), select(SIDES)];
  const unit = make("span", { class: "unit" });
  const tips = labelled("Tip of the turning tool", tip);
  const said = make("p", { role: "status" });
  const paper = drawing();
  const list = placeList("Ways of the tool and what is found about them", go);
  const use = (value: string) => {
    radius.value = value;
    set({ radius: decimal(value), tip: tip.value, side: side.value });
  };
  let due = 0;
  slider.addEventListener("input", () => {
    radius.value = slider.value;
    cancelAnimationFrame(due);
    due = requestAnimationFrame(() => use(slider.value));
  });
  for (const each of [radius, tip, side]) each.addEventListener("change", () => use(radius.value));
  const slide = (typed: string) => {
    const value = Number(decimal(typed)) || 0;
    slider.max = String(Math.max(slider.step === "0.005" ? 1 : 25, 2 * value));
    slider.value = String(value);
  };
  radius.addEventListener("input", () => slide(radius.value));
  return {
    node: fields(
      make("div", { class: "columns" }, make("div", {}, labelled("Radius of the tool", radius, unit), slider), tips, labelled("Side", side)),
      make("div", { class: "bar" }, button("The tool of the program", () => use(PROGRAM)), button("Without tool", () => use(""))),
      said,
      paper,
      list.node,
    ),
    show({ tool, unit: isIn, isTurned, tooled, trouble, plain }: ToolShown) {
      const active = activeIn(paper);
      if (active !== radius) radius.value = tool.radius;
      if (active !== slider) {
        slider.step = isIn === "inch" ? "0.005" : "0.1";
        slide(tool.radius);
      }
      [tip.value, side.value, unit.textContent, tips.hidden] = [tool.tip, tool.side, isIn, !isTurned];
      const largest = tooled?.largest_mm ?? null;
      const told = tooled ? (largest === null ? "" : `The largest radius that reaches all of it is ${largest.toFixed(3)} mm.`) : trouble || "With a radius, the drawing shows the way of the tool and what it cannot reach.";
      if (said.textContent !== told) said.textContent = told;
      said.classList.toggle("wrong", trouble !== "" && !tooled);
      const svg = tooled?.svg ?? plain ?? "";
      renew(paper, svg, () => picture(svg));
      const runs = tooled?.runs.map((each) => ({ line: each.line, text: each.title, kind: each.fits ? "fine" : "unsolved" })) ?? [];
      list.show([...runs, ...foundAt(tooled?.findings ?? [])]);
    },
  };
}

export function variablesPanel(set: (values: Record<string, number>, start: string) => void, go: (line: number) => void) {
  const list = make("div", { class: "columns" });
  const said = make("p", { role: "status" });
  const paper = drawing();
  const rows = placeList("What it comes to", go);
  const start = textField({ placeholder: "where the program says it", title: "Words such as X60. Z2." });
  const starts = labelled("Start point, in words such as X60. Z2.", start);
  starts.hidden = true;
  const node = fields(said, list, starts, paper, rows.node);
  const inputs = new Map<string, HTMLInputElement>();
  let names = "";
  let timer = 0;
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
    // Of another program than before, with the start point that it was given.
    show(varied: Varied, isOther: boolean, begun: string) {
      const { fields: own, left_out } = varied;
      const more = left_out ? ` ${left_out} more are not shown.` : "";
      said.textContent = own.length ? `Give values, and the contours follow. The text stays as it is, and the findings beside it are without them.${more}` : "This program has no variables.";
      starts.hidden = !own.length;
      const now = own.map((each) => `${each.name} ${each.set_on}`).join();
      if (isOther) {
        inputs.clear();
        start.value = begun;
      }
      if (isOther || now !== names) {
        names = now;
        const before = new Map(inputs);
        inputs.clear();
        for (const { name, value } of own) inputs.set(name, before.get(name) ?? numberField({ value, id: newId() }));
        const told = (set_on: number | null) => (set_on === null ? "given by the call" : `set on line ${set_on}`);
        keepFocus(list, () => list.replaceChildren(...own.map((each) => labelled(`${each.name}: ${told(each.set_on)}`, inputs.get(each.name)!))));
      }
      for (const { name, number } of own) inputs.get(name)!.placeholder = number === null ? "" : String(number);
      const svg = own.length ? varied.svg : "";
      renew(paper, svg, () => picture(svg));
      rows.show(own.length ? [...varied.contours.map(placeOf), ...foundAt(varied.findings)] : []);
    },
  };
}
