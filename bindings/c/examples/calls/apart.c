/*
 * The cost of points in two arrays compared with points in pairs: TESS_POINT_F32_APART and TESS_POINT_F32.
 *
 *   cc -O2 -I bindings/c/include bindings/c/examples/calls/apart.c bindings/c/examples/calls/clock.c
 *      target/release/libtess_capi.a -lpthread -ldl -lm -o apart && ./apart
 *
 * For each factor of a quad with odd fractional partitioning, prints nanoseconds per patch: tess_batch_patch with
 * pairs and with two arrays, then tess_batch_run of 64 patches with pairs and with two arrays, and both ratios. The
 * formats alternate; each figure is the smallest of 60 rounds.
 */
#include "tess.h"
#include <stdio.h>
#include <stdlib.h>

uint64_t calls_now(void); /* clock.c */

enum { PATCHES = 64, ROUNDS = 60, FACTORS = 6 };

static float points[2 * PATCHES * TESS_MAX_POINTS];
static uint16_t indices[PATCHES * TESS_MAX_INDICES];
static float factors[PATCHES * FACTORS];
static TessRange ranges[PATCHES];

static void require_ok(TessStatus status)
{
    if (status != TESS_OK) {
        fprintf(stderr, "%s\n", tess_status_message(status));
        exit(1);
    }
}

static double patch_by_patch(TessBatch *batch, TessBatchOutput *output)
{
    TessCounts counts;
    uint64_t start = calls_now();
    for (int patch = 0; patch < 16 * PATCHES; patch++)
        require_ok(tess_batch_patch(batch, factors + patch % PATCHES * FACTORS, output, &counts));
    return (double)(calls_now() - start) / (16 * PATCHES);
}

static double at_once(TessBatch *batch, TessBatchOutput *output)
{
    TessBatchCounts counts;
    uint64_t start = calls_now();
    for (int call = 0; call < 16; call++)
        require_ok(tess_batch_run(batch, factors, PATCHES * FACTORS, output, &counts));
    return (double)(calls_now() - start) / (16 * PATCHES);
}

int main(void)
{
    static const float all[] = {2, 4, 8, 16, 64};
    TessConfig config = {TESS_DOMAIN_QUAD, TESS_PARTITIONING_FRACTIONAL_ODD,
                         TESS_OUTPUT_TRIANGLE_CW, TESS_SPLIT_RULER};
    TessBatch *batch;
    require_ok(tess_batch_create(&config, TESS_LEVEL_DETECT, &batch));
    printf("factor, a call: pairs apart ratio, in a batch: pairs apart ratio\n");
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        double best[4] = {1e9, 1e9, 1e9, 1e9};
        /* All patches differ, as in a mesh. */
        for (int k = 0; k < PATCHES * FACTORS; k++)
            factors[k] = all[i] - (float)(k * 37 % 101) / 256;
        for (int turn = 0; turn < 4 * ROUNDS; turn++) {
            TessBatchOutput output = {0};
            output.points = points;
            output.point_capacity = PATCHES * TESS_MAX_POINTS;
            output.indices = indices;
            output.index_capacity = PATCHES * TESS_MAX_INDICES;
            output.ranges = ranges;
            output.range_capacity = PATCHES;
            output.point_format = turn % 2 ? TESS_POINT_F32_APART : TESS_POINT_F32;
            output.index_type = TESS_INDEX_U16;
            output.memory = TESS_MEMORY_INITIALISED; /* static memory is */
            double time = turn % 4 < 2 ? patch_by_patch(batch, &output) : at_once(batch, &output);
            if (time < best[turn % 4])
                best[turn % 4] = time;
        }
        printf("%g  %.0f %.0f %.3f  %.0f %.0f %.3f\n", all[i], best[0], best[1], best[1] / best[0], best[2], best[3],
               best[3] / best[2]);
    }
    tess_batch_free(batch);
    return 0;
}
