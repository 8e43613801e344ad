// Tests the stage and the geometry of three.js: the joined WGSL and the room in Node.js, then pages in a browser. Points and
// indices must equal the model's, which `tess patch` gives, bit for bit.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const tess = (words, input) => execFileSync(process.env.TESS_PROGRAM, words, { input, maxBuffer: 1 << 28, encoding: "utf8" });

// What the room decides: the same as the stage in Rust for the demands of rooms.txt, whose head explains its lines. `other`
// changes what the room is made of, as a planted fault.
function differingRooms(Room, other) {
  const record = readFileSync(new URL("../rooms.txt", import.meta.url), "utf8");
  let own, stage, now, compared = 0;
  const differing = [];
  for (const line of record.trim().split("\n").filter((line) => !line.startsWith("#"))) {
    const [what, ...words] = line.split(" "), numbers = words.map(Number);
    if (what === "stage") stage = numbers;
    if (what === "uniform") {
      const [patches, point, vertex, primitive, budget, limit] = stage;
      const uniform = [0, 3, 6, 9].map((at) => ({ factor: numbers[at], points: numbers[at + 1], primitives: numbers[at + 2] }));
      const all = { uniform, patches, bytes: [point + vertex, primitive], largest: Math.max(point, vertex), budget, limit };
      own = new Room({ ...all, ...other(all) });
    }
    if (what === "first") now = own.first();
    if (what === "frame") now = own.next(now, numbers[0], numbers.slice(1, 3)) ?? now;
    if (what !== "first" && what !== "frame") continue;
    compared++;
    if (String(now) !== String(numbers.slice(-2))) differing.push(`${line}: room for ${now}`);
  }
  assert.ok(compared >= 100, `only ${compared} rooms were compared`);
  return differing;
}

export async function tryRoom(packed) {
  const { Room } = await import(pathToFileURL(join(packed, "room.js")));
  assert.deepEqual(differingRooms(Room, () => ({})), []);
  for (const fault of [({ budget }) => ({ budget: budget - 20 }), ({ patches }) => ({ patches: patches + 1 })]) {
    assert.ok(differingRooms(Room, fault).length > 0, "another budget, or another patch, is seen");
  }
  console.log("test room ... ok");
}

const MEMBERS = { position: "vec4f", normal: "vec3f", id: "u32", uv: "vec2f" };
const KINDS = { isoline: "IsolineFactors", tri: "TriFactors", quad: "QuadFactors" };
const least = (domain) => `fn hull(number: u32) -> ${KINDS[domain]} { return ${KINDS[domain]}(); }
fn domain(number: u32, uv: vec2f) -> Vertex { return Vertex(vec4f(uv, 0.0, 1.0), vec3f(), number, uv); }
@group(0) @binding(0) var<uniform> eye: vec4f; // tess_view is only spoken of here
`;
const busy = (domain) => least(domain) + `fn seen(vertex: Vertex) -> Vertex {
  let factors = tess_factors(vertex.id + tess_instance());
  return vertex;
}
`;

// The joined modules equal the files of `tess shaders --stage FILE`, byte for byte.
export async function tryJoining(packed) {
  const { joined, vertexModule, vertexOf } = await import(pathToFileURL(join(packed, "compose.js")));
  const folder = mkdtempSync(join(tmpdir(), "tess-stage-"));
  let compared = 0;
  for (const domain of Object.keys(KINDS)) {
    const { parts } = JSON.parse(readFileSync(join(packed, `shaders/${domain}-pow2/stage.json`), "utf8"));
    for (const [text, project] of [[least(domain), undefined], [busy(domain), "seen"]]) {
      for (const isEvaluated of [false, true]) {
        const vertex = vertexOf(MEMBERS), user = vertex.wgsl + text;
        writeFileSync(join(folder, "user.wgsl"), user);
        const options = [...(isEvaluated ? ["--evaluate"] : []), ...(project ? ["--project", project] : [])];
        const output = domain === "isoline" ? "line" : "triangle_cw";
        tess(["shaders", "--target", "wgsl", "--domain", domain, "--partitioning", "pow2", "--output", output, "--force",
          "--stage", join(folder, "user.wgsl"), ...options, "-o", join(folder, "out")]);
        const file = (name) => readFileSync(join(folder, "out", name), "utf8");
        const manifest = JSON.parse(file("stage.json"));
        const own = {
          "stage_hull.wgsl": joined(parts, user, parts.hull, 1),
          "stage_fit.wgsl": parts.fit,
          "stage_vertex.wgsl": vertexModule(parts, user, 1, { project, vertex: isEvaluated ? vertex : undefined }),
        };
        if (isEvaluated) {
          own["stage_evaluate.wgsl"] = joined(parts, user, parts.evaluate, 1);
          const { stride, attributes } = manifest.vertex;
          const places = vertex.attributes.map(({ shaderLocation: location, offset, format }) => ({ location, offset, format }));
          assert.deepEqual([stride, attributes], [vertex.stride, places], `the vertex buffer of ${domain}`);
        }
        for (const [name, joint] of Object.entries(own)) assert.equal(joint, file(name), `${domain}: ${name}`);
        assert.equal(manifest.group, 1);
        compared += Object.keys(own).length;
      }
    }
  }
  rmSync(folder, { recursive: true });
  console.log(`test joining ... ok (${compared} modules)`);
}

