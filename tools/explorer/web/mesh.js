// Triangles with their edges, drawn by WebGL: flat patches and surfaces.

const VERTEX = `#version 300 es
uniform mat4 matrix;
uniform vec3 origin;
in vec3 position;
in vec3 normal;
in vec4 colour;
out vec4 fill;
out vec3 corner;
out vec3 facing;
void main() {
  gl_Position = matrix * vec4(position - origin, 1.0);
  fill = colour;
  facing = normal;
  int k = gl_VertexID % 3;
  corner = vec3(k == 0, k == 1, k == 2);
}`;

// `corner` is 1 at one corner and 0 on the opposite edge: its distance from 0, in pixels, draws the edges.
const FRAGMENT = `#version 300 es
precision highp float;
uniform vec4 edge;
uniform float width;
uniform float lit;
uniform vec3 light;
in vec4 fill;
in vec3 corner;
in vec3 facing;
out vec4 colour;
void main() {
  vec3 pixels = corner / max(fwidth(corner), vec3(1e-9));
  float distance = min(min(pixels.x, pixels.y), pixels.z);
  float light = mix(1.0, 0.45 + 0.55 * abs(dot(normalize(facing), light)), lit);
  float near = width > 0.0 ? 1.0 - smoothstep(width - 0.5, width + 0.5, distance) : 0.0;
  colour = vec4(mix(fill.rgb * light, edge.rgb, near * edge.a), 1.0);
}`;

export class Mesh {
  // `canvas` is drawn on; null where the browser has no WebGL 2.
  static on(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: true });
    return gl ? new Mesh(gl) : null;
  }

  constructor(gl) {
    this.gl = gl;
    this.program = link(gl);
    this.count = 0;
    this.attributes = { position: 3, normal: 3, colour: 4 };
    this.buffers = {};
    for (const name of Object.keys(this.attributes)) {
      this.buffers[name] = gl.createBuffer();
      this.attributes[name] = { size: this.attributes[name], at: gl.getAttribLocation(this.program, name) };
    }
    this.uniforms = {};
    for (const name of ["matrix", "origin", "edge", "width", "lit", "light"]) {
      this.uniforms[name] = gl.getUniformLocation(this.program, name);
    }
  }

  // Three positions (x, y, z) and colours (RGBA, bytes) for each triangle; normals for lit surfaces.
  set(positions, colours, normals = null) {
    this.count = positions.length / 3;
    this.upload("position", positions, this.gl.FLOAT);
    this.upload("colour", colours, this.gl.UNSIGNED_BYTE);
    this.hasNormals = normals !== null;
    if (normals) this.upload("normal", normals, this.gl.FLOAT);
  }

  upload(name, values, type) {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
    const { at, size } = this.attributes[name];
    if (at < 0) return;
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, type, type === gl.UNSIGNED_BYTE, 0, 0);
  }

  clear() {
    this.gl.clearColor(0, 0, 0, 0);
    this.gl.clear(this.gl.COLOR_BUFFER_BIT | this.gl.DEPTH_BUFFER_BIT);
  }

  // Draws the first `triangles`; `edge` is the colour of edges, RGBA from 0 to 1; `light` the
  // direction of the light on a surface.
  draw({ matrix, origin = [0, 0, 0], edge, width = 0.6, light = null, depth = false, triangles = Infinity }) {
    const gl = this.gl;
    gl.viewport(0, 0, gl.canvas.width, gl.canvas.height);
    this.clear();
    if (depth) gl.enable(gl.DEPTH_TEST); else gl.disable(gl.DEPTH_TEST);
    if (this.count === 0) return;
    if (!this.hasNormals) {
      gl.disableVertexAttribArray(this.attributes.normal.at);
      gl.vertexAttrib3f(this.attributes.normal.at, 0, 0, 1);
    }
    gl.useProgram(this.program);
    gl.uniformMatrix4fv(this.uniforms.matrix, false, matrix);
    gl.uniform3fv(this.uniforms.origin, origin);
    gl.uniform4fv(this.uniforms.edge, edge);
    gl.uniform1f(this.uniforms.width, width);
    gl.uniform1f(this.uniforms.lit, light ? 1 : 0);
    gl.uniform3fv(this.uniforms.light, light ?? [0, 0, 1]);
    gl.drawArrays(gl.TRIANGLES, 0, Math.min(this.count, 3 * triangles));
  }
}

function link(gl) {
  const program = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

// A canvas as large as it is shown, in device pixels; whether its size changed.
export function fit(canvas) {
  const ratio = devicePixelRatio || 1;
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
  const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  if (canvas.width === width && canvas.height === height) return false;
  Object.assign(canvas, { width, height });
  return true;
}

const colours = new Map();

// A colour of the style sheet, as numbers from 0 to 1. Asking the browser makes it lay the page out.
export function colourOf(name) {
  const key = `${document.documentElement.dataset.theme} ${name}`;
  if (!colours.has(key)) colours.set(key, readColour(name));
  return colours.get(key);
}

function readColour(name) {
  const text = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  return [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16) / 255);
}
