// The contour editor: from the drawing to the words. A chain of lines and arcs, each with what the drawing gives of it.
import { type Card, type CardHost, chainHead, type DrawingWords, elementCard } from "./chainCard";
import { chainPicture } from "./chainPicture";
import { type Chain, type ChainElement, type ChainEntry, guessAt, type Kind, type Sketch } from "./chainSketch";
import { wordsPanel } from "./chainWords";
import { activeIn, button, make, renew } from "./dom";
import type { ControlName } from "./protocol";
import { Views } from "./views";

const VIEWS = { elements: "Elements", drawing: "Drawing", words: "Words" };
const UNCHECKED = { state: "unchecked", told: "not checked", off_mm: null };
const UNKNOWN = { state: "unknown", told: "open", off_mm: null };
const NOTHING = { entries: [], remarks: [], findings: [], solutions: [], elements: [], said: "" };
const SAID_ABOVE = ["words-missing", "several-contours"]; // findings that the line at the top says

export class ChainPane implements CardHost {
  private sketch: Sketch | null = null;
  private cards: Card[] = [];
  private fields: ReturnType<typeof chainHead> | null = null; // of the head
  private structure = ""; // of the cards that are shown
  private chosen = 0; // number of the element at work
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
  private readonly picture = chainPicture((number) => this.focusElement(number), (number, place) => this.guess(number, place));
  private readonly words;
  private readonly views: Views<keyof typeof VIEWS>;

  constructor(
    readonly drawingWords: () => DrawingWords,
    controls: () => ControlName[],
    open: (name: string, text: string) => void,
  ) {
    this.words = wordsPanel(controls, open);
    const add = (kind: Kind, text: string) => button(text, () => this.insert(kind, this.count), { class: "main" });
    const adding = make("div", { class: "bar" }, add("line", "Add a line"), add("arc", "Add an arc"), this.undo, this.redo);
    this.views = new Views(
      VIEWS,
      {
        elements: [this.head, this.hints, this.list, adding],
        drawing: [this.picture.node, this.solutions, this.entries, this.findings],
        words: [this.words.node],
      },
      { kind: "chain", label: "Views of the contour", beside: 900, above: make("div", { class: "status" }, this.missing, this.about) },
      () => this.showWords(),
    );
    this.node.addEventListener("keydown", (event) => this.pressed(event));
    this.node.addEventListener("focusin", ({ target }) => {
      const label = (target as Element).closest("label");
      const name = (target as HTMLElement).dataset["field"] ?? "";
      this.about.textContent = label?.title ? `${/^[A-Z\d]+$/.test(name) ? `${name}: ` : ""}${label.title}` : "";
    });
    this.list.addEventListener("focusin", ({ target }) => {
      const number = numberAt(target as Element);
      if (!number || number === this.chosen) return;
      this.chosen = number;
      this.follow();
    });
  }

  get node() { return this.views.node; }
  private get count() { return this.sketch?.chain.element.length ?? 0; }

  focus = (): void => this.head.querySelector<HTMLElement>("select")?.focus();

  show(sketch: Sketch): void {
    if (this.sketch !== sketch) {
      this.sketch = sketch;
      this.chosen = sketch.chain.element.length ? 1 : 0;
      this.structure = "";
      // An empty one begins where it is drawn.
      if (sketch.isEmpty) this.views.view = "elements";
    }
    this.views.choose(this.views.view);
    this.follow();
  }

  private showWords(): void {
    if (this.sketch) this.words.show(this.sketch, this.views.isShown("words"));
  }

  // Changes --------------------------------------------------------------------------------------------------------

  change = (mark: string, by: (chain: Chain) => void): void => this.sketch?.change(mark, by);

  changeElement(mark: string, number: number, by: (element: ChainElement) => void): void {
    this.change(mark, ({ element }) => element[number - 1] && by(element[number - 1]!));
  }

  insert(kind: Kind, at: number): void {
    this.change("", ({ element }) => element.splice(at, 0, { kind }));
    this.focusElement(at + 1);
  }

  move(number: number, by: number): void {
    const to = number + by;
    if (to < 1 || to > this.count) return;
    this.change("", ({ element }) => element.splice(to - 1, 0, ...element.splice(number - 1, 1)));
    this.focusElement(to);
  }

