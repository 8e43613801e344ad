// Tests what a stage draws and how: pulled points, meshes, bind groups with offsets, constants, numbers of patches from the
// device, several cameras. Draw arguments and counts must equal the model's; pictures of pulled points must equal those of
// stored points, which try-stage.mjs compares with the model, in every bit of every pixel.

import assert from "node:assert/strict";
import { READ, TERRAIN, factorsOf, model } from "./try-stage.mjs";

const SETUPS = [["quad", "fractional_odd"], ["quad", "integer"], ["tri", "fractional_even"], ["tri", "pow2"], ["isoline", "integer"]];

// Runs in the page: the picture of each kind of points, whose pixels are the bits of u and v and the patch's number, plus 1.
async function pulled([read, domain, partitioning, most]) {
  const { Stage } = await import("/stage.js");
  const { read: bytes } = await import("data:text/javascript," + encodeURIComponent(`${read} export { read };`));
  const device = await (await navigator.gpu.requestAdapter()).requestDevice();
  const problems = [], pictures = {};
  device.onuncapturederror = ({ error }) => problems.push(error.message);
  const format = "rgba32uint", size = 128;
  const texture = device.createTexture({ size: [size, size], format, usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC });
  const pixels = device.createBuffer({ size: 16 * size * size, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC });
  const each = { isoline: 2, tri: 4, quad: 6 }[domain];
  const factors = (of) => Array.from({ length: 16 * each }, (_, i) => 1.5 + 0.75 * ((3 * i + of) % 11));
  for (const [name, options] of [["stored", {}], ["points", { pull: "points" }], ["corners", { pull: "corners" }], ["other", { pull: "points" }]]) {
    const stage = await Stage.load(device, {
      domain, partitioning, patches: most, ...options, vertex: { position: "vec4f", id: "vec3u" },
      wgsl: `
const ONE = 1.0; // the stage has these names, too
fn place() {}
fn domain(number: u32, uv: vec2f) -> Vertex {
  let at = (vec2f(vec2u(number % 4u, number / 4u)) + uv) / 4.0;
  return Vertex(vec4f(1.9 * at - 0.95, 0.5, ONE), vec3u(bitcast<vec2u>(uv), number + 1u));
}
@fragment fn shade(vertex: Vertex) -> @location(0) vec4u { return vec4u(vertex.id, u32(tess_factors(vertex.id.z - 1u).${
  domain === "isoline" ? "detail" : "edges.x"})); }`,
    });
    stage.setFactors(factors(name === "other" ? 1 : 0));
    const feedback = await stage.makeRoom({ patches: 16 });
    const material = await stage.material({ targets: [{ format }] });
    const encoder = device.createCommandEncoder();
    const frame = stage.prepare(encoder, { patches: 16 });
    const view = texture.createView();
    const pass = encoder.beginRenderPass({ colorAttachments: [{ view, loadOp: "clear", storeOp: "store" }] });
    material.draw(pass, frame);
    pass.end();
    encoder.copyTextureToBuffer({ texture }, { buffer: pixels, bytesPerRow: 16 * size }, [size, size]);
    device.queue.submit([encoder.finish()]);
    pictures[name] = [...new Uint32Array(await bytes(device, pixels, 16 * size * size))];
    pictures[name].primitives = feedback.primitives;
    stage.destroy();
  }
  const { stored } = pictures, ids = new Set(stored.filter((_, i) => i % 4 === 2));
  const differing = (name) => pictures[name].filter((word, i) => word !== stored[i]).length;
  return {
    problems, differing: ["points", "corners", "other"].map(differing), ids: [...ids].sort((a, b) => a - b),
    primitives: ["stored", "points", "corners"].map((name) => pictures[name].primitives),
  };
}

async function tryPulled(page) {
  for (const [domain, partitioning] of SETUPS) {
    // A stage for many patches has a catalogue of topologies.
    for (const most of domain === "quad" ? [16, 20_000] : [16]) {
      const found = await page.evaluate(pulled, [READ, domain, partitioning, most]);
      const name = `pulled points of ${domain}, ${partitioning}, ${most} patches`;
      assert.deepEqual(found.problems, [], name);
      const [points, corners, other] = found.differing;
      assert.deepEqual([points, corners], [0, 0], `${name}: words that differ`);
      assert.ok(other > 1000, `${name}: other factors are seen in ${other} words`);
      assert.deepEqual(found.ids, Array.from({ length: 17 }, (_, i) => i), `${name}: every patch is drawn`);
      assert.equal(new Set(found.primitives).size, 1, `${name}: ${found.primitives}`);
    }
  }
  console.log(`test pulled points ... ok (${SETUPS.length} setups)`);
}

