// The ports of the tessellator in SystemC: those of rtl/tess_top.sv, with the types that Verilator uses. An element of a
// stream is transferred at a rising edge of `clk` at which its valid and ready are true. See docs/rtl.md.
#ifndef TESS_PORTS_H
#define TESS_PORTS_H

#include <systemc>

struct tess_ports : sc_core::sc_module {
    sc_core::sc_in<bool> clk{"clk"};
    sc_core::sc_in<bool> rst{"rst"}; // synchronous

    sc_core::sc_in<bool> patch_valid{"patch_valid"};
    sc_core::sc_out<bool> patch_ready{"patch_ready"};
    sc_core::sc_in<uint32_t> patch_domain{"patch_domain"}; // numbers of tess.h
    sc_core::sc_in<uint32_t> patch_partitioning{"patch_partitioning"};
    sc_core::sc_in<uint32_t> patch_out{"patch_out"};
    sc_core::sc_in<bool> patch_center{"patch_center"};
    sc_core::sc_in<sc_dt::sc_bv<192>> patch_factors{"patch_factors"}; // binary32, factor 0 in the lowest bits

    sc_core::sc_out<bool> counts_valid{"counts_valid"};
    sc_core::sc_in<bool> counts_ready{"counts_ready"};
    sc_core::sc_out<uint32_t> counts_points{"counts_points"};
    sc_core::sc_out<uint32_t> counts_primitives{"counts_primitives"};

    sc_core::sc_out<bool> point_valid{"point_valid"};
    sc_core::sc_in<bool> point_ready{"point_ready"};
    sc_core::sc_out<uint32_t> point_u{"point_u"}; // 16.16, 0..0x10000
    sc_core::sc_out<uint32_t> point_v{"point_v"};
    sc_core::sc_out<bool> point_last{"point_last"};

    sc_core::sc_out<bool> primitive_valid{"primitive_valid"};
    sc_core::sc_in<bool> primitive_ready{"primitive_ready"};
    sc_core::sc_out<uint32_t> primitive_size{"primitive_size"}; // 1 to 3 indices; the others are 0
    sc_core::sc_out<uint32_t> primitive_i0{"primitive_i0"};
    sc_core::sc_out<uint32_t> primitive_i1{"primitive_i1"};
    sc_core::sc_out<uint32_t> primitive_i2{"primitive_i2"};
    sc_core::sc_out<bool> primitive_last{"primitive_last"};

  protected:
    explicit tess_ports(const sc_core::sc_module_name &name) : sc_module(name) {}
};

#endif
