// The next step of a stitch: which row advances, and which row the triangle's first vertex lies on
// (specification, sections 7.2 to 7.4; 14.3 for the masks). Combinational.
//
// A transition walks two half edges in split order. A mask for each row has a bit for every position that has a
// point, so the next step is the lowest set bit of both masks; on the way back it is the highest.
module tess_stitch (
    input  logic [1:0]  kind,         // of tess_pkg
    input  logic [6:0]  outer_at,     // entries that the stitch has come to
    input  logic [6:0]  inner_at,
    input  logic [6:0]  inner_points, // points on the inner row
    input  logic        outer_odd,    // transition: parities of the two factors
    input  logic        inside_odd,
    input  logic        outer_empty,  // transition: the outer half edge has no steps
    input  logic [31:0] outer_all,    // transition: the masks of the half edges, bit k - 1 for position k
    input  logic [31:0] inner_all,
    input  logic [31:0] outer_left,   // transition: what is left of them on this way
    input  logic [31:0] inner_left,
    input  logic [3:0]  done,         // transition: first step, middle inner, middle outer, on the way back

    output logic        advances_outer,
    output logic        begins_outer,
    output logic [31:0] outer_left_next,
    output logic [31:0] inner_left_next,
    output logic [3:0]  done_next
);
    localparam logic [1:0] TRANSITION = tess_pkg::TRANSITION;
    localparam logic [1:0] RING       = tess_pkg::RING;
    localparam logic [1:0] STRIP      = tess_pkg::STRIP;

    localparam int FIRST = 0, MIDDLE_INNER = 1, MIDDLE_OUTER = 2, BACK = 3;

    logic [31:0] outer_back, inner_back, out_bit, back_bit;
    always_comb begin
        outer_back = done[BACK] ? outer_left : outer_all;
        inner_back = done[BACK] ? inner_left : inner_all;
        out_bit  = lowest(outer_left | inner_left);
        back_bit = highest(outer_back | inner_back);
    end

    function automatic logic [31:0] lowest(input logic [31:0] x);
        lowest = x & (~x + 32'd1);
    endfunction

    function automatic logic [31:0] highest(input logic [31:0] x);
        highest = 32'd0;
        for (int i = 0; i < 32; i++) begin
            if (x[i]) highest = 32'd1 << i;
        end
    endfunction

    // Ring stitches and strips: steps come in pairs. A ring stitch has one step of the outer row before its pairs,
    // and one behind them.
    logic [6:0] step, pair;
    logic       is_second, is_before_middle, is_end, is_middle_quad;
    always_comb begin
        step = outer_at + inner_at;
        pair = ((kind == RING) ? step - 7'd1 : step) >> 1;
        is_second        = step[0] != (kind == RING);
        is_before_middle = pair < (inner_points >> 1);
        is_end           = step == 7'd0 || step == 7'({inner_points, 1'b0} - 8'd1);
        is_middle_quad   = pair == (inner_points - 7'd1) >> 1;
    end

    always_comb begin
        advances_outer  = 1'b1;
        begins_outer    = 1'b1;
        outer_left_next = outer_left;
        inner_left_next = inner_left;
        done_next       = done;
        if (kind == TRANSITION) begin
            if (!done[FIRST] && !outer_empty) begin
                done_next[FIRST] = 1'b1;
            end else if (!done[BACK] && (outer_left | inner_left) != 32'd0) begin
                // At one position the inner row comes first.
                advances_outer = (inner_left & out_bit) == 32'd0;
                begins_outer   = advances_outer;
                if (advances_outer) outer_left_next = outer_left & ~out_bit;
                else                inner_left_next = inner_left & ~out_bit;
            end else if (!done[MIDDLE_INNER] && inside_odd) begin
                advances_outer = 1'b0;
                begins_outer   = 1'b0;
                done_next[MIDDLE_INNER] = 1'b1;
            end else if (!done[MIDDLE_OUTER] && outer_odd) begin
                begins_outer = 1'b0;
                done_next[MIDDLE_OUTER] = 1'b1;
            end else if ((outer_back | inner_back) != 32'd0) begin
                // On the way back the outer row comes first.
                advances_outer = (outer_back & back_bit) != 32'd0;
                begins_outer   = advances_outer;
                outer_left_next = advances_outer ? outer_back & ~back_bit : outer_back;
                inner_left_next = advances_outer ? inner_back : inner_back & ~back_bit;
                done_next[BACK] = 1'b1;
            end
            // Otherwise the last step, on the outer row.
        end else if (kind == RING) begin
            // Diagonals are mirrored about the middle.
            if (!is_end) begin
                advances_outer = is_second == is_before_middle;
                begins_outer   = is_before_middle;
            end
        end else if (kind == STRIP) begin
            advances_outer = !is_second;
            begins_outer   = 1'b0;
        end else begin
            // All diagonals forward but one.
            advances_outer = is_second == is_middle_quad;
            begins_outer   = is_middle_quad ? 1'b1 : !is_second;
        end
    end
endmodule
