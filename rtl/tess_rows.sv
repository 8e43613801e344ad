// The two rows of a stitch, and the entries that the next triangle may use (specification, section 7.1).
// Combinational. A row is a value: its first index, its direction, and at most one entry that is replaced, which is
// where a ring closes.
module tess_rows (
    input  logic [12:0] outer_base,
    input  logic        outer_closes,   // entry outer_close_at is outer_close
    input  logic [6:0]  outer_close_at,
    input  logic [12:0] outer_close,
    input  logic [6:0]  outer_at,       // the current entry
    output logic [12:0] outer_now,      // its index
    output logic [12:0] outer_next,     // and that of the entry behind it

    input  logic [12:0] inner_base,
    input  logic        inner_descends, // entry k is inner_base - k
    input  logic        inner_closes,
    input  logic [6:0]  inner_close_at,
    input  logic [12:0] inner_close,
    input  logic [6:0]  inner_at,
    output logic [12:0] inner_now,
    output logic [12:0] inner_next
);
    function automatic logic [12:0] index(
            input logic [12:0] base, input logic descends, input logic closes,
            input logic [6:0] close_at, input logic [12:0] close, input logic [6:0] k);
        if (closes && k == close_at) index = close;
        else if (descends)           index = base - 13'(k);
        else                         index = base + 13'(k);
    endfunction

    always_comb begin
        outer_now  = index(outer_base, 1'b0, outer_closes, outer_close_at, outer_close, outer_at);
        outer_next = index(outer_base, 1'b0, outer_closes, outer_close_at, outer_close, outer_at + 7'd1);
        inner_now  = index(inner_base, inner_descends, inner_closes, inner_close_at, inner_close, inner_at);
        inner_next = index(inner_base, inner_descends, inner_closes, inner_close_at, inner_close, inner_at + 7'd1);
    end
endmodule
