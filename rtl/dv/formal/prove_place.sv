// tess_place_position equals the first half of the formula of section 5, computed here in 64 bits, for every input in
// range: the widths of section 14.1 suffice. Proved for all inputs at once.
module prove_place_position (
    input logic        clk, advance,
    input logic [16:0] inv_floor, inv_ceil,
    input logic [5:0]  half_points, split,
    input logic        odd,
    input logic [6:0]  p
);
    logic        flip, middle;
    logic [5:0]  position;
    logic [16:0] coarse, fine;
    tess_place_position place_position (.*);

    logic [63:0] q, pf, a, b;
    logic        flips, is_middle;
    always_comb begin
        flips = p >= half_points;
        q = flips ? 64'd2 * half_points - p - odd : 64'(p);
        is_middle = q == half_points;
        pf = (q > split) ? q - 64'd1 : q;
        a = pf * inv_floor;
        b = q * inv_ceil;

        // Section 14.1: the ranges of a context.
        assume (half_points >= 1 && half_points <= 32 && split <= 33);
        assume (inv_floor >= 1024 && inv_floor <= 64'h1_0000 && inv_ceil >= 1024 && inv_ceil <= 64'h1_0000);
        assume (p < (odd ? 64'd2 * half_points : 64'd2 * half_points + 64'd1));
        if (!is_middle) assume (a <= 64'h800A && b <= 64'h8000);

        assert (flip == flips && middle == is_middle);
        assert (position == q);
        assert (middle || (coarse == a && fine == b));
        cover (is_middle);
        cover (flips && !is_middle && q > split);
    end
endmodule

// tess_place_blend equals the second half. The solver is given two facts about products that it would not find: `coarse`
// times (ONE - fraction) is `coarse` times `weight` plus `coarse`; and a product is at most that of its factors' limits.
module prove_place_blend (
    input logic        clk, advance,
    input logic [15:0] fraction,
    input logic        flip, middle,
    input logic [16:0] coarse, fine
);
    logic [16:0] half_location, location;
    tess_place_blend place_blend (.*);

    localparam logic [63:0] LIMIT = 64'h800A; // section 14.1: the largest place
    logic [15:0] weight;
    logic [63:0] of_coarse, of_fine, half;
    always_comb begin
        weight    = ~fraction;
        of_coarse = 33'(coarse) * 33'(weight);
        of_fine   = 33'(fine) * 33'(fraction);
        half      = middle ? 64'h8000 : (of_coarse + coarse + of_fine + 64'h8000) >> 16;
        assume (coarse <= LIMIT && fine <= LIMIT);
        assume (of_coarse <= LIMIT * weight && of_fine <= LIMIT * fraction);
        assert (64'(weight) + 64'd1 == 64'h1_0000 - fraction);
        assert (half_location == half);
        assert (location == (flip ? 64'h1_0000 - half : half) && location <= 64'h1_0000);
        cover (middle);
        cover (flip && !middle && coarse != 17'd0 && fine != coarse && fraction != 16'd0);
    end
endmodule
