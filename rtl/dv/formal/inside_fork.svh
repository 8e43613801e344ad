// tess_fork hands each element to each consumer exactly once: a consumer has taken as many as have left, and one more while `took`
// is set for it.
for (genvar i = 0; i < N; i++) begin : g_ledgers
    ledger ledger (
        .clk, .rst, .came(16'(out_valid[i] && out_ready[i])), .left(16'(in_valid && in_ready)), .held(16'(took[i])),
        .came_last(1'b0), .left_last(1'b0), .held_last(8'd0), .also(1'b1));
end
