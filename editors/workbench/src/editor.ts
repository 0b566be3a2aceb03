// The text of a program: findings underlined, contours marked at the edge, fixes at the word.
import { defaultKeymap, history, historyKeymap, isolateHistory } from "@codemirror/commands";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { Annotation, type ChangeDesc, ChangeSet, EditorState, type Extension, RangeSetBuilder, StateEffect, StateField, type Text, Transaction, type TransactionSpec } from "@codemirror/state";
import {
  Decoration,
  type DecorationSet,
  drawSelection,
  EditorView,
  highlightActiveLine,
  keymap,
  lineNumbers,
  showTooltip,
  type Tooltip,
  ViewPlugin,
  type ViewUpdate,
} from "@codemirror/view";

import { button, make } from "./dom";
import type { Change, ContourRow, Finding, Fix } from "./protocol";

// What Python changed: the Desk has it already.
export const fromPython = Annotation.define<boolean>();

export interface Placed {
  finding: Finding;
  begin: number;
  end: number;
}

export interface Marks {
  findings: Placed[];
  contours: ContourRow[];
}

const setMarks = StateEffect.define<Marks>();
const setLit = StateEffect.define<readonly [number, number] | null>();
const openFixes = StateEffect.define<boolean>();

const REMARK = /\([^)\n]*\)?|;.*/g;
const greyed = Decoration.mark({ class: "cm-remark" });
const lit = Decoration.mark({ class: "cm-lit" });

export function moveMarks<Kind extends Marks>(all: Kind, changes: ChangeDesc): Kind {
  const findings = all.findings.map((each) => ({ ...each, begin: changes.mapPos(each.begin, 1), end: changes.mapPos(each.end, -1) }));
  return { ...all, findings };
}

// Where findings stand in the text of which they were found.
export function placed(findings: Finding[], doc: Text): Placed[] {
  return findings.map((finding) => {
    const line = doc.line(Math.max(1, Math.min(finding.line, doc.lines)));
    const at = (column: number) => Math.min(line.from + column, line.to);
    return { finding, begin: at(finding.from), end: at(finding.to) };
  });
}

interface Shown extends Marks {
  underlined: DecorationSet;
}

function underlined(findings: Placed[], state: EditorState): DecorationSet {
  const { length } = state.doc;
  const ranges = findings.flatMap(({ begin, end, finding }) => {
    const line = state.doc.lineAt(Math.min(begin, length));
    // A finding of no width stands at the whole line.
    const [first, last] = end > begin ? [begin, Math.min(end, length)] : [line.from, line.to];
    return last > first ? [Decoration.mark({ class: `cm-finding cm-${finding.severity}` }).range(first, last)] : [];
  });
  return Decoration.set(ranges, true);
}

const marks = StateField.define<Shown>({
  create: () => ({ findings: [], contours: [], underlined: Decoration.none }),
  update(shown, transaction) {
    let now = shown;
    if (transaction.docChanged) {
      now = { ...moveMarks(now, transaction.changes), underlined: now.underlined.map(transaction.changes) };
    }
    for (const effect of transaction.effects) {
      if (effect.is(setMarks)) now = { ...effect.value, underlined: underlined(effect.value.findings, transaction.state) };
    }
    return now;
  },
  provide: (field) => EditorView.decorations.from(field, (shown) => shown.underlined),
});

const litField = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(shown, transaction) {
    let now = transaction.docChanged ? shown.map(transaction.changes) : shown;
    for (const effect of transaction.effects) {
      if (!effect.is(setLit)) continue;
      const [from, to] = effect.value ?? [0, 0];
      now = to > from && to <= transaction.state.doc.length ? Decoration.set([lit.range(from, to)]) : Decoration.none;
    }
    return now;
  },
  provide: (field) => EditorView.decorations.from(field),
});

// Remarks are grey, lines of contours have a mark: only those in sight.
const inSight = ViewPlugin.fromClass(
  class {
    decorations: DecorationSet;

    constructor(view: EditorView) {
      this.decorations = this.made(view);
    }

    update(update: ViewUpdate): void {
      const isMarked = update.startState.field(marks) !== update.state.field(marks);
      if (update.docChanged || update.viewportChanged || isMarked) this.decorations = this.made(update.view);
    }

    private made(view: EditorView): DecorationSet {
      const builder = new RangeSetBuilder<Decoration>();
      const { contours } = view.state.field(marks);
      for (const { from, to } of view.visibleRanges) {
        for (let at = from; at <= to; ) {
          const line = view.state.doc.lineAt(at);
          const own = contourAt(contours, line.number);
          if (own) builder.add(line.from, line.from, Decoration.line({ class: `cm-contour cm-${kindOf(own.status)}` }));
          for (const match of line.text.matchAll(REMARK)) {
            if (match[0]) builder.add(line.from + match.index, line.from + match.index + match[0].length, greyed);
          }
          at = line.to + 1;
        }
      }
      return builder.finish();
    }
  },
  { decorations: (plugin) => plugin.decorations },
);

export const kindOf = (status: string): string => (status === "solved" ? "fine" : status === "ambiguous" ? "several" : "unsolved");

export function contourAt(contours: ContourRow[], line: number): ContourRow | undefined {
  let [low, high] = [0, contours.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (contours[middle]!.last < line) low = middle + 1;
    else high = middle;
  }
  const found = contours[low];
  return found && found.line <= line ? found : undefined;
}

export const fixText = (fix: Fix): string => (fix.effect ? `${fix.title} [${fix.effect}]` : fix.title);

