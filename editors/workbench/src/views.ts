// Views of one thing: as tabs, or, where there is room, the first one beside a chosen other.
import { make, newId, showTabs } from "./dom";

type Places<Name extends string> = {
  kind: string;
  label: string;
  above?: HTMLElement;
  beside: number; // px from which the first view stands beside the others
  wide?: number; // and from which there is room for a part of it on the other side, too
  withFirst?: NoInfer<Name>; // this one is shown with the first view, however narrow it is
  tools?: Partial<Record<NoInfer<Name>, HTMLElement>>; // beside the tabs, while it is shown
  between?: HTMLElement[]; // bars between views
};

export class Views<Name extends string> {
  readonly node: HTMLElement;
  view: Name;
  private size: "wide" | "middle" | "narrow" = "wide";
  private readonly names: Name[];
  private readonly first: Name;
  private readonly panels: Record<Name, HTMLElement>;
  private readonly bar: HTMLElement;
  private readonly side: HTMLElement;

  constructor(
    private readonly titles: Record<Name, string>,
    nodes: Record<Name, Node[]>,
    private readonly places: Places<Name>,
    private readonly moved: () => void,
    private readonly isThere: (name: Name) => boolean = () => true,
  ) {
    this.names = Object.keys(titles) as Name[];
    this.view = this.first = this.names[0]!;
    const { kind, label, above, beside, wide = beside, tools = {}, between = [] } = places;
    const panel = (name: Name) => make("section", { class: `view ${name}`, role: "tabpanel", id: newId(), tabindex: -1, "aria-label": titles[name] }, ...nodes[name]);
    this.panels = Object.fromEntries(this.names.map((name) => [name, panel(name)])) as Record<Name, HTMLElement>;
    const [first, ...others] = this.names.map((name) => this.panels[name]);
    this.bar = make("div", { class: "tablist", "aria-label": label });
    const head = make("div", { class: "views" }, this.bar, ...(Object.values(tools) as HTMLElement[]));
    this.side = make("div", { class: "side" }, ...others);
    this.node = make("div", { class: `pane ${kind}` }, head, above, first, this.side, ...between);
    const fit = (width: number) => {
      this.size = width >= wide ? "wide" : width >= beside ? "middle" : "narrow";
      this.choose(this.view);
    };
    fit(innerWidth);
    new ResizeObserver(([entry]) => fit(entry!.contentRect.width)).observe(this.node);
  }

  choose(view: Name): void {
    const { names, first, panels, places } = this;
    const isMoved = view !== this.view;
    this.view = view;
    const isBeside = (name: Name) => name === first && this.size !== "narrow";
    const shown = isBeside(view) ? names[1]! : view;
    Object.assign(this.node.dataset, { size: this.size, view: shown });
    const tabs = names.filter((name) => !isBeside(name) && this.isThere(name));
    showTabs(this.bar, tabs.map((name) => ({ name, text: this.titles[name], panel: panels[name].id })), shown, (name) => this.choose(name as Name));
    for (const name of names) panels[name].hidden = name !== shown && !isBeside(name) && !(name === first && shown === places.withFirst);
    for (const [name, node] of Object.entries(places.tools ?? {}) as [Name, HTMLElement][]) node.hidden = name !== shown;
    this.side.hidden = shown === first;
    if (isMoved) this.moved();
  }

  isShown(view: Name): boolean {
    return !this.panels[view].hidden;
  }

  focus(view: Name): void {
    this.panels[view].querySelector<HTMLElement>("button")?.focus();
  }
}

// A bar between two views that sets the width of one of them, `property` of `host`: it is dragged, or moved by arrow keys.
export function splitter(host: () => HTMLElement, label: string, property: string, [least, at, most]: [number, number, number], way: 1 | -1): HTMLElement {
  let width = at;
  const set = (wanted: number): void => {
    width = Math.round(Math.max(least, Math.min(most, wanted)));
    host().style.setProperty(property, `${width}px`);
    node.setAttribute("aria-valuenow", String(width));
  };
  const node = make("div", {
    class: `split of${property.slice(1)}`, role: "separator", tabindex: 0, "aria-orientation": "vertical", "aria-label": label,
    "aria-valuemin": least, "aria-valuemax": most, "aria-valuenow": at,
    onpointerdown: (event: PointerEvent) => {
      const [from, before] = [event.clientX, width];
      node.setPointerCapture(event.pointerId);
      node.onpointermove = (moved) => set(before + way * (moved.clientX - from));
      node.onpointerup = node.onpointercancel = () => (node.onpointermove = null);
      event.preventDefault();
    },
    ondblclick: () => set(at),
    onkeydown: (event: KeyboardEvent) => {
      const step = { ArrowLeft: -16, ArrowRight: 16 }[event.key];
      if (!step) return;
      set(width + way * step);
      event.preventDefault();
    },
  });
  return node;
}
