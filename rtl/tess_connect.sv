// The primitives of a patch, one per clock, in the specification's order (sections 7 and 8). tess_top starts it with the
// point counts of each patch; it does not need locations.
//
// The walk goes ring by ring and edge by edge; each edge is a stitch between two rows. The front half describes a stitch in
// two clocks, `edge_` and `ahead`, and continues into the next patch. tess_stitch walks `ahead`, and tess_rows has the
// indices.
//
//   counts   | 5       | 4        | 3     | 2     | 1     | 0     |   seven bits each: points of a factor
//   quad     | in v    | in u     | v = 1 | u = 1 | v = 0 | u = 0 |
//   triangle | in      | in       |       | w = 0 | v = 0 | u = 0 |
//   isoline  | density | detail   |
//
//   at       AT_STITCH  edges 0 .. of ring 1, of ring 2, ..; then AT_MIDDLE: a strip of a quad, or one triangle
//   row      index base + entry; the row of the last edge closes at the first index of edge 0
//
// The quad of docs/tour-cpu.md has the counts 5, 7, 7, 7 outside, 5 and 9 inside:
//
//   ring, edge   outer_base  points      inner_base  points      steps
//   1, 0         0           5           22          9 - 2 = 7   10     bases of the next edge: base + points - 1
//   1, 1         4           7           28          5 - 2 = 3   8
//   1, 3         16          7           36          3           8      rows close at outer_start 0, inner_start 22
//   2, 0         22          7           38          9 - 4 = 5   10
//   2, 2         30          7           42          5           10     walks back: ring 2 is a row, 42 to 38
//
// Invariants:
// - start_patch.primitives is the patch's count, from tess_factors: 0 for a culled patch. It ends a sequence. The stitches of a
//   patch have as many primitives together (section 12.6), so the place of a stitch says whether it is the last one: `is_last`.
// - Indices are below 4225, so they fit 13 bits. A patch has at most 8192 primitives, so 14 bits count them.
// - `described` and `ahead` are exact: the primitives that are described are walked, each once (dv/formal).
// - Registers after `ahead` change only when `advance` is 1, so nothing is lost while out_ready is 0.
`include "tess_types.svh"
module tess_connect (
    input  logic                             clk,
    input  logic                             rst,

    input  logic                             start_valid,
    output logic                             start_ready,
    /* verilator lint_off UNUSEDSIGNAL */ // the number of points is not used
    input  tess_patch_t                      start_patch,
    /* verilator lint_on UNUSEDSIGNAL */
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
    localparam logic [2:0] AT_MIDDLE   = 3'd4; // a strip, or the triangle in the middle of a triangle

    logic advance; // the registers after `ahead` may change
    assign advance = !out_valid || out_ready;

    // ---- the walk of edges ---------------------------------------------------------------------

    logic                             active;
    /* verilator lint_off UNUSEDSIGNAL */ // the number of points is not used
    tess_patch_t                      patch;
    /* verilator lint_on UNUSEDSIGNAL */
    logic [tess_pkg::COUNTS_BITS-1:0] counts;
    logic                             is_first;   // no edge of the patch has been described
    logic [2:0]                       at;
    logic                             is_first_ring;
    logic [1:0]                       side;       // number of the edge
    logic                             is_last;    // no edge of the patch follows
    logic [13:0]                      remaining;  // of a sequence: primitives from this edge on, less one
    logic                             along_u;    // the inner row of this edge, or the strip, runs along u
    logic [6:0]                       m_u, m_v;   // points on the inner rows of this ring, along u and v; m_v: lines that follow
    logic                             strip_along_u;

    function automatic logic [6:0] points_of(input logic [tess_pkg::COUNTS_BITS-1:0] all, input logic [2:0] i);
        unique case (i)
            3'd0:    points_of = all[7*0 +: 7];
            3'd1:    points_of = all[7*1 +: 7];
            3'd2:    points_of = all[7*2 +: 7];
            3'd3:    points_of = all[7*3 +: 7];
            3'd4:    points_of = all[7*4 +: 7];
            default: points_of = all[7*5 +: 7];
        endcase
    endfunction

    logic       is_quad, is_last_side, last_side_follows, is_last_ring;
    logic [6:0] n_outside, m, detail;
    assign is_quad           = patch.domain == tess_pkg::QUAD;
    assign is_last_side      = side == (is_quad ? 2'd3 : 2'd2);
    assign last_side_follows = side == (is_quad ? 2'd2 : 2'd1);
    assign is_last_ring      = m_u <= 7'd2 || m_v <= 7'd2;
    assign n_outside         = points_of(counts, {1'b0, side});
    assign detail            = points_of(counts, 3'd4);
    assign m                 = along_u ? m_u : m_v;

    // K - 1 and M - 1 of section 7.1, whose sum is the number of primitives, also where no stitch is; and the kind of stitch.
    logic [6:0] outer_last_next, inner_last_next, middle_next, offset_next;
    logic [2:0] kind_next;
    logic       walks_back;
    // The inner row is a row of points that is walked back: the parity across the edge is even, and the ring is the last
    // one of that axis.
    assign walks_back = at == AT_STITCH && is_quad && side[1] && (side[0] ? m_v : m_u) == 7'd1;
    always_comb begin
        outer_last_next = 7'd1;
        inner_last_next = m - 7'd1;
        middle_next     = (m >> 1) - 7'd1;
        offset_next     = 7'd2;   // from the outer base to the inner base, except for stitches
        kind_next       = tess_pkg::STRAIGHT;
        unique case (at)
            AT_SEQUENCE: begin
                outer_last_next = is_last ? {1'b0, remaining[5:0]} : 7'd64;
                inner_last_next = {6'd0, is_last};
            end
            AT_LINE: begin
                outer_last_next = detail; // no segment begins at the last point of a line
                inner_last_next = -7'd1;
            end
            AT_MINIMUM: begin
                outer_last_next = is_quad ? 7'd2 : 7'd1;
                inner_last_next = 7'd0;
                offset_next     = is_quad ? 7'd3 : 7'd2; // triangle 0 1 2; quad 0 1 3 and 1 2 3
            end
            AT_STITCH: begin
                outer_last_next = is_first_ring ? n_outside - 7'd1 : m + 7'd1;
                kind_next       = is_first_ring ? tess_pkg::TRANSITION : tess_pkg::RING;
            end
            default: begin
                inner_last_next = 7'd0;
                if (is_quad) begin
                    // Section 7.4: m - 1 quads between two rows of m points.
                    outer_last_next = m - 7'd1;
                    inner_last_next = m - 7'd1;
                    middle_next     = (m - 7'd1) >> 1;
                    offset_next     = {m[5:0], 1'b0} - {6'd0, !strip_along_u};
                    kind_next       = (!strip_along_u && !m_v[0]) ? tess_pkg::STRIP_EXCEPT_MIDDLE : tess_pkg::STRIP;
                end
            end
        endcase
    end

    logic describes, passes, ends_patch; // a stitch goes to edge_; from there to ahead; the patch's last one goes to edge_
    logic edge_valid, ahead_valid, takes; // edge_ holds a stitch; ahead holds one; the walk takes that of ahead
    assign describes   = active && (!edge_valid || passes);
    assign passes      = edge_valid && (!ahead_valid || takes);
    assign ends_patch  = describes && is_last;
    assign start_ready = !active || ends_patch;

    // The registers take the next patch without knowing whether there is one: `ready` comes late, and only their enable waits
    // for it.
    logic loads, steps;
    assign loads = !active || is_last;
    assign steps = !active || describes;

    // The first edge of a patch, and the one after this. They are selected by gates instead of conditions, from which synthesis
    // would make enables and resets of single registers, which come later than `steps`.
    logic        ends_ring, shrinks, start_last, next_last;
    logic [1:0]  next_side;
    logic [2:0]  start_at, next_at;
    logic [6:0]  start_u, start_v;
    logic [13:0] remaining_next;
    assign ends_ring      = at == AT_STITCH && is_last_side;
    assign shrinks        = ends_ring && !is_last_ring;
    assign start_u        = points_of(start_counts, 3'd4);
    assign start_v        = points_of(start_counts, 3'd5);
    assign next_side      = ends_ring ? 2'd0 : side + {1'b0, at == AT_STITCH};
    assign next_at        = (ends_ring && is_last_ring) ? AT_MIDDLE : at;
    assign remaining_next = {remaining[13:6] - 8'd1, remaining[5:0]};
    always_comb begin
        start_at   = AT_STITCH;
        start_last = 1'b0;
        if (start_patch.out == tess_pkg::POINT
                || (start_patch.out == tess_pkg::LINE && start_patch.domain != tess_pkg::ISOLINE)) begin
            start_at   = AT_SEQUENCE;
            start_last = start_patch.primitives <= 14'd64;
        end else if (start_patch.domain == tess_pkg::ISOLINE) begin
            start_at   = AT_LINE;
            start_last = start_v == 7'd2;
        end else if (start_patch.minimum) begin
            start_at   = AT_MINIMUM;
            start_last = 1'b1;
        end
        unique case (at)
            AT_SEQUENCE: next_last = remaining[13:6] == 8'd1;
            AT_LINE:     next_last = m_v == 7'd1;
            default:     next_last = is_last_side ? is_last_ring : last_side_follows && (m_u == 7'd1 || m_v == 7'd1);
        endcase
    end

    always_ff @(posedge clk) begin
        if (rst) begin
            active <= 1'b0;
        end else if (start_valid && start_ready) begin
            active <= start_patch.primitives != 14'd0;
        end else if (ends_patch) begin
            active <= 1'b0;
        end

        if (start_ready) begin
            patch         <= start_patch;
            counts        <= start_counts;
            strip_along_u <= start_u > start_v;
        end
        if (steps) begin
            at            <= ({3{loads}} & start_at) | ({3{!loads}} & next_at);
            is_last       <= (loads & start_last) | (!loads & next_last);
            is_first      <= loads;
            is_first_ring <= loads | (is_first_ring & !ends_ring);
            side          <= {2{!loads}} & next_side;
            along_u       <= !loads & (next_at == AT_MIDDLE ? strip_along_u : next_side[0]);
            remaining     <= ({14{loads}} & (start_patch.primitives - 14'd1)) | ({14{!loads}} & remaining_next);
            m_u           <= ({7{loads}} & (start_u - 7'd2)) | ({7{!loads}} & (m_u - {5'd0, shrinks, 1'b0}));
            m_v           <= ({7{loads}} & (start_v - 7'd2)) | ({7{!loads}} & (m_v - {5'd0, shrinks, at == AT_LINE}));
        end
    end

    // ---- the edge ------------------------------------------------------------------------------

    logic        edge_last, edge_stitch, edge_closes, edge_descends, edge_strip, edge_strip_along_u, edge_center, edge_swaps;
    logic [1:0]  edge_size;
    logic [6:0]  edge_outer_last, edge_inner_last, edge_middle, edge_offset;
    logic [2:0]  edge_kind;
    logic [12:0] outer_base, inner_base;   // first indices of its rows
    logic [12:0] outer_start, inner_start; // and those of edge 0

    logic [1:0] size;
    always_comb begin
        size = 2'd3;
        if (patch.out == tess_pkg::POINT) begin
            size = 2'd1;
        end else if (at == AT_SEQUENCE || at == AT_LINE) begin
            size = 2'd2;
        end
    end

    logic [12:0] outer_after, inner_after;
    assign outer_after = outer_base + {6'd0, edge_outer_last};
    assign inner_after = inner_base + {6'd0, edge_inner_last};

    always_ff @(posedge clk) begin
        if (rst) begin
            edge_valid <= 1'b0;
        end else if (describes) begin
            edge_valid <= 1'b1;
        end else if (passes) begin
            edge_valid <= 1'b0;
        end

        if (describes) begin
            edge_last          <= is_last;
            edge_stitch        <= at == AT_STITCH;
            edge_closes        <= at == AT_STITCH && is_last_side;
            edge_descends      <= at == AT_MIDDLE || walks_back;
            edge_strip         <= at == AT_MIDDLE && is_quad;
            edge_strip_along_u <= at == AT_MIDDLE && is_quad && strip_along_u;
            edge_center        <= patch.center;
            edge_size          <= size;
            edge_swaps         <= size == 2'd3 && patch.out == tess_pkg::TRIANGLE_CCW;
            edge_outer_last    <= outer_last_next;
            edge_inner_last    <= inner_last_next;
            edge_middle        <= middle_next;
            edge_offset        <= offset_next;
            edge_kind          <= kind_next;
        end
        // The last edge of a patch leaves before or when the first one of the next comes.
        if (passes || (is_first && !edge_valid)) begin
            if (is_first) begin
                outer_base  <= 13'd0;
                outer_start <= 13'd0;
                inner_base  <= {4'd0, patch.ring_points};
                inner_start <= {4'd0, patch.ring_points};
            end else begin
                outer_base <= outer_after;
                inner_base <= inner_after;
                if (edge_closes) begin
                    outer_start <= outer_after;
                    inner_start <= inner_after;
                end
            end
        end
    end

    // ---- the stitch ----------------------------------------------------------------------------

    // Half steps of the two factors: half_points, or one less if odd. The inside factor has two points more than the row.
    logic [5:0]  outer_half, inner_half;
    logic [31:0] outer_mask, inner_mask;
    assign outer_half = edge_outer_last[6:1];
    assign inner_half = edge_inner_last[6:1] + 6'd1;
    tess_mask mask_outer (.half(outer_half), .center(edge_center), .mask(outer_mask));
    tess_mask mask_inner (.half(inner_half), .center(edge_center), .mask(inner_mask));

    // Bit 2 p + 1 of `both` is position p of the outer row, bit 2 p that of the inner row. It is a separate vector because
    // Icarus Verilog 11 does not accept a variable index into a member.
    logic [63:0] both_masks;
    always_comb begin
        for (int i = 0; i < 32; i++) begin
            both_masks[2*i]     = inner_mask[i];
            both_masks[2*i + 1] = outer_mask[i];
        end
    end

    tess_stitch_t described, ahead;
    always_comb begin
        described.last      = edge_last;
        described.further   = edge_outer_last + edge_inner_last - 7'd1;
        described.kind      = edge_kind;
        described.has_ends  = outer_half != 6'd0;
        described.has_inner = edge_inner_last[0];
        described.has_outer = edge_outer_last[0];
        described.masked    = outer_half - {5'd0, described.has_ends} + edge_inner_last[6:1];
        if (described.has_ends) begin
            described.begins = tess_pkg::FIRST;
        end else if (edge_inner_last[6:1] != 0) begin
            described.begins = tess_pkg::OUT;
        end else if (described.has_inner) begin
            described.begins = tess_pkg::MIDDLE_INNER;
        end else begin
            described.begins = tess_pkg::MIDDLE_OUTER;
        end
        described.mask      = both_masks;
        described.middle         = edge_middle;
        described.outer_last     = edge_outer_last;
        described.outer_base     = outer_base + {12'd0, edge_strip_along_u};
        described.outer_closes   = edge_closes;
        described.outer_close    = outer_start;
        described.inner_last     = edge_inner_last;
        described.inner_base     = edge_stitch ? inner_base : outer_base + {6'd0, edge_offset};
        described.inner_descends = edge_descends;
        described.inner_closes   = edge_closes && !edge_descends;
        described.inner_opens    = edge_strip_along_u;
        described.inner_close    = edge_strip ? outer_base : inner_start;
        described.size           = edge_size;
        described.swaps          = edge_swaps;
    end

    always_ff @(posedge clk) begin
        if (rst) begin
            ahead_valid <= 1'b0;
        end else if (passes) begin
            ahead_valid <= 1'b1;
        end else if (takes) begin
            ahead_valid <= 1'b0;
        end
        if (passes) begin
            ahead <= described;
        end
    end

    logic         step_valid, step_begins;
    tess_step_t   step;
    tess_stitch_t step_stitch;
    tess_stitch stitch (
        .clk, .rst, .advance, .ahead_valid, .takes, .ahead, .step_valid, .step_begins, .step, .step_stitch);
    tess_rows rows (
        .clk, .rst, .advance, .step_valid, .step_begins, .step, .step_stitch,
        .out_valid, .out_size, .out_i0, .out_i1, .out_i2, .out_last);
endmodule
