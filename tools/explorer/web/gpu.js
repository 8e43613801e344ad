// Runs a batch of `tess-gpu` on WebGPU: shaders, buffers and dispatches come from its manifest.

import { GpuTables } from "./tess_explorer.js";

// Lines of the shaders' `place` that a planted fault changes: where factors are fractional, and where they are integers.
const FAULTS = [
  ["fraction_of(context) + HALF) >> 16u", "fraction_of(context) + HALF + HALF) >> 16u"],
  ["min(position, mirror) * context.y", "min(position, mirror) * context.y + 1u"],
];

let opened = null;

// The device, or an error that says why there is none.
export function open() {
  opened ??= openDevice();
  return opened;
}

async function openDevice() {
  if (!navigator.gpu) throw new Error("this browser has no WebGPU");
  const adapter = await navigator.gpu.requestAdapter();
  if (!adapter) throw new Error("this browser has WebGPU but no adapter");
  return new Gpu(await adapter.requestDevice());
}

class Gpu {
  constructor(device) {
    this.device = device;
    this.pipelines = new Map();
    this.tables = new Map();
    device.lost.then(() => (opened = null));
  }

  // Makes buffers, pipelines and bind groups of a batch.
  async prepare(batch, hasFault = false) {
    const manifest = JSON.parse(batch.manifest());
    const buffers = this.buffers(manifest, batch);
    const steps = [];
    // All are compiled at the same time.
    const pipelines = await Promise.all(manifest.dispatches.map(({ stage }) => {
      const { source, bindings } = manifest.stages[stage];
      return this.pipeline(stage, hasFault ? damaged(source) : source, bindings);
    }));
    for (const [number, step] of manifest.dispatches.entries()) {
      const pipeline = pipelines[number];
      const entries = step.bindings.map(([resource, offset, size], binding) =>
        ({ binding, resource: { buffer: buffers[resource], offset, size } }));
      const group = this.device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries });
      steps.push({ ...step, pipeline, group });
    }
    return { manifest, buffers, steps };
  }

  buffers(manifest, batch) {
    const filled = { Job: batch.jobs(), Factors: batch.factors() };
    const buffers = {};
    for (const [name, bytes] of Object.entries(manifest.buffers)) {
      if (name === "Tables") continue;
      const usage = (name === "Job" ? GPUBufferUsage.UNIFORM : GPUBufferUsage.STORAGE)
        | (name === "Points" ? GPUBufferUsage.VERTEX : name === "Indices" ? GPUBufferUsage.INDEX : 0)
        | (name === "Arguments" || name === "Draws" ? GPUBufferUsage.INDIRECT : 0)
        | GPUBufferUsage.COPY_SRC | GPUBufferUsage.COPY_DST;
      buffers[name] = this.device.createBuffer({ label: name, size: Math.max(16, Math.ceil(bytes / 16) * 16), usage });
      if (filled[name]) this.device.queue.writeBuffer(buffers[name], 0, filled[name]);
    }
    buffers.Tables = this.tablesOf(manifest.split);
    return buffers;
  }

  tablesOf(split) {
    if (!this.tables.has(split)) {
      const words = GpuTables.words(split);
      const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST;
      const buffer = this.device.createBuffer({ label: "Tables", size: words.byteLength, usage });
      this.device.queue.writeBuffer(buffer, 0, words);
      this.tables.set(split, buffer);
    }
    return this.tables.get(split);
  }

  async pipeline(entryPoint, code, bindings) {
    const key = entryPoint + code;
    if (!this.pipelines.has(key)) {
      const entries = bindings.map((type, binding) =>
        ({ binding, visibility: GPUShaderStage.COMPUTE, buffer: { type } }));
      const layout = this.device.createPipelineLayout(
        { bindGroupLayouts: [this.device.createBindGroupLayout({ entries })] });
      const module = this.device.createShaderModule({ label: entryPoint, code });
      this.pipelines.set(key, this.device.createComputePipelineAsync({ layout, compute: { module, entryPoint } }));
    }
    return this.pipelines.get(key);
  }

  encode({ steps, buffers }, encoder) {
    const pass = encoder.beginComputePass();
    for (const { pipeline, group, workgroups, indirect } of steps) {
      pass.setPipeline(pipeline);
      pass.setBindGroup(0, group);
      if (workgroups) pass.dispatchWorkgroups(...workgroups);
      else pass.dispatchWorkgroupsIndirect(buffers.Arguments, indirect);
    }
    pass.end();
  }

  // Runs a prepared batch; resolves when the device is done.
  async run(prepared, times = 1) {
    const encoder = this.device.createCommandEncoder();
    for (let k = 0; k < times; k++) this.encode(prepared, encoder);
    this.device.queue.submit([encoder.finish()]);
    await this.device.queue.onSubmittedWorkDone();
  }

  // The words of a buffer, read back.
  async read(buffer, bytes) {
    const size = Math.max(4, Math.ceil(bytes / 4) * 4);
    const staging = this.device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    const encoder = this.device.createCommandEncoder();
    encoder.copyBufferToBuffer(buffer, 0, staging, 0, size);
    this.device.queue.submit([encoder.finish()]);
    await staging.mapAsync(GPUMapMode.READ);
    const words = new Uint32Array(staging.getMappedRange().slice(0));
    staging.destroy();
    return words.subarray(0, bytes / 4);
  }

  release({ buffers }) {
    for (const [name, buffer] of Object.entries(buffers)) if (name !== "Tables") buffer.destroy();
  }

  // Output of the shaders for a batch: the points, two words each, and the indices.
  async tessellate(batch, hasFault = false) {
    this.device.pushErrorScope("validation");
    const prepared = await this.prepare(batch, hasFault);
    await this.run(prepared);
    const status = await this.read(prepared.buffers.Status, 32);
    const [points, , primitives] = status;
    const each = prepared.manifest.index_bytes;
    const result = {
      // Shaders that count wrong are told apart by what lies in the buffers.
      points: await this.read(prepared.buffers.Points, Math.min(8 * points, prepared.manifest.buffers.Points)),
      indices: await this.read(prepared.buffers.Indices, Math.min(each * primitives, prepared.manifest.buffers.Indices)),
    };
    this.release(prepared);
    const error = await this.device.popErrorScope();
    if (error) throw new Error(error.message);
    return result;
  }
}

function damaged(source) {
  return FAULTS.reduce((text, [right, wrong]) => text.replace(right, wrong), source);
}
