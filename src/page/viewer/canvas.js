// Drawings in the plane: one canvas a trial, side by side, y up.
export function lanes(stage, labels, [x0, x1, y0, y1]) {
  const row = stage.appendChild(document.createElement("div"));
  row.className = "lanes";
  return labels.map((label) => {
    const figure = row.appendChild(document.createElement("figure"));
    const canvas = figure.appendChild(document.createElement("canvas"));
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", label);
    figure.appendChild(Object.assign(document.createElement("figcaption"), { textContent: label }));
    const scale = 900 / Math.max(x1 - x0, y1 - y0);
    canvas.width = Math.ceil((x1 - x0) * scale);
    canvas.height = Math.ceil((y1 - y0) * scale);
    const pen = canvas.getContext("2d");
    pen.setTransform(scale, 0, 0, -scale, -x0 * scale, y1 * scale);
    return { pen, unit: 1 / scale, window: [x0, y0, x1 - x0, y1 - y0] };
  });
}

export function line(pen, points, colour, width, dash = []) {
  if (points.length < 2) return;
  pen.beginPath();
  points.forEach(([x, y], index) => (index ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.lineJoin = "round";
  pen.setLineDash(dash);
  pen.stroke();
  pen.setLineDash([]);
}

export function dot(pen, [x, y], radius, colour) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fillStyle = colour;
  pen.fill();
}
