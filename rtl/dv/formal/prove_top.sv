// Every output of the whole design, with and without register stages, tags and numbered points, and with several points per clock:
// an element that waits stays with its value, for any number of clocks. The modules' own proofs cover which element it is.
module prove_top (
    input logic         clk, rst, patch_valid, patch_center, counts_ready, point_ready, primitive_ready,
    input logic [1:0]   patch_domain, patch_partitioning, patch_out,
    input logic [191:0] patch_factors,
    input logic [3:0]   tag,
    input logic [13:0]  first
);
    for (genvar i = 0; i < 6; i++) begin : g_variant
        localparam int TAG    = (i == 2 || i == 3 || i == 5) ? 4 : 0;
        localparam int BASE   = (TAG == 0) ? 0 : 14;
        localparam int POINTS = (i < 4) ? 1 : (i == 4) ? 2 : 4;
        localparam int TAGS    = (TAG == 0) ? 1 : TAG;
        localparam int INDICES = (BASE == 0) ? 13 : BASE;
        logic               patch_ready, counts_valid, point_valid, point_last, primitive_valid, primitive_last;
        logic [12:0]        counts_points;
        logic [13:0]        counts_primitives;
        logic [POINTS-1:0]  point_keep;
        logic [17*POINTS-1:0] point_u, point_v;
        logic [1:0]         primitive_size;
        logic [INDICES-1:0] primitive_i0, primitive_i1, primitive_i2;
        logic [TAGS-1:0]    counts_tag, point_tag, primitive_tag;
        tess_top #(.BUFFERED(i % 2 == 1), .TAG(TAG), .BASE(BASE), .POINTS(POINTS)) top (
            .patch_tag(tag[TAGS-1:0]), .patch_first(first[((BASE == 0) ? 1 : BASE)-1:0]), .*);
        port #(.WIDTH(13 + 14 + TAGS)) counts_port (
            .clk, .rst, .valid(counts_valid), .ready(counts_ready), .data({counts_points, counts_primitives, counts_tag}));
        port #(.WIDTH(35 * POINTS + 1 + TAGS)) point_port (
            .clk, .rst, .valid(point_valid), .ready(point_ready), .data({point_keep, point_u, point_v, point_last, point_tag}));
        port #(.WIDTH(2 + 3 * INDICES + 1 + TAGS)) primitive_port (
            .clk, .rst, .valid(primitive_valid), .ready(primitive_ready),
            .data({primitive_size, primitive_i0, primitive_i1, primitive_i2, primitive_last, primitive_tag}));
    end
endmodule
