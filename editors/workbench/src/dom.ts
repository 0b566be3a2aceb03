// Elements of the page. Texts are set as text, never as HTML; pictures come from contoursolve's own painter.

type Properties = Record<string, string | boolean | number | null | undefined | ((event: never) => void)>;

export function make<Kind extends keyof HTMLElementTagNameMap>(
  kind: Kind,
  properties: Properties = {},
  ...children: (Node | string | null | undefined | false)[]
): HTMLElementTagNameMap[Kind] {
  const element = document.createElement(kind);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (name === "text") element.textContent = String(value);
    else if (typeof value === "function") element.addEventListener(name.slice(2), value as EventListener);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children.filter((child): child is Node | string => child !== null && child !== undefined && child !== false));
  return element;
}

export function button(text: string, action: (event: MouseEvent) => void, properties: Properties = {}): HTMLButtonElement {
  return make("button", { type: "button", text, onclick: action, ...properties });
}

export function picture(svg: string): SVGSVGElement | null {
  const root = new DOMParser().parseFromString(svg, "image/svg+xml").documentElement;
  return root.localName === "svg" ? (document.importNode(root, true) as unknown as SVGSVGElement) : null;
}

const ZOOMS = [1, 1.5, 2, 3, 4, 6, 8];

// Buttons, and the wheel with Ctrl, that set the size of what a box shows in part.
export function zoomBar(size: (times: number) => void, scroller: HTMLElement, of: string): HTMLElement {
  let zoom = 0;
  const smaller = button("−", () => zoomTo(zoom - 1), { "aria-label": "Smaller" });
  const larger = button("+", () => zoomTo(zoom + 1), { "aria-label": "Larger" });
  const whole = button("Whole", () => zoomTo(0));

  function zoomTo(wanted: number): void {
    const before = ZOOMS[zoom]!;
    zoom = Math.max(0, Math.min(ZOOMS.length - 1, wanted));
    const by = ZOOMS[zoom]! / before;
    // The middle of what is seen stays there.
    const [x, y] = [scroller.scrollLeft + scroller.clientWidth / 2, scroller.scrollTop + scroller.clientHeight / 2];
    size(ZOOMS[zoom]!);
    scroller.scrollTo(x * by - scroller.clientWidth / 2, y * by - scroller.clientHeight / 2);
    smaller.setAttribute("aria-disabled", String(zoom === 0));
    larger.setAttribute("aria-disabled", String(zoom === ZOOMS.length - 1));
  }
  scroller.addEventListener(
    "wheel",
    (event) => {
      if (!event.ctrlKey) return;
      event.preventDefault();
      zoomTo(zoom + (event.deltaY < 0 ? 1 : -1));
    },
    { passive: false },
  );
  zoomTo(0);
  return make("div", { class: "bar zoom", role: "group", "aria-label": `Size of ${of}` }, smaller, larger, whole);
}

let count = 0;
export function newId(): string {
  count += 1;
  return `wb-${count}`;
}

export function labelled(text: string, control: HTMLElement, note?: HTMLElement): HTMLLabelElement {
  return make("label", {}, make("span", { text }), control, note);
}

// A button that opens a menu. Its entries are asked for each time it opens.
export interface Entry {
  text: string;
  key?: string;
  act: () => void;
  isOff?: boolean;
}

