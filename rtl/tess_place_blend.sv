// Blends the two places by the factor's fraction, rounds, and mirrors back
// (specification, section 5, second half).
//
// Combinational. With REGISTERED it takes three clocks (multiply, add, mirror); the register of the last is the caller's.
module tess_place_blend #(
    parameter bit REGISTERED = 1'b0
) (
    input  logic        clk,           // with REGISTERED
    input  logic        advance,
    input  logic [15:0] fraction,
    input  logic        flip,
    input  logic        middle,
    input  logic [16:0] coarse,
    input  logic [16:0] fine,
    output logic [16:0] half_location, // at most HALF + 10, 16 fraction bits
    output logic [16:0] location       // 0..ONE, 16 fraction bits
);
    localparam int CLOCKS = REGISTERED ? 1 : 0; // of each step
    localparam logic [16:0] ONE  = 17'h1_0000;
    localparam logic [16:0] HALF = 17'h0_8000;

    // ---- multiply ------------------------------------------------------------------------------

    // The weight of `coarse` is ONE - fraction = ~fraction + 1, so it is multiplied by ~fraction and added once.
    logic [32:0] coarse_next, fine_next;
    logic [16:0] once_next;
    assign coarse_next = 33'(coarse) * 33'(16'(~fraction));
    assign fine_next   = 33'(fine) * 33'(fraction);
    assign once_next   = coarse + HALF;

    // ---- add -----------------------------------------------------------------------------------

    // Below 2^32, because the weights add up to ONE and both places are at most HALF + 10.
    logic [32:0] coarse_part, fine_part;
    /* verilator lint_off UNUSEDSIGNAL */ // the bits that are rounded away
    logic [32:0] sum;
    /* verilator lint_on UNUSEDSIGNAL */
    logic [16:0] once, half_next;
    logic        is_middle, flips, is_flipped;
    tess_delay #(.WIDTH(2 * 33 + 17 + 2), .CLOCKS(CLOCKS)) at_add (
        .clk, .advance,
        .in ({coarse_next, fine_next, once_next, middle, flip}),
        .out({coarse_part, fine_part, once, is_middle, flips})
    );
    assign sum       = coarse_part + fine_part + 33'(once);
    assign half_next = is_middle ? HALF : sum[32:16];

    // ---- mirror --------------------------------------------------------------------------------

    tess_delay #(.WIDTH(17 + 1), .CLOCKS(CLOCKS)) at_mirror (
        .clk, .advance, .in({half_next, flips}), .out({half_location, is_flipped}));
    assign location = is_flipped ? ONE - half_location : half_location;
endmodule
