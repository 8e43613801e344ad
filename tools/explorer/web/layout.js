// From domain points to pixels. Quads and isolines fill a square, u to the right, v down. Triangles are
// equilateral with w = 1 at the top, u = 1 at the right, v = 1 at the left, as in the pictures of `tess draw`.

const ONE = 65536;

export class Layout {
  constructor(domain) {
    this.triangle = domain === "tri";
    this.alongU = this.triangle ? [0.5, Math.sqrt(0.75)] : [1, 0];
    this.alongV = this.triangle ? [-0.5, Math.sqrt(0.75)] : [0, 1];
    // The middle of the picture: half way down a triangle.
    this.home = this.triangle ? [ONE / 4, ONE / 4] : [ONE / 2, ONE / 2];
    this.corners = this.triangle ? [[0, ONE], [0, 0], [ONE, 0]] : [[0, 0], [ONE, 0], [ONE, ONE], [0, ONE]];
  }
}

// The part of the plane that is seen: its centre in units of 16.16 and the magnification.
export class View {
  constructor(layout) {
    this.layout = layout;
    this.width = this.height = 1;
    this.reset();
  }

  reset() {
    [this.u, this.v] = this.layout.home;
    this.zoom = 1;
  }

  // Pixels per unit of 16.16.
  get scale() {
    return 0.9 * Math.min(this.width, this.height) * this.zoom / ONE;
  }

  toScreen(u, v) {
    const { alongU: a, alongV: b } = this.layout;
    const s = this.scale, du = u - this.u, dv = v - this.v;
    return [this.width / 2 + s * (a[0] * du + b[0] * dv), this.height / 2 + s * (a[1] * du + b[1] * dv)];
  }

  // x and y of all points.
  toScreenAll(points) {
    const places = new Float64Array(points.length);
    for (let k = 0; k < points.length; k += 2) places.set(this.toScreen(points[k], points[k + 1]), k);
    return places;
  }

  toDomain(x, y) {
    const { alongU: a, alongV: b } = this.layout;
    const s = this.scale, px = (x - this.width / 2) / s, py = (y - this.height / 2) / s;
    const determinant = a[0] * b[1] - a[1] * b[0];
    return [this.u + (px * b[1] - py * b[0]) / determinant, this.v + (py * a[0] - px * a[1]) / determinant];
  }

  pan(dx, dy) {
    [this.u, this.v] = this.toDomain(this.width / 2 - dx, this.height / 2 - dy);
  }

  // Magnifies by `factor`; what is at (x, y) stays there.
  magnify(factor, x = this.width / 2, y = this.height / 2) {
    const before = this.toDomain(x, y);
    this.zoom = Math.min(Math.max(this.zoom * factor, 0.2), 20000);
    const after = this.toDomain(x, y);
    this.u += before[0] - after[0];
    this.v += before[1] - after[1];
  }

  // The matrix for mesh.js, whose origin is (u, v).
  matrix() {
    const { alongU: a, alongV: b } = this.layout;
    const sx = 2 * this.scale / this.width, sy = -2 * this.scale / this.height;
    return [sx * a[0], sy * a[1], 0, 0, sx * b[0], sy * b[1], 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  }

  toText() {
    const isHome = this.zoom === 1 && this.u === this.layout.home[0] && this.v === this.layout.home[1];
    return isHome ? "" : [this.u.toFixed(2), this.v.toFixed(2), this.zoom.toPrecision(6)].join(",");
  }

  fromText(text) {
    const [u, v, zoom] = text.split(",").map(Number);
    if ([u, v, zoom].every(Number.isFinite) && zoom > 0) Object.assign(this, { u, v, zoom });
    else this.reset();
  }
}