// Patches whose factors every device computes exactly: multiples of a quarter.
export const TERRAIN = `
fn corner(number: u32) -> vec2f { return vec2f(vec2u(number % 4u, number / 4u)); }
fn hull(number: u32) -> QuadFactors {
  let first = 1.5 + 0.75 * f32(number % 8u);
  return tess_quad_factors(vec4f(first, first + 2.0, first + 9.25, first + 1.0));
}
`;
const PATCHES = 16;
export const factorsOf = (number) => {
  const first = 1.5 + 0.75 * (number % 8);
  return [first, first + 2, first + 9.25, first + 1, first + 1.5, first + 4.625];
};

// Points (u, v, patch) and indices of patches with these factors, by the model.
export function model(patches) {
  const bits = (numbers) => [...new Uint32Array(new Float32Array(numbers).buffer)].map((word) => word.toString(16).padStart(8, "0"));
  const lines = patches.map((factors) => `case quad fractional_odd triangle_cw ruler ${bits(factors).join(" ")}`);
  const listings = tess(["patch", "--cases", "-"], lines.join("\n") + "\n").split("\ncase ").slice(1);
  assert.equal(listings.length, patches.length, "a listing for each case");
  const points = [], indices = [];
  listings.forEach((text, patch) => {
    const base = points.length / 3, rows = text.split("\n");
    const count = Number(rows[1].split(" ")[1]);
    points.push(...rows.slice(2, 2 + count).flatMap((row) => [...row.split(" ").map((word) => parseInt(word, 16) / 65536), patch]));
    for (const row of rows.slice(3 + count)) if (/^\d/.test(row)) indices.push(...row.split(" ").map((word) => base + Number(word)));
  });
  return { points, indices };
}

const expected = () => model(Array.from({ length: PATCHES }, (_, number) => factorsOf(number)));
// The same with one patch's factors changed, as a planted fault.
const planted = () => model(Array.from({ length: PATCHES }, (_, number) => factorsOf(number + (number === PATCHES - 1 ? 1 : 0))));

// The first difference between two lists.
function difference(what, observed, wanted) {
  const at = wanted.findIndex((value, i) => !Object.is(observed[i], value));
  if (at >= 0) return `${what}[${at}]: observed ${observed[at]}, expected ${wanted[at]}`;
  return observed.length === wanted.length ? "" : `${observed.length} ${what}, expected ${wanted.length}`;
}

function compare(name, { points, indices }) {
  const to = (wanted) => difference("points", points, wanted.points) || difference("indices", indices, wanted.indices);
  assert.equal(to(expected()), "", name);
  assert.match(to(planted()), /^points\[\d+\]: observed/, `${name}: a planted fault is found`);
}

// Runs in the page: reads buffers back.
export const READ = `
async function read(device, buffer, bytes) {
  const size = Math.ceil(bytes / 4) * 4;
  const copy = device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  const encoder = device.createCommandEncoder();
  encoder.copyBufferToBuffer(buffer, 0, copy, 0, size);
  device.queue.submit([encoder.finish()]);
  await copy.mapAsync(GPUMapMode.READ);
  return copy.getMappedRange();
}
// Points as (u, v, patch) from vertices that begin with them, and indices.
async function output(device, { vertices, indices, stride, points, primitives }) {
  const words = new Float32Array(await read(device, vertices, stride * points));
  const all = Array.from({ length: points }, (_, i) => [...words.subarray(i * stride / 4, i * stride / 4 + 3)]).flat();
  return { points: all, indices: [...new Uint32Array(await read(device, indices, 12 * primitives))] };
}`;

