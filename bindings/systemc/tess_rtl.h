// The circuit of rtl/ as a SystemC module: cycle-accurate, through Verilator (`verilator --sc --top-module tess_top`).
#ifndef TESS_RTL_H
#define TESS_RTL_H

#include "Vtess_top.h"
#include "tess_ports.h"

class tess_rtl : public tess_ports {
  public:
    explicit tess_rtl(const sc_core::sc_module_name &name) : tess_ports(name) {
        top.clk(clk);
        top.rst(rst);
        top.patch_valid(patch_valid);
        top.patch_ready(patch_ready);
        top.patch_domain(patch_domain);
        top.patch_partitioning(patch_partitioning);
        top.patch_out(patch_out);
        top.patch_center(patch_center);
        top.patch_factors(patch_factors);
        top.counts_valid(counts_valid);
        top.counts_ready(counts_ready);
        top.counts_points(counts_points);
        top.counts_primitives(counts_primitives);
        top.point_valid(point_valid);
        top.point_ready(point_ready);
        top.point_u(point_u);
        top.point_v(point_v);
        top.point_last(point_last);
        top.primitive_valid(primitive_valid);
        top.primitive_ready(primitive_ready);
        top.primitive_size(primitive_size);
        top.primitive_i0(primitive_i0);
        top.primitive_i1(primitive_i1);
        top.primitive_i2(primitive_i2);
        top.primitive_last(primitive_last);
        for (auto *port : {&top.patch_tag, &top.patch_first}) (*port)(zero);
        top.point_keep(point_keep);
        top.counts_tag(counts_tag);
        top.point_tag(point_tag);
        top.primitive_tag(primitive_tag);
    }

  private:
    // The ports of TAG and BASE, which are 0.
    sc_core::sc_signal<bool> zero{"zero"}, point_keep{"point_keep"}, counts_tag{"counts_tag"}, point_tag{"point_tag"}, primitive_tag{"primitive_tag"};
    Vtess_top top{"top"};
};

#endif
