// A program that is open here and at the Desk: edits go there, findings come back, one question after another.
import type { ChangeSet, EditorState, Text, TransactionSpec } from "@codemirror/state";
import type { EditorView } from "@codemirror/view";

import { changesOf, editsOf, type Heard, markEffect, moveMarks, newState, placed, pythonEdits } from "./editor";
import { type Change, type ContourRow, type Finding, orTrouble, type Transport, Trouble, type View } from "./protocol";
import type { Saved, Work } from "./work";

const PAUSE = 40; // ms in which keys are gathered

export type Question = Record<string, unknown>;

export class Program implements Work {
  readonly noun = "program";
  readonly ending = "nc";
  number = 1;
  view: View;
  findings: Finding[] = []; // as they came last
  contours: ContourRow[] = [];
  state: EditorState;
  isLeft = false; // whether nobody goes on examining it, as was said at the top
  saved: Text | null; // null where no file has it
  private saving: Text | null = null; // what is being saved
  private editor: EditorView | null = null;
  private acknowledged: Text; // the text that the Desk has
  private pending: ChangeSet | null = null; // since then
  private isWhole = false; // whether the Desk needs the whole text, for it may have missed something
  private isOther = false; // whether it is about to be read for another control
  private isGoingOn = false; // whether a question is under way that examines further
  private isDragged = false; // whether the last step of undo is a drag that goes on
  private last: Promise<unknown> = Promise.resolve();
  private timer = 0;

  constructor(
    private readonly transport: Transport,
    view: View,
    heard: Omit<Heard, "changed">,
    private readonly shown: (program: Program, why: Trouble | null) => void,
  ) {
    this.view = view;
    this.state = newState(view.text ?? "", { ...heard, changed: (changes) => this.changed(changes) });
    this.acknowledged = this.state.doc;
    this.saved = view.base && !view.has_changes ? this.state.doc : null;
    this.adopt(view);
  }

  get name() { return this.view.name; }
  get base() { return this.view.base; }
  get text() { return this.state.doc.toString(); }
  get isEmpty() { return this.state.doc.length === 0; }
  /** Of what is made of the text as it is, read for its control. */
  get version() { return [this.view.id, this.view.seq, this.view.control?.name, this.pending ? "typed" : ""].join(" "); }
  get isChanged() { return this.saved === null || !this.state.doc.eq(this.saved); }
  get lines() { return this.state.doc.lines; }
  /** The lines of the text as it stands here, from the first one on, of which all is told. */
  get examined(): number {
    const { examined, lines } = this.view;
    let first = this.isWhole || this.isOther ? 0 : examined < lines ? examined : this.lines;
    this.pending?.iterChangedRanges((_from, _to, from) => (first = Math.min(first, this.state.doc.lineAt(from).number - 1)));
    return Math.min(first, this.lines);
  }


  // Until it is read for this control, nothing is told of it.
  async setControl(control: string): Promise<void> {
    this.isOther = true;
    this.shown(this, null);
    await orTrouble(this.answer<View>(() => ({ do: "control", control: control || null })), (why) => {
      this.isOther = false;
      this.shown(this, why);
    });
  }
  refusal = () => Promise.resolve("");
  again = () => this.ask(() => ({ do: "view" }));
  close = () => this.transport.ask({ do: "close", program: this.view.id }).catch(() => null);

  save(options: { name?: string; over?: string }): Promise<Saved> {
    return this.answer<Saved>(() => {
      this.saving = this.state.doc;
      return { do: "save", ...options };
    }) as Promise<Saved>;
  }

  wasSaved(name: string, base: string): void {
    this.view = { ...this.view, name, base };
    this.saved = this.saving;
  }

  // The editor shows one program at a time.
  show(editor: EditorView | null): void {
    if (this.editor) this.state = this.editor.state;
    this.editor = editor;
    editor?.setState(this.state);
  }

  update(spec: TransactionSpec): void {
    if (this.editor) {
      this.editor.dispatch(spec);
      this.state = this.editor.state;
    } else this.state = this.state.update(spec).state;
  }

