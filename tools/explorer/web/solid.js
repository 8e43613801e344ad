// A surface tessellated by the shaders of `tess-gpu` and drawn by WebGPU. Points and indices stay on the GPU.

import { open } from "./gpu.js";

// Goes behind the WGSL of `SurfaceView`. Depths are from 0 to 1 here.
const DRAW = `
struct Scene { matrix: mat4x4f, edge: vec4f, light: vec3f, width: f32 }
struct Vertex {
  @builtin(position) place: vec4f,
  @location(0) normal: vec3f,
  @location(1) corner: vec3f,
}
@group(0) @binding(0) var<uniform> scene: Scene;
@group(0) @binding(1) var<storage> nets: array<vec4f>;
@group(0) @binding(2) var<storage> points: array<vec2u>;
@group(0) @binding(3) var<storage> indices: array<u32>;

fn vertex(point: vec2u, corner: vec3f) -> Vertex {
  let u = f32(point.x & 0x1ffffu) / 65536.0;
  let v = f32((point.x >> 17u) | ((point.y & 3u) << 15u)) / 65536.0;
  let number = point.y >> 2u;
  let place = scene.matrix * vec4f(surface_position(number, u, v), 1.0);
  let depth = 0.5 * (place.z + place.w);
  return Vertex(vec4f(place.xy, depth, place.w), surface_normal(number, u, v), corner);
}

@vertex fn shared_vertex(@location(0) point: vec2u) -> Vertex {
  return vertex(point, vec3f(1.0));
}

// An edge needs to know which corner of its triangle a vertex is, so vertices are not shared.
@vertex fn own_vertex(@builtin(vertex_index) k: u32) -> Vertex {
  return vertex(points[indices[k]], vec3f(vec3u(k % 3u) == vec3u(0u, 1u, 2u)));
}

@fragment fn shade(vertex: Vertex) -> @location(0) vec4f {
  let pixels = vertex.corner / max(fwidth(vertex.corner), vec3f(1e-9));
  let distance = min(min(pixels.x, pixels.y), pixels.z);
  let near = select(0.0, 1.0 - smoothstep(scene.width - 0.5, scene.width + 0.5, distance), scene.width > 0.0);
  let light = 0.45 + 0.55 * abs(dot(normalize(vertex.normal), scene.light));
  return vec4f(mix(COLOUR * light, scene.edge.rgb, near * scene.edge.a), 1.0);
}`;

const SAMPLES = 4;
const SCENE_BYTES = 96;

export class Solid {
  // Draws on `canvas`. An error says why it cannot; `colour` is the surface's, from 0 to 1.
  static async on(canvas, colour) {
    const gpu = await open();
    const context = canvas.getContext("webgpu");
    if (!context) throw new Error("this browser has WebGPU but no canvas for it");
    return new Solid(gpu, context, `const COLOUR = vec3f(${colour});`);
  }