// Runs in the page: the draws of a stage's meshes, and the patches that the draw of each shows.
async function meshes([wgsl, read]) {
  const { Stage } = await import("/stage.js");
  const { read: bytes } = await import("data:text/javascript," + encodeURIComponent(`${read} export { read };`));
  const device = await (await navigator.gpu.requestAdapter()).requestDevice();
  const problems = [], found = [], said = {};
  device.onuncapturederror = ({ error }) => problems.push(error.message);
  const format = "r8uint", size = 256;
  const texture = device.createTexture({ size: [size, size], format, usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC });
  const pixels = device.createBuffer({ size: size * size, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC });
  const setup = { domain: "quad", partitioning: "fractional_odd", patches: 16, vertex: { position: "vec4f", id: "u32" } };
  const text = `${wgsl}
fn domain(number: u32, uv: vec2f) -> Vertex {
  return Vertex(vec4f((vec2f(vec2u(number % 4u, number / 4u)) + uv) / 2.0 - 1.0, 0.5, 1.0), number + 1u);
}
@fragment fn shade(vertex: Vertex) -> @location(0) u32 { return vertex.id; }`;
  const shown = async (stage, draw) => {
    const material = await stage.material({ targets: [{ format }] });
    const encoder = device.createCommandEncoder();
    const frame = stage.prepare(encoder, { instances: 3 });
    const pass = encoder.beginRenderPass({ colorAttachments: [{ view: texture.createView(), loadOp: "clear", storeOp: "store" }] });
    draw(material, pass, frame);
    pass.end();
    encoder.copyTextureToBuffer({ texture }, { buffer: pixels, bytesPerRow: size }, [size, size]);
    device.queue.submit([encoder.finish()]);
    return [...new Set(new Uint8Array(await bytes(device, pixels, size * size)))].filter((id) => id > 0).map((id) => id - 1).sort((a, b) => a - b);
  };
  for (const options of [{}, { evaluate: true }, { pull: "points" }, { pull: "corners" }]) {
    const stage = await Stage.load(device, { ...setup, ...options, wgsl: text, meshes: [0, 5, 5, 12] });
    await stage.makeRoom();
    for (const first of [[0, 5, 5, 12], [3]]) {
      stage.setMeshes(first);
      const patches = [];
      for (const mesh of first.keys()) patches.push(await shown(stage, (material, pass, frame) => material.drawMesh(pass, frame, mesh)));
      found.push({ first, patches, draws: [...new Uint32Array(await bytes(device, stage.meshIndirect, 20 * first.length))] });
    }
    stage.setMeshes([]);
    said.none = await shown(stage, (material, pass, frame) => material.drawMesh(pass, frame, 0)).catch(({ message }) => message);
    stage.destroy();
  }
  const told = (call) => Promise.resolve().then(call).then(() => "nothing", ({ message }) => message);
  said.descending = await told(() => Stage.load(device, { ...setup, wgsl: text, meshes: [5, 3] }));
  said.both = await told(() => Stage.load(device, { ...setup, wgsl: text, evaluate: true, pull: "points" }));
  said.pull = await told(() => Stage.load(device, { ...setup, wgsl: text, pull: "both" }));
  return { problems, found, said };
}

async function tryMeshes(page) {
  const { problems, found, said } = await page.evaluate(meshes, [TERRAIN, READ]);
  assert.deepEqual(problems, []);
  const counts = Array.from({ length: 16 }, (_, number) => model([factorsOf(number)]).indices.length);
  const sum = (begin, end) => counts.slice(begin, end).reduce((sum, count) => sum + count, 0);
  const drawn = (first) => first.flatMap((begin, mesh) => [sum(begin, first[mesh + 1] ?? 16), 3, sum(0, begin), 0, 0]);
  for (const { first, patches, draws } of found) {
    assert.deepEqual(draws, drawn(first), "arguments of the meshes' draws");
    assert.notDeepEqual(draws, drawn(first.map((begin) => begin + 1)), "other meshes are seen");
    const wanted = first.map((begin, mesh) => Array.from({ length: (first[mesh + 1] ?? 16) - begin }, (_, i) => begin + i));
    assert.deepEqual(patches, wanted, "patches of the meshes");
  }
  assert.equal(found.length, 8);
  assert.match(said.none, /there is no mesh 0: the frame has 0; `meshes`/);
  assert.match(said.descending, /mesh 1 begins at patch 3: it takes a whole number from 5, .* to 16/);
  assert.match(said.both, /leave out `evaluate` or `pull`/);
  assert.match(said.pull, /"points", "corners" or left out, not "both"/);
  console.log("test meshes ... ok");
}

