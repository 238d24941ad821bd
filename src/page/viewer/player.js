// Plays replays: a list to choose from, a slider, play, speed. What is drawn is up to the kind of scene.
import { anyAngle } from "./any_angle.js";
import { arm } from "./arm.js";
import { grid } from "./grid.js";
import { land, unfold } from "./land.js";
import { plane } from "./plane.js";
import { unpackJson } from "./unpack.js";

const KINDS = { any_angle: anyAngle, arm, grid, plane };

export function player(packed) {
  const place = document.getElementById("player");
  if (!place) return async () => {};
  place.innerHTML = `
    <label>replay <select name="which"></select></label>
    <div class="stage"></div>
    <div class="controls">
      <button type="button" name="play" aria-pressed="false">play</button>
      <input type="range" name="step" min="0" value="0" aria-label="step">
      <label>speed <select name="speed"><option value="0.25">¼</option><option value="1" selected>1</option><option value="4">4</option></select></label>
      <output></output>
    </div>`;
  const part = (name) => place.querySelector(`[name="${name}"]`);
  const [which, play, slider, stage, shown] = [part("which"), part("play"), part("step"), place.querySelector(".stage"), place.querySelector("output")];
  packed.forEach((element, index) => which.append(new Option(element.dataset.name, String(index))));

  let scene = null;
  const draw = () => {
    if (!scene) return;
    shown.textContent = scene.draw(Number(slider.value));
  };
  const stop = () => {
    play.setAttribute("aria-pressed", "false");
    play.textContent = "play";
  };
  const put = (replay) => {
    stop();
    scene?.end?.();
    stage.replaceChildren();
    scene = KINDS[replay.kind](stage, replay);
    slider.max = String(scene.steps);
    slider.value = "0";
    draw();
  };
  const load = async (index) => {
    which.value = String(index);
    put(await unpackJson(packed[index]));
  };

  let before = 0;
  let fraction = 0;
  const tick = (now) => {
    if (play.getAttribute("aria-pressed") !== "true") return;
    fraction += ((now - before) / 1000) * scene.perSecond * Number(part("speed").value);
    before = now;
    if (fraction >= 1) {
      slider.value = String(Number(slider.value) + Math.floor(fraction));
      fraction %= 1;
      draw();
    }
    if (Number(slider.value) >= scene.steps) stop();
    else requestAnimationFrame(tick);
  };
  play.addEventListener("click", () => {
    if (play.getAttribute("aria-pressed") === "true") return stop();
    if (Number(slider.value) >= scene.steps) slider.value = "0";
    play.setAttribute("aria-pressed", "true");
    play.textContent = "pause";
    before = performance.now();
    requestAnimationFrame(tick);
  });
  slider.addEventListener("input", draw);
  which.addEventListener("change", () => load(Number(which.value)));
  place.addEventListener("keydown", (event) => {
    if (event.key === " " && event.target !== play && event.target.tagName !== "SELECT") {
      event.preventDefault();
      play.click();
    }
  });
  document.getElementById("more")?.addEventListener("change", async (event) => {
    const file = event.target.files[0];
    try {
      put(JSON.parse(await file.text()));
      land(place);
    } catch (error) {
      shown.textContent = `${file.name} is no replay: ${error.message}`;
    }
  });

  // The first replay is drawn when it comes near the screen: three-dimensional ones take a moment.
  const seen = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    seen.disconnect();
    if (!scene && packed.length > 0) load(0);
  }, { rootMargin: "400px" });
  seen.observe(place);

  return async (trial, asked) => {
    seen.disconnect();
    unfold(place);
    for (const [index, element] of packed.entries()) {
      const replay = await unpackJson(element);
      if (!replay.trials.includes(trial)) continue;
      which.value = String(index);
      put(replay);
      slider.value = asked.get("step") ?? "0";
      draw();
      land(place);
      return;
    }
    shown.textContent = `the replay of ${trial} is not in this page`;
    land(place);
  };
}