  remove(number: number): void {
    this.change("", ({ element }) => element.splice(number - 1, 1));
    if (this.count) this.focusElement(Math.min(number, this.count));
    else this.focus();
  }

  private guess(number: number, place: [number, number]): void {
    const guess = guessAt(this.sketch!.chain, place);
    this.changeElement("", number, (element) => (element.guess = guess));
  }

  private focusElement(number: number, name = ""): void {
    this.views.choose(this.views.isShown("elements") ? this.views.view : "elements");
    const card = this.cards[number - 1];
    const node = card?.node ?? this.head;
    const input = name ? fieldIn(node, name) : node.querySelector<HTMLElement>(".grid input");
    if (input?.closest(".more")) card?.open();
    const hidden = input?.closest("details");
    if (hidden) hidden.open = true;
    input?.focus();
    node.scrollIntoView({ block: "nearest" });
    if (card) this.chosen = number;
    this.follow();
  }

  private pressed(event: KeyboardEvent): void {
    const { altKey, shiftKey, target } = event;
    const isControl = event.ctrlKey || event.metaKey;
    const key = event.key.toLowerCase();
    const at = this.chosen;
    if (isControl && (key === "z" || key === "y")) key === "y" || shiftKey ? this.sketch?.redo() : this.sketch?.undo();
    else if (isControl && key === "enter") this.insert(shiftKey ? "arc" : "line", at || this.count);
    else if (key === "enter" && target instanceof HTMLInputElement && target.type === "text") this.next(target);
    else if (altKey && key === "arrowdown" && at < this.count) this.focusElement(at + 1);
    else if (altKey && key === "arrowup" && at > 1) this.focusElement(at - 1);
    else if (altKey && key === "delete" && at) this.remove(at);
    else if (key !== "escape" || !this.picture.end()) return;
    event.preventDefault();
  }

  // Enter leads to the next field, from the last one to the button that adds a line.
  private next(field: HTMLInputElement): void {
    const all = [...field.closest(".view")!.querySelectorAll<HTMLElement>("input[type=text], button.main")].filter((each) => each.offsetParent !== null);
    all[all.indexOf(field) + 1]?.focus();
  }

  // What is shown --------------------------------------------------------------------------------------------------

  follow(): void {
    const { sketch } = this;
    if (!sketch) return;
    const { chain, isBehind } = sketch;
    this.node.classList.toggle("waiting", sketch.isWaiting);
    this.node.classList.toggle("older", sketch.isOlder);
    const view = isBehind ? null : sketch.view; // of an earlier chain, nothing is told
    this.build(chain);
    this.chosen = Math.min(this.chosen, chain.element.length);
    const blamed = (view?.findings ?? []).filter((each) => each.severity === "error").flatMap((each) => each.fields);
    const wrongIn = (number: number) => new Set([...blamed, ...(sketch.place ? [sketch.place] : [])].flatMap(([own, name]) => (own === number ? [name] : [])));
    chain.element.forEach((element, place) => {
      const number = place + 1;
      const card = this.cards[place]!;
      const state = isBehind ? UNCHECKED : (view?.elements.find((each) => each.name === `${element.kind} ${number}`) ?? UNKNOWN);
      card.show(element, state, wrongIn(number), (name) => {
        const entry = view?.entries.find((each) => each.number === number && each.field === name);
        const measured = sketch.measured[place]?.[name];
        return entry ? hintOf(entry) : measured && !element[name] ? `in the drawing ${measured}` : "";
      });
      card.node.classList.toggle("here", number === this.chosen);
    });
    this.fields!.show(chain, wrongIn(0), () => "");
    this.hints.hidden = chain.element.length > 0;
    this.undo.setAttribute("aria-disabled", String(!sketch.canUndo));
    this.redo.setAttribute("aria-disabled", String(!sketch.canRedo));
    this.picture.show({ chain, view: sketch.view, chosen: this.chosen, isBehind });
    this.tell(sketch);
    this.showWords();
  }

