// The contour editor: from the drawing to the words. A chain of lines and arcs, each with what the drawing gives of it.
import { type Card, choice, type DrawingWords, elementCard, field, setField } from "./chainCard";
import { chainPicture } from "./chainPicture";
import { AXES, type Chain, type ChainElement, type ChainEntry, elementOf, newElement, type Sketch } from "./chainSketch";
import { wordsPanel } from "./chainWords";
import { button, make, newId, showTabs } from "./dom";
import type { ControlName } from "./protocol";

const VIEWS = { elements: "Elements", drawing: "Drawing", words: "Words" };
type ViewName = keyof typeof VIEWS;
const UNCHECKED = { state: "unchecked", told: "not checked", off_mm: null };
const WIDE = 900; // px from which the elements stand beside the rest

export class ChainPane {
  readonly node: HTMLElement;
  private sketch: Sketch | null = null;
  private cards: Card[] = [];
  private structure = ""; // of the cards that are shown
  private chosen = 0; // number of the element at work
  private view: ViewName = "elements";
  private isWide = true;
  private readonly bar = make("div", { class: "views", "aria-label": "Views of the contour" });
  private readonly list = make("ol", { class: "cards", "aria-label": "Lines and arcs" });
  private readonly head = make("div", { class: "chain-head" });
  private readonly missing = make("p", { class: "missing", role: "status" });
  private readonly about = make("p", { class: "about muted" }); // the field that has the focus
  private readonly entries = make("div", { class: "bar entries", role: "group", "aria-label": "Entries that would finish it" });
  private readonly findings = make("ol", { class: "chain-findings", "aria-label": "Findings" });
  private readonly solutions = make("div", { class: "solutions", role: "group", "aria-label": "All contours that fit" });
  private readonly undo = button("Undo", () => this.sketch?.undo(), { title: "Ctrl+Z" });
  private readonly redo = button("Redo", () => this.sketch?.redo(), { title: "Ctrl+Y" });
  private readonly hints = make(
    "ol",
    { class: "steps" },
    make("li", { text: "Add lines and arcs in their order. Enter what the drawing gives, and leave all else empty, or write ? for it." }),
    make("li", { text: "The picture shows what is known. The line above it says what is missing." }),
    make("li", { text: "When it is finished, Words writes it for your control." }),
  );
  private readonly picture = chainPicture(
    (number) => this.focusElement(number),
    (number, place) => this.guess(number, place),
  );
  private readonly words;
  private readonly panels: Record<ViewName, HTMLElement>;
  private readonly side: HTMLElement;

  constructor(
    private readonly drawingWords: () => DrawingWords,
    controls: () => ControlName[],
    open: (name: string, text: string) => void,
  ) {
    this.words = wordsPanel(controls, open);
    const add = make(
      "div",
      { class: "bar" },
      button("Add a line", () => this.insert("line", this.count), { class: "main" }),
      button("Add an arc", () => this.insert("arc", this.count), { class: "main" }),
      this.undo,
      this.redo,
    );
    const panel = (name: ViewName, ...own: Node[]) => make("section", { class: `view ${name}`, role: "tabpanel", id: newId(), "aria-label": VIEWS[name] }, ...own);
    this.panels = {
      elements: panel("elements", this.head, this.hints, this.list, add),
      drawing: panel("drawing", this.picture.node, this.solutions, this.entries, this.findings),
      words: panel("words", this.words.node),
    };
    this.side = make("div", { class: "side" }, this.panels.drawing, this.panels.words);
    this.node = make("div", { class: "pane chain" }, this.bar, make("div", { class: "status" }, this.missing, this.about), this.panels.elements, this.side);
    this.node.addEventListener("keydown", (event) => this.pressed(event));
    this.node.addEventListener("focusin", (event) => {
      const label = (event.target as Element).closest("label");
      const name = (event.target as HTMLElement).dataset["field"] ?? "";
      this.about.textContent = label?.title ? `${/^[A-Z\d]+$/.test(name) ? `${name}: ` : ""}${label.title}` : "";
    });
    this.list.addEventListener("focusin", (event) => {
      const number = Number((event.target as Element).closest<HTMLElement>("[data-number]")?.dataset["number"] ?? 0);
      if (number && number !== this.chosen) {
        this.chosen = number;
        this.follow();
      }
    });
    new ResizeObserver(([entry]) => {
      this.isWide = entry!.contentRect.width >= WIDE;
      this.node.dataset["size"] = this.isWide ? "wide" : "narrow";
      this.choose(this.view);
    }).observe(this.node);
  }