// Runs in the page: frames whose number of patches the device has, whose factors depend on the offset of a bind group and on
// a constant, and draws with two cameras.
async function inputs([wgsl, read]) {
  const { Stage } = await import("/stage.js");
  const { read: bytes } = await import("data:text/javascript," + encodeURIComponent(`${read} export { read };`));
  const device = await (await navigator.gpu.requestAdapter()).requestDevice();
  const problems = [], counted = [], scaled = [], said = {};
  device.onuncapturederror = ({ error }) => problems.push(error.message);
  const { COPY_SRC, COPY_DST, STORAGE, UNIFORM } = GPUBufferUsage;
  const filled = (words, usage, at = 4) => {
    const buffer = device.createBuffer({ size: at * words.length, usage: usage | COPY_DST });
    words.forEach((word, i) => device.queue.writeBuffer(buffer, at * i, word));
    return buffer;
  };
  const setup = { domain: "quad", partitioning: "fractional_odd", patches: 16, vertex: { position: "vec4f" } };
  const domain = "fn domain(number: u32, uv: vec2f) -> Vertex { return Vertex(vec4f(uv - 1.0, 0.5, 1.0)); }";
  const stage = await Stage.load(device, { ...setup, wgsl: wgsl + domain });
  const counts = filled([9, 3, 999].map((count) => new Uint32Array([count])), COPY_SRC);
  for (const offset of [4, 0, 8]) counted.push((await stage.makeRoom({ patches: { buffer: counts, offset } })).primitives);
  const told = (call) => Promise.resolve().then(call).then(() => "nothing", ({ message }) => message);
  const encoder = device.createCommandEncoder();
  said.outside = await told(() => stage.prepare(encoder, { patches: { buffer: counts, offset: 12 } }));
  said.usage = await told(() => stage.prepare(encoder, { patches: { buffer: filled([new Uint32Array(1)], STORAGE) } }));

  // The layout of one value of 16 bytes whose place is an offset.
  const layoutOf = (visibility) => device.createBindGroupLayout({ entries: [{ binding: 0, visibility, buffer: { hasDynamicOffset: true } }] });
  const groupOf = (layout, values) => device.createBindGroup({
    layout, entries: [{ binding: 0, resource: { buffer: filled(values.map((value) => new Float32Array(value)), UNIFORM, 256), size: 16 } }],
  });
  const layout = layoutOf(GPUShaderStage.COMPUTE), group = groupOf(layout, [[3, 0, 0, 0], [5, 0, 0, 0]]);
  const own = await Stage.load(device, {
    ...setup, patches: 1, layouts: [layout], constants: { finer: 2 }, wgsl: `
override finer: f32;
@group(0) @binding(0) var<uniform> factor: vec4f;
fn hull(number: u32) -> QuadFactors { return tess_quad_factors(vec4f(factor.x + finer)); }
${domain}
@fragment fn shade() -> @location(0) vec4f { return vec4f(1.0); }
@group(0) @binding(0) var<uniform> camera: vec4f;
fn seen(vertex: Vertex) -> Vertex { return Vertex(vertex.position + camera + vec4f(finer - 2.0, 0.0, 0.0, 0.0)); }`,
  });
  for (const offset of [0, 256]) scaled.push((await own.makeRoom({ groups: [{ group, offsets: [offset] }] })).primitives);

  // One frame, seen by two cameras: a patch fills a quarter of the first one's picture, and half of it is out of the other's sight.
  const format = "r8unorm", size = 256, shares = [];
  const cameraLayout = layoutOf(GPUShaderStage.VERTEX), cameras = groupOf(cameraLayout, [[0, 0, 0, 0], [-0.5, 0, 0, 0]]);
  const material = await own.material({ targets: [{ format }], project: "seen", layouts: [cameraLayout] });
  const textures = [0, 1].map(() => device.createTexture({ size: [size, size], format, usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC }));
  const pixels = device.createBuffer({ size: size * size, usage: COPY_DST | COPY_SRC });
  const frames = device.createCommandEncoder();
  const frame = own.prepare(frames, { groups: [{ group, offsets: [0] }] });
  textures.forEach((texture, i) => {
    const pass = frames.beginRenderPass({ colorAttachments: [{ view: texture.createView(), loadOp: "clear", storeOp: "store" }] });
    material.draw(pass, frame, [{ group: cameras, offsets: [256 * i] }]);
    pass.end();
  });
  device.queue.submit([frames.finish()]);
  for (const texture of textures) {
    const copying = device.createCommandEncoder();
    copying.copyTextureToBuffer({ texture }, { buffer: pixels, bytesPerRow: size }, [size, size]);
    device.queue.submit([copying.finish()]);
    shares.push(new Uint8Array(await bytes(device, pixels, size * size)).filter((value) => value === 255).length / size ** 2);
  }
  return { problems, counted, scaled, shares, said };
}

async function tryInputs(page) {
  const { problems, counted, scaled, shares, said } = await page.evaluate(inputs, [TERRAIN, READ]);
  assert.deepEqual(problems, []);
  const triangles = (patches) => model(patches).indices.length / 3;
  const first = (count) => triangles(Array.from({ length: count }, (_, number) => factorsOf(number)));
  assert.deepEqual(counted, [3, 9, 16].map(first), "triangles of as many patches as the device says");
  assert.notEqual(first(3), first(4), "another number is seen");
  assert.deepEqual(scaled, [5, 7].map((factor) => triangles([Array(6).fill(factor)])), "factors of the offset and the constant");
  assert.deepEqual(shares, [0.25, 0.125], "shares of the two cameras' pictures");
  assert.match(said.outside, /from byte 12 of a buffer of 12 bytes/);
  assert.match(said.usage, /need GPUBufferUsage.COPY_SRC/);
  console.log("test patches, bind groups and constants ... ok");
}

export async function tryDraws(page) {
  await tryPulled(page);
  await tryMeshes(page);
  await tryInputs(page);
}
