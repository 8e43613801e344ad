// Adds the number of a patch's first point to the indices of a primitive, modulo 2^BASE; indices that the primitive does not
// have stay 0. With BASE 0 there are only wires.
module tess_base #(
    parameter int BASE     = 0,
    localparam int FIRSTS  = (BASE == 0) ? 1 : BASE,
    localparam int INDICES = (BASE == 0) ? 13 : BASE
) (
    /* verilator lint_off UNUSEDSIGNAL */ // wires add nothing
    input  logic [FIRSTS-1:0]  first,
    input  logic [1:0]         size,     // number of indices, 1 to 3
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic [12:0]        in_i0,
    input  logic [12:0]        in_i1,
    input  logic [12:0]        in_i2,
    output logic [INDICES-1:0] out_i0,
    output logic [INDICES-1:0] out_i1,
    output logic [INDICES-1:0] out_i2
);
    if (BASE == 0) begin : g_wires
        assign out_i0 = in_i0;
        assign out_i1 = in_i1;
        assign out_i2 = in_i2;
    end else begin : g_adders
        assign out_i0 = BASE'(in_i0) + first;
        assign out_i1 = BASE'(in_i1) + ((size > 2'd1) ? first : '0);
        assign out_i2 = BASE'(in_i2) + ((size > 2'd2) ? first : '0);
    end
endmodule