  show(sketch: Sketch): void {
    if (this.sketch !== sketch) {
      this.sketch = sketch;
      this.chosen = sketch.chain.elements.length ? 1 : 0;
      this.structure = "";
      // An empty one begins where it is drawn.
      if (sketch.isEmpty) this.view = "elements";
    }
    this.choose(this.view);
    this.follow();
  }

  focus(): void {
    this.node.querySelector<HTMLElement>("select, input")?.focus();
  }

  private get count(): number {
    return this.sketch?.chain.elements.length ?? 0;
  }

  private choose(view: ViewName): void {
    this.view = view;
    const shown = this.isWide && view === "elements" ? "drawing" : view;
    const names = (Object.keys(VIEWS) as ViewName[]).filter((name) => !(this.isWide && name === "elements"));
    showTabs(this.bar, names.map((name) => ({ name, text: VIEWS[name], panel: this.panels[name].id })), shown, (name) => this.choose(name as ViewName));
    for (const [name, panel] of Object.entries(this.panels)) panel.hidden = !(name === shown || (this.isWide && name === "elements"));
    this.side.hidden = shown === "elements";
    if (this.sketch) this.words.show(this.sketch, shown === "words");
  }

  // Changes --------------------------------------------------------------------------------------------------------

  private change(mark: string, by: (chain: Chain) => void): void {
    this.sketch?.change(mark, by);
  }

  private changeElement(mark: string, number: number, by: (element: ChainElement) => void): void {
    this.change(mark, (chain) => {
      const element = chain.elements[number - 1];
      if (element) by(element);
    });
  }

  private insert(kind: "line" | "arc", at: number): void {
    this.change("", (chain) => chain.elements.splice(at, 0, newElement(kind)));
    this.focusElement(at + 1);
  }

  private move(number: number, by: number): void {
    const to = number + by;
    if (to < 1 || to > this.count) return;
    this.change("", (chain) => {
      const [element] = chain.elements.splice(number - 1, 1);
      if (element) chain.elements.splice(to - 1, 0, element);
    });
    this.focusElement(to);
  }

  private remove(number: number): void {
    this.change("", (chain) => chain.elements.splice(number - 1, 1));
    if (this.count) this.focusElement(Math.min(number, this.count));
    else this.focus();
  }

  private guess(number: number, place: [number, number]): void {
    const { chain } = this.sketch!;
    const scale = chain.unit === "inch" ? 25.4 : 1;
    const written = place.map((value, axis) => ((value * (chain.part === "turned" && axis === 1 ? 2 : 1)) / scale).toFixed(chain.unit === "inch" ? 3 : 2));
    this.changeElement("", number, (element) => void (element.guess = Object.fromEntries(AXES[chain.part].map((axis, at) => [axis, written[at]!]))));
  }

  private focusElement(number: number, name = ""): void {
    if (!this.isWide && this.view !== "elements") this.choose("elements");
    const card = this.cards[number - 1]?.node ?? this.head;
    const input = name ? card.querySelector<HTMLElement>(`[data-field="${CSS.escape(name)}"]`) : card.querySelector<HTMLElement>(".grid input");
    if (input?.closest(".more")) this.cards[number - 1]?.open();
    const hidden = input?.closest("details");
    if (hidden) hidden.open = true;
    input?.focus();
    card.scrollIntoView({ block: "nearest" });
    this.chosen = this.cards[number - 1] ? number : this.chosen;
    this.follow();
  }

