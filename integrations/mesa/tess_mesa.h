/*
 * All patches of a draw in one call, beside Mesa's own interface of one patch a call (p_tessellator.h).
 *
 * Mesa numbers the vertices of a draw in 16 bits, so a draw is cut into parts of at most TESS_MESA_MAX_POINTS
 * points. p_tess_batch_take says how many patches the next part has and how large it is; p_tess_batch_write
 * writes it.
 */
#ifndef TESS_MESA_H
#define TESS_MESA_H

#include <stdbool.h>
#include <stdint.h>

#include "tessellator/p_tessellator.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The most points of a part. One patch has at most 4225, so that a part has at least one patch. */
enum { TESS_MESA_MAX_POINTS = 65535 };

/* Where the output of one patch lies in that of its part. A culled patch has no points and no indices. */
struct tess_mesa_range {
   uint32_t first_point;
   uint32_t num_points;
   uint32_t first_index;
   uint32_t num_indices;
};

/* A part of a draw. The tessellator owns the arrays; they last until its next call. */
struct tess_mesa_batch {
   unsigned num_patches;
   uint32_t num_points;
   uint32_t num_indices;
   float *points_u;
   float *points_v;
   const struct tess_mesa_range *ranges; /* one for each patch */
};

/* Takes as many of the `num_patches` patches at `factors` as make a part, at least one if there is one, and
 * sets the counts of `batch`, its arrays to NULL. False: there is no memory; nothing is taken. */
bool p_tess_batch_take(struct pipe_tessellator *ts, const struct pipe_tessellation_factors *factors,
                       unsigned num_patches, struct tess_mesa_batch *batch);

/* Tessellates the part that was taken last: sets the arrays of `batch`, and writes `batch->num_indices` indices,
 * which count from the part's first point, to `elts`. False: there is no memory; nothing is to be drawn. */
bool p_tess_batch_write(struct pipe_tessellator *ts, struct tess_mesa_batch *batch, uint16_t *elts);

#ifdef __cplusplus
}
#endif

#endif
