// The interpretations that were explored: choose one and see each claim's outcome under it; open a claim and see what each option does to
// it. Classes, effects and what counts are as analysis stored them.
import { land } from "./land.js";
import { unpackJson } from "./unpack.js";

const EFFECTS = { turns: "turns it", opens: "opens or decides it", number: "changes results, not which way it speaks" };
const SIGHTS = { powerless: "too few instances to say", unexplored: "its trials did not run under it" };

export async function interpretations(packed) {
  const [form, table] = [document.getElementById("interpretation"), document.getElementById("claimed")];
  if (!form || packed.length === 0) return () => {};
  const data = await unpackJson(packed[0]);
  const fields = fill(form, data);
  const lines = [...table.tBodies];

  const asked = () => Object.fromEntries(data.choices
    .map((choice) => [choice.id, fields.get(choice.id).value])
    .filter(([id, option]) => option !== data.choices.find((choice) => choice.id === id).default));
  const put = (options) => {
    for (const choice of data.choices) {
      const field = fields.get(choice.id);
      const isKnown = choice.options.some((option) => option.name === options[choice.id]);
      field.value = isKnown ? options[choice.id] : choice.default;
      field.classList.toggle("moved", field.value !== choice.default);
    }
  };
  const show = () => {
    const options = asked();
    put(options);
    const place = data.interpretations.findIndex((interpretation) => name(interpretation) === name(options));
    say(form, data, options, place, choose);
    table.classList.toggle("asked", place >= 0);
    document.querySelector("#filter [name=under]").parentElement.hidden = place < 0;
    if (place < 0) document.querySelector("#filter [name=under]").value = "";
    for (const line of lines) under(line, data, place, options);
    document.getElementById("filter").dispatchEvent(new Event("input"));
  };
  const choose = (options) => {
    put(options);
    const hash = Object.entries(options).map(([id, option]) => `${id}:${option}`).join(",");
    history.replaceState(null, "", `#interpretation=${hash}`);
    show();
  };
  form.addEventListener("input", () => choose(asked()));
  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("click", (event) => event.target.name === "defaults" && choose({}));
  table.addEventListener("opened", (event) => whatOptionsDo(event.target, data, choose));
  lines.filter((line) => !line.querySelector(".evidence").hidden).forEach((line) => whatOptionsDo(line, data, choose));

  return (hash) => {
    if (!hash.has("interpretation")) return;
    put(Object.fromEntries(hash.get("interpretation").split(",").filter(Boolean).map((pair) => pair.split(":"))));
    show();
    land(document.getElementById("interpretations"));
  };
}

// An interpretation by what departs from the defaults.
function name(options) {
  return Object.entries(options).map(([id, option]) => `${id} = ${option}`).sort().join(", ");
}

// One choice for each thing that the paper leaves open.
function fill(form, data) {
  const fields = new Map();
  for (const choice of data.choices) {
    const label = form.appendChild(element("label", `${choice.id} `));
    label.title = choice.why;
    const field = label.appendChild(document.createElement("select"));
    for (const option of choice.options) {
      const marks = [option.name === choice.default && "default", !option.votes && "probe"].filter(Boolean);
      field.append(new Option(option.name + (marks.length ? ` (${marks.join(", ")})` : ""), option.name, false, option.name === choice.default));
    }
    fields.set(choice.id, field);
  }
  form.appendChild(Object.assign(element("button", "all defaults"), { type: "button", name: "defaults" }));
  form.appendChild(document.createElement("output"));
  return fields;
}

// What is known of the interpretation; of one that was not explored, those next to it.
function say(form, data, options, place, choose) {
  const shown = form.querySelector("output");
  const probes = data.choices.filter((choice) => options[choice.id] && !choice.options.find((option) => option.name === options[choice.id]).votes);
  if (place >= 0) {
    const probe = probes.length ? ` It has a probe (${probes.map((choice) => choice.id).join(", ")}): shown and never counted.` : "";
    shown.replaceChildren(`Interpretation ${place + 1} of ${data.interpretations.length}: ${name(options) || "the default"}.${probe}`);
    return;
  }
  const far = (interpretation) => data.choices.filter((choice) => (interpretation[choice.id] ?? choice.default) !== (options[choice.id] ?? choice.default)).length;
  const near = data.interpretations.map((interpretation) => [far(interpretation), interpretation]).sort(([a], [b]) => a - b).slice(0, 4);
  shown.replaceChildren("This combination was not explored. Explored ones that are next to it: ");
  for (const [, interpretation] of near) shown.append(button(name(interpretation) || "the default", () => choose(interpretation)), " ");
}

