/*
 * Mesa's interface of a tessellator (src/gallium/auxiliary/tessellator/p_tessellator.h), over tess.h.
 *
 * Mesa's draw module makes a tessellator for each run of an evaluation shader, passes it one patch per call and
 * destroys it. A tessellator is in one call at a time; any number of threads may have tessellators. Memory grows
 * to the largest patch so far and is kept: one destroyed tessellator for each configuration waits for
 * the next p_tess_init, because a new one would learn its patches and grow its buffers again.
 *
 * The interface has no errors. Without memory a patch has no points, and Mesa skips it.
 */
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "tess_mesa.h"

#include "tess.h"

/* The numbers of the three domains in OpenGL, and so in each of Mesa's enumerations. */
enum { PRIM_LINES = 1, PRIM_TRIANGLES = 4, PRIM_QUADS = 7 };

/* Elements behind the output that tess_batch_patch may overwrite and is fastest with. Mesa's shaders read
 * coordinates in vectors, so up to 15 behind the last one. */
enum { SLACK = 64 };

/* Outer and inner factors of a patch in each domain, by the library's number of it. */
static const size_t OUTER[] = {2, 3, 4}, INNER[] = {0, 1, 2};

/* Patches of a draw that are counted at first. */
enum { FIRST_GUESS = 256 };

/* The library writes ranges as Mesa's part reads them: an array of negative size says where that ends. */
typedef char ranges_are_alike[sizeof(struct tess_mesa_range) == sizeof(TessRange) &&
                              offsetof(struct tess_mesa_range, num_points) == offsetof(TessRange, points) &&
                              offsetof(struct tess_mesa_range, first_index) == offsetof(TessRange, first_index) &&
                              offsetof(struct tess_mesa_range, num_indices) == offsetof(TessRange, indices)
                           ? 1
                           : -1];

/* A buffer that grows. */
struct room {
   void *data;
   size_t bytes;
};

struct pipe_tessellator {
   unsigned slot;
   TessConfig config;
   size_t factors_per_patch;
   TessBatch *batch;
   struct room points;  /* float[2]: u of as many points as there is room for, then v of them */
   struct room indices; /* uint32_t */
   struct room factors; /* float: those of the taken patches, as the library reads them */
   unsigned taken;      /* patches of the last part */
   struct room ranges;  /* TessRange: where the patches' output lies */
};

/* Makes room for `count` elements and SLACK more. What was there is lost. */
static bool
reserve(struct room *room, size_t count, size_t element)
{
   size_t bytes = (count + SLACK) * element;
   if (bytes <= room->bytes)
      return true;
   bytes += bytes / 2;
   free(room->data);
   room->data = calloc(1, bytes);
   room->bytes = room->data ? bytes : 0;
   return room->data != NULL;
}

/* ---- making and destroying ---- */

/* Tessellators that wait for the next draw: at most one for each configuration. */
enum { SPACINGS = 3, SLOTS = 3 * SPACINGS * 2 * 2 };
static struct pipe_tessellator *spares[SLOTS];

static void
free_tessellator(struct pipe_tessellator *ts)
{
   if (!ts)
      return;
   tess_batch_free(ts->batch);
   free(ts->points.data);
   free(ts->indices.data);
   free(ts->factors.data);
   free(ts->ranges.data);
   free(ts);
}

#ifdef __GNUC__
/* Puts `ts`, or nothing, in a slot and gives what was there. */
static struct pipe_tessellator *
exchange(unsigned slot, struct pipe_tessellator *ts)
{
   return __atomic_exchange_n(&spares[slot], ts, __ATOMIC_ACQ_REL);
}

__attribute__((destructor)) static void
free_spares(void)
{
   for (unsigned slot = 0; slot < SLOTS; slot++)
      free_tessellator(exchange(slot, NULL));
}
#else
/* Without atomic operations none waits. */
static struct pipe_tessellator *
exchange(unsigned slot, struct pipe_tessellator *ts)
{
   (void)slot;
   return ts;
}
#endif

