// The layer above the triangles: the domain's outline, lines, points, numbers, marks and differences.

import { state } from "./state.js";
import { patch } from "./patch.js";
import { css, fills } from "./colours.js";

export function drawOverlay(canvas, view, over, shown, hasTriangles) {
  const ratio = devicePixelRatio || 1;
  // Drawn by the CPU: the first picture then waits for no GPU.
  const paint = canvas.getContext("2d", { willReadFrequently: true });
  paint.setTransform(ratio, 0, 0, ratio, 0, 0);
  paint.clearRect(0, 0, view.width, view.height);
  paint.lineJoin = paint.lineCap = "round";
  const places = view.toScreenAll(patch.points);
  if (hasTriangles && patch.size === 3) triangles(paint, places, shown);
  outline(paint, view);
  if (patch.size === 2) lines(paint, places, shown);
  if (state.colours === "orientation" && patch.size === 3) degenerate(paint, places, shown);
  if (over.other) differences(paint, view, over.other);
  dots(paint, places, view);
  if (state.marks) marks(paint, places);
  highlight(paint, places, state.pick, css("--picked"), 3);
  if (over.hover !== state.pick) highlight(paint, places, over.hover, css("--picked", 0.8), 2);
  numbers(paint, places, view, shown);
}

function path(paint, corners, isClosed = true) {
  paint.beginPath();
  corners.forEach(([x, y]) => paint.lineTo(x, y));
  if (isClosed) paint.closePath();
}

function outline(paint, view) {
  paint.strokeStyle = css("--soft", 0.7);
  paint.lineWidth = 1;
  path(paint, view.layout.corners.map(([u, v]) => view.toScreen(u, v)));
  paint.stroke();
}

const cornersOf = (places, indices, size, t) =>
  [...indices.subarray(size * t, size * t + size)].map((i) => [places[2 * i], places[2 * i + 1]]);

function triangles(paint, places, shown) {
  const fill = fills(patch, state.colours);
  paint.strokeStyle = css("--mesh-edge", 0.9);
  paint.lineWidth = 1;
  for (let t = 0; t < shown; t++) {
    path(paint, cornersOf(places, patch.indices, 3, t));
    paint.fillStyle = `rgb(${fill.subarray(3 * t, 3 * t + 3).join(" ")})`;
    paint.fill();
    paint.stroke();
  }
}

function lines(paint, places, shown) {
  paint.strokeStyle = css("--ink", 0.9);
  paint.lineWidth = 1.2;
  paint.beginPath();
  for (let t = 0; t < shown; t++) {
    const [a, b] = patch.indices.subarray(2 * t, 2 * t + 2);
    paint.moveTo(places[2 * a], places[2 * a + 1]);
    paint.lineTo(places[2 * b], places[2 * b + 1]);
  }
  paint.stroke();
}

// Flipped triangles in red, triangles without area in amber.
function degenerate(paint, places, shown) {
  const areas = patch.view.areas();
  for (let t = 0; t < shown; t++) {
    if (areas[t] > 0) continue;
    paint.strokeStyle = css(areas[t] < 0 ? "--wrong" : "--zero");
    paint.lineWidth = 3;
    path(paint, cornersOf(places, patch.indices, 3, t));
    paint.stroke();
  }
}

// Another result: all of it as thin lines if it is of another case, and what differs in red.
function differences(paint, view, { points, indices, size, isOtherCase, differing }) {
  const places = view.toScreenAll(points);
  const draw = (t) => {
    const corners = cornersOf(places, indices, size, t).filter(([x]) => !Number.isNaN(x) && x !== undefined);
    if (corners.length === 1) mark(paint, ...corners[0], 5, css("--wrong"));
    else {
      path(paint, corners, size === 3);
      if (size === 3 && !isOtherCase) paint.fill();
      paint.stroke();
    }
  };
  paint.strokeStyle = css("--wrong");
  paint.fillStyle = css("--wrong", 0.35);
  paint.lineWidth = isOtherCase ? 1 : 2.5;
  const count = indices.length / size;
  const which = isOtherCase ? Array.from({ length: count }, (_, t) => t) : differing.primitives;
  which.filter((t) => t < count).forEach(draw);
  for (const i of isOtherCase ? [] : differing.points) {
    const list = 2 * i < points.length ? places : view.toScreenAll(patch.points);
    mark(paint, list[2 * i], list[2 * i + 1], 6, css("--wrong"));
  }
}

