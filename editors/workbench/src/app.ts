// The page: programs as tabs, opened, saved and taken along; what goes wrong is said at the top.
import { button, bytesOf, copyText, dialog, download, type Entry, labelled, make, menu, newId, showTabs } from "./dom";
import { ChainPane } from "./chain";
import { type Chain, chainOf, newChain, type Plain, Sketch } from "./chainSketch";
import { decimal } from "./forms";
import { ProgramPane } from "./pane";
import { Program } from "./program";
import { type Hello, type Made, type Transport, Trouble, type View } from "./protocol";
import type { Work } from "./work";

const PAUSE = 300; // ms without a change until the address follows; browsers forbid to write it often
const LONGEST_LINK = 6000; // characters of a program

interface Opening {
  name?: string;
  text?: string;
  base64?: string;
  example?: string;
  control?: string;
}

export class App {
  private hello: Hello | null = null;
  private isGreeted = false; // whether the Desk was asked for its hello
  private readonly isEmbedded: boolean;
  private told = ""; // what the address holds
  private works: Work[] = [];
  private active: Work | null = null;
  private readonly pane: ProgramPane;
  private readonly chain: ChainPane;
  private readonly trouble = make("p", { class: "trouble", role: "alert" });
  private isUnsaved = false; // what the trouble says stays true until something is saved
  private readonly rescue = make("div", { class: "rescue bar", hidden: true });
  private readonly said = make("span", { class: "said", role: "status" });
  private readonly tabs = make("div", { class: "programs", "aria-label": "Open programs" });
  private readonly control = make("select", { "aria-label": "Control", onchange: () => this.pane.setControl(this.control.value) });
  private readonly facts = make("span", { class: "facts" });
  private readonly save = button("Save", () => void this.saveActive(), { title: "Save (Ctrl+S)" });
  private readonly picker = make("input", { type: "file", multiple: true, hidden: true, "aria-label": "Open files" });
  private readonly start = make("section", { class: "start", "aria-label": "Begin" });
  private readonly host = make("div", { class: "host", role: "tabpanel", id: newId(), "aria-label": "Program" });

  constructor(
    private readonly root: HTMLElement,
    private readonly transport: Transport,
    private readonly known: Hello | null,
  ) {
    const isEmbedded = (this.isEmbedded = known !== null);
    root.classList.add("workbench");
    const title = make(isEmbedded ? "strong" : "h1", { class: "title", text: "contoursolve" });
    const actions = menu("Do", () => this.pane.entries());
    this.pane = new ProgramPane({
      root,
      transport,
      controls: () => this.hello?.controls ?? [],
      changed: (program, why) => this.changed(program, why),
      openText: (name, text) => void this.open({ name, text }),
      keep: isEmbedded ? null : (made) => void this.keep(made),
    });
    this.chain = new ChainPane(
      () => this.hello?.drawing_words ?? {},
      () => this.hello?.controls ?? [],
      (name, text) => void this.open({ name, text }),
    );
    const control = labelled("Control", this.control);
    this.ofProgram = [actions, control, this.facts];
    this.actions = make("div", { class: "actions" }, this.save, ...this.ofProgram);
    root.replaceChildren(
      this.trouble,
      this.rescue,
      make("div", { class: "head" }, title, menu("File", () => this.fileEntries()), this.actions, this.said),
      this.tabs,
      this.start,
      this.host,
      this.picker,
    );
    this.host.append(this.pane.node, this.chain.node);
    this.picker.addEventListener("change", () => {
      void this.openFiles(this.picker.files);
      this.picker.value = "";
    });
    this.follow();
    this.listen();
  }

  private readonly actions: HTMLElement;
  private readonly ofProgram: HTMLElement[]; // of the actions, those that a sketch has not