  constructor(gpu, context, colour) {
    Object.assign(this, { gpu, context, colour, prepared: null, targets: null, isStale: true });
    const { device } = gpu;
    this.format = navigator.gpu.getPreferredCanvasFormat();
    context.configure({ device, format: this.format, alphaMode: "premultiplied" });
    this.scene = device.createBuffer({ size: SCENE_BYTES, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
    const { VERTEX, FRAGMENT } = GPUShaderStage;
    const read = { type: "read-only-storage" };
    this.layout = device.createBindGroupLayout({ entries: [
      { binding: 0, visibility: VERTEX | FRAGMENT, buffer: {} },
      ...[1, 2, 3].map((binding) => ({ binding, visibility: VERTEX, buffer: read })),
    ] });
  }

  // Makes what depends on the surface and its partitioning.
  async load(surface) {
    const { device } = this.gpu;
    const batch = surface.batch(), nets = surface.nets(), code = this.colour + DRAW + surface.wgsl();
    device.pushErrorScope("validation");
    try {
      const prepared = await this.gpu.prepare(batch);
      this.release();
      this.nets = device.createBuffer({ size: nets.byteLength, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST });
      device.queue.writeBuffer(this.nets, 0, nets);
      const buffers = [this.scene, this.nets, prepared.buffers.points, prepared.buffers.indices];
      const entries = buffers.map((buffer, binding) => ({ binding, resource: { buffer } }));
      this.group = device.createBindGroup({ layout: this.layout, entries });
      const module = device.createShaderModule({ label: "surface", code });
      [this.filled, this.wired] = await Promise.all([this.pipeline(module, true), this.pipeline(module, false)]);
      this.prepared = prepared;
    } finally {
      batch.free();
      const error = await device.popErrorScope();
      if (error) throw new Error(error.message);
    }
  }

  pipeline(module, isShared) {
    const point = { arrayStride: 8, attributes: [{ shaderLocation: 0, offset: 0, format: "uint32x2" }] };
    return this.gpu.device.createRenderPipelineAsync({
      layout: this.gpu.device.createPipelineLayout({ bindGroupLayouts: [this.layout] }),
      vertex: { module, entryPoint: isShared ? "shared_vertex" : "own_vertex", buffers: isShared ? [point] : [] },
      fragment: { module, entryPoint: "shade", targets: [{ format: this.format }] },
      depthStencil: { format: "depth24plus", depthWriteEnabled: true, depthCompare: "less" },
      multisample: { count: SAMPLES },
    });
  }

  setFactors(words) {
    this.gpu.device.queue.writeBuffer(this.prepared.buffers.factors, 0, words);
    this.isStale = true;
  }

  // Draws, and tessellates first if there are new factors; resolves when the GPU is done.
  async draw({ matrix, edge, width, light }) {
    const { gpu: { device }, context: { canvas }, prepared } = this, { buffers } = prepared;
    device.queue.writeBuffer(this.scene, 0, new Float32Array([...matrix, ...edge, ...light, width]));
    const encoder = device.createCommandEncoder();
    if (this.isStale) prepared.encode(encoder);
    this.isStale = false;
    const [colour, depth] = this.targetsOf(canvas);
    const pass = encoder.beginRenderPass({
      colorAttachments: [{ view: colour, resolveTarget: this.context.getCurrentTexture().createView(), loadOp: "clear", storeOp: "discard" }],
      depthStencilAttachment: { view: depth, depthClearValue: 1, depthLoadOp: "clear", depthStoreOp: "discard" },
    });
    pass.setBindGroup(0, this.group);
    if (width > 0) {
      // The first four arguments of an indexed draw are those of one that counts its vertices.
      pass.setPipeline(this.wired);
      pass.drawIndirect(buffers.arguments, 0);
    } else {
      pass.setPipeline(this.filled);
      pass.setVertexBuffer(0, buffers.points);
      pass.setIndexBuffer(buffers.indices, "uint32");
      pass.drawIndexedIndirect(buffers.arguments, 0);
    }
    pass.end();
    device.queue.submit([encoder.finish()]);
    await device.queue.onSubmittedWorkDone();
  }

  // Colour and depth as large as the canvas.
  targetsOf({ width, height }) {
    if (this.targets?.width !== width || this.targets.height !== height) {
      this.targets?.textures.forEach((texture) => texture.destroy());
      const textures = [this.format, "depth24plus"].map((format) => this.gpu.device.createTexture(
        { size: [width, height], format, sampleCount: SAMPLES, usage: GPUTextureUsage.RENDER_ATTACHMENT }));
      this.targets = { width, height, textures, views: textures.map((texture) => texture.createView()) };
    }
    return this.targets.views;
  }

  // How many points and triangles the GPU made.
  async counts() {
    const [points, , triangles] = await this.gpu.read(this.prepared.buffers.status);
    return [points, triangles];
  }

  release() {
    this.prepared?.destroy();
    this.nets?.destroy();
    this.prepared = null;
  }
}
