// Patches on a surface: tessellated and evaluated by the CPU backend, drawn by WebGL.

import { SurfaceView } from "./tess_explorer.js";
import { Mesh, colourOf, fit } from "./mesh.js";
import { element, set, state } from "./state.js";

const canvas = element("solid");
let mesh = null;
let surface = null;
let name = "";
let made = "";
let sphere = [0, 0, 0, 1];
// The direction of the eye from the centre, in radians, and its distance in radii.
const orbit = { turn: 0.7, lift: 0.45, far: 2.4 };

export function start() {
  new ResizeObserver(() => state.tab === "surface" && draw()).observe(canvas);
  const bind = (id, key, read = (box) => box.value) =>
    element(id).addEventListener("input", () => set({ [key]: read(element(id)) }));
  bind("surface", "surface");
  bind("surface-partitioning", "spacing");
  bind("rule", "rule");
  bind("surface-factor", "factor");
  bind("wireframe", "wire", (box) => (box.checked ? "1" : ""));
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

function turn(by, up, away) {
  orbit.turn += by;
  orbit.lift = Math.min(Math.max(orbit.lift + up, -1.5), 1.5);
  orbit.far = Math.min(Math.max(orbit.far * away, 1.15), 12);
  set({ eye: [orbit.turn, orbit.lift, orbit.far].map((part) => part.toFixed(3)).join(",") });
}

export function update(keys) {
  if (state.tab !== "surface") return;
  if (keys.has("eye") && state.eye) [orbit.turn, orbit.lift, orbit.far] = state.eye.split(",").map(Number);
  element("surface").value = state.surface;
  element("surface-partitioning").value = state.spacing;
  element("rule").value = state.rule;
  element("surface-factor").value = state.factor;
  element("surface-factor-text").textContent = Number(state.factor).toFixed(2);
  element("wireframe").checked = state.wire !== "";
  draw();
}

function draw() {
  mesh ??= Mesh.on(canvas);
  if (!mesh) return;
  if (name !== state.surface) {
    surface?.free();
    surface = new SurfaceView(state.surface);
    [name, made, sphere] = [state.surface, "", surface.sphere()];
  }
  fit(canvas);
  const eye = eyePosition();
  tessellate(eye);
  const ratio = devicePixelRatio || 1;
  mesh.draw({
    matrix: projection(eye), edge: [...colourOf("--mesh-edge"), 0.75],
    width: state.wire ? 0.5 * ratio : 0, light: lightFrom(eye), depth: true,
  });
}

// Over the eye's shoulder.
function lightFrom(eye) {
  const towards = [eye[0] - sphere[0], eye[1] - sphere[1], eye[2] - sphere[2] + 0.8 * sphere[3] * orbit.far / 2];
  return towards.map((part) => part / Math.hypot(...towards));
}

function eyePosition() {
  const [x, y, z, radius] = sphere, { turn, lift, far } = orbit;
  return [x + far * radius * Math.cos(lift) * Math.cos(turn), y + far * radius * Math.cos(lift) * Math.sin(turn), z + far * radius * Math.sin(lift)];
}

// Anew if the surface, its factors or, with factors by distance, the eye changed.
function tessellate(eye) {
  const keeps = element("freeze").checked && made.startsWith(recipe(""));
  const wanted = recipe(state.rule === "distance" ? eye.join() : "");
  if (keeps || made === wanted) return;
  made = wanted;
  const factor = Number(state.factor);
  if (state.rule === "uniform") surface.uniform(state.spacing, factor);
  else surface.by_distance(state.spacing, factor * sphere[3], ...eye);
  const positions = surface.positions(), normals = surface.normals(), indices = surface.indices();
  const gather = (list) => {
    const all = new Float32Array(indices.length * 3);
    indices.forEach((i, k) => all.set(list.subarray(3 * i, 3 * i + 3), 3 * k));
    return all;
  };
  const colour = [0x8f, 0xb8, 0xdc, 0xff], colours = new Uint8Array(indices.length * 4);
  for (let k = 0; k < colours.length; k++) colours[k] = colour[k % 4];
  mesh.set(gather(positions), colours, gather(normals));
  element("surface-counts").textContent =
    `${surface.patches()} patches, ${positions.length / 3} vertices, ${indices.length / 3} triangles`;
}

const recipe = (eye) => [state.surface, state.spacing, state.rule, state.factor, eye].join(" ");

// Perspective from the eye to the centre, z up.
function projection(eye) {
  const [cx, cy, cz, radius] = sphere;
  const subtract = (a, b) => a.map((part, k) => part - b[k]);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => a.map((part) => part / Math.hypot(...a));
  const forward = unit(subtract([cx, cy, cz], eye));
  const right = unit(cross(forward, [0, 0, 1])), up = cross(right, forward);
  const far = 20 * radius, near = 0.02 * radius, open = 2.2;
  const aspect = canvas.width / canvas.height;
  const sx = open / Math.max(aspect, 1), sy = sx * aspect;
  const rows = [[...right.map((p) => p * sx), -dot(right, eye) * sx], [...up.map((p) => p * sy), -dot(up, eye) * sy]];
  const depth = (far + near) / (far - near), shift = -2 * far * near / (far - near);
  rows.push([...forward.map((p) => p * depth), -dot(forward, eye) * depth + shift]);
  rows.push([...forward, -dot(forward, eye)]);
  return [0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]));
}
