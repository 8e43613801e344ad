// tess_factor_context equals section 4, computed here in 64 bits, for every factor, parity and split order. A reciprocal is the
// only number that, times its divisor, is next to 2^16. Proved for all inputs at once.
module prove_context (
    input logic [22:0] factor,
    input logic        odd, center
);
    logic [16:0] inv_floor, inv_ceil;
    logic [15:0] fraction;
    logic [5:0]  half_points, split;
    logic [6:0]  points;
    tess_factor_context factor_context (.clk(1'b0), .advance(1'b0), .*);

    logic [63:0] half, below, above, steps_below, steps_above, top, beyond;
    always_comb begin
        // Odd factors are 1 to 63, even ones 1 or 2 to 64.
        assume (factor >= 23'h01_0000 && factor <= (odd ? 23'h3F_0000 : 23'h40_0000));
        assume (odd || factor == 23'h01_0000 || factor >= 23'h02_0000);

        half  = (64'(factor) + 64'd1) / 64'd2 + ((odd || factor == 23'h01_0000) ? 64'h8000 : 64'd0);
        below = half / 64'h1_0000;
        above = (half + 64'hFFFF) / 64'h1_0000;
        assert (fraction == half - below * 64'h1_0000);
        assert (half_points == above);
        assert (points == 64'd2 * above + (odd ? 64'd0 : 64'd1));

        steps_below = 64'd2 * below - 64'(odd);
        steps_above = 64'd2 * above - 64'(odd);
        assert (inv_floor * steps_below <= 64'h1_0000 + steps_below / 64'd2);
        assert ((64'(inv_floor) + 64'd1) * steps_below > 64'h1_0000 + steps_below / 64'd2);
        assert (inv_ceil * steps_above <= 64'h1_0000 + steps_above / 64'd2);
        assert ((64'(inv_ceil) + 64'd1) * steps_above > 64'h1_0000 + steps_above / 64'd2);

        // Behind the highest power of two that is not above the points of the floor, on odd edges less one.
        top    = below - 64'(odd);
        beyond = (top >= 32) ? top - 32 : (top >= 16) ? top - 16 : (top >= 8) ? top - 8 : (top >= 4) ? top - 4
               : (top >= 2) ? top - 2 : 64'd0;
        if (below == above)               assert (split == above + 64'd1);
        else if (center)                  assert (split == above - (odd ? 64'd2 : 64'd1));
        else if (odd && below == 64'd1)   assert (split == 64'd0);
        else                              assert (split == 64'd2 * beyond + 64'd1);
    end
endmodule
