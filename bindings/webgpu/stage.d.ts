/// <reference types="@webgpu/types" />

import type { Setup } from "./tess.js";

// An argument of another type than those below is a `TypeError` that names what the function takes; a number out of its
// range is a `RangeError`.

/** A type of WGSL that a member can have. */
export type MemberType =
  | "f32" | "vec2f" | "vec3f" | "vec4f" | "u32" | "vec2u" | "vec3u" | "vec4u" | "i32" | "vec2i" | "vec3i" | "vec4i";

/** The members of a struct, in order. */
export type Members = Readonly<Record<string, MemberType>>;

export interface StageOptions extends Setup {
  /** The most patches of a frame. */
  patches: number;
  /**
   * Functions in WGSL, with what they need. `fn hull(number: u32) -> QuadFactors` gives the factors of a patch, or
   * `TriFactors` or `IsolineFactors`; without it, `setFactors` does. `fn domain(number: u32, uv: vec2f) -> Vertex` makes a
   * vertex. Both may call the helpers of the stage in the table of
   * https://github.com/tess-model/tess/blob/main/tess-wgpu/README.md#the-tessellation-stage. Names that begin with `tess_`
   * are the stage's. Directives such as `enable` are not possible together with `vertex`.
   */
  wgsl?: string;
  /**
   * The members of `struct Vertex`, if the WGSL does not declare it. `position: "vec4f"` is the builtin that is drawn; the
   * other members get the locations 0, 1, ... and the position the next one.
   */
  vertex?: Members;
  /** The layouts of your bind groups, which `hull` and, with `evaluate`, `domain` read: visible to `COMPUTE`. */
  layouts?: GPUBindGroupLayout[];
  /** Values of the `override`s of the WGSL, by name. */
  constants?: Readonly<Record<string, number>>;
  /**
   * Meshes that are drawn one by one, with `Material.drawMesh`: the number of each one's first patch. The numbers ascend, and a
   * mesh ends where the next one begins. `setMeshes` replaces them. Default: none.
   */
  meshes?: number[];
  /**
   * Whether a pass calls `domain` once for each point and keeps the vertices, which all draws then load; `vertex` must be
   * given. Otherwise the vertex shader of each draw calls it. Default: false.
   */
  evaluate?: boolean;
  /**
   * Where nothing stores points: with `points` the vertex shader computes each from its index, and with `corners` it computes
   * the points of each corner of each primitive, so that there are neither points nor indices in memory. The triangles and their
   * order are the same. Draws then bind five storage buffers and a uniform buffer more. Not together with `evaluate`. Default:
   * points are stored, 8 bytes each.
   */
  pull?: "points" | "corners";
  /**
   * The fate of a frame that does not fit: `coarser` multiplies all factors above 1 by one scale, on the device, so that it
   * fits and edges stay closed; with `nothing`, nothing is drawn. Default: `coarser`.
   */
  overflow?: "coarser" | "nothing";
  /** The most bytes of points, vertices and indices together. Default: 256 MiB. */
  budget?: number;
}

/** What a frame needed, and what it drew. */
export interface Feedback {
  frame: number;
  /** Points and primitives of the factors before they were scaled. */
  points: number;
  primitives: number;
  /** Primitives that were drawn. */
  drawn: number;
  /** The scale of the factors; 1 if everything fitted. */
  scale: number;
}

/** A bind group, alone or with the dynamic offsets of its buffers in bytes. */
export type Group = GPUBindGroup | { group: GPUBindGroup; offsets: number[] };

/** The number of patches in a buffer of the device: a u32 at `offset`, a multiple of 4 bytes that is 0 by default. */
export interface DeviceCount { buffer: GPUBuffer; offset?: number }

/** A prepared frame. It can be drawn until its stage prepares the next one. */
export interface Frame { readonly stage: Stage; readonly number: number }

