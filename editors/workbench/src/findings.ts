// The list of findings under the text.
import { button, make } from "./dom";
import { fixText, type Placed } from "./editor";

const MOST = 100; // that are shown at first
const KINDS = { error: "Error", warning: "Warning", info: "Note" };

export interface FindingsList {
  node: HTMLElement;
  show(findings: Placed[], left: number, progress: string, lineOf: (at: number) => number, here: Set<number>): void;
}

export function findingsList(go: (finding: number) => void, fix: (finding: number, fix: number) => void): FindingsList {
  let left = 0; // that were not sent
  let under = ""; // how far the program is examined
  let shown: Placed[] | null = null;
  let most = MOST;
  const list = make("ol", {});
  const more = button("", () => {
    most += 10 * MOST;
    render();
  });
  const title = make("h2", { "aria-live": "polite" });
  const node = make("section", { class: "findings", "aria-label": "Findings" }, title, make("div", { class: "scroll", tabindex: 0, role: "group", "aria-label": "List of findings" }, list, more));
  let lines: (at: number) => number = () => 1;

  function render(): void {
    const all = shown ?? [];
    const active = (node.getRootNode() as Document).activeElement;
    const place = active ? [...list.querySelectorAll("button")].indexOf(active as HTMLButtonElement) : -1;
    list.replaceChildren(...all.slice(0, most).map((each, number) => item(each, number)));
    more.hidden = all.length <= most;
    more.textContent = `${all.length - most} more findings`;
    tell();
    // What is shown anew would lose the keys that follow to the page.
    if (place >= 0) ([...list.querySelectorAll("button")].at(Math.min(place, list.querySelectorAll("button").length - 1)) ?? list.parentElement)?.focus();
  }

  function tell(): void {
    const told = [summary(shown ?? [], left), under].filter(Boolean).join(". ");
    if (title.textContent !== told) title.textContent = told;
  }

  function item({ finding, begin }: Placed, number: number): HTMLElement {
    const fixes = finding.fixes.map((each, place) => button(fixText(each), () => fix(number, place), { class: `fix ${each.kind}` }));
    const source = finding.source && `Source: ${finding.source}`;
    const about = [...finding.notes, ...finding.labels.map((each) => each.text), finding.help, finding.alarm, source, `Rule: ${finding.code}`].filter(Boolean);
    return make(
      "li",
      { class: finding.severity },
      make(
        "button",
        { type: "button", class: "go", onclick: () => go(number), title: "Show the word in the text" },
        make("strong", { text: KINDS[finding.severity] ?? "Note" }),
        make("span", { class: "line", text: ` line ${lines(begin)} ` }),
        make("span", { text: finding.message }),
      ),
      fixes.length ? make("div", { class: "fixes", role: "group", "aria-label": "Fixes" }, ...fixes) : null,
      make("details", {}, make("summary", { text: "Why" }), ...about.map((text) => make("p", { text }))),
    );
  }

  return {
    node,
    show(findings, more, progress, lineOf, here) {
      const isSame = shown?.length === findings.length && findings.every((each, place) => each.finding === shown?.[place]?.finding);
      if (!isSame || more !== left) {
        left = more;
        if (shown && !sameStart(findings, shown)) most = MOST;
        shown = findings;
        lines = lineOf;
        render();
      }
      under = progress;
      tell();
      [...list.children].forEach((each, number) => each.classList.toggle("here", here.has(number)));
      const first = Math.min(...here);
      const lit = Number.isFinite(first) ? list.children[first] : null;
      const scroller = list.parentElement!;
      if (lit instanceof HTMLElement && !scroller.contains((node.getRootNode() as Document).activeElement)) {
        scroller.scrollTop += lit.getBoundingClientRect().top - scroller.getBoundingClientRect().top - 4;
      }
    },
  };
}

function sameStart(one: Placed[], other: Placed[]): boolean {
  return one[0]?.finding.code === other[0]?.finding.code;
}

function summary(all: Placed[], left: number): string {
  if (!all.length) return "No findings";
  const counts = (["error", "warning", "info"] as const).map((kind) => [KINDS[kind].toLowerCase(), all.filter((each) => each.finding.severity === kind).length] as const);
  return counts.filter(([, count]) => count).map(([kind, count]) => `${count} ${kind}${count === 1 ? "" : "s"}`).join(", ") + (left ? `, and ${left} more when these are mended` : "");
}
