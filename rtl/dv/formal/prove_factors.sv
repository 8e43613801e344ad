// tess_factors neither drops nor doubles a patch: the patches that it has accepted are those that have left and one for
// each of its steps that holds a patch whose last factor is there or behind. Proved by induction.
module prove_factors (
    input logic       clk, rst, is_culled, issues_last,
    input logic       starts, busy, is_complete, product_valid, sum_valid, out_valid, out_ready,
    input logic [5:0] valids, lasts,
    input logic [2:0] k, factor_count
);
    logic       has_begun = 1'b0;
    logic [7:0] accepted, left, made;
    always_ff @(posedge clk) begin
        has_begun <= 1'b1;
        accepted  <= rst ? 8'd0 : accepted + 8'(starts);
        left      <= rst ? 8'd0 : left + 8'(out_valid && out_ready);
    end
    always_comb begin
        made = 8'd0;
        for (int i = 0; i < 6; i++) made = made + 8'(valids[i] && lasts[i]);
        if (!has_begun) assume (rst);
        if (rst) assert (!starts);
        if (has_begun && !rst) begin
            assert (!busy || k < factor_count);
            assert (!busy || issues_last == (is_culled || k == factor_count - 3'd1));
            assert (8'(product_valid) + 8'(sum_valid) + 8'(out_valid) <= 8'd1);
            assert (8'(accepted - left) == 8'(busy) + made + 8'(is_complete) + 8'(product_valid) + 8'(sum_valid)
                + 8'(out_valid));
        end
    end
endmodule
