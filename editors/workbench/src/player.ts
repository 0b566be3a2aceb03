// What is drawn over the drawing of a program: the tool that goes along its path, distances, and the ways of a contour
// with several. It has the coordinates of the plane, mm.
import { button, make, newId } from "./dom";
import type { Drawn, Move, Spot, Way } from "./protocol";

const SVG = "http://www.w3.org/2000/svg";
const NEAR = 16; // px from a point that a finger means
const LASTS = 12; // s for the whole path
const SHARES = [0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1]; // of a line or arc, at which it is compared
const STILL = 700; // ms for a block, for who wants no motion
const MM_PER_INCH = 25.4;

type Piece = Pick<Move, "start" | "end" | "center" | "sweep">;
type Gone = { move: Move; from: number; to: number }; // lengths along the path

const radius = ({ start, center }: Piece): number => (center ? Math.hypot(start[0] - center[0], start[1] - center[1]) : 0);
const lengthOf = (piece: Piece): number => (piece.center ? radius(piece) * Math.abs(piece.sweep ?? 0) : Math.hypot(piece.end[0] - piece.start[0], piece.end[1] - piece.start[1]));

// The place at a share of a line or arc.
function along({ start, end, center, sweep = 0 }: Piece, share: number): Spot {
  if (!center) return [start[0] + (end[0] - start[0]) * share, start[1] + (end[1] - start[1]) * share];
  const [x, y] = [start[0] - center[0], start[1] - center[1]];
  const [cos, sin] = [Math.cos(sweep * share), Math.sin(sweep * share)];
  return [center[0] + x * cos - y * sin, center[1] + x * sin + y * cos];
}

function draw(kind: string, properties: Record<string, string | number>, text = ""): SVGElement {
  const element = document.createElementNS(SVG, kind);
  for (const [name, value] of Object.entries(properties)) element.setAttribute(name, String(value));
  element.textContent = text;
  return element;
}

const icon = (path: string): SVGElement => {
  const node = draw("svg", { viewBox: "0 0 16 16", width: 16, height: 16, "aria-hidden": "true" });
  node.append(draw("path", { d: path, fill: "currentColor" }));
  return node;
};
const ICONS = { before: "M3 3h2v10H3zM13 3v10L6 8z", play: "M4 2.5v11l9-5.5z", pause: "M4 3h3v10H4zM9 3h3v10H9z", after: "M11 3h2v10h-2zM3 3v10l7-5z" };

export const LEGEND = 46; // px under the drawing: the axes and one row of the legend
const MARGIN = 14; // px around a way

// What is shown of a page: the drawing and its legend, without what stands over and under it.
export function viewOf({ frame, ways }: Drawn): string {
  const { width, height, box, origin, scale } = frame!;
  if (!box) return `0 0 ${width} ${height}`;
  // Ways that the drawing did not know may lead out of it.
  const seen = ways.flatMap(({ pieces }) => pieces.flatMap((each) => SHARES.map((share) => origin[1] - along(each, share)[1] * scale)));
  const [top, bottom] = [Math.min(box[1], ...seen.map((y) => y - MARGIN)), Math.max(box[3] + LEGEND, ...seen.map((y) => y + MARGIN))];
  return `0 ${top} ${width} ${bottom - top}`;
}