static bool
domain_of(unsigned prim_mode, uint32_t *domain)
{
   switch (prim_mode) {
   case PRIM_LINES: *domain = TESS_DOMAIN_ISOLINE; return true;
   case PRIM_TRIANGLES: *domain = TESS_DOMAIN_TRIANGLE; return true;
   case PRIM_QUADS: *domain = TESS_DOMAIN_QUAD; return true;
   default: return false;
   }
}

static bool
partitioning_of(enum pipe_tess_spacing spacing, uint32_t *partitioning)
{
   switch (spacing) {
   case PIPE_TESS_SPACING_FRACTIONAL_ODD: *partitioning = TESS_PARTITIONING_FRACTIONAL_ODD; return true;
   case PIPE_TESS_SPACING_FRACTIONAL_EVEN: *partitioning = TESS_PARTITIONING_FRACTIONAL_EVEN; return true;
   case PIPE_TESS_SPACING_EQUAL: *partitioning = TESS_PARTITIONING_INTEGER; return true;
   default: return false;
   }
}

static uint32_t
output_of(uint32_t domain, bool cw, bool point_mode)
{
   if (point_mode)
      return TESS_OUTPUT_POINT;
   if (domain == TESS_DOMAIN_ISOLINE)
      return TESS_OUTPUT_LINE;
   return cw ? TESS_OUTPUT_TRIANGLE_CW : TESS_OUTPUT_TRIANGLE_CCW;
}

struct pipe_tessellator *
p_tess_init(enum mesa_prim tes_prim_mode, enum pipe_tess_spacing spacing, bool tes_vertex_order_cw,
            bool tes_point_mode)
{
   TessConfig config = {0};
   config.split = TESS_SPLIT_RULER;
   if (!domain_of((unsigned)tes_prim_mode, &config.domain) || !partitioning_of(spacing, &config.partitioning))
      return NULL;
   config.output = output_of(config.domain, tes_vertex_order_cw, tes_point_mode);

   unsigned slot = ((config.domain * SPACINGS + (unsigned)spacing) * 2 + tes_vertex_order_cw) * 2 + tes_point_mode;
   struct pipe_tessellator *ts = exchange(slot, NULL);
   if (ts)
      return ts;
   ts = calloc(1, sizeof(*ts));
   if (!ts)
      return NULL;
   ts->slot = slot;
   ts->config = config;
   ts->factors_per_patch = OUTER[config.domain] + INNER[config.domain];
   if (tess_batch_create(&config, TESS_LEVEL_DETECT, &ts->batch) != TESS_OK) {
      free(ts);
      return NULL;
   }
   return ts;
}

void
p_tess_destroy(struct pipe_tessellator *pipe_ts)
{
   if (pipe_ts)
      free_tessellator(exchange(pipe_ts->slot, pipe_ts));
}

/* ---- one patch a call ---- */

/* Writes a patch's factors in the library's order. */
static void
pack(uint32_t domain, const struct pipe_tessellation_factors *from, float *to)
{
   memcpy(to, from->outer_tf, OUTER[domain] * sizeof(float));
   memcpy(to + OUTER[domain], from->inner_tf, INNER[domain] * sizeof(float));
}

/* The points that there is room for: v of the first lies as many floats behind its u. */
static size_t
point_capacity(const struct pipe_tessellator *ts)
{
   return ts->points.bytes / (2 * sizeof(float));
}

static bool
reserve_points(struct pipe_tessellator *ts, size_t count)
{
   return reserve(&ts->points, count, 2 * sizeof(float));
}

static TessStatus
run_patch(struct pipe_tessellator *ts, const float *factors, TessCounts *counts)
{
   TessBatchOutput output = {0};
   output.points = ts->points.data;
   output.point_capacity = point_capacity(ts);
   output.indices = ts->indices.data;
   output.index_capacity = ts->indices.bytes / sizeof(uint32_t);
   output.point_format = TESS_POINT_F32_APART;
   output.index_type = TESS_INDEX_U32;
   output.memory = TESS_MEMORY_INITIALISED; /* by calloc */
   return tess_batch_patch(ts->batch, factors, &output, counts);
}

