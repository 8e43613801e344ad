// Mirrors a point onto the first half of its edge and finds its place in the coarser and the finer
// subdivision (specification, section 5, first half). Combinational. In: p < points.
module tess_place_position (
    input  logic [16:0] inv_floor,
    input  logic [16:0] inv_ceil,
    input  logic [5:0]  half_points,
    input  logic [5:0]  split,
    input  logic        odd,
    input  logic [6:0]  p,
    output logic        flip,     // the point lies on the second half
    output logic        middle,   // the point is the exact middle of an even edge
    output logic [5:0]  position, // 0..32
    output logic [16:0] coarse,   // at most HALF + 10, 16 fraction bits; 0 in the middle
    output logic [16:0] fine      // at most HALF + 10, 16 fraction bits; 0 in the middle
);
    logic [5:0] mirrored;
    logic [5:0] coarse_position;

    always_comb begin
        flip     = p >= {1'b0, half_points};
        mirrored = 6'({half_points, 1'b0} - p - {6'd0, odd});
        position = flip ? mirrored : p[5:0];
        middle   = position == half_points;

        coarse_position = (position > split) ? position - 6'd1 : position;
        coarse = middle ? 17'd0 : 17'(coarse_position) * inv_floor;
        fine   = middle ? 17'd0 : 17'(position) * inv_ceil;
    end
endmodule