  private pressed(event: KeyboardEvent): void {
    const isControl = event.ctrlKey || event.metaKey;
    const key = event.key.toLowerCase();
    const at = this.chosen;
    if (isControl && (key === "z" || key === "y")) key === "y" || event.shiftKey ? this.sketch?.redo() : this.sketch?.undo();
    else if (isControl && event.key === "Enter") this.insert(event.shiftKey ? "arc" : "line", at || this.count);
    else if (event.key === "Enter" && event.target instanceof HTMLInputElement && event.target.type === "text") this.next(event.target);
    else if (event.altKey && event.key === "ArrowDown" && at < this.count) this.focusElement(at + 1);
    else if (event.altKey && event.key === "ArrowUp" && at > 1) this.focusElement(at - 1);
    else if (event.altKey && event.key === "Delete" && at) this.remove(at);
    else return;
    event.preventDefault();
  }

  // Enter leads to the next field, from the last one to the button that adds a line.
  private next(field: HTMLInputElement): void {
    const all = [...this.panels.elements.querySelectorAll<HTMLElement>("input[type=text], button.main")].filter((each) => each.offsetParent !== null);
    all[all.indexOf(field) + 1]?.focus();
  }

  // What is shown --------------------------------------------------------------------------------------------------

  follow(): void {
    const { sketch } = this;
    if (!sketch) return;
    const { chain, view } = sketch;
    this.build(chain);
    this.chosen = Math.min(this.chosen, chain.elements.length);
    const wrong = this.wrong(sketch);
    const hints = new Map((view?.entries ?? []).map((entry) => [`${entry.number} ${entry.field}`, hintOf(entry)]));
    const isAsked = !sketch.isBehind && view !== null;
    chain.elements.forEach((element, place) => {
      const number = place + 1;
      const own = (all: Iterable<string>) => [...all].filter((each) => each.startsWith(`${number} `)).map((each) => each.slice(String(number).length + 1));
      const part = view?.elements.find((each) => each.name === `${element.kind} ${number}`);
      const card = this.cards[place]!;
      const told = new Map(own(hints.keys()).map((name) => [name, hints.get(`${number} ${name}`)!]));
      const state = sketch.isBehind ? UNCHECKED : { state: part?.state ?? "unknown", told: part?.told ?? "open", off_mm: part?.off_mm ?? null };
      card.show(element, state, new Set(own(wrong)), isAsked ? told : new Map(), sketch.measured[place] ?? {});
      card.node.classList.toggle("here", number === this.chosen);
    });
    for (const axis of AXES[chain.part]) setField(this.head, `start.${axis}`, chain.start[axis] ?? "", wrong.has(`0 start.${axis}`) || wrong.has("0 start"), "");
    for (const axis of AXES[chain.part]) setField(this.head, `pole.${axis}`, chain.pole[axis] ?? "", wrong.has("0 pole"), "");
    const closed = this.head.querySelector<HTMLInputElement>("[data-field=closed]")!;
    closed.checked = chain.closed;
    closed.setAttribute("aria-invalid", String(wrong.has("0 closed")));
    const facts = this.head.querySelector<HTMLTextAreaElement>("[data-field=facts]")!;
    if (facts.value !== chain.facts) facts.value = chain.facts;
    this.hints.hidden = chain.elements.length > 0;
    this.undo.setAttribute("aria-disabled", String(!sketch.canUndo));
    this.redo.setAttribute("aria-disabled", String(!sketch.canRedo));
    this.picture.show(chain, view, this.chosen, sketch.isBehind);
    this.tell(sketch);
    this.words.show(sketch, !this.panels.words.hidden);
  }

  // The fields that contradict, and the one that cannot be read.
  private wrong({ view, place, isBehind }: Sketch): Set<string> {
    const blamed = (isBehind ? [] : (view?.findings ?? [])).filter((each) => each.severity === "error").flatMap((each) => each.fields);
    return new Set([...blamed, ...(place ? [place] : [])].map(([number, name]) => `${number} ${name}`));
  }

