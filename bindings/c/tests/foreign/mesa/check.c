/*
 * Drives integrations/mesa/tess_mesa.c as Mesa's draw module does, and compares it with the model.
 *
 *   check list tri integer triangle_cw ruler 40a00000 40a00000 40a00000 40a00000
 *       prints one patch as a listing, the form of golden/cases.txt
 *   check draws THREADS PATCHES
 *       each thread makes draws of random patches until it has compared its share of PATCHES, then says so.
 *       Every other thread flushes denormals, as llvmpipe's threads do (on x86-64).
 *
 * Exit codes: 0 done or equal, 1 different, 2 bad usage.
 */
#define _POSIX_C_SOURCE 200112L

#include "tess_mesa.h"

#include "tess.h"

#include <inttypes.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

enum { EQUAL = 0, DIFFERENT = 1, BAD_USAGE = 2, MAX_THREADS = 64, MAX_DRAW = 400 };

static const char *const DOMAINS[] = {"isoline", "tri", "quad", NULL};
static const char *const PARTITIONINGS[] = {"integer", "pow2", "fractional_odd", "fractional_even", NULL};
static const char *const OUTPUTS[] = {"point", "line", "triangle_cw", "triangle_ccw", NULL};

/* ---- the words of Mesa ---- */

static const enum mesa_prim PRIMS[] = {MESA_PRIM_LINES, MESA_PRIM_TRIANGLES, MESA_PRIM_QUADS};
static const enum pipe_tess_spacing SPACINGS[] = {
   PIPE_TESS_SPACING_EQUAL, PIPE_TESS_SPACING_EQUAL, PIPE_TESS_SPACING_FRACTIONAL_ODD,
   PIPE_TESS_SPACING_FRACTIONAL_EVEN};

static struct pipe_tessellator *init(const TessConfig *config)
{
   return p_tess_init(PRIMS[config->domain], SPACINGS[config->partitioning],
                      config->output == TESS_OUTPUT_TRIANGLE_CW, config->output == TESS_OUTPUT_POINT);
}

/* Factors in the order of tess.h as Mesa has them. */
static struct pipe_tessellation_factors mesa_factors(uint32_t domain, const float *factors)
{
   static const size_t OUTER[] = {2, 3, 4};
   struct pipe_tessellation_factors mesa;
   memset(&mesa, 0xff, sizeof mesa); /* what the domain lacks is NaN */
   memcpy(mesa.outer_tf, factors, OUTER[domain] * sizeof(float));
   memcpy(mesa.inner_tf, factors + OUTER[domain], domain * sizeof(float));
   return mesa;
}

static size_t factor_count(uint32_t domain)
{
   return 2 + 2 * (size_t)domain;
}

/* ---- one patch as a listing ---- */

static int number_of(const char *name, const char *const *names, uint32_t *number)
{
   for (uint32_t i = 0; names[i] != NULL; i++) {
      if (strcmp(name, names[i]) == 0) {
         *number = i;
         return 1;
      }
   }
   fprintf(stderr, "check: unknown name: %s\n", name);
   return 0;
}

static void print(const struct pipe_tessellator_data *data, uint32_t size)
{
   printf("points %" PRIu32 "\n", data->num_domain_points);
   for (uint32_t i = 0; i < data->num_domain_points; i++) {
      printf("%05" PRIx32 " %05" PRIx32 "\n", (uint32_t)(data->domain_points_u[i] * 65536.0f),
             (uint32_t)(data->domain_points_v[i] * 65536.0f));
   }
   printf("indices %" PRIu32 "\n", data->num_indices);
   for (uint32_t i = 0; i < data->num_indices; i++)
      printf("%" PRIu32 "%c", data->indices[i], (i + 1) % size == 0 ? '\n' : ' ');
   printf("end\n");
}

static int list(int argc, char **argv)
{
   TessConfig config = {0, 0, 0, TESS_SPLIT_RULER};
   float factors[TESS_MAX_FACTORS] = {0};
   if (argc < 4 || !number_of(argv[0], DOMAINS, &config.domain) ||
       !number_of(argv[1], PARTITIONINGS, &config.partitioning) || !number_of(argv[2], OUTPUTS, &config.output))
      return BAD_USAGE;
   if (strcmp(argv[3], "ruler") != 0 || (size_t)argc - 4 != factor_count(config.domain)) {
      fprintf(stderr, "check: not a patch that Mesa has\n");
      return BAD_USAGE;
   }
   for (int i = 4; i < argc; i++) {
      uint32_t bits = (uint32_t)strtoul(argv[i], NULL, 16);
      memcpy(&factors[i - 4], &bits, sizeof bits);
   }
   uint32_t size = config.output == TESS_OUTPUT_POINT ? 1 : config.domain == TESS_DOMAIN_ISOLINE ? 2 : 3;
   struct pipe_tessellator *tess = init(&config);
   struct pipe_tessellation_factors mesa = mesa_factors(config.domain, factors);
   struct pipe_tessellator_data data = {0};
   p_tessellate(tess, &mesa, &data);
   print(&data, size);
   p_tess_destroy(tess);
   return EQUAL;
}

