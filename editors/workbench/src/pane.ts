// The pane of a program: its text and findings, and beside them its drawing, the contour at the cursor, the tool, the
// variables and what commands made.
import { redo, undo } from "@codemirror/commands";
import { openSearchPanel } from "@codemirror/search";
import { EditorView } from "@codemirror/view";

import { type Acted, contourPanel } from "./contour";
import { button, dialog, type Entry, labelled, make, type Option, select } from "./dom";
import { drawingPanel } from "./drawing";
import { contourAt, litEffect, marksOf, playEffect, toFinding, touches } from "./editor";
import { findingsList, summary, type Told } from "./findings";
import { PROGRAM, type Tooled, toolPanel, type ToolState, type Varied, variablesPanel } from "./forms";
import { Program } from "./program";
import { type Change, type ControlName, type Drawn, type Finding, type Looked, type Made, orTrouble, type Transport, type Trouble, type View, type Words } from "./protocol";
import { resultPanel } from "./result";
import { splitter, Views } from "./views";

const VIEWS = { program: "Program", drawing: "Drawing", contour: "Contour", tool: "Tool", variables: "Variables", result: "Result" };
const REST = 250; // ms without a key after which the drawing and the contour follow

const COMMANDS: readonly Option[] = [["verify", "Verify"], ["report", "Report"], ["dxf", "Drawing as DXF"], ["png", "Picture as PNG"]];

// What stands beside the text of one program.
class Beside {
  readonly of = { drawing: "", tool: "", variables: "", result: "" }; // versions of which they were made
  drawn: Drawn | null = null;
  took = 0; // ms until that was there
  looked: [number, number, string] | null = null; // first line, last line, version
  tool: ToolState = { radius: "", tip: "", side: "" };
  tooled: Tooled | null = null;
  toolTrouble = "";
  values: Record<string, number> = {};
  start = "";
  made: Made | null = null;
  isBegun = false; // whether its first error was gone to
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
  private program: Program | null = null;
  private readonly besides = new WeakMap<Program, Beside>();
  private rest = 0;
  private isActing = 0; // actions of the explorer under way
  private isHeld = false; // what its user drags
  private variedOf: Program | null = null; // whose variables are shown
  told = ""; // of its findings, in a line
  private readonly editor: EditorView;
  private readonly views: Views<keyof typeof VIEWS>;
  private readonly go = (line: number): void => this.goTo(this.editor.state.doc.line(Math.max(1, Math.min(line, this.editor.state.doc.lines))).from);
  private readonly findings = findingsList({
    go: (number) => this.goFinding(number),
    step: (way) => void (toFinding(way)(this.editor) && this.editor.focus()),
    fix: (finding, fix) => void this.fix(finding, fix),
    light: (finding, fix) => this.light(finding, fix),
  });
  private readonly count = make("span", { class: "muted" });
  private readonly contour = contourPanel((action) => void this.act(action), (place) => this.lightWord(place));
  private readonly tool = toolPanel((tool) => void this.setTool(tool), this.go);
  private readonly variables = variablesPanel((values, start) => void this.setVariables(values, start), this.go);
  private readonly drawing = drawingPanel(
    this.go,
    (line) => {
      this.go(line);
      this.views.choose("contour");
    },
    (line) => this.play(line),
  );
  private readonly result;

  constructor(private readonly around: Around) {
    this.result = resultPanel(around.openText, around.keep, this.go);
    const text = make("div", { class: "text" });
    this.editor = new EditorView({ parent: text, root: around.root.getRootNode() as Document | ShadowRoot });
    const { findings, drawing, contour, tool, variables, result } = this;
    const by = (name: string, sign: string, key: string, act: (view: EditorView) => boolean) => button(sign, () => void (act(this.editor), this.editor.focus()), { class: "icon", "aria-label": name, title: key });
    const edits = [by("Find in the text", "⌕", "Ctrl+F", openSearchPanel), by("Undo in the text", "↶", "Ctrl+Z", undo), by("Redo in the text", "↷", "Ctrl+Y", redo)];
    const head = make("div", { class: "headline" }, make("h2", { text: "Program" }), make("span", { class: "end" }, this.count, ...edits));
    const host = () => this.node;
    const between = [splitter(host, "Width of the program", "--program", [240, 404, 800], 1), splitter(host, "Width of the findings", "--findings", [260, 352, 640], -1)];
    this.views = new Views(
      VIEWS,
      { program: [make("div", { class: "own" }, head, text), findings.node], drawing: [drawing.node], contour: [contour.node], tool: [tool.node], variables: [variables.node], result: [result.node] },
      { kind: "of-program", label: "Views of the program", beside: 701, wide: 1160, withFirst: "drawing", tools: { drawing: drawing.tools }, between },
      () => this.settle(),
      (name) => name !== "result" || Boolean(this.program && this.own.made),
    );
  }

