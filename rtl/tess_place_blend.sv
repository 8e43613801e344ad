// Blends the two places by the factor's fraction, rounds, and mirrors back
// (specification, section 5, second half). Combinational.
module tess_place_blend (
    input  logic [15:0] fraction,
    input  logic        flip,
    input  logic        middle,
    input  logic [16:0] coarse,
    input  logic [16:0] fine,
    output logic [16:0] half_location, // at most HALF + 10, 16 fraction bits
    output logic [16:0] location       // 0..ONE, 16 fraction bits
);
    localparam logic [16:0] ONE  = 17'h1_0000;
    localparam logic [16:0] HALF = 17'h0_8000;

    logic [16:0] coarse_weight;
    logic [32:0] sum;

    always_comb begin
        // The weights add up to ONE and both places are at most HALF + 10: below 2^32.
        coarse_weight = ONE - {1'b0, fraction};
        sum = 33'(coarse) * 33'(coarse_weight) + 33'(fine) * 33'(fraction);
        sum = sum + 33'(HALF);
        half_location = middle ? HALF : sum[32:16];
        location      = flip ? ONE - half_location : half_location;
    end
endmodule
