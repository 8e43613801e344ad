// Animations: a factor over a range, and the patch built primitive by primitive.

import { element, set, state } from "./state.js";
import { change, changeFactor, toBits } from "./controls.js";
import { patch } from "./patch.js";

const running = { factor: null, build: null };

export function start() {
  element("animate").addEventListener("click", () => (running.factor ? stop("factor") : playFactor()));
  element("build").addEventListener("click", () => (running.build ? stop("build") : playBuild()));
  document.addEventListener("visibilitychange", () => document.hidden && (stop("factor"), stop("build")));
}

function run(which, button, each) {
  const began = performance.now();
  const token = (running[which] = {});
  element(button).setAttribute("aria-pressed", "true");
  const frame = (now) => {
    if (running[which] !== token) return;
    if (each((now - began) / 1000)) requestAnimationFrame(frame);
    else stop(which);
  };
  requestAnimationFrame(frame);
}

function stop(which) {
  running[which] = null;
  element(which === "factor" ? "animate" : "build").setAttribute("aria-pressed", "false");
}

// There and back again until it is stopped.
function playFactor() {
  const number = (id) => Number(element(id).value);
  run("factor", "animate", (seconds) => {
    const period = Math.max(number("animate-seconds"), 0.1);
    const phase = (seconds / period) % 2;
    const part = phase < 1 ? phase : 2 - phase;
    const bits = toBits(number("animate-from") + (number("animate-to") - number("animate-from")) * part);
    const which = element("animate-factor").value;
    if (which === "all") change({ factors: patch.parts.factors.map(() => bits) });
    else changeFactor(Number(which), bits);
    return true;
  });
}

// The whole patch in eight seconds, or less if it is small.
function playBuild() {
  const from = state.built === "" ? 0 : Number(state.built);
  const rate = Math.max(patch.primitives / 8, 4);
  run("build", "build", (seconds) => {
    const count = from + Math.floor(seconds * rate);
    set({ built: count >= patch.primitives ? "" : String(count) });
    return count < patch.primitives;
  });
}

// Sets an animation up and plays it.
export function play({ line, from, to, seconds }) {
  set({ line, view: "", built: "" });
  element("animation").open = true;
  for (const [name, value] of Object.entries({ from, to, seconds, factor: "all" })) element(`animate-${name}`).value = value;
  if (!running.factor) playFactor();
}
