// The page: programs as tabs, opened, saved and taken along; what goes wrong is said over its lower edge.
import { Address } from "./address";
import { button, base64Of, copyText, decimal, dialog, download, type Entry, labelled, make, menu, newId, numberField, offer, select, showTabs, textField } from "./dom";
import { ChainPane } from "./chain";
import { type Chain, chainOf, newChain, PARTS, Sketch, UNITS } from "./chainSketch";
import { ProgramPane } from "./pane";
import { Program } from "./program";
import { type Hello, type Made, orTrouble, type Transport, Trouble, type View } from "./protocol";
import type { Work } from "./work";

const SAID = 6000; // ms for which is said what was done

type Opening = { name?: string; text?: string; base64?: string; example?: string; control?: string };

export class App {
  private hello: Hello | null = null;
  private isGreeted = false; // whether the Desk was asked for its hello
  private readonly isEmbedded: boolean;
  private readonly address = new Address(); // of a page of the documentation
  private works: Work[] = [];
  private active: Work | null = null;
  private readonly pane: ProgramPane;
  private readonly chain: ChainPane;
  private readonly trouble = make("p", { class: "trouble", role: "alert" });
  private readonly rescue = make("div", { class: "rescue bar" });
  private readonly notice = make("div", { class: "notice", hidden: true }, this.trouble, this.rescue);
  private isUnsaved = false; // what the trouble says stays true until something is saved
  private readonly said = make("span", { class: "said", role: "status" });
  private readonly tabs = make("div", { class: "programs", "aria-label": "Open programs" });
  private readonly control = select([], { "aria-label": "Control", onchange: () => this.pane.setControl(this.control.value) });
  private readonly facts = make("span", { class: "facts" });
  private readonly save = button("Save", () => void this.saveActive(), { title: "Save (Ctrl+S)" });
  private readonly picker = make("input", { type: "file", multiple: true, hidden: true, "aria-label": "Open files" });
  private readonly start = make("section", { class: "start", "aria-label": "Begin" });
  private readonly host = make("div", { class: "host", role: "tabpanel", id: newId(), "aria-label": "Program" });
  private readonly state = make("span", { class: "tally", "aria-hidden": "true" }); // the heading of the findings says it
  private readonly doing = menu("Do", () => this.pane.entries(this.others()));
  private readonly ofProgram = [labelled("Control", this.control), this.facts, this.state]; // not of a sketch
  private readonly actions = make("div", { class: "actions" }, ...this.ofProgram);

  constructor(
    private readonly root: HTMLElement,
    private readonly transport: Transport,
    private readonly known: Hello | null,
  ) {
    const isEmbedded = (this.isEmbedded = known !== null);
    const controls = () => this.hello?.controls ?? [];
    const openText = (name: string, text: string) => void this.open({ name, text });
    this.pane = new ProgramPane({ root, transport, controls, changed: this.changed, openText, keep: isEmbedded ? null : (made) => void this.keep(made) });
    this.chain = new ChainPane(() => this.hello?.drawing_words ?? {}, controls, openText);
    this.host.append(this.pane.node, this.chain.node);
    const title = make(isEmbedded ? "strong" : "h1", { class: "title", text: "contoursolve" });
    root.classList.add("workbench");
    const head = make("div", { class: "head" }, title, menu("File", () => this.fileEntries()), this.save, this.doing, this.tabs, this.said, this.actions);
    root.replaceChildren(head, this.start, this.host, this.notice, this.picker);
    this.follow();
    this.listen();
  }

  private readonly changed = (work: Work, why: Trouble | null): void => {
    if (why) this.tell(why);
    else this.answered();
    if (work === this.active) this.follow();
  };