// A claim's outcome under the interpretation at `place`.
function under(line, data, place, options) {
  const cell = line.querySelector("td.under");
  const results = data.claims[idOf(line)]?.results ?? [];
  const [found, base] = [place, 0].map((at) => results.find((result) => result.interpretations.includes(at)));
  line.dataset.under = place >= 0 && found ? found.class : "";
  line.toggleAttribute("data-differs", place >= 0 && Boolean(found) && found.class !== base?.class);
  if (place < 0) return cell.replaceChildren();
  if (!found) return cell.replaceChildren("not explored");
  const notes = [number(found), why(found, data, place, options)].filter(Boolean);
  cell.replaceChildren(badge(found.class), ...notes.map((note) => element("div", note)));
}

// Why a result does not count, or counts as something else.
function why(found, data, place, options) {
  if (SIGHTS[found.sight]) return SIGHTS[found.sight];
  const isProbe = data.choices.some((choice) => choice.options.some((option) => option.name === options[choice.id] && !option.votes));
  if (isProbe) return "";
  if (!found.counted.includes(place)) return "does not count: it contradicts what the study was calibrated to";
  return found.counts_as === found.class ? "" : `counts as ${found.counts_as}: the second seed does not say so too`;
}

// What each option does to a claim when it alone departs from the defaults.
function whatOptionsDo(line, data, choose) {
  const cell = line.querySelector(".evidence td");
  const claim = data.claims[idOf(line)];
  if (!claim || cell.querySelector(".options")) return;
  const place = cell.appendChild(element("div"));
  place.className = "options";
  const order = Object.keys(EFFECTS);
  const found = (one) => claim.results.find((result) => result.interpretations.includes(one.interpretation));
  const base = claim.results.find((result) => result.interpretations.includes(0));
  const link = (one) => button(`${one.choice} = ${one.option}`, () => choose(data.interpretations[one.interpretation]));
  const isLoud = (one) => one.effect !== "none" && found(one).class !== base.class;
  const loud = claim.options.filter(isLoud).sort((a, b) => order.indexOf(a.effect) - order.indexOf(b.effect));
  const quiet = claim.options.filter((one) => one.effect !== "none" && !isLoud(one));
  if (loud.length) place.append(element("p", "what an option does that alone departs from the defaults:"), tableOf(loud, found, link, data));
  if (quiet.length) place.append(folded(`the outcome stays under ${quiet.length} options that change the results`, quiet, (one) => [link(one), aside(found(one))]));
  const names = (wanted) => data.choices.filter((choice) => choice.options.every((option) => option.name === choice.default || wanted(choice.id, option.name))).map((choice) => choice.id);
  const seen = (choice, option) => claim.options.find((one) => one.choice === choice && one.option === option);
  const still = names((choice, option) => seen(choice, option)?.effect === "none");
  const unseen = names((choice, option) => !seen(choice, option));
  if (still.length) place.append(element("p", `no option changes anything: ${still.join(", ")}`));
  if (unseen.length) place.append(element("p", `its trials ran under the default alone: ${unseen.join(", ")}`));
}

function tableOf(options, found, link, data) {
  const table = element("table");
  table.className = "plain";
  table.createTHead().insertRow().append(...["option", "what it does", "outcome", "ours"].map((text) => element("th", text)));
  const body = table.createTBody();
  for (const one of options) {
    const [row, result] = [body.insertRow(), found(one)];
    const { votes } = data.choices.find((choice) => choice.id === one.choice).options.find((option) => option.name === one.option);
    row.insertCell().append(link(one), votes ? "" : " (probe)");
    row.insertCell().append(EFFECTS[one.effect]);
    row.insertCell().append(badge(result.class), SIGHTS[result.sight] ? ` ${SIGHTS[result.sight]}` : "");
    row.insertCell().append(number(result));
  }
  const wide = element("div");
  wide.className = "wide";
  wide.append(table);
  return wide;
}

function folded(title, options, of) {
  const fold = element("details");
  const line = element("p");
  for (const one of options) line.append(...of(one), one === options.at(-1) ? "" : ", ");
  fold.append(element("summary", title), line);
  return fold;
}

function aside(result) {
  return number(result) ? ` (${number(result)})` : "";
}

function number({ value, interval, n }) {
  if (value === null) return "";
  const short = (x) => String(Number(x.toPrecision(5)));
  return `${short(value)}${interval ? ` [${interval.map(short).join(", ")}]` : ""}; n = ${n}`;
}

function idOf(line) {
  return line.id.slice("claim=".length);
}

function badge(word) {
  const made = element("span", word);
  made.className = `class ${word.replaceAll(" ", "-")}`;
  return made;
}

function button(text, act) {
  const made = Object.assign(element("button", text), { type: "button", className: "link" });
  made.addEventListener("click", act);
  return made;
}

function element(tag, text = "") {
  return Object.assign(document.createElement(tag), { textContent: text });
}
