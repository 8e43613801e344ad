// Runs the shaders next to this file on a WebGPU device. tess.d.ts documents the interface, docs/shaders.md the manifest.

import { SHADERS, bindingType, get, need, needArray, needEncoder, refuse, value } from "./common.js";

export const unpackWgsl = `
struct TessPoint { uv: vec2f, of_patch: u32 }
fn tess_point(packed: vec2u) -> TessPoint {
    let v = (packed.x >> 17u) | ((packed.y & 3u) << 15u);
    return TessPoint(vec2f(vec2u(packed.x & 0x1ffffu, v)) / 65536.0, packed.y >> 2u);
}`;

export async function openDevice() {
  const adapter = await globalThis.navigator?.gpu?.requestAdapter();
  if (adapter) return adapter.requestDevice();
  throw new Error(globalThis.navigator?.gpu
    ? "the browser has WebGPU but no adapter; update the graphics driver, or look at chrome://gpu or about:support"
    : "there is no WebGPU here; use a browser that has it, and a page from https or localhost");
}

export async function surfacesWgsl(names, base = SHADERS) {
  needArray("surfacesWgsl", names, '["factors"]');
  const modules = await (await get("surfaces/modules.json", base)).json();
  const find = (name) => modules.find((module) => module.name === name) ?? refuse("module", name, modules.map(({ name }) => name));
  const all = new Set(names.flatMap((name) => [...find(name).needs, name]));
  const texts = [...all].map(async (name) => (await get(`surfaces/${find(name).file}`, base)).text());
  return (await Promise.all(texts)).join("\n");
}

const DOMAINS = ["isoline", "tri", "quad"];
const PARTITIONINGS = ["integer", "pow2", "fractional_odd", "fractional_even"];

export class Tessellator {
  static async load(device, { domain, partitioning, base = SHADERS } = {}) {
    need(device?.createBuffer, "Tessellator.load takes a GPUDevice; `await openDevice()` returns one");
    if (!DOMAINS.includes(domain)) refuse("domain", domain, DOMAINS);
    if (!PARTITIONINGS.includes(partitioning)) refuse("partitioning", partitioning, PARTITIONINGS);
    const folder = `${domain}-${partitioning}`;
    const manifest = await (await get(`${folder}/manifest.json`, base)).json();
    const words = await (await get("tables.bin", base)).arrayBuffer();
    const tables = device.createBuffer({ size: words.byteLength, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST });
    device.queue.writeBuffer(tables, 0, words);
    const type = ({ kind, is_written }) => kind === "uniform" ? kind : bindingType(is_written);
    const pipeline = async ({ name, file, entry_point: entryPoint, bindings }) => {
      // An explicit layout, because some stages do not use all of their bindings.
      const entries = bindings.map((entry) =>
        ({ binding: entry.binding, visibility: GPUShaderStage.COMPUTE, buffer: { type: type(entry) } }));
      const layout = device.createPipelineLayout({ bindGroupLayouts: [device.createBindGroupLayout({ entries })] });
      const module = device.createShaderModule({ code: await (await get(`${folder}/${file}`, base)).text() });
      return [name, await device.createComputePipelineAsync({ layout, compute: { module, entryPoint } })];
    };
    const pipelines = new Map(await Promise.all(manifest.stages.map(pipeline)));
    return Object.assign(new Tessellator(), { device, manifest, tables, pipelines });
  }

  batch(patches, room = { points: 1, primitives: 1 }, given = {}) {
    return new Batch(this, patches, room, given);
  }

  async tessellate(factors) {
    need(Number.isInteger(factors?.length) && typeof factors !== "string",
      "tessellate takes an array of numbers: the factors of one patch after another");
    const { domain, factors_per_patch: each } = this.manifest.setup;
    const patches = factors.length / each;
    if (!Number.isInteger(patches) || patches === 0) {
      throw new RangeError(`${factors.length} factors: a patch of domain ${domain} has ${each}`);
    }
    const run = async (room, results) => {
      const batch = this.batch(patches, room);
      try {
        this.device.queue.writeBuffer(batch.buffers.factors, 0, new Float32Array(factors));
        return await batch.read(results);
      } finally {
        batch.destroy();
      }
    };
    const [points, pointsHigh, primitives, primitivesHigh] = (await run(undefined, ["status"])).status;
    const room = { points: points + pointsHigh * 2 ** 32, primitives: primitives + primitivesHigh * 2 ** 32 };
    const { status, points: packed, indices } = await run(room, ["status", "points", "indices"]);
    if (status[4] !== 0) throw new Error("the counted room does not hold the batch");
    const word = (of) => Array.from({ length: points }, (_, i) => of(packed[2 * i], packed[2 * i + 1]));
    return {
      uv: Float32Array.from(word((low, high) => [low & 0x1ffff, low >>> 17 | (high & 3) << 15]).flat(), (x) => x / 65536),
      patches: Uint32Array.from(word((_, high) => high >>> 2)),
      indices: indices.slice(0, primitives * this.manifest.setup.indices_per_primitive),
    };
  }
}

class Batch {
  constructor({ device, manifest, tables, pipelines }, patches, { points, primitives }, given) {
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
    const large = plan.buffers.find(({ bytes }) => of(bytes) > most);
    if (large) throw new RangeError(`${large.resource} has ${of(large.bytes)} bytes; the device binds ${most}`);
    const make = (label, size) => device.createBuffer({ label, size, usage: STORAGE | COPY_DST | COPY_SRC | also[label] });
    // The caller's and the tessellator's buffers are not this batch's to free.
    this.kept = { tables, ...given };
    this.buffers = Object.fromEntries(plan.buffers.map(({ resource, bytes }) =>
      [resource, this.kept[resource] ?? make(resource, of(bytes))]));
    const stride = manifest.job_stride / 4;
    const words = new Uint32Array(stride * plan.jobs.length);
    plan.jobs.forEach((job, number) => words.set(job.map(of), stride * number));
    device.queue.writeBuffer(this.buffers.job, 0, words);
    this.device = device;
    this.dispatches = plan.dispatches.map(({ stage, bindings, workgroups }) => {
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
    const copies = names.map((name) => {
      const { size } = this.buffers[name];
      const copy = this.device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
      encoder.copyBufferToBuffer(this.buffers[name], 0, copy, 0, size);
      return copy;
    });
    this.device.queue.submit([encoder.finish()]);
    const words = async (copy) => {
      await copy.mapAsync(GPUMapMode.READ);
      const words = new Uint32Array(copy.getMappedRange().slice(0));
      copy.destroy();
      return words;
    };
    const all = await Promise.all(copies.map(words));
    return Object.fromEntries(names.map((name, i) => [name, all[i]]));
  }

  destroy() {
    for (const [name, buffer] of Object.entries(this.buffers)) if (!this.kept[name]) buffer.destroy();
  }
}
