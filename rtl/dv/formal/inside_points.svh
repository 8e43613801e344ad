// tess_points neither drops nor duplicates a point, for any patches and any stalls of the consumer. It holds the points of the
// edges to be described, of the edge ahead and of the walk, and those after the walk. Given that the edges up to the one with
// `is_last` have as many points as the patch counts, which tess_check_counts asserts in every run.
logic [12:0] undescribed; // points of this edge and later ones of the patch, less one
always_ff @(posedge clk) begin
    if (start_valid && start_ready) undescribed <= start_patch.points - 13'd1;
    else if (describes) undescribed <= undescribed - 13'(further) - 13'd1;
end
always_comb assume (!active || (is_last ? undescribed == 13'(further) : undescribed > 13'(further)));
logic [7:0] behind, behind_last;
always_comb begin
    behind      = 8'(out_valid);
    behind_last = 8'(out_valid && out_last);
    for (int i = 0; i < BEHIND; i++) begin
        behind      = behind + 8'(valids[i]);
        behind_last = behind_last + 8'(valids[i] && lasts[i]);
    end
end
ledger ledger (
    .clk, .rst, .came((start_valid && start_ready) ? 16'(start_patch.points) : 16'd0), .left(16'(out_valid && out_ready)),
    .came_last(start_valid && start_ready && start_patch.points != 13'd0), .left_last(out_valid && out_ready && out_last),
    .held((active ? 16'(undescribed) + 16'd1 : 16'd0) + (ahead_valid ? 16'(ahead_further) + 16'd1 : 16'd0)
        + (walks ? 16'(to_come) + 16'd1 : 16'd0) + 16'(behind)),
    .held_last(8'(active) + 8'(ahead_valid && ahead.last) + 8'(walks && here.last) + behind_last),
    .also(!walks || ends_edge == (to_come == 7'd0)));
port #(.WIDTH(35)) out_port (.clk, .rst, .valid(out_valid), .ready(out_ready), .data({out_u, out_v, out_last}));
// What waits keeps its values: the patch until the next one starts, the edge ahead, and the walk.
hold #(.WIDTH(2 + tess_pkg::CONTEXTS_BITS)) patch_hold (
    .clk, .keeps(!(start_valid && start_ready)), .state({is_quad, row_along_u, contexts}));
hold #(.WIDTH(16 + 2 * 7 + 2 * BITS)) ahead_hold (
    .clk, .keeps(!describes), .state({ahead, ahead_start, ahead_further, ahead_a, ahead_b}));
hold #(.WIDTH(1 + 16 + 2 * 7 + 1 + 2 * BITS + 2 * BEHIND)) walk_hold (
    .clk, .keeps(!advance && !rst),
    .state({walks, here, along, to_come, ends_edge, a_context, b_context, valids, lasts}));
