/// <reference types="@webgpu/types" />

// An argument of another type than those below is a `TypeError` that names what the function takes.

/** WGSL: `tess_point(packed: vec2u) -> TessPoint { uv: vec2f, of_patch: u32 }`, which unpacks the two words of a vertex. */
export const unpackWgsl: string;

/** Opens the first WebGPU device. Rejects with the reason if there is none. */
export function openDevice(): Promise<GPUDevice>;

/** A module of WGSL functions; `shaders/surfaces/README.md` has a table of them. */
export type SurfaceModule =
  | "flat" | "pn_edge" | "factors" | "culling" | "height"
  | "bezier" | "bezier_factors" | "pn" | "pn_triangle" | "displacement";

/**
 * The WGSL of these modules and of those that they need, to put before your shaders. `base` is that of `Setup`. Rejects
 * with a `RangeError` if there is no such module.
 */
export function surfacesWgsl(names: SurfaceModule[], base?: URL | string): Promise<string>;

export interface Setup {
  domain: "isoline" | "tri" | "quad";
  partitioning: "integer" | "pow2" | "fractional_odd" | "fractional_even";
  /** The address of the package's folder `shaders`, with a slash at its end; by default the folder next to the module. */
  base?: URL | string;
}

/** The numbers of elements that a batch has memory for. */
export interface Room { points: number; primitives: number }

export interface Output {
  /** u and v of each point, exact. */
  uv: Float32Array;
  /** The patch of each point. */
  patches: Uint32Array;
  /** Two per line (isoline) or three per triangle, clockwise; they count from the first point of the batch. */
  indices: Uint32Array;
}

export class Tessellator {
  /** Loads the shaders. Rejects with a `RangeError` if there is no such setup. */
  static load(device: GPUDevice, setup: Setup): Promise<Tessellator>;
  /**
   * Counts, makes room, tessellates and reads back. `factors` has the factors of one patch after another, 2 (isoline),
   * 4 (tri) or 6 (quad) per patch. Rejects with a `RangeError` if they are not whole patches.
   */
  tessellate(factors: ArrayLike<number>): Promise<Output>;
  /**
   * Makes buffers that you keep for many frames, by default with room for one point and one primitive. Throws a
   * `RangeError` if a number is not whole, or if the batch or its room is too large. Buffers in `given` are used instead of
   * new ones, by the names of `Batch.buffers`, and stay yours to free. `without` names output that is not written and has no
   * buffer, `points` or `points` and `indices`, for shaders that compute it.
   */
  batch(patches: number, room?: Room, given?: Readonly<Record<string, GPUBuffer>>, without?: ("points" | "indices")[]): Batch;
}

export interface Batch {
  /**
   * `factors`, which you write; `points`, `indices`, and `arguments` for `drawIndexedIndirect` at offset 0; `status`, which
   * https://github.com/tess-model/tess/blob/main/docs/shaders.md explains.
   */
  readonly buffers: Readonly<Record<string, GPUBuffer>>;
  /** Records the dispatches. If the room is too small, the draw is empty, and `status` has the room that is needed. */
  encode(encoder: GPUCommandEncoder): void;
  /** Runs the batch and returns the contents of these buffers as words. Rejects with a `RangeError` if there is no such buffer. */
  read(names: string[]): Promise<Record<string, Uint32Array>>;
  /** Frees the buffers. */
  destroy(): void;
}
