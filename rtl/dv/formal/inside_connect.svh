// tess_connect neither drops nor duplicates a primitive when it describes stitches. It holds the primitives to be described and
// those of the stitch ahead, which may be taken at any time. The proofs of tess_stitch and tess_rows cover the rest.
always_comb assume (!takes || ahead_valid);
ledger ledger (
    .clk, .rst, .came((start_valid && start_ready) ? 16'(start_patch.primitives) : 16'd0),
    .left(takes ? 16'(ahead.further) + 16'd1 : 16'd0),
    .came_last(start_valid && start_ready && start_patch.primitives != 14'd0), .left_last(takes && ahead.last),
    .held((!active ? 16'd0 : is_first ? 16'(patch.primitives) : 16'(remaining) + 16'd1)
        + (ahead_valid ? 16'(ahead.further) + 16'd1 : 16'd0)),
    .held_last(8'(active) + 8'(ahead_valid && ahead.last)),
    .also((!edge_valid || (active && !is_first)) && (!active || !is_first || patch.primitives != 14'd0)));
// What waits keeps its values: the patch until the next one starts, and the stitch ahead.
hold #(.WIDTH($bits(patch) + tess_pkg::COUNTS_BITS + 1)) patch_hold (
    .clk, .keeps(!(start_valid && start_ready)), .state({patch, counts, strip_along_u}));
hold #(.WIDTH($bits(ahead))) ahead_hold (.clk, .keeps(!passes), .state(ahead));
