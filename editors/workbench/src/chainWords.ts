// The words of a sketch for a control: the shortest first, and the same for all controls as a table.
import { button, make, offer, scroller, select, takeAlong } from "./dom";
import { AXES, type Sketch } from "./chainSketch";
import { type ControlName, orTrouble } from "./protocol";

type Word = { text: string; rests: string; off: string }; // drawing, round, computed
type Candidate = { title?: string; block: string; program: string; words?: Word[] };
type Written = { candidates: Candidate[]; reason: string; ending: string }; // of the files of its programs
type Row = { title: string; block: string; reason: string }; // for a control

const RESTS = [["drawing", "from the drawing"], ["round", "exact, but not from the drawing"], ["computed", "computed and rounded"]] as const;
const FIRST = 2; // ways that are shown at first
const MACHINES = { turned: "lathe", milled: "mill" };

export function wordsPanel(controls: () => ControlName[], open: (name: string, text: string) => void) {
  let sketch: Sketch | null = null;
  let made = ""; // for which sketch and control
  let offered = ""; // the kind of machine whose controls are offered
  const control = select([], { onchange: () => void ask() });
  const said = make("p", { role: "status", class: "muted" });
  const list = make("div", { class: "candidates" });
  const table = make("div", {});
  const all = button("The same for all controls", () => void askAll());
  const bar = make("div", { class: "bar" }, make("label", {}, make("span", { text: "Write it for" }), control), all);

  const isReady = (of: Sketch) => !of.isBehind && of.view?.is_finished === true;

  // What is written, or the reason why nothing is.
  function asked<Reply>(of: Sketch, name: string | null): Promise<Reply | null> {
    said.textContent = name ? "Writing …" : "Writing for all controls …";
    return orTrouble(of.words<Reply>(name), (why) => (said.textContent = of.named(why.message)));
  }

  async function ask(): Promise<void> {
    const of = sketch;
    const mark = of && `${control.value} ${of.trouble} ${of.text}`;
    if (!of || mark === null || mark === made) return;
    made = mark;
    table.replaceChildren();
    all.setAttribute("aria-disabled", String(!isReady(of)));
    if (!isReady(of)) {
      said.textContent = of.trouble || "The contour is not finished yet: enter what is missing, then its words are written here.";
      return list.replaceChildren();
    }
    const written = await asked<Written>(of, control.value);
    if (mark !== made) return;
    if (written) said.textContent = written.reason;
    const start = AXES[of.chain.part].map((axis) => `${axis}${of.chain.start[axis] || "0"}`).join(" ");
    const sections = (written?.candidates ?? []).map((each, number) => candidate(each, number, `${of.name.replace(/\.[^.]*$/, "") || "contour"}-${control.value}${written?.ending ?? ""}`));
    const about = `The blocks begin at ${start}. Tool, speed, feed, approach and retract are yours to add.`;
    const more = sections.splice(FIRST);
    const folded = more.length && make("details", {}, make("summary", { text: `${more.length} more ${more.length === 1 ? "way" : "ways"}` }), ...more);
    list.replaceChildren(sections.length ? make("p", { class: "muted", text: about }) : "", ...sections, folded || "");
  }

  function candidate({ title, block, program, words = [] }: Candidate, number: number, name: string): HTMLElement {
    const counts = RESTS.map(([kind, text]) => [text, words.filter((word) => word.rests === kind).length] as const).filter(([, count]) => count);
    const computed = words.filter((word) => word.rests === "computed").map((word) => make("span", { class: "word computed", text: `${word.text} (${word.off})`, title: RESTS[2][1] }));
    const told = counts.map(([text, count]) => `${count} ${count === 1 ? "word" : "words"} ${text}`).join(", ");
    return make(
      "section",
      { class: "candidate", "aria-label": title ?? `Way ${number + 1}` },
      make("h2", { text: title ?? (number ? `Way ${number + 1}` : "The shortest") }),
      scroller("pre", "Words", { text: block }),
      told && make("p", { class: "muted", text: told }),
      computed.length ? make("p", { class: "muted" }, "Computed: ", ...computed.flatMap((word) => [word, " "])) : null,
      takeAlong(name, program, "text/plain", block, button("Open as a program", () => open(name, program))),
    );
  }

  async function askAll(): Promise<void> {
    const of = sketch;
    if (!of || !isReady(of)) return;
    const reply = await asked<{ rows: Row[] }>(of, null);
    if (!reply || of !== sketch) return;
    said.textContent = "";
    const row = ({ title, block, reason }: Row) => make("tr", {}, make("th", { scope: "row", text: title }), make("td", {}, block && make("pre", { text: block }), reason && make("p", { class: "muted", text: reason })));
    // Those that cannot say it come last.
    const rows = [...reply.rows].sort((one, other) => Number(!one.block) - Number(!other.block));
    const head = make("tr", {}, ...["Control", "Words"].map((text) => make("th", { scope: "col", text })));
    table.replaceChildren(scroller("div", "The same for all controls", { class: "scroll" }, make("table", {}, make("thead", {}, head), make("tbody", {}, ...rows.map(row)))));
    table.scrollIntoView({ block: "start" });
  }

  return {
    node: make("div", { class: "result words" }, bar, said, list, table),
    show(now: Sketch, isWanted: boolean) {
      sketch = now;
      const machine = MACHINES[now.chain.part];
      if (machine !== offered) {
        const alike = controls().filter((each) => each.machines?.includes(machine) !== false);
        offer(control, alike.map((each) => [each.name, each.title]));
        if (alike.length) offered = machine;
      }
      if (isWanted) void ask();
    },
  };
}
