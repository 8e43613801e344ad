/* The clock of calls.c, calls.sv and apart.c, in nanoseconds. */
#define _POSIX_C_SOURCE 199309L
#include <stdint.h>
#include <time.h>

#ifdef __cplusplus
extern "C"
#endif
uint64_t calls_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}