function mark(paint, x, y, radius, colour, width = 2.5) {
  paint.beginPath();
  paint.arc(x, y, radius, 0, 2 * Math.PI);
  paint.strokeStyle = colour;
  paint.lineWidth = width;
  paint.stroke();
}

function dots(paint, places, view) {
  const count = places.length / 2;
  const radius = Math.min(Math.max(30 / Math.sqrt(count) * Math.sqrt(view.zoom), 0.8), 4);
  paint.fillStyle = css("--point");
  paint.beginPath();
  for (let k = 0; k < places.length; k += 2) {
    const x = places[k], y = places[k + 1];
    if (x < -9 || x > view.width + 9 || y < -9 || y > view.height + 9) continue;
    // Of a pixel or two nobody sees the shape, and squares are faster.
    if (radius < 1) {
      paint.rect(x - radius, y - radius, 2 * radius, 2 * radius);
    } else {
      paint.moveTo(x + radius, y);
      paint.arc(x, y, radius, 0, 7);
    }
  }
  paint.fill();
}

// A square in the exact middle of an even edge, a diamond where an edge is split.
function marks(paint, places) {
  const kinds = patch.view.point_marks();
  paint.lineWidth = 2;
  kinds.forEach((kind, i) => {
    if (kind === 0) return;
    const [x, y] = [places[2 * i], places[2 * i + 1]];
    const square = [[-6, -6], [6, -6], [6, 6], [-6, 6]], diamond = [[0, -8], [8, 0], [0, 8], [-8, 0]];
    path(paint, (kind === 1 ? square : diamond).map(([dx, dy]) => [x + dx, y + dy]));
    paint.strokeStyle = css(kind === 1 ? "--right" : "--wrong");
    paint.stroke();
  });
}

// The element that is asked about: a ring around a point, a thick outline of a primitive, with a light rim.
function highlight(paint, places, pick, colour, width) {
  if (!pick) return;
  const number = Number(pick.slice(1));
  const isPoint = pick[0] === "p";
  if (number >= (isPoint ? places.length / 2 : patch.primitives)) return;
  const corners = isPoint ? [[places[2 * number], places[2 * number + 1]]]
    : cornersOf(places, patch.indices, patch.size, number);
  for (const [stroke, extra] of [["rgb(255 255 255 / 0.9)", 3], [colour, 0]]) {
    if (corners.length === 1) mark(paint, ...corners[0], 8, stroke, width + extra);
    else {
      path(paint, corners, corners.length === 3);
      paint.strokeStyle = stroke;
      paint.lineWidth = width + extra;
      paint.stroke();
    }
  }
}

// Numbers where there is room: each cell of a grid holds one.
function numbers(paint, places, view, shown) {
  if (state.numbers === "none") return;
  const taken = new Set();
  paint.font = "11px system-ui, sans-serif";
  paint.textAlign = "center";
  paint.textBaseline = "middle";
  paint.lineWidth = 3;
  const write = (text, x, y, colour) => {
    if (x < 0 || y < 0 || x > view.width || y > view.height) return;
    const cell = `${Math.round(x / 26)},${Math.round(y / 14)}`;
    if (taken.has(cell)) return;
    taken.add(cell);
    paint.strokeStyle = "rgb(255 255 255 / 0.85)";
    paint.strokeText(text, x, y);
    paint.fillStyle = colour;
    paint.fillText(text, x, y);
  };
  if (state.numbers !== "primitives") {
    for (let i = 0; 2 * i < places.length; i++) write(String(i), places[2 * i], places[2 * i + 1] - 9, "#0b3c68");
  }
  if (state.numbers === "points") return;
  for (let t = 0; t < shown; t++) {
    const corners = cornersOf(places, patch.indices, patch.size, t);
    const middle = (axis) => corners.reduce((sum, corner) => sum + corner[axis], 0) / corners.length;
    write(String(t), middle(0), middle(1), "#8a3b00");
  }
}
