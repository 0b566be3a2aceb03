// The pane of a program: its text and findings, and beside them its drawing, the contour at the cursor, the tool, the
// variables and what commands made.
import { EditorView } from "@codemirror/view";

import { type Acted, contourPanel } from "./contour";
import { dialog, type Entry, labelled, make, newId, showTabs } from "./dom";
import { drawingPanel } from "./drawing";
import { contourAt, litEffect, marksOf, touches } from "./editor";
import { findingsList } from "./findings";
import { decimal, PROGRAM, type Tooled, toolPanel, type ToolState, type Varied, variablesPanel } from "./forms";
import { Program } from "./program";
import { type Change, type ControlName, type Looked, type Made, type Transport, type Trouble, type View } from "./protocol";
import { resultPanel } from "./result";

const VIEWS = { program: "Program", drawing: "Drawing", contour: "Contour", tool: "Tool", variables: "Variables", result: "Result" };
type ViewName = keyof typeof VIEWS;

const WIDE = 900; // px from which the text stands beside the rest
const REST = 250; // ms without a key after which the drawing and the contour follow

interface Beside {
  seq: number; // of the text for which the drawing was made
  svg: string | null;
  took: number; // ms until that was there
  looked: [number, number, number] | null; // first line, last line, seq
  tool: ToolState;
  tooled: Tooled | null;
  values: Record<string, number>;
  start: string;
  toolTrouble: string;
  varied: number; // seq of the text for which the variables are shown
  toolSeq: number; // and the tool
  made: Made | null;
}

export interface Around {
  root: HTMLElement;
  transport: Transport;
  controls: () => ControlName[];
  changed: (program: Program, why: Trouble | null) => void;
  openText: (name: string, text: string) => void;
  keep: ((made: Made) => void) | null;
}

export class ProgramPane {
  readonly node: HTMLElement;
  private program: Program | null = null;
  private readonly beside = new WeakMap<Program, Beside>();
  private view: ViewName = "program";
  private isWide = true;
  private rest = 0;
  private isActing = 0; // actions of the explorer under way
  private isHeld = false; // what its user drags
  private readonly editor: EditorView;
  private readonly bar = make("div", { class: "views", "aria-label": "Views of the program" });
  private readonly panels = new Map<ViewName, HTMLElement>();
  private readonly findings = findingsList(
    (number) => this.goFinding(number),
    (finding, fix) => void this.fix(finding, fix),
  );
  private readonly drawing = drawingPanel(
    (line) => this.go(line),
    (line) => {
      this.go(line);
      this.choose("contour");
    },
  );
  private readonly contour = contourPanel(
    (action) => void this.act(action),
    (place) => this.lightWord(place),
  );
  private readonly tool = toolPanel(
    (tool) => void this.setTool(tool),
    (line) => this.go(line),
  );
  private readonly variables = variablesPanel(
    (values, start) => void this.setVariables(values, start),
    (line) => this.go(line),
  );
  private readonly result;
  private readonly side: HTMLElement;

  constructor(private readonly around: Around) {
    this.result = resultPanel(around.openText, around.keep);
    const text = make("div", { class: "text" });
    this.editor = new EditorView({ parent: text, root: around.root.getRootNode() as Document | ShadowRoot });
    const nodes: Record<ViewName, Node[]> = {
      program: [text, this.findings.node],
      drawing: [this.drawing.node],
      contour: [this.contour.node],
      tool: [this.tool.node],
      variables: [this.variables.node],
      result: [this.result.node],
    };
    for (const [name, own] of Object.entries(nodes)) {
      const panel = make("section", { class: `view ${name}`, role: "tabpanel", id: newId(), "aria-label": VIEWS[name as ViewName] }, ...own);
      this.panels.set(name as ViewName, panel);
    }
    const [program, ...others] = [...this.panels.values()];
    this.node = make("div", { class: "pane" }, this.bar, program!, make("div", { class: "side" }, ...others));
    this.side = this.node.lastElementChild as HTMLElement;
    new ResizeObserver(([entry]) => this.resized(entry!.contentRect.width)).observe(this.node);
    this.resized(innerWidth);
  }

