// Where a surface is looked at from, z up.

// The direction of the eye from the centre, in radians, and its distance in radii.
const HOME = { turn: 0.7, lift: 0.45, far: 2.4 };

export const toText = ({ turn, lift, far }) => [turn, lift, far].map((part) => part.toFixed(3)).join(",");

// The orbit of a text; where that is none, `otherwise`.
export function fromText(text, otherwise = HOME) {
  const [turn, lift, far] = text.split(",").map(Number);
  return [turn, lift, far].every(Number.isFinite) ? { turn, lift, far } : otherwise;
}

// Turned by these angles in radians, and further away by this factor.
export function moved({ turn, lift, far }, by, up, away) {
  const within = (value, low, high) => Math.min(Math.max(value, low), high);
  return { turn: turn + by, lift: within(lift + up, -1.5, 1.5), far: within(far * away, 1.15, 12) };
}

// The eye's place. `sphere` is around the surface: centre and radius.
export function eyeOf({ turn, lift, far }, [x, y, z, radius]) {
  const along = far * radius * Math.cos(lift);
  return [x + along * Math.cos(turn), y + along * Math.sin(turn), z + far * radius * Math.sin(lift)];
}

// The direction to the light: over the eye's shoulder.
export function lightOf({ far }, eye, [x, y, z, radius]) {
  const towards = [eye[0] - x, eye[1] - y, eye[2] - z + 0.8 * radius * far / 2];
  return towards.map((part) => part / Math.hypot(...towards));
}

// Perspective from the eye to the centre, column by column; depths from -1 to 1, as WebGL has them.
export function projection(eye, [cx, cy, cz, radius], aspect) {
  const subtract = (a, b) => a.map((part, k) => part - b[k]);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => a.map((part) => part / Math.hypot(...a));
  const forward = unit(subtract([cx, cy, cz], eye));
  const right = unit(cross(forward, [0, 0, 1])), up = cross(right, forward);
  const far = 20 * radius, near = 0.02 * radius, open = 2.2;
  const sx = open / Math.max(aspect, 1), sy = sx * aspect;
  const rows = [[...right.map((p) => p * sx), -dot(right, eye) * sx], [...up.map((p) => p * sy), -dot(up, eye) * sy]];
  const depth = (far + near) / (far - near), shift = -2 * far * near / (far - near);
  rows.push([...forward.map((p) => p * depth), -dot(forward, eye) * depth + shift]);
  rows.push([...forward, -dot(forward, eye)]);
  return [0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]));
}
