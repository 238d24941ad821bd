import { land } from "./land.js";

// The table of claims: words, verdicts and interpretations to filter by, heads to sort by, lines that open.
export function claims() {
  const table = document.getElementById("claimed");
  if (!table) return;
  const form = document.getElementById("filter");
  const lines = [...table.tBodies];
  const words = new Map(lines.map((line) => [line, line.textContent.toLowerCase()]));

  for (const choice of new Set(lines.flatMap(choices))) form.elements.hangs.append(new Option(choice));
  if (form.elements.hangs.length === 1) form.elements.hangs.parentElement.hidden = true;

  const hasParts = lines.some((line) => "part" in line.dataset);
  form.elements.parts.parentElement.hidden = !hasParts;

  const filter = () => {
    const asked = form.elements.words.value.toLowerCase().split(/\s+/).filter(Boolean);
    const [kind, hangs, under] = ["class", "hangs", "under"].map((name) => form.elements[name].value);
    let count = 0;
    for (const line of lines) {
      const shown = asked.every((word) => words.get(line).includes(word))
        && (!kind || line.dataset.class === kind)
        && (!hangs || choices(line).includes(hangs))
        && (!under || (under === "differs" ? "differs" in line.dataset : line.dataset.under === under))
        && (form.elements.parts.checked || asked.length > 0 || !("part" in line.dataset));
      line.hidden = !shown;
      count += shown;
    }
    form.querySelector("output").textContent = `${count} of ${lines.length} claims`;
  };
  form.addEventListener("input", filter);
  form.addEventListener("submit", (event) => event.preventDefault());

  const open = (line, wanted) => {
    line.querySelector(".evidence").hidden = !wanted;
    line.querySelector(".open").setAttribute("aria-expanded", String(wanted));
    if (wanted) line.dispatchEvent(new Event("opened", { bubbles: true }));
  };
  table.addEventListener("click", (event) => {
    const button = event.target.closest("button");
    if (button?.classList.contains("open")) {
      const line = button.closest("tbody");
      open(line, line.querySelector(".evidence").hidden);
    }
    if (button?.dataset.sort) sort(table, lines, button);
  });
  addEventListener("beforeprint", () => {
    lines.forEach((line) => open(line, true));
    document.querySelectorAll("details").forEach((details) => (details.open = true));
  });

  const follow = () => {
    const asked = new URLSearchParams(location.hash.slice(1));
    for (const name of ["words", "class", "hangs"]) {
      if (asked.has(name)) form.elements[name].value = asked.get(name);
    }
    const line = asked.has("claim") && document.getElementById(`claim=${asked.get("claim")}`);
    if (line) form.elements.parts.checked ||= "part" in line.dataset;
    filter();
    if (line) {
      line.hidden = false;
      open(line, true);
      land(line);
    }
  };
  addEventListener("hashchange", follow);
  follow();
}

// The choices that turn a claim's outcome or open it.
function choices(line) {
  return line.dataset.hangs ? line.dataset.hangs.split(" ") : [];
}

function sort(table, lines, button) {
  const head = button.closest("th");
  const up = head.getAttribute("aria-sort") !== "ascending";
  for (const other of table.tHead.querySelectorAll("th")) other.setAttribute("aria-sort", "none");
  head.setAttribute("aria-sort", up ? "ascending" : "descending");
  const column = head.cellIndex;
  const key = (line) => (button.dataset.sort === "class" ? Number(line.dataset.rank) : line.rows[0].cells[column].textContent);
  const compare = (a, b) => (typeof a === "number" ? a - b : a.localeCompare(b, "en", { numeric: true }));
  lines.sort((a, b) => (up ? 1 : -1) * compare(key(a), key(b)));
  table.append(...lines);
}