  private listen(): void {
    const { root } = this;
    this.picker.addEventListener("change", () => {
      void this.openFiles(this.picker.files);
      this.picker.value = "";
    });
    for (const name of ["dragover", "dragleave", "drop"] as const) {
      root.addEventListener(name, (event) => {
        const isStill = name === "dragover" || (name === "dragleave" && event.relatedTarget instanceof Node && root.contains(event.relatedTarget));
        root.classList.toggle("dropping", isStill);
        if (name !== "dragleave") event.preventDefault();
        if (name === "drop") void this.openFiles(event.dataTransfer?.files ?? null);
      });
    }
    // Before the explorer, which keeps all keys to itself.
    const pressed = (event: KeyboardEvent) => {
      if (root.querySelector("dialog[open]") || event.altKey) return;
      const key = event.key.toLowerCase();
      if (key === "escape") return this.tell(null);
      if (!event.ctrlKey && !event.metaKey) return;
      if (key === "s" && this.active) void (event.shiftKey ? this.saveAs() : this.saveActive());
      else if (key === "o") this.picker.click();
      else return;
      event.preventDefault();
    };
    root.addEventListener("keydown", pressed, { capture: true });
    addEventListener("beforeunload", (event) => {
      if (!this.isEmbedded && this.works.some((each) => each.isChanged && !each.isEmpty)) event.preventDefault();
    });
  }

  async begin(): Promise<void> {
    if (!this.known) return void ((await this.greeted()) && this.hello?.open && (await this.open({ name: this.hello.open })));
    // In a page of the documentation the Desk is loaded with the first program.
    this.greet(this.known);
    addEventListener("hashchange", () => void this.openLinked());
    if (location.protocol === "file:") this.tell(new Trouble("Browsers start no Python in a page that is opened as a file. Open this page from a web server.", {}));
    else await this.openLinked();
  }

  private greet(hello: Hello): void {
    this.hello = hello;
    this.isGreeted = hello.style !== undefined;
    if (hello.style) {
      const sheet = new CSSStyleSheet();
      sheet.replaceSync(hello.style);
      const place = this.root.getRootNode() as Document | ShadowRoot;
      place.adoptedStyleSheets = [...place.adoptedStyleSheets, sheet];
    }
    offer(this.control, [["", "as the words tell"], ...hello.controls.map((each) => [each.name, each.title] as const)]);
    if (!this.active) this.showStart();
  }

  // Beginning ------------------------------------------------------------------------------------------------------

  // What begins a work; the page and its menu offer them.
  private beginnings(): Entry[] {
    const canDraw = this.hello?.drawing_words || this.isEmbedded;
    return [
      { text: "Open a file…", key: "Ctrl+O", act: () => this.picker.click() },
      { text: "New program", act: () => void this.open({ name: "", text: "" }) },
      ...(canDraw ? [{ text: "New contour from a drawing", act: () => void this.greeted().then((is) => is && this.addSketch(newChain("turned"), "", "")) }] : []),
    ];
  }

  private showStart(): void {
    const { examples, folder } = this.hello!;
    const list = (label: string, kind: string) => make("ul", { class: kind, "aria-label": label });
    const item = (text: string, what: Opening) => make("li", {}, button(text, () => void this.open(what)));
    const files = list("Programs in the folder", "files");
    const own = list("Examples", "examples");
    own.append(...examples.map(({ title, control }) => item(title, { example: control })));
    const steps = [
      "Drop a program on this page, or choose one below.",
      "What is wrong is underlined and listed with its fixes. Touch a fix, and the text changes.",
      "The drawing shows every contour. Touch one to see its words and to drag its points.",
    ];
    this.start.replaceChildren(
      make("h2", { text: "Open a program, or build a contour" }),
      make("ol", {}, ...steps.map((text) => make("li", { text }))),
      make("div", { class: "bar" }, ...this.beginnings().map(({ text, act }, place) => button(text, act, { class: place ? null : "main" }))),
      this.isEmbedded && !this.isGreeted ? make("p", { class: "muted", text: "The first program loads Python: about 30 MB, once." }) : "",
      ...(folder ? [make("h2", { text: `In the folder ${folder}` }), files] : []),
      make("h2", { text: "An example for each control" }),
      own,
    );
    if (!folder) return;
    void this.asked<{ files: { name: string }[]; left_out?: number }>({ do: "files" }).then((found) => {
      const note = found && (!found.files.length ? "There is no program in it yet." : found.left_out ? `and ${found.left_out} more` : "");
      files.append(...(found?.files ?? []).map(({ name }) => item(name, { name })), note ? make("li", { class: "muted", text: note }) : "");
    });
  }

