import type { BufferGeometry } from "three";
import type { Feedback, Members, StageOptions } from "./stage.js";

export interface GeometryOptions extends Omit<StageOptions, "evaluate" | "layouts" | "meshes" | "pull"> {
  /**
   * The members of `Vertex`, which become attributes of these names: `position`, `normal`, `uv` as three.js knows them, or
   * your own. All are floats. Without `vertex` and without a function `domain`, `position` is u, v and the number of the
   * patch, and `uv` is u and v, for a material whose `positionNode` moves them.
   */
  vertex?: Members;
  /** Values that `hull` and `domain` read as `uniforms.NAME`; `update` sets them. */
  uniforms?: Members;
}

/** A number for a member of one component, otherwise as many numbers, or a vector or colour of three.js. */
export type UniformValue = number | readonly number[] | { toArray(): number[] };

export interface GeometryValues {
  /** The number of patches; by default as many as the geometry was made for. */
  patches?: number;
  /** The instances of each draw. */
  instances?: number;
  /** The factors of the first patches, for a geometry without a function `hull`. */
  factors?: ArrayLike<number>;
  /** The uniforms, by name. */
  [uniform: string]: UniformValue | ArrayLike<number> | undefined;
}

/**
 * An indexed geometry for a `Mesh` of three.js's `WebGPURenderer`, or, with the domain `isoline`, for `LineSegments`. With WebGPU a compute shader makes the triangles and the
 * draw is indirect. With WebGL 2 the CPU makes them, without `wgsl` and `uniforms`. `dispose` frees everything. Its
 * `boundingSphere` is infinite, so that nothing is culled; set a better one if you know it. Rays of `Raycaster` do not hit
 * what the GPU made.
 */
export class TessellatedGeometry extends BufferGeometry {
  private constructor();
  /** Waits for the renderer's device, then loads and compiles everything. */
  static load(renderer: object, options: GeometryOptions): Promise<TessellatedGeometry>;
  /**
   * Tessellates. Call it before `renderer.render` whenever something has changed; before the first call nothing is drawn, and
   * the console says so. If
   * the room for the points has to grow, which a later call learns, the picture is coarser until then.
   */
  update(values?: GeometryValues): void;
  /** Runs a frame and makes the room that it needs, for a first picture that is exact; `update` does not wait. */
  makeRoom(values?: GeometryValues): Promise<Feedback>;
  /** The latest frame whose numbers have arrived. */
  readonly feedback: Feedback | undefined;
}
