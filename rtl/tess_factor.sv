// Clamps, rounds and converts one factor (specification, section 3, steps 2 to 7, and section 2).
// It has no floating-point unit: positive binary32 numbers compare like their bits.
//
// Combinational. With REGISTERED it takes three clocks (clamp, align, round); the register of the last is the caller's.
`include "tess_types.svh"
module tess_factor #(
    parameter bit REGISTERED = 1'b0
) (
    input  logic        clk,          // with REGISTERED
    input  logic        advance,
    input  logic [31:0] bits,         // binary32, any pattern
    input  logic [1:0]  partitioning, // integer for the density of isolines
    input  logic        is_inside,
    input  logic        has_frame,    // step 4: a factor of the patch exceeds 1 + 2^-17
    output logic [22:0] fixed,        // 15.16, 1..64
    output logic        odd           // parity
);
    localparam int CLOCKS = REGISTERED ? 1 : 0; // of each step
    localparam logic [30:0] F32_1       = 31'h3F80_0000;
    localparam logic [30:0] F32_1_FRAME = 31'h3F80_0080; // 1 + 2^-16
    localparam logic [30:0] F32_2       = 31'h4000_0000;
    localparam logic [30:0] F32_63      = 31'h427C_0000;
    localparam logic [30:0] F32_64      = 31'h4280_0000;

    // ---- clamp ---------------------------------------------------------------------------------

    // The comparisons with each bound are of fields, without carries; the partitioning selects among their results.
    logic [7:0]  e; // exponent and mantissa
    logic [22:0] m;
    logic        is_nan, is_below_1, is_below_1_frame, is_below_2, is_above_63, is_above_64, is_below, is_above;
    logic [30:0] low, high;
    assign e = bits[30:23];
    assign m = bits[22:0];
    assign is_nan           = (&e) && (|m);
    assign is_below_1       = !e[7] && e[6:0] != 7'd127;
    assign is_below_1_frame = !e[7] && (e[6:0] != 7'd127 || m[22:7] == 16'd0);
    assign is_below_2       = !e[7];
    assign is_above_63      = e[7] && (e[6:0] > 7'd4 || (e[6:0] == 7'd4 && (&m[22:18]) && (|m[17:0])));
    assign is_above_64      = e[7] && (e[6:0] > 7'd5 || (e[6:0] == 7'd5 && (|m)));
    /* verilator lint_off UNUSEDSIGNAL */ // three bits of the exponent are enough
    logic [30:0] clamped;
    /* verilator lint_on UNUSEDSIGNAL */
    always_comb begin
        low      = F32_1;
        is_below = is_below_1;
        high     = F32_64;
        is_above = is_above_64;
        if (partitioning == tess_pkg::FRACTIONAL_EVEN) begin
            low      = F32_2;
            is_below = is_below_2;
        end
        if (partitioning == tess_pkg::FRACTIONAL_ODD) begin
            high     = F32_63;
            is_above = is_above_63;
            if (is_inside && has_frame) begin
                low      = F32_1_FRAME;
                is_below = is_below_1_frame;
            end
        end
        clamped = bits[30:0];
        if (bits[31] || is_nan || is_below) begin
            clamped = low;
        end else if (is_above) begin
            clamped = high;
        end
    end

    // ---- align ---------------------------------------------------------------------------------

    logic [25:0] to_align;
    tess_delay #(.WIDTH(26), .CLOCKS(CLOCKS)) at_align (.clk, .advance, .in(clamped[25:0]), .out(to_align));

    logic [2:0]  exponent;
    logic [29:0] aligned; // 7.23
    always_comb begin
        // The clamped exponent is 127..133, so its low three bits are 7, 0, 1, ... 5.
        exponent = to_align[25:23] + 3'd1;
        aligned  = {6'd0, 1'b1, to_align[22:0]} << exponent;
    end

    // ---- round ---------------------------------------------------------------------------------

    logic [29:0] wide;
    logic        is_integer, is_odd, was_inside;
    tess_delay #(.WIDTH(30), .CLOCKS(CLOCKS)) at_round (.clk, .advance, .in(aligned), .out(wide));
    tess_delay #(.WIDTH(3), .CLOCKS(2 * CLOCKS)) modes (
        .clk, .advance,
        .in ({!partitioning[1], partitioning == tess_pkg::FRACTIONAL_ODD, is_inside}),
        .out({is_integer, is_odd, was_inside})
    );

    logic [6:0] whole; // the ceiling
    logic       rounds_up;
    always_comb begin
        // Every bit after the binary point counts, including those below 2^-16.
        whole = wide[29:23] + {6'd0, |wide[22:0]};
        // To the nearest multiple of 2^-16, ties to even.
        rounds_up = wide[6] && ((|wide[5:0]) || wide[7]);
        fixed = is_integer ? {whole, 16'd0} : wide[29:7] + {22'd0, rounds_up};
        odd = is_integer ? whole[0] && !(was_inside && whole == 7'd1) : is_odd;
    end
endmodule
