// tess_factors neither drops nor doubles a patch: the patches that it has accepted are those that have left and one for
// each of its steps that holds a patch whose last factor is there or behind. Proved by induction.
module prove_factors (
    input logic       clk, rst,
    input logic       starts, busy, context_valid, context_last, counted_valid, out_valid, out_ready,
    input logic [2:0] k, factor_count
);
    logic       has_begun = 1'b0, stalled;
    logic [7:0] accepted, left;
    always_ff @(posedge clk) begin
        has_begun <= 1'b1;
        stalled   <= !rst && out_valid && !out_ready;
        accepted  <= rst ? 8'd0 : accepted + 8'(starts);
        left      <= rst ? 8'd0 : left + 8'(out_valid && out_ready);
    end
    always_comb begin
        if (!has_begun) assume (rst);
        if (has_begun && !rst) begin
            assert (!busy || k < factor_count);
            assert (8'(accepted - left) == 8'(busy) + 8'(context_valid && context_last) + 8'(counted_valid)
                + 8'(out_valid));
            if (stalled) assert (out_valid);
        end
    end
endmodule
