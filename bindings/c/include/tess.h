/*
 * Bit-exact Direct3D 11 class tessellation.
 *
 * The caller owns all memory. Only the functions on batches, tess_fuzz() and tess_check_rules()
 * allocate. A function that can fail returns TESS_OK, or the reason for which it refused the call;
 * tess_status_message() describes it.
 * Null and misaligned pointers, unknown numbers, and buffers that are too small or overlap are refused
 * with a status and are never undefined behaviour. The library cannot check that the memory behind a
 * pointer is as large as the call states: the caller must ensure it.
 * All functions may be called from any number of threads at the same time, except that only one call
 * may use a batch at a time.
 *
 * Factors are any binary32 numbers, NaN included, in the order of their domain:
 *   isoline   density, detail
 *   triangle  outer U=0, V=0, W=0; inside
 *   quad      outer U=0, V=0, U=1, V=1; inside U, V
 */


#ifndef TESS_H
#define TESS_H

/* Generated from the Rust sources of tess-capi by `TESS_BLESS=1 cargo test -p tess-capi --test header`. Do not edit. */

#include <stddef.h>
#include <stdint.h>

/**
 * The version as three numbers: `major << 16 | minor << 8 | patch`.
 */
#define TESS_VERSION 256

/**
 * Buffer: the points.
 */
#define TESS_BUFFER_POINTS 0

/**
 * Buffer: the indices.
 */
#define TESS_BUFFER_INDICES 1

/**
 * Buffer: the ranges, one for each patch.
 */
#define TESS_BUFFER_RANGES 2

/**
 * Domain: parallel lines along u, stacked in v. Factors: density, detail.
 */
#define TESS_DOMAIN_ISOLINE 0

/**
 * Domain: barycentric (u, v). Factors: outer U=0, V=0, W=0; inside.
 */
#define TESS_DOMAIN_TRIANGLE 1

/**
 * Domain: the unit square. Factors: outer U=0, V=0, U=1, V=1; inside U, V.
 */
#define TESS_DOMAIN_QUAD 2

/**
 * Partitioning: factors rounded up to integers, 1..64.
 */
#define TESS_PARTITIONING_INTEGER 0

/**
 * Partitioning: tessellates as integer; only `tess_prepare` rounds to powers of two.
 */
#define TESS_PARTITIONING_POW2 1

/**
 * Partitioning: an odd number of segments, 1..63.
 */
#define TESS_PARTITIONING_FRACTIONAL_ODD 2

/**
 * Partitioning: an even number of segments, 2..64.
 */
#define TESS_PARTITIONING_FRACTIONAL_EVEN 3

/**
 * Output: one index per point.
 */
#define TESS_OUTPUT_POINT 0

/**
 * Output: line segments.
 */
#define TESS_OUTPUT_LINE 1

/**
 * Output: triangles, clockwise as seen with v pointing down (lines on an isoline domain).
 */
#define TESS_OUTPUT_TRIANGLE_CW 2

/**
 * Output: triangles, counter-clockwise as seen with v pointing down (lines on an isoline domain).
 */
#define TESS_OUTPUT_TRIANGLE_CCW 3

/**
 * Split order: bit-reversed, the standard.
 */
#define TESS_SPLIT_RULER 0

/**
 * Split order: from the centre outwards, as the Xbox 360 does.
 */
#define TESS_SPLIT_CENTER 1

/**
 * Parity: an even number of segments.
 */
#define TESS_PARITY_EVEN 0

/**
 * Parity: an odd number of segments.
 */
#define TESS_PARITY_ODD 1

/**
 * The largest number of points of a patch.
 */
#define TESS_MAX_POINTS 4225

/**
 * The largest number of indices of a patch.
 */
#define TESS_MAX_INDICES 24576

/**
 * The largest number of factors of a patch.
 */
#define TESS_MAX_FACTORS 6

/**
 * The patch is culled: no points, no indices, no processed factors.
 */
#define TESS_OUTCOME_CULLED 0

/**
 * Every factor is 1: the minimum patch, of one or two triangles.
 */
#define TESS_OUTCOME_MINIMUM 1

/**
 * Every other patch.
 */
#define TESS_OUTCOME_REGULAR 2

/**
 * Origin of a point: corner `p` of a minimum patch.
 */
#define TESS_POINT_ORIGIN_CORNER 0

/**
 * Origin of a point: point `p` of isoline `line`.
 */
#define TESS_POINT_ORIGIN_LINE 1

/**
 * Origin of a point: point `p` of outer edge `edge`.
 */
#define TESS_POINT_ORIGIN_OUTER_EDGE 2

/**
 * Origin of a point: point `p` of edge `edge` of interior ring `ring`.
 */
#define TESS_POINT_ORIGIN_RING 3

/**
 * Origin of a point: point `p` of the centre of an even interior, a single point or a row.
 */
#define TESS_POINT_ORIGIN_CENTRE 4

/**
 * Origin of a primitive: number `step` of point output, or of a line through all points in order.
 */
#define TESS_PRIMITIVE_ORIGIN_SEQUENCE 0

/**
 * Origin of a primitive: segment `step` of isoline `line`.
 */
#define TESS_PRIMITIVE_ORIGIN_LINE 1

/**
 * Origin of a primitive: triangle `step` of a minimum patch.
 */
#define TESS_PRIMITIVE_ORIGIN_MINIMUM 2

/**
 * Origin of a primitive: triangle `step` of the transition stitch of edge `edge`.
 */
#define TESS_PRIMITIVE_ORIGIN_TRANSITION 3

