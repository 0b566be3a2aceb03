// All contours of a program on one drawing: touch one, and its text is shown.
import { make, picture, scroller, zoomBar } from "./dom";
import { kindOf } from "./editor";
import type { ContourRow } from "./protocol";

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

export type Place = { line: number; text: string; kind: string };

export const placeOf = (each: ContourRow): Place => ({ line: each.line, text: `${each.title}: ${each.told}`, kind: kindOf(each.status) });

// A list of places in the program, each a button.
export function placeList(title: string, go: (line: number) => void) {
  const node = make("ul", { class: "contours", "aria-label": title });
  const row = ({ line, text, kind }: Place) =>
    make("li", {}, make("button", { type: "button", class: kind, "data-at": line, onclick: () => go(line) }, make("span", { class: "line", text: `line ${line}` }), ` ${text}`));
  return { node, show: (places: Place[]) => node.replaceChildren(...places.slice(0, MOST).map(row)) };
}

export function drawingPanel(go: (line: number) => void, open: (line: number) => void) {
  let isLit: number | null = null;
  let listed: ContourRow[] | null = null;
  const paper = scroller("div", "Drawing of the program", { class: "canvas" });
  const box = scroller("div", "Drawing of all contours; arrow keys move it", { class: "all contoursolve" }, paper);
  const zoom = zoomBar(paper, box, "the drawing");
  const rows = placeList("Contours", go);
  const said = make("p", { class: "muted" });

  const at = (act: (line: number) => void) => (event: MouseEvent) => {
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
    node: make("div", { class: "drawing" }, zoom, box, said, rows.node),
    show(svg: string | null) {
      paper.replaceChildren(...picture(svg ?? ""));
      relight();
    },
    list(contours: ContourRow[], isUnread: boolean) {
      const none = isUnread ? "Nothing is drawn as long as the control is not known." : "There is no contour to solve in this program yet.";
      if (!contours.length && said.textContent !== none) said.textContent = none;
      if (contours === listed) return;
      listed = contours;
      const { length } = contours;
      const most = length > MOST ? `; the first ${MOST} are listed, the text has a mark at each` : "";
      if (length) said.textContent = `${length} ${length === 1 ? "contour" : "contours"}${most}. Touch one to see its text.`;
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
