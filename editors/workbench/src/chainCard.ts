// The head of a sketch, and one line or arc of it as a card: the usual fields, and under "more" all others.
import { button, make, newId } from "./dom";
import { Fields } from "./chainFields";
import { AXES, type Chain, type ChainElement, type ChainView, CORNERS, type Kind, kept, keepWords, KINDS, PARTS, TURNS, UNITS } from "./chainSketch";

export type DrawingWords = Record<string, Record<Kind, Record<string, string>>>;
export type PartState = Pick<ChainView["elements"][number], "state" | "told" | "off_mm">;

// What a card asks of the editor in which it stands.
export interface CardHost {
  drawingWords(): DrawingWords;
  change(mark: string, by: (chain: Chain) => void): void;
  changeElement(mark: string, number: number, by: (element: ChainElement) => void): void;
  insert(kind: Kind, at: number): void;
  move(number: number, by: number): void;
  remove(number: number): void;
}

const isDiameter = (part: string, name: string): boolean => part === "turned" && name.endsWith("X") && !name.startsWith("R");
const sized = (part: string, name: string): string => `${name.slice(-1)}${isDiameter(part, name) ? " ⌀" : ""}`;

const sizeOf = ({ corner = {} }: ChainElement): string => Object.values(corner)[0] ?? "";

function resize(element: ChainElement, size: string | boolean): void {
  for (const shape of Object.keys(element.corner ?? {})) element.corner![shape] = String(size);
}

// What the usual fields are called on a drawing; the others are called as their words.
function usual(part: Chain["part"], kind: Kind): [string, string][] {
  const ends = AXES[part].map((axis): [string, string] => [axis, `End ${sized(part, axis)}`]);
  if (kind === "line") return [...ends, ["AN", "Angle"], ["LEN", "Length"]];
  return [...ends, ["R", "Radius"], ...AXES[part].map((axis): [string, string] => [`CC${axis}`, `Centre ${sized(part, axis)}`])];
}

