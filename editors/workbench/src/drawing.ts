// All contours of a program on one drawing: touch one, and its text is shown.
import { make, picture, zoomBar } from "./dom";
import { kindOf } from "./editor";
import type { ContourRow } from "./protocol";

const MOST = 200; // buttons under the drawing

const NEAR = 22; // px from a line that a finger means

// How far a part of the drawing is from a place on the screen.
function distance(part: SVGGraphicsElement, x: number, y: number): number {
  const box = part.getBoundingClientRect();
  const beside = Math.hypot(Math.max(box.left - x, 0, x - box.right), Math.max(box.top - y, 0, y - box.bottom));
  const matrix = part.getScreenCTM();
  if (beside > NEAR || !(part instanceof SVGGeometryElement) || !matrix) return beside;
  const length = part.getTotalLength();
  const gaps = Array.from({ length: STEPS + 1 }, (_, step) => {
    const at = part.getPointAtLength((length * step) / STEPS).matrixTransform(matrix);
    return Math.hypot(at.x - x, at.y - y);
  });
  return Math.min(...gaps);
}

const STEPS = 60; // places of a line that are looked at

export interface DrawingPanel {
  node: HTMLElement;
  show(svg: string | null): void;
  list(contours: ContourRow[]): void;
  light(line: number | null): void;
}

export function drawingPanel(go: (line: number) => void, open: (line: number) => void): DrawingPanel {
  let isLit: number | null = null;
  let listed: ContourRow[] | null = null;
  const paper = make("div", { class: "canvas", tabindex: 0, role: "group", "aria-label": "Drawing of the program" });
  const scroller = make("div", { class: "all contoursolve", tabindex: 0, role: "group", "aria-label": "Drawing of all contours; arrow keys move it" }, paper);
  const zoom = zoomBar((times) => (paper.style.width = `${100 * times}%`), scroller, "the drawing");
  const rows = make("ul", { class: "contours", "aria-label": "Contours" });
  const said = make("p", { class: "muted" });
  const node = make("div", { class: "drawing" }, zoom, scroller, said, rows);

  const lineOf = (event: MouseEvent) => {
    const parts = [...paper.querySelectorAll<SVGGraphicsElement>("[data-line]")];
    // The drawing of a single contour names no line.
    if (!parts.length) return listed?.length === 1 ? listed[0]!.line : 0;
    const near = parts.map((part) => [distance(part, event.clientX, event.clientY), Number(part.getAttribute("data-line"))] as const);
    const [gap, line] = near.reduce((best, each) => (each[0] < best[0] ? each : best));
    return gap <= NEAR ? line : 0;
  };
  paper.addEventListener("click", (event) => {
    const line = lineOf(event);
    if (line) go(line);
  });
  paper.addEventListener("dblclick", (event) => {
    const line = lineOf(event);
    if (line) open(line);
  });

  function relight(): void {
    for (const each of paper.querySelectorAll("[data-line]")) each.classList.toggle("lit", Number(each.getAttribute("data-line")) === isLit);
    for (const each of rows.querySelectorAll<HTMLElement>("button")) each.setAttribute("aria-pressed", String(Number(each.dataset["at"]) === isLit));
  }

  return {
    node,
    show(svg) {
      const drawn = svg ? picture(svg) : null;
      paper.replaceChildren(...(drawn ? [drawn] : []));
      relight();
    },
    list(contours) {
      if (contours === listed) return;
      listed = contours;
      const shown = contours.slice(0, MOST);
      const left = contours.length - shown.length;
      said.textContent = contours.length
        ? `${contours.length} ${contours.length === 1 ? "contour" : "contours"}${left ? `; the first ${MOST} are listed, the text has a mark at each` : ""}. Touch one to see its text.`
        : "There is no contour to solve in this program yet.";
      rows.replaceChildren(
        ...shown.map((each) =>
          make("li", {}, make("button", { type: "button", class: kindOf(each.status), "data-at": each.line, onclick: () => go(each.line) }, make("span", { class: "line", text: `line ${each.line}` }), ` ${each.title}: ${each.told}`)),
        ),
      );
      relight();
    },
    light(line) {
      if (line === isLit) return;
      isLit = line;
      relight();
    },
  };
}
