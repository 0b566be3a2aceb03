// The list of findings, by contour: each is one card, with its fixes.
import { activeIn, button, keepFocus, make, scroller } from "./dom";
import { contourAt, kindOf, type Placed } from "./editor";
import { fixButtons } from "./fixes";
import type { ContourRow, Finding } from "./protocol";

const MOST = 100; // that are shown at first
const FIRST = 2; // fixes of one that are shown at first
const KINDS = { error: "Error", warning: "Warning", info: "Note" };

// `left` were not sent; so many lines of all are `examined`, and nobody goes on where it `isLeft`; `here` are numbers of
// those at the cursor. A program whose control is not known is `unread`, for this reason.
export type Told = {
  findings: Placed[]; contours: ContourRow[]; unread: string; left: number;
  examined: number; lines: number; isLeft: boolean;
  lineOf: (at: number) => number; here: Set<number>;
};

const NOTHING: Told = { findings: [], contours: [], unread: "", left: 0, examined: 0, lines: 1, isLeft: false, lineOf: () => 1, here: new Set() };

export interface FindingsHeard {
  go: (finding: number) => void;
  step: (way: 1 | -1) => void;
  fix: (finding: number, fix: number) => void;
  light: (finding: Finding, fix: number | null) => void; // a fix that is pointed at
}

export function findingsList({ go, step, fix, light }: FindingsHeard) {
  let told = NOTHING;
  let most = MOST;
  let shown = ""; // groups and their states
  const reason = make("p", { class: "reason" });
  const list = make("div", { class: "groups" });
  const more = button("", () => ((most += 10 * MOST), render()), { hidden: true });
  const box = scroller("div", "List of findings", { class: "scroll" }, reason, list, more);
  const title = make("h2", { "aria-live": "polite" });
  const fold = button("", () => folded(!node.classList.contains("folded")), { class: "icon fold" });
  const steps = [button("↑", () => step(-1), { class: "icon", "aria-label": "Finding before", title: "Shift+F8" }), button("↓", () => step(1), { class: "icon", "aria-label": "Next finding", title: "F8" })];
  const node = make("section", { class: "findings", "aria-label": "Findings" }, make("div", { class: "headline" }, title, make("span", { class: "end" }, ...steps, fold)), box);

  function folded(isFolded: boolean): void {
    node.classList.toggle("folded", isFolded);
    fold.setAttribute("aria-expanded", String(!isFolded));
    fold.setAttribute("aria-label", isFolded ? "Show the list" : "Fold the list");
    fold.textContent = isFolded ? "▸" : "▾";
    box.hidden = isFolded;
  }
  folded(false);

  const contourOf = (each: Placed) => contourAt(told.contours, told.lineOf(each.begin));

  function render(): void {
    const cards = told.findings.slice(0, most).map((each, number) => [contourOf(each), card(each, number)] as const);
    const groups: HTMLElement[] = [];
    cards.forEach(([contour, item], place) => {
      if (!place || contour !== cards[place - 1]![0]) groups.push(make("section", { class: "group" }, contour ? heading(contour) : null, make("ol", {})));
      groups.at(-1)!.lastElementChild!.append(item);
    });
    keepFocus(box, () => list.replaceChildren(...groups));
    more.hidden = told.findings.length <= most;
    more.textContent = `${told.findings.length - most} more findings`;
  }

  function heading(contour: ContourRow): HTMLElement {
    const { line, last, status, told: state, title: form } = contour;
    const number = make("span", { class: "number", text: String(told.contours.indexOf(contour) + 1) });
    return make("h3", { class: kindOf(status) }, number, `${form}, ${line === last ? `line ${line}` : `lines ${line} to ${last}`}`, make("em", { text: state }));
  }

  function card({ finding, begin }: Placed, number: number): HTMLElement {
    const source = finding.source && `Source: ${finding.source}`;
    const about = [...finding.notes, ...finding.labels.map((each) => each.text), finding.help, finding.alarm, source, `Rule: ${finding.code}`].filter(Boolean);
    const [first, rest] = fixButtons(finding, FIRST, (place) => fix(number, place), (place) => light(finding, place));
    const unfolded = (name: string, ...within: Node[]) => make("details", {}, make("summary", { text: name }), ...within);
    return make(
      "li",
      { class: `card ${finding.severity}` },
      make(
        "button",
        { type: "button", class: "go", onclick: () => go(number), title: "Show the word in the text" },
        make("span", { class: "top" }, make("strong", { text: KINDS[finding.severity] ?? "Note" }), make("span", { class: "line", text: ` line ${told.lineOf(begin)} ` })),
        make("span", { class: "text", text: finding.message }),
      ),
      first.length ? make("div", { class: "fixes", role: "group", "aria-label": "Fixes" }, ...first) : null,
      rest.length ? unfolded(`${rest.length} more ${rest.length === 1 ? "fix" : "fixes"}`, make("div", { class: "fixes", role: "group", "aria-label": "More fixes" }, ...rest)) : null,
      unfolded("Why", ...about.map((text) => make("p", { text }))),
    );
  }

  return {
    node,
    show(now: Told) {
      const before = told;
      told = now;
      const isSame = before.findings.length === now.findings.length && now.findings.every((each, place) => each.finding === before.findings[place]?.finding);
      if (before.findings[0]?.finding.code !== now.findings[0]?.finding.code) most = MOST;
      const groups = JSON.stringify(now.findings.length ? now.contours : []);
      if (!isSame || groups !== shown) render();
      shown = groups;
      const said = summary(now);
      title.setAttribute("aria-busy", String(now.examined < now.lines));
      if (title.textContent !== said) title.textContent = said;
      title.className = now.examined < now.lines ? "waiting" : (now.findings[0]?.finding.severity ?? "");
      reason.textContent = now.unread && `${now.unread}\nChoose the control above.`;
      reason.hidden = !now.unread;
      for (const each of steps) each.hidden = !now.findings.length;
      node.classList.toggle("none", !now.unread && !now.findings.length);
      const cards = [...list.querySelectorAll<HTMLElement>(".card")];
      cards.forEach((each, number) => each.classList.toggle("here", now.here.has(number)));
      const lit = cards.find((each) => each.classList.contains("here"));
      if (!lit || box.contains(activeIn(box))) return;
      // With the heading of its group, where it is the first one.
      const group = lit.previousElementSibling ? lit : lit.closest(".group")!;
      for (const [mover, name, from] of [[box, "scrollTop", "top"], [list, "scrollLeft", "left"]] as const) {
        mover[name] += (from === "top" ? group : lit).getBoundingClientRect()[from] - mover.getBoundingClientRect()[from] - 8;
      }
    },
  };
}

// That there are none is said of a program all of whose lines are examined, and of no other.
export function summary({ findings, unread, left, examined, lines, isLeft }: Told): string {
  const isWaiting = examined < lines;
  if (unread && !isWaiting) return "Not checked";
  const counts = Object.entries(KINDS).map(([kind, name]) => [name.toLowerCase(), findings.filter((each) => each.finding.severity === kind).length] as const);
  const told = counts.filter(([, count]) => count).map(([name, count]) => `${count} ${name}${count === 1 ? "" : "s"}`).join(", ");
  if (!isWaiting) return (told || "No findings") + (left ? `, and ${left} more when these are mended` : "");
  const rest = isLeft ? `not checked from line ${examined + 1} on` : `still checking, ${examined} of ${lines} lines`;
  return told ? `${told} so far; ${rest}` : `${rest[0]!.toUpperCase()}${rest.slice(1)}`;
}