export function menu(text: string, entries: () => Entry[]): HTMLElement {
  const list = make("div", { role: "menu", class: "menu", hidden: true, "aria-label": text });
  const opener = button(text, () => (list.hidden ? open() : close()), { "aria-haspopup": "menu", "aria-expanded": "false", "aria-label": text });
  const whole = make("div", { class: "dropdown" }, opener, list);
  const items = () => [...list.children] as HTMLElement[];

  function open(): void {
    list.replaceChildren(
      ...entries().map((each) =>
        make(
          "button",
          { type: "button", role: "menuitem", tabindex: -1, "aria-disabled": each.isOff ? "true" : null, onclick: () => choose(each) },
          make("span", { text: each.text }),
          each.key ? make("kbd", { text: each.key }) : null,
        ),
      ),
    );
    list.hidden = false;
    opener.setAttribute("aria-expanded", "true");
    items()[0]?.focus();
  }

  function close(isFocused = false): void {
    list.hidden = true;
    opener.setAttribute("aria-expanded", "false");
    if (isFocused) opener.focus();
  }

  function choose(entry: Entry): void {
    if (entry.isOff) return;
    close(true);
    entry.act();
  }

  opener.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowDown") return;
    event.preventDefault();
    open();
  });
  list.addEventListener("keydown", (event) => {
    const all = items();
    const at = all.indexOf(event.target as HTMLElement);
    const next = { ArrowDown: at + 1, ArrowUp: at - 1 + all.length, Home: 0, End: all.length - 1 }[event.key];
    if (event.key === "Escape") close(true);
    else if (event.key === "Tab") return close();
    else if (next !== undefined) all[next % all.length]?.focus();
    else {
      const first = all.find((each, place) => place > at && each.textContent?.toLowerCase().startsWith(event.key.toLowerCase()));
      if (event.key.length > 1 || !first) return;
      first.focus();
    }
    event.preventDefault();
    event.stopPropagation();
  });
  whole.addEventListener("focusout", (event) => {
    if (event.relatedTarget instanceof Node && !whole.contains(event.relatedTarget)) close();
  });
  // A touch beside it closes it; the path tells where, also from inside a shadow root.
  document.addEventListener("pointerdown", (event) => {
    if (!list.hidden && !event.composedPath().includes(whole)) close();
  });
  return whole;
}

// Tabs: the arrow keys go from one to the next.
export interface Tab {
  name: string;
  text: string;
  title?: string;
  panel: string;
}

export function showTabs(bar: HTMLElement, tabs: Tab[], chosen: string, choose: (name: string) => void): void {
  bar.setAttribute("role", "tablist");
  const isFocused = bar.contains((bar.getRootNode() as Document).activeElement);
  const old = new Map(([...bar.children] as HTMLElement[]).map((each) => [each.dataset["name"], each]));
  const shown = tabs.map((each) => {
    const node = old.get(each.name) ?? button("", () => choose(each.name), { role: "tab", "data-name": each.name, id: newId() });
    node.textContent = each.text;
    node.setAttribute("aria-controls", each.panel);
    node.setAttribute("aria-selected", String(each.name === chosen));
    node.tabIndex = each.name === chosen ? 0 : -1;
    if (each.title) node.title = each.title;
    return node;
  });
  if (shown.length !== bar.children.length || shown.some((node, place) => node !== bar.children[place])) bar.replaceChildren(...shown);
  bar.onkeydown = (event) => {
    const at = tabs.findIndex((each) => each.name === (event.target as HTMLElement).dataset["name"]);
    const next = { ArrowRight: at + 1, ArrowLeft: at - 1 + tabs.length, Home: 0, End: tabs.length - 1 }[event.key];
    if (at < 0 || next === undefined) return;
    event.preventDefault();
    choose(tabs[next % tabs.length]!.name);
  };
  const now = shown.find((each) => each.dataset["name"] === chosen);
  if (isFocused) now?.focus();
  now?.scrollIntoView?.({ block: "nearest", inline: "nearest" });
}

// A question that is asked over the page; what was answered, or null where its user thought better of it.
export function dialog(host: Node, title: string, fields: HTMLElement[], accept: string, others: string[] = []): Promise<string | null> {
  const heading = make("h2", { text: title, id: newId() });
  const form = make(
    "form",
    { method: "dialog" },
    heading,
    ...fields,
    make(
      "div",
      { class: "answers" },
      make("button", { type: "submit", class: "main", value: accept, text: accept }),
      ...others.map((each) => make("button", { type: "submit", value: each, text: each })),
      button("Cancel", () => box.close("")),
    ),
  );
  const box = make("dialog", { "aria-labelledby": heading.id }, form);
  host.appendChild(box);
  return new Promise((done) => {
    box.addEventListener("close", () => {
      box.remove();
      done(box.returnValue || null);
    });
    box.showModal();
  });
}

export function download(name: string, content: BlobPart, type = "text/plain"): void {
  const address = URL.createObjectURL(new Blob([content], { type }));
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

export function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(base64), (each) => each.charCodeAt(0));
}

export async function copyText(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // Without a secure context there is no clipboard but the old one.
    const area = make("textarea", { "aria-hidden": "true" });
    area.value = text;
    document.body.append(area);
    area.select();
    const isDone = document.execCommand("copy");
    area.remove();
    return isDone;
  }
}
