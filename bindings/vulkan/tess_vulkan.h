/* A host in C99 that runs the compute shaders over Vulkan 1.1. It needs the loader and a folder written by
   `tess shaders --target spirv -o FOLDER`; tess_vulkan.c includes FOLDER/tess_shaders.h. */
#ifndef TESS_VULKAN_H
#define TESS_VULKAN_H

#include <stdint.h>

/* A device with a pipeline for each stage. Only one thread may use it at a time. */
struct tess_vulkan;

/* The output of a batch. If `overflow` is not 0, the room was too small for the points (bit 0) or the
   primitives (bit 1), and neither points nor indices were written. */
struct tess_output {
    uint64_t needed_points, needed_primitives;
    uint32_t overflow;
    uint32_t draw[5];  /* indexed indirect draw: index count, instances, first index, vertex, instance */
    void *points;      /* 8 bytes each, needed_points of them */
    void *indices;     /* draw[0] of them, of the shaders' index width */
    double milliseconds; /* from the first dispatch to the last, by the device's clock */
};

/* Opens device number `device` (in the loader's order) with the shaders and tables in `folder`.
   Returns NULL after an error, which `message` then describes. */
struct tess_vulkan *tess_vulkan_open(const char *folder, uint32_t device, char message[256]);

/* Tessellates `patches` patches, whose factors are binary32 bits in the specification's order, with
   room for `points` points and `primitives` primitives, at least 1 each. Runs the batch `runs` times and
   records the time of the fastest run. Returns 0, or -1 after an error, which `message` then describes.
   Free the output with tess_output_free. */
int tess_vulkan_run(struct tess_vulkan *host, const uint32_t *factors, uint32_t patches,
                    uint32_t points, uint32_t primitives, uint32_t runs,
                    struct tess_output *output, char message[256]);

void tess_output_free(struct tess_output *output);
void tess_vulkan_close(struct tess_vulkan *host);

#endif
