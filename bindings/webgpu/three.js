// A geometry of three.js (its `WebGPURenderer`) that is tessellated: any material and light of three's, shadows included, see
// an indexed BufferGeometry. three.d.ts documents the interface.

import { BufferGeometry, Sphere, Vector3 } from "three/webgpu";
import { need } from "./common.js";
import { CpuSource } from "./three-cpu.js";
import { GpuSource } from "./three-gpu.js";

export class TessellatedGeometry extends BufferGeometry {
  static async load(renderer, options = {}) {
    need(renderer?.isRenderer && renderer.init, "TessellatedGeometry.load takes a WebGPURenderer of three.js");
    await renderer.init();
    const { wgsl = "", vertex } = options;
    need(/\bfn\s+domain\b/.test(wgsl) === (vertex !== undefined), "`vertex` and a function `domain` go together: give both or neither");
    const Source = renderer.backend.isWebGPUBackend ? GpuSource : CpuSource;
    return new TessellatedGeometry(await Source.load(renderer, options));
  }

  // The source gives the attributes, the index and, on the GPU, the indirect draw.
  constructor(source) {
    super();
    this.source = source;
    source.attach(this);
    // Nobody on the CPU knows where a material or `domain` puts the points: nothing is culled unless the caller sets a ball.
    this.boundingSphere = new Sphere(new Vector3(), Infinity);
    this.addEventListener("dispose", () => source.destroy());
  }

  update(values = {}) {
    this.source.update(this, values);
    this.isUpdated = true;
  }

  makeRoom(values = {}) {
    this.isUpdated = true;
    return this.source.makeRoom(this, values);
  }

  // The renderer asks for the attributes when it first draws the geometry.
  getAttribute(name) {
    if (!this.isUpdated) {
      console.warn("TessellatedGeometry: nothing is drawn before its first `update`; call it before the renderer draws");
      this.isUpdated = true;
    }
    return super.getAttribute(name);
  }

  get feedback() {
    return this.source.feedback;
  }
}