  private listen(): void {
    const { root } = this;
    root.addEventListener("dragover", (event) => {
      event.preventDefault();
      root.classList.add("dropping");
    });
    root.addEventListener("dragleave", (event) => {
      if (!(event.relatedTarget instanceof Node && root.contains(event.relatedTarget))) root.classList.remove("dropping");
    });
    root.addEventListener("drop", (event) => {
      event.preventDefault();
      root.classList.remove("dropping");
      void this.openFiles(event.dataTransfer?.files ?? null);
    });
    root.addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.altKey || root.querySelector("dialog[open]")) return;
      const key = event.key.toLowerCase();
      if (key === "s" && this.active) void (event.shiftKey ? this.saveAs() : this.saveActive());
      else if (key === "o") this.picker.click();
      else return;
      event.preventDefault();
    });
    addEventListener("beforeunload", (event) => {
      if (!this.isEmbedded && this.works.some((each) => each.isChanged && !each.isEmpty)) event.preventDefault();
    });
  }

  async begin(): Promise<void> {
    // In a page of the documentation the Desk is loaded with the first program.
    if (this.known) {
      this.greet(this.known);
      addEventListener("hashchange", () => void this.readAddress());
      if (location.protocol === "file:") this.trouble.textContent = "Browsers start no Python in a page that is opened as a file. Open this page from a web server.";
      else await this.readAddress();
      return;
    }
    const hello = await this.asked<Hello>({ do: "hello" });
    if (!hello) return;
    this.greet(hello);
    if (hello.open) await this.open({ name: hello.open });
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
    this.control.replaceChildren(make("option", { value: "", text: "as the words tell" }), ...hello.controls.map((each) => make("option", { value: each.name, text: each.title })));
    if (!this.active) this.showStart();
  }

  // The program and its control stand in the address of a page of the documentation, behind the #.
  private async readAddress(): Promise<void> {
    if (location.hash.slice(1) === this.told) return;
    const told = new URLSearchParams(location.hash.slice(1));
    const control = told.get("control");
    const text = unpacked(told.get("program") ?? "");
    if (text) await this.open({ name: "", text, ...(control && this.hello?.controls.some((each) => each.name === control) ? { control } : {}) });
  }

  private writeAddress(program: Program): void {
    const { control } = this.pane;
    const parts = new URLSearchParams({ program: packed(program.text), ...(control ? { control } : {}) });
    const told = program.text.length <= LONGEST_LINK ? parts.toString() : "";
    if (told === this.told) return;
    this.told = told;
    clearTimeout(this.writing);
    this.writing = setTimeout(() => history.replaceState(null, "", `#${told}`), PAUSE);
  }

  private writing = 0;

  // Beginning ------------------------------------------------------------------------------------------------------

  private showStart(): void {
    const { examples, folder } = this.hello!;
    const note = this.isEmbedded && !this.isGreeted ? make("p", { class: "muted", text: "The first program loads Python: about 30 MB, once." }) : null;
    const files = make("ul", { class: "files", "aria-label": "Programs in the folder" });
    const choices = examples.map((each) => make("li", {}, button(each.title, () => void this.open({ example: each.control }))));
    this.start.replaceChildren(
      make("h2", { text: "Open a program, or build a contour" }),
      make(
        "ol",
        {},
        make("li", { text: "Drop a program on this page, or choose one below." }),
        make("li", { text: "What is wrong is underlined and listed with its fixes. Touch a fix, and the text changes." }),
        make("li", { text: "The drawing shows every contour. Touch one to see its words and to drag its points." }),
      ),
      make("div", { class: "bar" }, button("Open a file…", () => this.picker.click(), { class: "main" }), button("New program", () => void this.open({ name: "", text: "" })), ...this.newContour()),
      ...(note ? [note] : []),
      ...(folder ? [make("h2", { text: `In the folder ${folder}` }), files] : []),
      make("h2", { text: "An example for each control" }),
      make("ul", { class: "examples", "aria-label": "Examples" }, ...choices),
    );
    if (folder) void this.listFiles(files);
  }

  private async listFiles(list: HTMLElement): Promise<void> {
    const found = await this.asked<{ files: { name: string; size: number }[]; left_out?: number }>({ do: "files" });
    if (!found) return;
    list.replaceChildren(...found.files.map((each) => make("li", {}, button(each.name, () => void this.open({ name: each.name })))));
    if (!found.files.length) list.append(make("li", { class: "muted", text: "There is no program in it yet." }));
    if (found.left_out) list.append(make("li", { class: "muted", text: `and ${found.left_out} more` }));
  }

  private fileEntries(): Entry[] {
    const { active, hello } = this;
    return [
      { text: "Open a file…", key: "Ctrl+O", act: () => this.picker.click() },
      { text: hello?.folder ? "Open from the folder, or an example…" : "Open an example…", act: () => this.choose(null) },
      { text: "New program", act: () => void this.open({ name: "", text: "" }) },
      ...(hello?.drawing_words || this.isEmbedded ? [{ text: "New contour from a drawing", act: () => void this.newSketch() }] : []),
      ...(hello?.may_write ? [{ text: "Save", key: "Ctrl+S", act: () => void this.saveActive(), isOff: !active }, { text: "Save as…", key: "Ctrl+Shift+S", act: () => void this.saveAs(), isOff: !active }] : []),
      { text: "Download", act: () => this.downloadActive(), isOff: !active },
      ...(this.isEmbedded ? [{ text: "Copy a link to this program", act: () => void this.copyLink(), isOff: !active || !this.told }] : []),
      { text: "Copy the text", act: () => void this.copyActive(), isOff: !active },
      ...(hello?.can_unlock && !hello.may_write ? [{ text: "Allow saving: enter the password…", act: () => void this.unlock() }] : []),
      { text: "Close", act: () => void this.close(active!), isOff: !active },
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
    if (/\.(toml|json)$/i.test(what.name ?? "")) return this.openSketch(what);
    if (/\.dxf$/i.test(what.name ?? "")) return this.openDrawing(what);
    const view = await this.asked<View>({ do: "open", ...what });
    if (!view) return;
    const program = this.pane.make(view);
    this.add(program);
    this.choose(program);
    this.pane.focus();
  }

  private add(work: Work): void {
    numbered(work, this.works);
    this.works.push(work);
  }

  private newContour(): HTMLElement[] {
    return this.hello?.drawing_words || this.isEmbedded ? [button("New contour from a drawing", () => void this.newSketch())] : [];
  }

  private async newSketch(): Promise<void> {
    if (await this.greeted()) this.addSketch(newChain("turned"), "", "");
  }

  private addSketch(chain: Chain, name: string, base: string, measured: Record<string, string>[] = []): void {
    const sketch: Sketch = new Sketch(this.transport, chain, name, base, (own, why) => {
      if (own === this.active) this.chain.follow();
      this.changed(own, why);
    });
    sketch.measured = measured;
    this.add(sketch);
    this.choose(sketch);
    this.chain.focus();
  }

  private async openSketch(file: Opening): Promise<void> {
    const read = await this.asked<{ sketch: Plain; name: string; base: string }>({ do: "sketch_open", ...file });
    if (read) this.addSketch(chainOf(read.sketch), read.name, read.base);
  }

  // The contour of a CAD drawing: what the file does not tell is asked.
  private async openDrawing(file: Opening): Promise<void> {
    const options = (all: [string, string][]) => make("select", {}, ...all.map(([value, text]) => make("option", { value, text })));
    const part = options([["turned", "Turned part"], ["milled", "Milled part"]]);
    const unit = options([["", "as the drawing says"], ["mm", "mm"], ["inch", "inch"]]);
    const layer = make("input", { type: "text", autocomplete: "off", placeholder: "all layers" });
    const chain = make("input", { type: "text", inputmode: "numeric", autocomplete: "off", placeholder: "the only one" });
    const zero = ["Zero point, first axis of the drawing", "Zero point, second axis"].map((text) => [text, make("input", { type: "text", inputmode: "decimal", autocomplete: "off" })] as const);
    const reverse = make("input", { type: "checkbox" });
    const said = make("p", { class: "wrong", role: "alert" });
    const fields = [labelled("Kind of part", part), labelled("Unit", unit), labelled("Layer", layer), labelled("Number of the contour, the largest is 1", chain), ...zero.map(([text, input]) => labelled(text, input)), make("label", { class: "check" }, reverse, "the other way round"), said];
    while (await dialog(this.root, `Contour of ${file.name ?? "the drawing"}`, fields, "Open")) {
      const place = zero.map(([, input]) => decimal(input.value));
      const request = {
        ...file,
        part: part.value,
        unit: unit.value,
        layer: layer.value.trim(),
        reverse: reverse.checked,
        ...(chain.value.trim() ? { chain: Number(chain.value) } : {}),
        ...(place.every((each) => each && Number.isFinite(Number(each))) ? { zero: place.map(Number) } : {}),
      };
      try {
        const read = await this.transport.ask<{ sketch: Plain; notes: string[]; measured: Record<string, string>[] }>({ do: "dxf_in", ...request });
        this.addSketch(chainOf(read.sketch), (file.name ?? "").replace(/\.dxf$/i, ".toml"), "", read.measured);
        if (read.notes.length) await dialog(this.root, "What the drawing says", read.notes.map((text) => make("p", { text })), "Go on");
        return;
      } catch (error) {
        if (!(error instanceof Trouble) || !error.reply) return this.tell(error);
        said.textContent = error.message;
      }
    }
  }

  private async openFiles(files: FileList | null): Promise<void> {
    for (const file of [...(files ?? [])]) {
      const bytes = new Uint8Array(await file.arrayBuffer());
      let text = "";
      for (let at = 0; at < bytes.length; at += 0x8000) text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
      await this.open({ name: file.name, base64: btoa(text) });
    }
  }

  private choose(work: Work | null): void {
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

  private changed(work: Work, why: Trouble | null): void {
    if (why) this.tell(why);
    else this.answered();
    if (work === this.active) this.follow();
  }

  private follow(): void {
    const { active } = this;
    this.start.hidden = active !== null;
    this.host.hidden = this.actions.hidden = active === null;
    this.tabs.hidden = !this.works.length;
    // A file may be open twice, as it was and as it is now.
    const again = (work: Work, number: number) => {
      const same = this.works.slice(0, number).filter((each) => each.name && each.name === work.name).length;
      return same ? ` (${same + 1})` : "";
    };
    const names = this.works.map((each, number) => ({
      name: String(number),
      text: `${titleOf(each)}${again(each, number)}${each.isChanged && !each.isEmpty ? " •" : ""}`,
      title: each.isChanged ? `${titleOf(each)}: changes are not saved` : titleOf(each),
      panel: this.host.id,
    }));
    showTabs(this.tabs, names, String(active ? this.works.indexOf(active) : -1), (name) => this.choose(this.works[Number(name)]!));
    if (!active) return;
    const isProgram = active instanceof Program;
    for (const each of this.ofProgram) each.hidden = !isProgram;
    this.pane.node.hidden = !isProgram;
    this.chain.node.hidden = isProgram;
    this.save.textContent = this.hello?.may_write ? "Save" : "Download";
    this.save.setAttribute("aria-disabled", String(Boolean(this.hello?.may_write) && !active.isChanged));
    if (!this.isEmbedded) document.title = `${active.isChanged ? "• " : ""}${titleOf(active)} - contoursolve`;
    if (isProgram) this.followProgram(active);
  }

  private followProgram(active: Program): void {
    const { view } = active;
    const open = this.control.options[0];
    if (open) open.text = view.control && view.control_from !== "choice" ? `${view.control.title} (the ${view.control_from === "program" ? "words" : view.control_from} say so)` : "as the words tell";
    if (this.control !== (this.root.getRootNode() as Document).activeElement) this.control.value = this.pane.control;
    this.facts.textContent = [view.unit, view.trouble_control].filter(Boolean).join(" · ");
    if (this.isEmbedded) this.writeAddress(active);
  }

  // Saving ---------------------------------------------------------------------------------------------------------

  private async saveActive(): Promise<boolean> {
    const { active } = this;
    if (!active) return false;
    if (!this.hello?.may_write) {
      this.downloadActive();
      return true;
    }
    if (!active.base) return this.saveAs();
    return this.write(active, {});
  }

  private async saveAs(): Promise<boolean> {
    const { active } = this;
    if (!active) return false;
    const why = await active.refusal?.();
    if (why) {
      this.tell(new Trouble(`Not saved. ${why}`, {}));
      return false;
    }
    const name = make("input", { type: "text", value: active.name || fileOf(active), autocomplete: "off" });
    const folder = this.hello?.folder;
    const answer = await dialog(this.root, "Save as", [labelled(folder ? `Name in the folder ${folder}` : "Name", name)], "Save");
    return answer !== null && name.value.trim() !== "" && this.write(active, { name: name.value.trim() });
  }

  private async write(work: Work, options: { name?: string; over?: string }): Promise<boolean> {
    let conflict = "";
    const saved = await work.save(options, (why) => {
      conflict = String(why.reply?.["conflict"] ?? "");
      return conflict !== "";
    });
    if (conflict) {
      const what = make("p", { text: options.name ? "There is a file with this name already. Your text is still here." : "This file was changed since it was opened: by another program, or in another window. Your text is still here." });
      const answer = await dialog(this.root, options.name ? `${options.name} exists` : `${work.name} has changed`, [what], "Save under another name", ["Replace it", "Open that file beside"]);
      if (answer === "Open that file beside") return this.openBeside(options.name ?? work.name);
      if (answer === "Replace it") return this.write(work, { ...options, over: conflict });
      return answer !== null && this.saveAs();
    }
    this.isUnsaved = !saved;
    if (!saved) return false;
    this.tell(null);
    work.wasSaved(saved.saved, saved.base);
    this.say(`Saved as ${saved.saved}.`);
    this.follow();
    return true;
  }

  // What is in the folder now, in a tab of its own: nothing is lost, and nothing saved.
  private async openBeside(name: string): Promise<boolean> {
    await this.open({ name }, true);
    return false;
  }

  private async keep(made: Made): Promise<void> {
    const content = made.base64 === undefined ? { text: made.text ?? "" } : { base64: made.base64 };
    const saved = await this.asked<{ saved: string }>({ do: "save", name: made.name, ...content });
    if (saved) this.say(`Saved as ${saved.saved}.`);
  }

  private downloadActive(): void {
    const { active } = this;
    if (!active) return;
    download(active.name || fileOf(active), active.text);
    this.say("Downloaded.");
    void active.refusal?.().then((why) => why && this.tell(new Trouble(`Downloaded, but it cannot be opened as it is. ${why}`, {})));
  }

  private async copyActive(): Promise<void> {
    if (this.active) this.say((await copyText(this.active.text)) ? "The text is copied." : "This browser copies nothing: use Ctrl+C in the text.");
  }

  private async copyLink(): Promise<void> {
    history.replaceState(null, "", `#${this.told}`);
    this.say((await copyText(location.href)) ? "The link is copied." : "The link stands in the address bar: copy it there.");
  }

  private async unlock(): Promise<void> {
    const password = make("input", { type: "password", autocomplete: "current-password" });
    if (!(await dialog(this.root, "Allow saving", [labelled("Password", password)], "Allow"))) return;
    const reply = await this.asked<{ may_write: boolean }>({ do: "unlock", password: password.value });
    if (!reply || !this.hello) return;
    this.hello.may_write = reply.may_write;
    this.follow();
  }

  // What is said -----------------------------------------------------------------------------------------------------

  private async asked<Reply>(request: Record<string, unknown>): Promise<Reply | null> {
    try {
      const reply = await this.transport.ask<Reply>(request);
      this.answered();
      return reply;
    } catch (error) {
      this.tell(error);
      return null;
    }
  }

  private say(text: string): void {
    this.said.textContent = text;
    setTimeout(() => this.said.textContent === text && (this.said.textContent = ""), 6000);
  }

  progress(text: string): void {
    this.said.textContent = text;
  }

  private answered(): void {
    if (this.trouble.textContent && !this.isUnsaved) this.tell(null);
  }

  // One sentence at the top; where nobody answers, the text can be taken along.
  private tell(error: unknown): void {
    if (error !== null && !(error instanceof Trouble)) throw error;
    this.isUnsaved = false;
    this.trouble.textContent = error?.message ?? "";
    this.rescue.hidden = !error || error.reply !== null;
    if (this.rescue.hidden) return;
    this.rescue.replaceChildren(
      button("Try again", () => void (this.hello ? (this.active?.again() ?? this.asked({ do: "hello" })) : this.begin())),
      ...(this.active ? [button("Copy the text", () => void this.copyActive()), button("Download the text", () => this.downloadActive())] : []),
    );
  }
}

// A text as it can stand in an address, whatever characters it has.
function packed(text: string): string {
  return btoa(String.fromCharCode(...new TextEncoder().encode(text))).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

function unpacked(text: string): string {
  try {
    return new TextDecoder().decode(bytesOf(text.replaceAll("-", "+").replaceAll("_", "/")));
  } catch {
    return ""; // a link that was cut off, or that means a place on the page
  }
}

// Those without a name are told apart by numbers, as long as they are open.
const numbers = new WeakMap<Work, number>();

function numbered(work: Work, works: Work[]): void {
  const taken = new Set(works.filter((each) => each !== work && !each.name && each.ending === work.ending).map((each) => numbers.get(each)));
  let number = 1;
  while (taken.has(number)) number += 1;
  numbers.set(work, number);
}

const nounOf = (work: Work): string => (work instanceof Sketch ? "contour" : "program");
const numberOf = (work: Work, before: string): string => ((numbers.get(work) ?? 1) > 1 ? `${before}${numbers.get(work)}` : "");
const titleOf = (work: Work): string => work.name || `new ${nounOf(work)}${numberOf(work, " ")}`;
const fileOf = (work: Work): string => `${nounOf(work)}${numberOf(work, "-")}.${work.ending}`;