export function elementCard(host: CardHost, chain: Chain, number: number) {
  const element = chain.element[number - 1]!;
  const { part } = chain;
  const { kind } = element;
  const name = `${kind} ${number}`;
  const words = host.drawingWords()[part];
  const own = words?.[kind] ?? {};
  const first = usual(part, kind);
  const rest = Object.keys(own).filter((word) => !first.some(([each]) => each === word));
  const fields = new Fields<ChainElement>((typed, by) => host.changeElement(typed && `${number} ${typed}`, number, by));
  const word = (title: string, key: string, isTold = false) =>
    fields.text(title, key, fields.own(key), { label: `${name}: ${title}`, meaning: `${own[key] ?? ""}${isDiameter(part, key) ? ", as a diameter" : ""}`, isTold });
  // That of an arc may tell its centre.
  const guessed = [...AXES[part], ...(kind === "arc" ? AXES[part].map((axis) => `CC${axis}`) : [])];
  const guess = guessed.map((word) => {
    const [axis, isCentre] = [word.slice(-1), word.length > 1];
    return fields.text(`About ${isCentre ? "centre " : ""}${axis}`, `guess.${word}`, fields.within("guess", word), {
      label: `${name}: guess of its ${isCentre ? "centre" : "end"}, ${axis}`,
      meaning: `about where ${isCentre ? "its centre is" : "it ends"}: it chooses among several contours, and is no dimension`,
    });
  });
  const kinds = fields.choice(`${name}: line or arc`, "kind", KINDS, {
    read: (each) => each.kind,
    // Words of the other kind stay behind.
    write: (each, value) => {
      Object.assign(each, { kind: value, turn: "" });
      keepWords(each, words?.[each.kind] ?? {});
    },
  });
  const turn = kind === "arc" ? fields.choice(`${name}: sense`, "turn", TURNS, fields.own("turn")) : null;
  const smooth = fields.check("tangent to the one before", "tangent");
  const corner = fields.choice(`${name}: corner after it`, "shape", CORNERS, {
    read: ({ corner = {} }) => Object.keys(corner)[0] ?? "",
    write: (each, shape) => (each.corner = shape ? { [String(shape)]: sizeOf(each) } : {}),
  });
  const size = fields.text("Size", "corner", { read: sizeOf, write: resize }, { meaning: "radius of the rounding, or how far the chamfer goes along each line", label: `${name}: size of the corner` });
  const state = make("span", { class: "chip" });
  const more = make(
    "div",
    { class: "more", id: newId(), hidden: true },
    make("div", { class: "grid" }, ...rest.map((key) => word(key, key, true))),
    make("p", { class: "muted", text: `A guess of where it ends${kind === "arc" ? ", or of its centre," : ""} chooses among several contours. It is never taken for a dimension.` }),
    make("div", { class: "grid" }, ...guess),
    fields.statements("Statements, one in a line", `${name}: statements, one in a line`, `chord of ${name} = 20`),
  );
  const toggle = button("More", () => open(more.hidden === true), { "aria-expanded": "false", "aria-controls": more.id, "aria-label": `More of ${name}` });
  const open = (isOpen: boolean) => {
    more.hidden = !isOpen;
    toggle.setAttribute("aria-expanded", String(isOpen));
  };
  const node = make(
    "li",
    { class: "card", "data-number": number, "data-element": name },
    make("div", { class: "bar title" }, make("h2", { text: name }), state),
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
  open(rest.some((key) => element[key]) || Object.values(element.guess ?? {}).some(Boolean) || Boolean(element.facts?.length));

  return {
    node,
    open: () => open(true),
    show(now: ChainElement, is: PartState, wrong: Set<string>, hintOf: (name: string) => string) {
      node.dataset["state"] = is.state;
      state.textContent = `${is.told}${is.off_mm === null ? "" : `: off by ${is.off_mm.toFixed(3)} mm`}`;
      fields.show(now, wrong, hintOf);
      size.hidden = !Object.keys(now.corner ?? {}).length;
      smooth.hidden = number === 1 && !now.tangent; // before the first one is nothing
      if (rest.some((key) => wrong.has(key))) open(true);
    },
  };
}

export type Card = ReturnType<typeof elementCard>;

// What holds for all of a sketch; made anew into `node` where the kind of part is another.
export function chainHead(node: HTMLElement, host: CardHost, part: Chain["part"]) {
  const fields = new Fields<Chain>(host.change);
  const axes = AXES[part];
  const place = (name: "start" | "pole", title: string) =>
    axes.map((axis) => fields.text(`${title} ${sized(part, axis)}`, `${name}.${axis}`, fields.within(name, axis)));
  const parts = fields.choice("Kind of part", "part", PARTS, {
    read: (chain) => chain.part,
    // What the other part does not have stays behind; undo brings it back.
    write: (chain, value) => {
      chain.part = value as Chain["part"];
      const own = AXES[chain.part];
      chain.start = { ...Object.fromEntries(own.map((axis) => [axis, "0"])), ...kept(chain.start, own) };
      chain.pole = kept(chain.pole, own);
      for (const each of chain.element) {
        keepWords(each, host.drawingWords()[chain.part]?.[each.kind] ?? {});
        each.guess = kept(each.guess ?? {}, own);
      }
    },
  });
  node.replaceChildren(
    make("div", { class: "bar" }, parts, fields.choice("Unit", "unit", UNITS, fields.own("unit")), fields.check("ends where it begins", "closed")),
    make("div", { class: "grid" }, ...place("start", "Start")),
    make(
      "details",
      {},
      make("summary", { text: "More" }),
      make("div", { class: "grid" }, ...place("pole", "Pole")),
      fields.statements("Statements about several elements, one in a line", "Statements about several elements, one in a line", "length of line 1 = length of line 3"),
    ),
  );
  return fields;
}
