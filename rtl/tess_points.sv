// The domain points of a patch, up to POINTS per clock, in the specification's order (section 6).
//
// The walk goes edge by edge. The front half describes each edge in `ahead`, one edge in advance, and continues into the
// next patch. Along an edge, `along` counts forward or backward, and `across` is constant. Each coordinate is a constant or
// a location, so two placers, A and B, serve every point. With POINTS 2 or 4 a step of the walk has as many points, from `along`
// on, or those that the edge still has; each further one has a lane of its own, tess_lane.
//
//   line         u = A: place(detail, along)    v = B: place(density, line)
//   outer edge   A: place(edge, along); the other coordinate is constant or ONE - A
//   quad ring    u = A, v = B: one is `along`, the other `across`
//   triangle     A: place(inside, ring), the ring's distance; B: place(inside, along)
//   centre       like a ring of a quad; one third on triangles
//
// A quad with the factors 2, 3, 2, 3 outside, 4 (u) and 3 (v) inside has the counts 3, 4, 3, 4, 5 and 4, and 16 points.
// `tess explain quad --outer 2,3,2,3 --inner 4,3 --partitioning integer --point N` prints each of them.
//
//   v = 1   0---9---8---7          edge           along      across   points
//           | 10  15  14 |         outer, u = 0   2, 1       -        0, 1       backward
//           1            6         outer, v = 0   0, 1, 2    -        2 to 4     forward
//           | 11  12  13 |         outer, u = 1   0, 1       -        5, 6       forward
//   v = 0   2---3---4---5          outer, v = 1   3, 2, 1    -        7 to 9     backward
//                                  ring 1, 0      v 2        u 1      10         end_v = 4 - 1 - 1 = 2
//                                  ring 1, 1      u 1, 2     v 1      11, 12
//                                  ring 1, 2      v 1        u 3      13         end_u = 5 - 1 - 1 = 3
//                                  ring 1, 3      u 3, 2     v 2      14, 15
//
// Ring r has end_u - r and end_v - r points on its edges, so rest_u = 5 - 2 - 2r points follow the first one. Ring 2 would
// have no points, so ring 1 is the innermost.
//
// Invariants:
// - start_patch.points is the patch's count, from tess_factors: 0 for a culled patch. The edges of a patch have as many points
//   together (section 12.6), so the place of an edge says whether it is the last one: `is_last`.
// - `further` and `ahead` are exact: the points that are described are walked, each once (dv/formal).
// - `along` and `across` are below the points of their contexts, which stay with the edge while the next patch is described.
// - Registers after `ahead` change only when `advance` is 1, so nothing is lost while out_ready is 0.
`include "tess_types.svh"
module tess_points #(
    parameter int POINTS = 1 // per clock: 1, 2 or 4
) (
    input  logic                               clk,
    input  logic                               rst,

    input  logic                               start_valid,
    output logic                               start_ready,
    /* verilator lint_off UNUSEDSIGNAL */ // the number of primitives is not used
    input  tess_patch_t                        start_patch,
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic [tess_pkg::CONTEXTS_BITS-1:0] start_contexts,

    output logic                               out_valid,
    input  logic                               out_ready,
    output logic [POINTS-1:0]                  out_keep, // the lanes that have a point, from the lowest bit on
    output logic [17*POINTS-1:0]               out_u,    // the earlier point in the lower bits
    output logic [17*POINTS-1:0]               out_v,
    output logic                               out_last  // the last point of the patch is among them
);
    localparam int BITS = tess_pkg::CONTEXT_BITS;
    localparam logic [2:0] AT_LINE   = tess_pkg::AT_LINE;
    localparam logic [2:0] AT_CORNER = tess_pkg::AT_CORNER;
    localparam logic [2:0] AT_OUTER  = tess_pkg::AT_OUTER;
    localparam logic [2:0] AT_RING   = tess_pkg::AT_RING;
    localparam logic [2:0] AT_CENTRE = tess_pkg::AT_CENTRE;

    logic advance; // the registers of the walk and after it may change
    assign advance = !out_valid || out_ready;

    // ---- the edge that is being described ------------------------------------------------------

    logic                               active;
    logic                               is_quad;
    logic [tess_pkg::CONTEXTS_BITS-1:0] contexts;
    logic                               is_last;   // no edge of the patch follows
    logic [2:0]                         at;
    logic [1:0]                         side;      // number of the edge or the corner
    logic [5:0]                         ring;      // 0 for outer edges; on isolines the number of the line
    logic [6:0]                         further;   // points of this edge after its first one
    logic [6:0]                         end_u, end_v;   // the last positions of this ring
    logic [6:0]                         rest_u, rest_v; // points of its edges after the first; for ring 0 by the inside factors
    logic                               row_along_u;    // the row of points at the centre runs along u

    /* verilator lint_off UNUSEDSIGNAL */ // the rest of each context is not used
    function automatic logic [6:0] points_of(input logic [tess_pkg::CONTEXTS_BITS-1:0] all, input logic [2:0] i);
        unique case (i)
            3'd0:    points_of = all[BITS*0 +: 7];
            3'd1:    points_of = all[BITS*1 +: 7];
            3'd2:    points_of = all[BITS*2 +: 7];
            3'd3:    points_of = all[BITS*3 +: 7];
            3'd4:    points_of = all[BITS*4 +: 7];
            default: points_of = all[BITS*5 +: 7];
        endcase
    endfunction
    /* verilator lint_on UNUSEDSIGNAL */

    logic is_last_side, runs_along_v, backward;
    assign is_last_side = side == (is_quad ? 2'd3 : 2'd2);
    assign runs_along_v = !side[0];
    assign backward     = side == 2'd0 || is_last_side; // the walk of this edge begins at the far end

    // The first position, the constant position across the edge, and whether placer A has the position that runs.
    logic [6:0] start, across, n_outer;
    logic       a_runs, is_backward;
    assign n_outer = points_of(contexts, {1'b0, side});
    always_comb begin
        start       = 7'd0;
        across      = {1'b0, ring};
        a_runs      = 1'b1;
        is_backward = 1'b0;
        unique case (at)
            AT_OUTER: begin
                start       = backward ? n_outer - 7'd1 : 7'd0;
                is_backward = backward;
            end
            AT_RING: begin
                is_backward = backward;
                if (!is_quad || runs_along_v) begin
                    a_runs = 1'b0;
                    start  = backward ? end_v : {1'b0, ring};
                    if (is_quad && side[1]) begin
                        across = end_u;
                    end
                end else begin
                    start = backward ? end_u : {1'b0, ring};
                    if (side[1]) begin
                        across = end_v;
                    end
                end
            end
            AT_CENTRE: begin
                // `ring` is now the number of the row, the middle of the shorter axis.
                a_runs      = row_along_u;
                is_backward = !row_along_u;
                start       = row_along_u ? {1'b0, ring} : end_v;
            end
            default: begin
            end
        endcase
    end

    tess_context_t described_a;
    always_comb begin
        described_a = contexts[BITS*4 +: BITS];
        if (at == AT_OUTER) begin
            unique case (side)
                2'd0:    described_a = contexts[BITS*0 +: BITS];
                2'd1:    described_a = contexts[BITS*1 +: BITS];
                2'd2:    described_a = contexts[BITS*2 +: BITS];
                default: described_a = contexts[BITS*3 +: BITS];
            endcase
        end
    end

    // ---- the next edge -------------------------------------------------------------------------

    logic describes, ends_patch;
    assign ends_patch  = describes && is_last;
    assign start_ready = !active || ends_patch;

    // The registers take the next patch without knowing whether there is one: `ready` comes late, and only their enable waits
    // for it.
    logic loads, steps;
    assign loads = !active || is_last;
    assign steps = !active || describes;

    // No ring follows the innermost one: on the shorter axis its edges would have no points. A row of points at the centre
    // follows if that axis has one left.
    logic       is_innermost, has_centre, last_side_follows;
    logic [6:0] short_rest, long_rest, next_outer;
    assign short_rest   = row_along_u ? rest_v : rest_u;
    assign long_rest    = row_along_u ? rest_u : rest_v;
    assign is_innermost = short_rest[6:1] == 6'd0;
    assign has_centre   = short_rest[0];
    assign next_outer   = points_of(contexts, {1'b0, side + 2'd1}) - 7'd2;
    assign last_side_follows = side == (is_quad ? 2'd2 : 2'd1);

    // The first edge of a patch, and the one after this. They are selected by gates instead of conditions, from which synthesis
    // would make enables and resets of single registers, which come later than `steps`.
    logic       ends_line, ends_ring, shrinks, start_last, next_last;
    logic [1:0] next_side;
    logic [2:0] start_at, next_at;
    logic [6:0] start_u, start_v, start_further, next_further;
    assign ends_line = at == AT_LINE;
    assign ends_ring = is_last_side;
    assign shrinks   = (at == AT_OUTER || at == AT_RING) && is_last_side;
    assign start_u   = points_of(start_contexts, 3'd4);
    assign start_v   = points_of(start_contexts, 3'd5);
    assign next_side = (ends_line || ends_ring) ? 2'd0 : side + 2'd1;
    always_comb begin
        start_at      = AT_OUTER;
        start_last    = 1'b0;
        start_further = points_of(start_contexts, 3'd0) - 7'd2;
        if (start_patch.domain == tess_pkg::ISOLINE) begin
            start_at      = AT_LINE;
            start_last    = start_v == 7'd2;
            start_further = start_u - 7'd1;
        end else if (start_patch.minimum) begin
            start_at      = AT_CORNER;
            start_further = 7'd0;
        end
        next_at      = at;
        next_further = further;
        if (at == AT_OUTER) begin
            next_further = next_outer;
        end
        if (at == AT_RING) begin
            next_further = runs_along_v ? rest_u : rest_v;
        end
        if (shrinks) begin
            next_at      = is_innermost ? AT_CENTRE : AT_RING;
            next_further = is_innermost ? long_rest - 7'd1 : rest_v - 7'd2;
        end
        unique case (at)
            AT_LINE:   next_last = {1'b0, ring} + 7'd1 == rest_v; // lines, less one
            AT_CORNER: next_last = last_side_follows;
            default:   next_last = is_innermost && (is_last_side || (last_side_follows && !has_centre));
        endcase
    end

    always_ff @(posedge clk) begin
        if (rst) begin
            active <= 1'b0;
        end else if (start_valid && start_ready) begin
            active <= start_patch.points != 13'd0;
        end else if (ends_patch) begin
            active <= 1'b0;
        end

        if (start_ready) begin
            is_quad     <= start_patch.domain == tess_pkg::QUAD;
            contexts    <= start_contexts;
            row_along_u <= start_u > start_v;
        end
        if (steps) begin
            at      <= ({3{loads}} & start_at)     | ({3{!loads}} & next_at);
            is_last <= (loads & start_last)        | (!loads & next_last);
            further <= ({7{loads}} & start_further) | ({7{!loads}} & next_further);
            side    <= {2{!loads}} & next_side;
            ring    <= {6{!loads}} & (ring + 6'(ends_line || ends_ring));
            end_u   <= ({7{loads}} & (start_u - 7'd1)) | ({7{!loads}} & (end_u - 7'(shrinks)));
            end_v   <= ({7{loads}} & (start_v - 7'd1)) | ({7{!loads}} & (end_v - 7'(shrinks)));
            rest_u  <= ({7{loads}} & (start_u - 7'd2)) | ({7{!loads}} & (rest_u - {5'd0, shrinks, 1'b0}));
            rest_v  <= ({7{loads}} & (start_v - 7'd2)) | ({7{!loads}} & (rest_v - {5'd0, shrinks, 1'b0}));
        end
    end

    // ---- the edge ahead ------------------------------------------------------------------------

    typedef struct packed {
        logic       last;     // of the patch
        logic       is_quad;
        logic [2:0] at;
        logic [1:0] side;
        logic       backward;
        logic       a_runs;
        logic [6:0] across;
    } edge_t;
    logic          ahead_valid, takes;
    edge_t         ahead, here;
    logic [6:0]    ahead_start, ahead_further;
    tess_context_t ahead_a, ahead_b;
    assign describes = active && (!ahead_valid || takes);

    always_ff @(posedge clk) begin
        if (rst) begin
            ahead_valid <= 1'b0;
        end else if (describes) begin
            ahead_valid <= 1'b1;
        end else if (takes) begin
            ahead_valid <= 1'b0;
        end

        if (describes) begin
            ahead         <= {is_last, is_quad, at, side, is_backward, a_runs, across};
            ahead_start   <= start;
            ahead_further <= further;
            ahead_a       <= described_a;
            ahead_b       <= contexts[BITS*5 +: BITS];
        end
    end

    // ---- the walk ------------------------------------------------------------------------------

    localparam int LOG = $clog2(POINTS);
    localparam logic [6:0] STEP = 7'(POINTS);
    logic          walks;    // there is a point
    logic [6:0]    along;
    logic [6:0]    to_come;  // points of this edge after this one
    logic          ends_edge; // no point of this edge follows those of this step; 1 if there is no point
    tess_context_t a_context, b_context;
    assign takes = advance && ahead_valid && ends_edge;

    always_ff @(posedge clk) begin
        if (rst) begin
            walks     <= 1'b0;
            ends_edge <= 1'b1;
        end else if (takes) begin
            walks     <= 1'b1;
            ends_edge <= ahead_further[6:LOG] == '0;
        end else if (advance && ends_edge) begin
            walks     <= 1'b0;
        end else if (advance) begin
            ends_edge <= to_come[6:LOG+1] == '0;
        end

        if (takes) begin
            here      <= ahead;
            along     <= ahead_start;
            to_come   <= ahead_further;
            a_context <= ahead_a;
            b_context <= ahead_b;
        end else if (advance) begin
            along     <= here.backward ? along - STEP : along + STEP;
            to_come   <= to_come - STEP;
        end
    end

    logic [6:0] a_p, b_p;
    assign a_p = here.a_runs ? along : here.across;
    assign b_p = here.a_runs ? here.across : along;

    // ---- the location --------------------------------------------------------------------------

    localparam int PLACING = 6, COMBINING = 4; // clocks
    localparam int BEHIND = PLACING + COMBINING - 1;
    logic [16:0] a, b;
    tess_place place_a (.clk, .advance, .in_context(a_context), .in_p(a_p), .location(a));
    tess_place place_b (.clk, .advance, .in_context(b_context), .in_p(b_p), .location(b));

    logic       quad_there;
    logic [2:0] at_there;
    logic [1:0] side_there;
    tess_delay #(.WIDTH(1 + 3 + 2), .CLOCKS(PLACING)) beside (
        .clk, .advance, .in({here.is_quad, here.at, here.side}), .out({quad_there, at_there, side_there}));
    tess_combine combine (
        .clk, .advance, .is_quad(quad_there), .at(at_there), .side(side_there), .in_a(a), .in_b(b),
        .u(out_u[16:0]), .v(out_v[16:0]));

    logic [BEHIND-1:0] valids, lasts; // of the points after the walk, the newest in the lowest bit
    always_ff @(posedge clk) begin
        if (rst) begin
            valids    <= '0;
            out_valid <= 1'b0;
        end else if (advance) begin
            {out_valid, valids} <= {valids, walks};
        end
        if (advance) begin
            {out_last, lasts} <= {lasts, here.last && ends_edge};
        end
    end

    // ---- the lanes after the first -------------------------------------------------------------

    assign out_keep[0] = 1'b1;
    if (POINTS > 1) begin : g_lanes
        localparam int MORE = POINTS - 1;
        tess_context_t                    run_context;
        logic                             a_runs_there;
        logic [MORE-1:0]                  keep;
        logic [MORE*(PLACING+COMBINING)-1:0] keeps; // after the walk, the newest in the lowest bits
        always_ff @(posedge clk) begin
            if (takes) begin
                run_context <= ahead.a_runs ? ahead_a : ahead_b;
            end
            if (advance) begin
                keeps <= {keeps[MORE*BEHIND-1:0], keep};
            end
        end
        tess_delay #(.WIDTH(1), .CLOCKS(PLACING)) runs (.clk, .advance, .in(here.a_runs), .out(a_runs_there));
        assign out_keep[POINTS-1:1] = keeps[MORE*BEHIND +: MORE];
        for (genvar k = 1; k < POINTS; k++) begin : g_lane
            logic [6:0] p;
            assign keep[k-1] = !ends_edge || to_come[LOG-1:0] >= LOG'(k);
            always_ff @(posedge clk) begin
                if (takes) begin
                    p <= ahead.backward ? ahead_start - 7'(k) : ahead_start + 7'(k);
                end else if (advance) begin
                    p <= here.backward ? p - STEP : p + STEP;
                end
            end
            tess_lane lane (
                .clk, .advance, .in_context(run_context), .in_p(p),
                .a_runs(a_runs_there), .in_a(a), .in_b(b), .is_quad(quad_there), .at(at_there), .side(side_there),
                .u(out_u[17*k +: 17]), .v(out_v[17*k +: 17]));
        end
    end
endmodule
