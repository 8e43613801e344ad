// tess_factors neither drops nor duplicates a patch. It holds one patch for each step that has, or had, a patch's last factor.
logic [7:0] held;
always_comb begin
    held = 8'(busy) + 8'(is_complete) + 8'(product_valid) + 8'(sum_valid) + 8'(out_valid);
    for (int i = 0; i < 6; i++) held = held + 8'(valids[i] && lasts[i]);
    if (rst) assert (!in_ready);
end
ledger ledger (
    .clk, .rst, .came(16'(in_valid && in_ready)), .left(16'(out_valid && out_ready)), .held(16'(held)),
    .came_last(in_valid && in_ready), .left_last(out_valid && out_ready), .held_last(held),
    .also((!busy || (k < factor_count && issues_last == (is_culled || k == factor_count - 3'd1)))
        && 8'(product_valid) + 8'(sum_valid) + 8'(out_valid) <= 8'd1));
port #(.WIDTH(42 + tess_pkg::CONTEXTS_BITS)) out_port (.clk, .rst, .valid(out_valid), .ready(out_ready), .data({out_patch, out_contexts}));
