// The ports of rtl/tess_top. The driver and the sink write at falling edges; all components read at rising edges.
interface tess_if (
    input logic clk
);
    logic         rst = 1'b1;

    logic         patch_valid = 1'b0;
    logic         patch_ready;
    logic [1:0]   patch_domain;
    logic [1:0]   patch_partitioning;
    logic [1:0]   patch_out;
    logic         patch_center;
    logic [191:0] patch_factors;

    logic         counts_valid;
    logic         counts_ready = 1'b0;
    logic [12:0]  counts_points;
    logic [13:0]  counts_primitives;

    logic         point_valid;
    logic         point_ready = 1'b0;
    logic [16:0]  point_u;
    logic [16:0]  point_v;
    logic         point_last;

    logic         primitive_valid;
    logic         primitive_ready = 1'b0;
    logic [1:0]   primitive_size;
    logic [12:0]  primitive_i0;
    logic [12:0]  primitive_i1;
    logic [12:0]  primitive_i2;
    logic         primitive_last;
endinterface
