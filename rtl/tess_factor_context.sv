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
    localparam logic [22:0] HALF = 23'h00_8000;

    // ---- half ----------------------------------------------------------------------------------

    logic [22:0] rounded_half, half_next, half;
    always_comb begin
        rounded_half = (factor + 23'd1) >> 1;
        half_next = rounded_half + ((odd || factor == ONE) ? HALF : 23'd0);
    end
    tess_delay #(.WIDTH(23), .CLOCKS(CLOCKS)) at_points (.clk, .advance, .in(half_next), .out(half));

    // ---- points --------------------------------------------------------------------------------

    logic       odd_here, is_odd, is_center, has_fraction;
    logic [6:0] floor_points, ceil_points;
    logic [6:0] floor_before, ceil_before; // one less if odd
    tess_delay #(.WIDTH(1), .CLOCKS(CLOCKS)) parity_here (.clk, .advance, .in(odd), .out(odd_here));
    assign has_fraction = half[15:0] != 16'd0;
    logic [6:0] less_odd;
    assign less_odd = half[22:16] - {6'd0, odd_here};
    tess_delay #(.WIDTH(23 + 3 * 7), .CLOCKS(CLOCKS)) at_rest (
        .clk, .advance,
        .in ({half, half[22:16] + 7'(has_fraction), less_odd, less_odd + 7'(has_fraction)}),
        .out({floor_points, fraction, ceil_points, floor_before, ceil_before})
    );
    tess_delay #(.WIDTH(1), .CLOCKS(CLOCKS)) parity (.clk, .advance, .in(odd_here), .out(is_odd));
    tess_delay #(.WIDTH(1), .CLOCKS(2 * CLOCKS)) order (.clk, .advance, .in(center), .out(is_center));

    // ---- the rest ------------------------------------------------------------------------------

    function automatic logic [6:0] drop_msb(input logic [6:0] x);
        drop_msb = x;
        for (int i = 0; i < 7; i++) begin
            if (x[i]) begin // the highest set bit is assigned last
                drop_msb = x & ~(7'd1 << i);
            end
        end
    endfunction

    logic [6:0] odd_top, even_top; // the points of the floor without their highest bit
    assign odd_top  = drop_msb(floor_before);
    assign even_top = drop_msb(floor_points);
    always_comb begin
        half_points = ceil_points[5:0];
        points      = {ceil_points[5:0], !is_odd}; // section 14.1
        if (floor_points == ceil_points) begin // no position splits
            split = 6'(ceil_points + 7'd1);
        end else if (is_center) begin
            split = 6'(ceil_before - 7'd1);
        end else if (is_odd && floor_points == 7'd1) begin
            split = 6'd0;
        end else if (is_odd) begin
            split = 6'((odd_top << 1) + 7'd1);
        end else begin
            split = 6'((even_top << 1) + 7'd1);
        end
    end

    tess_reciprocal floor_reciprocal (
        .n    ({floor_before[5:0], is_odd}),
        .value(inv_floor)
    );
    tess_reciprocal ceil_reciprocal (
        .n    ({ceil_before[5:0], is_odd}),
        .value(inv_ceil)
    );
endmodule
