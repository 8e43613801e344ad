// The source of a geometry where three.js draws with WebGL 2: the CPU backend, in WebAssembly, fills the same attributes.

import { BufferAttribute } from "three/webgpu";
import { need } from "./common.js";

const FACTORS = { isoline: 2, tri: 4, quad: 6 };

export class CpuSource {
  static async load(_, { wgsl = "", uniforms, domain, partitioning, patches }) {
    need(wgsl === "" && !uniforms, "the renderer draws with WebGL 2, which runs no WGSL: leave out `wgsl` and `uniforms`, give " +
      "the factors to `update`, and move the points in the material's `positionNode`; or use a browser that has WebGPU");
    const cpu = await import("./cpu/tess_webgpu_cpu.js");
    await cpu.default({ module_or_path: new URL("./cpu/tess_webgpu_cpu_bg.wasm", import.meta.url) });
    const source = Object.assign(new CpuSource(), { cpu, domain, partitioning, patches, frame: 0 });
    // Culled patches, so that mistakes in the names are reported here.
    source.factors = new Float32Array(FACTORS[domain] ?? 0);
    source.output = source.#tessellate();
    source.factors = new Float32Array(patches * FACTORS[domain]);
    return source;
  }

  #tessellate() {
    const output = this.cpu.tessellate(this.domain, this.partitioning, this.factors);
    const [positions, indices] = [output.positions(), output.indices()];
    output.free();
    return { positions, indices };
  }

  attach(geometry) {
    this.#fill(geometry);
  }

  #fill(geometry) {
    const { positions, indices } = this.output;
    const uv = new Float32Array(positions.length / 3 * 2);
    for (let i = 0; i < uv.length / 2; i++) uv.set(positions.subarray(3 * i, 3 * i + 2), 2 * i);
    // WebGL 2 has no indirect draw and buffers of a fixed size, so attributes that are too small are replaced.
    const put = (name, array, size) => {
      const old = name === "index" ? geometry.index : geometry.getAttribute(name);
      if (old && old.array.length >= array.length) {
        old.array.set(array);
        old.needsUpdate = true;
        return;
      }
      const room = new array.constructor(Math.ceil(array.length * 3 / 2 / size) * size || size);
      room.set(array);
      const made = new BufferAttribute(room, size);
      if (name === "index") geometry.setIndex(made);
      else geometry.setAttribute(name, made);
    };
    put("position", positions, 3);
    put("uv", uv, 2);
    put("index", indices, 1);
    geometry.setDrawRange(0, indices.length);
  }

  update(geometry, { factors, patches = this.patches, instances = 1, ...values }) {
    const [unknown] = Object.keys(values);
    need(unknown === undefined, `there is no uniform \`${unknown}\``);
    need(instances === 1, "with WebGL 2, draw instances with an `InstancedMesh`");
    const each = FACTORS[this.domain];
    if (factors) {
      need(Number.isInteger(factors.length / each) && typeof factors !== "string", `factors are an array of numbers, ${each} for each patch`);
      if (factors.length > this.factors.length) throw new RangeError(`${factors.length / each} patches; the geometry was made for ${this.patches}`);
      this.factors.set(factors);
    }
    const all = this.factors;
    this.factors = all.subarray(0, patches * each);
    this.output = this.#tessellate();
    this.factors = all;
    this.#fill(geometry);
    const { indices, positions } = this.output;
    const primitives = indices.length / (this.domain === "isoline" ? 2 : 3);
    this.feedback = { frame: this.frame++, points: positions.length / 3, primitives, drawn: primitives, scale: 1 };
  }

  async makeRoom(geometry, values) {
    this.update(geometry, values);
    return this.feedback;
  }

  destroy() {}
}