// Runs in the page: frames of a stage whose first room is too little.
async function frames([wgsl, text]) {
  const { Stage } = await import("/stage.js");
  const { output, read } = await import("data:text/javascript," + encodeURIComponent(`${text} export { output, read };`));
  const device = await (await navigator.gpu.requestAdapter()).requestDevice();
  const problems = [];
  device.onuncapturederror = ({ error }) => problems.push(error.message);
  const setup = { domain: "quad", partitioning: "fractional_odd", patches: 16 };
  const vertex = { position: "vec3f", uv: "vec2f" };
  const domain = "fn domain(number: u32, uv: vec2f) -> Vertex { return Vertex(vec3f(uv, f32(number)), uv); }";
  const stage = await Stage.load(device, { ...setup, wgsl: wgsl + domain, vertex, evaluate: true });
  const run = async (of = stage, options = {}) => {
    const encoder = device.createCommandEncoder();
    const frame = of.prepare(encoder, options);
    device.queue.submit([encoder.finish()]);
    await device.queue.onSubmittedWorkDone();
    await of.feedbacks.ask();
    return frame;
  };
  const read_ = ({ points, primitives }, of = stage) => output(device, {
    vertices: of.vertices, indices: of.indices, stride: of.vertexLayout.arrayStride, points, primitives,
  });
  const scales = [];
  for (let frame = 0; frame < 20 && scales.at(-1) !== 1; frame++) {
    await run();
    scales.push(stage.feedback.scale);
    // A frame that is recorded and dropped changes nothing.
    stage.prepare(device.createCommandEncoder());
  }
  const last = stage.feedback;
  const grown = await read_(last);

  const given = await Stage.load(device, { ...setup, wgsl: domain, vertex, evaluate: true });
  given.setFactors(Array.from({ length: 16 }, (_, number) => {
    const first = 1.5 + 0.75 * (number % 8);
    return [first, first + 2, first + 9.25, first + 1, first + 1.5, first + 4.625];
  }).flat());
  const feedback = await given.makeRoom();
  await run(given);
  const copied = await read_(feedback, given);

  // Little memory for ever, and no scaling.
  const little = await Stage.load(device, { ...setup, wgsl: wgsl + domain, vertex, evaluate: true, budget: 20_000 });
  for (let frame = 0; frame < 5; frame++) await run(little);
  const nothing = await Stage.load(device, { ...setup, wgsl: wgsl + domain, vertex, overflow: "nothing", budget: 20_000 });
  for (let frame = 0; frame < 5; frame++) await run(nothing);
  const coarse = little.feedback;
  await run(little, { patches: 3, instances: 5 });
  const [, instances] = new Uint32Array(await read(device, little.indirect, 20));

  // A device without the memory to grow.
  const poor = await Stage.load(device, { ...setup, wgsl: wgsl + domain, vertex, evaluate: true });
  const first = String(poor.output.room), pop = device.popErrorScope;
  let tries = 0;
  device.popErrorScope = () => {
    tries++;
    return pop.call(device).then(() => new Error("out of memory"));
  };
  for (let frame = 0; frame < 5; frame++) await run(poor);
  device.popErrorScope = pop;
  const kept = String(poor.output.room) === first && poor.feedback;
  for (const one of [stage, given, little, nothing, poor]) one.destroy();
  return {
    problems, scales, last, grown, copied, little: coarse, three: little.feedback, nothing: nothing.feedback, instances, kept, tries,
    room: little.output.room, stride: stage.vertexLayout.arrayStride,
  };
}

