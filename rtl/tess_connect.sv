// The primitives of a patch, one a clock, in the specification's order (sections 7 and 8). tess_top starts it with the
// point counts of each patch; locations do not matter here.
//
// The walker goes ring by ring, edge by edge. Within a stitch tess_stitch says which row advances, and tess_rows which
// indices the rows have there. The half edges of a transition are masks, which are looked up when an edge begins.
//
//   counts   | 5     | 4     | 3     | 2     | 1     | 0     |   seven bits each: points of a factor
//   quad     | in v  | in u  | v = 1 | u = 1 | v = 0 | u = 0 |
//   triangle |       |       | in    | w = 0 | v = 0 | u = 0 |
//
//   at       AT_STITCH  edges 0 .. of ring 1, of ring 2, ..; then AT_STRIP (quad) or AT_CENTRE (triangle)
//   row      base + outer_at or inner_at; the row of the last edge closes at edge 0's first index
//
// The quad of docs/tour-cpu.md has the counts 5, 7, 7, 7 outside, 5 and 9 inside:
//
//   ring, edge   outer_base  points      inner_base  points      steps
//   1, 0         0           5           22          9 - 2 = 7   10     bases of the next edge: base + points - 1
//   1, 1         4           7           28          5 - 2 = 3   8
//   1, 3         16          7           36          3           8      rows close at outer_start 0, inner_start 22
//   2, 0         22          7           38          9 - 4 = 5   10
//   2, 2         30          7           42          5           10     walks_back: ring 2 is a row, 42 to 38
//
// What must hold:
// - start_patch.primitives is the patch's count, from tess_factors: it ends the walk, and a culled patch has 0.
// - Indices are below 4225, so 13 bits hold them; a patch has at most 8192 primitives, so 14 bits count them.
// - outer_all and inner_all belong to `side` of this clock, outer_begins and inner_begins to the edge that begins next.
// - Registers of the walk change only where `advance` is 1, so nothing is lost while out_ready is 0 (rtl/dv/formal).
`include "tess_types.svh"
module tess_connect (
    input  logic                             clk,
    input  logic                             rst,

    input  logic                             start_valid,
    output logic                             start_ready,
    input  tess_patch_t                 start_patch,
    input  logic [tess_pkg::COUNTS_BITS-1:0] start_counts, // points of each factor; factor 0 in the lowest bits

    output logic                             out_valid,
    input  logic                             out_ready,
    output logic [1:0]                       out_size,     // indices of the primitive, 1 to 3
    output logic [12:0]                      out_i0,
    output logic [12:0]                      out_i1,
    output logic [12:0]                      out_i2,
    output logic                             out_last
);
    localparam logic [2:0] AT_SEQUENCE = 3'd0; // points; lines that join all points
    localparam logic [2:0] AT_LINE     = 3'd1; // the segments of isolines
    localparam logic [2:0] AT_MINIMUM  = 3'd2;
    localparam logic [2:0] AT_STITCH   = 3'd3;
    localparam logic [2:0] AT_STRIP    = 3'd4;
    localparam logic [2:0] AT_CENTRE   = 3'd5; // the triangle in the middle of a triangle

    logic advance;
    assign advance = !out_valid || out_ready;

    // ---- the walk ------------------------------------------------------------------------------

    logic                             active;
    /* verilator lint_off UNUSEDSIGNAL */ // no stage needs every field
    tess_patch_t                      patch;
    /* verilator lint_on UNUSEDSIGNAL */
    logic [tess_pkg::COUNTS_BITS-1:0] counts;
    logic [2:0]                       at;
    logic [5:0]                       ring;       // the inner ring, from 1
    logic [1:0]                       side;       // number of the edge
    logic [6:0]                       outer_at, inner_at;
    logic [12:0]                      outer_base, inner_base; // first indices of the current rows
    logic [12:0]                      outer_start, inner_start; // and those of edge 0
    logic [31:0]                      outer_left, inner_left;
    logic [3:0]                       done;
    logic [13:0]                      number;     // of the primitive
    logic [12:0]                      index;      // of its first point, where points are joined in order

    function automatic logic [6:0] points_of(input logic [tess_pkg::COUNTS_BITS-1:0] all, input logic [2:0] i);
        // Constant places: an index times 7 would be a multiplier and a shifter.
        case (i)
            3'd0:    points_of = all[0*7 +: 7];
            3'd1:    points_of = all[1*7 +: 7];
            3'd2:    points_of = all[2*7 +: 7];
            3'd3:    points_of = all[3*7 +: 7];
            3'd4:    points_of = all[4*7 +: 7];
            default: points_of = all[5*7 +: 7];
        endcase
    endfunction

    // Along edge `edge_number`, with the outer row an outer edge: the points of the outer factor and of the inside one.
    function automatic logic [6:0] outside_of(input logic [tess_pkg::COUNTS_BITS-1:0] all, input logic [1:0] edge_number);
        outside_of = points_of(all, {1'b0, edge_number});
    endfunction
    function automatic logic [6:0] inside_of(
            input logic [tess_pkg::COUNTS_BITS-1:0] all, input logic quad, input logic runs_along_u);
        inside_of = points_of(all, !quad ? 3'd3 : runs_along_u ? 3'd4 : 3'd5);
    endfunction

    // Half steps: half_points, less one if odd.
    function automatic logic [5:0] half_of(input logic [6:0] points);
        half_of = 6'((points - 7'd1) >> 1);
    endfunction

    logic       is_quad, is_last_side;
    logic [6:0] n_u, n_v, n_outside, n_inside;
    assign is_quad      = patch.domain == tess_pkg::QUAD;
    assign is_last_side = side == (is_quad ? 2'd3 : 2'd2);
    assign n_u          = points_of(counts, is_quad ? 3'd4 : 3'd3);
    assign n_v          = points_of(counts, is_quad ? 3'd5 : 3'd3);
    assign n_outside    = outside_of(counts, side);
    assign n_inside     = inside_of(counts, is_quad, side[0]);

    // One more than the number of rings of each axis.
    logic [5:0] end_u, end_v, rings_end;
    logic       is_first_ring, is_last_ring;
    assign end_u         = 6'((n_u + 7'd1) >> 1);
    assign end_v         = 6'((n_v + 7'd1) >> 1);
    assign rings_end     = (end_u < end_v) ? end_u : end_v;
    assign is_first_ring = ring == 6'd1;
    assign is_last_ring  = ring + 6'd1 == rings_end;

    // ---- the rows ------------------------------------------------------------------------------

    logic [6:0] outer_points, inner_points; // K and M of section 7.1
    logic       walks_back;                 // the inner row is a row of points, walked back
    logic [6:0] strip_quads;
    logic       strip_along_u;
    always_comb begin
        inner_points = n_inside - {ring, 1'b0};
        outer_points = is_first_ring ? n_outside : inner_points + 7'd2;
        // Even parity across the edge (an odd number of points), and the last ring of that axis.
        walks_back = side[1] && (side[0] ? n_v[0] && ring + 6'd1 == end_v
                                         : n_u[0] && ring + 6'd1 == end_u) && is_quad;
        // Section 7.4. A number of points is odd if the parity is even.
        strip_along_u = n_u > n_v;
        strip_quads = strip_along_u ? {n_u[6:1] - n_v[6:1], 1'b0} + (n_u[0] ? 7'd2 : 7'd1)
                                    : {n_v[6:1] - n_u[6:1], 1'b0} + (n_v[0] ? 7'd2 : 7'd1);
        if (at == AT_STRIP) begin
            inner_points = strip_quads + 7'd1;
            outer_points = inner_points;
        end
    end

    logic [12:0] strip_end;
    assign strip_end = outer_base + {5'd0, strip_quads, 1'b0} + (strip_along_u ? 13'd2 : 13'd1);

    logic [12:0] outer_now, outer_next, inner_now, inner_next;
    tess_rows rows (
        .outer_base    ((at == AT_STRIP && strip_along_u) ? outer_base + 13'd1 : outer_base),
        .outer_closes  (at == AT_STITCH && is_last_side),
        .outer_close_at(outer_points - 7'd1),
        .outer_close   (outer_start),
        .outer_at      (outer_at),
        .outer_now     (outer_now),
        .outer_next    (outer_next),
        .inner_base    ((at == AT_STRIP) ? strip_end : inner_base),
        .inner_descends(at == AT_STRIP || walks_back),
        .inner_closes  ((at == AT_STRIP) ? strip_along_u : is_last_side && !walks_back),
        .inner_close_at((at == AT_STRIP) ? 7'd0 : inner_points - 7'd1),
        .inner_close   ((at == AT_STRIP) ? outer_base : inner_start),
        .inner_at      (inner_at),
        .inner_now     (inner_now),
        .inner_next    (inner_next)
    );

    // ---- the masks -----------------------------------------------------------------------------

    // The edge behind this one, whose masks are looked up while this one ends.
    logic [1:0] side_next;
    assign side_next = is_last_side ? 2'd0 : side + 2'd1;
    logic       starts, begins_center, start_is_quad;
    logic [6:0] begins_outside, begins_inside;
    assign starts         = start_valid && start_ready;
    assign start_is_quad  = start_patch.domain == tess_pkg::QUAD;
    assign begins_center  = starts ? start_patch.center : patch.center;
    assign begins_outside = starts ? outside_of(start_counts, 2'd0) : outside_of(counts, side_next);
    assign begins_inside  = starts ? inside_of(start_counts, start_is_quad, 1'b0)
                                   : inside_of(counts, is_quad, side_next[0]);

    // The masks of this edge, and those of the edge that begins behind this clock.
    logic [31:0] outer_all, inner_all, outer_begins, inner_begins;
    tess_mask outer_mask (.points(n_outside), .center(patch.center), .mask(outer_all));
    tess_mask inner_mask (.points(n_inside), .center(patch.center), .mask(inner_all));
    tess_mask outer_begins_mask (.points(begins_outside), .center(begins_center), .mask(outer_begins));
    tess_mask inner_begins_mask (.points(begins_inside), .center(begins_center), .mask(inner_begins));

    // ---- the step ------------------------------------------------------------------------------

    logic [1:0]  kind;
    logic        advances_outer, begins_outer;
    logic [31:0] outer_left_next, inner_left_next;
    logic [3:0]  done_next;
    always_comb begin
        if (at == AT_STITCH) kind = is_first_ring ? tess_pkg::TRANSITION : tess_pkg::RING;
        else kind = (!strip_along_u && !n_v[0]) ? tess_pkg::STRIP_EXCEPT_MIDDLE : tess_pkg::STRIP;
    end
    tess_stitch stitch (
        .kind           (kind),
        .outer_at       (outer_at),
        .inner_at       (inner_at),
        .inner_points   (inner_points),
        .outer_odd      (!n_outside[0]),
        .inside_odd     (!n_inside[0]),
        .outer_empty    (half_of(n_outside) == 6'd0),
        .outer_all      (outer_all),
        .inner_all      (inner_all),
        .outer_left     (outer_left),
        .inner_left     (inner_left),
        .done           (done),
        .advances_outer (advances_outer),
        .begins_outer   (begins_outer),
        .outer_left_next(outer_left_next),
        .inner_left_next(inner_left_next),
        .done_next      (done_next)
    );

    logic [7:0] steps, step_next;
    logic       ends_edge, is_last;
    assign steps     = {1'b0, outer_points} + {1'b0, inner_points} - 8'd2;
    assign step_next = {1'b0, outer_at} + {1'b0, inner_at} + 8'd1;
    assign ends_edge = step_next == steps;
    assign is_last   = number == patch.primitives - 14'd1;

    assign start_ready = advance && (!active || is_last);

    // Where the rows of the next edge begin.
    logic [12:0] outer_after, inner_after;
    assign outer_after = outer_base + {6'd0, outer_points} - 13'd1;
    assign inner_after = inner_base + {6'd0, inner_points} - 13'd1;

    always_ff @(posedge clk) begin
        if (rst) begin
            active <= 1'b0;
        end else if (advance) begin
            if (starts) begin
                active      <= start_patch.primitives != 14'd0;
                patch       <= start_patch;
                counts      <= start_counts;
                number      <= 14'd0;
                index       <= 13'd0;
                ring        <= 6'd1;
                side        <= 2'd0;
                outer_at    <= 7'd0;
                inner_at    <= 7'd0;
                outer_base  <= 13'd0;
                outer_start <= 13'd0;
                inner_base  <= outer_ring(start_counts, start_is_quad);
                inner_start <= outer_ring(start_counts, start_is_quad);
                outer_left  <= outer_begins;
                inner_left  <= inner_begins;
                done        <= 4'd0;
                if (start_patch.out == tess_pkg::POINT)           at <= AT_SEQUENCE;
                else if (start_patch.domain == tess_pkg::ISOLINE) at <= AT_LINE;
                else if (start_patch.out == tess_pkg::LINE)       at <= AT_SEQUENCE;
                else                                              at <= start_patch.minimum ? AT_MINIMUM : AT_STITCH;
            end else if (active) begin
                active <= !is_last;
                number <= number + 14'd1;
                // The last point of a line begins no segment.
                if (at == AT_LINE && outer_at == points_of(counts, 3'd1) - 7'd2) begin
                    index    <= index + 13'd2;
                    outer_at <= 7'd0;
                end else if (at == AT_LINE) begin
                    index    <= index + 13'd1;
                    outer_at <= outer_at + 7'd1;
                end else if (at == AT_SEQUENCE) begin
                    index    <= index + 13'd1;
                end else if (at == AT_STITCH && ends_edge) begin
                    outer_at   <= 7'd0;
                    inner_at   <= 7'd0;
                    side       <= side_next;
                    done       <= 4'd0;
                    outer_left <= outer_begins;
                    inner_left <= inner_begins;
                    outer_base <= outer_after;
                    inner_base <= inner_after;
                    if (is_last_side) begin
                        ring        <= ring + 6'd1;
                        outer_start <= outer_after;
                        inner_start <= inner_after;
                        if (is_last_ring) at <= is_quad ? AT_STRIP : AT_CENTRE;
                    end
                end else begin
                    outer_at   <= outer_at + {6'd0, advances_outer};
                    inner_at   <= inner_at + {6'd0, !advances_outer};
                    outer_left <= outer_left_next;
                    inner_left <= inner_left_next;
                    done       <= done_next;
                end
            end
        end
    end

    // Points on the outer ring: B of section 12.6.
    function automatic logic [12:0] outer_ring(input logic [tess_pkg::COUNTS_BITS-1:0] all, input logic quad);
        outer_ring = 13'(points_of(all, 3'd0)) + 13'(points_of(all, 3'd1)) + 13'(points_of(all, 3'd2)) - 13'd3;
        if (quad) outer_ring = outer_ring + 13'(points_of(all, 3'd3)) - 13'd1;
    endfunction

    // ---- the primitive -------------------------------------------------------------------------

    logic [12:0] i0, i1, i2;
    logic [1:0]  size;
    always_comb begin
        size = 2'd3;
        i0 = outer_base;
        i1 = outer_base + 13'd1;
        i2 = outer_base + 13'd2;
        case (at)
            AT_SEQUENCE, AT_LINE: begin
                size = (patch.out == tess_pkg::POINT) ? 2'd1 : 2'd2;
                i0 = index;
                i1 = (size == 2'd2) ? index + 13'd1 : 13'd0;
                i2 = 13'd0;
            end
            AT_MINIMUM: begin
                // Triangle 0 1 2; quad 0 1 3 and 1 2 3.
                i0 = number[0] ? 13'd1 : 13'd0;
                i1 = number[0] ? 13'd2 : 13'd1;
                i2 = is_quad ? 13'd3 : 13'd2;
            end
            AT_STITCH, AT_STRIP: begin
                i0 = begins_outer ? outer_now : inner_now;
                if (advances_outer) begin
                    i1 = begins_outer ? outer_next : outer_now;
                    i2 = begins_outer ? inner_now : outer_next;
                end else begin
                    i1 = begins_outer ? inner_next : outer_now;
                    i2 = begins_outer ? inner_now : inner_next;
                end
            end
            default: begin
            end
        endcase
    end

    logic swaps;
    assign swaps = size == 2'd3 && patch.out == tess_pkg::TRIANGLE_CCW;

    always_ff @(posedge clk) begin
        if (rst) begin
            out_valid <= 1'b0;
        end else if (advance) begin
            out_valid <= active;
            out_size  <= size;
            out_i0    <= i0;
            out_i1    <= swaps ? i2 : i1;
            out_i2    <= swaps ? i1 : i2;
            out_last  <= is_last;
        end
    end
endmodule
