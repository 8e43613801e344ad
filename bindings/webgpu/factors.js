// Factor rules on the CPU, for factors that a page computes itself and writes to `batch.buffers.factors`. They are
// the functions for straight edges and insides of shaders/surfaces/factors.wgsl. Each step is rounded to binary32, so
// the results have the bits of the Rust and C functions. Both patches of an edge get the same factor, whichever end
// comes first, so no crack opens. factors.d.ts has the interface.

const f32 = Math.fround;

const middle = (a, b) => a.map((from, i) => f32(f32(from + b[i]) * 0.5));

function distance(a, b) {
  const [x, y, z] = a.map((from, i) => f32(from - b[i]));
  return f32(Math.sqrt(f32(f32(f32(x * x) + f32(y * y)) + f32(z * z))));
}

// dividend / divisor within 1 to 64, also for a divisor of 0; 1 unless both are numbers and dividend > divisor >= 0.
function quotient(dividend, divisor) {
  if (!(dividend > divisor && divisor >= 0)) return 1;
  return f32(dividend / 64) >= divisor ? 64 : clampFactor(f32(dividend / divisor));
}

// This many numbers, rounded to binary32 as in a typed array.
function rounded(numbers, count = 3) {
  const own = Array.from(numbers ?? [], f32);
  if (own.length === count) return own;
  throw new TypeError(`${count === 3 ? "a point or the edges of a triangle are" : "the edges of a quad are"} an array of ` +
    `${count} numbers, not ${JSON.stringify(numbers)}`);
}

export function clampFactor(factor) {
  return f32(factor) > 1 ? Math.min(f32(factor), 64) : 1;
}

export function edgeByScreenSize(a, b, eye, pixelsPerUnit, segment) {
  [a, b, eye] = [a, b, eye].map((point) => rounded(point));
  const pixels = f32(distance(a, b) * f32(pixelsPerUnit));
  return quotient(pixels, f32(distance(eye, middle(a, b)) * f32(segment)));
}

export function edgeByLength(a, b, pixelsPerUnit, segment) {
  return quotient(f32(distance(rounded(a), rounded(b)) * f32(pixelsPerUnit)), f32(segment));
}

export function edgeByDistance(a, b, eye, scale) {
  [a, b, eye] = [a, b, eye].map((point) => rounded(point));
  return quotient(f32(scale), distance(eye, middle(a, b)));
}

export function edgeBesideHalves(factor) {
  let whole = 2;
  while (whole < clampFactor(factor)) whole *= 2;
  return [whole, whole / 2];
}

export function atMost(factor, most) {
  return f32(factor) > f32(most) ? f32(most) : f32(factor);
}

export function insideQuad(edges) {
  const [u0, v0, u1, v1] = rounded(edges, 4);
  return [f32(f32(v0 + v1) * 0.5), f32(f32(u0 + u1) * 0.5)];
}

export function insideTriangle(edges) {
  const [u, v, w] = rounded(edges);
  return f32(u + f32(f32(f32(v - u) + f32(w - u)) / 3));
}