// Runs in the page: draws two instances of a patch side by side, each half of the picture, in the colour of its factors.
async function drawings([read]) {
  const { Stage } = await import("/stage.js");
  const { read: bytes } = await import("data:text/javascript," + encodeURIComponent(`${read} export { read };`));
  const device = await (await navigator.gpu.requestAdapter()).requestDevice();
  const problems = [], shares = [];
  device.onuncapturederror = ({ error }) => problems.push(error.message);
  const format = "rgba8unorm", size = 64;
  const texture = device.createTexture({ size: [size, size], format, usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC });
  const pixels = device.createBuffer({ size: 4 * size * size, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC });
  for (const evaluate of [false, true]) {
    const stage = await Stage.load(device, {
      domain: "quad", partitioning: "integer", patches: 1, evaluate, vertex: { position: "vec4f" },
      wgsl: "fn domain(number: u32, uv: vec2f) -> Vertex { return Vertex(vec4f(uv.x - 1.0, 2.0 * uv.y - 1.0, 0.5, 1.0)); }",
    });
    stage.setFactors([2, 2, 2, 2, 2, 2]);
    const material = await stage.material({
      targets: [{ format }], project: "seen",
      wgsl: `${stage.wgsl}
fn seen(vertex: Vertex) -> Vertex { return Vertex(vertex.position + vec4f(f32(tess_instance()), 0.0, 0.0, 0.0)); }
@fragment fn shade() -> @location(0) vec4f { return vec4f(tess_factors(0u).inside.x / 4.0, 0.0, 0.0, 1.0); }`,
    });
    for (const instances of [1, 2]) {
      const encoder = device.createCommandEncoder();
      const frame = stage.prepare(encoder, { instances });
      const view = texture.createView();
      const pass = encoder.beginRenderPass({ colorAttachments: [{ view, loadOp: "clear", storeOp: "store" }] });
      material.draw(pass, frame);
      pass.end();
      encoder.copyTextureToBuffer({ texture }, { buffer: pixels, bytesPerRow: 4 * size }, [size, size]);
      device.queue.submit([encoder.finish()]);
      const data = new Uint8Array(await bytes(device, pixels, 4 * size * size));
      shares.push(data.filter((value, i) => i % 4 === 0 && (value === 127 || value === 128)).length / (size * size));
    }
  }
  return { problems, shares };
}

// Runs in the page: what is refused, with its message.
async function refusals([wgsl]) {
  const { Stage } = await import("/stage.js");
  const device = await (await navigator.gpu.requestAdapter()).requestDevice();
  device.onuncapturederror = ({ error }) => { throw error; };
  const setup = { domain: "quad", partitioning: "integer", patches: 4 };
  const vertex = { position: "vec4f" };
  const domain = "fn domain(number: u32, uv: vec2f) -> Vertex { return Vertex(vec4f(uv, 0.0, 1.0)); }";
  const said = {};
  const told = async (name, call) => said[name] = await Promise.resolve().then(call).then(() => "nothing", ({ message }) => message);
  const load = (options) => Stage.load(device, { ...setup, vertex, wgsl: wgsl + domain, ...options });
  await told("device", () => Stage.load(undefined, setup));
  await told("domain", () => load({ domain: "triangle" }));
  await told("patches", () => load({ patches: 0 }));
  await told("members", () => load({ vertex: { position: "vec5f" } }));
  await told("no members", () => load({ vertex: undefined, evaluate: true }));
  await told("line", () => load({ wgsl: "\n\nfn broken() -> f32 { return 1u; }" + wgsl + domain }));
  await told("hull", () => load({ wgsl: wgsl.replace("-> QuadFactors", "-> TriFactors").replace("tess_quad_factors(vec4f(", "tess_tri_factors(vec3f(").replace(", first + 1.0", "") + domain }));
  await told("overflow", () => load({ overflow: "less" }));
  const stage = await load({});
  await told("encoder", () => stage.prepare());
  await told("more", () => stage.prepare(device.createCommandEncoder(), { patches: 5 }));
  await told("groups", () => stage.prepare(device.createCommandEncoder(), { groups: [1] }));
  await told("factors", () => stage.setFactors([1, 2]));
  const targets = [{ format: "rgba8unorm" }], shade = "@fragment fn shade() -> @location(0) vec4f { return vec4f(); }";
  const material = await stage.material({ wgsl: domain + shade, targets });
  const first = stage.prepare(device.createCommandEncoder());
  stage.prepare(device.createCommandEncoder());
  const pass = { drawIndexedIndirect() {} };
  await told("old", () => material.draw(pass, first));
  await told("other", () => material.draw(pass, (async () => {})()));
  await told("project", async () => (await load({})).material({ wgsl: domain + shade, targets, project: "seen" }));
  const seen = "fn seen(vertex: Vertex) -> Vertex { return vertex; }", withSeen = { wgsl: domain + shade + seen, targets, project: "seen" };
  await told("earlier", () => stage.material(withSeen));
  const projected = await load({});
  await projected.material({ wgsl: domain + shade, targets, project: null });
  await projected.material(withSeen);
  await told("forgotten", () => projected.material({ wgsl: domain + shade, targets }));
  await told("none", () => projected.material({ wgsl: domain + shade, targets, project: null }));
  return said;
}