/* ---- random draws ---- */

/* SplitMix64. */
static uint64_t next(uint64_t *state)
{
   uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
   z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
   z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
   return z ^ (z >> 31);
}

/* Mostly up to 6, some up to 70, integers, denormals of either sign, and any bits. */
static float random_factor(uint64_t *state)
{
   uint64_t random = next(state);
   uint32_t bits = (uint32_t)(random >> 32);
   float factor, fraction = (float)(bits >> 8) / 16777216.0f;
   switch (random % 32) {
   case 0: break;
   case 1: bits &= 0x807fffff; break;
   case 2: return 70.0f * fraction;
   case 3: case 4: return (float)(bits % 9);
   default: return 6.0f * fraction;
   }
   memcpy(&factor, &bits, sizeof bits);
   return factor;
}

struct draw {
   TessConfig config;
   unsigned patches;
   float factors[MAX_DRAW][TESS_MAX_FACTORS];
   struct pipe_tessellation_factors mesa[MAX_DRAW];
};

struct worker {
   pthread_t thread;
   uint64_t state;
   unsigned long patches; /* to compare */
   unsigned long parts;   /* of draws that had several */
   int flushes;
   int result;
   struct draw draw;
   TessPoint points[TESS_MAX_POINTS];
   uint32_t indices[TESS_MAX_INDICES];
   uint16_t elts[1 << 19];
};

/* A draw of a few patches; one of 128 has many large ones, so that it has several parts. */
static void make_draw(struct worker *worker)
{
   struct draw *draw = &worker->draw;
   uint64_t random = next(&worker->state);
   int large = random % 128 == 0;
   draw->config.domain = (uint32_t)(random >> 8) % 3;
   draw->config.partitioning = (uint32_t)(random >> 16) % 4;
   draw->config.output = (uint32_t)(random >> 24) % 4;
   draw->config.split = TESS_SPLIT_RULER;
   if (draw->config.output != TESS_OUTPUT_POINT) {
      uint32_t winding = TESS_OUTPUT_TRIANGLE_CW + draw->config.output % 2;
      draw->config.output = draw->config.domain == TESS_DOMAIN_ISOLINE ? TESS_OUTPUT_LINE : winding;
   }
   draw->patches = 1 + (unsigned)(random >> 32) % (large ? MAX_DRAW : 20);
   for (unsigned patch = 0; patch < draw->patches; patch++) {
      for (size_t i = 0; i < factor_count(draw->config.domain); i++)
         draw->factors[patch][i] = large ? 40.0f : random_factor(&worker->state);
      draw->mesa[patch] = mesa_factors(draw->config.domain, draw->factors[patch]);
   }
}

static int report(const struct worker *worker, unsigned patch, const char *what)
{
   const TessConfig *config = &worker->draw.config;
   fprintf(stderr, "case %s %s %s ruler", DOMAINS[config->domain], PARTITIONINGS[config->partitioning],
           OUTPUTS[config->output]);
   for (size_t i = 0; i < factor_count(config->domain); i++) {
      uint32_t bits;
      memcpy(&bits, &worker->draw.factors[patch][i], sizeof bits);
      fprintf(stderr, " %08" PRIx32, bits);
   }
   fprintf(stderr, "\npatch %u of %u%s: %s\n", patch, worker->draw.patches,
           worker->flushes ? ", denormals flushed" : "", what);
   return 0;
}

/* Whether coordinates are the model's, bit for bit. */
static int same_points(const TessPoint *points, uint32_t count, const float *u, const float *v)
{
   for (uint32_t i = 0; i < count; i++) {
      float expected[2] = {(float)points[i].u / 65536.0f, (float)points[i].v / 65536.0f};
      if (memcmp(&expected[0], &u[i], sizeof u[i]) != 0 || memcmp(&expected[1], &v[i], sizeof v[i]) != 0)
         return 0;
   }
   return 1;
}

/* The model's output of a patch, in the worker's buffers. */
static TessCounts model(struct worker *worker, unsigned patch)
{
   TessCounts counts = {0};
   const TessConfig *config = &worker->draw.config;
   TessStatus status = tess_patch(config, worker->draw.factors[patch], factor_count(config->domain), worker->points,
                                  TESS_MAX_POINTS, worker->indices, TESS_MAX_INDICES, &counts);
   if (status != TESS_OK) {
      fprintf(stderr, "check: %s\n", tess_status_message(status));
      exit(BAD_USAGE);
   }
   return counts;
}

