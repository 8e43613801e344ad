/** x, y, z; rounded to binary32. */
type Point = ArrayLike<number> & Iterable<number>;

/** The factor clamped to 1 to 64; 1 for NaN. */
export function clampFactor(factor: number): number;

/**
 * A factor for segments of `segment` pixels on the straight edge from a to b. `pixelsPerUnit` is the number of pixels that
 * a length of 1 covers at distance 1: height / (2 * tan(field of view / 2)).
 */
export function edgeByScreenSize(a: Point, b: Point, eye: Point, pixelsPerUnit: number, segment: number): number;

/** The same under a camera without perspective: a length of 1 covers `pixelsPerUnit` pixels at any distance. */
export function edgeByLength(a: Point, b: Point, pixelsPerUnit: number, segment: number): number;

/** `scale` divided by the distance from the eye to the middle of the edge. */
export function edgeByDistance(a: Point, b: Point, eye: Point, scale: number): number;

/**
 * The factors of an edge next to two edges of half its length, from the factor that a rule gives the whole edge. The
 * whole edge gets a power of two from 2 to 64, at least the rule's factor; each half gets half of it. Both sides then
 * have the same points under `integer` and `pow2`. Neighbours must compute both factors from the whole edge.
 */
export function edgeBesideHalves(factor: number): [whole: number, half: number];

/** A factor of at most `most`, like HLSL's `maxtessfactor`. A factor that culls still culls if `most` is positive. */
export function atMost(factor: number, most: number): number;

/** The inside factors along u and v of a quad with these factors on its edges u = 0, v = 0, u = 1, v = 1. */
export function insideQuad(edges: Iterable<number>): [u: number, v: number];

/** The inside factor of a triangle: the mean of its three edges. */
export function insideTriangle(edges: Iterable<number>): number;
