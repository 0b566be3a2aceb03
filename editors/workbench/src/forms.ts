// The tool, and the variables of a subprogram, as fields.
import { button, labelled, make, newId } from "./dom";
import type { VariableField } from "./protocol";

export interface ToolState {
  radius: string;
  tip: string;
  side: string;
}

const TIPS = ["", "1", "2", "3", "4", "5", "6", "7", "8", "9"];
const SIDES: [string, string][] = [
  ["", "as the program says"],
  ["left", "left of the way (G41)"],
  ["right", "right of the way (G42)"],
];

export const decimal = (text: string): string => text.trim().replace(",", ".");

export interface ToolPanel {
  node: HTMLElement;
  show(tool: ToolState, unit: string, note: string): void;
}

export function toolPanel(set: (tool: ToolState, isHeld: boolean) => void): ToolPanel {
  const radius = make("input", { type: "text", inputmode: "decimal", autocomplete: "off" });
  const slider = make("input", { type: "range", min: 0, max: 25, step: 0.1, "aria-label": "Radius of the tool, slider" });
  const tip = make("select", {}, ...TIPS.map((each) => make("option", { value: each, text: each || "none: a cutter" })));
  const side = make("select", {}, ...SIDES.map(([value, text]) => make("option", { value, text })));
  const unit = make("span", { class: "unit" });
  const said = make("p", { role: "status" });
  const state = (): ToolState => ({ radius: decimal(radius.value), tip: tip.value, side: side.value });
  const node = make(
    "form",
    { class: "fields", onsubmit: (event: Event) => event.preventDefault() },
    make("p", { class: "muted", text: "With a radius, the drawing shows the way of the tool and what it cannot reach." }),
    labelled("Radius of the tool", radius, unit),
    slider,
    labelled("Tip of a turning tool", tip),
    labelled("Side", side),
    make("div", { class: "answers" }, button("Without tool", () => {
      radius.value = "";
      set(state(), false);
    })),
    said,
  );
  slider.addEventListener("input", () => {
    radius.value = slider.value;
    set(state(), true);
  });
  for (const each of [radius, tip, side]) each.addEventListener("change", () => set(state(), false));
  return {
    node,
    show(tool, isIn, note) {
      const active = (node.getRootNode() as Document).activeElement;
      if (active !== radius) radius.value = tool.radius;
      if (active !== slider) {
        const value = Number(tool.radius) || 0;
        slider.max = String(Math.max(isIn === "inch" ? 1 : 25, 2 * value));
        slider.step = isIn === "inch" ? "0.005" : "0.1";
        slider.value = String(value);
      }
      if (active !== tip) tip.value = tool.tip;
      if (active !== side) side.value = tool.side;
      unit.textContent = isIn;
      said.textContent = note;
    },
  };
}

export interface VariablesPanel {
  node: HTMLElement;
  show(fields: VariableField[], results: { line: number; text: string }[], note: string): void;
}

export function variablesPanel(set: (values: Record<string, string>) => void, go: (line: number) => void): VariablesPanel {
  const list = make("div", { class: "variables" });
  const said = make("p", { role: "status" });
  const rows = make("ul", { class: "contours", "aria-label": "What it comes to" });
  const node = make("form", { class: "fields", onsubmit: (event: Event) => event.preventDefault() }, said, list, rows);
  let names = "";
  const inputs = new Map<string, HTMLInputElement>();
  const send = () => set(Object.fromEntries([...inputs].filter(([, input]) => input.value.trim()).map(([name, input]) => [name, decimal(input.value)])));
  list.addEventListener("change", send);
  return {
    node,
    show(fields, results, note) {
      said.textContent = note || (fields.length ? "Values with which the subprogram is called:" : "This program takes no variables from outside.");
      const now = fields.map((each) => each.name).join(" ");
      if (now !== names) {
        names = now;
        inputs.clear();
        for (const { name } of fields) inputs.set(name, make("input", { type: "text", inputmode: "decimal", autocomplete: "off", id: newId() }));
        list.replaceChildren(...fields.map(({ name, meaning }) => labelled([name, meaning].filter(Boolean).join(": "), inputs.get(name)!)));
      }
      const active = (node.getRootNode() as Document).activeElement;
      for (const { name, value } of fields) {
        const input = inputs.get(name)!;
        if (active !== input && value) input.value = value;
      }
      rows.replaceChildren(...results.map((each) => make("li", {}, make("button", { type: "button", onclick: () => go(each.line) }, make("span", { class: "line", text: `line ${each.line}` }), ` ${each.text}`))));
    },
  };
}
