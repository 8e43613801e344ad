// Patches on a surface: tessellated and drawn by the GPU where there is WebGPU, else tessellated by the CPU
// backend and drawn by WebGL.

import { SurfaceView } from "./tess_explorer.js";
import { Mesh, colourOf, fit } from "./mesh.js";
import { eyeOf, fromText, lightOf, moved, projection, toText } from "./orbit.js";
import { Solid } from "./solid.js";
import { counted, element, set, state } from "./state.js";

const COLOUR = [0x8f, 0xb8, 0xdc];

const canvas = element("solid"), gpuCanvas = element("solid-gpu");
let mesh = null;
let solid = null;
// Why the GPU cannot draw.
let missing = "";
let surface = null;
let name = "", made = "", loaded = "";
let sphere = [0, 0, 0, 1];

export function start() {
  new ResizeObserver(() => state.tab === "surface" && draw()).observe(canvas);
  const bind = (id, key, read = (box) => box.value) =>
    element(id).addEventListener("input", () => set({ [key]: read(element(id)) }));
  bind("surface", "surface");
  bind("surface-partitioning", "spacing");
  bind("rule", "rule");
  bind("surface-factor", "factor");
  bind("surface-by", "by");
  bind("wireframe", "wire", (box) => (box.checked ? "1" : ""));
  bind("freeze", "kept", (box) => (box.checked ? toText(orbit()) : ""));
  listen();
}

function listen() {
  let held = null;
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held = [event.clientX, event.clientY];
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    turn((held[0] - event.clientX) * 0.008, (event.clientY - held[1]) * 0.008, 1);
    held = [event.clientX, event.clientY];
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => (held = null));
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    turn(0, 0, Math.exp(event.deltaY * 0.001));
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const turns = { ArrowLeft: [0.1, 0, 1], ArrowRight: [-0.1, 0, 1], ArrowUp: [0, 0.1, 1], ArrowDown: [0, -0.1, 1], "+": [0, 0, 0.9], "=": [0, 0, 0.9], "-": [0, 0, 1.1] };
    if (!(event.key in turns)) return;
    event.preventDefault();
    turn(...turns[event.key]);
  });
}

const orbit = () => fromText(state.eye);
const turn = (by, up, away) => set({ eye: toText(moved(orbit(), by, up, away)) });

export function update() {
  if (state.tab !== "surface") return;
  element("surface").value = state.surface;
  element("surface-partitioning").value = state.spacing;
  element("rule").value = state.rule;
  element("surface-factor").value = state.factor;
  element("surface-factor-text").textContent = Number(state.factor).toFixed(2);
  element("surface-by").value = state.by;
  element("wireframe").checked = state.wire !== "";
  element("freeze").checked = state.kept !== "";
  draw();
}

function draw() {
  if (name !== state.surface) {
    surface?.free();
    surface = new SurfaceView(state.surface);
    [name, made, loaded, sphere] = [state.surface, "", "", surface.sphere()];
  }
  const isGpu = state.by === "gpu" && !missing;
  gpuCanvas.hidden = !isGpu;
  fit(canvas);
  fit(gpuCanvas);
  if (isGpu) return drawOnGpu();
  drawOnCpu();
  say("cpu", `Tessellated by the CPU, drawn by WebGL${state.by === "gpu" ? `: ${missing}` : ""}.`);
}

function say(by, text) {
  element("surface-note").dataset.by = by;
  element("surface-note").textContent = text;
}

// Settings of both ways of drawing.
function scene() {
  const eye = eyeOf(orbit(), sphere);
  const width = state.wire ? 0.5 * (devicePixelRatio || 1) : 0;
  const matrix = projection(eye, sphere, canvas.width / canvas.height);
  return { matrix, edge: [...colourOf("--mesh-edge"), 0.75], width, light: lightOf(orbit(), eye, sphere) };
}

// Sets the factors again if they, the surface or, with factors by distance, the eye changed; whether they did.
function setFactors() {
  const eye = eyeOf(state.kept ? fromText(state.kept) : orbit(), sphere);
  const wanted = [state.by, missing, state.spacing, state.rule, state.factor, state.rule === "distance" ? eye : ""].join(" ");
  if (made === wanted) return false;
  made = wanted;
  const factor = Number(state.factor);
  if (state.rule === "uniform") surface.uniform(state.spacing, factor);
  else surface.by_distance(state.spacing, factor * sphere[3], ...eye);
  return true;
}

function count(vertices, triangles) {
  const words = [counted(surface.patches(), "patch", "patches"), counted(vertices, "vertex", "vertices")];
  element("surface-counts").textContent = [...words, counted(triangles, "triangle")].join(", ");
}

function drawOnCpu() {
  mesh ??= Mesh.on(canvas);
  if (!mesh) return say("none", "This browser has neither WebGPU nor WebGL 2.");
  if (setFactors()) upload();
  mesh.draw({ ...scene(), depth: true });
}

function upload() {
  surface.tessellate();
  const positions = surface.positions(), normals = surface.normals(), indices = surface.indices();
  const gather = (list) => {
    const all = new Float32Array(indices.length * 3);
    for (let k = 0; k < indices.length; k++) {
      for (let axis = 0; axis < 3; axis++) all[3 * k + axis] = list[3 * indices[k] + axis];
    }
    return all;
  };
  const [red, green, blue] = COLOUR;
  const colours = new Uint32Array(indices.length).fill((0xff000000 | blue << 16 | green << 8 | red) >>> 0);
  mesh.set(gather(positions), new Uint8Array(colours.buffer), gather(normals));
  count(positions.length / 3, indices.length / 3);
}

let busy = null;
let isAgain = false;

// One picture after the other, the last one of what is shown then.
function drawOnGpu() {
  isAgain = true;
  busy ??= drawWhileAsked().finally(() => (busy = null));
}

// Resolves when the GPU has drawn what is shown. For tests.
export const settled = () => busy;

async function drawWhileAsked() {
  try {
    solid ??= await openSolid();
    while (isAgain && state.by === "gpu" && state.tab === "surface") {
      isAgain = false;
      await drawOnce();
    }
  } catch (error) {
    [missing] = error.message.split("\n");
    draw();
  }
}

async function openSolid() {
  const opened = await Solid.on(gpuCanvas, COLOUR.map((part) => part / 255));
  opened.gpu.device.lost.then(() => {
    missing = "the graphics device was lost";
    if (state.tab === "surface") draw();
  });
  return opened;
}

async function drawOnce() {
  const isAnew = setFactors(), words = surface.factor_words(), wanted = `${name} ${state.spacing}`;
  if (loaded !== wanted) await solid.load(surface);
  if (isAnew || loaded !== wanted) solid.setFactors(words);
  loaded = wanted;
  await solid.draw(scene());
  mesh?.clear();
  if (isAnew) count(...await solid.counts());
  say("gpu", "Tessellated and drawn by the GPU.");
}