  private tell({ view, trouble, isBehind, chain }: Sketch): void {
    const { entries, remarks, findings, solutions, said } = (isBehind ? null : view) ?? NOTHING;
    const told = trouble || (isBehind ? "Not checked: contoursolve does not answer." : "") || (chain.element.length ? said : "Add the first line or arc.");
    if (this.missing.textContent !== told) this.missing.textContent = told;
    this.missing.classList.toggle("wrong", isBehind);
    this.missing.classList.toggle("done", !isBehind && view?.is_finished === true);
    const nameOf = ({ number, field }: ChainEntry) => (number ? `${field === "turn" ? "Sense" : field} of ${chain.element[number - 1]?.kind ?? "line"} ${number}` : field.replace("start.", "start "));
    renew(this.entries, entries, () =>
      entries.map((each) => button(`${nameOf(each)}${each.example ? `: such as ${each.example}` : ""}`, () => this.focusElement(each.number, each.field), { title: [each.meaning, hintOf(each)].filter(Boolean).join("; ") })),
    );
    const found = findings.filter((each) => !SAID_ABOVE.includes(each.code));
    const item = (each: (typeof found)[number]) =>
      make(
        "li",
        { class: each.severity },
        make("p", {}, make("strong", { text: { error: "Error", warning: "Warning" }[each.severity] ?? "Note" }), ` ${each.message}`),
        each.help && make("p", { class: "muted", text: each.help }),
        make("div", { class: "bar fixes" }, ...each.fixes.map((fix) => button(fix.title, () => this.mend(fix.elements)))),
      );
    renew(this.findings, [remarks, found], () => [...remarks.map((text) => make("li", { class: "info", text })), ...found.map(item)]);
    const choice = (each: (typeof solutions)[number]) => {
      const made = button(`${each.name}${each.is_chosen ? " (chosen)" : ""}`, () => this.changeElement("", each.guess.number, (element) => (element.guess = { ...each.guess.place })), { "aria-pressed": String(each.is_chosen) });
      for (const name of ["pointerenter", "focus"]) made.addEventListener(name, () => this.picture.ghost(each.segments));
      for (const name of ["pointerleave", "blur"]) made.addEventListener(name, () => this.picture.ghost([]));
      return made;
    };
    renew(this.solutions, solutions, () =>
      solutions.length ? [make("p", { text: `${solutions.length} contours fit. Choose one: that writes a guess, and no dimension.` }), make("div", { class: "bar" }, ...solutions.map(choice))] : [],
    );
  }

  private mend(elements: Record<string, ChainElement>): void {
    this.change("", (chain) => {
      for (const [number, plain] of Object.entries(elements)) chain.element[Number(number) - 1] = plain;
    });
  }

  // The cards are made anew where the chain has other elements than they show; the keys that follow stay in the editor.
  private build(chain: Chain): void {
    const structure = JSON.stringify([chain.part, chain.unit, chain.element.map((each) => each.kind)]);
    if (structure === this.structure) return;
    this.structure = structure;
    const active = activeIn(this.node);
    const isOurs = active instanceof HTMLElement && (this.head.contains(active) || this.list.contains(active));
    const [number, name] = isOurs ? [numberAt(active), active.dataset["field"] ?? ""] : [0, ""];
    this.cards = chain.element.map((_, place) => elementCard(this, chain, place + 1));
    this.list.replaceChildren(...this.cards.map((each) => each.node));
    this.fields = chainHead(this.head, this, chain.part);
    if (!isOurs) return;
    const within = number ? this.cards[number - 1]?.node : this.head;
    const same = within && ((name && fieldIn(within, name)) || within.querySelector<HTMLElement>("input"));
    if (same) same.focus();
    else this.focus();
  }
}

const fieldIn = (node: ParentNode, name: string) => node.querySelector<HTMLElement>(`[data-field="${CSS.escape(name)}"]`);
const numberAt = (node: Element): number => Number(node.closest<HTMLElement>("[data-number]")?.dataset["number"] ?? 0);

const hintOf = ({ example, ranges }: ChainEntry): string => {
  const told = ranges.map(({ low, high }) => (low && high ? `${low} to ${high}` : low ? `${low} or above` : high ? `${high} or below` : "any")).join(", or ");
  return [example && `such as ${example}`, told].filter(Boolean).join("; ");
};