/**
 * Origin of a primitive: triangle `step` of the stitch of edge `edge` to ring `ring`.
 */
#define TESS_PRIMITIVE_ORIGIN_RING 4

/**
 * Origin of a primitive: triangle `step` inside the innermost ring.
 */
#define TESS_PRIMITIVE_ORIGIN_CENTRE 5

/**
 * Reduction: the smallest of the outer factors.
 */
#define TESS_REDUCTION_MIN 0

/**
 * Reduction: the largest of the outer factors.
 */
#define TESS_REDUCTION_MAX 1

/**
 * Reduction: the sum of the outer factors, divided by their number.
 */
#define TESS_REDUCTION_AVERAGE 2

/**
 * Quad axes: one reduction over all four edges, with the U scale, for both inside factors.
 */
#define TESS_AXES_ONE 0

/**
 * Quad axes: U from the edges V=0 and V=1, V from the edges U=0 and U=1.
 */
#define TESS_AXES_TWO 1

/**
 * CPU level: the most capable one that this machine has.
 */
#define TESS_LEVEL_DETECT 0

/**
 * CPU level: the instructions that the library was compiled for; always available.
 */
#define TESS_LEVEL_BASELINE 1

/**
 * CPU level: AVX2 on x86-64.
 */
#define TESS_LEVEL_AVX2 2

/**
 * CPU level: AVX-512 on x86-64, with the extensions of Ice Lake and Zen 4.
 */
#define TESS_LEVEL_AVX512 3

/**
 * Triangle order: the specification's.
 */
#define TESS_TRIANGLES_SPECIFIED 0

/**
 * Triangle order: the same triangles and points, in columns that suit the vertex caches of GPUs.
 */
#define TESS_TRIANGLES_VERTEX_CACHE 1

/**
 * Point format: `TessPoint`, a pair of unsigned 16.16 numbers.
 */
#define TESS_POINT_FIXED 0

/**
 * Point format: two floats, exactly equal to the 16.16 numbers.
 */
#define TESS_POINT_F32 1

/**
 * Point format: as `TESS_POINT_F32`, but u and v in two arrays. `points` has `2 * point_capacity`
 * floats: u of each point from float 0, v of each point from float `point_capacity`.
 */
#define TESS_POINT_F32_APART 2

/**
 * Index type: `uint32_t`.
 */
#define TESS_INDEX_U32 0

/**
 * Index type: `uint16_t`, which is always enough with `TESS_NUMBERING_PER_PATCH`. With
 * `TESS_NUMBERING_PER_BATCH` it numbers 65536 points. The last index, 65535, restarts primitives
 * in WebGL 2 and wherever primitive restart is on. There, `base_vertex` plus the number of points
 * in the batch must not exceed `TESS_POINTS_WITHOUT_RESTART_U16`.
 */
#define TESS_INDEX_U16 1

/**
 * The points that `uint16_t` numbers from 0 without the index 65535.
 */
#define TESS_POINTS_WITHOUT_RESTART_U16 65535

/**
 * Numbering: indices count from the first point of their patch.
 */
#define TESS_NUMBERING_PER_PATCH 0

/**
 * Numbering: indices count from the first point of the batch, whose number is `base_vertex`.
 */
#define TESS_NUMBERING_PER_BATCH 1

/**
 * Memory: the buffers may be uninitialised.
 */
#define TESS_MEMORY_ANY 0

/**
 * Memory: every byte of the buffers has been written before, by `calloc`, `memset`, an earlier
 * call or the caller. This is faster, because the call need not clear them first.
 */
#define TESS_MEMORY_INITIALISED 1

/**
 * A device's answer: it does not have the requested configuration. Not a finding.
 */
#define TESS_DEVICE_UNSUPPORTED -1

/**
 * Order: the model's, index for index.
 */
#define TESS_ORDER_EXACT 0

/**
 * Order: the model's order of primitives and of their vertices, which are identified by their
 * coordinates.
 */
#define TESS_ORDER_SEQUENCE 1

/**
 * Order: any order of primitives, and any leading vertex of a triangle.
 */
#define TESS_ORDER_ANY 2

/**
 * Denormals: a positive denormal outer factor is greater than zero.
 */
#define TESS_DENORMALS_KEEP 0

/**
 * Denormals: a positive denormal outer factor may count as zero, which culls the patch.
 */
#define TESS_DENORMALS_FLUSH 1

/**
 * Conversion of factors to 16 fraction bits: to the nearest, ties to even.
 */
#define TESS_CONVERSION_EXACT 0

/**
 * Conversion: to either neighbour if the fraction is between 0.4 and 0.6.
 */
#define TESS_CONVERSION_WITHIN_0_6_ULP 1

/**
 * A configuration's field: any value.
 */
#define TESS_ANY 4294967295

/**
 * Standard: Vulkan.
 */
#define TESS_SPECIFICATION_VULKAN 0

/**
 * Standard: OpenGL.
 */
#define TESS_SPECIFICATION_OPENGL 1

/**
 * Standard: Direct3D 11.
 */
#define TESS_SPECIFICATION_D3D11 2

/**
 * A tessellator for batches. `tess_batch_create` makes it, `tess_batch_free` frees it.
 */
typedef struct TessBatch TessBatch;

/**
 * The result of a call: `TESS_OK`, or the reason for which it was refused.
 */
typedef uint32_t TessStatus;

/**
 * A buffer that was too small. If several were, it is the first of ranges, points, indices.
 */
