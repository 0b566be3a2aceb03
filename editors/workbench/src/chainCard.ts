// One line or arc of a sketch as a card: the usual fields, and behind "more" all others.
import { button, make, newId } from "./dom";
import { AXES, type Chain, type ChainElement, type ChainView, type Values } from "./chainSketch";

export type DrawingWords = Record<string, Record<"line" | "arc", Record<string, string>>>;

export interface CardHost {
  words: DrawingWords;
  change(mark: string, number: number, by: (element: ChainElement) => void): void;
  insert(kind: "line" | "arc", at: number): void;
  move(number: number, by: number): void;
  remove(number: number): void;
}

export interface Card {
  node: HTMLElement;
  open(): void;
  show(element: ChainElement, state: PartState, wrong: Set<string>, hints: Map<string, string>, measured: Values): void;
}

export type PartState = Pick<ChainView["elements"][number], "state" | "told" | "off_mm">;

const isDiameter = (part: string, name: string): boolean => part === "turned" && name.endsWith("X") && !name.startsWith("R");

// What the usual fields are called on a drawing; the others are called as their words.
function usual(part: Chain["part"], kind: "line" | "arc"): [string, string][] {
  const [first, second] = AXES[part];
  const sized = (name: string) => `${name.slice(-1)}${isDiameter(part, name) ? " ⌀" : ""}`;
  const ends: [string, string][] = [first, second].map((axis) => [axis, `End ${sized(axis)}`]);
  if (kind === "line") return [...ends, ["AN", "Angle"], ["LEN", "Length"]];
  const centres: [string, string][] = [`CC${first}`, `CC${second}`].map((name) => [name, `Centre ${sized(name)}`]);
  return [...ends, ["R", "Radius"], ...centres];
}

export function field(title: string, name: string, host: { value: string; set: (value: string) => void; label?: string; meaning?: string }): HTMLElement {
  const hint = make("span", { class: "hint", id: newId() });
  const input = make("input", { type: "text", inputmode: "text", autocomplete: "off", spellcheck: "false", "data-field": name, "aria-describedby": hint.id });
  if (host.label) input.setAttribute("aria-label", host.label);
  input.value = host.value;
  input.addEventListener("input", () => host.set(input.value));
  const code = name !== title && !title.endsWith(name) && /^[A-Z\d]+$/.test(name) && !title.startsWith("End ") ? make("span", { class: "code", text: name }) : null;
  const label = make("span", { class: "name" }, title, code);
  return make("label", { title: host.meaning ?? null }, label, input, hint);
}

export function setField(node: ParentNode, name: string, value: string, isWrong: boolean, hint: string): void {
  const input = node.querySelector<HTMLInputElement>(`[data-field="${CSS.escape(name)}"]`);
  if (!input) return;
  if (input.value !== value) input.value = value;
  input.setAttribute("aria-invalid", String(isWrong));
  const told = input.parentElement?.querySelector(".hint");
  if (told && told.textContent !== hint) told.textContent = hint;
}

