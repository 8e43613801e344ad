/*
 * A batch on several threads: in a forked child, or where no thread can be started.
 *
 *   threads fork    the parent sets threads and runs the batch; a child runs it too, and another one
 *   threads none    no thread can be started: the environment asks for stacks that no memory holds
 *
 * Ends with 0 if every output is that of a batch on one thread. A child that hangs is ended by SIGALRM.
 */
#define _POSIX_C_SOURCE 200809L
#include "tess.h"
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PATCHES = 2000, FACTORS = 6 };

typedef struct Output {
    TessPoint *points;
    uint32_t *indices;
    TessBatchCounts counts;
} Output;

static float factors[PATCHES * FACTORS];

static void must(const char *what, int is_right)
{
    if (!is_right) {
        fprintf(stderr, "%s\n", what);
        _exit(1);
    }
}

static TessBatch *created(void)
{
    const TessConfig config = {TESS_DOMAIN_QUAD, TESS_PARTITIONING_FRACTIONAL_ODD, TESS_OUTPUT_TRIANGLE_CW,
                               TESS_SPLIT_RULER};
    TessBatch *batch = NULL;
    must("tess_batch_create", tess_batch_create(&config, TESS_LEVEL_DETECT, &batch) == TESS_OK);
    return batch;
}

static Output run(TessBatch *batch)
{
    Output to = {0};
    TessBatchOutput output = {0};
    must("tess_batch_count", tess_batch_count(batch, factors, PATCHES * FACTORS, &to.counts) == TESS_OK);
    output.points = to.points = calloc(output.point_capacity = to.counts.points, sizeof(TessPoint));
    output.indices = to.indices = calloc(output.index_capacity = to.counts.indices, sizeof(uint32_t));
    output.memory = TESS_MEMORY_INITIALISED;
    must("memory", to.points != NULL && to.indices != NULL);
    must("tess_batch_run", tess_batch_run(batch, factors, PATCHES * FACTORS, &output, &to.counts) == TESS_OK);
    return to;
}

static void compare(const char *what, TessBatch *batch, const Output *expected)
{
    Output output = run(batch);
    must(what, output.counts.points == expected->counts.points && output.counts.indices == expected->counts.indices
                   && !memcmp(output.points, expected->points, output.counts.points * sizeof(TessPoint))
                   && !memcmp(output.indices, expected->indices, output.counts.indices * sizeof(uint32_t)));
    free(output.points);
    free(output.indices);
}

/* Runs a batch of the parent and one of its own in a child, and in a child of that. */
static void in_children(TessBatch *batch, const Output *expected, int depth)
{
    int status = 1;
    const pid_t child = fork();
    must("fork", child >= 0);
    if (child == 0) {
        TessBatch *own = created();
        alarm(60);
        compare("a batch of the parent", batch, expected);
        must("threads of a child", tess_batch_set_threads(own, 3) == TESS_OK);
        compare("a batch of the child", own, expected);
        if (depth > 1)
            in_children(batch, expected, depth - 1);
        tess_batch_free(own);
        _exit(0);
    }
    must("waitpid", waitpid(child, &status, 0) == child);
    must("the child hangs", !WIFSIGNALED(status) || WTERMSIG(status) != SIGALRM);
    must("the child", WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

int main(int argc, char **argv)
{
    TessBatch *batch = created();
    Output expected;
    size_t i;
    for (i = 0; i < PATCHES * FACTORS; i++)
        factors[i] = 1 + (float)(i * 37 % 101) / 8;
    expected = run(batch);
    must("the batch is large enough for threads", expected.counts.indices * sizeof(uint32_t) > 1 << 20);
    if (argc == 2 && !strcmp(argv[1], "fork")) {
        in_children(batch, &expected, 1);
        must("threads", tess_batch_set_threads(batch, 2) == TESS_OK);
        in_children(batch, &expected, 1);
        compare("the parent", batch, &expected);
        in_children(batch, &expected, 2);
        compare("the parent, afterwards", batch, &expected);
    } else {
        must("no threads", tess_batch_set_threads(batch, 2) == TESS_NO_THREADS);
        must("the message", !strcmp(tess_status_message(TESS_NO_THREADS), "no more threads can be started"));
        must("one thread", tess_batch_set_threads(batch, 1) == TESS_OK);
        compare("on one thread", batch, &expected);
    }
    tess_batch_free(batch);
    puts("equal");
    return 0;
}
