// A fixed-function tessellator. Takes configurations and factors, and outputs streams of counts, points and primitives. See
// docs/rtl.md.
//
// Every stream is valid/ready: an element is transferred at a rising edge of clk at which both are 1. Each patch has one
// element in the stream of counts. Its points and primitives follow the order of the specification, with `last` at the last
// of each. A culled patch has counts of 0, and no elements in the other streams. The three streams do not wait for each
// other within a patch; none is more than two patches ahead of another.
//
// TAG adds a value of the user to each patch, which is beside its counts and each of its points and primitives. BASE numbers
// the points of a patch from `patch_first`: the sum of it and an index is the index that the primitive has. The ports of
// parameters that are 0 have one bit, which is ignored or 0.
//
// With POINTS 2 or 4, an element of the stream of points is up to so many points that follow each other on an edge. They are in
// the lanes of `point_u` and `point_v` from the lowest on, and `point_keep` has a bit for each.
`include "tess_types.svh"
module tess_top #(
    parameter bit BUFFERED = 1'b0, // a register stage at each port: tess_skid
    parameter int TAG      = 0,    // bits of a tag
    parameter int BASE     = 0,    // bits of an index that is counted from patch_first; 0: 13 bits, counted from 0
    parameter int POINTS   = 1,    // points per clock: 1, 2 or 4
    localparam int TAGS    = (TAG == 0) ? 1 : TAG,
    localparam int FIRSTS  = (BASE == 0) ? 1 : BASE,
    localparam int INDICES = (BASE == 0) ? 13 : BASE
) (
    input  logic               clk,
    input  logic               rst,            // synchronous

    input  logic               patch_valid,
    output logic               patch_ready,
    input  logic [1:0]         patch_domain,   // numbers of tess_pkg; 3 is not a domain, and its patches are culled
    input  logic [1:0]         patch_partitioning,
    input  logic [1:0]         patch_out,
    input  logic               patch_center,   // split order: 0 ruler, 1 center
    input  logic [191:0]       patch_factors,  // binary32 in the order of section 1, factor 0 in the lowest bits
    /* verilator lint_off UNUSEDSIGNAL */ // parameters that are 0 leave them unused
    input  logic [TAGS-1:0]    patch_tag,
    input  logic [FIRSTS-1:0]  patch_first,    // number of the patch's first point
    /* verilator lint_on UNUSEDSIGNAL */

    output logic               counts_valid,
    input  logic               counts_ready,
    output logic [12:0]        counts_points,  // 0..4225
    output logic [13:0]        counts_primitives, // 0..8192
    output logic [TAGS-1:0]    counts_tag,     // of the patch

    output logic               point_valid,
    input  logic               point_ready,
    output logic [POINTS-1:0]  point_keep,     // the lanes that have a point, from the lowest bit on: never 0
    output logic [17*POINTS-1:0] point_u,      // 16.16, 0..ONE; 17 bits of each lane
    output logic [17*POINTS-1:0] point_v,
    output logic               point_last,
    output logic [TAGS-1:0]    point_tag,

    output logic               primitive_valid,
    input  logic               primitive_ready,
    output logic [1:0]         primitive_size, // 1 to 3 indices; the others are 0
    output logic [INDICES-1:0] primitive_i0,
    output logic [INDICES-1:0] primitive_i1,
    output logic [INDICES-1:0] primitive_i2,
    output logic               primitive_last,
    output logic [TAGS-1:0]    primitive_tag
);
    // Every patch, even a culled one, takes at least two clocks, so buffers for one element in two clocks are enough for
    // patches and counts.
    localparam int EVERY_OTHER = BUFFERED ? 1 : 0;
    localparam int EVERY       = BUFFERED ? 2 : 0;
    // The sums of BASE are behind registers, so they are not in the path of `primitive_ready`.
    localparam int SUMMED      = (BASE == 0) ? EVERY : 2;
    // What accompanies a patch: its tag and the number of its first point.
    localparam bit LABELLED = TAG != 0 || BASE != 0;
    localparam int LABELS   = TAGS + FIRSTS;

    // ---- the front end -------------------------------------------------------------------------

    localparam int PATCH   = 2 + 2 + 2 + 1 + 192;
    localparam int PATCHES = PATCH + (LABELLED ? LABELS : 0);
    logic               in_valid, in_ready, in_center;
    logic [1:0]         in_domain, in_partitioning, in_out;
    logic [191:0]       in_factors;
    logic [PATCHES-1:0] patch_data;
    tess_skid #(.WIDTH(PATCHES), .ENTRIES(EVERY_OTHER)) patch_stage (
        .clk, .rst,
        .in_valid (patch_valid),
        .in_ready (patch_ready),
        .in_data  (PATCHES'({(TAG == 0) ? '0 : patch_tag, (BASE == 0) ? '0 : patch_first,
                              patch_domain, patch_partitioning, patch_out, patch_center, patch_factors})),
        .out_valid(in_valid),
        .out_ready(in_ready),
        .out_data (patch_data)
    );
    assign {in_domain, in_partitioning, in_out, in_center, in_factors} = patch_data[PATCH-1:0];

    logic              enter_valid, enter_ready, leave_valid, leave_ready, made_valid, made_ready;
    logic [LABELS-1:0] label;
    tess_tags #(.USED(LABELLED), .WIDTH(LABELS)) front_tags (
        .clk, .rst,
        .in_valid,
        .in_ready,
        .in_count  (14'd1),
        .in_tag    (LABELS'(patch_data >> PATCH)),
        .to_valid  (enter_valid),
        .to_ready  (enter_ready),
        .from_valid(leave_valid),
        .from_ready(leave_ready),
        .from_last (1'b1),
        .out_valid (made_valid),
        .out_ready (made_ready),
        .out_tag   (label)
    );
    tess_patch_t                        made;
    logic [tess_pkg::CONTEXTS_BITS-1:0] contexts;
    tess_factors stage_factors (
        .clk, .rst,
        .in_valid    (enter_valid),
        .in_ready    (enter_ready),
        .in_domain,
        .in_partitioning,
        .in_out,
        .in_center,
        .in_factors,
        .out_valid   (leave_valid),
        .out_ready   (leave_ready),
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
    logic [TAGS-1:0] counted_tag;
    assign counts_free = !counted_valid || counted_ready;
    always_ff @(posedge clk) begin
        if (rst) begin
            counted_valid <= 1'b0;
        end else if (counts_free) begin
            counted_valid      <= counts_starts;
            counted_points     <= made.points;
            counted_primitives <= made.primitives;
            counted_tag        <= label[LABELS-1:FIRSTS];
        end
    end
    logic [27+TAG-1:0] counts_data;
    tess_skid #(.WIDTH(27 + TAG), .ENTRIES(EVERY_OTHER)) counts_stage (
        .clk, .rst,
        .in_valid (counted_valid),
        .in_ready (counted_ready),
        .in_data  ((27+TAG)'({counted_tag, counted_points, counted_primitives})),
        .out_valid(counts_valid),
        .out_ready(counts_ready),
        .out_data (counts_data)
    );
    assign {counts_points, counts_primitives} = counts_data[26:0];
    assign counts_tag = TAGS'(counts_data >> 27);

    // ---- points --------------------------------------------------------------------------------

    logic            place_valid, place_ready, walked_valid, walked_ready, placed_valid, placed_ready, placed_last;
    logic [POINTS-1:0]    placed_keep;
    logic [17*POINTS-1:0] placed_u, placed_v;
    logic [TAGS-1:0]      placed_tag;
    tess_tags #(.USED(TAG != 0), .WIDTH(TAGS)) point_tags (
        .clk, .rst,
        .in_valid  (points_starts),
        .in_ready  (points_ready),
        .in_count  ({1'b0, made.points}),
        .in_tag    (label[LABELS-1:FIRSTS]),
        .to_valid  (place_valid),
        .to_ready  (place_ready),
        .from_valid(walked_valid),
        .from_ready(walked_ready),
        .from_last (placed_last),
        .out_valid (placed_valid),
        .out_ready (placed_ready),
        .out_tag   (placed_tag)
    );
    // The patch waits here for the walk, so that no `ready` of the walk leads to the fork. A patch has at least two clocks.
    logic                               to_place_valid, to_place_ready;
    tess_patch_t                        to_place;
    logic [tess_pkg::CONTEXTS_BITS-1:0] to_place_contexts;
    tess_skid #(.WIDTH(tess_pkg::PATCH_BITS + tess_pkg::CONTEXTS_BITS), .ENTRIES(1)) place_stage (
        .clk, .rst,
        .in_valid (place_valid),
        .in_ready (place_ready),
        .in_data  ({made, contexts}),
        .out_valid(to_place_valid),
        .out_ready(to_place_ready),
        .out_data ({to_place, to_place_contexts})
    );
    tess_points #(.POINTS(POINTS)) stage_points (
        .clk, .rst,
        .start_valid   (to_place_valid),
        .start_ready   (to_place_ready),
        .start_patch   (to_place),
        .start_contexts(to_place_contexts),
        .out_valid     (walked_valid),
        .out_ready     (walked_ready),
        .out_keep      (placed_keep),
        .out_u         (placed_u),
        .out_v         (placed_v),
        .out_last      (placed_last)
    );
    localparam int POINT = POINTS * (1 + 2 * 17) + 1;
    logic [POINT+TAG-1:0] point_data;
    tess_skid #(.WIDTH(POINT + TAG), .ENTRIES(EVERY)) point_stage (
        .clk, .rst,
        .in_valid (placed_valid),
        .in_ready (placed_ready),
        .in_data  ((POINT+TAG)'({placed_tag, placed_keep, placed_u, placed_v, placed_last})),
        .out_valid(point_valid),
        .out_ready(point_ready),
        .out_data (point_data)
    );
    assign {point_keep, point_u, point_v, point_last} = point_data[POINT-1:0];
    assign point_tag = TAGS'(point_data >> POINT);

    // ---- primitives ----------------------------------------------------------------------------

    logic [tess_pkg::COUNTS_BITS-1:0] edges;
    for (genvar i = 0; i < tess_pkg::FACTORS; i++) begin : g_counts
        assign edges[7*i +: 7] = contexts[tess_pkg::CONTEXT_BITS*i +: 7];
    end
    logic              join_valid, join_ready, stepped_valid, stepped_ready, joined_valid, joined_ready, joined_last;
    logic [1:0]        joined_size;
    logic [12:0]       joined_i0, joined_i1, joined_i2;
    logic [LABELS-1:0] joined_label;
    tess_tags #(.USED(LABELLED), .WIDTH(LABELS)) primitive_tags (
        .clk, .rst,
        .in_valid  (connect_starts),
        .in_ready  (connect_ready),
        .in_count  (made.primitives),
        .in_tag    (label),
        .to_valid  (join_valid),
        .to_ready  (join_ready),
        .from_valid(stepped_valid),
        .from_ready(stepped_ready),
        .from_last (joined_last),
        .out_valid (joined_valid),
        .out_ready (joined_ready),
        .out_tag   (joined_label)
    );
    logic                             to_join_valid, to_join_ready;
    tess_patch_t                      to_join;
    logic [tess_pkg::COUNTS_BITS-1:0] to_join_edges;
    tess_skid #(.WIDTH(tess_pkg::PATCH_BITS + tess_pkg::COUNTS_BITS), .ENTRIES(1)) join_stage (
        .clk, .rst,
        .in_valid (join_valid),
        .in_ready (join_ready),
        .in_data  ({made, edges}),
        .out_valid(to_join_valid),
        .out_ready(to_join_ready),
        .out_data ({to_join, to_join_edges})
    );
    tess_connect stage_connect (
        .clk, .rst,
        .start_valid (to_join_valid),
        .start_ready (to_join_ready),
        .start_patch (to_join),
        .start_counts(to_join_edges),
        .out_valid   (stepped_valid),
        .out_ready   (stepped_ready),
        .out_size    (joined_size),
        .out_i0      (joined_i0),
        .out_i1      (joined_i1),
        .out_i2      (joined_i2),
        .out_last    (joined_last)
    );
    logic [INDICES-1:0] i0, i1, i2;
    tess_base #(.BASE(BASE)) base (
        .first (joined_label[FIRSTS-1:0]),
        .size  (joined_size),
        .in_i0 (joined_i0),
        .in_i1 (joined_i1),
        .in_i2 (joined_i2),
        .out_i0(i0),
        .out_i1(i1),
        .out_i2(i2)
    );
    localparam int PRIMITIVE = 2 + 3 * INDICES + 1;
    logic [PRIMITIVE+TAG-1:0] primitive_data;
    tess_skid #(.WIDTH(PRIMITIVE + TAG), .ENTRIES(SUMMED)) primitive_stage (
        .clk, .rst,
        .in_valid (joined_valid),
        .in_ready (joined_ready),
        .in_data  ((PRIMITIVE+TAG)'({joined_label[LABELS-1:FIRSTS], joined_size, i0, i1, i2, joined_last})),
        .out_valid(primitive_valid),
        .out_ready(primitive_ready),
        .out_data (primitive_data)
    );
    assign {primitive_size, primitive_i0, primitive_i1, primitive_i2, primitive_last} = primitive_data[PRIMITIVE-1:0];
    assign primitive_tag = TAGS'(primitive_data >> PRIMITIVE);
endmodule