  get node() { return this.views.node; }
  private get own() { return this.besides.get(this.program!)!; }
  private get here() { return contourAt(this.program!.contours, this.line.number); }

  focus = (): void => this.editor.focus();
  setControl = (control: string): void => void this.program?.setControl(control);

  make(view: View): Program {
    const heard = { selected: () => this.selected(), fix: (finding: number, fix: number) => void this.fix(finding, fix) };
    return new Program(this.around.transport, view, heard, (program, why) => {
      if (program === this.program) this.follow();
      this.around.changed(program, why);
    });
  }

  show(program: Program): void {
    if (this.program === program) return;
    this.program?.show(null);
    this.program = program;
    if (!this.besides.has(program)) this.besides.set(program, new Beside());
    program.show(this.editor);
    const { drawn, made } = this.own;
    this.drawing.show(drawn);
    if (made) this.result.show(made);
    this.own.looked = null;
    this.own.of.variables = "";
    this.contour.open(null);
    this.views.choose(made || this.views.view !== "result" ? this.views.view : "drawing");
    this.follow();
    this.settle();
  }

  entries(others: Program[]): Entry[] {
    const entry = (text: string, what: string, options = () => ({})): Entry => ({ text, act: () => void this.command(what, options()) });
    // The other one is the older: what is at work is what came of it.
    const comparing = others.map((other) => ({ text: `Compare with ${other.name || `new program ${other.number}`}`, act: () => void this.compare(other) }));
    const first = [{ text: "Convert for another control…", act: () => void this.convert() }, entry("Expand into G01, G02, G03", "expand")];
    return [...first, entry("Expand along the path of the tool", "expand", () => this.stated(this.own.tool)), ...COMMANDS.map(([what, text]) => entry(text, what)), ...comparing];
  }

  get control(): string {
    const view = this.program?.view;
    return view?.control_from === "choice" ? (view.control?.name ?? "") : "";
  }

  // Ask about the program that is shown; null, too, where another one is shown by then.
  private async asked<Reply extends object>(question: () => Record<string, unknown> | null): Promise<Reply | null> {
    const { program } = this;
    const reply = await program?.ask<Reply>(question);
    return program === this.program ? (reply ?? null) : null;
  }

  // The same with the place where is told why there is none; that nobody answers is told at the top, too.
  private orTold<Reply extends object>(program: Program, question: () => Record<string, unknown>, tell: (why: string) => void): Promise<Reply | null> {
    return orTrouble(program.answer<Reply>(question), (why) => {
      tell(why.message);
      if (!why.reply) this.around.changed(program, why);
    });
  }

  // What follows the text ----------------------------------------------------------------------------------------