// The tooltip at a word with a finding: what is wrong, and its fixes as buttons.
function fixesAtWord(apply: (finding: number, fix: number) => void): Extension {
  const field = StateField.define<Tooltip | null>({
    create: () => null,
    update(shown, transaction) {
      for (const effect of transaction.effects) {
        if (!effect.is(openFixes)) continue;
        return effect.value ? tooltipAt(transaction.state, transaction.state.selection.main.head) : null;
      }
      return transaction.docChanged || transaction.selection ? null : shown;
    },
    provide: (own) => showTooltip.from(own),
  });

  function tooltipAt(state: EditorState, at: number): Tooltip | null {
    const { findings } = state.field(marks);
    const here = findings.map((placed, number) => ({ ...placed, number })).filter((each) => touches(each, at, state));
    if (!here.length) return null;
    return {
      pos: Math.min(...here.map((each) => Math.min(each.begin, state.doc.length))),
      above: false,
      arrow: false,
      create: (view) => {
        const close = (event: KeyboardEvent) => {
          if (event.key !== "Escape") return;
          view.dispatch({ effects: openFixes.of(false) });
          view.focus();
        };
        const told = here.map(({ finding, number }) =>
          make(
            "div",
            { class: `told ${finding.severity}` },
            make("p", { text: finding.message }),
            ...finding.fixes.map((fix, place) =>
              button(fixText(fix), () => {
                view.focus();
                apply(number, place);
              }),
            ),
          ),
        );
        return { dom: make("div", { class: "at-word", role: "dialog", "aria-label": "Finding and its fixes", onkeydown: close }, ...told) };
      },
    };
  }

  const show = (view: EditorView) => {
    view.dispatch({ effects: openFixes.of(true) });
    // The tooltip is there after the next measurement.
    requestAnimationFrame(() => view.dom.querySelector<HTMLElement>(".at-word button")?.focus());
    return true;
  };
  return [
    field,
    keymap.of([{ key: "Mod-.", run: show }, { key: "Alt-Enter", run: show }, { key: "Escape", run: (view) => hide(view, field) }]),
    EditorView.domEventHandlers({
      click: (event, view) => {
        const at = view.posAtCoords({ x: event.clientX, y: event.clientY });
        if (at !== null && view.state.selection.main.empty) view.dispatch({ effects: openFixes.of(true) });
      },
    }),
  ];
}

function hide(view: EditorView, field: StateField<Tooltip | null>): boolean {
  if (!view.state.field(field)) return false;
  view.dispatch({ effects: openFixes.of(false) });
  return true;
}

export function touches({ begin, end }: Placed, at: number, state: EditorState): boolean {
  if (end > begin) return begin <= at && at <= end;
  const line = state.doc.lineAt(Math.min(begin, state.doc.length));
  return line.from <= at && at <= line.to;
}

function toFinding(way: 1 | -1): (view: EditorView) => boolean {
  return (view) => {
    const at = view.state.selection.main.head;
    const starts = view.state.field(marks).findings.map((each) => each.begin).sort((a, b) => a - b);
    const next = way > 0 ? (starts.find((each) => each > at) ?? starts[0]) : (starts.filter((each) => each < at).at(-1) ?? starts.at(-1));
    if (next === undefined) return false;
    view.dispatch({ selection: { anchor: next }, scrollIntoView: true, effects: openFixes.of(true) });
    return true;
  };
}

export interface Heard {
  changed: (changes: ChangeSet) => void;
  selected: () => void;
  fix: (finding: number, fix: number) => void;
}

export function newState(text: string, heard: Heard, isReadOnly = false): EditorState {
  return EditorState.create({
    doc: text,
    extensions: [
      marks,
      litField,
      inSight,
      lineNumbers(),
      history(),
      drawSelection(),
      highlightActiveLine(),
      highlightSelectionMatches(),
      search({ top: true }),
      fixesAtWord(heard.fix),
      keymap.of([
        { key: "F8", run: toFinding(1), shift: toFinding(-1) },
        ...searchKeymap,
        ...historyKeymap,
        ...defaultKeymap,
      ]),
      EditorView.contentAttributes.of({ "aria-label": "Program", tabindex: "0", spellcheck: "false", autocapitalize: "off", autocorrect: "off" }),
      EditorState.readOnly.of(isReadOnly),
      EditorView.updateListener.of((update) => {
        if (update.docChanged) {
          const own = update.transactions.filter((each) => each.docChanged && !each.annotation(fromPython)).map((each) => each.changes);
          // What comes from Python comes alone.
          if (own.length) heard.changed(own.reduce((all, each) => all.compose(each)));
        }
        if (update.docChanged || update.selectionSet) heard.selected();
      }),
    ],
  });
}

export const markEffect = (found: Marks): StateEffect<Marks> => setMarks.of(found);
export const litEffect = (range: readonly [number, number] | null): StateEffect<readonly [number, number] | null> => setLit.of(range);
export const marksOf = (state: EditorState): Marks => state.field(marks);

// Edits of Python: one step of undo, or none.
export function pythonEdits(changes: ChangeSet, isStep = true): TransactionSpec {
  const annotations = isStep ? [fromPython.of(true), isolateHistory.of("full")] : [fromPython.of(true), Transaction.addToHistory.of(false)];
  return { changes, annotations };
}

export function changesOf(edits: Change[], length: number): ChangeSet {
  return ChangeSet.of(
    edits.map(({ from, to, text }) => ({ from, to, insert: text })),
    length,
  );
}

export function editsOf(changes: ChangeSet): Change[] {
  const edits: Change[] = [];
  changes.iterChanges((from, to, _from, _to, inserted) => edits.push({ from, to, text: inserted.toString() }));
  return edits;
}