/* Tessellates a patch into the tessellator's buffers, which grow to its size. */
static bool
tessellate(struct pipe_tessellator *ts, const float *factors, TessCounts *counts)
{
   TessStatus status = run_patch(ts, factors, counts);
   if (status == TESS_BUFFER_TOO_SMALL) {
      if (!reserve_points(ts, counts->points) || !reserve(&ts->indices, counts->indices, sizeof(uint32_t)))
         return false;
      status = run_patch(ts, factors, counts);
   }
   return status == TESS_OK;
}

void
p_tessellate(struct pipe_tessellator *pipe_ts, const struct pipe_tessellation_factors *tess_factors,
             struct pipe_tessellator_data *tess_data)
{
   float factors[TESS_MAX_FACTORS];
   TessCounts counts = {0};

   memset(tess_data, 0, sizeof(*tess_data));
   if (!pipe_ts)
      return;
   pack(pipe_ts->config.domain, tess_factors, factors);
   if (!tessellate(pipe_ts, factors, &counts))
      return;
   tess_data->num_indices = counts.indices;
   tess_data->num_domain_points = counts.points;
   tess_data->indices = pipe_ts->indices.data;
   tess_data->domain_points_u = pipe_ts->points.data;
   tess_data->domain_points_v = (float *)pipe_ts->points.data + point_capacity(pipe_ts);
}

/* ---- all patches of a draw ---- */

/* Says how large the output of the first `patches` packed patches is. */
static bool
count(struct pipe_tessellator *ts, unsigned patches, TessBatchCounts *counts)
{
   return tess_batch_count(ts->batch, ts->factors.data, patches * ts->factors_per_patch, counts) == TESS_OK;
}

/* Fewer patches, which may have few enough points when `patches` have too many: exact if all are alike. */
static unsigned
fewer(unsigned patches, size_t points)
{
   unsigned alike = (unsigned)((uint64_t)patches * TESS_MESA_MAX_POINTS / points);
   unsigned half = patches / 2;
   return alike > half ? alike : half > 1 ? half : 1;
}

bool
p_tess_batch_take(struct pipe_tessellator *ts, const struct pipe_tessellation_factors *factors,
                  unsigned num_patches, struct tess_mesa_batch *batch)
{
   TessBatchCounts counts = {0};
   unsigned patches;

   memset(batch, 0, sizeof(*batch));
   if (!ts)
      return false;
   /* Neighbouring parts are alike, so the last one says how many are worth counting. */
   patches = 2 * ts->taken + FIRST_GUESS;
   if (patches > num_patches)
      patches = num_patches;
   if (!reserve(&ts->factors, patches * ts->factors_per_patch, sizeof(float)))
      return false;
   for (unsigned i = 0; i < patches; i++)
      pack(ts->config.domain, &factors[i], (float *)ts->factors.data + i * ts->factors_per_patch);
   if (!count(ts, patches, &counts))
      return false;
   while (counts.points > TESS_MESA_MAX_POINTS) {
      patches = fewer(patches, counts.points);
      if (!count(ts, patches, &counts))
         return false;
   }
   ts->taken = patches;
   batch->num_patches = patches;
   batch->num_points = counts.points;
   batch->num_indices = counts.indices;
   return true;
}

bool
p_tess_batch_write(struct pipe_tessellator *ts, struct tess_mesa_batch *batch, uint16_t *elts)
{
   TessBatchCounts counts;
   TessBatchOutput output = {0};

   if (!reserve_points(ts, batch->num_points) || !reserve(&ts->ranges, batch->num_patches, sizeof(TessRange)))
      return false;
   output.points = ts->points.data;
   output.point_capacity = point_capacity(ts);
   output.indices = elts;
   output.index_capacity = batch->num_indices;
   output.ranges = ts->ranges.data;
   output.range_capacity = batch->num_patches;
   output.point_format = TESS_POINT_F32_APART;
   output.index_type = TESS_INDEX_U16;
   output.numbering = TESS_NUMBERING_PER_BATCH;
   if (tess_batch_run(ts->batch, ts->factors.data, ts->taken * ts->factors_per_patch, &output, &counts) != TESS_OK)
      return false;
   batch->points_u = ts->points.data;
   batch->points_v = (float *)ts->points.data + point_capacity(ts);
   batch->ranges = ts->ranges.data;
   return true;
}
