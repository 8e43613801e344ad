/*
 * The declarations by which Mesa's draw module calls a tessellator, written for the tests of integrations/mesa:
 * names, numbers and layouts as Mesa 25.0 has them, so that tess_mesa.c compiles and runs without Mesa.
 */
#ifndef PIPE_TESSELLATOR_H
#define PIPE_TESSELLATOR_H

#include <stdbool.h>
#include <stdint.h>

enum mesa_prim { MESA_PRIM_LINES = 1, MESA_PRIM_TRIANGLES = 4, MESA_PRIM_QUADS = 7 };

enum pipe_tess_spacing {
   PIPE_TESS_SPACING_FRACTIONAL_ODD = 0,
   PIPE_TESS_SPACING_FRACTIONAL_EVEN = 1,
   PIPE_TESS_SPACING_EQUAL = 2
};

struct pipe_tessellator;

struct pipe_tessellation_factors {
   float outer_tf[4];
   float inner_tf[2];
   float pad[2];
};

struct pipe_tessellator_data {
   uint32_t num_indices;
   uint32_t num_domain_points;
   uint32_t *indices;
   float *domain_points_u;
   float *domain_points_v;
};

struct pipe_tessellator *p_tess_init(enum mesa_prim tes_prim_mode, enum pipe_tess_spacing spacing,
                                     bool tes_vertex_order_cw, bool tes_point_mode);
void p_tess_destroy(struct pipe_tessellator *pipe_ts);
void p_tessellate(struct pipe_tessellator *pipe_ts, const struct pipe_tessellation_factors *tess_factors,
                  struct pipe_tessellator_data *tess_data);

#endif
