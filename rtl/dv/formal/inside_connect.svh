// tess_connect neither drops nor duplicates a primitive when it describes stitches. It holds the primitives to be described,
// those of the edge and those of the stitch ahead, which may be taken at any time. The proofs of tess_stitch and tess_rows cover
// the rest. Given that the stitches up to the one with `is_last` have as many primitives as the patch counts, which
// tess_check_counts asserts in every run.
logic [6:0] further_next;
assign further_next = outer_last_next + inner_last_next - 7'd1;
logic [13:0] undescribed; // primitives of the next stitch and later ones of the patch, less one
always_ff @(posedge clk) begin
    if (start_valid && start_ready) undescribed <= start_patch.primitives - 14'd1;
    else if (describes) undescribed <= undescribed - 14'(further_next) - 14'd1;
end
always_comb assume (!active || (is_last ? undescribed == 14'(further_next) : undescribed > 14'(further_next)));
always_comb assume (!takes || ahead_valid);
ledger ledger (
    .clk, .rst, .came((start_valid && start_ready) ? 16'(start_patch.primitives) : 16'd0),
    .left(takes ? 16'(ahead.further) + 16'd1 : 16'd0),
    .came_last(start_valid && start_ready && start_patch.primitives != 14'd0), .left_last(takes && ahead.last),
    .held((active ? 16'(undescribed) + 16'd1 : 16'd0) + (edge_valid ? 16'(described.further) + 16'd1 : 16'd0)
        + (ahead_valid ? 16'(ahead.further) + 16'd1 : 16'd0)),
    .held_last(8'(active) + 8'(edge_valid && edge_last) + 8'(ahead_valid && ahead.last)), .also(1'b1));
// What waits keeps its values: the patch until the next one starts, the edge, and the stitch ahead.
hold #(.WIDTH($bits(patch) + tess_pkg::COUNTS_BITS + 1)) patch_hold (
    .clk, .keeps(!start_ready), .state({patch, counts, strip_along_u}));
hold #(.WIDTH(15)) edge_hold (.clk, .keeps(!describes), .state({edge_last, edge_outer_last, edge_inner_last}));
hold #(.WIDTH($bits(ahead))) ahead_hold (.clk, .keeps(!passes), .state(ahead));