export function playerOver(paper: HTMLElement, told: (line: number | null) => void) {
  let drawn: Drawn | null = null;
  let path: Gone[] = [];
  let way = 0; // length of the path
  let at = 0; // how far the tool is along it
  let isPlaying = false;
  let frame = 0;
  let picks: Spot[] = [];
  let hover: Spot | null = null;
  let lit: { line: number; letter: string } | null = null;

  const over = draw("svg", { class: "over", "aria-hidden": "true" });
  const groups = ["ways", "rule", "tool"].map((name) => over.appendChild(draw("g", { class: name })));
  const [ways, rule, tool] = groups as [SVGElement, SVGElement, SVGElement];

  const position = make("input", { type: "range", min: 0, max: 1000, step: "any", value: 0, "aria-label": "Place on the path", oninput: () => goTo((position.valueAsNumber / 1000) * way) });
  const where = make("output", { for: (position.id = newId()), "aria-live": "off" });
  const go = (name: string, path: string, act: () => void) => {
    const made = button("", act, { class: "go-by", "aria-label": name, title: name });
    made.append(icon(path));
    return made;
  };
  const play = go("Play", ICONS.play, () => run(!isPlaying));
  const player = make("div", { class: "player", role: "group", "aria-label": "Play the path", hidden: true }, go("Block before", ICONS.before, () => step(-1)), play, go("Block after", ICONS.after, () => step(1)), position, where);
  player.addEventListener("keydown", (event) => {
    const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key] as 1 | -1 | undefined;
    if (way) step(way);
    else if (event.key === " " && event.target === position) run(!isPlaying);
    else if (event.key === "Enter" && event.target === position && isMeasuring() && path.length) pick(place());
    else return;
    event.preventDefault();
  });

  const measured = make("dl", {});
  const asked = make("p", { class: "muted", text: "Touch two points. Enter takes the place of the tool." });
  const readout = make("div", { class: "readout", role: "status", hidden: true }, make("h3", { text: "Measured" }), asked, measured);
  const measure = button("Measure", () => setMeasuring(!isMeasuring()), { class: "icon", "aria-pressed": "false", title: "Measure between two points" });
  const isMeasuring = (): boolean => measure.getAttribute("aria-pressed") === "true";

  // Places --------------------------------------------------------------------------------------------------------

  const onPage = ([x, y]: Spot): Spot => {
    const { origin, scale } = drawn!.frame!;
    return [origin[0] + x * scale, origin[1] - y * scale];
  };

  function written([x, y]: Spot, isStep = false): string[] {
    const { axes, isDiameter, unit } = drawn!;
    return [x, y].map((value, axis) => {
      const own = (value * (isDiameter[axis] ? 2 : 1)) / (unit === "inch" ? MM_PER_INCH : 1);
      const text = own.toFixed(unit === "inch" ? 4 : 3).replace(/^-(0\.0+)$/, "$1");
      return isStep ? text : `${axes[axis]}${text}`;
    });
  }

  function outline(piece: Piece): string {
    const [[x, y], end] = [onPage(piece.start), onPage(piece.end)];
    if (!piece.center) return `M${x},${y}L${end}`;
    const r = radius(piece) * drawn!.frame!.scale;
    const sweep = piece.sweep ?? 0;
    if (Math.abs(sweep) < 2 * Math.PI - 1e-9) return `M${x},${y}A${r},${r} 0 ${Math.abs(sweep) > Math.PI ? 1 : 0} ${sweep > 0 ? 0 : 1} ${end}`;
    return `${outline({ ...piece, end: along(piece, 0.5), sweep: sweep / 2 })}${outline({ ...piece, start: along(piece, 0.5), sweep: sweep / 2 })}`;
  }

  // Playing ---------------------------------------------------------------------------------------------------------

  const gone = (): Gone | undefined => path.find((each) => at <= each.to + 1e-9) ?? path.at(-1);
  const place = (): Spot => {
    const { move, from, to } = gone()!;
    return along(move, to > from ? (at - from) / (to - from) : 1);
  };

  function goTo(wanted: number): void {
    at = Math.max(0, Math.min(way, wanted));
    showTool();
    told(path.length ? gone()!.move.line : null);
  }

  function step(by: 1 | -1): void {
    run(false);
    const stops = [0, ...path.map((each) => each.to)];
    const next = by > 0 ? stops.find((each) => each > at + 1e-6) : stops.filter((each) => each < at - 1e-6).at(-1);
    if (next !== undefined) goTo(next);
  }

  function run(wanted: boolean): void {
    isPlaying = wanted && path.length > 0;
    play.replaceChildren(icon(isPlaying ? ICONS.pause : ICONS.play));
    play.setAttribute("aria-label", (play.title = isPlaying ? "Pause" : "Play"));
    cancelAnimationFrame(frame);
    clearTimeout(frame);
    if (!isPlaying) return;
    if (at >= way - 1e-9) at = 0;
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) {
      const next = () => {
        const stop = path.find((each) => each.to > at + 1e-6);
        if (!stop) return run(false);
        goTo(stop.to);
        frame = setTimeout(next, STILL);
      };
      return next();
    }
    let before = performance.now();
    const next = (now: number) => {
      goTo(at + (way * (now - before)) / 1000 / LASTS);
      before = now;
      if (at >= way) run(false);
      else frame = requestAnimationFrame(next);
    };
    frame = requestAnimationFrame(next);
  }

  function showTool(): void {
    if (!path.length) return void tool.replaceChildren();
    const [x, y] = onPage(place());
    const isRapid = gone()!.move.kind === "rapid";
    tool.replaceChildren(draw("circle", { class: "ring", cx: x, cy: y, r: 9 }), draw("circle", { class: "tip", cx: x, cy: y, r: 3 }));
    if (document.activeElement !== position || isPlaying) position.value = String(way ? (1000 * at) / way : 0);
    const words = written(place()).join(" ");
    const line = `line ${gone()!.move.line}`;
    where.replaceChildren(make("span", { text: `${line}${isRapid ? ", rapid" : ""}  ` }), words);
    position.setAttribute("aria-valuetext", `${line}, ${words}`);
  }

  // Measuring -------------------------------------------------------------------------------------------------------

  function setMeasuring(wanted: boolean): void {
    measure.setAttribute("aria-pressed", String(wanted));
    paper.classList.toggle("measuring", wanted);
    readout.hidden = !wanted;
    [picks, hover] = [[], null];
    showRule();
  }

  // The point that is meant, or the place itself, on the plane.
  function pointed(event: MouseEvent): Spot | null {
    const matrix = (over as SVGSVGElement).getScreenCTM();
    if (!drawn?.frame || !matrix) return null;
    const { origin, scale } = drawn.frame;
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    const here: Spot = [(x - origin[0]) / scale, (origin[1] - y) / scale];
    const all = [...drawn.moves, ...drawn.ways.flatMap((each) => each.pieces)].flatMap(({ start, end, center }) => [start, end, ...(center ? [center] : [])]);
    const gap = ([u, v]: Spot) => Math.hypot(u - here[0], v - here[1]) * scale * matrix.a;
    const near = [...all, [0, 0] as Spot].reduce((best, each) => (gap(each) < gap(best) ? each : best));
    return gap(near) <= NEAR ? near : here;
  }

  function pick(spot: Spot): void {
    picks = picks.length === 2 ? [spot] : [...picks, spot];
    showRule();
  }

  function showRule(): void {
    const [one, other] = [picks[0], picks[1] ?? hover ?? undefined];
    const dots = [...picks, ...(hover && picks.length < 2 ? [hover] : [])].map((each) => {
      const [x, y] = onPage(each);
      return draw("circle", { class: "pick", cx: x, cy: y, r: 5 });
    });
    const line = one && other ? [draw("path", { d: outline({ start: one, end: other }) })] : [];
    rule.replaceChildren(...line, ...dots);
    asked.hidden = Boolean(one && other);
    const rows: [string, string][] = [];
    if (one && other && drawn) {
      const by: Spot = [other[0] - one[0], other[1] - one[1]];
      const unit = drawn.unit || "mm";
      const length = Math.hypot(...by) / (unit === "inch" ? MM_PER_INCH : 1);
      rows.push(["Distance", `${length.toFixed(unit === "inch" ? 4 : 3)} ${unit}`]);
      written(by, true).forEach((text, axis) => rows.push([`${drawn!.axes[axis]}${drawn!.isDiameter[axis] ? " ⌀" : ""}`, `${text} ${unit}`]));
      rows.push(["Angle", `${((Math.atan2(by[1], by[0]) * 180) / Math.PI).toFixed(3)}°`]);
    } else if (one && drawn) rows.push(["From", written(one).join(" ")]);
    measured.replaceChildren(...rows.flatMap(([name, text]) => [make("dt", { text: name }), make("dd", { text })]));
  }

  paper.addEventListener("pointermove", (event) => {
    if (!isMeasuring()) return;
    hover = pointed(event);
    showRule();
  });
  paper.addEventListener("click", (event) => {
    const spot = isMeasuring() ? pointed(event) : null;
    if (spot) pick(spot);
  });
  addEventListener("keydown", (event) => event.key === "Escape" && isMeasuring() && setMeasuring(false));

  // Ways ------------------------------------------------------------------------------------------------------------

  function showWays(): void {
    const shown = (drawn?.ways ?? []).filter((each) => each.pieces.length);
    const samples = shown.map(({ pieces }) => pieces.flatMap((each) => SHARES.map((share) => along(each, share))));
    const state = ({ line, letter }: Way) => (!lit ? "" : lit.line === line && lit.letter === letter ? " lit" : " pale");
    const lines = shown.map((each) => {
      const own = draw("g", { class: `way-line way-${each.letter}${state(each)}` });
      own.append(...each.pieces.map((piece) => draw("path", { d: outline(piece) })));
      return own;
    });
    // A letter stands where its way is farthest from the others.
    const marks = shown.map((each, place) => {
      const others = samples.filter((_, other) => other !== place).flat();
      const gap = ([u, v]: Spot) => Math.min(...others.map(([x, y]) => Math.hypot(x - u, y - v)));
      const [x, y] = onPage(samples[place]!.reduce((best, at) => (gap(at) > gap(best) ? at : best)));
      const own = draw("g", { class: `way way-${each.letter}${state(each)}`, "data-letter": each.letter });
      own.append(each.letter === "A" ? draw("circle", { class: "mark", cx: x, cy: y, r: 10 }) : draw("rect", { class: "mark", x: x - 9, y: y - 9, width: 18, height: 18 }), draw("text", { x, y: y + 4.5 }, each.letter));
      return own;
    });
    ways.replaceChildren(...lines, ...marks);
  }

  return {
    player,
    measure,
    readout,
    isMeasuring,
    lightWay(wanted: typeof lit): void {
      lit = wanted;
      if (drawn?.frame) showWays();
    },
    show(now: Drawn | null): void {
      drawn = now;
      run(false);
      let length = 0;
      path = now?.frame ? now.moves.map((move) => ({ move, from: length, to: (length += lengthOf(move)) })) : [];
      way = length;
      at = Math.min(at, way);
      player.hidden = !path.length;
      measure.hidden = !now?.frame;
      if (!now?.frame) return setMeasuring(false);
      over.setAttribute("viewBox", viewOf(now));
      paper.append(over);
      [picks, hover] = [[], null];
      showWays();
      showRule();
      showTool();
    },
  };
}