export function elementCard(host: CardHost, chain: Chain, number: number): Card {
  const element = chain.elements[number - 1]!;
  const { part } = chain;
  const { kind } = element;
  const name = `${kind} ${number}`;
  const own = host.words[part]?.[kind] ?? {};
  const first = usual(part, kind);
  const rest = Object.keys(own).filter((word) => !first.some(([each]) => each === word));
  const word = (title: string, key: string) =>
    field(title, key, {
      value: element.words[key] ?? "",
      label: `${name}: ${title}`,
      meaning: (own[key] ?? "") + (isDiameter(part, key) ? ", as a diameter" : ""),
      set: (value) => host.change(`${number} ${key}`, number, (each) => void (each.words[key] = value)),
    });
  const told = (key: string) => {
    const made = word(key, key);
    made.querySelector(".name")!.append(make("span", { class: "meaning", text: own[key] ?? "" }));
    return made;
  };
  // That of an arc may tell its centre.
  const guessed = [...AXES[part], ...(kind === "arc" ? AXES[part].map((axis) => `CC${axis}`) : [])];
  const guess = guessed.map((axis) =>
    field(`About ${axis.replace("CC", "centre ")}`, `guess.${axis}`, {
      value: element.guess[axis] ?? "",
      label: `${name}: guess of its end, ${axis}`,
      meaning: "about where it ends: it chooses among several contours, and is no dimension",
      set: (value) => host.change(`${number} guess.${axis}`, number, (each) => void (each.guess[axis] = value)),
    }),
  );
  const state = make("span", { class: "chip", id: newId() });
  const heading = make("h2", { text: name });
  const kinds = choice(`${name}: line or arc`, "kind", [["line", "Line"], ["arc", "Arc"]], kind, (value) =>
    host.change("", number, (each) => {
      each.kind = value === "arc" ? "arc" : "line";
      // Words of the other kind stay behind.
      each.words = Object.fromEntries(Object.entries(each.words).filter(([key]) => key in (host.words[part]?.[each.kind] ?? {})));
      each.turn = "";
    }),
  );
  const turn = kind === "arc" ? choice(`${name}: sense`, "turn", [["", "Sense not given"], ["cw", "Clockwise"], ["ccw", "Counter-clockwise"]], element.turn, (value) => host.change("", number, (each) => void (each.turn = value))) : null;
  const tangent = make("input", { type: "checkbox", "data-field": "tangent" });
  tangent.addEventListener("change", () => host.change("", number, (each) => void (each.tangent = tangent.checked)));
  const smooth = make("label", { class: "check" }, tangent, "tangent to the one before");
  const corner = choice(`${name}: corner behind it`, "shape", [["", "none"], ["rounding", "Rounding"], ["chamfer", "Chamfer"]], element.corner, (value) => host.change("", number, (each) => void (each.corner = value)));
  const size = field("Size", "corner", { meaning: "radius of the rounding, or how far the chamfer goes along each line", value: element.size, label: `${name}: size of the corner`, set: (value) => host.change(`${number} corner`, number, (each) => void (each.size = value)) });
  const facts = make("textarea", { rows: 2, "data-field": "facts", "aria-label": `${name}: statements, one in a line`, placeholder: `chord of ${name} = 20`, spellcheck: "false" });
  facts.addEventListener("input", () => host.change(`${number} facts`, number, (each) => void (each.facts = facts.value)));
  const more = make("div", { class: "more", id: newId(), hidden: true }, make("div", { class: "grid" }, ...rest.map(told)), make("p", { class: "muted", text: "A guess of where it ends chooses among several contours. It is never taken for a dimension." }), make("div", { class: "grid" }, ...guess), make("label", {}, make("span", { class: "name", text: "Statements, one in a line" }), facts));
  const toggle = button("More", () => open(more.hidden === true), { "aria-expanded": "false", "aria-controls": more.id, "aria-label": `More of ${name}` });
  const open = (isOpen: boolean) => {
    more.hidden = !isOpen;
    toggle.setAttribute("aria-expanded", String(isOpen));
  };
  const node = make(
    "li",
    { class: "card", "data-number": number, "data-element": name },
    make("div", { class: "bar title" }, heading, state),
    make("div", { class: "bar" }, kinds, turn, smooth),
    make("div", { class: "grid" }, ...first.map(([key, title]) => word(title, key)), make("label", {}, make("span", { class: "name", text: "Corner" }), corner), size),
    make(
      "div",
      { class: "bar actions" },
      toggle,
      button("Line after it", () => host.insert("line", number), { title: "Ctrl+Enter" }),
      button("Arc after it", () => host.insert("arc", number), { title: "Ctrl+Shift+Enter" }),
      button("↑", () => host.move(number, -1), { "aria-label": `Move ${name} up` }),
      button("↓", () => host.move(number, 1), { "aria-label": `Move ${name} down` }),
      button("Remove", () => host.remove(number), { "aria-label": `Remove ${name}`, title: "Alt+Delete" }),
    ),
    more,
  );
  const hasMore = (each: ChainElement) => rest.some((key) => each.words[key]) || Object.values(each.guess).some(Boolean) || each.facts !== "";
  open(hasMore(element));

  return {
    node,
    open: () => open(true),
    show(now, is, wrong, hints, measured) {
      node.dataset["state"] = is.state;
      state.textContent = `${is.told}${is.off_mm === null ? "" : `: off by ${is.off_mm.toFixed(3)} mm`}`;
      const value = (key: string, values: Values) => values[key] ?? "";
      for (const key of [...first.map(([each]) => each), ...rest]) {
        const hint = hints.get(key) ?? (measured[key] && !now.words[key] ? `in the drawing ${measured[key]}` : "");
        setField(node, key, value(key, now.words), wrong.has(key), hint);
      }
      for (const axis of guessed) setField(node, `guess.${axis}`, value(axis, now.guess), wrong.has("guess"), "");
      setField(node, "corner", now.size, wrong.has("corner"), hints.get("corner") ?? "");
      size.hidden = !now.corner;
      corner.value = now.corner;
      if (turn) turn.value = now.turn;
      tangent.checked = now.tangent;
      smooth.hidden = number === 1 && !now.tangent; // before the first one is nothing
      if (facts.value !== now.facts) facts.value = now.facts;
      if ([...wrong].some((key) => rest.includes(key))) open(true);
    },
  };
}

export function choice(label: string, name: string, options: [string, string][], value: string, set: (value: string) => void): HTMLSelectElement {
  const select = make("select", { "aria-label": label, "data-field": name }, ...options.map(([each, text]) => make("option", { value: each, text })));
  select.value = value;
  select.addEventListener("change", () => set(select.value));
  return select;
}
