// A search on a grid: each step opens one more node of either side. When a node was closed is not kept; what was closed is
// shown at the end.
import { dot, lanes, line } from "./canvas.js";

const COLOURS = { start: "#b6dcf4", goal: "#f0b95a", closed: "#56b4e9", both: "#9d7bb8", blocked: "#3c3c3c", paper: "#ffffff" };

export function grid(stage, replay) {
  const [width, height] = replay.size;
  const drawn = lanes(stage, replay.lanes.map((lane) => `${lane.label}: ${lane.said}`), part(replay, width, height));
  const count = (lane) => Math.max(...lane.opened.map((side) => side.length));
  const steps = Math.max(...replay.lanes.map(count)) + 1;
  key(stage);
  const draw = (step) => {
    const said = replay.lanes.map((lane, index) => drawLane(drawn[index], replay, lane, Math.min(step, count(lane) + 1)));
    return `step ${step} of ${steps}: ${said.join("; ")}`;
  };
  return { steps, perSecond: Math.max(10, steps / 12), draw };
}

function drawLane({ pen, unit, window }, replay, lane, step) {
  pen.fillStyle = COLOURS.paper;
  pen.fillRect(...window);
  const cell = ([x, y], colour) => {
    pen.fillStyle = colour;
    pen.fillRect(x, y, 1, 1);
  };
  replay.blocked.forEach((at) => cell(at, COLOURS.blocked));
  const sides = lane.opened.map((side) => side.slice(0, step));
  const other = new Set(sides[1].map(String));
  sides[1].forEach((at) => cell(at, COLOURS.goal));
  sides[0].forEach((at) => cell(at, other.has(String(at)) ? COLOURS.both : COLOURS.start));
  const isEnd = step > Math.max(...lane.opened.map((side) => side.length));
  if (isEnd) lane.closed.forEach((at) => cell(at, COLOURS.closed));
  pen.strokeStyle = "#00000022";
  pen.lineWidth = unit;
  if (replay.size[0] <= 100) for (let x = 0; x <= replay.size[0]; x += 1) line(pen, [[x, 0], [x, replay.size[1]]], "#00000022", unit);
  if (replay.size[1] <= 100) for (let y = 0; y <= replay.size[1]; y += 1) line(pen, [[0, y], [replay.size[0], y]], "#00000022", unit);
  const nodes = sides[0].length + sides[1].length;
  if (isEnd) {
    line(pen, lane.raw, "#0072b2", 3 * unit, [8 * unit, 6 * unit]);
    line(pen, lane.path, "#d55e00", 5 * unit);
  }
  for (const end of [lane.path[0], lane.path.at(-1)]) if (end) dot(pen, end, 0.35, "#009e73");
  return `${lane.label} ${nodes} opened`;
}

// The part of the map that the trials looked at, with some room around it.
function part(replay, width, height) {
  const cells = replay.lanes.flatMap((lane) => [...lane.opened.flat(), ...lane.path]);
  const ends = (axis, size) => {
    const all = cells.map((cell) => cell[axis]);
    return cells.length ? [Math.max(0, Math.floor(Math.min(...all)) - 2), Math.min(size, Math.ceil(Math.max(...all)) + 3)] : [0, size];
  };
  return [...ends(0, width), ...ends(1, height)];
}

function key(stage) {
  const names = { start: "opened from the start", closed: "closed", goal: "opened from the goal", both: "opened from both", blocked: "blocked" };
  const list = stage.appendChild(document.createElement("p"));
  list.className = "key";
  for (const [kind, name] of Object.entries(names)) {
    const entry = list.appendChild(document.createElement("span"));
    entry.style.setProperty("--colour", COLOURS[kind]);
    entry.textContent = name;
  }
}