  private changed(changes: ChangeSet): void {
    if (this.editor) this.state = this.editor.state;
    this.isDragged = false;
    this.pending = this.pending ? this.pending.compose(changes) : changes;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.ask(() => null), PAUSE);
  }

  // Ask about the text as it is now; null where that failed, which is said at the top.
  ask<Reply extends object>(question: () => Question | null, isHeld = false): Promise<Reply | null> {
    return orTrouble(this.answer<Reply>(question, isHeld), (why) => this.shown(this, why));
  }

  // The same, with its Trouble for whoever asks. What is asked is made when its turn comes; null asks nothing more than
  // the findings.
  answer<Reply extends object>(question: () => Question | null, isHeld = false): Promise<Reply | null> {
    const next = this.last.then(() => this.asked<Reply>(question, isHeld));
    this.last = next.catch(() => null);
    return next;
  }

  private async asked<Reply extends object>(question: () => Question | null, isHeld: boolean): Promise<Reply | null> {
    await this.send().then(() => (this.isLeft = false), (why) => {
      this.isLeft = true;
      throw why;
    });
    const what = question();
    const reply = what && (await this.tell<Reply & { edits?: Change[] } & Partial<View>>(what));
    const isAct = what?.["do"] === "act";
    if (what?.["do"] === "control") this.isOther = false;
    if (reply?.edits?.length) this.take(reply.edits, isAct, isHeld);
    if (isAct && !isHeld) this.isDragged = false;
    if (reply?.seq !== undefined && reply.counts) this.adopt(reply as View);
    this.shown(this, null);
    return reply;
  }

  // A Desk that was away, or has forgotten this program, has it again before it answers.
  private async tell<Reply>(what: Question): Promise<Reply> {
    const ask = () => this.transport.ask<Reply>({ program: this.view.id, seq: this.view.seq, ...what });
    try {
      return await ask();
    } catch (error) {
      if (!(error instanceof Trouble) || !error.reply?.["is_gone"]) throw error;
      await this.openAnew();
      return what["do"] === "edit" ? (this.view as Reply) : ask();
    }
  }

  // Bring the Desk's text up to what stands here, and let it examine all of it.
  private async send(): Promise<void> {
    clearTimeout(this.timer);
    this.isGoingOn = false;
    const under = this.pending;
    if (under || this.isWhole) {
      const text = this.whole();
      const what = this.isWhole || !under ? { text } : { edits: editsOf(under) };
      try {
        this.adopt(await this.tell<View>({ do: "edit", ...what }));
      } catch (error) {
        this.isWhole = true; // whether it came there is not known
        if (!(error instanceof Trouble) || !error.reply?.["is_old"]) throw error;
        this.adopt(await this.tell<View>({ do: "edit", text: this.whole() }));
      }
      this.isWhole = false;
    }
    // What is typed meanwhile goes first.
    if (this.view.examined < this.view.lines && !this.pending) this.adopt(await this.tell<View>({ do: "go_on" }));
  }

  // The text as it is now, with which the Desk has all.
  private whole(): string {
    this.pending = null;
    this.acknowledged = this.state.doc;
    return this.text;
  }

  private async openAnew(): Promise<void> {
    const { name, base, encoding, has_order_mark, line_end, control, control_from } = this.view;
    const chosen = control_from === "choice" && control ? { control: control.name } : {};
    this.adopt(await this.transport.ask<View>({ do: "open", name, text: this.whole(), base, encoding, has_order_mark, line_end, ...chosen }));
  }

  private take(edits: Change[], isAct: boolean, isHeld: boolean): void {
    let changes = changesOf(edits, this.acknowledged.length);
    this.acknowledged = changes.apply(this.acknowledged);
    if (this.pending) {
      const own = this.pending;
      this.pending = own.map(changes);
      changes = changes.map(own, true);
    }
    // All that is done while its user drags is one step of undo.
    this.update(pythonEdits(changes, isAct && this.isDragged));
    this.isDragged = isHeld;
  }

  private mark(): void {
    const marks = { findings: placed(this.findings, this.acknowledged), contours: this.contours };
    this.update({ effects: markEffect.of(this.pending ? moveMarks(marks, this.pending) : marks) });
  }

  // The findings are about the text that the Desk has; what was typed since moves them. As long as lines wait, whatever
  // was asked, the Desk is asked to go on.
  private adopt(view: View): void {
    this.view = view;
    if (view.examined < view.lines && !this.isGoingOn) {
      this.isGoingOn = true;
      void this.ask(() => null);
    }
    this.contours = view.contours ?? this.contours;
    if (!view.findings && !view.contours) return;
    this.findings = view.findings ?? this.findings;
    this.mark();
  }
}
