/*
 * Fuzzes a tessellator against the model. Put yours in place of `device`.
 *
 * With libFuzzer, from the workspace:
 *
 *   cargo build --release -p tess-capi
 *   clang -std=c99 -fsanitize=fuzzer,address -I bindings/c/include bindings/c/examples/fuzz.c \
 *         target/release/libtess_capi.a -lpthread -ldl -lm -o fuzz && ./fuzz
 *
 * With any C compiler, to call the same function N times with pseudo-random bytes:
 *
 *   cc -std=c99 -O2 -DTESS_FUZZ_MAIN -I bindings/c/include bindings/c/examples/fuzz.c \
 *      target/release/libtess_capi.a -lpthread -ldl -lm -o fuzz && ./fuzz 1000000
 *
 * A finding ends the program with abort(), after the case is printed to stderr. To plant a fault, set
 * TESS_FUZZ_FAULT=1 in the environment.
 */
#include "tess.h"

#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* The tessellator under test: the library's own. If the fault is planted, it moves a point. */
static int32_t device(void *user, const TessConfig *config, const float *factors, size_t factor_count,
                      TessPoint *points, uint32_t *indices, TessCounts *counts)
{
    TessStatus status = tess_patch(config, factors, factor_count, points, TESS_MAX_POINTS,
                                   indices, TESS_MAX_INDICES, counts);
    if (*(const int *)user && counts->points > 100) {
        points[100].u ^= 1;
    }
    return (int32_t)status;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char message[1024] = "";
    int has_fault = getenv("TESS_FUZZ_FAULT") != NULL;
    /* All configurations; the output must be the model's, index for index. */
    const TessFuzzOptions options = {TESS_ORDER_EXACT, TESS_DENORMALS_KEEP, TESS_CONVERSION_EXACT,
                                     TESS_ANY, TESS_ANY, TESS_ANY, TESS_ANY};
    TessStatus status = tess_fuzz(data, size, device, &has_fault, &options, message, sizeof message);
    if (status != TESS_OK && status != TESS_LEFT_OUT) {
        fprintf(stderr, "%s\n%s\n", tess_status_message(status), message);
        abort();
    }
    return 0;
}

#ifdef TESS_FUZZ_MAIN
int main(int argc, char **argv)
{
    long inputs = argc > 1 ? strtol(argv[1], NULL, 10) : 1000000;
    uint64_t state = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    uint8_t bytes[64];
    size_t i;
    long n;
    if (inputs <= 0) {
        fprintf(stderr, "usage: fuzz [INPUTS [SEED]]\n");
        return 2;
    }
    for (n = 0; n < inputs; n++) {
        for (i = 0; i < sizeof bytes; i++) {
            /* A linear congruential generator: only its upper bits are random enough. */
            state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
            bytes[i] = (uint8_t)(state >> 56);
        }
        LLVMFuzzerTestOneInput(bytes, sizeof bytes);
    }
    printf("%ld inputs, no findings\n", inputs);
    return 0;
}
#endif
