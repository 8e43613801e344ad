// Stands at the end of tess_connect in the copy that is proved.
prove_connect proof (
    .clk(clk), .rst(rst), .starts(start_valid && start_ready), .start_primitives(start_patch.primitives), .active(active),
    .is_first(is_first), .patch_primitives(patch.primitives), .edge_valid(edge_valid), .remaining(remaining),
    .ahead_valid(ahead_valid), .ahead_last(ahead.last), .ahead_further(ahead.further), .takes(takes)
);
