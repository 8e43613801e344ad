// Runs batches of a manifest: pipelines, buffers and dispatches. A host with its own manifest, such as the explorer's, gives
// `source`, the WGSL, with each of its stages. docs/shaders.md explains the manifest.

import { bindingType, needArray, needEncoder, refuse, value } from "./common.js";

// The pipelines of a device, each made once.
export class Pipelines {
  constructor(device) {
    Object.assign(this, { device, made: new Map() });
  }

  // Those of these stages of a manifest, by name.
  async of(stages) {
    return new Map(await Promise.all(stages.map(async (stage) => [stage.name, await this.#one(stage)])));
  }

  #one({ entry_point: entryPoint, bindings, source: code }) {
    const { device, made } = this, key = entryPoint + code;
    if (made.has(key)) return made.get(key);
    // An explicit layout, because some stages do not use all of their bindings.
    const entries = bindings.map(({ binding, kind, is_written }) => ({
      binding, visibility: GPUShaderStage.COMPUTE, buffer: { type: kind === "uniform" ? kind : bindingType(is_written) },
    }));
    const layout = device.createPipelineLayout({ bindGroupLayouts: [device.createBindGroupLayout({ entries })] });
    const module = device.createShaderModule({ label: entryPoint, code });
    made.set(key, device.createComputePipelineAsync({ layout, compute: { module, entryPoint } }));
    return made.get(key);
  }
}

// Submits an encoder and returns the words of these buffers as it leaves them.
export async function readBack(device, encoder, buffers) {
  const copies = buffers.map((buffer) => {
    const { size } = buffer;
    const copy = device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    encoder.copyBufferToBuffer(buffer, 0, copy, 0, size);
    return copy;
  });
  device.queue.submit([encoder.finish()]);
  return Promise.all(copies.map(async (copy) => {
    await copy.mapAsync(GPUMapMode.READ);
    const words = new Uint32Array(copy.getMappedRange().slice(0));
    copy.destroy();
    return words;
  }));
}

export class Batch {
  constructor({ device, manifest, tables, pipelines }, patches, { points, primitives }, given = {}, without = []) {
    for (const [name, count] of Object.entries({ patches, points, primitives })) {
      if (!Number.isInteger(count)) throw new RangeError(`batch takes a whole number of ${name}, not ${count}`);
    }
    const plan = manifest.plans.find((plan) => plan.min_patches <= patches && patches <= plan.max_patches);
    if (!plan || points > plan.max_points || primitives > plan.max_primitives) {
      throw new RangeError(`${patches} patches, ${points} points, ${primitives} primitives: not one batch`);
    }
    const { maxComputeWorkgroupsPerDimension: max_workgroups, maxStorageBufferBindingSize: most } = device.limits;
    const numbers = { patches, points: Math.max(points, 1), primitives: Math.max(primitives, 1), max_workgroups };
    const of = (formula) => value(formula, numbers);
    const { STORAGE, COPY_DST, COPY_SRC, UNIFORM, INDIRECT, VERTEX, INDEX } = GPUBufferUsage;
    const also = { job: UNIFORM, arguments: INDIRECT, points: VERTEX, indices: INDEX };
    // What is not written has no buffer, and nothing runs that would write it.
    const isNeeded = ({ resource }) => !without.includes(resource);
    const dispatches = plan.dispatches.filter(({ bindings }) => bindings.every(isNeeded));
    const large = dispatches.flatMap(({ bindings }) => bindings).find(({ bytes }) => of(bytes) > most);
    if (large) throw new RangeError(`${large.resource} has ${of(large.bytes)} bytes; the device binds ${most}`);
    const make = (label, size) => device.createBuffer({ label, size, usage: STORAGE | COPY_DST | COPY_SRC | also[label] });
    // The caller's and the tessellator's buffers are not this batch's to free.
    this.kept = { tables, ...given };
    this.buffers = Object.fromEntries(plan.buffers.filter(isNeeded).map(({ resource, bytes }) =>
      [resource, this.kept[resource] ?? make(resource, of(bytes))]));
    const stride = manifest.job_stride / 4;
    const words = new Uint32Array(stride * plan.jobs.length);
    plan.jobs.forEach((job, number) => words.set(job.map(of), stride * number));
    device.queue.writeBuffer(this.buffers.job, 0, words);
    this.device = device;
    this.dispatches = dispatches.map(({ stage, bindings, workgroups }) => {
      const entries = bindings.map(({ resource, offset, bytes }, binding) =>
        ({ binding, resource: { buffer: this.buffers[resource], offset: of(offset), size: of(bytes) } }));
      const pipeline = pipelines.get(stage);
      const group = device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries });
      if ("indirect_at" in workgroups) return { pipeline, group, at: of(workgroups.indirect_at) };
      const count = of(workgroups.direct), x = Math.min(count, max_workgroups);
      return { pipeline, group, rows: [x, Math.ceil(count / x)] };
    });
  }

  encode(encoder) {
    needEncoder("encode", encoder);
    const pass = encoder.beginComputePass();
    for (const { pipeline, group, at, rows } of this.dispatches) {
      pass.setPipeline(pipeline);
      pass.setBindGroup(0, group);
      if (rows) pass.dispatchWorkgroups(...rows);
      else pass.dispatchWorkgroupsIndirect(this.buffers.arguments, at);
    }
    pass.end();
  }

  async read(names) {
    needArray("read", names, '["status"]');
    const unknown = names.find((name) => !Object.hasOwn(this.buffers, name));
    if (unknown !== undefined) refuse("buffer", unknown, Object.keys(this.buffers));
    const encoder = this.device.createCommandEncoder();
    this.encode(encoder);
    const words = await readBack(this.device, encoder, names.map((name) => this.buffers[name]));
    return Object.fromEntries(names.map((name, i) => [name, words[i]]));
  }

  destroy() {
    for (const [name, buffer] of Object.entries(this.buffers)) if (!this.kept[name]) buffer.destroy();
  }
}