  private tell({ view, trouble, isBehind, chain }: Sketch): void {
    this.missing.classList.toggle("wrong", isBehind);
    const isDone = view?.is_finished === true;
    const said = trouble || (isBehind ? "Not checked: contoursolve does not answer." : "") || (chain.elements.length ? (view?.said ?? "") : "Add the first line or arc.");
    if (this.missing.textContent !== said) this.missing.textContent = said;
    this.missing.classList.toggle("done", isDone && !isBehind);
    const place = (number: number, name: string) => (number ? `${name === "turn" ? "Sense" : name} of ${chain.elements[number - 1]?.kind ?? "line"} ${number}` : name.replace("start.", "start "));
    const shown = isBehind ? [] : (view?.entries ?? []);
    renew(this.entries, shown, () => shown.map((each) => button(`${place(each.number, each.field)}${each.example ? `: such as ${each.example}` : ""}`, () => this.focusElement(each.number, each.field), { title: [each.meaning, hintOf(each)].filter(Boolean).join("; ") })));
    const remarks = isBehind ? [] : (view?.remarks ?? []);
    // What is missing, and that several fit, stands above.
    const found = isBehind ? [] : (view?.findings ?? []).filter((each) => !["words-missing", "several-contours"].includes(each.code));
    const item = (each: (typeof found)[number]) =>
      make(
        "li",
        { class: each.severity },
        make("p", {}, make("strong", { text: { error: "Error", warning: "Warning" }[each.severity] ?? "Note" }), ` ${each.message}`),
        each.help ? make("p", { class: "muted", text: each.help }) : null,
        make("div", { class: "bar fixes" }, ...each.fixes.map((fix) => button(fix.title, () => this.mend(fix.elements)))),
      );
    renew(this.findings, [remarks, found], () => [...remarks.map((text) => make("li", { class: "info", text })), ...found.map(item)]);
    const several = isBehind ? [] : (view?.solutions ?? []);
    const choices = () => several.map((each) => {
      const made = button(`${each.name}${each.is_chosen ? " (chosen)" : ""}`, () => this.changeElement("", each.guess.number, (element) => void (element.guess = { ...each.guess.place })), { "aria-pressed": String(each.is_chosen) });
      for (const name of ["pointerenter", "focus"]) made.addEventListener(name, () => this.picture.ghost(each.segments));
      for (const name of ["pointerleave", "blur"]) made.addEventListener(name, () => this.picture.ghost(null));
      return made;
    });
    renew(this.solutions, several, () => several.length ? [make("p", { text: `${several.length} contours fit. Choose one: that writes a guess, and no dimension.` }), make("div", { class: "bar" }, ...choices())] : []);
  }

  private mend(elements: Record<string, Record<string, unknown>>): void {
    this.change("", (chain) => {
      for (const [number, plain] of Object.entries(elements)) chain.elements[Number(number) - 1] = elementOf(plain);
    });
  }

  // The cards are made anew where the chain has other elements than they show.
  private build(chain: Chain): void {
    const structure = JSON.stringify([chain.part, chain.unit, chain.elements.map((each) => each.kind)]);
    if (structure === this.structure) return;
    this.structure = structure;
    const root = this.node.getRootNode() as Document;
    const active = root.activeElement instanceof HTMLElement && this.node.contains(root.activeElement) ? root.activeElement : null;
    const focused = active ? [active.closest<HTMLElement>("[data-number]")?.dataset["number"] ?? "0", active.dataset["field"] ?? ""] : null;
    const host = {
      words: this.drawingWords(),
      change: (mark: string, number: number, by: (element: ChainElement) => void) => this.changeElement(mark, number, by),
      insert: (kind: "line" | "arc", at: number) => this.insert(kind, at),
      move: (number: number, by: number) => this.move(number, by),
      remove: (number: number) => this.remove(number),
    };
    this.cards = chain.elements.map((_, place) => elementCard(host, chain, place + 1));
    this.list.replaceChildren(...this.cards.map((each) => each.node));
    this.buildHead(chain);
    if (!focused) return;
    // The keys that follow stay in the editor.
    const within = focused[0] === "0" ? this.head : this.list.querySelector(`[data-number="${focused[0]}"]`);
    const same = focused[1] ? within?.querySelector<HTMLElement>(`[data-field="${CSS.escape(focused[1])}"]`) : null;
    (same ?? within?.querySelector<HTMLElement>("input") ?? this.head.querySelector<HTMLElement>("select"))?.focus();
  }

