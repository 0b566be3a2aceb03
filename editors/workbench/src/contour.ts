// The explorer of the contour at the cursor, with the front end that notebooks have.
import explorer, { type Model } from "../../../contoursolve/notebook/explorer.js";

import { make } from "./dom";
import type { Looked, Words } from "./protocol";

// `state` is all of it, where the text was changed meanwhile.
export type Acted = Looked & { changed?: Record<string, unknown> };

// What the explorer takes for the widget of a notebook.
class Held implements Model {
  private readonly news = new EventTarget();

  constructor(
    private readonly state: Record<string, unknown>,
    private readonly act: (action: Record<string, unknown>) => void,
  ) {}

  get = (name: string): unknown => this.state[name];
  set = (name: string, value: unknown): unknown => (this.state[name] = value);
  save_changes = (): void => this.act(this.state["action"] as Record<string, unknown>);
  on = (event: string, listener: () => void): void => this.news.addEventListener(event, listener);
  off = (event: string, listener: () => void): void => this.news.removeEventListener(event, listener);

  tell(changed: Record<string, unknown>): void {
    Object.assign(this.state, changed);
    for (const name of Object.keys(changed)) this.news.dispatchEvent(new Event(`change:${name}`));
  }
}

export function contourPanel(act: (action: Record<string, unknown>) => void, point: (place: Words[string] | null) => void) {
  const place = make("div", {});
  const empty = make("p", { class: "empty" });
  let words: Words = {};
  let close: (() => void) | null = null;
  let model: Held | null = null;
  // What is pointed at here is lit in the text.
  const pointed = (event: Event) => {
    const word = (event.target as Element).closest?.<HTMLElement>("[data-word]")?.dataset["word"]?.split(" ")[0];
    point(word ? (words[word] ?? null) : null);
  };
  for (const name of ["pointerover", "focusin", "pointerleave"]) place.addEventListener(name, pointed);

  return {
    node: make("div", { class: "contour" }, empty, place),
    open(looked: Looked | null) {
      empty.textContent = looked ? "" : "There is no contour to solve in this program yet. Its words, its drawing and its findings will be here.";
      empty.hidden = looked !== null;
      words = looked?.words ?? {};
      close?.();
      close = model = null;
      place.replaceChildren();
      if (!looked) return;
      model = new Held({ ...looked.state }, act);
      close = explorer.render({ model, el: place });
    },
    changed(news: Record<string, unknown>, now?: Words) {
      words = now ?? words;
      model?.tell(news);
    },
    // And the word at the cursor is lit here.
    light(line: number, column: number) {
      const keys = Object.entries(words).flatMap(([key, [own, from, to]]) => (own === line && from <= column && column <= to ? [key] : []));
      for (const each of place.querySelectorAll<HTMLElement>("[data-word]")) {
        each.classList.toggle("lit", (each.dataset["word"] ?? "").split(" ").some((key) => keys.includes(key)));
      }
    },
  };
}