const REFUSED = {
  device: /takes a GPUDevice; `await openDevice\(\)`/, domain: /there is no domain "triangle"; choose/, patches: /1 or more, not 0/,
  members: /`position` has "vec5f"/, "no members": /give the members of `Vertex`/, line: /^line 3 of your WGSL: /,
  hull: /does not go with the stage .*fn hull\(number: u32\) -> QuadFactors/s, overflow: /"coarser" or "nothing", not "less"/,
  encoder: /takes a GPUCommandEncoder/, more: /0 to 4 patches/, groups: /0 bind groups, one for each of `layouts`, not 1/,
  factors: /without a function `hull`/, old: /frame 0 is gone: its stage has prepared frame 1/, other: /not a frame of the material's stage/,
  forgotten: /another material of this stage calls `seen`/, none: /^nothing$/, earlier: /earlier material of this stage has no `project`/,
  project: /does not go with the stage|line \d+ of your WGSL/,
};

export async function tryStage(page) {
  const found = await page.evaluate(frames, [TERRAIN, READ]);
  assert.deepEqual(found.problems, []);
  assert.ok(found.scales[0] < 1 && found.scales.at(-1) === 1, `the room was too little at first, and grew: ${found.scales}`);
  assert.equal(found.last.drawn, found.last.primitives);
  compare("factors of the hull", found.grown);
  compare("factors of the page", found.copied);
  assert.ok(found.little.scale < 1 && found.little.drawn > 0 && found.little.drawn < found.last.drawn, "coarser for ever");
  const three = model([0, 1, 2].map(factorsOf)).indices.length / 3;
  assert.ok(found.three.primitives === three && found.three.scale === 1, `3 patches: ${JSON.stringify(found.three)}, not ${three}`);
  assert.ok(found.stride * found.room[0] + 8 * found.room[0] + 12 * found.room[1] <= 20_000, "the budget is kept");
  assert.ok(found.nothing.drawn === 0 && found.nothing.scale === 1 && found.nothing.points === found.last.points, "nothing is drawn");
  assert.equal(found.instances, 5, "instances of the draw");
  assert.ok(found.kept.scale < 1 && found.kept.drawn > 0, `without memory the room stays: ${JSON.stringify(found.kept)}`);
  assert.equal(found.tries, 1, "it is not asked for again");
  const drawn = await page.evaluate(drawings, [READ]);
  assert.deepEqual(drawn, { problems: [], shares: [0.5, 1, 0.5, 1] });
  const said = await page.evaluate(refusals, [TERRAIN]);
  for (const [name, wanted] of Object.entries(REFUSED)) assert.match(said[name], wanted, name);
  console.log(`test the stage ... ok (${found.last.primitives} triangles after ${found.scales.length} frames; ${Object.keys(REFUSED).length - 1} refusals)`);
}