typedef struct TessShortage {
  /**
   * `TESS_BUFFER_...`
   */
  uint32_t buffer;
  /**
   * Number of elements that the output needs.
   */
  size_t needed;
  /**
   * Number of elements that the buffer had room for: its capacity.
   */
  size_t got;
} TessShortage;

/**
 * The configuration of a tessellator. Each field is one of the constants with the given prefix.
 */
typedef struct TessConfig {
  /**
   * `TESS_DOMAIN_...`
   */
  uint32_t domain;
  /**
   * `TESS_PARTITIONING_...`
   */
  uint32_t partitioning;
  /**
   * `TESS_OUTPUT_...`
   */
  uint32_t output;
  /**
   * `TESS_SPLIT_...`
   */
  uint32_t split;
} TessConfig;

/**
 * Sizes of a patch's output.
 */
typedef struct TessCounts {
  /**
   * Domain points, at most `TESS_MAX_POINTS`.
   */
  uint32_t points;
  /**
   * Points, line segments or triangles.
   */
  uint32_t primitives;
  /**
   * Indices, 1, 2 or 3 for each primitive, at most `TESS_MAX_INDICES`.
   */
  uint32_t indices;
} TessCounts;

/**
 * A domain point in unsigned 16.16 numbers, 0..0x10000. On triangles w = 0x10000 - u - v.
 */
typedef struct TessPoint {
  /**
   * First coordinate.
   */
  uint32_t u;
  /**
   * Second coordinate.
   */
  uint32_t v;
} TessPoint;

/**
 * The six numbers of a factor, and its parity (specification, section 4).
 */
typedef struct TessContext {
  /**
   * `TESS_PARITY_...`
   */
  uint32_t parity;
  /**
   * Reciprocal of the coarser subdivision, 16 fraction bits.
   */
  uint32_t inv_floor;
  /**
   * Reciprocal of the finer subdivision, 16 fraction bits.
   */
  uint32_t inv_ceil;
  /**
   * Weight of the finer subdivision, 16 fraction bits, below 0x10000.
   */
  uint32_t fraction;
  /**
   * Points on a half edge without the midpoint of an even edge, 1..32.
   */
  uint32_t half_points;
  /**
   * The position on the half edge that is splitting; `half_points + 1` if no position splits.
   */
  uint32_t split;
  /**
   * Points on the whole edge, both ends included, 2..65.
   */
  uint32_t points;
} TessContext;

/**
 * One factor after each step of factor processing (specification, section 3).
 */
typedef struct TessProcessedFactor {
  /**
   * Bits of the binary32 factor after clamping (steps 2 and 5).
   */
  uint32_t clamped;
  /**
   * Bits of the binary32 factor after rounding (steps 3 and 5).
   */
  uint32_t rounded;
  /**
   * The factor as an unsigned 15.16 number (step 7).
   */
  uint32_t fixed;
  /**
   * Its parity (step 6) and the six numbers derived from it (section 4).
   */
  struct TessContext context;
} TessProcessedFactor;

/**
 * Result of factor processing for a patch.
 */
typedef struct TessProcessedPatch {
  /**
   * `TESS_OUTCOME_...`
   */
  uint32_t outcome;
  /**
   * Number of elements of `factors` that are used: 0 if culled, else as many as the domain has.
   */
  uint32_t factor_count;
  /**
   * The factors in the order of the input; elements past `factor_count` are zero.
   */
  struct TessProcessedFactor factors[6];
} TessProcessedPatch;

/**
 * One primitive: `size` indices into the patch's points.
 */
typedef struct TessPrimitive {
  /**
   * 1 (point), 2 (line) or 3 (triangle).
   */
  uint32_t size;
  /**
   * The indices; the elements past `size` are 0.
   */
  uint32_t indices[3];
} TessPrimitive;

/**
 * The origin of a point (specification, section 6). Fields that its kind does not use are 0.
 */
typedef struct TessPointOrigin {
  /**
   * `TESS_POINT_ORIGIN_...`
   */
  uint32_t kind;
  /**
   * Number of the isoline, from v = 0.
   */
  uint32_t line;
  /**
   * Number of the interior ring, from 1.
   */
  uint32_t ring;
  /**
   * Number of the edge: U=0, V=0, then W=0 or U=1, V=1.
   */
  uint32_t edge;
  /**
   * Number of the point, counted in the direction of the walk.
   */
  uint32_t p;
} TessPointOrigin;

/**
 * The origin of a primitive (specification, sections 7 and 8). Fields that its kind does not use
 * are 0.
 */
typedef struct TessPrimitiveOrigin {
  /**
   * `TESS_PRIMITIVE_ORIGIN_...`
   */
  uint32_t kind;
  /**
   * Number of the isoline, from v = 0.
   */
  uint32_t line;
  /**
   * Number of the inner ring of the stitch, from 2.
   */
  uint32_t ring;
  /**
   * Number of the edge: U=0, V=0, then W=0 or U=1, V=1.
   */
  uint32_t edge;
  /**
   * Number of the primitive along its line, stitch, centre or sequence.
   */
  uint32_t step;
} TessPrimitiveOrigin;

/**
 * The kind of preparation. Each field is one of the constants with the given prefix.
 */
typedef struct TessPreparation {
  /**
   * `TESS_DOMAIN_...`
   */
  uint32_t domain;
  /**
   * `TESS_PARTITIONING_...`
   */
  uint32_t partitioning;
  /**
   * `TESS_REDUCTION_...`; checked on isolines too, where it has no effect.
   */
  uint32_t reduction;
  /**
   * `TESS_AXES_...`; checked on every domain, but has an effect only on quads.
   */
  uint32_t axes;
} TessPreparation;

