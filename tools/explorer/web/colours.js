// Colours of triangles, by their meaning.

import { colourOf } from "./mesh.js";

const LEGENDS = {
  order: "From the first primitive to the last: blue, green, yellow.",
  rings: "Orange: transitions, from an outer edge to the first ring. Blue: stitches between rings. Green: the centre.",
  orientation: "Red: flipped triangles. Lines in amber: triangles without any area, also where they are too thin to see.",
  slivers: "Red where a triangle is thin: its area, compared with an equilateral one of the same edges (mean square).",
  plain: "",
};

const WRONG = [0xe5, 0x39, 0x35];
const RIGHT = [0xdc, 0xe9, 0xf5];

export const legend = (colours) => LEGENDS[colours] ?? "";

// Red, green and blue of each triangle.
export function fills({ view, points, indices, parts }, colours) {
  if (colours === "slivers") return slivers(points, indices, parts.domain === "tri");
  if (colours !== "orientation") return view.fills(colours);
  const areas = view.areas(), fill = new Uint8Array(3 * areas.length);
  areas.forEach((area, t) => fill.set(area < 0 ? WRONG : RIGHT, 3 * t));
  return fill;
}

// 1 for an equilateral triangle, 0 for one without area: 4 sqrt(3) area / (sum of squared edges).
function quality(points, [a, b, c], isTriangle) {
  const place = (i) => {
    const u = points[2 * i], v = points[2 * i + 1];
    return isTriangle ? [(u - v) / 2, (u + v) * Math.sqrt(0.75)] : [u, v];
  };
  const [p, q, r] = [place(a), place(b), place(c)];
  const squared = (s, t) => (s[0] - t[0]) ** 2 + (s[1] - t[1]) ** 2;
  const sum = squared(p, q) + squared(q, r) + squared(r, p);
  const doubled = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  return sum === 0 ? 0 : 2 * Math.sqrt(3) * Math.abs(doubled) / sum;
}

function slivers(points, indices, isTriangle) {
  const fill = new Uint8Array(indices.length);
  for (let k = 0; k < indices.length; k += 3) {
    const good = quality(points, indices.subarray(k, k + 3), isTriangle) ** 0.7;
    for (let channel = 0; channel < 3; channel++) {
      fill[k + channel] = WRONG[channel] + (RIGHT[channel] - WRONG[channel]) * good;
    }
  }
  return fill;
}

// A colour of the style sheet for a canvas.
export function css(name, alpha = 1) {
  const [red, green, blue] = colourOf(name).map((part) => Math.round(255 * part));
  return `rgb(${red} ${green} ${blue} / ${alpha})`;
}
