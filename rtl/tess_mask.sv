// The positions of a half edge that have a point. Bit k - 1 is set if position k has one, that is, if its number in the
// split order is below the half steps (specification, sections 7.2 and 14.3). Combinational.
module tess_mask (
    input  logic [5:0]  half,   // half steps, 0..32: half_points, or one less if odd
    input  logic        center, // split order: 0 ruler, 1 center
    output logic [31:0] mask
);
    // The number of each position in ruler order, position 32 first. Numbers begin with 1; center order has 1, 2, ..
    localparam logic [32*6-1:0] RULER = {
        6'd31, 6'd15, 6'd30, 6'd7, 6'd29, 6'd14, 6'd28, 6'd3,
        6'd27, 6'd13, 6'd26, 6'd6, 6'd25, 6'd12, 6'd24, 6'd1,
        6'd23, 6'd11, 6'd22, 6'd5, 6'd21, 6'd10, 6'd20, 6'd2,
        6'd19, 6'd9, 6'd18, 6'd4, 6'd17, 6'd8, 6'd16, 6'd32
    };
    for (genvar i = 0; i < 32; i++) begin : g_position
        assign mask[i] = center ? half > 6'(i + 1) : half > RULER[6*i +: 6];
    end
endmodule