/**
 * Sizes of a batch's output.
 */
typedef struct TessBatchCounts {
  /**
   * Patches, including culled ones: elements of `ranges`.
   */
  size_t patches;
  /**
   * Elements of `points`.
   */
  size_t points;
  /**
   * Elements of `indices`.
   */
  size_t indices;
} TessBatchCounts;

/**
 * The part of a batch's output that belongs to one patch or one group. A culled patch has neither
 * points nor indices.
 */
typedef struct TessRange {
  /**
   * Number of its first point in the batch's points.
   */
  uint32_t first_point;
  /**
   * Number of its points.
   */
  uint32_t points;
  /**
   * Number of its first index in the batch's indices.
   */
  uint32_t first_index;
  /**
   * Number of its indices.
   */
  uint32_t indices;
} TessRange;

/**
 * The buffers and formats of a batch's output. Capacities count elements. A buffer of
 * capacity 0 may be null.
 */
typedef struct TessBatchOutput {
  /**
   * Receives the points of all patches, one patch after another.
   */
  void *points;
  /**
   * Number of elements that `points` has room for.
   */
  size_t point_capacity;
  /**
   * Receives the indices of all patches, one patch after another.
   */
  void *indices;
  /**
   * Number of elements that `indices` has room for.
   */
  size_t index_capacity;
  /**
   * Receives one range for each patch. Null, with a `range_capacity` of 0, if you do not want
   * ranges.
   */
  struct TessRange *ranges;
  /**
   * Number of elements that `ranges` has room for.
   */
  size_t range_capacity;
  /**
   * `TESS_POINT_FIXED`, `TESS_POINT_F32` or `TESS_POINT_F32_APART`
   */
  uint32_t point_format;
  /**
   * `TESS_INDEX_U32` or `TESS_INDEX_U16`
   */
  uint32_t index_type;
  /**
   * `TESS_NUMBERING_...`
   */
  uint32_t numbering;
  /**
   * The number of the batch's first point with `TESS_NUMBERING_PER_BATCH`, else ignored.
   */
  uint32_t base_vertex;
  /**
   * `TESS_MEMORY_ANY` or `TESS_MEMORY_INITIALISED`, which is a promise about all three buffers.
   */
  uint32_t memory;
} TessBatchOutput;

/**
 * A point or a direction.
 */
typedef struct TessVec3 {
  /**
   * First coordinate.
   */
  float x;
  /**
   * Second coordinate.
   */
  float y;
  /**
   * Third coordinate.
   */
  float z;
} TessVec3;

/**
 * A corner of a point-normal triangle or quad.
 */
typedef struct TessCorner {
  /**
   * Its position.
   */
  struct TessVec3 position;
  /**
   * Its normal, of length 1.
   */
  struct TessVec3 normal;
} TessCorner;

/**
 * A matrix, by columns: `columns[4 * c + r]` is in row r of column c.
 */
typedef struct TessMat4 {
  /**
   * Four columns of four numbers.
   */
  float columns[16];
} TessMat4;

/**
 * A tessellator under test: it writes the points and indices of one patch and their counts.
 *
 * `points` has room for `TESS_MAX_POINTS` points and `indices` for `TESS_MAX_INDICES` indices.
 * Both and `counts` are zero before the call; `counts->primitives` is ignored. `user` is the
 * pointer that was passed to `tess_fuzz` or `tess_check_rules`. The tessellator returns 0, or
 * `TESS_DEVICE_UNSUPPORTED`, or any other number if it failed, which is a finding.
 */
typedef int32_t (*TessDevice)(void *user,
                              const struct TessConfig *config,
                              const float *factors,
                              size_t factor_count,
                              struct TessPoint *points,
                              uint32_t *indices,
                              struct TessCounts *counts);

/**
 * Strength of the comparison, and the configurations to test.
 */
typedef struct TessFuzzOptions {
  /**
   * `TESS_ORDER_...`
   */
  uint32_t order;
  /**
   * `TESS_DENORMALS_...`
   */
  uint32_t denormals;
  /**
   * `TESS_CONVERSION_...`
   */
  uint32_t conversion;
  /**
   * `TESS_DOMAIN_...`, or `TESS_ANY`.
   */
  uint32_t domain;
  /**
   * `TESS_PARTITIONING_...`, or `TESS_ANY`.
   */
  uint32_t partitioning;
  /**
   * `TESS_OUTPUT_...`, or `TESS_ANY`.
   */
  uint32_t output;
  /**
   * `TESS_SPLIT_...`, or `TESS_ANY`.
   */
  uint32_t split;
} TessFuzzOptions;

/**
 * Done.
 */
#define TESS_OK 0

/**
 * A required pointer is null.
 */
#define TESS_NULL_POINTER 1

/**
 * A pointer is not aligned for its type.
 */
#define TESS_MISALIGNED 2

/**
 * An enumeration (domain, partitioning, ...) has an unknown value.
 */
#define TESS_UNKNOWN_VALUE 3

/**
 * The number of factors does not fit the domain: 2 (isoline), 4 (triangle) or 6 (quad) per patch.
 */
#define TESS_WRONG_FACTOR_COUNT 4

/**
 * A buffer is too small. The call has written the sizes that are needed to its counts, and
 * `tess_shortage` names the buffer.
 */
#define TESS_BUFFER_TOO_SMALL 5

/**
 * The patch or edge has no element with this number, or a number is outside its range.
 */
