// Every output of the whole design, with and without register stages: an element that waits stays with its value, for any
// number of clocks. The modules' own proofs cover which element it is.
module prove_top (
    input logic         clk, rst, patch_valid, patch_center, counts_ready, point_ready, primitive_ready,
    input logic [1:0]   patch_domain, patch_partitioning, patch_out,
    input logic [191:0] patch_factors
);
    for (genvar i = 0; i < 2; i++) begin : g_buffered
        logic        patch_ready, counts_valid, point_valid, point_last, primitive_valid, primitive_last;
        logic [12:0] counts_points, primitive_i0, primitive_i1, primitive_i2;
        logic [13:0] counts_primitives;
        logic [16:0] point_u, point_v;
        logic [1:0]  primitive_size;
        tess_top #(.BUFFERED(i == 1)) top (.*);
        port #(.WIDTH(13 + 14)) counts_port (
            .clk, .rst, .valid(counts_valid), .ready(counts_ready), .data({counts_points, counts_primitives}));
        port #(.WIDTH(2 * 17 + 1)) point_port (
            .clk, .rst, .valid(point_valid), .ready(point_ready), .data({point_u, point_v, point_last}));
        port #(.WIDTH(2 + 3 * 13 + 1)) primitive_port (
            .clk, .rst, .valid(primitive_valid), .ready(primitive_ready),
            .data({primitive_size, primitive_i0, primitive_i1, primitive_i2, primitive_last}));
    end
endmodule
