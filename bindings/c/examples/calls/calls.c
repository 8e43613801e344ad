/* Times tess_batch_patch for run.py; the measurement is that of main.rs. */
#include "tess.h"
#include <stdio.h>
#include <stdlib.h>

uint64_t calls_now(void); /* clock.c */

static TessPoint points[TESS_MAX_POINTS];
static uint32_t indices[TESS_MAX_INDICES];

static void require_ok(TessStatus status)
{
    if (status != TESS_OK) {
        fprintf(stderr, "%s\n", tess_status_message(status));
        exit(1);
    }
}

static uint64_t run(TessBatch *batch, const float *factors)
{
    TessBatchOutput output = {0};
    TessCounts counts;
    uint64_t start = calls_now();
    output.points = points;
    output.point_capacity = TESS_MAX_POINTS;
    output.indices = indices;
    output.index_capacity = TESS_MAX_INDICES;
    output.point_format = TESS_POINT_FIXED;
    output.index_type = TESS_INDEX_U32;
    output.memory = TESS_MEMORY_INITIALISED; /* static memory is */
    for (int call = 0; call < 2000; call++)
        require_ok(tess_batch_patch(batch, factors, &output, &counts));
    return calls_now() - start;
}

int main(void)
{
    static const float all[] = {1, 2, 4, 8, 64};
    TessConfig config = {TESS_DOMAIN_QUAD, TESS_PARTITIONING_INTEGER,
                         TESS_OUTPUT_TRIANGLE_CW, TESS_SPLIT_RULER};
    TessBatch *batch;
    require_ok(tess_batch_create(&config, TESS_LEVEL_DETECT, &batch));
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        float f = all[i], factors[6] = {f, f, f, f, f, f};
        uint64_t best = UINT64_MAX;
        for (int turn = 0; turn < 60; turn++) {
            uint64_t time = run(batch, factors);
            if (time < best)
                best = time;
        }
        printf("%g %.1f\n", f, (double)best / 2000);
    }
    tess_batch_free(batch);
    return 0;
}