#define TESS_OUT_OF_RANGE 6

/**
 * No factor has this context.
 */
#define TESS_NOT_A_CONTEXT 7

/**
 * Two buffers share memory, and one of them is written.
 */
#define TESS_OVERLAP 8

/**
 * A size exceeds the address space, or a batch has more than 2^32 - 1 points or indices.
 */
#define TESS_TOO_LARGE 9

/**
 * An index does not fit the index format: use wider indices, or number each patch from 0.
 */
#define TESS_INDEX_TOO_LARGE 10

/**
 * This machine or this build cannot run the CPU level.
 */
#define TESS_LEVEL_UNAVAILABLE 11

/**
 * A defect of this library; nothing was written.
 */
#define TESS_INTERNAL 12

/**
 * A tessellator under test differs from the model (`tess_fuzz`), or breaks a rule
 * (`tess_check_rules`).
 */
#define TESS_DIFFERENT 13

/**
 * Nothing was compared: the tessellator under test does not have the configuration.
 */
#define TESS_LEFT_OUT 14

/**
 * The system refused to start threads.
 */
#define TESS_NO_THREADS 15

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * The version of the linked library, in the form of `TESS_VERSION`.
 *
 * It differs from `TESS_VERSION` if the program was compiled with the header of another version.
 */
uint32_t tess_version(void);

/**
 * The version of the library as text, `major.minor.patch`.
 *
 * Never null; the text lives as long as the program and must not be freed.
 */
const char *tess_version_string(void);

/**
 * Meaning of a status, in English, without a newline.
 *
 * Never null: an unknown number gives "unknown status". The text lives as long as the program and
 * must not be freed.
 */
const char *tess_status_message(TessStatus status);

/**
 * Gets the buffer that was too small in the calling thread's last call that returned
 * `TESS_BUFFER_TOO_SMALL`. Returns `TESS_OUT_OF_RANGE` if there was no such call.
 *
 * The caller must ensure:
 * - `shortage`, if not null and aligned, is valid for writing one structure.
 */
TessStatus tess_shortage(struct TessShortage *shortage);

/**
 * Counts the points, primitives and indices of a patch.
 *
 * Any bit pattern of any factor is valid; a culled patch has no points and no indices.
 *
 * The caller must ensure:
 * Pointers that are not null and aligned must be valid:
 * - `config` for reading one configuration,
 * - `factors` for reading `factor_count` floats,
 * - `counts` for writing one structure.
 */
TessStatus tess_count(const struct TessConfig *config,
                      const float *factors,
                      size_t factor_count,
                      struct TessCounts *counts);

/**
 * Tessellates a patch into the caller's buffers.
 *
 * With `TESS_OK` the output is written and `counts` has its sizes. With `TESS_BUFFER_TOO_SMALL`
 * only `counts` is written, with the sizes that are needed; `tess_shortage` names the buffer. With
 * any other status nothing is written. Buffers and `counts` must not overlap (`TESS_OVERLAP`). A
 * buffer of capacity 0 may be null. `TESS_MAX_POINTS` and `TESS_MAX_INDICES` are enough for any
 * patch. The call does not allocate.
 *
 * The caller must ensure:
 * Pointers that are not null and aligned must be valid:
 * - `config` for reading one configuration,
 * - `factors` for reading `factor_count` floats,
 * - `points` for writing `point_capacity` points,
 * - `indices` for writing `index_capacity` indices,
 * - `counts` for writing one structure,
 *
 * and no other thread may use the memory that is written during the call.
 */
TessStatus tess_patch(const struct TessConfig *config,
                      const float *factors,
                      size_t factor_count,
                      struct TessPoint *points,
                      size_t point_capacity,
                      uint32_t *indices,
                      size_t index_capacity,
                      struct TessCounts *counts);

/**
 * Processes the factors of a patch: cull, clamp, round, parity, conversion, context.
 *
 * The caller must ensure:
 * Pointers that are not null and aligned must be valid:
 * - `config` for reading one configuration,
 * - `factors` for reading `factor_count` floats,
 * - `processed` for writing one structure.
 */
TessStatus tess_process(const struct TessConfig *config,
                        const float *factors,
                        size_t factor_count,
                        struct TessProcessedPatch *processed);

/**
 * Converts the bits of a binary32 number to an unsigned 15.16 number (specification, section 2).
 *
 * Rounds to nearest, ties to even. NaN and negative numbers give 0; 2^15 and larger numbers give
 * 0x7FFFFFFF.
 */
uint32_t tess_fixed_factor(uint32_t binary32_bits);

/**
 * Computes the context of a 15.16 factor (specification, sections 4 and 10).
 *
 * `parity_number` is `TESS_PARITY_...`, `split` is `TESS_SPLIT_...`. A factor outside 1..63 (odd)
 * or 1..64 (even) is clamped to that range.
 *
 * The caller must ensure:
 * - `context`, if not null and aligned, must be valid for writing one structure.
 */
TessStatus tess_context(uint32_t fixed_factor,
                        uint32_t parity_number,
                        uint32_t split,
                        struct TessContext *context);

/**
 * Computes the location of point `p` along an edge with this context (specification, section 5).
 *
 * `location` receives an unsigned 16.16 number, 0..0x10000. Returns `TESS_OUT_OF_RANGE` unless `p`
 * is below the context's `points`, and `TESS_NOT_A_CONTEXT` if no factor has this context.
 *
 * The caller must ensure:
 * Pointers that are not null and aligned must be valid:
 * - `context` for reading one structure,
 * - `location` for writing one number.
 */
