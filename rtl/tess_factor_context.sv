// The context of a factor: six numbers, computed once per factor (specification, sections 4 and 10).
// In: 15.16 factor, 1..63 if odd, 1 or 2..64 if even.
//
// Combinational. With REGISTERED it takes three clocks (half, points, the rest); the register of the last is the caller's.
module tess_factor_context #(
    parameter bit REGISTERED = 1'b0
) (
    input  logic        clk,         // with REGISTERED
    input  logic        advance,
    input  logic [22:0] factor,
    input  logic        odd,
    input  logic        center,      // split order: 0 ruler, 1 center
    output logic [16:0] inv_floor,   // 16 fraction bits
    output logic [16:0] inv_ceil,    // 16 fraction bits
    output logic [15:0] fraction,    // 16 fraction bits
    output logic [5:0]  half_points, // 1..32
    output logic [5:0]  split,       // 0..33
    output logic [6:0]  points       // 2..65
);
    localparam int CLOCKS = REGISTERED ? 1 : 0; // of each step
    localparam logic [22:0] ONE  = 23'h01_0000;
    localparam logic [21:0] HALF = 22'h00_8000;

    // ---- half ----------------------------------------------------------------------------------

    logic [21:0] rounded_half, half_next, half;
    always_comb begin
        rounded_half = 22'((factor + 23'd1) >> 1);
        half_next    = rounded_half + ((odd || factor == ONE) ? HALF : 22'd0);
    end
    tess_delay #(.WIDTH(22), .CLOCKS(CLOCKS)) at_points (.clk, .advance, .in(half_next), .out(half));

    // ---- points --------------------------------------------------------------------------------

    logic       odd_here, is_odd, is_center, has_fraction, splits;
    logic [5:0] floor_points, ceil_points, points_after; // points_after: the floor and one more
    logic [5:0] less_odd, floor_before, ceil_before;     // points, one less if odd
    tess_delay #(.WIDTH(1), .CLOCKS(CLOCKS)) parity_here (.clk, .advance, .in(odd), .out(odd_here));
    assign has_fraction = half[15:0] != 16'd0;
    assign floor_points = half[21:16];
    assign less_odd     = floor_points - {5'd0, odd_here};
    tess_delay #(.WIDTH(16 + 4 * 6), .CLOCKS(CLOCKS)) at_rest (
        .clk, .advance,
        .in ({half[15:0], floor_points + 6'd1, floor_points + 6'(has_fraction), less_odd, less_odd + 6'(has_fraction)}),
        .out({fraction, points_after, ceil_points, floor_before, ceil_before})
    );
    tess_delay #(.WIDTH(2), .CLOCKS(CLOCKS)) parity (.clk, .advance, .in({odd_here, has_fraction}), .out({is_odd, splits}));
    tess_delay #(.WIDTH(1), .CLOCKS(2 * CLOCKS)) order (.clk, .advance, .in(center), .out(is_center));

    // ---- the rest ------------------------------------------------------------------------------

    function automatic logic [4:0] drop_msb(input logic [5:0] x);
        drop_msb = 5'd0;
        for (int i = 1; i < 6; i++) begin
            if (x[i]) begin // the highest set bit is assigned last
                drop_msb = x[4:0] & ~(5'h1F << i);
            end
        end
    endfunction

    always_comb begin
        half_points = ceil_points;
        points      = {ceil_points, !is_odd}; // section 14.1
        if (!splits) begin
            split = points_after;
        end else if (is_center) begin
            split = floor_before; // the ceiling is one more
        end else begin
            split = {drop_msb(floor_before), floor_before != 6'd0}; // 0 if the floor is 1 and odd
        end
    end

    tess_reciprocal floor_reciprocal (
        .n    ({floor_before, is_odd}),
        .value(inv_floor)
    );
    tess_reciprocal ceil_reciprocal (
        .n    ({ceil_before, is_odd}),
        .value(inv_ceil)
    );
endmodule
