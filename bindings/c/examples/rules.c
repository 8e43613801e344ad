/*
 * Judges a tessellator by the rules that a standard has for its output. Put yours in place of `device`.
 *
 *   cc -std=c99 -I bindings/c/include bindings/c/examples/rules.c target/release/libtess_capi.a \
 *      -lpthread -ldl -lm -o rules && ./rules
 *
 * Prints each rule of Vulkan as held, held as far as asked, broken or not exercised. The exit code is 1 if a rule is broken.
 */
#include "tess.h"

#include <stdio.h>

/* The tessellator under test: the library's own. It returns TESS_DEVICE_UNSUPPORTED for what it does not have. */
static int32_t device(void *user, const TessConfig *config, const float *factors, size_t factor_count,
                      TessPoint *points, uint32_t *indices, TessCounts *counts)
{
    (void)user;
    if (config->split != TESS_SPLIT_RULER) {
        return TESS_DEVICE_UNSUPPORTED;
    }
    return (int32_t)tess_patch(config, factors, factor_count, points, TESS_MAX_POINTS, indices,
                               TESS_MAX_INDICES, counts);
}

int main(void)
{
    static char report[16384];
    TessStatus status = tess_check_rules(TESS_SPECIFICATION_VULKAN, 0, 1, device, NULL, report,
                                         sizeof report);
    printf("%s", report);
    return status == TESS_OK ? 0 : 1;
}
