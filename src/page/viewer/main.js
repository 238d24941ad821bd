// The page's script: filters and sorts claims, shows interpretations, unpacks figures, plays replays, shows curves. It computes no result.
import { claims } from "./claims.js";
import { curves } from "./curves.js";
import { figures } from "./figures.js";
import { land } from "./land.js";
import { player } from "./player.js";
import { interpretations } from "./interpretations.js";
import { unpack } from "./unpack.js";

const packed = (kind) => [...document.querySelectorAll(`script[data-kind="${kind}"]`)];

// The menu stays on top, so what is scrolled to stops below it.
const menu = document.querySelector("nav");
const measure = () => document.documentElement.style.setProperty("--menu", `${menu.offsetHeight}px`);
if (menu) new ResizeObserver(measure).observe(menu);
// On a narrow screen all folds but the head's are closed; one that opens has its curves fitted.
if (matchMedia("(max-width: 600px)").matches) document.querySelectorAll("section > details").forEach((part) => (part.open = false));
document.addEventListener("toggle", () => dispatchEvent(new Event("resize")), true);

figures(packed("figure"), unpack);
curves(packed("curves"), unpack);
const show = player(packed("replay"), unpack);
claims();
const read = interpretations(packed("interpretations"));

// Links within the page name a part of it, or what they show: #claim=ID, #class=WORD, #interpretation=CHOICE:OPTION,…, #replay=TRIAL&step=N.
async function follow() {
  const asked = new URLSearchParams(location.hash.slice(1));
  const part = document.getElementById(location.hash.slice(1));
  if (part && !location.hash.includes("=")) land(part);
  (await read)(asked);
  if (asked.has("replay")) await show(asked.get("replay"), asked);
  document.documentElement.dataset.ready = "yes";
}
addEventListener("hashchange", follow);
// A link to where one is already leads there again.
document.addEventListener("click", (event) => {
  if (event.target.closest("a")?.hash && event.target.closest("a").hash === location.hash) dispatchEvent(new Event("hashchange"));
});
follow();
