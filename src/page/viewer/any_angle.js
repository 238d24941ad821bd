// An any-angle search: each step closes one node and joins it with its parent, which may be far, by a straight line.
import { dot, lanes, line } from "./canvas.js";

const BLOCKED = "#3c3c3c";
const TREE = "#4ba3d9";

export function anyAngle(stage, replay) {
  const [width, height] = replay.size;
  const drawn = lanes(stage, replay.lanes.map((lane) => `${lane.label}: ${lane.ending}`), [0, width, 0, height]);
  const steps = Math.max(...replay.lanes.map((lane) => lane.closed.length)) + 1;
  key(stage);
  const draw = (step) => {
    const counts = replay.lanes.map((lane, index) => drawLane(drawn[index], replay, lane, step));
    return `step ${step} of ${steps}: ${counts.join("; ")}`;
  };
  return { steps, perSecond: Math.max(10, steps / 12), draw };
}

function drawLane({ pen, unit, window }, replay, lane, step) {
  pen.fillStyle = "#ffffff";
  pen.fillRect(...window);
  pen.fillStyle = BLOCKED;
  for (const [x, y] of replay.blocked) pen.fillRect(x - 0.5, y - 0.5, 1, 1);
  const closed = lane.closed.slice(0, step);
  for (const [x, y, px, py] of closed) line(pen, [[px, py], [x, y]], TREE, 1.5 * unit);
  for (const [x, y] of closed) dot(pen, [x, y], 2.5 * unit, TREE);
  const isEnd = step > lane.closed.length;
  const last = closed.at(-1);
  if (last && !isEnd) {
    const [x, y, px, py] = last;
    line(pen, [[px, py], [x, y]], "#111111", 3 * unit);
    dot(pen, [x, y], 5 * unit, "#111111");
  }
  if (isEnd) {
    line(pen, lane.raw, "#0b2d4d", 3 * unit, [8 * unit, 6 * unit]);
    line(pen, lane.path, "#d0103a", 5 * unit);
  }
  for (const end of [lane.path[0], lane.path.at(-1)]) if (end) dot(pen, end, 0.35, "#009e73");
  return `${lane.label} ${closed.length} closed`;
}

function key(stage) {
  const list = stage.appendChild(document.createElement("p"));
  list.className = "key";
  for (const [name, colour] of [["closed, joined with its parent", TREE], ["blocked", BLOCKED]]) {
    const entry = list.appendChild(document.createElement("span"));
    entry.style.setProperty("--colour", colour);
    entry.textContent = name;
  }
  list.append("Black: closed just now. At the end: the path as searched (dashed) and as returned.");
}
