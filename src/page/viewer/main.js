// The page's script: filters and sorts claims, shows interpretations, unpacks figures, plays replays, shows curves. It computes no result.
import { claims } from "./claims.js";
import { curves } from "./curves.js";
import { figures } from "./figures.js";
import { player } from "./player.js";
import { interpretations } from "./interpretations.js";
import { unpack } from "./unpack.js";

const packed = (kind) => [...document.querySelectorAll(`script[data-kind="${kind}"]`)];

figures(packed("figure"), unpack);
curves(packed("curves"), unpack);
const show = player(packed("replay"), unpack);
claims();
const read = interpretations(packed("interpretations"));

// Links within the page name what they show: #claim=ID, #class=WORD, #interpretation=CHOICE:OPTION,…, #replay=TRIAL&step=N.
async function follow() {
  const asked = new URLSearchParams(location.hash.slice(1));
  (await read)(asked);
  if (asked.has("replay")) await show(asked.get("replay"), asked);
  document.documentElement.dataset.ready = "yes";
}
addEventListener("hashchange", follow);
follow();
