// The two rows of a stitch and the primitives between them (specification, sections 7.1 and 8). It holds two entries of each
// row. In each step one row advances; a clock later the indices of the primitive follow.
`include "tess_types.svh"
module tess_rows (
    input  logic         clk,
    input  logic         rst,
    input  logic         advance,     // all registers may change
    input  logic         step_valid,
    input  logic         step_begins, // the rows of `step_stitch` begin with this step
    input  tess_step_t   step,
    /* verilator lint_off UNUSEDSIGNAL */ // the mask and other fields that only tess_stitch uses
    input  tess_stitch_t step_stitch,
    /* verilator lint_on UNUSEDSIGNAL */

    output logic         out_valid,   // two clocks later
    output logic [1:0]   out_size,
    output logic [12:0]  out_i0,
    output logic [12:0]  out_i1,
    output logic [12:0]  out_i2,
    output logic         out_last
);
    // ---- the rows ------------------------------------------------------------------------------

    logic        valid;
    tess_step_t  here;
    logic [12:0] outer_now, outer_next, inner_now, inner_next; // the entries that a primitive may use
    logic [6:0]  outer_left, inner_left;                       // entries after `now`
    logic        outer_closes, inner_closes, inner_descends, swaps;
    logic [12:0] outer_close, inner_close;
    logic [1:0]  size;

    // The entry after `next`.
    logic [12:0] outer_then, inner_then;
    assign outer_then = (outer_closes && outer_left == 7'd2) ? outer_close : outer_next + 13'd1;
    assign inner_then = (inner_closes && inner_left == 7'd2) ? inner_close
                      : inner_descends ? inner_next - 13'd1 : inner_next + 13'd1;

    always_ff @(posedge clk) begin
        if (rst) begin
            valid <= 1'b0;
        end else if (advance) begin
            valid <= step_valid;
        end
        if (advance) begin
            here <= step;
            if (step_valid && step_begins) begin
                outer_now      <= step_stitch.outer_base;
                outer_next     <= (step_stitch.outer_closes && step_stitch.outer_last == 7'd1) ? step_stitch.outer_close
                                : step_stitch.outer_base + 13'd1;
                outer_left     <= step_stitch.outer_last;
                outer_closes   <= step_stitch.outer_closes;
                outer_close    <= step_stitch.outer_close;
                inner_now      <= (step_stitch.inner_opens || (step_stitch.inner_closes && step_stitch.inner_last == 7'd0))
                                ? step_stitch.inner_close : step_stitch.inner_base;
                inner_next     <= (step_stitch.inner_closes && step_stitch.inner_last == 7'd1) ? step_stitch.inner_close
                                : step_stitch.inner_descends ? step_stitch.inner_base - 13'd1 : step_stitch.inner_base + 13'd1;
                inner_left     <= step_stitch.inner_last;
                inner_closes   <= step_stitch.inner_closes;
                inner_close    <= step_stitch.inner_close;
                inner_descends <= step_stitch.inner_descends;
                size           <= step_stitch.size;
                swaps          <= step_stitch.swaps;
            end else if (here.advances_outer) begin
                outer_now  <= outer_next;
                outer_next <= outer_then;
                outer_left <= outer_left - 7'd1;
            end else begin
                inner_now  <= inner_next;
                inner_next <= inner_then;
                inner_left <= inner_left - 7'd1;
            end
        end
    end

    // ---- the primitive -------------------------------------------------------------------------

    logic [12:0] i0, i1, i2;
    always_comb begin
        i0 = here.begins_outer ? outer_now : inner_now;
        if (here.advances_outer) begin
            i1 = here.begins_outer ? outer_next : outer_now;
            i2 = here.begins_outer ? inner_now : outer_next;
        end else begin
            i1 = here.begins_outer ? inner_next : outer_now;
            i2 = here.begins_outer ? inner_now : inner_next;
        end
    end

    always_ff @(posedge clk) begin
        if (rst) begin
            out_valid <= 1'b0;
        end else if (advance) begin
            out_valid <= valid;
        end
        if (advance) begin
            out_size <= size;
            out_i0   <= i0;
            out_i1   <= (size == 2'd1) ? 13'd0 : swaps ? i2 : i1;
            out_i2   <= (size != 2'd3) ? 13'd0 : swaps ? i1 : i2;
            out_last <= here.last;
        end
    end
endmodule