TessStatus tess_place(const struct TessContext *context, uint32_t p, uint32_t *location);

/**
 * Gets point `i` of a patch, in constant time; `TESS_OUT_OF_RANGE` if there is no such point.
 *
 * The caller must ensure:
 * Pointers that are not null and aligned must be valid:
 * - `config` for reading one configuration,
 * - `factors` for reading `factor_count` floats,
 * - `point` for writing one structure.
 */
TessStatus tess_point(const struct TessConfig *config,
                      const float *factors,
                      size_t factor_count,
                      uint32_t i,
                      struct TessPoint *point);

/**
 * Gets primitive `t` of a patch, in constant time; `TESS_OUT_OF_RANGE` if there is no such
 * primitive.
 *
 * The caller must ensure:
 * Pointers that are not null and aligned must be valid:
 * - `config` for reading one configuration,
 * - `factors` for reading `factor_count` floats,
 * - `primitive` for writing one structure.
 */
TessStatus tess_primitive(const struct TessConfig *config,
                          const float *factors,
                          size_t factor_count,
                          uint32_t t,
                          struct TessPrimitive *primitive);

/**
 * Gets the origin of point `i` of a patch; `TESS_OUT_OF_RANGE` if there is no such point.
 *
 * The caller must ensure:
 * Pointers that are not null and aligned must be valid:
 * - `config` for reading one configuration,
 * - `factors` for reading `factor_count` floats,
 * - `origin` for writing one structure.
 */
TessStatus tess_locate_point(const struct TessConfig *config,
                             const float *factors,
                             size_t factor_count,
                             uint32_t i,
                             struct TessPointOrigin *origin);

/**
 * Gets the origin of primitive `t` of a patch; `TESS_OUT_OF_RANGE` if there is no such primitive.
 *
 * The caller must ensure:
 * Pointers that are not null and aligned must be valid:
 * - `config` for reading one configuration,
 * - `factors` for reading `factor_count` floats,
 * - `origin` for writing one structure.
 */
TessStatus tess_locate_primitive(const struct TessConfig *config,
                                 const float *factors,
                                 size_t factor_count,
                                 uint32_t t,
                                 struct TessPrimitiveOrigin *origin);

/**
 * Prepares the factors of one patch, as the HLSL functions `Process...TessFactors` do in Shader
 * Model 5 (compiler FXC). DXC compiles them to other operations, which this library does not have
 * (specification, section 9).
 *
 * `requested` holds the outer factors and, in the places of the inside factors, the inside
 * scales. `unrounded` and `rounded` receive `factor_count` factors each; tessellate the rounded
 * ones. All three may be the same array or overlap: the input is read first, and `rounded` is
 * written last.
 *
 * The caller must ensure:
 * Pointers that are not null and aligned must be valid:
 * - `preparation` for reading one structure,
 * - `requested` for reading `factor_count` floats,
 * - `unrounded` and `rounded` for writing `factor_count` floats each.
 */
TessStatus tess_prepare(const struct TessPreparation *preparation,
                        const float *requested,
                        size_t factor_count,
                        float *unrounded,
                        float *rounded);

/**
 * Makes a tessellator for batches of one domain in one configuration.
 *
 * `level` is `TESS_LEVEL_...`. All levels produce the same bits. If this machine lacks the level,
 * the call returns `TESS_LEVEL_UNAVAILABLE`. The first call in a process with a configuration
 * takes about a millisecond, later ones a microsecond. The batch learns from patches, and its
 * memory grows by at most 1.2 MB per thread; `tess_batch_reserve` allocates all of it in advance.
 * Free the handle with `tess_batch_free`.
 *
 * The caller must ensure:
 * Pointers that are not null and aligned must be valid:
 * - `config` for reading one configuration,
 * - `batch` for writing one pointer.
 */
TessStatus tess_batch_create(const struct TessConfig *config,
                             uint32_t level,
                             struct TessBatch **batch);

/**
 * Frees a batch. Null is allowed and does nothing.
 *
 * The caller must ensure:
 * - `batch` is null or came from `tess_batch_create`, is not in use and is not used again.
 */
void tess_batch_free(struct TessBatch *batch);

/**
 * Allocates all memory that a batch can need, 1.2 MB per thread, so that no later call allocates.
 *
 * The caller must ensure:
 * - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
 */
TessStatus tess_batch_reserve(struct TessBatch *batch);

/**
 * Sets the order of triangles for later calls, `TESS_TRIANGLES_...`. A new batch uses the
 * specification's order.
 *
 * `TESS_TRIANGLES_VERTEX_CACHE` is for renderers. With it, patches of more than about 300 points
 * take two to four times as long. The batch discards what it has learned from patches.
 *
 * The caller must ensure:
 * - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
 */
TessStatus tess_batch_set_triangles(struct TessBatch *batch, uint32_t order);

/**
 * Spreads later calls of `tess_batch_run` with `TESS_MEMORY_INITIALISED` over up to `threads`
 * threads. A new batch uses one; 0 returns `TESS_OUT_OF_RANGE`. The output does not depend on the
 * number of threads.
 *
 * A call uses one thread for each 256 KiB of output. The threads belong to a pool that all batches
 * of the process share. It has one thread per processor, or as many as the environment variable
 * `RAYON_NUM_THREADS` states. Each thread takes up to 1.2 MB of memory. The batch discards what it
 * has learned from patches. If the system refuses to start threads, the call returns
 * `TESS_NO_THREADS` and changes nothing.
 *
 * After `fork` the child may use batches that its parent made, with any number of threads: its
 * first large batch starts threads of its own. If it cannot start them, it tessellates on the
 * calling thread. No other thread may be in a call on these batches when the process forks.
 *
 * The caller must ensure:
 * - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
 */