  private buildHead(chain: Chain): void {
    const closed = make("input", { type: "checkbox", "data-field": "closed" });
    closed.addEventListener("change", () => this.change("", (each) => void (each.closed = closed.checked)));
    const facts = make("textarea", { rows: 2, "data-field": "facts", "aria-label": "Statements about several elements, one in a line", placeholder: "length of line 1 = length of line 3", spellcheck: "false" });
    facts.addEventListener("input", () => this.change("facts", (each) => void (each.facts = facts.value)));
    const place = (name: "start" | "pole", title: string) =>
      AXES[chain.part].map((axis) =>
        field(`${title} ${axis}${chain.part === "turned" && axis === "X" ? " ⌀" : ""}`, `${name}.${axis}`, {
          value: chain[name][axis] ?? "",
          set: (value) => this.change(`${name}.${axis}`, (each) => void (each[name][axis] = value)),
        }),
      );
    const part = choice("Kind of part", "part", [["turned", "Turned part: Z and X"], ["milled", "Milled part: X and Y"]], chain.part, (value) =>
      this.change("", (each) => {
        each.part = value === "milled" ? "milled" : "turned";
        const words = this.drawingWords()[each.part];
        const kept = (values: Record<string, string>, names: readonly string[]) => Object.fromEntries(Object.entries(values).filter(([name]) => names.includes(name)));
        // What the other part does not have stays behind; undo brings it back.
        each.start = { ...Object.fromEntries(AXES[each.part].map((axis) => [axis, "0"])), ...kept(each.start, AXES[each.part]) };
        each.pole = kept(each.pole, AXES[each.part]);
        for (const element of each.elements) {
          element.words = kept(element.words, Object.keys(words?.[element.kind] ?? {}));
          element.guess = kept(element.guess, AXES[each.part]);
        }
      }),
    );
    const unit = choice("Unit", "unit", [["mm", "mm"], ["inch", "inch"]], chain.unit, (value) => this.change("", (each) => void (each.unit = value)));
    this.head.replaceChildren(
      make("div", { class: "bar" }, part, unit, make("label", { class: "check" }, closed, "ends where it begins")),
      make("div", { class: "grid" }, ...place("start", "Start")),
      make("details", {}, make("summary", { text: "More" }), make("div", { class: "grid" }, ...place("pole", "Pole")), make("label", {}, make("span", { class: "name", text: "Statements about several elements, one in a line" }), facts)),
    );
  }
}

const hintOf = (entry: ChainEntry): string => {
  const ranges = entry.ranges.map(({ low, high }) => (low && high ? `${low} to ${high}` : low ? `${low} or above` : high ? `${high} or below` : "any")).join(", or ");
  return [entry.example && `such as ${entry.example}`, ranges].filter(Boolean).join("; ");
};

const shownIn = new WeakMap<HTMLElement, string>();

// What is shown anew would lose the keys that follow to the page; what is the same stays.
function renew(host: HTMLElement, of: unknown, nodes: () => HTMLElement[]): void {
  const key = JSON.stringify(of);
  if (shownIn.get(host) === key) return;
  shownIn.set(host, key);
  const at = [...host.querySelectorAll("button")].findIndex((each) => each.matches(":focus"));
  host.replaceChildren(...nodes());
  const buttons = [...host.querySelectorAll("button")];
  if (at >= 0) buttons.at(Math.min(at, buttons.length - 1))?.focus();
}
