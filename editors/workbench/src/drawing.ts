// All contours of a program on one drawing: touch one, and its text is shown.
import { make, picture, scroller, zoomBar } from "./dom";
import { kindOf } from "./editor";
import { LEGEND, playerOver, viewOf } from "./player";
import type { ContourRow, Drawn } from "./protocol";

const MOST = 200; // buttons under the drawing
const NEAR = 22; // px from a line that a finger means
const STEPS = 60; // places of a line that are looked at

// How far a part of the drawing is from a place on the screen.
function distance(part: SVGGraphicsElement, x: number, y: number): number {
  const box = part.getBoundingClientRect();
  const beside = Math.hypot(Math.max(box.left - x, 0, x - box.right), Math.max(box.top - y, 0, y - box.bottom));
  const matrix = part.getScreenCTM();
  if (beside > NEAR || !(part instanceof SVGGeometryElement) || !matrix) return beside;
  const length = part.getTotalLength();
  const places = Array.from({ length: STEPS + 1 }, (_, step) => part.getPointAtLength((length * step) / STEPS).matrixTransform(matrix));
  return Math.min(...places.map((at) => Math.hypot(at.x - x, at.y - y)));
}

// The drawing without its heading and its remarks: both stand beside it already.
function crop(whole: SVGSVGElement, drawn: Drawn): void {
  whole.setAttribute("viewBox", viewOf(drawn));
  const [, top, , bottom] = drawn.frame?.box ?? [0, -Infinity, 0, Infinity];
  for (const each of whole.querySelectorAll("text")) {
    const y = Number(each.getAttribute("y"));
    if (y < top || y > bottom + LEGEND) each.remove();
  }
}

export type Place = { line: number; text: string; kind: string };

export const placeOf = (each: ContourRow): Place => ({ line: each.line, text: `${each.title}: ${each.told}`, kind: kindOf(each.status) });

// A list of places in the program, each a button.
export function placeList(title: string, go: (line: number) => void) {
  const node = make("ul", { class: "contours", "aria-label": title });
  const row = ({ line, text, kind }: Place) =>
    make("li", {}, make("button", { type: "button", class: kind, "data-at": line, onclick: () => go(line) }, make("span", { class: "line", text: `line ${line}` }), ` ${text}`));
  return { node, show: (places: Place[]) => node.replaceChildren(...places.slice(0, MOST).map(row)) };
}

// `played` hears at which line the tool is.
export function drawingPanel(go: (line: number) => void, open: (line: number) => void, played: (line: number | null) => void) {
  let isLit: number | null = null;
  let listed: ContourRow[] | null = null;
  const paper = scroller("div", "Drawing of the program", { class: "canvas" });
  const box = scroller("div", "Drawing of all contours; arrow keys move it", { class: "all contoursolve" }, paper);
  const overlay = playerOver(paper, played);
  const tools = make("div", { class: "end" }, overlay.measure, zoomBar(paper, box, "the drawing"));
  const rows = placeList("Contours", go);
  const said = make("summary", {});
  const none = make("p", { class: "muted" });
  const list = make("details", { class: "list" }, said, rows.node);

  const at = (act: (line: number) => void) => (event: MouseEvent) => {
    if (overlay.isMeasuring()) return;
    const parts = [...paper.querySelectorAll<SVGGraphicsElement>("[data-line]")];
    // The drawing of a single contour names no line.
    if (!parts.length) return listed?.length === 1 ? act(listed[0]!.line) : undefined;
    const near = parts.map((part) => [distance(part, event.clientX, event.clientY), Number(part.dataset["line"])] as const);
    const [gap, line] = near.reduce((best, each) => (each[0] < best[0] ? each : best));
    if (gap <= NEAR && line) act(line);
  };
  paper.addEventListener("click", at(go));
  paper.addEventListener("dblclick", at(open));

  function relight(): void {
    for (const each of paper.querySelectorAll<SVGElement>("[data-line]")) each.classList.toggle("lit", Number(each.dataset["line"]) === isLit);
    for (const each of rows.node.querySelectorAll<HTMLElement>("button")) each.setAttribute("aria-pressed", String(Number(each.dataset["at"]) === isLit));
  }

  return {
    node: make("div", { class: "drawing" }, none, make("div", { class: "sheet" }, box, overlay.readout), overlay.player, list),
    tools,
    lightWay: overlay.lightWay,
    show(drawn: Drawn | null) {
      const shown = picture(drawn?.svg ?? "");
      if (drawn?.frame) for (const each of shown) crop(each, drawn);
      paper.replaceChildren(...shown);
      overlay.show(drawn);
      relight();
    },
    list(contours: ContourRow[], isUnread: boolean) {
      none.textContent = contours.length ? "" : isUnread ? "Nothing is drawn as long as the control is not known." : "There is no contour to solve in this program yet.";
      none.hidden = contours.length > 0;
      list.hidden = !contours.length;
      if (contours === listed) return;
      listed = contours;
      const { length } = contours;
      said.textContent = `${length} ${length === 1 ? "contour" : "contours"}${length > MOST ? `; the first ${MOST} are listed, the text has a mark at each` : ""}`;
      rows.show(contours.map(placeOf));
      relight();
    },
    light(line: number | null) {
      if (line === isLit) return;
      isLit = line;
      relight();
    },
  };
}
