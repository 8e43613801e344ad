// The tessellation stage that WebGPU lacks: hull and domain functions in WGSL, room that grows by itself, factors that are
// scaled down until everything fits. stage.d.ts documents the interface, docs/shaders.md the manifest stage.json.
//
// The user's WGSL is joined here with the stage's text, which `tess shaders --stage` publishes in parts, rather than by a
// module of WebAssembly: joining is a few replacements, and a page loads nothing but text for it.

import { Tessellator } from "./tess.js";
import { SHADERS, bindGroup, get, need, needEncoder, needMost, needPatches, setGroups, typeOf, value } from "./common.js";
import { compile, joined, uses, vertexOf } from "./compose.js";
import { Feedbacks } from "./feedback.js";
import { Material } from "./material.js";
import { INSTANCES_AT, Meshes, meshPass } from "./meshes.js";
import { Room } from "./room.js";

const FACTORS = { isoline: "IsolineFactors", tri: "TriFactors", quad: "QuadFactors" };

export class Stage {
  static async load(device, options = {}) {
    need(device?.createBuffer, "Stage.load takes a GPUDevice; `await openDevice()` returns one");
    const {
      domain, partitioning, base = SHADERS, patches, wgsl = "", vertex, layouts = [], constants, meshes = [], evaluate = false,
      pull, overflow = "coarser", budget = 256 * 2 ** 20,
    } = options;
    need(typeof wgsl === "string", "Stage.load takes `wgsl`, a text with the functions `hull` and `domain`");
    needMost("Stage.load", patches);
    need(!evaluate || vertex, "to evaluate points, give the members of `Vertex`, such as vertex: { position: \"vec4f\" }");
    need([undefined, "points", "corners"].includes(pull), `\`pull\` is "points", "corners" or left out, not ${JSON.stringify(pull)}`);
    need(!(evaluate && pull), "points are evaluated or pulled: leave out `evaluate` or `pull`");
    need(["coarser", "nothing"].includes(overflow), `\`overflow\` is "coarser" or "nothing", not ${JSON.stringify(overflow)}`);
    const tessellator = await Tessellator.load(device, { domain, partitioning, base });
    const manifest = await (await get(`${domain}-${partitioning}/stage.json`, base)).json();
    const stage = Object.assign(new Stage(), {
      device, tessellator, manifest, patches, layouts, constants, evaluate, pull, isCoarser: overflow === "coarser",
      layout: vertex && vertexOf(vertex), wgsl, projects: new Set(), hasHull: /\bfn\s+hull\b/.test(wgsl),
    });
    await stage.#make(budget);
    stage.setMeshes(meshes);
    return stage;
  }

  // A text of the user with the struct `Vertex` before it, if its members were given.
  text(wgsl = this.wgsl) {
    return (this.layout?.wgsl ?? "") + wgsl;
  }

  async #make(budget) {
    const { device, manifest, patches, tessellator: { manifest: { setup } } } = this;
    const user = this.text(), { limits } = device;
    const { STORAGE, COPY_DST, COPY_SRC, INDIRECT } = GPUBufferUsage;
    const of = (formula) => value(formula, { patches });
    const make = (label, size, usage = 0) =>
      device.createBuffer({ label, size, usage: STORAGE | COPY_DST | COPY_SRC | usage });
    this.buffers = { factors: make("factors", 4 * setup.factors_per_patch * patches) };
    for (const { name, bytes } of manifest.buffers.filter(({ name }) => name !== "window")) {
      this.buffers[name] = make(name, of(bytes), name === "fit_arguments" ? INDIRECT : 0);
    }
    this.rows = this.#rows(Math.ceil(patches / manifest.workgroup_size));
    device.queue.writeBuffer(this.buffers.terms, 8, new Uint32Array(this.rows));
    device.queue.writeBuffer(this.buffers.terms, 16, new Float32Array(manifest.ladder));

    const first = this.hasHull ? "hull" : "copy_factors";
    const before = manifest.before_batch.filter(({ part }) => part === first || part === "fit" && this.isCoarser);
    const after = this.evaluate ? manifest.after_batch : [];
    const own = this.layouts.length;
    const needs = `fn hull(number: u32) -> ${FACTORS[setup.domain]} and fn domain(number: u32, uv: vec2f) -> Vertex`;
    const modules = {};
    const pipelines = (passes) => Promise.all(passes.map(async (pass) => {
      const isUsers = ["hull", "evaluate"].includes(pass.part);
      const text = manifest.parts[pass.part];
      const code = isUsers ? joined(manifest.parts, user, text, own) : text;
      const module = await (modules[pass.part] ??= compile(device, pass.part, code, isUsers ? user : "", needs));
      return this.#pipeline(pass, module, isUsers, user);
    }));
    const ofMeshes = { ...manifest, job_stride: this.tessellator.manifest.job_stride };
    [this.before, this.after, this.meshPass] =
      await Promise.all([pipelines(before), pipelines(after), meshPass(device, ofMeshes)]);

