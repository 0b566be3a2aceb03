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
  element.append(...children.filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

export const button = (text: string, action: (event: MouseEvent) => void, properties: Properties = {}): HTMLButtonElement => make("button", { type: "button", text, onclick: action, ...properties });

export function picture(svg: string): SVGSVGElement[] {
  const root = new DOMParser().parseFromString(svg, "image/svg+xml").documentElement;
  return root.localName === "svg" ? [document.importNode(root, true) as unknown as SVGSVGElement] : [];
}

export const textField = (properties: Properties = {}): HTMLInputElement =>
  make("input", { type: "text", autocomplete: "off", spellcheck: "false", ...properties });

export const numberField = (properties: Properties = {}): HTMLInputElement => textField({ inputmode: "decimal", ...properties });

export const decimal = (text: string): string => text.trim().replace(",", ".");

export type Option = readonly [value: string, text: string];

const optionsOf = (options: readonly Option[]) => options.map(([value, text]) => make("option", { value, text }));

export const select = (options: readonly Option[], properties: Properties = {}): HTMLSelectElement => make("select", properties, ...optionsOf(options));

// Other options; what was chosen stays, where there still is such a one.
export function offer(list: HTMLSelectElement, options: readonly Option[], value = list.value): void {
  list.replaceChildren(...optionsOf(options));
  list.value = options.some(([each]) => each === value) ? value : (options[0]?.[0] ?? "");
}

// What is larger than its place, to be moved by keys.
export const scroller = (kind: "div" | "pre", label: string, properties: Properties, ...children: Node[]): HTMLElement =>
  make(kind, { tabindex: 0, role: "group", "aria-label": label, ...properties }, ...children);

export const activeIn = (node: Node): Element | null => (node.getRootNode() as Document).activeElement;

// What is shown anew would lose the keys that follow to the page: what stands in the same place has them then.
export function keepFocus(host: HTMLElement, change: () => void): void {
  const all = () => [...host.querySelectorAll<HTMLElement>("button, input, select, textarea, summary")].filter((each) => each.getClientRects().length);
  const at = all().indexOf(activeIn(host) as HTMLElement);
  change();
  if (at >= 0) (all()[at] ?? all().at(-1) ?? host.closest<HTMLElement>("[tabindex]"))?.focus();
}

const shownIn = new WeakMap<HTMLElement, string>();

// What is the same stays.
export function renew(host: HTMLElement, of: unknown, nodes: () => Node[]): void {
  const key = JSON.stringify(of);
  if (shownIn.get(host) === key) return;
  shownIn.set(host, key);
  keepFocus(host, () => host.replaceChildren(...nodes()));
}

// Buttons to take something along, and what came of it.
export function takeAlong(name: string, content: BlobPart, type: string, copied: string | undefined, ...before: (HTMLElement | null)[]): HTMLElement {
  const said = make("span", { role: "status" });
  const copy = async () => (said.textContent = (await copyText(copied ?? "")) ? "copied" : "press Ctrl+C");
  const isThere = typeof content !== "string" || content !== "";
  return make("div", { class: "bar" }, ...before, isThere && button("Download", () => download(name, content, type)), copied && button("Copy", () => void copy()), said);
}

const ZOOMS = [0, 1, 1.5, 2, 3, 4, 6, 8]; // times the size at which its texts can be read; at 0 all of it is in sight

// Buttons, and the wheel with Ctrl, that set the size of a sheet of which a box shows a part.
export function zoomBar(sheet: HTMLElement, box: HTMLElement, of: string): HTMLElement {
  let zoom = 0;
  const smaller = button("−", () => zoomTo(zoom - 1), { class: "icon", "aria-label": "Smaller" });
  const larger = button("+", () => zoomTo(zoom + 1), { class: "icon", "aria-label": "Larger" });
  const tell = () => {
    smaller.setAttribute("aria-disabled", String(zoom <= 0));
    larger.setAttribute("aria-disabled", String(zoom === ZOOMS.length - 1));
    sheet.style.setProperty("--times", String(ZOOMS[zoom]));
    box.classList.toggle("whole", zoom === 0);
    box.classList.toggle("zoomed", zoom > 1);
  };
  const zoomTo = (wanted: number) => {
    const [before, high] = [box.scrollWidth, box.scrollHeight];
    // The middle of what is seen stays there.
    const [x, y] = [box.scrollLeft + box.clientWidth / 2, box.scrollTop + box.clientHeight / 2];
    const isLarger = wanted > zoom;
    zoom = Math.max(0, Math.min(ZOOMS.length - 1, wanted));
    tell();
    const by = box.scrollWidth / before;
    // All of it may be as large as can be read.
    if (zoom === 1 && by === 1 && box.scrollHeight === high && isLarger) return zoomTo(2);
    box.scrollTo(x * by - box.clientWidth / 2, y * by - box.clientHeight / 2);
  };
  box.addEventListener("wheel", (event) => {
    if (!event.ctrlKey) return;
    event.preventDefault();
    zoomTo(zoom + (event.deltaY < 0 ? 1 : -1));
  }, { passive: false });
  tell();
  return make("div", { class: "bar zoom", role: "group", "aria-label": `Size of ${of}` }, smaller, larger, button("Whole", () => zoomTo(0), { class: "icon" }));
}

let count = 0;
export const newId = (): string => `wb-${(count += 1)}`;

export const labelled = (text: string, control: HTMLElement, note?: HTMLElement): HTMLLabelElement => make("label", {}, make("span", { text }), control, note);

// Where the arrow keys lead in a row of things.
function stepped(key: string, at: number, among: number, back: string, forth: string): number | undefined {
  const to = { [forth]: at + 1, [back]: at - 1 + among, Home: 0, End: among - 1 }[key];
  return to === undefined ? to : to % among;
}

// A button that opens a menu. Its entries are asked for each time it opens.
export type Entry = { text: string; key?: string; act: () => void; isOff?: boolean };

export function menu(text: string, entries: () => Entry[]): HTMLElement {
  const list = make("div", { role: "menu", "aria-label": text });
  const box = make("dialog", { class: "menu", "aria-label": text }, list);
  const opener = button(text, () => open(), { "aria-haspopup": "menu", "aria-expanded": "false", "aria-label": text });
  const items = () => [...list.children] as HTMLElement[];
  const item = ({ text, key, act, isOff }: Entry) => {
    const chosen = () => {
      if (isOff) return;
      box.close();
      act();
    };
    return make("button", { type: "button", role: "menuitem", tabindex: -1, "aria-disabled": isOff && "true", onclick: chosen }, make("span", { text }), key && make("kbd", { text: key }));
  };
  const open = () => {
    const { left, bottom } = opener.getBoundingClientRect();
    Object.assign(box.style, { left: `${left}px`, top: `${bottom + 4}px` });
    list.replaceChildren(...entries().map(item));
    opener.setAttribute("aria-expanded", "true");
    box.showModal();
    items()[0]?.focus();
  };
  box.addEventListener("close", () => opener.setAttribute("aria-expanded", "false"));
  box.addEventListener("click", (event) => event.target === box && box.close()); // beside it
  list.addEventListener("keydown", (event) => {
    const all = items();
    const at = all.indexOf(event.target as HTMLElement);
    const next = stepped(event.key, at, all.length, "ArrowUp", "ArrowDown");
    const begun = all.find((each, place) => event.key.length === 1 && place > at && each.textContent?.toLowerCase().startsWith(event.key.toLowerCase()));
    if (event.key === "Tab") box.close();
    else if (next === undefined && !begun) return;
    else (begun ?? all[next!])?.focus();
    event.preventDefault();
  });
  opener.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowDown") return;
    event.preventDefault();
    open();
  });
  return make("div", { class: "dropdown" }, opener, box);
}

