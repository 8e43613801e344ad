// tess_points neither drops nor duplicates a point, for any patches and any stalls of the consumer. It holds the points of the
// edges to be described, of the edge ahead and of the walk, and the elements after the walk. Given that the edges up to the one with
// `is_last` have as many points as the patch counts, which tess_check_counts asserts in every run.
logic [12:0] undescribed; // points of this edge and later ones of the patch, less one
always_ff @(posedge clk) begin
    if (start_valid && start_ready) undescribed <= start_patch.points - 13'd1;
    else if (describes) undescribed <= undescribed - 13'(further) - 13'd1;
end
always_comb assume (!active || (is_last ? undescribed == 13'(further) : undescribed > 13'(further)));
logic [7:0] step; // points of this step of the walk
assign step = ends_edge ? 8'(to_come) + 8'd1 : 8'(STEP);
logic [7:0] kept; // lanes that have one
if (POINTS == 1) begin : g_single
    assign kept = 8'd1;
end else begin : g_several
    always_comb begin
        kept = 8'd1;
        for (int k = 0; k < POINTS - 1; k++) kept = kept + 8'(g_lanes.keep[k]);
    end
end
ledger ledger (
    .clk, .rst, .came((start_valid && start_ready) ? 16'(start_patch.points) : 16'd0), .left((advance && walks) ? 16'(step) : 16'd0),
    .came_last(start_valid && start_ready && start_patch.points != 13'd0),
    .left_last(advance && walks && here.last && ends_edge),
    .held((active ? 16'(undescribed) + 16'd1 : 16'd0) + (ahead_valid ? 16'(ahead_further) + 16'd1 : 16'd0)
        + (walks ? 16'(to_come) + 16'd1 : 16'd0)),
    .held_last(8'(active) + 8'(ahead_valid && ahead.last) + 8'(walks && here.last)),
    .also(ends_edge == (!walks || to_come < STEP) && (!walks || kept == step)));
// After the walk a step is one element, with as many lanes as it has points.
logic [7:0] behind, behind_last;
always_comb begin
    behind      = 8'(out_valid);
    behind_last = 8'(out_valid && out_last);
    for (int i = 0; i < BEHIND; i++) begin
        behind      = behind + 8'(valids[i]);
        behind_last = behind_last + 8'(valids[i] && lasts[i]);
    end
end
ledger behind_ledger (
    .clk, .rst, .came(16'(advance && walks)), .left(16'(out_valid && out_ready)), .held(16'(behind)),
    .came_last(advance && walks && here.last && ends_edge), .left_last(out_valid && out_ready && out_last),
    .held_last(behind_last), .also(1'b1));
if (POINTS > 1) begin : g_keep
    hold #(.WIDTH((POINTS-1) * (BEHIND+1))) keep_hold (.clk, .keeps(!advance), .state(g_lanes.keeps));
end
port #(.WIDTH(35 * POINTS + 1)) out_port (
    .clk, .rst, .valid(out_valid), .ready(out_ready), .data({out_keep, out_u, out_v, out_last}));
// What waits keeps its values: the patch until the next one starts, the edge ahead, and the walk.
hold #(.WIDTH(2 + tess_pkg::CONTEXTS_BITS)) patch_hold (
    .clk, .keeps(!start_ready), .state({is_quad, row_along_u, contexts}));
hold #(.WIDTH(16 + 2 * 7 + 2 * BITS)) ahead_hold (
    .clk, .keeps(!describes), .state({ahead, ahead_start, ahead_further, ahead_a, ahead_b}));
hold #(.WIDTH(1 + 16 + 2 * 7 + 1 + 2 * BITS + 2 * BEHIND)) walk_hold (
    .clk, .keeps(!advance && !rst),
    .state({walks, here, along, to_come, ends_edge, a_context, b_context, valids, lasts}));