  private fileEntries(): Entry[] {
    const { active, hello } = this;
    const isOff = !active;
    const [file, ...others] = this.beginnings();
    const saving = [{ text: "Save", key: "Ctrl+S", act: () => void this.saveActive(), isOff }, { text: "Save as…", key: "Ctrl+Shift+S", act: () => void this.saveAs(), isOff }];
    return [
      file!,
      { text: hello?.folder ? "Open from the folder, or an example…" : "Open an example…", act: () => this.choose(null) },
      ...others,
      ...(hello?.may_write ? saving : []),
      { text: "Download", act: () => this.downloadActive(), isOff },
      ...(this.isEmbedded ? [{ text: "Copy a link to this program", act: () => void this.copyLink(), isOff: isOff || !this.address.told }] : []),
      { text: "Copy the text", act: () => void this.copyActive(), isOff },
      { text: "Close", act: () => void this.close(active!), isOff },
    ];
  }

  // Programs -------------------------------------------------------------------------------------------------------

  private async greeted(): Promise<boolean> {
    if (this.isGreeted) return true;
    const hello = await this.asked<Hello>({ do: "hello" });
    if (hello) this.greet(hello);
    return hello !== null;
  }

  private async open(what: Opening, isBeside = false): Promise<void> {
    const isNew = !isBeside && what.text === undefined && what.base64 === undefined;
    const known = isNew && what.name && this.works.find((each) => each.name === what.name && each.base);
    if (known) return this.choose(known);
    if (!(await this.greeted())) return;
    if (/\.(toml|json)$/i.test(what.name ?? "")) {
      const read = await this.asked<{ sketch: Partial<Chain>; name: string; base: string }>({ do: "sketch_open", ...what });
      return read ? this.addSketch(chainOf(read.sketch), read.name, read.base) : undefined;
    }
    if (/\.dxf$/i.test(what.name ?? "")) return this.openDrawing(what);
    const view = await this.asked<View>({ do: "open", ...what });
    if (view) this.add(this.pane.make(view));
  }

  private add(work: Work): void {
    const taken = new Set(this.works.filter((each) => !each.name && each.noun === work.noun).map((each) => each.number));
    while (taken.has(work.number)) work.number += 1;
    this.works.push(work);
    this.choose(work);
    this.focus();
  }

  private focus(): void {
    if (this.active instanceof Program) this.pane.focus();
    else if (this.active) this.chain.focus();
    else this.start.querySelector("button")?.focus();
  }

  private async openLinked(): Promise<void> {
    const linked = this.address.read();
    if (!linked) return;
    await this.open({ name: "", text: linked.text, ...(this.hello?.controls.some((each) => each.name === linked.control) ? { control: linked.control } : {}) });
  }

  private addSketch(chain: Chain, name: string, base: string, measured: Record<string, string>[] = []): void {
    const sketch: Sketch = new Sketch(this.transport, chain, name, base, (own, why) => {
      if (own === this.active) this.chain.follow();
      this.changed(own, why);
    });
    sketch.measured = measured;
    this.add(sketch);
  }

  // The contour of a CAD drawing: what the file does not tell is asked.
  private async openDrawing(file: Opening): Promise<void> {
    const part = select(PARTS);
    const unit = select([["", "as the drawing says"], ...UNITS]);
    const layer = textField({ placeholder: "all layers" });
    const chain = numberField({ placeholder: "the only one" });
    const zero = [numberField(), numberField()];
    const reverse = make("input", { type: "checkbox" });
    const said = make("p", { class: "wrong", role: "alert" });
    const titles = ["Kind of part", "Unit", "Layer", "Number of the contour, the largest is 1", "Zero point, first axis of the drawing", "Zero point, second axis"];
    const fields = [part, unit, layer, chain, ...zero].map((each, place) => labelled(titles[place]!, each));
    while (await dialog(this.root, `Contour of ${file.name ?? "the drawing"}`, [...fields, make("label", { class: "check" }, reverse, "the other way round"), said], "Open")) {
      const place = zero.map((each) => decimal(each.value));
      const chosen = { part: part.value, unit: unit.value, layer: layer.value.trim(), reverse: reverse.checked, chain: chain.value.trim() ? Number(chain.value) : null };
      const request = { do: "dxf_in", ...file, ...chosen, zero: place.every((each) => each && Number.isFinite(Number(each))) ? place.map(Number) : null };
      const read = await orTrouble(this.transport.ask<{ sketch: Partial<Chain>; notes: string[]; measured: Record<string, string>[] }>(request), (why) => (said.textContent = why.message));
      if (!read) continue;
      this.addSketch(chainOf(read.sketch), (file.name ?? "").replace(/\.dxf$/i, ".toml"), "", read.measured);
      if (read.notes.length) await dialog(this.root, "What the drawing says", read.notes.map((text) => make("p", { text })), "Go on");
      return;
    }
  }

