/*
 * Tessellates 1000 quads in one batch, then compares each with the model's patch.
 *
 * examples/cmake builds it with find_package(tess). To build it in the workspace:
 *
 *   cargo build --release -p tess-capi
 *   cc -std=c99 -I bindings/c/include bindings/c/examples/batch.c target/release/libtess_capi.a \
 *      -lpthread -ldl -lm -o batch
 */
#include "tess.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATCHES = 1000, FACTORS = 6 };

static void must(TessStatus status)
{
    if (status != TESS_OK) {
        fprintf(stderr, "%s\n", tess_status_message(status));
        exit(1);
    }
}

/* Two calls: one for the sizes, one for the output. calloc initialises the buffers, which is faster. */
static TessBatchOutput tessellate(const TessConfig *config, const float *factors, TessBatchCounts *counts)
{
    TessBatch *batch = NULL;
    TessBatchOutput output = {0};
    must(tess_batch_create(config, TESS_LEVEL_DETECT, &batch));
    must(tess_batch_count(batch, factors, PATCHES * FACTORS, counts));
    output.points = calloc(output.point_capacity = counts->points, sizeof(TessPoint));
    output.indices = calloc(output.index_capacity = counts->indices, sizeof(uint32_t));
    output.ranges = calloc(output.range_capacity = counts->patches, sizeof(TessRange));
    output.point_format = TESS_POINT_FIXED;
    output.index_type = TESS_INDEX_U32;
    output.numbering = TESS_NUMBERING_PER_PATCH;
    output.memory = TESS_MEMORY_INITIALISED;
    must(tess_batch_run(batch, factors, PATCHES * FACTORS, &output, counts));
    tess_batch_free(batch);
    return output;
}

int main(void)
{
    static TessPoint points[TESS_MAX_POINTS];
    static uint32_t indices[TESS_MAX_INDICES];
    static float factors[PATCHES * FACTORS];
    const TessConfig config = {TESS_DOMAIN_QUAD, TESS_PARTITIONING_FRACTIONAL_ODD, TESS_OUTPUT_TRIANGLE_CW,
                               TESS_SPLIT_RULER};
    TessBatchCounts counts;
    TessBatchOutput output;
    size_t i;
    for (i = 0; i < PATCHES * FACTORS; i++) {
        factors[i] = 1 + (float)(i * 37 % 101) / 16;
    }
    output = tessellate(&config, factors, &counts);
    for (i = 0; i < PATCHES; i++) {
        const TessRange *range = &output.ranges[i];
        TessCounts one;
        must(tess_patch(&config, &factors[i * FACTORS], FACTORS, points, TESS_MAX_POINTS, indices, TESS_MAX_INDICES,
                        &one));
        if (range->points != one.points || range->indices != one.indices
            || memcmp((const TessPoint *)output.points + range->first_point, points, one.points * sizeof *points)
            || memcmp((const uint32_t *)output.indices + range->first_index, indices, one.indices * sizeof *indices)) {
            fprintf(stderr, "patch %u differs\n", (unsigned)i);
            return 1;
        }
    }
    printf("%u patches, %u points, %u indices\n", (unsigned)counts.patches, (unsigned)counts.points,
           (unsigned)counts.indices);
    free(output.points);
    free(output.indices);
    free(output.ranges);
    return 0;
}
