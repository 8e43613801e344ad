/*
 * Prints one patch as a listing in the format of golden/cases.txt, which `tess check` reads.
 *
 *   patch quad fractional_odd triangle_cw ruler 40400000 40800000 40a00000 40c00000 40800000 40e00000
 *
 * Factors are bit patterns of binary32 numbers, in hex. To build it in the workspace:
 *
 *   cargo build --release -p tess-capi
 *   cc -std=c99 -I bindings/c/include bindings/c/examples/patch.c target/release/libtess_capi.a \
 *      -lpthread -ldl -lm -o patch
 */
#include "tess.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DONE = 0, BAD_USAGE = 2 };

static const char *const DOMAINS[] = {"isoline", "tri", "quad", NULL};
static const char *const PARTITIONINGS[] = {"integer", "pow2", "fractional_odd", "fractional_even", NULL};
static const char *const OUTPUTS[] = {"point", "line", "triangle_cw", "triangle_ccw", NULL};
static const char *const SPLITS[] = {"ruler", "center", NULL};

/* The library's number of a name: its position in a list that ends in NULL. */
static int number_of(const char *name, const char *const *names, uint32_t *number)
{
    uint32_t i;
    for (i = 0; names[i] != NULL; i++) {
        if (strcmp(name, names[i]) == 0) {
            *number = i;
            return 1;
        }
    }
    fprintf(stderr, "patch: unknown name: %s\n", name);
    return 0;
}

/* A binary32 number from its bits in hex. */
static int factor_of(const char *text, float *factor)
{
    char *end;
    unsigned long long wide;
    uint32_t bits;
    errno = 0;
    wide = strtoull(text, &end, 16);
    if (errno != 0 || end == text || *end != '\0' || text[0] == '-' || wide > UINT32_MAX) {
        fprintf(stderr, "patch: not the bits of a factor: %s\n", text);
        return 0;
    }
    bits = (uint32_t)wide;
    memcpy(factor, &bits, sizeof bits);
    return 1;
}

static void print_points(const TessPoint *points, uint32_t count)
{
    uint32_t i;
    printf("points %" PRIu32 "\n", count);
    for (i = 0; i < count; i++) {
        printf("%05" PRIx32 " %05" PRIx32 "\n", points[i].u, points[i].v);
    }
}

/* Prints one line per primitive. */
static void print_indices(const uint32_t *indices, const TessCounts *counts)
{
    uint32_t size = counts->primitives == 0 ? 1 : counts->indices / counts->primitives;
    uint32_t i;
    printf("indices %" PRIu32 "\n", counts->indices);
    for (i = 0; i < counts->indices; i++) {
        printf("%" PRIu32 "%c", indices[i], (i + 1) % size == 0 ? '\n' : ' ');
    }
}

int main(int argc, char **argv)
{
    static TessPoint points[TESS_MAX_POINTS];
    static uint32_t indices[TESS_MAX_INDICES];
    float factors[TESS_MAX_FACTORS];
    size_t factor_count = 0;
    TessConfig config;
    TessCounts counts;
    TessStatus status;

    if (argc < 6 || argc > 5 + TESS_MAX_FACTORS) {
        fprintf(stderr, "usage: patch DOMAIN PARTITIONING OUTPUT SPLIT FACTOR...\n");
        return BAD_USAGE;
    }
    if (!number_of(argv[1], DOMAINS, &config.domain)
        || !number_of(argv[2], PARTITIONINGS, &config.partitioning)
        || !number_of(argv[3], OUTPUTS, &config.output)
        || !number_of(argv[4], SPLITS, &config.split)) {
        return BAD_USAGE;
    }
    for (; (int)factor_count < argc - 5; factor_count++) {
        if (!factor_of(argv[5 + factor_count], &factors[factor_count])) {
            return BAD_USAGE;
        }
    }
    status = tess_patch(&config, factors, factor_count, points, TESS_MAX_POINTS,
                        indices, TESS_MAX_INDICES, &counts);
    if (status != TESS_OK) {
        fprintf(stderr, "patch: %s\n", tess_status_message(status));
        return BAD_USAGE;
    }
    print_points(points, counts.points);
    print_indices(indices, &counts);
    printf("end\n");
    return DONE;
}
