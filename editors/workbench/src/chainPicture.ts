// The picture of a sketch: what is known of it, the ghost of a solution, and guesses, which a touch sets.
import { button, make, picture, renew, scroller, zoomBar } from "./dom";
import { type Chain, type ChainView, guessesOf, type Piece } from "./chainSketch";
import type { Frame } from "./protocol";

const SVG = "http://www.w3.org/2000/svg";

function mark(kind: string, attributes: Record<string, string>): SVGElement {
  const element = document.createElementNS(SVG, kind);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}

type Shown = { chain: Chain; view: ChainView | null; chosen: number; isBehind: boolean };

export function chainPicture(select: (number: number) => void, guess: (number: number, place: [number, number]) => void) {
  let isGuessing = false;
  let now: Shown | null = null;
  let frame: Frame | null = null;
  const over = mark("svg", { class: "over", "aria-hidden": "true" });
  const drawn = make("div", { class: "drawn" });
  const paper = scroller("div", "Picture of the contour; arrow keys move it", { class: "canvas contoursolve" }, drawn);
  const toggle = button("Guess by touch", () => set(!isGuessing), { "aria-pressed": "false" });
  const told = make("span", { class: "muted" });
  const stale = make("p", { class: "wrong note", role: "status", hidden: true, text: "Not up to date: this picture is older than what is entered." });
  const zoom = zoomBar(drawn, paper, "the picture");
  const node = make("div", { class: "chain-picture" }, make("div", { class: "bar" }, toggle, zoom, told), make("div", { class: "framed" }, paper, stale));
  let ghostly: Piece[] = [];

  function set(wanted: boolean): void {
    isGuessing = wanted;
    toggle.setAttribute("aria-pressed", String(wanted));
    paper.classList.toggle("guessing", wanted);
    told.textContent = wanted ? "Touch the drawing about where the element ends." : "";
  }

  const at = ([x, y]: [number, number]): [number, number] => [frame!.origin[0] + x * frame!.scale, frame!.origin[1] - y * frame!.scale];

  paper.addEventListener("click", (event) => {
    if (!isGuessing) {
      const number = Number((event.target as Element).closest?.("[data-number]")?.getAttribute("data-number") ?? 0);
      if (number) select(number);
      return;
    }
    const box = drawn.getBoundingClientRect();
    if (!frame || !now?.chosen || !box.width || !stale.hidden) return;
    const x = ((event.clientX - box.left) / box.width) * frame.width;
    const y = ((event.clientY - box.top) / box.height) * frame.height;
    guess(now.chosen, [(x - frame.origin[0]) / frame.scale, (frame.origin[1] - y) / frame.scale]);
    set(false);
  });

  function path(piece: Piece): string {
    const [start, end] = [at(piece.start), at(piece.end)];
    if (piece.kind !== "arc" || !piece.center) return `M${start}L${end}`;
    const center = piece.center;
    const angle = ([x, y]: [number, number]) => Math.atan2(y - center[1], x - center[0]);
    const turn = piece.turn === "cw" ? -1 : 1;
    const swept = ((angle(piece.end) - angle(piece.start)) * turn + 4 * Math.PI) % (2 * Math.PI);
    const radius = (piece.radius ?? 0) * frame!.scale;
    return `M${start}A${radius},${radius} 0 ${swept > Math.PI ? 1 : 0} ${turn > 0 ? 0 : 1} ${end}`;
  }

  function overlay(): void {
    over.replaceChildren();
    if (!frame || !now) return;
    over.setAttribute("viewBox", `0 0 ${frame.width} ${frame.height}`);
    for (const { number, segment } of now.view?.elements ?? []) {
      if (segment) over.append(mark("path", { d: path(segment), class: number === now.chosen ? "hit lit" : "hit", "data-number": String(number) }));
    }
    for (const piece of ghostly) over.append(mark("path", { d: path(piece), class: "ghost" }));
    for (const each of guessesOf(now.chain)) {
      const [cx, cy] = at(each).map((value) => value.toFixed(2)) as [string, string];
      over.append(mark("circle", { cx, cy, r: "9", class: "guess" }), mark("circle", { cx, cy, r: "2.5", class: "guess dot" }));
    }
  }

  return {
    node,
    // Guess no more; whether that was so.
    end(): boolean {
      const before = isGuessing;
      set(false);
      return before;
    },
    ghost(pieces: Piece[]) {
      ghostly = pieces;
      overlay();
    },
    show(wanted: Shown) {
      const { chain, view, chosen, isBehind } = (now = wanted);
      node.classList.toggle("stale", isBehind);
      stale.hidden = !isBehind || !view?.picture;
      toggle.setAttribute("aria-disabled", String(isBehind || !chosen || !view?.picture));
      toggle.textContent = chosen ? `Guess by touch: end of ${chain.element[chosen - 1]?.kind ?? "line"} ${chosen}` : "Guess by touch";
      frame = view?.picture?.frame.scale ? view.picture.frame : null;
      const svg = view?.picture?.svg ?? "";
      renew(drawn, svg, () => [...picture(svg), ...(svg ? [over] : [])]);
      overlay();
    },
  };
}
