// Runs the shaders next to this file on a WebGPU device. tess.d.ts documents the interface, docs/shaders.md the manifest.

import { Batch, Pipelines } from "./batch.js";
import { SHADERS, get, need, needArray, refuse } from "./common.js";

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
    const stages = await Promise.all(manifest.stages.map(async (stage) =>
      ({ ...stage, source: await (await get(`${folder}/${stage.file}`, base)).text() })));
    const pipelines = await new Pipelines(device).of(stages);
    return Object.assign(new Tessellator(), { device, manifest, tables, pipelines });
  }

  batch(patches, room = { points: 1, primitives: 1 }, given = {}, without = []) {
    return new Batch(this, patches, room, given, without);
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