  private async openFiles(files: FileList | null): Promise<void> {
    for (const file of [...(files ?? [])]) await this.open({ name: file.name, base64: base64Of(new Uint8Array(await file.arrayBuffer())) });
  }

  private choose(work: Work | null): void {
    if (work !== this.active) this.progress(""); // what was done is said of another one
    this.active = work;
    if (work instanceof Program) this.pane.show(work);
    else if (work instanceof Sketch) this.chain.show(work);
    else if (this.hello) this.showStart();
    this.follow();
  }

  private async close(work: Work): Promise<void> {
    if (work.isChanged && !work.isEmpty && !this.isEmbedded) {
      const answer = await dialog(this.root, `Close ${titleOf(work)}?`, [make("p", { text: "Its changes are not saved." })], "Close without saving", this.hello?.may_write ? ["Save"] : ["Download"]);
      if (!answer) return;
      if (answer === "Download") this.downloadActive();
      if (answer === "Save" && !(await this.saveActive())) return;
    }
    this.tell(null);
    void work.close();
    const at = this.works.indexOf(work);
    this.works = this.works.filter((each) => each !== work);
    this.choose(this.works[Math.min(at, this.works.length - 1)] ?? null);
  }

  private follow(): void {
    const { active, works } = this;
    const isProgram = active instanceof Program;
    this.start.hidden = active !== null;
    this.host.hidden = this.actions.hidden = this.save.hidden = active === null;
    this.tabs.hidden = !works.length;
    const tab = (each: Work, number: number) => {
      // A file may be open twice, as it was and as it is now.
      const same = works.slice(0, number).filter((other) => other.name && other.name === each.name).length;
      const mark = each.isChanged && !each.isEmpty ? " •" : "";
      const title = `${titleOf(each)}${each.isChanged ? ": changes are not saved" : ""}`;
      return { name: String(number), text: `${titleOf(each)}${same ? ` (${same + 1})` : ""}${mark}`, title, panel: this.host.id };
    };
    showTabs(this.tabs, works.map(tab), String(active ? works.indexOf(active) : -1), (name) => this.choose(works[Number(name)]!));
    this.doing.hidden = !isProgram;
    if (!active) return;
    for (const each of [...this.ofProgram, this.pane.node]) each.hidden = !isProgram;
    this.chain.node.hidden = isProgram;
    this.save.textContent = this.hello?.may_write ? "Save" : "Download";
    this.save.setAttribute("aria-disabled", String(Boolean(this.hello?.may_write) && !active.isChanged));
    if (!this.isEmbedded) document.title = `${active.isChanged ? "• " : ""}${titleOf(active)} - contoursolve`;
    if (isProgram) this.followProgram(active);
  }

  // The other programs that are open.
  private others(): Program[] {
    return this.works.filter((each): each is Program => each instanceof Program && each !== this.active);
  }

  private followProgram({ view, text, examined, lines }: Program): void {
    this.state.textContent = this.pane.told;
    this.state.classList.toggle("waiting", examined < lines);
    this.state.style.setProperty("--share", String(examined / lines));
    const open = this.control.options[0];
    const from = view.control_from === "program" ? "words" : view.control_from;
    if (open) open.text = view.control && from !== "choice" ? `${view.control.title} (the ${from} say${from === "words" ? "" : "s"} so)` : "as the words tell";
    if (!this.control.matches(":focus")) this.control.value = this.pane.control;
    this.facts.textContent = [view.unit, view.control && view.trouble_control].filter(Boolean).join(" · ");
    if (this.isEmbedded) this.address.write(text, this.pane.control);
  }

  // Saving ---------------------------------------------------------------------------------------------------------

  private async saveActive(): Promise<boolean> {
    const { active } = this;
    if (!active) return false;
    if (this.hello?.may_write) return active.base ? this.write(active, {}) : this.saveAs();
    this.downloadActive();
    return true;
  }

