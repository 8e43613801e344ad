// The source of a geometry on the GPU: the stage evaluates the vertices, which three.js draws indirectly.
//
// three has no public way to give it a buffer of the GPU. Two members of `renderer.backend` are used here and nowhere else:
// `device`, and the record `get(attribute).buffer`, where three looks for an attribute's buffer before it makes one.

import { BufferAttribute, IndirectStorageBufferAttribute, InterleavedBuffer, InterleavedBufferAttribute } from "three/webgpu";
import { membersOf } from "./compose.js";
import { need } from "./common.js";
import { Stage } from "./stage.js";

// Points as they are, for materials that move them (`positionNode`): u, v and the patch's number.
const PLAIN = {
  vertex: { position: "vec3f", uv: "vec2f" },
  wgsl: "\nfn domain(number: u32, uv: vec2f) -> Vertex { return Vertex(vec3f(uv, f32(number)), uv); }",
};

export class GpuSource {
  static async load({ backend }, { uniforms, wgsl = "", vertex, ...options }) {
    const { device } = backend;
    const own = uniforms ? new Uniforms(device, uniforms) : undefined;
    const stage = await Stage.load(device, {
      ...options, evaluate: true, layouts: own ? [own.layout] : [], vertex: vertex ?? PLAIN.vertex,
      wgsl: (own?.wgsl ?? "") + wgsl + (vertex ? "" : PLAIN.wgsl),
    });
    return Object.assign(new GpuSource(), { backend, stage, uniforms: own });
  }

  attach(geometry) {
    const { attributes, stride } = this.stage.layout;
    need(attributes.some(({ name }) => name === "position"), "`vertex` needs a member `position`, as three.js names it");
    // Arrays of one vertex: only their types matter, because the buffers come from the stage.
    this.vertices = new InterleavedBuffer(new Float32Array(stride / 4), stride / 4);
    for (const { name, type, count, offset } of attributes) {
      need(type.includes("f32"), `\`${name}\` has the type ${type}; members of \`vertex\` are floats here`);
      geometry.setAttribute(name, new InterleavedBufferAttribute(this.vertices, count, offset / 4));
    }
    geometry.setIndex(new BufferAttribute(new Uint32Array(3), 1));
    geometry.setIndirect(new IndirectStorageBufferAttribute(5, 5));
    this.#hand(geometry);
  }

  // Hands the stage's buffers to three. A stage replaces them when it changes its room.
  #hand({ index, indirect }) {
    const { stage, backend, vertices } = this;
    backend.get(vertices).buffer = stage.vertices;
    backend.get(index).buffer = stage.indices;
    backend.get(indirect).buffer = stage.indirect;
  }

  #options({ patches, instances, factors, ...values }) {
    const unknown = Object.keys(values).find((name) => !this.uniforms?.has(name));
    need(unknown === undefined, `there is no uniform \`${unknown}\`; \`uniforms\` of TessellatedGeometry.load names them`);
    if (factors) this.stage.setFactors(factors);
    this.uniforms?.set(values);
    return { patches, instances, groups: this.uniforms ? [this.uniforms.group] : [] };
  }

  update(geometry, values) {
    const { device } = this.stage;
    const encoder = device.createCommandEncoder();
    this.stage.prepare(encoder, this.#options(values));
    device.queue.submit([encoder.finish()]);
    this.#hand(geometry);
  }

  async makeRoom(geometry, values) {
    const feedback = await this.stage.makeRoom(this.#options(values));
    this.#hand(geometry);
    return feedback;
  }

  get feedback() {
    return this.stage.feedback;
  }

  destroy() {
    this.stage.destroy();
    this.uniforms?.buffer.destroy();
  }
}

// A uniform buffer of the user's members, as @group(0) @binding(0) of the WGSL's first line.
class Uniforms {
  constructor(device, given) {
    const { members, end } = membersOf("uniforms", given);
    const text = members.map(({ name, type }) => `${name}: ${type}`).join(", ");
    this.wgsl = `struct Uniforms { ${text} } @group(0) @binding(0) var<uniform> uniforms: Uniforms; `;
    this.words = new DataView(new ArrayBuffer(Math.ceil(end / 16) * 16));
    const { UNIFORM, COPY_DST } = GPUBufferUsage, { COMPUTE } = GPUShaderStage;
    this.buffer = device.createBuffer({ label: "uniforms", size: this.words.byteLength, usage: UNIFORM | COPY_DST });
    this.layout = device.createBindGroupLayout({ entries: [{ binding: 0, visibility: COMPUTE, buffer: { type: "uniform" } }] });
    this.group = device.createBindGroup({ layout: this.layout, entries: [{ binding: 0, resource: { buffer: this.buffer } }] });
    Object.assign(this, { device, members });
  }

  has(name) {
    return this.members.some((one) => one.name === name);
  }

  // Numbers, arrays of numbers, and the vectors and colours of three.js.
  set(values) {
    for (const { name, type, count, offset } of this.members) {
      if (!(name in values)) continue;
      const given = values[name]?.toArray?.() ?? [values[name]].flat();
      need(given.length === count && given.every((one) => typeof one === "number"), `the uniform \`${name}\` takes ${count} numbers`);
      const write = type.includes("f32") ? "setFloat32" : type.includes("u32") ? "setUint32" : "setInt32";
      given.forEach((one, i) => this.words[write](offset + 4 * i, one, true));
    }
    this.device.queue.writeBuffer(this.buffer, 0, this.words.buffer);
  }
}
