// A search on a grid: each step closes one node and opens what is opened from it. Where the closings were not kept, each step
// opens one node of either side.
import { dot, lanes, line } from "./canvas.js";

const BLOCKED = "#3c3c3c";
// Of the start's side and of the goal's.
const OPENED = ["#c4e3f5", "#fbe0b0"];
const CLOSED = ["#4ba3d9", "#e0930a"];

export function grid(stage, replay) {
  const [width, height] = replay.size;
  const drawn = lanes(stage, replay.lanes.map((lane) => `${lane.label}: ${lane.ending}`), part(replay, width, height));
  const steps = Math.max(...replay.lanes.map(count)) + 1;
  key(stage, replay.lanes.some((lane) => lane.opened[1].length > 0));
  const draw = (step) => {
    const texts = replay.lanes.map((lane, index) => drawLane(drawn[index], replay, lane, Math.min(step, count(lane) + 1)));
    return `step ${step} of ${steps}: ${texts.join("; ")}`;
  };
  return { steps, perSecond: Math.max(10, steps / 12), draw };
}

function count(lane) {
  return lane.closings.length || Math.max(...lane.opened.map((side) => side.length));
}

// What each side has opened and closed after `step` steps.
function sides(lane, step) {
  const closed = lane.closings.slice(0, step);
  const next = lane.closings[step];
  return [0, 1].map((side) => ({
    opened: lane.opened[side].slice(0, next ? next[3 + side] : lane.closings.length ? undefined : step),
    closed: closed.filter((closing) => closing[2] === side),
  }));
}

function drawLane({ pen, unit, window }, replay, lane, step) {
  pen.fillStyle = "#ffffff";
  pen.fillRect(...window);
  pen.fillStyle = BLOCKED;
  for (const [x, y] of replay.blocked) pen.fillRect(x, y, 1, 1);
  const now = sides(lane, step);
  const both = new Set(now[1].opened.map(String));
  now.forEach(({ opened, closed }, side) => {
    for (const at of opened) fill(pen, at, OPENED[side], side === 0 && both.has(String(at)));
    const other = side === 0 ? both : new Set();
    for (const at of closed) fill(pen, at, CLOSED[side], other.has(String(at.slice(0, 2))));
  });
  ruled(pen, unit, replay.size);
  const isEnd = step > count(lane);
  const last = lane.closings[step - 1];
  if (last && !isEnd) {
    pen.strokeStyle = "#111111";
    pen.lineWidth = 3 * unit;
    pen.strokeRect(last[0], last[1], 1, 1);
  }
  if (isEnd) {
    line(pen, lane.raw, "#0b2d4d", 3 * unit, [8 * unit, 6 * unit]);
    line(pen, lane.path, "#d0103a", 5 * unit);
  }
  for (const end of [lane.path[0], lane.path.at(-1)]) if (end) dot(pen, end, 0.35, "#009e73");
  return `${lane.label} ${counts(now)}`;
}

// A cell; where the other side was as well, only the half below its diagonal.
function fill(pen, [x, y], colour, isHalf) {
  pen.fillStyle = colour;
  if (!isHalf) return pen.fillRect(x, y, 1, 1);
  pen.beginPath();
  pen.moveTo(x, y);
  pen.lineTo(x + 1, y);
  pen.lineTo(x, y + 1);
  pen.fill();
}

function ruled(pen, unit, [width, height]) {
  if (width <= 100) for (let x = 0; x <= width; x += 1) line(pen, [[x, 0], [x, height]], "#00000022", unit);
  if (height <= 100) for (let y = 0; y <= height; y += 1) line(pen, [[0, y], [width, y]], "#00000022", unit);
}

function counts([start, goal]) {
  const one = ({ opened, closed }) => `${opened.length} opened, ${closed.length} closed`;
  return goal.opened.length ? `from the start ${one(start)}, from the goal ${one(goal)}` : one(start);
}

// The part of the map that the trials looked at, with some room around it.
function part(replay, width, height) {
  const cells = replay.lanes.flatMap((lane) => [...lane.opened.flat(), ...lane.path]);
  const ends = (axis, size) => {
    let [low, high] = [Infinity, -Infinity];
    for (const cell of cells) [low, high] = [Math.min(low, cell[axis]), Math.max(high, cell[axis])];
    return cells.length ? [Math.max(0, Math.floor(low) - 2), Math.min(size, Math.ceil(high) + 3)] : [0, size];
  };
  return [...ends(0, width), ...ends(1, height)];
}

function key(stage, hasTwoSides) {
  const names = hasTwoSides
    ? [["opened from the start", OPENED[0]], ["closed from the start", CLOSED[0]], ["opened from the goal", OPENED[1]], ["closed from the goal", CLOSED[1]]]
    : [["opened", OPENED[0]], ["closed", CLOSED[0]]];
  const list = stage.appendChild(document.createElement("p"));
  list.className = "key";
  for (const [name, colour] of [...names, ["blocked", BLOCKED]]) {
    const entry = list.appendChild(document.createElement("span"));
    entry.style.setProperty("--colour", colour);
    entry.textContent = name;
  }
  const more = hasTwoSides ? "A cell of two halves is both sides'. " : "";
  list.append(`${more}Outlined: closed just now. At the end: the path as searched (dashed) and as returned.`);
}