  make(view: View): Program {
    return new Program(
      this.around.transport,
      view,
      { selected: () => this.selected(), fix: (finding, fix) => void this.fix(finding, fix) },
      (program, why) => {
        if (program === this.program) this.follow();
        this.around.changed(program, why);
      },
    );
  }

  show(program: Program): void {
    if (this.program === program) return;
    this.program?.show(null);
    this.program = program;
    if (!this.beside.has(program)) {
      this.beside.set(program, { seq: -1, svg: null, took: 0, looked: null, tool: { radius: "", tip: "", side: "" }, tooled: null, toolTrouble: "", values: {}, start: "", varied: -1, toolSeq: -1, made: null });
    }
    program.show(this.editor);
    const { svg, made } = this.own;
    this.drawing.show(svg);
    if (made) this.result.show(made);
    else if (this.view === "result") this.view = "drawing";
    this.own.looked = null;
    this.contour.open(null);
    this.choose(this.view);
    this.follow();
    this.settle();
  }

  focus(): void {
    this.editor.focus();
  }

  entries(): Entry[] {
    const run = (what: string) => () => void this.command(what, {});
    return [
      { text: "Convert for another control…", act: () => void this.convert() },
      { text: "Expand into G01, G02, G03", act: run("expand") },
      { text: "Expand along the path of the tool", act: () => void this.command("expand", this.asked(this.own.tool)) },
      { text: "Verify", act: run("verify") },
      { text: "Report", act: run("report") },
      { text: "Drawing as DXF", act: run("dxf") },
      { text: "Picture as PNG", act: run("png") },
    ];
  }

  get control(): string {
    const view = this.program?.view;
    return view?.control_from === "choice" ? (view.control?.name ?? "") : "";
  }

  setControl(control: string): void {
    void this.program?.ask<View>(() => ({ do: "control", control: control || null }));
  }

  private get own(): Beside {
    return this.beside.get(this.program!)!;
  }

  // Views ------------------------------------------------------------------------------------------------------

  private resized(width: number): void {
    this.isWide = width >= WIDE;
    this.node.dataset["size"] = this.isWide ? "wide" : "narrow";
    this.choose(this.view);
  }

  private choose(view: ViewName): void {
    const isMoved = view !== this.view;
    this.view = view;
    const shown = this.isWide && view === "program" ? "drawing" : view;
    const tabs = (Object.keys(VIEWS) as ViewName[]).filter((name) => !(this.isWide && name === "program") && !(name === "result" && !(this.program && this.own.made)));
    const names = tabs.map((name) => ({ name, text: VIEWS[name], panel: this.panels.get(name)!.id }));
    showTabs(this.bar, names, shown, (name) => this.choose(name as ViewName));
    for (const [name, panel] of this.panels) panel.hidden = !(name === shown || (this.isWide && name === "program"));
    this.side.hidden = shown === "program";
    if (isMoved && this.program) this.settle();
  }

  private isShown(view: ViewName): boolean {
    return !this.panels.get(view)!.hidden;
  }

  // What follows the text ----------------------------------------------------------------------------------------

