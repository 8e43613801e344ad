// The picture of the patch: triangles by WebGL where there is any, everything else on a canvas above them.

import { Mesh, colourOf, fit } from "./mesh.js";
import { Layout, View } from "./layout.js";
import { counted, element, flush, set, state } from "./state.js";
import { patch } from "./patch.js";
import { fills, legend } from "./colours.js";
import { drawOverlay } from "./overlay.js";

const canvas = element("mesh");
const overlay = element("overlay");
let mesh = null;
let uploaded = "";
export let view = new View(new Layout("quad"));
// Overlay of the picture: `points`, `indices` and `size` of another result, and the numbers of
// its points and primitives that differ.
export const over = { other: null, hover: "" };

export function start() {
  new ResizeObserver(() => draw()).observe(element("canvases"));
  listen();
}

// Lets WebGL draw the triangles, which can take a browser a second to begin with. Until then, and where there is
// none, the canvas above has them.
export function useWebGL() {
  mesh = Mesh.on(canvas);
  draw();
}

// Draws the picture again after these keys of the state changed.
export function update(keys) {
  if (keys.has("line") && view.layout.triangle !== (patch.parts.domain === "tri")) {
    view = new View(new Layout(patch.parts.domain));
  }
  if (keys.has("view")) view.fromText(state.view);
  if (["line", "colours"].some((key) => keys.has(key))) uploaded = "";
  element("legend").textContent = legend(state.colours);
  const { points, primitives, size } = patch;
  const noun = ["point", "line", "triangle"][size - 1], indices = counted(patch.indices.length, "index", "indices");
  element("counts").textContent = [counted(points.length / 2, "point"), counted(primitives, noun), indices].join(", ");
  draw();
}

function upload() {
  const { points, indices, size } = patch;
  if (size !== 3) return mesh.set(new Float32Array(0), new Uint8Array(0));
  const positions = new Float32Array(indices.length * 3);
  const colours = new Uint32Array(indices.length);
  const fill = fills(patch, state.colours);
  for (let k = 0; k < indices.length; k++) {
    positions[3 * k] = points[2 * indices[k]];
    positions[3 * k + 1] = points[2 * indices[k] + 1];
    const at = k - k % 3;
    colours[k] = fill[at] | fill[at + 1] << 8 | fill[at + 2] << 16 | 0xff000000;
  }
  mesh.set(positions, new Uint8Array(colours.buffer));
}

// How many primitives are shown.
export function shown() {
  return state.built === "" ? patch.primitives : Math.min(Number(state.built), patch.primitives);
}

export function draw() {
  if (!patch.view) return;
  fit(canvas);
  fit(overlay);
  view.width = canvas.clientWidth;
  view.height = canvas.clientHeight;
  if (mesh) {
    if (uploaded !== patch.line + state.colours) upload();
    uploaded = patch.line + state.colours;
    const ratio = devicePixelRatio || 1;
    mesh.draw({
      matrix: view.matrix(), origin: [view.u, view.v, 0], edge: [...colourOf("--mesh-edge"), 0.9],
      width: 0.55 * ratio, triangles: shown(),
    });
  }
  drawOverlay(overlay, view, over, shown(), !mesh);
}

function keepView() {
  set({ view: view.toText() });
  draw();
}

