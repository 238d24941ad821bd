// A planar arm along its path: base, elbow and tip at each station.
import { dot, lanes, line } from "./canvas.js";

export function plane(stage, replay) {
  const drawn = lanes(stage, replay.lanes.map((lane) => `${lane.label}: ${lane.ending}`), replay.window);
  const steps = Math.max(...replay.lanes.map((lane) => lane.stations.length)) - 1;
  const draw = (step) => {
    replay.lanes.forEach((lane, index) => drawLane(drawn[index], replay, lane, Math.min(step, lane.stations.length - 1)));
    return `station ${step} of ${steps}`;
  };
  return { steps, perSecond: Math.max(4, steps / 8), draw };
}

function drawLane({ pen, unit, window }, replay, lane, step) {
  pen.fillStyle = "#ffffff";
  pen.fillRect(...window);
  for (const corners of replay.obstacles) {
    pen.beginPath();
    corners.forEach(([x, y], index) => (index ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    pen.closePath();
    pen.fillStyle = "#9fb6c8";
    pen.fill();
  }
  const tips = lane.stations.map((station) => [station[2], station[3]]);
  line(pen, tips, "#bbbbbb", 2 * unit, [6 * unit, 6 * unit]);
  line(pen, tips.slice(0, step + 1), "#d55e00", 4 * unit);
  const [ex, ey, tx, ty] = lane.stations[step];
  line(pen, [[0, 0], [ex, ey]], "#0072b2", 9 * unit);
  line(pen, [[ex, ey], [tx, ty]], "#56b4e9", 7 * unit);
  for (const joint of [[0, 0], [ex, ey]]) dot(pen, joint, 7 * unit, "#222222");
  dot(pen, tips[0], 7 * unit, "#009e73");
  dot(pen, tips.at(-1), 7 * unit, "#cc79a7");
}
