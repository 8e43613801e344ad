// The source of a geometry where three.js draws with WebGL 2: the CPU backend, in WebAssembly, fills the same attributes.

import { BufferAttribute } from "three/webgpu";
import { need, needMost, needPatches } from "./common.js";

export class CpuSource {
  static async load(_, { wgsl = "", uniforms, domain, partitioning, patches }) {
    need(wgsl === "" && !uniforms, "the renderer draws with WebGL 2, which runs no WGSL: leave out `wgsl` and `uniforms`, give " +
      "the factors to `update`, and move the points in the material's `positionNode`; or use a browser that has WebGPU");
    needMost("TessellatedGeometry.load", patches);
    const cpu = await import("./cpu/tess_webgpu_cpu.js");
    await cpu.default({ module_or_path: new URL("./cpu/tess_webgpu_cpu_bg.wasm", import.meta.url) });
    const tessellator = new cpu.CpuTessellator(domain, partitioning);
    const each = tessellator.factors_per_patch();
    return Object.assign(new CpuSource(), { tessellator, domain, patches, each, frame: 0, factors: new Float32Array(patches * each) });
  }

  // Before the first `update` there are no points.
  attach(geometry) {
    this.#fill(geometry, 0);
  }

  // Fills the attributes with these first patches, and returns the numbers of points and indices.
  #fill(geometry, patches) {
    this.tessellator.tessellate(this.factors.subarray(0, patches * this.each));
    const [positions, indices] = [this.tessellator.positions(), this.tessellator.indices()];
    const uv = new Float32Array(positions.length / 3 * 2);
    for (let i = 0; i < uv.length / 2; i++) uv.set(positions.subarray(3 * i, 3 * i + 2), 2 * i);
    // WebGL 2 has no indirect draw and buffers of a fixed size, so attributes that are too small are replaced.
    const put = (name, array, size) => {
      const old = name === "index" ? geometry.index : geometry.attributes[name];
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
    return [positions.length / 3, indices.length];
  }

  update(geometry, { factors, patches = this.patches, instances = 1, ...values }) {
    const [unknown] = Object.keys(values);
    need(unknown === undefined, `there is no uniform \`${unknown}\``);
    need(instances === 1, "with WebGL 2, draw instances with an `InstancedMesh`");
    const { each } = this;
    needPatches("update", patches, this.patches);
    if (factors) {
      need(Number.isInteger(factors.length / each) && typeof factors !== "string", `factors are an array of numbers, ${each} for each patch`);
      needPatches("update", factors.length / each, this.patches);
      this.factors.set(factors);
    }
    const [points, indices] = this.#fill(geometry, patches);
    const primitives = indices / (this.domain === "isoline" ? 2 : 3);
    this.feedback = { frame: this.frame++, points, primitives, drawn: primitives, scale: 1 };
  }

  async makeRoom(geometry, values) {
    this.update(geometry, values);
    return this.feedback;
  }

  // A disposed geometry may be updated again, so the tessellator is left to the garbage collector.
  destroy() {}
}
