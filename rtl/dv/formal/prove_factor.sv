// tess_factor equals section 3, steps 2 to 7, computed here with 64-bit numbers in units of 2^-23, for every bit pattern,
// partitioning, place and frame. Proved for all inputs at once.
module prove_factor (
    input logic [31:0] bits,
    input logic [1:0]  partitioning,
    input logic        is_inside, has_frame
);
    logic [22:0] fixed;
    logic        odd;
    tess_factor factor (.clk(1'b0), .advance(1'b0), .*);

    logic [63:0] x, low, high, clamped, whole;
    always_comb begin
        // All numbers below 1 have the same result, and so do all from 128.
        if (bits[31] || bits[30:23] < 8'd127)                   x = 64'd0;
        else if (bits[30:23] == 8'd255 && bits[22:0] != 23'd0)  x = 64'd0;
        else if (bits[30:23] > 8'd133)                          x = 64'd128 << 23;
        else                                                    x = {40'd0, 1'b1, bits[22:0]} << (bits[30:23] - 8'd127);
        low  = 64'd1 << 23;
        high = 64'd64 << 23;
        if (partitioning == 2'd3) low = 64'd2 << 23;
        if (partitioning == 2'd2) high = 64'd63 << 23;
        if (partitioning == 2'd2 && is_inside && has_frame) low = (64'd1 << 23) + (64'd1 << 7);
        clamped = (x < low) ? low : (x > high) ? high : x;
        whole   = (clamped + (64'd1 << 23) - 64'd1) >> 23;
        if (partitioning[1]) begin
            assert (fixed == (clamped + 64'd63 + 64'(clamped[7])) >> 7); // to the nearest 2^-16, ties to even
            assert (odd == (partitioning == 2'd2));
        end else begin
            assert (fixed == whole << 16);
            assert (odd == (whole[0] && !(is_inside && whole == 64'd1)));
        end
        cover (partitioning[1]);
        cover (!partitioning[1]);
    end
endmodule
