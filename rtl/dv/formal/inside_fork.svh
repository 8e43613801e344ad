// tess_fork passes each element to each consumer exactly once. A consumer has taken as many elements as have left, and one more
// while its bit of `took` is set.
for (genvar i = 0; i < N; i++) begin : g_ledgers
    ledger ledger (
        .clk, .rst, .came(16'(out_valid[i] && out_ready[i])), .left(16'(in_valid && in_ready)), .held(16'(took[i])),
        .came_last(1'b0), .left_last(1'b0), .held_last(8'd0), .also(1'b1));
end