function listen() {
  const at = (event) => {
    const box = overlay.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const held = new Map();
  let moved = false;
  overlay.addEventListener("pointerdown", (event) => {
    overlay.setPointerCapture(event.pointerId);
    held.set(event.pointerId, at(event));
    moved = false;
  });
  overlay.addEventListener("pointermove", (event) => {
    const [x, y] = at(event);
    if (!held.has(event.pointerId)) return hover(pickAt(x, y));
    const [fromX, fromY] = held.get(event.pointerId);
    if (Math.hypot(x - fromX, y - fromY) < 3 && !moved) return;
    moved = true;
    if (held.size === 2) pinch(held, event.pointerId, [x, y]);
    else view.pan(x - fromX, y - fromY);
    held.set(event.pointerId, [x, y]);
    keepView();
  });
  overlay.addEventListener("pointerup", (event) => {
    if (held.delete(event.pointerId) && !moved) set({ pick: pickAt(...at(event)), answer: "ask" });
  });
  overlay.addEventListener("pointercancel", (event) => held.delete(event.pointerId));
  overlay.addEventListener("pointerleave", () => hover(""));
  overlay.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.magnify(Math.exp(-event.deltaY * 0.002), ...at(event));
    keepView();
  }, { passive: false });
  overlay.addEventListener("keydown", onKey);
  for (const [id, factor] of [["zoom-in", 1.5], ["zoom-out", 1 / 1.5], ["zoom-fit", 0]]) {
    element(id).addEventListener("click", () => zoomBy(factor));
  }
}

// Two fingers: what was between them stays between them.
function pinch(held, moving, to) {
  const [other] = [...held].filter(([id]) => id !== moving).map(([, place]) => place);
  const from = held.get(moving);
  const spread = (p) => Math.max(Math.hypot(p[0] - other[0], p[1] - other[1]), 1);
  view.magnify(spread(to) / spread(from), (to[0] + other[0]) / 2, (to[1] + other[1]) / 2);
}

function zoomBy(factor) {
  if (factor === 0) view.reset();
  else view.magnify(factor);
  keepView();
}

function onKey(event) {
  const pans = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
  const zooms = { "+": 1.5, "=": 1.5, "-": 1 / 1.5, 0: 0 };
  const steps = { PageUp: -1, PageDown: 1 };
  if (event.key in pans) view.pan(...pans[event.key]), keepView();
  else if (event.key in zooms) zoomBy(zooms[event.key]);
  else if (event.key in steps) step(event.shiftKey ? "t" : "p", steps[event.key]);
  else if (event.key === "Escape") set({ pick: "" });
  else return;
  event.preventDefault();
}

// Asks about the next point ("p") or primitive ("t").
function step(kind, by) {
  const count = kind === "p" ? patch.points.length / 2 : patch.primitives;
  if (count === 0) return;
  const current = state.pick.startsWith(kind) ? Number(state.pick.slice(1)) : by > 0 ? -1 : count;
  set({ pick: `${kind}${(current + by + count) % count}`, answer: "ask" });
}

function hover(pick) {
  if (over.hover === pick) return;
  over.hover = pick;
  draw();
  overlay.dispatchEvent(new Event("hovered"));
  flush();
}

// The point near these pixels, else the primitive there, else nothing: `p7`, `t12`, ``.
function pickAt(x, y) {
  const { points, indices, size } = patch;
  let best = "", nearest = 9;
  for (let i = 0; i < points.length / 2; i++) {
    const [px, py] = view.toScreen(points[2 * i], points[2 * i + 1]);
    const distance = Math.hypot(px - x, py - y);
    if (distance < nearest) [best, nearest] = [`p${i}`, distance];
  }
  if (best && nearest < Math.min(9, 0.3 * spacing())) return best;
  for (let t = shown() - 1; t >= 0; t--) {
    const corners = [...indices.subarray(size * t, size * t + size)]
      .map((i) => view.toScreen(points[2 * i], points[2 * i + 1]));
    if (size === 3 ? inside(corners, x, y) : size === 2 && besideLine(corners, x, y)) return `t${t}`;
  }
  return best;
}

// About how many pixels lie between neighbouring points.
function spacing() {
  return 65536 * view.scale / Math.max(1, Math.sqrt(patch.points.length / 2) - 1);
}

function inside([a, b, c], x, y) {
  const side = (p, q) => (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
  const sides = [side(a, b), side(b, c), side(c, a)];
  return sides.every((s) => s >= 0) || sides.every((s) => s <= 0);
}

function besideLine([a, b], x, y) {
  const dx = b[0] - a[0], dy = b[1] - a[1];
  const along = Math.min(Math.max(((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy || 1), 0), 1);
  return Math.hypot(a[0] + along * dx - x, a[1] + along * dy - y) < 5;
}
