/* A host of the compute shaders over Vulkan 1.1, in C99. It needs the loader and the folder that
   `tess shaders --target spirv -o FOLDER` wrote, with FOLDER/tess_shaders.h included by tess_vulkan.c. */
#ifndef TESS_VULKAN_H
#define TESS_VULKAN_H

#include <stdint.h>

/* A device with a pipeline for each stage. One thread uses it at a time. */
struct tess_vulkan;

/* The output of a batch. If `overflow` is not 0, the room was too small (bit 0: for the points, bit 1: for
   the primitives), and neither points nor indices were written. */
struct tess_output {
    uint64_t needed_points, needed_primitives;
    uint32_t overflow;
    uint32_t draw[5];  /* indexed indirect draw: index count, instances, first index, vertex, instance */
    void *points;      /* 8 bytes each, needed_points of them */
    void *indices;     /* draw[0] of them, of the width that the shaders were written for */
    double milliseconds; /* from the first dispatch to the last, by the device's clock */
};

/* Opens device number `device` (in the loader's order) with the shaders and tables in `folder`.
   Gives NULL after an error; `message` then says what was wrong. */
struct tess_vulkan *tess_vulkan_open(const char *folder, uint32_t device, char message[256]);

/* Tessellates `patches` patches, whose factors are binary32 bits in the specification's order, with
   room for these numbers of points and primitives, at least 1 each. Runs it `runs` times and gives the
   time of the fastest. Gives 0, or -1 after an error. Free the output with tess_output_free. */
int tess_vulkan_run(struct tess_vulkan *host, const uint32_t *factors, uint32_t patches,
                    uint32_t points, uint32_t primitives, uint32_t runs,
                    struct tess_output *output, char message[256]);

void tess_output_free(struct tess_output *output);
void tess_vulkan_close(struct tess_vulkan *host);

#endif
