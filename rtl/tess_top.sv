// A fixed-function tessellator. Takes configurations and factors, and outputs streams of counts, points and primitives. See
// docs/rtl.md.
//
// Every stream is valid/ready: an element is transferred at a rising edge of clk at which both are 1. Each patch has one
// element in the stream of counts. Its points and primitives follow the order of the specification, with `last` at the last
// of each. A culled patch has counts of 0, and no elements in the other streams. The three streams do not wait for each
// other within a patch; none is more than one patch ahead of another.
`include "tess_types.svh"
module tess_top #(
    parameter bit BUFFERED = 1'b0              // a register stage at each port: tess_skid
) (
    input  logic         clk,
    input  logic         rst,              // synchronous

    input  logic         patch_valid,
    output logic         patch_ready,
    input  logic [1:0]   patch_domain,       // numbers of tess_pkg; 3 is not a domain, and its patches are culled
    input  logic [1:0]   patch_partitioning,
    input  logic [1:0]   patch_out,
    input  logic         patch_center,       // split order: 0 ruler, 1 center
    input  logic [191:0] patch_factors,      // binary32 in the order of section 1, factor 0 in the lowest bits

    output logic         counts_valid,
    input  logic         counts_ready,
    output logic [12:0]  counts_points,      // 0..4225
    output logic [13:0]  counts_primitives,  // 0..8192

    output logic         point_valid,
    input  logic         point_ready,
    output logic [16:0]  point_u,            // 16.16, 0..ONE
    output logic [16:0]  point_v,
    output logic         point_last,

    output logic         primitive_valid,
    input  logic         primitive_ready,
    output logic [1:0]   primitive_size,     // 1 to 3 indices; the others are 0
    output logic [12:0]  primitive_i0,
    output logic [12:0]  primitive_i1,
    output logic [12:0]  primitive_i2,
    output logic         primitive_last
);
    // Every patch, even a culled one, takes at least two clocks, so buffers for one element in two clocks are enough for
    // patches and counts.
    localparam int EVERY_OTHER = BUFFERED ? 1 : 0;
    localparam int EVERY       = BUFFERED ? 2 : 0;

    // ---- the front end -------------------------------------------------------------------------

    logic         in_valid, in_ready, in_center;
    logic [1:0]   in_domain, in_partitioning, in_out;
    logic [191:0] in_factors;
    tess_skid #(.WIDTH(2 + 2 + 2 + 1 + 192), .ENTRIES(EVERY_OTHER)) patch_stage (
        .clk, .rst,
        .in_valid (patch_valid),
        .in_ready (patch_ready),
        .in_data  ({patch_domain, patch_partitioning, patch_out, patch_center, patch_factors}),
        .out_valid(in_valid),
        .out_ready(in_ready),
        .out_data ({in_domain, in_partitioning, in_out, in_center, in_factors})
    );

    logic                               made_valid, made_ready;
    tess_patch_t                        made;
    logic [tess_pkg::CONTEXTS_BITS-1:0] contexts;
    tess_factors stage_factors (
        .clk, .rst,
        .in_valid,
        .in_ready,
        .in_domain,
        .in_partitioning,
        .in_out,
        .in_center,
        .in_factors,
        .out_valid   (made_valid),
        .out_ready   (made_ready),
        .out_patch   (made),
        .out_contexts(contexts)
    );

    // A patch leaves the front end when all three consumers have taken it.
    logic points_ready, connect_ready, counts_free;
    logic points_starts, connect_starts, counts_starts;
    tess_fork #(.N(3)) stage_fork (
        .clk, .rst,
        .in_valid (made_valid),
        .in_ready (made_ready),
        .out_valid({counts_starts, connect_starts, points_starts}),
        .out_ready({counts_free, connect_ready, points_ready})
    );

    // ---- counts --------------------------------------------------------------------------------

    logic        counted_valid, counted_ready;
    logic [12:0] counted_points;
    logic [13:0] counted_primitives;
    assign counts_free = !counted_valid || counted_ready;
    always_ff @(posedge clk) begin
        if (rst) begin
            counted_valid <= 1'b0;
        end else if (counts_free) begin
            counted_valid      <= counts_starts;
            counted_points     <= made.points;
            counted_primitives <= made.primitives;
        end
    end
    tess_skid #(.WIDTH(13 + 14), .ENTRIES(EVERY_OTHER)) counts_stage (
        .clk, .rst,
        .in_valid (counted_valid),
        .in_ready (counted_ready),
        .in_data  ({counted_points, counted_primitives}),
        .out_valid(counts_valid),
        .out_ready(counts_ready),
        .out_data ({counts_points, counts_primitives})
    );

    // ---- points --------------------------------------------------------------------------------

    logic        placed_valid, placed_ready, placed_last;
    logic [16:0] placed_u, placed_v;
    tess_points stage_points (
        .clk, .rst,
        .start_valid   (points_starts),
        .start_ready   (points_ready),
        .start_patch   (made),
        .start_contexts(contexts),
        .out_valid     (placed_valid),
        .out_ready     (placed_ready),
        .out_u         (placed_u),
        .out_v         (placed_v),
        .out_last      (placed_last)
    );
    tess_skid #(.WIDTH(17 + 17 + 1), .ENTRIES(EVERY)) point_stage (
        .clk, .rst,
        .in_valid (placed_valid),
        .in_ready (placed_ready),
        .in_data  ({placed_u, placed_v, placed_last}),
        .out_valid(point_valid),
        .out_ready(point_ready),
        .out_data ({point_u, point_v, point_last})
    );

    // ---- primitives ----------------------------------------------------------------------------

    logic [tess_pkg::COUNTS_BITS-1:0] counts;
    for (genvar i = 0; i < tess_pkg::FACTORS; i++) begin : g_counts
        assign counts[7*i +: 7] = contexts[tess_pkg::CONTEXT_BITS*i +: 7];
    end
    logic        joined_valid, joined_ready, joined_last;
    logic [1:0]  joined_size;
    logic [12:0] joined_i0, joined_i1, joined_i2;
    tess_connect stage_connect (
        .clk, .rst,
        .start_valid (connect_starts),
        .start_ready (connect_ready),
        .start_patch (made),
        .start_counts(counts),
        .out_valid   (joined_valid),
        .out_ready   (joined_ready),
        .out_size    (joined_size),
        .out_i0      (joined_i0),
        .out_i1      (joined_i1),
        .out_i2      (joined_i2),
        .out_last    (joined_last)
    );
    tess_skid #(.WIDTH(2 + 3 * 13 + 1), .ENTRIES(EVERY)) primitive_stage (
        .clk, .rst,
        .in_valid (joined_valid),
        .in_ready (joined_ready),
        .in_data  ({joined_size, joined_i0, joined_i1, joined_i2, joined_last}),
        .out_valid(primitive_valid),
        .out_ready(primitive_ready),
        .out_data ({primitive_size, primitive_i0, primitive_i1, primitive_i2, primitive_last})
    );
endmodule
