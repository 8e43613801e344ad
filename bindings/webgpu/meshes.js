// The meshes of a stage: patches from a first one on, up to those of the next mesh, that are drawn one by one. After the
// batch, a pass makes the arguments of a draw for each.

import { bindGroup, typeOf } from "./common.js";

// Bytes of an indexed indirect draw, and where its number of instances is.
export const DRAW_BYTES = 20, INSTANCES_AT = 4;

// The pass of a manifest on a device, which serves every set of meshes.
export async function meshPass(device, { groups: pass, parts, job_stride }) {
  const entries = pass.bindings.map((one) =>
    ({ binding: one.binding, visibility: GPUShaderStage.COMPUTE, buffer: { type: typeOf(one) } }));
  const group = device.createBindGroupLayout({ entries });
  const module = device.createShaderModule({ label: "meshes", code: parts.groups });
  const layout = device.createPipelineLayout({ bindGroupLayouts: [group] });
  const pipeline = await device.createComputePipelineAsync({ layout, compute: { module, entryPoint: pass.entry_point } });
  return { pipeline, layout: group, bindings: pass.bindings, job_stride };
}

export class Meshes {
  // `first` has the number of each mesh's first patch, of at most so many patches.
  constructor(device, { workgroup_size }, first, patches) {
    first.forEach((one, number) => {
      const least = number > 0 ? first[number - 1] : 0;
      if (!(Number.isInteger(one) && least <= one && one <= patches)) {
        throw new RangeError(`mesh ${number} begins at patch ${one}: it takes a whole number from ${least}, where the one before it ` +
          `begins, to ${patches}`);
      }
    });
    const { STORAGE, COPY_DST, COPY_SRC, INDIRECT } = GPUBufferUsage;
    const make = (label, each, usage) => device.createBuffer({ label, size: each * first.length, usage: STORAGE | COPY_DST | usage });
    this.groups = make("meshes", 4, 0);
    this.draws = make("draws of meshes", DRAW_BYTES, INDIRECT | COPY_SRC);
    device.queue.writeBuffer(this.groups, 0, new Uint32Array(first));
    Object.assign(this, { device, count: first.length, workgroups: Math.ceil(first.length / workgroup_size), bound: new WeakMap() });
  }

  // Records the pass after a batch with these buffers, and copies the number of instances into each draw.
  encode(encoder, { pipeline, layout, bindings, job_stride }, buffers, [header, at]) {
    if (!this.bound.has(buffers)) {
      const all = { ...buffers, groups: this.groups, draws: this.draws };
      this.bound.set(buffers, bindGroup(this.device, layout, bindings, all, job_stride));
    }
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, this.bound.get(buffers));
    pass.dispatchWorkgroups(this.workgroups);
    pass.end();
    for (let mesh = 0; mesh < this.count; mesh++) {
      encoder.copyBufferToBuffer(header, at, this.draws, DRAW_BYTES * mesh + INSTANCES_AT, 4);
    }
  }

  destroy() {
    [this.groups, this.draws].forEach((one) => one.destroy());
  }
}