export interface FrameOptions {
  /**
   * The number of patches; by default as many as the stage was made for. A number in a buffer, which needs the usage `COPY_SRC`,
   * is read when the frame runs; if it is larger, all patches are drawn that the stage was made for.
   */
  patches?: number | DeviceCount;
  /** Your bind groups, one for each of `layouts`. */
  groups?: Group[];
  /** The instances of each draw; in WGSL, `tess_instance()` is the number of the one that is drawn. Default: 1. */
  instances?: number;
}

/**
 * The hull and domain stage. It has room for all patches at factor 4 at first, and grows or shrinks with what frames need,
 * which it learns a frame or two late and without waiting. A buffer is at most as large as the device binds
 * (`maxStorageBufferBindingSize`).
 */
export class Stage {
  /** Loads and compiles everything. Rejects with the line of your WGSL that is wrong. */
  static load(device: GPUDevice, options: StageOptions): Promise<Stage>;
  /**
   * Sets the factors of the first patches, as `Tessellator.tessellate` takes them, for a stage without `hull`. All frames
   * that are submitted afterwards have them.
   */
  setFactors(factors: ArrayLike<number>): void;
  /**
   * Replaces the meshes, from the next frame on. Nothing is compiled. Throws a `RangeError` if a number is less than the one
   * before it or exceeds the most patches.
   */
  setMeshes(first: number[]): void;
  /** Records the passes of a frame. Submit the encoder before or with the one that draws. */
  prepare(encoder: GPUCommandEncoder, options?: FrameOptions): Frame;
  /** Runs a frame, waits for its numbers and makes the room that it needs: the next frame with these factors is exact. */
  makeRoom(options?: FrameOptions): Promise<Feedback>;
  /** Compiles a material. */
  material(options: MaterialOptions): Promise<Material>;
  /** The latest frame whose numbers have arrived. */
  readonly feedback: Feedback | undefined;
  /**
   * Vertex buffer of the last frame: `Vertex` structs with `evaluate`, otherwise packed points; undefined with `pull`. Fetch it in
   * each frame.
   */
  readonly vertices: GPUBuffer | undefined;
  /** Index buffer of the last frame, 32 bits each; undefined with `pull: "corners"`. */
  readonly indices: GPUBuffer | undefined;
  /** Arguments of `drawIndexedIndirect` of the last frame, at offset 0; of `drawIndirect` with `pull: "corners"`. */
  readonly indirect: GPUBuffer;
  /** The same for each mesh, 20 bytes apart; undefined without meshes. */
  readonly meshIndirect: GPUBuffer | undefined;
  /** The layout of `vertices`. */
  readonly vertexLayout: GPUVertexBufferLayout | undefined;
  /** Frees the buffers. */
  destroy(): void;
}

/** What a render pipeline takes, except for layout and vertex state. */
export interface MaterialOptions extends Omit<GPURenderPipelineDescriptor, "layout" | "vertex" | "fragment"> {
  /** By default the stage's WGSL. */
  wgsl?: string;
  /**
   * The name of a function `fn name(vertex: Vertex) -> Vertex` that each draw calls, such as one with a camera. A stage's
   * materials have one or none of them has: otherwise the later one is refused. Null says that a material needs none.
   */
  project?: string | null;
  /** The fragment shader's name, if the WGSL has several. */
  fragment?: string;
  /** The colour targets; without them nothing but depth is drawn. */
  targets?: GPUColorTargetState[];
  /** The layouts of the bind groups of the draws. */
  layouts?: GPUBindGroupLayout[];
  /** Values of the `override`s of the WGSL; by default those of the stage, if the WGSL is the stage's. */
  constants?: Readonly<Record<string, number>>;
}

export interface Material {
  /** Draws a frame; `groups` are your bind groups, one for each of `layouts`. Throws if the frame is not the last one. */
  draw(pass: GPURenderPassEncoder, frame: Frame, groups?: Group[]): void;
  /** Draws one of the frame's meshes, by its number from 0. Throws a `RangeError` if the frame has no such mesh. */
  drawMesh(pass: GPURenderPassEncoder, frame: Frame, mesh: number, groups?: Group[]): void;
}