TessStatus tess_batch_set_threads(struct TessBatch *batch, uint32_t threads);

/**
 * Gets the CPU level of a batch, `TESS_LEVEL_...`.
 *
 * The caller must ensure:
 * - `batch` is null or came from `tess_batch_create`.
 * - `level`, if not null and aligned, is valid for writing one number.
 */
TessStatus tess_batch_level(const struct TessBatch *batch, uint32_t *level);

/**
 * Computes the sizes of a batch's output.
 *
 * `factors` holds the factors of one patch after another. `factor_count` is the number of floats;
 * if it is not a multiple of the domain's number of factors, the call returns
 * `TESS_WRONG_FACTOR_COUNT`.
 *
 * The caller must ensure:
 * - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
 *
 * Other pointers that are not null and aligned must be valid:
 * - `factors` for reading `factor_count` floats,
 * - `counts` for writing one structure.
 */
TessStatus tess_batch_count(struct TessBatch *batch,
                            const float *factors,
                            size_t factor_count,
                            struct TessBatchCounts *counts);

/**
 * Tessellates a batch into the caller's buffers.
 *
 * The factors are as for `tess_batch_count`. With `TESS_OK` the output is written and `counts` has
 * its sizes. With `TESS_BUFFER_TOO_SMALL` only `counts` is written, with the sizes that are
 * needed; `tess_shortage` names the buffer. With any other status nothing is written. No ranges
 * are written if `ranges` is null and `range_capacity` 0. Buffers, factors and `counts` must not
 * overlap (`TESS_OVERLAP`). A call allocates if a patch has point counts that are new to this
 * batch; after `tess_batch_reserve` no call does.
 *
 * The caller must ensure:
 * - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
 *
 * Other pointers that are not null and aligned must be valid:
 * - `factors` for reading `factor_count` floats,
 * - `output` for reading one structure,
 * - its buffers for writing as many elements of their formats as their capacities state, and with
 *   `TESS_MEMORY_INITIALISED` also for reading them,
 * - `counts` for writing one structure,
 *
 * and no other thread may use any of them during the call.
 */
TessStatus tess_batch_run(struct TessBatch *batch,
                          const float *factors,
                          size_t factor_count,
                          const struct TessBatchOutput *output,
                          struct TessBatchCounts *counts);

/**
 * Gets the range of each group of patches in a batch's output.
 *
 * `ranges` holds the ranges of `patch_count` patches, as `tess_batch_run` wrote them. `starts`
 * holds the numbers of the patches at which `group_count` groups begin, in ascending order. A
 * group ends where the next one begins, the last one at the end of the batch. If a start is below
 * its predecessor, or past the end of the batch, the call returns `TESS_OUT_OF_RANGE` and writes
 * nothing. `groups` must not overlap the other arrays (`TESS_OVERLAP`).
 *
 * The caller must ensure:
 * Pointers that are not null and aligned must be valid:
 * - `ranges` for reading `patch_count` ranges,
 * - `starts` for reading `group_count` numbers,
 * - `groups` for writing `group_count` ranges,
 *
 * and no other thread may write any of them during the call.
 */
TessStatus tess_batch_groups(const struct TessRange *ranges,
                             size_t patch_count,
                             const uint32_t *starts,
                             size_t group_count,
                             struct TessRange *groups);

/**
 * Tessellates one patch into the caller's buffers: `tess_batch_run` for callers that have one
 * patch at a time, such as drivers, emulators and test benches.
 *
 * `factors` holds the factors of one patch: 2, 4 or 6 floats. The ranges, numbering and
 * `base_vertex` of `output` are ignored; indices count from the patch's first point. With
 * `TESS_OK` the output is written and `counts` has its sizes. With `TESS_BUFFER_TOO_SMALL` only
 * `counts` is written, with the sizes that are needed; `tess_shortage` names the buffer. With any
 * other status nothing is written. Up to 64 elements past the output may be overwritten in either
 * buffer, but never past its capacity; calls are fastest with that much room. Buffers, factors and
 * `counts` must not overlap (`TESS_OVERLAP`).
 *
 * A call takes 43 to 68 ns for factors up to 8 (one core of a server with AVX-512). With
 * `TESS_MEMORY_INITIALISED` and the same factors as the previous patch, it takes 19 ns for factors
 * up to 4 and 28 ns for factor 8. It is faster than `tess_batch_run` with one patch, which counts
 * twice; for large patches the two take equally long. A call allocates if a patch has point counts
 * that are new to this batch; after `tess_batch_reserve` no call does.
 *
 * The caller must ensure:
 * - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
 *
 * Other pointers that are not null and aligned must be valid:
 * - `factors` for reading as many floats as the domain has factors,
 * - `output` for reading one structure,
 * - its buffers for writing as many elements of their formats as their capacities state, and with
 *   `TESS_MEMORY_INITIALISED` also for reading them,
 * - `counts` for writing one structure,
 *
 * and no other thread may use any of them during the call.
 */
TessStatus tess_batch_patch(struct TessBatch *batch,
                            const float *factors,
                            const struct TessBatchOutput *output,
                            struct TessCounts *counts);

/**
 * A factor for segments of `segment` pixels on the straight edge from `a` to `b`.
 * `pixels_per_unit` is the number of pixels that a length of 1 covers at distance 1: for a picture
 * of height h and field of view f, h / (2 tan(f / 2)).
 */