// Tabs: the arrow keys go from one to the next.
export type Tab = { name: string; text: string; title?: string; panel: string };

export function showTabs(bar: HTMLElement, tabs: Tab[], chosen: string, choose: (name: string) => void): void {
  bar.setAttribute("role", "tablist");
  const isFocused = bar.contains(activeIn(bar));
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
    const next = stepped(event.key, at, tabs.length, "ArrowLeft", "ArrowRight");
    if (at < 0 || next === undefined) return;
    event.preventDefault();
    choose(tabs[next]!.name);
  };
  const now = shown.find((each) => each.dataset["name"] === chosen);
  if (isFocused) now?.focus();
  now?.scrollIntoView?.({ block: "nearest", inline: "nearest" });
}

// A question that is asked over the page; what was answered, or null where its user thought better of it.
export function dialog(host: Node, title: string, fields: HTMLElement[], accept: string, others: string[] = []): Promise<string | null> {
  const heading = make("h2", { text: title, id: newId() });
  const answer = (text: string, kind?: string) => make("button", { type: "submit", class: kind, value: text, text });
  const answers = make("div", { class: "answers" }, answer(accept, "main"), ...others.map((each) => answer(each)), button("Cancel", () => box.close("")));
  const box = make("dialog", { "aria-labelledby": heading.id }, make("form", { method: "dialog" }, heading, ...fields, answers));
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

export function base64Of(bytes: Uint8Array): string {
  let text = "";
  for (let at = 0; at < bytes.length; at += 0x8000) text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
  return btoa(text);
}

export const bytesOf = (base64: string): Uint8Array<ArrayBuffer> => Uint8Array.from(atob(base64), (each) => each.charCodeAt(0));

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
