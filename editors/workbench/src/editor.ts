// The text of a program: findings underlined, contours marked at the edge, fixes at the word.
import { defaultKeymap, history, historyKeymap, isolateHistory } from "@codemirror/commands";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { Annotation, type ChangeDesc, ChangeSet, EditorState, type Extension, StateEffect, StateField, type Text, type TransactionSpec } from "@codemirror/state";
import { Decoration, type DecorationSet, drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers, MatchDecorator, showTooltip, type Tooltip, ViewPlugin, type ViewUpdate } from "@codemirror/view";

import { make } from "./dom";
import { fixButtons } from "./fixes";
import type { Change, ContourRow, Finding } from "./protocol";

// What Python changed: the Desk has it already.
export const fromPython = Annotation.define<boolean>();

export type Placed = { finding: Finding; begin: number; end: number };
export type Marks = { findings: Placed[]; contours: ContourRow[] };

export const markEffect = StateEffect.define<Marks>();
export const litEffect = StateEffect.define<readonly [number, number] | null>();
export const playEffect = StateEffect.define<number | null>(); // the line at which the tool is
const openFixes = StateEffect.define<boolean>();

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

// Of no width, it stands at the whole line.
function stretchOf({ begin, end }: Placed, { doc }: EditorState): [number, number] {
  if (end > begin) return [begin, Math.min(end, doc.length)];
  const line = doc.lineAt(Math.min(begin, doc.length));
  return [line.from, line.to];
}

// Drawn are findings underlined, lines of contours with a mark, and the word that is pointed at elsewhere.
type Shown = Marks & { drawn: DecorationSet[] };

function underlined(findings: Placed[], state: EditorState): DecorationSet {
  const told = new Set<number>(); // lines at whose end is told what is wrong: the first finding
  const ranges = findings.flatMap((each) => {
    const [first, last] = stretchOf(each, state);
    const { severity } = each.finding;
    const words = last > first ? [Decoration.mark({ class: `cm-finding ${severity}` }).range(first, last)] : [];
    const line = state.doc.lineAt(first);
    const amount = amountOf(each.finding);
    if (!amount || told.has(line.number)) return words;
    told.add(line.number);
    return [...words, Decoration.line({ class: `cm-told ${severity}`, attributes: { "data-told": amount } }).range(line.from)];
  });
  return Decoration.set(ranges, true);
}

// What stands at its own word: the amount, or the choice.
const amountOf = ({ labels, line, from }: Finding): string => labels.find((each) => each.line === line && each.from === from)?.text ?? "";

function marked(contours: ContourRow[], { doc }: EditorState): DecorationSet {
  const ranges = contours.flatMap(({ line, last, status }) => {
    const mark = Decoration.line({ class: `cm-contour ${kindOf(status)}` });
    return Array.from({ length: Math.max(0, Math.min(last, doc.lines) - line + 1) }, (_, place) => mark.range(doc.line(line + place).from));
  });
  return Decoration.set(ranges, true);
}

const marks = StateField.define<Shown>({
  create: () => ({ findings: [], contours: [], drawn: [Decoration.none, Decoration.none, Decoration.none] }),
  update(shown, { docChanged, changes, effects, state }) {
    let now = docChanged ? { ...moveMarks(shown, changes), drawn: shown.drawn.map((each) => each.map(changes)) } : shown;
    for (const effect of effects) {
      const [findings, contours, word] = now.drawn as [DecorationSet, DecorationSet, DecorationSet];
      if (effect.is(markEffect)) {
        const { value } = effect;
        // The same contours moved with their lines, if none of these was put in anew.
        const isSame = value.contours === now.contours && contours.size === value.contours.reduce((sum, each) => sum + each.last - each.line + 1, 0);
        now = { ...value, drawn: [underlined(value.findings, state), isSame ? contours : marked(value.contours, state), word] };
      }
      if (!effect.is(litEffect)) continue;
      const [from, to] = effect.value ?? [0, 0];
      now = { ...now, drawn: [findings, contours, to > from && to <= state.doc.length ? Decoration.set([Decoration.mark({ class: "cm-lit" }).range(from, to)]) : Decoration.none] };
    }
    return now;
  },
  provide: (field) => [0, 1, 2].map((which) => EditorView.decorations.from(field, (shown) => shown.drawn[which]!)),
});

const played = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(shown, { effects, changes, state }) {
    const told = effects.find((each) => each.is(playEffect));
    if (!told) return shown.map(changes);
    const line = told.value as number | null;
    return line === null || line > state.doc.lines ? Decoration.none : Decoration.set([Decoration.line({ class: "cm-played" }).range(state.doc.line(line).from)]);
  },
  provide: (field) => EditorView.decorations.from(field),
});

