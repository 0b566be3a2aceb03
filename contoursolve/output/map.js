// A map of two words that answers to the pointer and to arrow keys. Without a kernel it shows the frames that came with
// it; a kernel solves any other value. Texts are set as text, never as HTML; the picture comes from contoursolve's own painter.

function showMap(root, data, kernel) {
  const SVG = "http://www.w3.org/2000/svg";
  const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1], PageUp: [0, 5], PageDown: [0, -5] };
  const [left, top, wide, high] = data.box;
  const paper = root.querySelector(".paper");

  function draw(kind, properties = {}) {
    const element = document.createElementNS(SVG, kind);
    for (const [name, value] of Object.entries(properties)) element.setAttribute(name, value);
    return element;
  }

  function make(kind, properties = {}, text = "") {
    const element = document.createElement(kind);
    for (const [name, value] of Object.entries(properties)) element.setAttribute(name, value);
    element.textContent = text;
    return element;
  }

  const names = data.words.map((word) => word.name).join(" and ");
  const told = make("p", { class: "told", role: "status", "aria-live": "polite" });
  const stage = make("div", { class: "stage", tabindex: "0", role: "application", "aria-roledescription": "map", "aria-label": `Map of ${names}. Arrow keys move over the values${kernel ? ", Enter opens the explorer" : ""}.` });
  const over = draw("svg", { class: "over", viewBox: `0 0 ${data.size[0]} ${data.size[1]}`, "aria-hidden": "true" });
  const cross = [draw("path", { class: "halo" }), draw("path", { class: "cross" })];
  const dot = draw("circle", { class: "dot", r: 5 });
  over.append(...cross, dot);
  paper.replaceWith(stage);
  stage.append(paper, over);

  const small = draw("svg", { class: "small", role: "img" });
  const label = draw("title");
  const ghost = draw("path", { class: "ghost", d: data.ghost || "M0 0" });
  const path = draw("path", { class: "path" });
  const begin = draw("circle", { class: "begin" });
  small.append(label, ghost, path, begin);
  const side = make("div", { class: "side" });
  const nothing = make("p", { class: "nothing" }, "no contour here");
  const axes = data.axis_names.map((name, number) => (data.diameters[number] ? `${name} (a diameter)` : name));
  const about = `${axes[0]} to the right, ${axes[1]} up${data.ghost ? "; dashed: the block as it stands" : ""}`;
  const frame = make("div", { class: "drawing" });
  frame.append(small, nothing);
  side.append(told, frame, make("p", { class: "hint" }, about));
  if (kernel) {
    const open = make("button", { type: "button", class: "open" }, "Open in the explorer");
    open.addEventListener("click", () => kernel.open(valuesAt(here)));
    side.append(open, make("p", { class: "hint" }, "Click into the map: the contour there opens below."));
  } else side.append(make("p", { class: "hint" }, data.note));
  const desk = make("div", { class: "desk" });
  root.querySelector("figure").replaceWith(desk);
  desk.append(stage, side);

  // Where the reader is: a column and a row, of all values with a kernel, else of the frames.
  const grid = kernel ? data.axes.map((values) => values.map((_, number) => number)) : [data.columns, data.rows];
  const shareOf = (axis, number) => data.shares[axis][number];
  const nearest = (list, distance) => {
    let best = 0;
    for (let each = 1; each < list.length; each += 1) if (distance(list[each]) < distance(list[best])) best = each;
    return best;
  };
  const valuesAt = (place) => place.map((each, axis) => data.axes[axis][grid[axis][each]]);
  let here = [0, 1].map((axis) => nearest(grid[axis], (number) => Math.abs(data.axes[axis][number] - data.stated[axis])));

  function wordsOf(values) {
    return data.words.map((word, axis) => `${word.name} ${Number(values[axis].toPrecision(7))}${word.unit ? ` ${word.unit}` : ""}`).join(", ");
  }

  function show(values, text, line) {
    told.textContent = `${wordsOf(values)}:\n${text.replaceAll("; ", "\n")}`;
    label.textContent = told.textContent;
    frame.classList.toggle("empty", !line);
    path.setAttribute("d", line || "M0 0");
    // A contour that is larger than most makes all of it smaller.
    let [x, y, width, height] = data.view;
    if (line) {
      const box = path.getBBox();
      const margin = 0.04 * Math.max(width, height);
      const right = Math.max(x + width, box.x + box.width + margin);
      const bottom = Math.max(y + height, box.y + box.height + margin);
      [x, y] = [Math.min(x, box.x - margin), Math.min(y, box.y - margin)];
      [width, height] = [right - x, bottom - y];
      const [first, second] = line.match(/-?[\d.]+/g);
      begin.setAttribute("cx", first);
      begin.setAttribute("cy", second);
    }
    begin.setAttribute("r", Math.max(width, height) / 90);
    small.setAttribute("viewBox", `${x} ${y} ${width} ${height}`);
  }

  function frameAt(place) {
    const held = [data.columns, data.rows].map((list, axis) =>
      nearest(list, (number) => Math.abs(shareOf(axis, number) - shareOf(axis, grid[axis][place[axis]]))),
    );
    const found = data.frames[held[0] * data.rows.length + held[1]];
    const values = [data.axes[0][data.columns[held[0]]], data.axes[1][data.rows[held[1]]]];
    return typeof found === "number" ? [values, data.texts[found], ""] : [values, found[0], found[1]];
  }

  function move(place) {
    here = place.map((each, axis) => Math.min(Math.max(each, 0), grid[axis].length - 1));
    const x = left + wide * shareOf(0, grid[0][here[0]]);
    const y = top + high * (1 - shareOf(1, grid[1][here[1]]));
    for (const line of cross) line.setAttribute("d", `M${x} ${top}V${top + high}M${left} ${y}H${left + wide}`);
    dot.setAttribute("cx", x);
    dot.setAttribute("cy", y);
    show(...frameAt(here));
    if (kernel) kernel.look(valuesAt(here));
  }

  function placeOf(event) {
    const box = paper.getBoundingClientRect();
    const scale = data.size[0] / box.width;
    const spot = [((event.clientX - box.left) * scale - left) / wide, 1 - ((event.clientY - box.top) * scale - top) / high];
    if (spot.some((share) => share < -0.02 || share > 1.02)) return null;
    return spot.map((share, axis) => nearest(grid[axis], (number) => Math.abs(shareOf(axis, number) - share)));
  }

  function pointed(event) {
    const place = placeOf(event);
    if (place && (place[0] !== here[0] || place[1] !== here[1])) move(place);
  }

  stage.addEventListener("pointermove", pointed);
  stage.addEventListener("pointerdown", pointed);
  stage.addEventListener("click", (event) => {
    if (kernel && placeOf(event)) kernel.open(valuesAt(here));
  });
  stage.addEventListener("keydown", (event) => {
    const step = STEPS[event.key];
    if (!step && !(kernel && event.key === "Enter")) return;
    event.preventDefault();
    event.stopPropagation();
    if (!step) return kernel.open(valuesAt(here));
    // With a kernel there are as many values as pixels; Shift takes each of them.
    const by = kernel && !event.shiftKey ? [data.columns, data.rows].map((list, axis) => Math.max(1, Math.round(grid[axis].length / list.length))) : [1, 1];
    return move([here[0] + step[0] * by[0], here[1] + step[1] * by[1]]);
  });
  move(here);
  // What a kernel tells of a place counts as long as the reader is there.
  return (values, text, line) => {
    if (valuesAt(here).every((value, axis) => value === values[axis])) show(values, text, line);
  };
}