  private follow(): void {
    const program = this.program;
    if (!program) return;
    const { state } = program;
    const { findings } = marksOf(state);
    const here = new Set(findings.flatMap((each, number) => (touches(each, state.selection.main.head, state) ? [number] : [])));
    const { more_findings, control, trouble_control } = program.view;
    const { examined, lines, isLeft } = program;
    const unread = control ? "" : trouble_control;
    const lineOf = (place: number) => state.doc.lineAt(Math.min(place, state.doc.length)).number;
    const told: Told = { findings, contours: program.contours, unread, left: more_findings ?? 0, examined, lines, isLeft, lineOf, here };
    this.findings.show(told);
    this.told = summary(told);
    this.count.textContent = `${lines} ${lines === 1 ? "line" : "lines"}`;
    this.begin(program);
    this.drawing.list(program.contours, unread !== "");
    this.drawing.light(this.here?.line ?? null);
    this.lightRow();
    this.showTool();
    this.result.mark(this.own.of.result !== program.version);
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.settle(), REST);
  }

  // A program opens at its first error, where nobody went elsewhere meanwhile.
  private begin(program: Program): void {
    const { own } = this;
    if (own.isBegun || program.examined < program.lines) return;
    own.isBegun = true;
    const first = marksOf(program.state).findings.find((each) => each.finding.severity === "error");
    if (first && !program.state.selection.main.head) this.goTo(Math.min(first.begin, program.state.doc.length));
  }

  private get line() { return this.program!.state.doc.lineAt(this.program!.state.selection.main.head); }

  private lightRow = (): void => this.contour.light(this.line.number, this.program!.state.selection.main.head - this.line.from);

  private lightWord(place: Words[string] | null): void {
    const { doc } = this.editor.state;
    const line = place && place[0] <= doc.lines ? doc.line(place[0]) : null;
    const range = line && place ? ([line.from + place[1], Math.min(line.from + place[2], line.to)] as const) : null;
    this.editor.dispatch({ effects: litEffect.of(range) });
  }

  // The way that a fix chooses.
  private light({ line, fixes }: Finding, fix: number | null): void {
    const letter = fix === null ? undefined : fixes[fix]?.solution;
    const contour = contourAt(this.program!.contours, line);
    this.drawing.lightWay(letter && contour ? { line: contour.line, letter } : null);
  }

  private play(line: number | null): void {
    const { doc } = this.editor.state;
    const at = line !== null && line <= doc.lines ? doc.line(line).from : null;
    this.editor.dispatch({ effects: [playEffect.of(line), ...(at === null ? [] : [EditorView.scrollIntoView(at, { y: "nearest", yMargin: 40 })])] });
  }

  // Between contours: the next one, or the last.
  private get nearest() {
    const { contours } = this.program!;
    return contours.find((each) => each.line > this.line.number) ?? contours.at(-1);
  }

  private selected(): void {
    if (this.program) this.program.state = this.editor.state;
    this.follow();
  }

  // When its user rests: what takes longer.
  private settle(): void {
    const { program, views } = this;
    if (!program) return;
    // Nothing can be drawn of a program for no control; the head says why there is none.
    if (!program.view.control) return this.drawing.show(null);
    const { version } = program;
    const own = this.own;
    // An edit waits for a drawing that is under way: that of a long program comes when its user rests longer.
    const isDrawn = views.isShown("drawing") || (views.isShown("tool") && !own.tooled);
    if (isDrawn && own.of.drawing !== version) this.rest = setTimeout(() => void this.draw(program), 2 * own.took);
    if (views.isShown("contour") && !this.isActing && !this.isHeld) void this.look(program);
    if (views.isShown("variables") && own.of.variables !== version) void this.setVariables(own.values, own.start);
    if (views.isShown("tool") && own.tooled && own.of.tool !== version) void this.setTool(own.tool);
  }

  private async draw(program: Program): Promise<void> {
    const beside = this.besides.get(program)!;
    if (program.examined < program.lines) return;
    beside.of.drawing = program.version;
    const begin = performance.now();
    const drawn = await program.ask<Drawn>(() => ({ do: "drawing" }));
    if (!drawn) return;
    beside.took = performance.now() - begin;
    beside.drawn = drawn;
    if (program !== this.program) return;
    this.drawing.show(drawn);
    this.showTool();
  }

  private async look(program: Program): Promise<void> {
    const here = this.here ?? this.nearest;
    const beside = this.own;
    const now: Beside["looked"] = here ? [here.line, here.last, program.version] : null;
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
      const acted = await program.ask<Acted>(() => ({ do: "act", line: beside.looked?.[0] ?? this.line.number, action }), this.isHeld);
      if (program !== this.program) return;
      // The text is what the explorer made it: it need not look again.
      if (acted) beside.looked = acted.line !== null && acted.last !== null ? [acted.line, acted.last, program.version] : null;
      this.contour.changed({ number: action["number"], ...(acted?.changed ?? acted?.state) }, acted?.words);
    } finally {
      this.isActing -= 1;
      if (!this.isActing) this.follow();
    }
  }

  // Going there, and mending ---------------------------------------------------------------------------------------

  private goTo(at: number): void {
    this.editor.dispatch({ selection: { anchor: at }, effects: EditorView.scrollIntoView(at, { y: "center" }) });
  }

  private goFinding(number: number): void {
    const found = marksOf(this.editor.state).findings[number];
    if (!found) return;
    if (!this.views.isShown("program")) this.views.choose("program");
    this.goTo(Math.min(found.begin, this.editor.state.doc.length));
    // A touch does not ask for the keys of a screen.
    if (!matchMedia("(pointer: coarse)").matches) this.focus();
  }

  private async fix(number: number, fix: number): Promise<void> {
    const program = this.program;
    const wanted = program && marksOf(program.state).findings[number]?.finding;
    if (!wanted) return;
    // What is typed before it may have moved the findings.
    const place = () => program.findings.findIndex((each) => each === wanted || (each.code === wanted.code && each.message === wanted.message));
    const reply = await this.asked<View & { edits?: Change[] }>(() => (place() < 0 ? null : { do: "fix", finding: place(), fix }));
    const [first] = reply?.edits ?? [];
    if (!first) return;
    // A number that is still open is selected, to be typed over.
    const open = first.text.indexOf("?");
    const [anchor, head] = open < 0 ? [first.from, first.from] : [first.from + open, first.from + open + 1];
    if (head <= this.editor.state.doc.length) this.editor.dispatch({ selection: { anchor, head }, scrollIntoView: true });
    if (open >= 0) this.editor.focus();
  }

  // Commands -------------------------------------------------------------------------------------------------------

  // The tool of its fields; without a radius, that which the program states.
  private stated({ radius, tip, side }: ToolState): Record<string, unknown> {
    const isOwn = radius === "" || radius === PROGRAM;
    return { tool: isOwn ? PROGRAM : `R${radius}`, ...(tip ? { tip: Number(tip) } : {}), ...(side ? { side } : {}) };
  }

  private async setTool(wanted: ToolState): Promise<void> {
    const program = this.program;
    if (!program) return;
    const own = this.own;
    Object.assign(own, { tool: wanted, tooled: null, toolTrouble: "" });
    if (wanted.radius) {
      own.tooled = await this.orTold<Tooled>(program, () => ({ do: "tool", ...this.stated(wanted) }), (why) => (own.toolTrouble = why));
      own.of.tool = program.version;
    }
    if (program === this.program) this.showTool();
  }

  private showTool(): void {
    const { tool, tooled, toolTrouble: trouble, drawn } = this.own;
    const { unit, control } = this.program!.view;
    this.tool.show({ tool, unit: unit || "mm", isTurned: control?.machines?.[0] !== "mill", tooled, trouble, plain: drawn?.svg ?? null });
  }

  private async setVariables(values: Record<string, number>, start: string): Promise<void> {
    const { program } = this;
    if (!program) return;
    Object.assign(this.own, { values, start }).of.variables = program.version;
    const reply = await this.asked<Varied>(() => ({ do: "variables", values, start }));
    if (!reply) return;
    this.variables.show(reply, program !== this.variedOf, start);
    this.variedOf = program;
  }

  private async convert(): Promise<void> {
    const own = this.program?.view.control;
    const machine = own?.machines?.[0];
    const alike = this.around.controls().filter((each) => each.name !== own?.name && (!machine || each.machines?.includes(machine) !== false));
    const targets = alike.filter((each) => each.may_be_target !== false);
    const others = alike.filter((each) => !targets.includes(each)).map((each) => each.title);
    const control = select(targets.map((each) => [each.name, each.title]));
    const said = [machine ? `The program is for a ${machine}: these are the other controls of ${machine === "lathe" ? "lathes" : "mills"}.` : "", others.length ? `${others.join(" and ")}: no target. Its contours are blocks of another kind.` : ""];
    const notes = said.filter(Boolean).map((text) => make("p", { class: "muted", text }));
    const answer = await dialog(this.around.root, "Convert for another control", [labelled("Control", control), ...notes], "Convert");
    if (answer) await this.command("convert", { to: control.value });
  }

  private async compare(other: Program): Promise<void> {
    // Both have their whole texts at the Desk.
    const isThere = await other.ask(() => null).then(() => !other.isLeft);
    if (isThere) await this.command("compare", { program: other.view.id, with: this.program!.view.id });
  }

  // What it made; where it fails, why stands in the place of what was made before.
  private async command(what: string, options: Record<string, unknown>): Promise<void> {
    const program = this.program;
    if (!program) return;
    const own = this.own;
    const question = () => ((own.of.result = program.version), { do: what, ...options });
    own.made = (await this.orTold<Made>(program, question, (message) => (own.made = { name: "", message, isWrong: true }))) ?? own.made;
    if (program !== this.program || !own.made) return;
    this.result.show(own.made);
    this.follow();
    this.views.choose("result");
    this.views.focus("result");
  }
}
