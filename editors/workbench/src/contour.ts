// The explorer of the contour at the cursor, with the front end that notebooks have.
import explorer from "../../../contoursolve/notebook/explorer.js";

import { make } from "./dom";
import type { Looked, Words } from "./protocol";

export interface Acted {
  changed?: Record<string, unknown>;
  state?: Record<string, unknown>; // all of it, where the text was changed meanwhile
  line: number | null;
  last: number | null;
  words?: Words;
}

// What the explorer takes for the widget of a notebook.
class Model {
  private readonly listeners = new Map<string, (() => void)[]>();

  constructor(
    private readonly state: Record<string, unknown>,
    private readonly act: (action: Record<string, unknown>) => void,
  ) {}

  get(name: string): unknown {
    return this.state[name];
  }

  set(name: string, value: unknown): void {
    this.state[name] = value;
  }

  save_changes(): void {
    this.act(this.state["action"] as Record<string, unknown>);
  }

  on(event: string, listener: () => void): void {
    this.listeners.set(event, [...(this.listeners.get(event) ?? []), listener]);
  }

  off(event: string, listener: () => void): void {
    this.listeners.set(event, (this.listeners.get(event) ?? []).filter((each) => each !== listener));
  }

  tell(changed: Record<string, unknown>): void {
    Object.assign(this.state, changed);
    for (const name of Object.keys(changed)) for (const listener of this.listeners.get(`change:${name}`) ?? []) listener();
  }
}

export interface ContourPanel {
  node: HTMLElement;
  open(looked: Looked | null): void;
  changed(news: Record<string, unknown>, words?: Words): void;
  light(line: number, column: number): void;
  words: Words;
}

export function contourPanel(act: (action: Record<string, unknown>) => void, point: (place: [number, number, number] | null) => void): ContourPanel {
  const place = make("div", {});
  const empty = make("p", { class: "empty" });
  const node = make("div", { class: "contour" }, empty, place);
  let close: (() => void) | null = null;
  let model: Model | null = null;

  const panel: ContourPanel = {
    node,
    words: {},
    open(looked) {
      empty.textContent = looked ? "" : "There is no contour to solve in this program yet. Its words, its drawing and its findings will be here.";
      empty.hidden = looked !== null;
      panel.words = looked?.words ?? {};
      close?.();
      close = model = null;
      place.replaceChildren();
      if (!looked) return;
      model = new Model({ ...looked.state }, act);
      close = explorer.render({ model, el: place });
    },
    changed(news, words) {
      panel.words = words ?? panel.words;
      model?.tell(news);
    },
    // The word at the cursor is lit here.
    light(line, column) {
      const keys = Object.entries(panel.words).flatMap(([key, [own, from, to]]) => (own === line && from <= column && column <= to ? [key] : []));
      for (const each of place.querySelectorAll<HTMLElement>("[data-word]")) {
        each.classList.toggle("lit", (each.dataset["word"] ?? "").split(" ").some((key) => keys.includes(key)));
      }
    },
  };
  // And what is pointed at here is lit in the text.
  const pointed = (event: Event) => {
    const word = (event.target as Element).closest?.<HTMLElement>("[data-word]")?.dataset["word"]?.split(" ")[0];
    point(word ? (panel.words[word] ?? null) : null);
  };
  for (const name of ["pointerover", "focusin", "pointerleave"]) place.addEventListener(name, pointed);
  return panel;
}
