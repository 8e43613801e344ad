// The lesson: its words are in index.html; here its patches move.

import { element, state } from "./state.js";
import { patch } from "./patch.js";
import { play } from "./animation.js";

const boxes = () => [...element("learn-partitionings").children];

export function start() {
  for (const box of boxes()) box.querySelector("button").addEventListener("click", () => show(box.dataset));
}

// All factors of a quad, over the range that shows what the partitioning does.
function show({ partitioning, from, to }) {
  const line = `case quad ${partitioning} triangle_cw ${patch.parts.split}${" 40400000".repeat(6)}`;
  play({ line, from, to, seconds: 12 });
}

// The text about the chosen partitioning is open.
export function update(keys) {
  if (!keys.has("line") || state.answer !== "learn") return;
  for (const box of boxes()) box.open = box.dataset.partitioning === patch.parts.partitioning;
}