// Runs in the page: a geometry of three.js with the plain points, and what it hands over. With WebGL 2 the page gives the
// factors.
async function geometry([wgsl, read, isWebGL, factors]) {
  const THREE = await import("three/webgpu");
  const { attribute, float, vec3 } = await import("three/tsl");
  const { TessellatedGeometry } = await import("/three.js");
  const { output } = await import("data:text/javascript," + encodeURIComponent(`${read} export { output };`));
  const setup = { domain: "quad", partitioning: "fractional_odd", patches: 16 };
  const renderer = new THREE.WebGPURenderer({ forceWebGL: isWebGL });
  const ground = await TessellatedGeometry.load(renderer, isWebGL ? setup : { ...setup, wgsl });
  const { stage } = ground.source, problems = [];
  if (stage) stage.device.onuncapturederror = ({ error }) => problems.push(error.message);
  const scene = new THREE.Scene(), camera = new THREE.OrthographicCamera(-0.5, 4.5, 4.5, -0.5, 0, 10);
  camera.position.z = 5;
  // The patches side by side: their points are moved by nodes of the material.
  const at = attribute("position", "vec3");
  const material = new THREE.MeshBasicNodeMaterial({ color: "white", side: THREE.DoubleSide });
  material.positionNode = vec3(at.x.add(at.z.mod(4)), at.y.add(at.z.div(float(4)).floor()), 0);
  scene.add(new THREE.Mesh(ground, material));
  const target = new THREE.RenderTarget(100, 100);
  renderer.setRenderTarget(target);
  const scales = [], shares = [], warned = [], { warn } = console;
  console.warn = (text) => warned.push(text);
  renderer.render(scene, camera);
  console.warn = warn;
  const frame = async (values) => {
    ground.update(values);
    renderer.render(scene, camera);
    const pixels = await renderer.readRenderTargetPixelsAsync(target, 0, 0, 100, 100);
    shares.push(pixels.filter((value, i) => i % 4 === 0 && value > 128).length / 10_000);
    await stage?.feedbacks.ask();
    scales.push(ground.feedback.scale);
  };
  while (scales.length < 20 && scales.at(-1) !== 1) await frame(isWebGL ? { factors } : {});
  const { points, primitives } = ground.feedback;
  const record = (attribute) => renderer.backend.get(attribute).buffer;
  const made = stage ? await output(stage.device, {
    vertices: record(ground.source.vertices), indices: record(ground.index), stride: stage.vertexLayout.arrayStride, points, primitives,
  }) : {
    points: [...ground.getAttribute("position").array.subarray(0, 3 * points)],
    indices: [...ground.index.array.subarray(0, 3 * primitives)],
  };
  // With WebGL 2 also without the first patch, which moves everything in the buffers.
  await frame(isWebGL ? { patches: 4, factors: factors.map((factor, i) => i < 6 ? 0 : factor) } : { patches: 4 });
  const told = async (call) => Promise.resolve().then(call).then(() => "nothing", ({ message }) => message);
  const said = [
    await told(() => ground.update({ eye: 1 })), await told(() => TessellatedGeometry.load({}, setup)),
    await told(() => TessellatedGeometry.load(new THREE.WebGPURenderer({ forceWebGL: true }), { ...setup, wgsl })),
    await told(() => TessellatedGeometry.load(renderer, { ...setup, wgsl, vertex: { position: "vec3f" } })),
    await told(() => TessellatedGeometry.load(renderer, { ...setup, domain: "square" })),
    await told(() => TessellatedGeometry.load(renderer, { ...setup, patches: 0 })), await told(() => ground.update({ patches: 17 })),
  ];
  ground.dispose();
  await stage?.device.queue.onSubmittedWorkDone();
  return { problems, scales, shares, made, said, warned };
}

export async function tryThree(page) {
  const factors = Array.from({ length: PATCHES }, (_, number) => factorsOf(number)).flat();
  for (const isWebGL of [false, true]) {
    const found = await page.evaluate(geometry, [TERRAIN, READ, isWebGL, factors]);
    assert.deepEqual(found.problems, []);
    assert.ok((isWebGL || found.scales[0] < 1) && found.scales.at(-1) === 1, `the room grew: ${found.scales}`);
    compare("the geometry's buffers", found.made);
    // 4 by 4 patches of 20 by 20 pixels, drawn through three's own pipeline; then one row of them, or three of a row.
    for (const [i, share] of found.shares.entries()) {
      const wanted = i < found.shares.length - 1 ? 0.64 : isWebGL ? 0.12 : 0.16;
      assert.ok(Math.abs(share - wanted) < 0.02, `frame ${i} covers ${share} of the picture, not ${wanted}`);
    }
    const wanted = [/there is no uniform `eye`/, /takes a WebGPURenderer/, /draws with WebGL 2, which runs no WGSL/, /give both or neither/, /square/,
      /1 or more, not 0/, /16/];
    assert.equal(found.warned.filter((text) => /before its first `update`/.test(text)).length, 1, `${found.warned}`);
    wanted.forEach((one, i) => assert.match(found.said[i], one));
    console.log(`test the geometry of three.js, ${isWebGL ? "WebGL 2" : "WebGPU"} ... ok (${found.scales.length} frames)`);
  }
}
