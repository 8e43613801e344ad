// The context of a factor: six numbers, computed once per factor (specification, sections 4 and 10).
// Combinational. In: 15.16 factor, 1..63 if odd, 1 or 2..64 if even.
module tess_factor_context (
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
    localparam logic [22:0] HALF = 23'h00_8000;

    logic [22:0] rounded_half;
    logic [22:0] half;
    logic [6:0]  floor_points;
    logic [6:0]  ceil_points;
    logic [6:0]  edge_points;
    logic [22:0] edge_half;
    logic [6:0]  odd_top, even_top; // the points of the floor without their highest bit

    // The integer part of a 7.16 number, after rounding up.
    function automatic logic [6:0] ceil_int(input logic [22:0] x);
        ceil_int = x[22:16] + 7'(|x[15:0]);
    endfunction

    function automatic logic [6:0] drop_msb(input logic [6:0] x);
        drop_msb = x;
        for (int i = 0; i < 7; i++) begin
            if (x[i]) drop_msb = x & ~(7'd1 << i); // the highest bit comes last
        end
    endfunction

    always_comb begin
        rounded_half = (factor + 23'd1) >> 1;
        half = rounded_half;
        if (odd || rounded_half == HALF) half = rounded_half + HALF; // HALF: even factor 1

        floor_points = half[22:16];
        ceil_points  = ceil_int(half);
        fraction     = half[15:0];
        half_points  = ceil_points[5:0];
        edge_half    = odd ? rounded_half + HALF : rounded_half;
        edge_points  = ceil_int(edge_half);
        points       = odd ? edge_points << 1 : (edge_points << 1) + 7'd1;
    end

    assign odd_top  = drop_msb(floor_points - 7'd1);
    assign even_top = drop_msb(floor_points);
    always_comb begin
        if (floor_points == ceil_points)      split = 6'(ceil_points + 7'd1); // no point reaches it
        else if (center)                      split = 6'(ceil_points - (odd ? 7'd2 : 7'd1));
        else if (odd && floor_points == 7'd1) split = 6'd0;
        else if (odd)                         split = 6'((odd_top << 1) + 7'd1);
        else                                  split = 6'((even_top << 1) + 7'd1);
    end

    tess_reciprocal floor_reciprocal (
        .n    ((floor_points << 1) - {6'd0, odd}),
        .value(inv_floor)
    );
    tess_reciprocal ceil_reciprocal (
        .n    ((ceil_points << 1) - {6'd0, odd}),
        .value(inv_ceil)
    );
endmodule
