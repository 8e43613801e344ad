/* Compares a stage's last frame with the model: its factors, tessellated by bindings/c, must give
   the same points and indices, bit for bit. */
#ifndef TESS_MODEL
#define TESS_MODEL
#endif
#include "terrain.h"
#include "tess.h"

#include <stdio.h>
#include <string.h>

/* The place of a name in a list, which is that of the constants of tess.h. */
static uint32_t place(const char *name, const char *const names[4])
{
    uint32_t at = 0;
    while (at < 4 && strcmp(name, names[at]) != 0)
        at++;
    return at;
}

static TessConfig config_of(const struct tess_sdl_shaders *shaders)
{
    static const char *const domains[4] = {"isoline", "tri", "quad", ""};
    static const char *const partitionings[4] = {
        "integer", "pow2", "fractional_odd", "fractional_even"};
    static const char *const outputs[4] = {"point", "line", "triangle_cw", "triangle_ccw"};
    static const char *const splits[4] = {"ruler", "center", "", ""};
    TessConfig config = {place(shaders->domain, domains),
        place(shaders->partitioning, partitionings), place(shaders->output, outputs),
        place(shaders->split, splits)};
    return config;
}

/* The model's output for these factors; false if it refuses them. */
static bool tessellate(const TessConfig *config, const float *factors, size_t count,
    TessBatchOutput *output, TessBatchCounts *counts)
{
    TessBatch *batch = NULL;
    bool done = tess_batch_create(config, TESS_LEVEL_DETECT, &batch) == TESS_OK &&
                tess_batch_count(batch, factors, count, counts) == TESS_OK;
    if (done) {
        output->points = SDL_calloc(output->point_capacity = counts->points, sizeof(TessPoint));
        output->indices = SDL_calloc(output->index_capacity = counts->indices, sizeof(uint32_t));
        output->ranges = SDL_calloc(output->range_capacity = counts->patches, sizeof(TessRange));
        output->point_format = TESS_POINT_FIXED;
        output->index_type = TESS_INDEX_U32;
        output->numbering = TESS_NUMBERING_PER_BATCH;
        done = tess_batch_run(batch, factors, count, output, counts) == TESS_OK;
    }
    tess_batch_free(batch);
    return done;
}

/* The first point that differs, or the number of points. A point has u and v in 17 bits each, and
 * then its patch. */
static size_t first_other(
    const Uint64 *points, const TessBatchOutput *model, size_t patches, size_t count)
{
    const TessPoint *expected = model->points;
    for (size_t patch = 0; patch < patches; patch++) {
        const TessRange *range = &model->ranges[patch];
        for (size_t i = range->first_point; i < (size_t)range->first_point + range->points; i++)
            if (points[i] !=
                ((Uint64)expected[i].u | (Uint64)expected[i].v << 17 | (Uint64)patch << 34))
                return i;
    }
    return count;
}

bool equals_the_model(struct tess_sdl_stage *stage, const struct tess_sdl_shaders *shaders)
{
    const TessConfig config = config_of(shaders);
    size_t bytes[5];
    float *factors = tess_sdl_read(stage, TESS_SDL_FACTORS, &bytes[0]);
    Uint64 *points = tess_sdl_read(stage, TESS_SDL_POINTS, &bytes[1]);
    Uint32 *indices = tess_sdl_read(stage, TESS_SDL_INDICES, &bytes[2]);
    Uint32 *status = tess_sdl_read(stage, TESS_SDL_STATUS, &bytes[3]);
    Uint32 *draw = tess_sdl_read(stage, TESS_SDL_ARGUMENTS, &bytes[4]);
    TessBatchOutput model = {0};
    TessBatchCounts counts = {0};
    bool is_equal = factors && points && indices && status && draw &&
                    tessellate(&config, factors, bytes[0] / sizeof *factors, &model, &counts);
    if (!is_equal)
        fprintf(stderr, "the frame or the model cannot be read: %s\n", SDL_GetError());
    if (is_equal && (status[4] != 0 || status[0] != counts.points || draw[0] != counts.indices ||
                        counts.points == 0)) {
        fprintf(stderr, "%u points and %u indices, overflow %u: the model has %u and %u\n",
            status[0], draw[0], status[4], (unsigned)counts.points, (unsigned)counts.indices);
        is_equal = false;
    }
    if (is_equal) {
        size_t at = first_other(points, &model, counts.patches, counts.points);
        is_equal =
            at == counts.points && memcmp(indices, model.indices, 4 * (size_t)counts.indices) == 0;
        printf("%u points, %u indices: %s\n", (unsigned)counts.points, (unsigned)counts.indices,
            is_equal              ? "equal"
            : at == counts.points ? "the indices differ"
                                  : "the points differ");
    }
    SDL_free(factors);
    SDL_free(points);
    SDL_free(indices);
    SDL_free(status);
    SDL_free(draw);
    SDL_free(model.points);
    SDL_free(model.indices);
    SDL_free(model.ranges);
    return is_equal;
}
