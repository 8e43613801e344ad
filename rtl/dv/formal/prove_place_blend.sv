// tess_place_blend equals the second half of the formula of section 5, computed here in 64 bits, for every input in
// range: the widths of section 14.1 suffice. Proved for all inputs at once.
module prove_place_blend (
    input logic        clk, advance,
    input logic [15:0] fraction,
    input logic        flip, middle,
    input logic [16:0] coarse, fine
);
    logic [16:0] half_location, location;
    tess_place_blend place_blend (.*);

    logic [63:0] sum, half, whole;
    always_comb begin
        sum = 64'(coarse) * (64'h1_0000 - fraction) + 64'(fine) * fraction + 64'h8000;
        half = middle ? 64'h8000 : sum >> 16;
        whole = flip ? 64'h1_0000 - half : half;

        // Section 14.1: what the position gives.
        assume (coarse <= 17'h0_800A && fine <= 17'h0_800A);

        assert (half_location == half && location == whole);
        assert (whole <= 64'h1_0000);
    end
endmodule
