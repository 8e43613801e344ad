// Runs batches of `tess-gpu` on WebGPU. The host is that of `bindings/webgpu`; shaders, buffers and dispatches come from the
// batch's manifest.

import { Batch, Pipelines, readBack } from "./batch.js";
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
    Object.assign(this, { device, pipelines: new Pipelines(device), tables: new Map() });
    device.lost.then(() => (opened = null));
  }

  // Makes buffers, pipelines and bind groups of a batch.
  async prepare(batch, hasFault = false) {
    const manifest = JSON.parse(batch.manifest());
    const { stages, setup, plans: [{ max_patches: patches }] } = manifest;
    const chosen = hasFault ? stages.map((stage) => ({ ...stage, source: damaged(stage.source) })) : stages;
    const pipelines = await this.pipelines.of(chosen);
    const tables = this.tablesOf(setup.split);
    // The manifest is that of this batch, with its room.
    const made = new Batch({ device: this.device, manifest, tables, pipelines }, patches, { points: 1, primitives: 1 });
    this.device.queue.writeBuffer(made.buffers.factors, 0, batch.factors());
    return Object.assign(made, { primitiveBytes: setup.primitive_bytes });
  }

  tablesOf(split) {
    if (!this.tables.has(split)) {
      const words = GpuTables.words(split);
      const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST;
      const buffer = this.device.createBuffer({ label: "tables", size: words.byteLength, usage });
      this.device.queue.writeBuffer(buffer, 0, words);
      this.tables.set(split, buffer);
    }
    return this.tables.get(split);
  }

  // Runs a prepared batch; resolves when the device is done.
  async run(prepared, times = 1) {
    const encoder = this.device.createCommandEncoder();
    for (let k = 0; k < times; k++) prepared.encode(encoder);
    this.device.queue.submit([encoder.finish()]);
    await this.device.queue.onSubmittedWorkDone();
  }

  // The words of a buffer, as the last run left them.
  async read(buffer) {
    return (await readBack(this.device, this.device.createCommandEncoder(), [buffer]))[0];
  }

  // Output of the shaders for a batch: the points, two words each, and the indices.
  async tessellate(batch, hasFault = false) {
    this.device.pushErrorScope("validation");
    const prepared = await this.prepare(batch, hasFault);
    const { status: [points, , primitives], ...all } = await prepared.read(["status", "points", "indices"]);
    prepared.destroy();
    const error = await this.device.popErrorScope();
    if (error) throw new Error(error.message);
    // Shaders that count wrong are told apart by what lies in the buffers.
    return { points: all.points.subarray(0, 2 * points), indices: all.indices.subarray(0, prepared.primitiveBytes / 4 * primitives) };
  }
}

function damaged(source) {
  return FAULTS.reduce((text, [right, wrong]) => text.replace(right, wrong), source);
}
