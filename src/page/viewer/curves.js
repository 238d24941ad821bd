// Curves along a sweep, with the values under the pointer.
import uPlot from "uplot";
import { unpackJson } from "./unpack.js";

const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"];

export async function curves(packed) {
  const place = document.querySelector("#curves > details");
  for (const element of packed) {
    const data = await unpackJson(element);
    const figure = place.appendChild(document.createElement("figure"));
    const plot = figure.appendChild(document.createElement("div"));
    figure.appendChild(Object.assign(document.createElement("figcaption"), { textContent: data.title }));
    draw(plot, data);
  }
}

function draw(plot, data) {
  const ink = getComputedStyle(document.body).color;
  const columns = [data.at];
  const series = [{ label: data.axis }];
  const bands = [];
  const colour = (of) => COLOURS[of % COLOURS.length];
  data.lines.forEach((line) => {
    const stroke = colour(line.of);
    series.push(line.is_printed
      ? { label: line.label, stroke, width: 0, points: { show: true, size: 11, width: 2, stroke, fill: "#ffffff" } }
      : { label: line.label, stroke, width: 2, value: (_chart, value, _series, at) => readout(line, value, at) });
    columns.push(line.values);
    if (line.band) {
      const at = columns.length;
      for (const [end, values] of [["from", line.band[0]], ["to", line.band[1]]]) {
        series.push({ label: `band ${end}`, class: "band", stroke, width: 0.5, points: { show: false } });
        columns.push(values);
      }
      bands.push({ series: [at + 1, at], fill: `${stroke}33` });
    }
  });
  const axis = { stroke: ink, grid: { stroke: `${"#888888"}44` }, ticks: { stroke: ink } };
  const size = () => ({ width: Math.min(plot.clientWidth || 700, 900), height: 360 });
  const chart = new uPlot({
    ...size(),
    scales: { x: { time: false } },
    axes: [{ ...axis, label: data.axis }, { ...axis, label: data.value }],
    series,
    bands,
  }, columns, plot);
  addEventListener("resize", () => chart.setSize(size()));
}

// The value under the pointer, between the ends of the band around it.
function readout(line, value, at) {
  if (at === null || value === null) return "–";
  const short = (number) => String(Number(number.toPrecision(4)));
  return line.band ? `${short(value)} [${short(line.band[0][at])}, ${short(line.band[1][at])}]` : short(value);
}
