// The list of findings under the text.
import { activeIn, button, keepFocus, make, scroller } from "./dom";
import { fixText, type Placed } from "./editor";

const MOST = 100; // that are shown at first
const KINDS = { error: "Error", warning: "Warning", info: "Note" };

// `left` were not sent; so many lines of all are `examined`, and nobody goes on where it `isLeft`; `here` are numbers of
// those at the cursor. A program whose control is not known is `unread`, for this reason.
export type Told = {
  findings: Placed[]; unread: string; left: number;
  examined: number; lines: number; isLeft: boolean;
  lineOf: (at: number) => number; here: Set<number>;
};

export function findingsList(go: (finding: number) => void, fix: (finding: number, fix: number) => void) {
  let told: Told = { findings: [], unread: "", left: 0, examined: 0, lines: 1, isLeft: false, lineOf: () => 1, here: new Set() };
  let most = MOST;
  const reason = make("p", {});
  const list = make("ol", {});
  const more = button("", () => ((most += 10 * MOST), render()), { hidden: true });
  const box = scroller("div", "List of findings", { class: "scroll" }, reason, list, more);
  const title = make("h2", { "aria-live": "polite" });

  function render(): void {
    const { findings } = told;
    keepFocus(box, () => list.replaceChildren(...findings.slice(0, most).map(item)));
    more.hidden = findings.length <= most;
    more.textContent = `${findings.length - most} more findings`;
  }

  function item({ finding, begin }: Placed, number: number): HTMLElement {
    const fixes = finding.fixes.map((each, place) => button(fixText(each), () => fix(number, place), { class: each.kind }));
    const source = finding.source && `Source: ${finding.source}`;
    const about = [...finding.notes, ...finding.labels.map((each) => each.text), finding.help, finding.alarm, source, `Rule: ${finding.code}`].filter(Boolean);
    return make(
      "li",
      { class: finding.severity },
      make(
        "button",
        { type: "button", class: "go", onclick: () => go(number), title: "Show the word in the text" },
        make("strong", { text: KINDS[finding.severity] ?? "Note" }),
        make("span", { class: "line", text: ` line ${told.lineOf(begin)} ` }),
        make("span", { text: finding.message }),
      ),
      fixes.length ? make("div", { class: "fixes", role: "group", "aria-label": "Fixes" }, ...fixes) : null,
      make("details", {}, make("summary", { text: "Why" }), ...about.map((text) => make("p", { text }))),
    );
  }

  return {
    node: make("section", { class: "findings", "aria-label": "Findings" }, title, box),
    show(now: Told) {
      const before = told;
      told = now;
      const isSame = before.findings.length === now.findings.length && now.findings.every((each, place) => each.finding === before.findings[place]?.finding);
      if (before.findings[0]?.finding.code !== now.findings[0]?.finding.code) most = MOST;
      if (!isSame) render();
      const said = summary(now);
      title.setAttribute("aria-busy", String(now.examined < now.lines));
      if (title.textContent !== said) title.textContent = said;
      reason.textContent = now.unread && `${now.unread}\nChoose the control above.`;
      reason.hidden = !now.unread;
      [...list.children].forEach((each, number) => each.classList.toggle("here", now.here.has(number)));
      const lit = list.querySelector(".here");
      if (lit && !box.contains(activeIn(box))) box.scrollTop += lit.getBoundingClientRect().top - box.getBoundingClientRect().top - 4;
    },
  };
}

// That there are none is said of a program all of whose lines are examined, and of no other.
function summary({ findings, unread, left, examined, lines, isLeft }: Told): string {
  const isWaiting = examined < lines;
  if (unread && !isWaiting) return "Not checked";
  const counts = Object.entries(KINDS).map(([kind, name]) => [name.toLowerCase(), findings.filter((each) => each.finding.severity === kind).length] as const);
  const told = counts.filter(([, count]) => count).map(([name, count]) => `${count} ${name}${count === 1 ? "" : "s"}`).join(", ");
  if (!isWaiting) return (told || "No findings") + (left ? `, and ${left} more when these are mended` : "");
  const rest = isLeft ? `not checked from line ${examined + 1} on` : `still checking, ${examined} of ${lines} lines`;
  return told ? `${told} so far; ${rest}` : `${rest[0]!.toUpperCase()}${rest.slice(1)}`;
}
