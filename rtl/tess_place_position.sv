// Mirrors a point onto the first half of its edge and finds its place in the coarser and the finer
// subdivision (specification, section 5, first half). In: p < points.
//
// Combinational. With REGISTERED it takes three clocks (mirror, choose, multiply); the register of the last is the caller's.
module tess_place_position #(
    parameter bit REGISTERED = 1'b0
) (
    input  logic        clk,      // with REGISTERED
    input  logic        advance,
    input  logic [16:0] inv_floor,
    input  logic [16:0] inv_ceil,
    input  logic [5:0]  half_points,
    input  logic [5:0]  split,
    input  logic        odd,
    input  logic [6:0]  p,
    output logic        flip,     // the point is on the second half
    output logic        middle,   // the point is the exact middle of an even edge
    output logic [5:0]  position, // 0..32
    output logic [16:0] coarse,   // at most HALF + 10, 16 fraction bits; 0 in the middle
    output logic [16:0] fine      // at most HALF + 10, 16 fraction bits; 0 in the middle
);
    localparam int CLOCKS = REGISTERED ? 1 : 0; // of each step

    // ---- mirror --------------------------------------------------------------------------------

    logic       flip_next;
    logic [5:0] mirrored, position_next;
    always_comb begin
        flip_next     = p >= {1'b0, half_points};
        mirrored      = 6'({half_points, 1'b0} - p - {6'd0, odd});
        position_next = flip_next ? mirrored : p[5:0];
    end

    // ---- choose --------------------------------------------------------------------------------

    logic [5:0] chosen, chosen_half, chosen_split;
    tess_delay #(.WIDTH(3 * 6), .CLOCKS(CLOCKS)) at_choose (
        .clk, .advance,
        .in ({position_next, half_points, split}),
        .out({chosen, chosen_half, chosen_split})
    );
    logic       middle_next;
    logic [5:0] coarse_next, fine_next; // positions
    always_comb begin
        middle_next = chosen == chosen_half;
        coarse_next = (chosen > chosen_split) ? chosen - 6'd1 : chosen;
        fine_next   = chosen;
        if (middle_next) begin
            coarse_next = 6'd0;
            fine_next   = 6'd0;
        end
    end

    // ---- multiply ------------------------------------------------------------------------------

    logic [5:0]  coarse_position, fine_position;
    logic [16:0] coarse_unit, fine_unit;
    tess_delay #(.WIDTH(1 + 3 * 6), .CLOCKS(CLOCKS)) at_multiply (
        .clk, .advance,
        .in ({middle_next, coarse_next, fine_next, chosen}),
        .out({middle, coarse_position, fine_position, position})
    );
    tess_delay #(.WIDTH(2 * 17 + 1), .CLOCKS(2 * CLOCKS)) inverses (
        .clk, .advance,
        .in ({inv_floor, inv_ceil, flip_next}),
        .out({coarse_unit, fine_unit, flip})
    );
    assign coarse = 17'(coarse_position) * coarse_unit;
    assign fine   = 17'(fine_position) * fine_unit;
endmodule
