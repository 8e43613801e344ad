/* tess_vulkan [-d DEVICE] [-t RUNS] FOLDER FACTORS...

   Tessellates each file of factors (binary32, little-endian, one patch after another) with the shaders in
   FOLDER. Writes FACTORS.points, FACTORS.indices and FACTORS.draw next to it, as the device wrote them.
   Exit codes: 0 done, 2 bad usage or a file error, 3 a device error. */
#include "tess_shaders.h"
#include "tess_vulkan.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int write_file(const char *name, const char *ending, const void *content, size_t bytes)
{
    char path[4096];
    snprintf(path, sizeof path, "%s.%s", name, ending);
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(content, 1, bytes, file) != bytes || fclose(file) != 0) {
        fprintf(stderr, "tess_vulkan: cannot write %s\n", path);
        return 2;
    }
    return 0;
}

static uint32_t *read_factors(const char *name, uint32_t *patches)
{
    FILE *file = fopen(name, "rb");
    uint32_t *factors = NULL;
    long bytes = -1;
    if (file && fseek(file, 0, SEEK_END) == 0 && (bytes = ftell(file)) > 0) {
        rewind(file);
        factors = malloc((size_t)bytes);
        if (factors && fread(factors, 1, (size_t)bytes, file) != (size_t)bytes)
            bytes = -1;
    }
    if (file)
        fclose(file);
    if (!factors || bytes <= 0 || bytes % (4 * TESS_FACTORS_PER_PATCH) != 0) {
        fprintf(stderr, "tess_vulkan: %s does not hold whole patches of %d factors\n", name,
                TESS_FACTORS_PER_PATCH);
        free(factors);
        return NULL;
    }
    *patches = (uint32_t)(bytes / (4 * TESS_FACTORS_PER_PATCH));
    return factors;
}

/* Runs the batch twice: first with minimal room, to get the sizes that are needed. */
static int tessellate(struct tess_vulkan *host, const char *name, uint32_t runs)
{
    char message[256] = "";
    uint32_t patches;
    uint32_t *factors = read_factors(name, &patches);
    if (!factors)
        return 2;
    struct tess_output output;
    int failed = tess_vulkan_run(host, factors, patches, 1, 1, 1, &output, message);
    if (!failed && output.overflow) {
        uint64_t points = output.needed_points, primitives = output.needed_primitives;
        if ((points | primitives) >> 32) {
            snprintf(message, sizeof message, "the output of %s is too large", name);
            failed = 1;
        } else {
            failed = tess_vulkan_run(host, factors, patches, (uint32_t)points, (uint32_t)primitives,
                                     runs, &output, message);
        }
    }
    free(factors);
    if (failed) {
        fprintf(stderr, "tess_vulkan: %s\n", message);
        return 3;
    }
    if (runs > 1)
        printf("%s: %u patches, %llu primitives, %.4f ms\n", name, patches,
               (unsigned long long)output.needed_primitives, output.milliseconds);
    int exit = 0;
    if (write_file(name, "points", output.points, output.needed_points * TESS_BYTES_PER_POINT) ||
        write_file(name, "indices", output.indices, (size_t)output.draw[0] * TESS_BYTES_PER_INDEX) ||
        write_file(name, "draw", output.draw, sizeof output.draw))
        exit = 2;
    tess_output_free(&output);
    return exit;
}

int main(int count, char **words)
{
    uint32_t device = 0, runs = 1;
    int at = 1;
    for (; at + 1 < count && words[at][0] == '-'; at += 2) {
        if (strcmp(words[at], "-d") == 0)
            device = (uint32_t)strtoul(words[at + 1], NULL, 10);
        else if (strcmp(words[at], "-t") == 0)
            runs = (uint32_t)strtoul(words[at + 1], NULL, 10);
        else
            break;
    }
    if (count - at < 2 || words[at][0] == '-') {
        fprintf(stderr, "usage: tess_vulkan [-d DEVICE] [-t RUNS] FOLDER FACTORS...\n");
        return 2;
    }
    char message[256] = "";
    struct tess_vulkan *host = tess_vulkan_open(words[at], device, message);
    if (!host) {
        fprintf(stderr, "tess_vulkan: %s\n", message);
        return 3;
    }
    int exit = 0;
    for (int i = at + 1; i < count && exit == 0; i++)
        exit = tessellate(host, words[i], runs);
    tess_vulkan_close(host);
    return exit;
}