float tess_edge_by_screen_size(struct TessVec3 a,
                               struct TessVec3 b,
                               struct TessVec3 eye,
                               float pixels_per_unit,
                               float segment);

/**
 * A factor for segments of `segment` pixels on the straight edge from `a` to `b`, under a camera
 * without perspective: a length of 1 covers `pixels_per_unit` pixels at any distance.
 */
float tess_edge_by_length(struct TessVec3 a,
                          struct TessVec3 b,
                          float pixels_per_unit,
                          float segment);

/**
 * The factor of an edge next to two edges of half its length, from the factor that a rule gives
 * the whole edge. The result is a power of two in 2..=64, at least the rule's factor. Give the two
 * short edges half of it: both sides then have the same points under integer and power-of-two
 * partitioning. Neighbours must compute both factors from the whole edge.
 */
float tess_edge_beside_halves(float factor);

/**
 * A factor of at most `most`, like HLSL's `maxtessfactor`. A factor that culls (0, negative or
 * NaN) still culls if `most` is positive.
 */
float tess_at_most(float factor, float most);

/**
 * `scale` divided by the distance from the eye to the middle of the straight edge from `a` to `b`.
 */
float tess_edge_by_distance(struct TessVec3 a, struct TessVec3 b, struct TessVec3 eye, float scale);

/**
 * A factor that keeps equal segments within `tolerance`, in units of the positions, of the
 * point-normal edge between two corners.
 */
float tess_edge_by_curvature(struct TessCorner a, struct TessCorner b, float tolerance);

/**
 * The inside factor of a triangle with these factors on its edges: their mean.
 */
float tess_inside_triangle(float u0, float v0, float w0);

/**
 * An inside factor of a quad with these factors on the two edges that run the same way: their
 * mean. Inside factor U is the mean of the edges V=0 and V=1, inside factor V the mean of the
 * edges U=0 and U=1.
 */
float tess_inside_quad(float one, float other);

/**
 * Whether a ball is wholly outside one of the six planes of a projection with z from 0 to w, as in
 * Direct3D, Vulkan, Metal and WebGPU: 1 or 0. The ball must contain the whole patch, including its
 * displacement. If the result is 1, give the patch factors of 0.
 */
uint32_t tess_is_outside(struct TessMat4 clip_from_world, struct TessVec3 center, float radius);

/**
 * Whether all of a surface faces away from the eye: 1 or 0. The surface is inside a ball, and its
 * normals are within an angle of less than 90 degrees of the unit vector `axis`; `sine` is the
 * sine of that angle.
 */
uint32_t tess_faces_away(struct TessVec3 center,
                         float radius,
                         struct TessVec3 axis,
                         float sine,
                         struct TessVec3 eye);

/**
 * Compares a tessellator with the model on the patch that a fuzzer's bytes encode.
 *
 * Any bytes encode a patch of a configuration that the options select. Most patches are small, and
 * boundary cases are frequent. Without options (null) the comparison is exact, and all
 * configurations are tested.
 *
 * - `TESS_OK`: equal.
 * - `TESS_LEFT_OUT`: the tessellator does not have the configuration; nothing was compared. Count
 *   these: a run in which every patch is left out proves nothing.
 * - `TESS_DIFFERENT`: a finding. `message` receives the case as a line for `tess patch --cases`, a
 *   command that shows the correct output, and the first difference. The message ends with a zero
 *   byte and is cut off at `message_capacity` bytes; 1024 are enough.
 *
 * `message` must not overlap `data` (`TESS_OVERLAP`; nothing was compared). This function
 * allocates.
 *
 * The caller must ensure:
 * Pointers that are not null and aligned must be valid:
 * - `data` for reading `size` bytes,
 * - `device` for calls as its type says,
 * - `options` for reading one structure,
 * - `message` for writing `message_capacity` bytes.
 */
TessStatus tess_fuzz(const uint8_t *data,
                     size_t size,
                     TessDevice device,
                     void *user,
                     const struct TessFuzzOptions *options,
                     char *message,
                     size_t message_capacity);

/**
 * Asks a tessellator for the patches of `tess gen --rules`, and judges its outputs by the rules of
 * a standard.
 *
 * `specification` is `TESS_SPECIFICATION_...`. The patches are the systematic ones in the
 * standard split order, then `random` patches that depend on `seed`. For Direct3D 11 the correct
 * locations of vertices come from the model; the other standards are judged without it. Patches of
 * configurations that the tessellator does not have are left out.
 *
 * - `TESS_OK`: no rule is broken.
 * - `TESS_DIFFERENT`: a rule is broken, or the tessellator failed.
 * - `TESS_LEFT_OUT`: the tessellator has none of the configurations; nothing was judged.
 *
 * `report` receives the text that `tess check --rules` prints: each rule as held, held as far as
 * asked, broken or not exercised, with what was not asked and the smallest patches that break it;
 * or the patch at which the tessellator failed. It ends with a zero byte and is cut off at
 * `report_capacity` bytes; 16384 are enough. This function allocates.
 *
 * The caller must ensure:
 * Pointers that are not null and aligned must be valid:
 * - `device` for calls as its type says,
 * - `report` for writing `report_capacity` bytes.
 */
TessStatus tess_check_rules(uint32_t specification,
                            uint64_t random,
                            uint64_t seed,
                            TessDevice device,
                            void *user,
                            char *report,
                            size_t report_capacity);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* TESS_H */
