// Draws the frames of a stage: with a fragment shader, as a shadow map, as a depth prepass.

import { bindGroup, need, setGroups, typeOf } from "./common.js";
import { compile, uses, vertexModule } from "./compose.js";
import { DRAW_BYTES } from "./meshes.js";

export class Material {
  static async make(stage, { wgsl, project, fragment, targets = [], layouts = [], constants, primitive, ...state } = {}) {
    const { device, manifest, evaluate, pull, layout } = stage;
    need(!layout || layout.isDrawable, "to draw with a material, `vertex` needs the member position: \"vec4f\", in clip space");
    // A material without the others' camera would be drawn in another place, mostly out of sight.
    const { projects } = stage, other = project === undefined && [...projects].find((one) => one);
    need(!other, `another material of this stage calls \`${other}\`: give this one its \`project\`, or null if it needs none`);
    need(!project || !projects.has(undefined), `an earlier material of this stage has no \`project\`, and this one calls ` +
      `\`${project}\`: give that one its \`project\`, or null if it needs none`);
    const user = stage.text(wgsl);
    const { parts } = manifest, own = layouts.length;
    const code = vertexModule(parts, user, own, { project: project ?? "", vertex: evaluate ? layout : undefined, pull });
    const needs = "fn domain(number: u32, uv: vec2f) -> Vertex";
    const module = await compile(device, "material", code, user, needs);
    const bindings = Material.#bindings(manifest, pull, uses(user, "tess_factors"));
    const ownLayout = bindings.length > 0 ? device.createBindGroupLayout({ entries: bindings.map((one) =>
      ({ binding: one.binding, visibility: one.visibility, buffer: { type: typeOf(one) } })) }) : undefined;
    const bindGroupLayouts = [...layouts, ...(ownLayout ? [ownLayout] : [])];
    // Without WGSL of its own it has the stage's, with the stage's constants.
    const values = constants ?? (wgsl === undefined ? stage.constants : undefined);
    const { domain } = stage.tessellator.manifest.setup;
    const pipeline = await device.createRenderPipelineAsync({
      ...state,
      layout: device.createPipelineLayout({ bindGroupLayouts }),
      vertex: { module, entryPoint: "tess_vertex", constants: values, buffers: pull ? [] : [stage.vertexLayout] },
      fragment: targets.length > 0 ? { module, entryPoint: fragment, constants: values, targets } : undefined,
      primitive: { ...primitive, topology: domain === "isoline" ? "line-list" : "triangle-list" },
    });
    projects.add(project);
    return Object.assign(new Material(), { stage, pipeline, own, bindings, ownLayout, groups: new WeakMap() });
  }

  // What draws bind of the stage, after the user's groups: the factors that `tess_factors` reads, and what points are computed from.
  static #bindings(manifest, pull, hasFactors) {
    const { VERTEX, FRAGMENT } = GPUShaderStage;
    const factors = manifest.after_batch[0].bindings.filter(({ buffer }) => hasFactors && buffer === "factors");
    const pulled = (pull ? manifest.pulled : []).map((one) => ({ ...one, visibility: VERTEX }));
    return [...pulled, ...factors.map((one) => ({ ...one, visibility: VERTEX | FRAGMENT }))];
  }

  // Their bind group over an output.
  #group(output) {
    if (!this.groups.has(output)) {
      const { device, tessellator: { manifest } } = this.stage;
      this.groups.set(output, bindGroup(device, this.ownLayout, this.bindings, output.all, manifest.job_stride));
    }
    return this.groups.get(output);
  }

  draw(pass, frame, groups = []) {
    this.#draw("draw", pass, frame, groups);
    this.#issue(pass, frame.output.batch.buffers.arguments, 0);
  }

  drawMesh(pass, frame, mesh, groups = []) {
    this.#draw("drawMesh", pass, frame, groups);
    const count = frame.meshes?.count ?? 0;
    if (!(Number.isInteger(mesh) && mesh >= 0 && mesh < count)) {
      throw new RangeError(`there is no mesh ${mesh}: the frame has ${count}; \`meshes\` of Stage.load or setMeshes names their first patches`);
    }
    this.#issue(pass, frame.meshes.draws, DRAW_BYTES * mesh);
  }

  // Sets everything but the arguments.
  #draw(call, pass, frame, groups) {
    need(pass?.drawIndexedIndirect, `${call} takes the render pass and the frame that \`prepare\` returned`);
    need(frame?.stage === this.stage, "this is not a frame of the material's stage; draw what its `prepare` returned");
    const last = this.stage.frames - 1;
    if (frame.number !== last) throw new RangeError(`frame ${frame.number} is gone: its stage has prepared frame ${last}`);
    need(groups.length === this.own, `${call} takes ${this.own} bind groups, one for each of \`layouts\`, not ${groups.length}`);
    const { batch: { buffers }, vertices } = frame.output;
    pass.setPipeline(this.pipeline);
    setGroups(pass, groups);
    if (this.ownLayout) pass.setBindGroup(this.own, this.#group(frame.output));
    if (!this.stage.pull) pass.setVertexBuffer(0, vertices ?? buffers.points);
    if (buffers.indices) pass.setIndexBuffer(buffers.indices, "uint32");
  }

  #issue(pass, draws, at) {
    // The first four arguments of an indexed draw are those of one without indices.
    if (this.stage.pull === "corners") pass.drawIndirect(draws, at);
    else pass.drawIndexedIndirect(draws, at);
  }
}