  private follow(): void {
    const program = this.program;
    if (!program) return;
    const { findings } = marksOf(program.state);
    const at = program.state.selection.main.head;
    const here = new Set(findings.flatMap((each, number) => (touches(each, at, program.state) ? [number] : [])));
    const { examined, lines } = program.view;
    const progress = examined < lines ? `${examined} of ${lines} lines are examined` : "";
    this.findings.show(findings, program.view.more_findings ?? 0, progress, (place) => program.state.doc.lineAt(Math.min(place, program.state.doc.length)).number, here);
    this.drawing.list(program.contours);
    this.drawing.light(this.here?.line ?? null);
    this.lightRow();
    this.showTool(program);
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.settle(), REST);
  }

  private lightRow(): void {
    const { state } = this.program!;
    const at = state.selection.main.head;
    const line = state.doc.lineAt(at);
    this.contour.light(line.number, at - line.from);
  }

  private lightWord(place: [number, number, number] | null): void {
    const { doc } = this.editor.state;
    const line = place && place[0] <= doc.lines ? doc.line(place[0]) : null;
    const range = line && place ? ([line.from + place[1], Math.min(line.from + place[2], line.to)] as const) : null;
    this.editor.dispatch({ effects: litEffect(range) });
  }

  private get line(): number {
    const { state } = this.program!;
    return state.doc.lineAt(state.selection.main.head).number;
  }

  private get here() {
    return contourAt(this.program!.contours, this.line);
  }

  // Between contours: the next one, or the last.
  private get nearest() {
    const { contours } = this.program!;
    return contours.find((each) => each.line > this.line) ?? contours.at(-1);
  }

  private selected(): void {
    if (!this.program) return;
    this.program.state = this.editor.state;
    this.follow();
  }

  // When its user rests: what takes longer.
  private settle(): void {
    const program = this.program;
    if (!program) return;
    // Nothing can be drawn of a program for no control; the head says why there is none.
    if (!program.view.control) return this.drawing.show(null);
    // An edit waits for a drawing that is under way: that of a long program comes when its user rests longer.
    const isDrawn = this.isShown("drawing") || (this.isShown("tool") && !this.own.tooled);
    if (isDrawn && this.own.seq !== program.view.seq) this.rest = setTimeout(() => void this.draw(program), 2 * this.own.took);
    if (this.isShown("contour") && !this.isActing && !this.isHeld) void this.look(program);
    if (this.isShown("variables") && this.own.varied !== program.view.seq) {
      this.own.varied = program.view.seq;
      void this.setVariables(this.own.values, this.own.start);
    }
    if (this.isShown("tool") && this.own.tooled && this.own.toolSeq !== program.view.seq) void this.setTool(this.own.tool);
  }

  private async draw(program: Program): Promise<void> {
    const beside = this.beside.get(program)!;
    if (program.view.examined < program.view.lines) return;
    beside.seq = program.view.seq;
    const begin = performance.now();
    const drawn = await program.ask<{ svg: string | null }>(() => ({ do: "drawing" }));
    if (!drawn) return;
    beside.took = performance.now() - begin;
    beside.svg = drawn.svg;
    if (program !== this.program) return;
    this.drawing.show(drawn.svg);
    this.showTool(program);
  }

  private async look(program: Program): Promise<void> {
    const here = this.here ?? this.nearest;
    const beside = this.own;
    const now: [number, number, number] | null = here ? [here.line, here.last, program.view.seq] : null;
    if (String(now) === String(beside.looked)) return;
    beside.looked = now;
    const looked = now ? await program.ask<Looked>(() => ({ do: "look", line: now[0] })) : null;
    if (program !== this.program || beside.looked !== now) return;
    this.contour.open(looked?.state ? looked : null);
    this.lightRow();
  }

  private async act(action: Record<string, unknown>): Promise<void> {
    const program = this.program;
    if (!program) return;
    const beside = this.own;
    this.isActing += 1;
    this.isHeld = action["is_held"] === true;
    try {
      const acted = await program.ask<Acted>(() => ({ do: "act", line: beside.looked?.[0] ?? this.line, action }), this.isHeld);
      if (program !== this.program) return;
      // The text is what the explorer made it: it need not look again.
      if (acted) beside.looked = acted.line !== null && acted.last !== null ? [acted.line, acted.last, program.view.seq] : null;
      this.contour.changed({ number: action["number"], ...(acted?.changed ?? acted?.state) }, acted?.words);
    } finally {
      this.isActing -= 1;
      if (!this.isActing) this.follow();
    }
  }

  // Going there, and mending ---------------------------------------------------------------------------------------

  private go(line: number): void {
    const { doc } = this.editor.state;
    const at = doc.line(Math.max(1, Math.min(line, doc.lines))).from;
    this.editor.dispatch({ selection: { anchor: at }, effects: EditorView.scrollIntoView(at, { y: "center" }) });
  }

  private goFinding(number: number): void {
    const { findings } = marksOf(this.editor.state);
    const found = findings[number];
    if (!found) return;
    if (!this.isShown("program")) this.choose("program");
    const at = Math.min(found.begin, this.editor.state.doc.length);
    this.editor.dispatch({ selection: { anchor: at }, effects: EditorView.scrollIntoView(at, { y: "center" }) });
  }

  private async fix(number: number, fix: number): Promise<void> {
    const program = this.program;
    const wanted = program && marksOf(program.state).findings[number]?.finding;
    if (!program || !wanted) return;
    // What is typed before it may have moved the findings.
    const place = () => program.findings.findIndex((each) => each === wanted || (each.code === wanted.code && each.message === wanted.message));
    const reply = await program.ask<View & { edits?: Change[] }>(() => (place() < 0 ? null : { do: "fix", finding: place(), fix }));
    const [first] = reply?.edits ?? [];
    if (!first || program !== this.program) return;
    // A number that is still open is selected, to be typed over.
    const open = first.text.indexOf("?");
    const { length } = this.editor.state.doc;
    const [anchor, head] = open < 0 ? [first.from, first.from] : [first.from + open, first.from + open + 1];
    if (head <= length) this.editor.dispatch({ selection: { anchor, head }, scrollIntoView: true });
    if (open >= 0) this.editor.focus();
  }

  // Commands -------------------------------------------------------------------------------------------------------

  // The tool of its fields; without a radius, that which the program states.
  private asked({ radius, tip, side }: ToolState): Record<string, unknown> {
    const isOwn = radius === "" || radius === PROGRAM;
    return { tool: isOwn ? PROGRAM : `R${radius}`, ...(tip ? { tip: Number(tip) } : {}), ...(side ? { side } : {}) };
  }

  private async setTool(tool: ToolState): Promise<void> {
    const program = this.program;
    if (!program) return;
    const own = this.own;
    own.tool = { ...tool, radius: decimal(tool.radius) };
    own.tooled = null;
    if (own.tool.radius) {
      own.toolTrouble = "";
      own.tooled = await program.ask<Tooled>(() => ({ do: "tool", ...this.asked(own.tool) }), false, (why) => {
        if (why.reply) own.toolTrouble = why.message;
        return why.reply !== null;
      });
      own.toolSeq = program.view.seq;
    }
    if (program === this.program) this.showTool(program);
  }

  private showTool(program: Program): void {
    const { tool, tooled, toolTrouble, svg } = this.own;
    this.tool.show(tool, program.view.unit || "mm", tooled, toolTrouble, svg);
  }

  private async setVariables(values: Record<string, number>, start: string): Promise<void> {
    const program = this.program;
    if (!program) return;
    Object.assign(this.own, { values, start });
    const reply = await program.ask<Varied>(() => ({ do: "variables", values, start }));
    if (reply && program === this.program) this.variables.show(reply);
  }

  private async convert(): Promise<void> {
    const own = this.program?.view.control;
    const machine = own?.machines?.[0];
    const alike = this.around.controls().filter((each) => each.name !== own?.name && (!machine || each.machines?.includes(machine) !== false));
    const targets = alike.filter((each) => each.may_be_target !== false);
    const others = alike.filter((each) => !targets.includes(each)).map((each) => each.title);
    const control = make("select", {}, ...targets.map((each) => make("option", { value: each.name, text: each.title })));
    const said = [machine ? `The program is for a ${machine}: these are the other controls of ${machine === "lathe" ? "lathes" : "mills"}.` : "", others.length ? `${others.join(" and ")}: no target. Its contours are blocks of another kind.` : ""];
    const notes = said.filter(Boolean).map((text) => make("p", { class: "muted", text }));
    const answer = await dialog(this.around.root, "Convert for another control", [labelled("Control", control), ...notes], "Convert");
    if (answer) await this.command("convert", { to: control.value });
  }

  private async command(what: string, options: Record<string, unknown>): Promise<void> {
    const program = this.program;
    const made = await program?.ask<Made>(() => ({ do: what, ...options }));
    if (!program || !made) return;
    this.beside.get(program)!.made = made;
    if (program !== this.program) return;
    this.result.show(made);
    this.choose("result");
    this.panels.get("result")!.querySelector<HTMLElement>("button")?.focus();
  }
}
