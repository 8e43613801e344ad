/// <reference types="@webgpu/types" />

/** WGSL: `tess_point(packed: vec2u) -> TessPoint { uv: vec2f, of_patch: u32 }` unpacks the two words of a vertex. */
export const unpackWgsl: string;

/** A module of WGSL functions; `shaders/surfaces/README.md` has a table of them. */
export type SurfaceModule =
  | "flat" | "pn_edge" | "factors" | "culling" | "height"
  | "bezier" | "bezier_factors" | "pn" | "pn_triangle" | "displacement";

/**
 * The WGSL of these modules and of those that they need, to put before shaders of yours. `base` is as in `Setup`. Rejects
 * with a `RangeError` if there is no such module.
 */
export function surfacesWgsl(names: SurfaceModule[], base?: URL | string): Promise<string>;

export interface Setup {
  domain: "isoline" | "tri" | "quad";
  partitioning: "integer" | "pow2" | "fractional_odd" | "fractional_even";
  /** The folder `shaders` of the package, with a slash at its end; by default it is beside the module. */
  base?: URL | string;
}

/** Elements that a batch has memory for. */
export interface Room { points: number; primitives: number }

export interface Output {
  /** u and v of each point, exact. */
  uv: Float32Array;
  /** The patch of each point. */
  patches: Uint32Array;
  /** Two for each line (isoline) or three for each triangle, clockwise; they count through the batch. */
  indices: Uint32Array;
}

export class Tessellator {
  /** Loads the shaders. Rejects with a `RangeError` if there is no such setup. */
  static load(device: GPUDevice, setup: Setup): Promise<Tessellator>;
  /**
   * Counts, makes room, tessellates and reads back. Factors are patch after patch: 2 (isoline), 4 (tri) or 6 (quad). Rejects
   * with a `RangeError` if they are not whole patches.
   */
  tessellate(factors: ArrayLike<number>): Promise<Output>;
  /** Buffers for many frames, with room for one point and one primitive by default. Throws a `RangeError`. */
  batch(patches: number, room?: Room): Batch;
}

export interface Batch {
  /**
   * `factors`, which you write; `points`, `indices`, and `arguments` for `drawIndexedIndirect` at offset 0; `status`:
   * https://github.com/tess-model/tess/blob/main/docs/shaders.md explains it.
   */
  readonly buffers: Readonly<Record<string, GPUBuffer>>;
  /** Records the dispatches. If the room is too small, nothing is drawn, and `status` has the room that is needed. */
  encode(encoder: GPUCommandEncoder): void;
  /** Runs the batch and returns the words of these buffers. */
  read(names: string[]): Promise<Record<string, Uint32Array>>;
  /** Frees the buffers. */
  destroy(): void;
}