// Remarks are grey: those in sight.
const remarks = new MatchDecorator({ regexp: /\([^)\n]*\)?|;.*/g, decoration: Decoration.mark({ class: "cm-remark" }) });
const greyed = ViewPlugin.define(
  (view) => ({ shown: remarks.createDeco(view), update(update: ViewUpdate) { this.shown = remarks.updateDeco(update, this.shown); } }),
  { decorations: (plugin) => plugin.shown },
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

// The tooltip at a word with a finding: what is wrong, and its fixes as buttons.
function fixesAtWord(apply: (finding: number, fix: number) => void): Extension {
  const field = StateField.define<Tooltip | null>({
    create: () => null,
    update(shown, { effects, docChanged, selection, state }) {
      const opened = effects.find((effect) => effect.is(openFixes));
      if (opened) return opened.value ? tooltipAt(state, state.selection.main.head) : null;
      return docChanged || selection ? null : shown;
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
        const told = here.map(({ finding, number }) => {
          const fixed = (place: number) => {
            view.focus();
            apply(number, place);
          };
          const [fixes] = fixButtons(finding, finding.fixes.length, fixed, () => {});
          return make("div", { class: `told ${finding.severity}` }, make("p", { text: finding.message }), ...fixes);
        });
        const pressed = (event: KeyboardEvent) => event.key === "Escape" && hide(view);
        return { dom: make("div", { class: "at-word", role: "dialog", "aria-label": "Finding and its fixes", onkeydown: pressed }, ...told) };
      },
    };
  }

  const show = (view: EditorView) => {
    view.dispatch({ effects: openFixes.of(true) });
    // The tooltip is there after the next measurement.
    requestAnimationFrame(() => view.dom.querySelector<HTMLElement>(".at-word button")?.focus());
    return true;
  };
  const hide = (view: EditorView) => {
    if (!view.state.field(field)) return false;
    view.dispatch({ effects: openFixes.of(false) });
    view.focus();
    return true;
  };
  return [
    field,
    keymap.of([{ key: "Mod-.", run: show }, { key: "Alt-Enter", run: show }, { key: "Escape", run: hide }]),
    EditorView.domEventHandlers({
      click: (event, view) => {
        const at = view.posAtCoords({ x: event.clientX, y: event.clientY });
        if (at !== null && view.state.selection.main.empty) view.dispatch({ effects: openFixes.of(true) });
      },
    }),
  ];
}

export function touches(placed: Placed, at: number, state: EditorState): boolean {
  const [begin, end] = stretchOf(placed, state);
  return begin <= at && at <= end;
}

export function toFinding(way: 1 | -1): (view: EditorView) => boolean {
  return (view) => {
    const at = view.state.selection.main.head;
    const starts = view.state.field(marks).findings.map((each) => each.begin).sort((a, b) => a - b);
    const next = way > 0 ? (starts.find((each) => each > at) ?? starts[0]) : (starts.filter((each) => each < at).at(-1) ?? starts.at(-1));
    if (next === undefined) return false;
    view.dispatch({ selection: { anchor: next }, scrollIntoView: true, effects: openFixes.of(true) });
    return true;
  };
}

export type Heard = { changed: (changes: ChangeSet) => void; selected: () => void; fix: (finding: number, fix: number) => void };

export function newState(text: string, heard: Heard): EditorState {
  return EditorState.create({
    doc: text,
    extensions: [
      marks,
      played,
      greyed,
      lineNumbers(),
      history(),
      drawSelection(),
      highlightActiveLine(),
      highlightSelectionMatches(),
      search({ top: true }),
      fixesAtWord(heard.fix),
      keymap.of([{ key: "F8", run: toFinding(1), shift: toFinding(-1) }, ...searchKeymap, ...historyKeymap, ...defaultKeymap]),
      EditorView.contentAttributes.of({ "aria-label": "Program", tabindex: "0", spellcheck: "false", autocapitalize: "off", autocorrect: "off" }),
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

export const marksOf = (state: EditorState): Marks => state.field(marks);

// Edits of Python: one step of undo, or a part of the last one, which only a composition always is.
export const pythonEdits = (changes: ChangeSet, isPart: boolean): TransactionSpec => ({
  changes,
  annotations: [fromPython.of(true), isolateHistory.of("full")],
  ...(isPart ? { userEvent: "input.type.compose" } : {}),
});

export const changesOf = (edits: Change[], length: number): ChangeSet => ChangeSet.of(edits.map(({ from, to, text }) => ({ from, to, insert: text })), length);

export function editsOf(changes: ChangeSet): Change[] {
  const edits: Change[] = [];
  changes.iterChanges((from, to, _from, _to, inserted) => edits.push({ from, to, text: inserted.toString() }));
  return edits;
}