static int one_by_one(struct worker *worker)
{
   struct pipe_tessellator *tess = init(&worker->draw.config);
   struct pipe_tessellator_data data = {0};
   int equal = 1;
   for (unsigned patch = 0; equal && patch < worker->draw.patches; patch++) {
      TessCounts counts = model(worker, patch);
      p_tessellate(tess, &worker->draw.mesa[patch], &data);
      if (data.num_domain_points != counts.points || data.num_indices != counts.indices)
         equal = report(worker, patch, "other counts");
      else if (!same_points(worker->points, counts.points, data.domain_points_u, data.domain_points_v))
         equal = report(worker, patch, "other points");
      else if (counts.indices > 0 && memcmp(worker->indices, data.indices, counts.indices * sizeof(uint32_t)) != 0)
         equal = report(worker, patch, "other indices");
   }
   p_tess_destroy(tess);
   return equal;
}

/* Whether a patch of a part is the model's. */
static int same_in_part(struct worker *worker, unsigned patch, const struct tess_mesa_batch *batch,
                        struct tess_mesa_range range)
{
   TessCounts counts = model(worker, patch);
   if (range.num_points != counts.points || range.num_indices != counts.indices)
      return report(worker, patch, "other counts in its part");
   if (!same_points(worker->points, counts.points, batch->points_u + range.first_point,
                    batch->points_v + range.first_point))
      return report(worker, patch, "other points in its part");
   for (uint32_t i = 0; i < counts.indices; i++) {
      if (worker->elts[range.first_index + i] != range.first_point + worker->indices[i])
         return report(worker, patch, "other elements in its part");
   }
   return 1;
}

static int in_parts(struct worker *worker)
{
   struct pipe_tessellator *tess = init(&worker->draw.config);
   const struct draw *draw = &worker->draw;
   struct tess_mesa_batch batch;
   int equal = 1;
   for (unsigned first = 0; equal && first < draw->patches; first += batch.num_patches) {
      worker->parts += first > 0;
      if (!p_tess_batch_take(tess, draw->mesa + first, draw->patches - first, &batch) || batch.num_patches == 0 ||
          batch.num_indices > sizeof worker->elts / sizeof worker->elts[0] ||
          !p_tess_batch_write(tess, &batch, worker->elts)) {
         equal = report(worker, first, "a part begins here that cannot be had");
         break;
      }
      for (unsigned i = 0; equal && i < batch.num_patches; i++)
         equal = same_in_part(worker, first + i, &batch, batch.ranges[i]);
   }
   p_tess_destroy(tess);
   return equal;
}

static void *work(void *argument)
{
   struct worker *worker = argument;
   unsigned long compared = 0;
#ifdef __SSE2__
   if (worker->flushes)
      _mm_setcsr(_mm_getcsr() | 0x8040); /* results and operands that are denormal count as zero */
#endif
   while (compared < worker->patches) {
      make_draw(worker);
      if (!one_by_one(worker) || !in_parts(worker))
         return NULL;
      compared += worker->draw.patches;
   }
   worker->result = EQUAL;
   return NULL;
}

static int draws(unsigned long threads, unsigned long patches)
{
   struct worker *workers = calloc(threads, sizeof *workers);
   unsigned long parts = 0;
   int result = EQUAL;
   for (unsigned long i = 0; i < threads; i++) {
      workers[i].state = i + 1;
      workers[i].patches = patches / threads;
      workers[i].flushes = i % 2;
      workers[i].result = DIFFERENT;
      if (pthread_create(&workers[i].thread, NULL, work, &workers[i]) != 0)
         exit(BAD_USAGE);
   }
   for (unsigned long i = 0; i < threads; i++) {
      pthread_join(workers[i].thread, NULL);
      result |= workers[i].result;
      parts += workers[i].parts;
   }
   free(workers);
   if (result == EQUAL)
      printf("%lu threads, %lu patches equal, %s draws of several parts\n", threads, patches, parts ? "with" : "no");
   return result;
}

int main(int argc, char **argv)
{
   if (argc > 1 && strcmp(argv[1], "list") == 0)
      return list(argc - 2, argv + 2);
   if (argc == 4 && strcmp(argv[1], "draws") == 0) {
      unsigned long threads = strtoul(argv[2], NULL, 10), patches = strtoul(argv[3], NULL, 10);
      if (threads > 0 && threads <= MAX_THREADS && patches >= threads)
         return draws(threads, patches);
   }
   fprintf(stderr, "usage: check list PATCH | check draws THREADS PATCHES\n");
   return BAD_USAGE;
}
