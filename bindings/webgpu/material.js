// Draws the frames of a stage: with a fragment shader, as a shadow map, as a depth prepass.

import { bindingType, need } from "./common.js";
import { compile, uses, vertexModule } from "./compose.js";

export class Material {
  static async make(stage, { wgsl, project, fragment, targets = [], layouts = [], primitive, ...state } = {}) {
    const { device, manifest, evaluate, layout } = stage;
    need(!layout || layout.isDrawable, "to draw with a material, `vertex` needs the member position: \"vec4f\", in clip space");
    // A material without the others' camera would be drawn in another place, mostly out of sight.
    const { projects } = stage, other = project === undefined && [...projects].find((one) => one);
    need(!other, `another material of this stage calls \`${other}\`: give this one its \`project\`, or null if it needs none`);
    need(!project || !projects.has(undefined), `an earlier material of this stage has no \`project\`, and this one calls ` +
      `\`${project}\`: give that one its \`project\`, or null if it needs none`);
    const user = stage.text(wgsl);
    const { parts } = manifest, own = layouts.length;
    const code = vertexModule(parts, user, own, { project: project ?? "", vertex: evaluate ? layout : undefined });
    const needs = "fn domain(number: u32, uv: vec2f) -> Vertex";
    const module = await compile(device, "material", code, user, needs);
    const factors = uses(user, "tess_factors") ? Material.#factors(stage) : undefined;
    const bindGroupLayouts = [...layouts, ...(factors ? [factors.layout] : [])];
    const { domain } = stage.tessellator.manifest.setup;
    const pipeline = await device.createRenderPipelineAsync({
      ...state,
      layout: device.createPipelineLayout({ bindGroupLayouts }),
      vertex: { module, entryPoint: "tess_vertex", buffers: [stage.vertexLayout] },
      fragment: targets.length > 0 ? { module, entryPoint: fragment, targets } : undefined,
      primitive: { ...primitive, topology: domain === "isoline" ? "line-list" : "triangle-list" },
    });
    projects.add(project);
    return Object.assign(new Material(), { stage, pipeline, own, factors: factors?.group });
  }

  // The bind group of the factors that `tess_factors` reads.
  static #factors({ device, manifest, buffers }) {
    const { binding, is_written } = manifest.after_batch[0].bindings.find(({ buffer }) => buffer === "factors");
    const visibility = GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT;
    const layout = device.createBindGroupLayout({ entries: [{ binding, visibility, buffer: { type: bindingType(is_written) } }] });
    const entries = [{ binding, resource: { buffer: buffers.factors } }];
    return { layout, group: device.createBindGroup({ layout, entries }) };
  }

  draw(pass, frame, groups = []) {
    need(pass?.drawIndexedIndirect, "draw takes the render pass and the frame that `prepare` returned");
    need(frame?.stage === this.stage, "this is not a frame of the material's stage; draw what its `prepare` returned");
    const last = this.stage.frames - 1;
    if (frame.number !== last) throw new RangeError(`frame ${frame.number} is gone: its stage has prepared frame ${last}`);
    need(groups.length === this.own, `draw takes ${this.own} bind groups, one for each of \`layouts\`, not ${groups.length}`);
    const { batch: { buffers }, vertices } = frame.output;
    pass.setPipeline(this.pipeline);
    groups.forEach((group, number) => pass.setBindGroup(number, group));
    if (this.factors) pass.setBindGroup(this.own, this.factors);
    pass.setVertexBuffer(0, vertices ?? buffers.points);
    pass.setIndexBuffer(buffers.indices, "uint32");
    pass.drawIndexedIndirect(buffers.arguments, 0);
  }
}
