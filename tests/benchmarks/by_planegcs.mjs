// The contour of one G111 block with planegcs, the solver of FreeCAD, as npm has it: from the text of the block to points
// that are checked, and to text. Prints microseconds, the median of many, and the end point.
//
//     npm install @salusoft89/planegcs && node by_planegcs.mjs "G00 X40. Z0." "G111 X100. A180. K-30. B120. P5. Q5."
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const found = createRequire(`${process.cwd()}/`).resolve("@salusoft89/planegcs");
const { GcsWrapper, init_planegcs_module } = await import(pathToFileURL(found));
const system = new GcsWrapper(new (await init_planegcs_module()).GcsSystem());
const [START, BLOCK] = process.argv.slice(2);
const words = (text) => Object.fromEntries([...text.matchAll(/([A-Z])([-+]?[\d.]+)/g)].map((each) => [each[1], +each[2]]));
const ENDS = { l1: ["S", "V1"], l2: ["V1", "V2"], l3: ["V2", "W"] };
const radians = (degrees) => (degrees * Math.PI) / 180;

// Axes are Z and X; what is asked for begins 1 mm beside the solution.
function primitives(start, block) {
  const [z, x] = [start.Z, start.X / 2];
  const v1 = [z + block.K, x];
  const v2 = [v1[0] + (block.X / 2 - x) / Math.tan(radians(block.B)), block.X / 2];
  const point = (id, at, fixed = false) => ({ id, type: "point", x: at[0] + (fixed ? 0 : 1), y: at[1] + (fixed ? 0 : 1), fixed });
  const list = [point("S", [z, x], true), point("V1", v1), point("V2", v2), point("W", [v2[0] - 50, v2[1]])];
  list.push({ id: "l1", type: "line", p1_id: "S", p2_id: "V1" }, { id: "l2", type: "line", p1_id: "V1", p2_id: "V2" });
  list.push({ id: "l3", type: "line", p1_id: "V2", p2_id: "W" });
  list.push({ id: "a", type: "p2p_angle", p1_id: "S", p2_id: "V1", angle: radians(block.A) });
  list.push({ id: "b", type: "p2p_angle", p1_id: "V1", p2_id: "V2", angle: radians(block.B) });
  list.push({ id: "k", type: "coordinate_x", p_id: "V1", x: z + block.K }, { id: "x", type: "coordinate_y", p_id: "V2", y: block.X / 2 });
  list.push({ id: "w", type: "coordinate_x", p_id: "W", x: -150 }, { id: "h", type: "horizontal_pp", p1_id: "V2", p2_id: "W" });
  const corners = [["1", v1, block.P, 1, "l1", "l2", 180, block.B], ["2", v2, block.Q, -1, "l2", "l3", block.B, 180]];
  for (const [name, at, radius, side, before, after, heading, next] of corners) {
    const half = radians((next - heading) / 2);
    const room = Math.abs(radius * Math.tan(half));
    const begin = [at[0] - room * Math.cos(radians(heading)), at[1] - room * Math.sin(radians(heading))];
    const end = [at[0] + room * Math.cos(radians(next)), at[1] + room * Math.sin(radians(next))];
    const turn = Math.sign(half);
    const center = [begin[0] - turn * radius * Math.sin(radians(heading)), begin[1] + turn * radius * Math.cos(radians(heading))];
    const [from, to] = turn > 0 ? [begin, end] : [end, begin];
    const ids = turn > 0 ? [`T${name}`, `U${name}`] : [`U${name}`, `T${name}`];
    list.push(point(`C${name}`, center), point(`T${name}`, begin), point(`U${name}`, end));
    const angle = (place) => Math.atan2(place[1] - center[1], place[0] - center[0]);
    list.push({ id: `a${name}`, type: "arc", c_id: `C${name}`, radius, start_angle: angle(from), end_angle: angle(to), start_id: ids[0], end_id: ids[1] });
    list.push({ id: `r${name}`, type: "arc_rules", a_id: `a${name}` }, { id: `s${name}`, type: "arc_radius", a_id: `a${name}`, radius });
    list.push({ id: `p${name}`, type: "point_on_line_pl", p_id: `T${name}`, l_id: before }, { id: `q${name}`, type: "point_on_line_pl", p_id: `U${name}`, l_id: after });
    // Radii stand upright on their lines: that a circle touches a line in a point of both is a double root, which takes longer.
    for (const [id, at, ends] of [[`t${name}`, `T${name}`, ENDS[before]], [`u${name}`, `U${name}`, ENDS[after]]])
      list.push({ id, type: "perpendicular_pppp", l1p1_id: `C${name}`, l1p2_id: at, l2p1_id: ends[0], l2p2_id: ends[1] });
  }
  return list;
}

function solve() {
  const [start, block] = [words(START), words(BLOCK.replace("G111", ""))];
  system.clear_data();
  system.push_primitives_and_params(primitives(start, block));
  const status = system.solve();
  system.apply_solution();
  const at = Object.fromEntries(["V1", "V2", "T1", "U1", "C1", "T2", "U2", "C2"].map((id) => [id, system.sketch_index.get_primitive(id)]));
  const gap = Math.max(
    Math.abs(at.V1.x - start.Z - block.K),
    Math.abs(at.V2.y - block.X / 2),
    Math.abs((at.V2.x - at.V1.x) * Math.sin(radians(block.B)) - (at.V2.y - at.V1.y) * Math.cos(radians(block.B))),
    ...[["1", block.P], ["2", block.Q]].flatMap(([name, radius]) =>
      ["T", "U"].map((end) => Math.abs(Math.hypot(at[end + name].x - at[`C${name}`].x, at[end + name].y - at[`C${name}`].y) - radius)),
    ),
  );
  if (status !== 0 || gap > 1e-6) throw new Error(`planegcs: status ${status}, ${gap} mm`);
  return Object.entries(at).map(([id, each]) => `${id} Z${each.x.toFixed(4)} X${(2 * each.y).toFixed(4)}`).join("\n");
}

let text = "";
for (let round = 0; round < 500; round++) text = solve();
const times = [];
for (let round = 0; round < 2000; round++) {
  const begin = process.hrtime.bigint();
  text = solve();
  times.push(Number(process.hrtime.bigint() - begin) / 1e3);
}
times.sort((one, other) => one - other);
console.log(JSON.stringify({ us: times[times.length / 2], best: times[0], end: /U2 .*/.exec(text)[0] }));
process.exit(0);
