// Views of one thing: as tabs, or, where there is room, the first one beside a chosen other.
import { make, newId, showTabs } from "./dom";

const WIDE = 900; // px from which the first view stands beside the others

export class Views<Name extends string> {
  readonly node: HTMLElement;
  view: Name;
  private isWide = innerWidth >= WIDE;
  private readonly names: Name[];
  private readonly first: Name;
  private readonly panels: Record<Name, HTMLElement>;
  private readonly bar: HTMLElement;
  private readonly side: HTMLElement;

  constructor(
    private readonly titles: Record<Name, string>,
    nodes: Record<Name, Node[]>,
    options: { kind: string; label: string; above?: HTMLElement },
    private readonly moved: () => void,
    private readonly isThere: (name: Name) => boolean = () => true,
  ) {
    this.names = Object.keys(titles) as Name[];
    this.view = this.first = this.names[0]!;
    const panel = (name: Name) => make("section", { class: `view ${name}`, role: "tabpanel", id: newId(), tabindex: -1, "aria-label": titles[name] }, ...nodes[name]);
    this.panels = Object.fromEntries(this.names.map((name) => [name, panel(name)])) as Record<Name, HTMLElement>;
    const [first, ...others] = this.names.map((name) => this.panels[name]);
    this.bar = make("div", { class: "views", "aria-label": options.label });
    this.side = make("div", { class: "side" }, ...others);
    this.node = make("div", { class: `pane ${options.kind}` }, this.bar, options.above, first, this.side);
    new ResizeObserver(([entry]) => {
      this.isWide = entry!.contentRect.width >= WIDE;
      this.choose(this.view);
    }).observe(this.node);
  }

  choose(view: Name): void {
    const isMoved = view !== this.view;
    this.view = view;
    this.node.dataset["size"] = this.isWide ? "wide" : "narrow";
    const isBeside = (name: Name) => this.isWide && name === this.first;
    const shown = isBeside(view) ? this.names[1]! : view;
    const tabs = this.names.filter((name) => !isBeside(name) && this.isThere(name));
    showTabs(this.bar, tabs.map((name) => ({ name, text: this.titles[name], panel: this.panels[name].id })), shown, (name) => this.choose(name as Name));
    for (const name of this.names) this.panels[name].hidden = name !== shown && !isBeside(name);
    this.side.hidden = shown === this.first;
    if (isMoved) this.moved();
  }

  isShown(view: Name): boolean {
    return !this.panels[view].hidden;
  }

  focus(view: Name): void {
    this.panels[view].querySelector<HTMLElement>("button")?.focus();
  }
}