    const each = this.pull ? 0 : 8 + (this.evaluate ? this.layout.stride : 0);
    this.room = new Room({
      uniform: manifest.uniform, patches, budget,
      bytes: [each, this.pull === "corners" ? 0 : setup.indices_per_primitive * setup.bytes_per_index],
      largest: this.pull ? 0 : Math.max(8, each - 8),
      // Every buffer is bound whole.
      limit: Math.min(limits.maxBufferSize, limits.maxStorageBufferBindingSize),
    });
    this.feedbacks = new Feedbacks(device, manifest.ladder);
    Object.assign(this, { frames: 0, retired: [], output: this.#output(this.room.first()) });
  }

  #rows(count) {
    const x = Math.min(count, this.device.limits.maxComputeWorkgroupsPerDimension);
    return [x, Math.ceil(count / x)];
  }

  // The pipeline of a pass. The stage's own bind groups follow the user's, of which there are `own`.
  async #pipeline(pass, module, isUsers, user) {
    const { device } = this, own = isUsers ? this.layouts.length : 0;
    const bindings = pass.bindings.filter(({ buffer }) => pass.part !== "evaluate" || buffer !== "factors" || uses(user, "tess_factors"));
    const numbers = [...new Set(bindings.map(({ group }) => group))];
    const layouts = numbers.map((group) => device.createBindGroupLayout({
      entries: bindings.filter((one) => one.group === group).map((one) =>
        ({ binding: one.binding, visibility: GPUShaderStage.COMPUTE, buffer: { type: typeOf(one) } })),
    }));
    const users = own > 0 ? this.layouts : [];
    const layout = device.createPipelineLayout({ bindGroupLayouts: [...users, ...layouts] });
    const pipeline = await device.createComputePipelineAsync({ layout, compute: { module, entryPoint: pass.entry_point, constants: isUsers ? this.constants : undefined } });
    return { ...pass, pipeline, own, groups: numbers.map((group, i) => [layouts[i], bindings.filter((one) => one.group === group)]) };
  }

  // A batch with this room, the buffers that it writes, and the passes' bind groups over them.
  #output(room) {
    const { device, buffers, evaluate, patches } = this;
    const [points, primitives] = room;
    const without = { points: ["points"], corners: ["points", "indices"] }[this.pull];
    const batch = this.tessellator.batch(patches, { points, primitives }, { factors: buffers.factors }, without);
    const { VERTEX, STORAGE, COPY_SRC, COPY_DST } = GPUBufferUsage;
    const vertices = evaluate ? device.createBuffer({
      label: "vertices", size: this.layout.stride * Math.max(points, 1), usage: VERTEX | STORAGE | COPY_SRC,
    }) : undefined;
    const window = device.createBuffer({ label: "window", size: 8, usage: STORAGE | COPY_DST });
    device.queue.writeBuffer(window, 0, new Uint32Array([0, points]));
    const all = { ...batch.buffers, ...buffers, window, vertices };
    const bound = ({ groups, ...pass }) => ({
      ...pass,
      groups: groups.map(([layout, bindings]) => bindGroup(device, layout, bindings, all)),
    });
    const { workgroup_size, most_workgroups } = this.manifest;
    const workgroups = Math.min(Math.ceil(points / workgroup_size), most_workgroups);
    const destroy = () => [batch, window, vertices].forEach((one) => one?.destroy());
    return { room, batch, all, vertices, before: this.before.map(bound), after: this.after.map(bound), workgroups, destroy };
  }

  // Replaces the output if another room is better; the memory is there before it is used.
  #adapt() {
    const last = this.feedback;
    if (!last || this.growing) return;
    const room = this.room.next(this.output.room, last.frame, [last.points, last.primitives]);
    if (!room) return;
    this.device.pushErrorScope("out-of-memory");
    const output = this.#output(room);
    this.growing = this.device.popErrorScope().then((error) => {
      this.growing = undefined;
      if (error) {
        // The present room stays usable; asking again in each frame would not help.
        this.room.isFixed = true;
        return output.destroy();
      }
      // An encoder of the last frame may not be submitted yet.
      this.retired.push({ output: this.output, until: this.frames + 1 });
      this.output = output;
    }, () => this.growing = undefined);
  }

  get feedback() {
    return this.feedbacks.last;
  }

  // The buffers of the last frame, for a render pipeline of the caller's.
  get vertices() {
    return this.output.vertices ?? this.output.batch.buffers.points;
  }

  get indices() {
    return this.output.batch.buffers.indices;
  }

  get indirect() {
    return this.output.batch.buffers.arguments;
  }

  // The arguments of one draw for each mesh, 20 bytes apart; undefined without meshes.
  get meshIndirect() {
    return this.meshes?.draws;
  }

  get vertexLayout() {
    if (this.pull) return undefined;
    if (!this.evaluate) return { arrayStride: 8, attributes: [{ shaderLocation: 0, offset: 0, format: "uint32x2" }] };
    const attributes = this.layout.attributes.map(({ shaderLocation, offset, format }) => ({ shaderLocation, offset, format }));
    return { arrayStride: this.layout.stride, attributes };
  }

  setFactors(factors) {
    need(!this.hasHull, "setFactors is for a stage without a function `hull`, which gives the factors here");
    const each = this.tessellator.manifest.setup.factors_per_patch, count = factors?.length / each;
    need(Number.isInteger(count) && typeof factors !== "string", `setFactors takes an array of numbers, ${each} for each patch`);
    needPatches("setFactors", count, this.patches);
    this.device.queue.writeBuffer(this.buffers.given_factors, 0, new Float32Array(factors));
  }

  setMeshes(first) {
    need(Array.isArray(first), `setMeshes takes an array of the meshes' first patches, such as [0, 40], not ${JSON.stringify(first)}`);
    const meshes = first.length > 0 ? new Meshes(this.device, this.manifest, first, this.patches) : undefined;
    // The last frame may not be submitted yet.
    if (this.meshes) this.retired.push({ output: this.meshes, until: this.frames + 1 });
    this.meshes = meshes;
  }

  prepare(encoder, { patches = this.patches, groups = [], instances = 1 } = {}) {
    needEncoder("prepare", encoder);
    const count = this.#count(patches);
    const users = this.layouts.length;
    need(groups.length === users, `prepare takes ${users} bind groups, one for each of \`layouts\`, not ${groups.length}`);
    const frame = this.frames++;
    if (frame > 0) this.feedbacks.ask();
    this.#adapt();
    const done = this.feedback?.frame ?? -1;
    this.retired = this.retired.filter(({ output, until }) => until > done || output.destroy());

    const { output, buffers, device } = this;
    // The frame's numbers travel in a buffer of their own, so that frames may be recorded ahead or dropped.
    const header = device.createBuffer({ label: "frame", size: 20, usage: GPUBufferUsage.COPY_SRC, mappedAtCreation: true });
    new Uint32Array(header.getMappedRange()).set([count.number, ...output.room, frame + 1, instances]);
    header.unmap();
    encoder.copyBufferToBuffer(count.buffer ?? header, count.offset, buffers.patch_count, 0, 4);
    encoder.copyBufferToBuffer(header, 4, buffers.terms, 0, 8);
    if (this.isCoarser) encoder.clearBuffer(buffers.fit);
    this.#encode(encoder, output.before, groups);
    output.batch.encode(encoder);
    encoder.copyBufferToBuffer(header, 16, output.batch.buffers.arguments, INSTANCES_AT, 4);
    this.meshes?.encode(encoder, this.meshPass, output.batch.buffers, [header, 16]);
    this.#encode(encoder, output.after, groups);
    this.feedbacks.record(encoder, [header, 12], output.batch.buffers, this.isCoarser ? buffers.fit : undefined, frame);
    return Object.freeze({ stage: this, number: frame, output, meshes: this.meshes });
  }

  // A frame's number of patches: a number, or a buffer of the device and the byte where its number is.
  #count(patches) {
    if (!patches?.buffer) {
      needPatches("prepare", patches, this.patches);
      return { number: patches, offset: 0 };
    }
    const { buffer, offset = 0 } = patches, { size, usage } = buffer;
    if (Number.isInteger(offset) && offset % 4 === 0 && offset >= 0 && offset + 4 <= size && usage & GPUBufferUsage.COPY_SRC) {
      return { number: 0, buffer, offset };
    }
    throw new RangeError(`prepare reads the number of patches from byte ${offset} of a buffer of ${size} bytes with the usages ` +
      `${usage}: the byte has to be a multiple of 4 inside of it, and the usages need GPUBufferUsage.COPY_SRC`);
  }

  // A pass of WebGPU for each, so that no buffer is bound as storage where its words are the size of a dispatch.
  #encode(encoder, passes, users) {
    for (const { pipeline, own, groups, workgroups } of passes) {
      const pass = encoder.beginComputePass();
      pass.setPipeline(pipeline);
      if (own > 0) setGroups(pass, users);
      groups.forEach((group, number) => pass.setBindGroup(own + number, group));
      if (workgroups === "fit_arguments") pass.dispatchWorkgroupsIndirect(this.buffers.fit_arguments, 0);
      else if (workgroups === "patches") pass.dispatchWorkgroups(...this.rows);
      else pass.dispatchWorkgroups(workgroups === "points" ? Math.max(this.output.workgroups, 1) : 1);
      pass.end();
    }
  }

  async makeRoom(options) {
    const encoder = this.device.createCommandEncoder();
    const { number } = this.prepare(encoder, options);
    this.device.queue.submit([encoder.finish()]);
    // An answer that is under way may be one to an earlier question.
    for (let asked = 0; asked < 2 && !(this.feedback?.frame >= number); asked++) await this.feedbacks.ask();
    this.#adapt();
    await this.growing;
    return this.feedback;
  }

  material(options) {
    return Material.make(this, options);
  }

  destroy() {
    [this.output, this.feedbacks, ...(this.meshes ? [this.meshes] : []), ...this.retired.map(({ output }) => output), ...Object.values(this.buffers)]
      .forEach((one) => one.destroy());
  }
}
