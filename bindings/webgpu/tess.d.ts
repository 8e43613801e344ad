/// <reference types="@webgpu/types" />

/** WGSL: `tess_point(packed: vec2u) -> TessPoint { uv: vec2f, of_patch: u32 }`, the vertex buffer's two words unpacked. */
export const unpackWgsl: string;

export interface Setup {
  domain: "isoline" | "tri" | "quad";
  partitioning: "integer" | "pow2" | "fractional_odd" | "fractional_even";
  /** Where the folders of shaders are; beside the module unless given. */
  base?: URL | string;
}

export interface Room { points: number; primitives: number }

export interface Output {
  /** u and v of each point, exact. */
  uv: Float32Array;
  /** The patch of each point. */
  patches: Uint32Array;
  /** Two a line (isoline) or three a triangle, clockwise; they count through the batch. */
  indices: Uint32Array;
}

export class Tessellator {
  /** Loads the shaders. Rejects if there is no such setup. */
  static load(device: GPUDevice, setup: Setup): Promise<Tessellator>;
  /** Counts, makes room, tessellates and reads back. Factors are patch after patch: 2 (isoline), 4 (tri) or 6 (quad). */
  tessellate(factors: ArrayLike<number>): Promise<Output>;
  /** Buffers to use again and again, with room for one point and primitive unless given. Throws a `RangeError`. */
  batch(patches: number, room?: Room): Batch;
}

export interface Batch {
  /** `factors` to write; `points`, `indices` and `arguments` for `drawIndexedIndirect` at 0; `status` (docs/shaders.md). */
  readonly buffers: Readonly<Record<string, GPUBuffer>>;
  /** Records the dispatches. If the room is too small, `status` says so and nothing is drawn. */
  encode(encoder: GPUCommandEncoder): void;
  /** Runs, and gives the words of buffers. */
  read(names: string[]): Promise<Record<string, Uint32Array>>;
  destroy(): void;
}