  private async saveAs(): Promise<boolean> {
    const { active } = this;
    if (!active) return false;
    const why = await active.refusal();
    if (why) return this.tell(new Trouble(`Not saved. ${why}`, {})), false;
    const name = textField({ value: active.name || fileOf(active) });
    const folder = this.hello?.folder;
    const answer = await dialog(this.root, "Save as", [labelled(folder ? `Name in the folder ${folder}` : "Name", name)], "Save");
    return answer !== null && name.value.trim() !== "" && this.write(active, { name: name.value.trim() });
  }

  private async write(work: Work, options: { name?: string; over?: string }): Promise<boolean> {
    let conflict = "";
    const saved = await orTrouble(work.save(options), (why) => {
      conflict = String(why.reply?.["conflict"] ?? "");
      if (!conflict) this.tell(why, true);
    });
    if (saved) {
      this.tell(null);
      work.wasSaved(saved.saved, saved.base);
      if (work === this.active) this.say(`Saved as ${saved.saved}.`);
    }
    this.follow();
    if (!conflict) return saved !== null;
    const name = options.name ?? work.name;
    const what = options.name ? "There is a file with this name already." : "This file was changed since it was opened: by another program, or in another window.";
    const answer = await dialog(this.root, `${name} ${options.name ? "exists" : "has changed"}`, [make("p", { text: `${what} Your text is still here.` })], "Save under another name", ["Replace it", "Open that file beside"]);
    if (answer === "Replace it") return this.write(work, { ...options, over: conflict });
    if (answer === "Save under another name") return this.saveAs();
    // What is in the folder now, in a tab of its own: nothing is lost, and nothing saved.
    if (answer) await this.open({ name }, true);
    return false;
  }

  private async keep({ name, text = "", base64 }: Made): Promise<void> {
    const saved = await this.asked<{ saved: string }>({ do: "save", name, ...(base64 === undefined ? { text } : { base64 }) });
    if (saved) this.say(`Saved as ${saved.saved}.`);
  }

  private downloadActive(): void {
    const { active } = this;
    if (!active) return;
    download(active.name || fileOf(active), active.text);
    this.say("Downloaded.");
    void active.refusal().then((why) => why && this.tell(new Trouble(`Downloaded, but it cannot be opened as it is. ${why}`, {})));
  }

  private async copyActive(): Promise<void> {
    if (this.active) this.say((await copyText(this.active.text)) ? "The text is copied." : "This browser copies nothing: use Ctrl+C in the text.");
  }

  private async copyLink(): Promise<void> {
    this.address.show();
    this.say((await copyText(location.href)) ? "The link is copied." : "The link stands in the address bar: copy it there.");
  }

  // What is said -----------------------------------------------------------------------------------------------------

  private async asked<Reply>(request: Record<string, unknown>): Promise<Reply | null> {
    const reply = await orTrouble(this.transport.ask<Reply>(request), (why) => this.tell(why));
    if (reply) this.answered();
    return reply;
  }

  progress = (text: string): void => void (this.said.textContent = text);

  private say(text: string): void {
    this.progress(text);
    setTimeout(() => this.said.textContent === text && this.progress(""), SAID);
  }

  private answered = (): void => (this.isUnsaved ? undefined : this.tell(null));
  // One sentence, over the page, so that nothing moves; where nobody answers, the text can be taken along.
  private tell(why: Trouble | null, isUnsaved = false): void {
    this.isUnsaved = isUnsaved;
    if (!why && this.notice.hidden) return;
    const isFocused = this.notice.matches(":focus-within");
    this.notice.hidden = !why;
    this.trouble.textContent = why?.message ?? "";
    const again = () => void (this.hello ? (this.active?.again() ?? this.asked({ do: "hello" })) : this.begin());
    const taking = this.active ? [button("Copy the text", () => void this.copyActive()), button("Download the text", () => this.downloadActive())] : [];
    this.rescue.replaceChildren(...(why?.reply === null ? [button("Try again", again), ...taking] : []), button("Close this message", () => this.tell(null), { title: "Escape" }));
    if (isFocused) why ? this.rescue.querySelector("button")?.focus() : this.focus();
  }
}

const numberOf = ({ number }: Work, before: string): string => (number > 1 ? `${before}${number}` : "");
export const titleOf = (work: Work): string => work.name || `new ${work.noun}${numberOf(work, " ")}`;
const fileOf = (work: Work): string => `${work.noun}${numberOf(work, "-")}.${work.ending}`;
