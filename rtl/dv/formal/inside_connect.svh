// Stands at the end of tess_connect in the copy that is proved.
prove_connect proof (
    .clk(clk), .rst(rst), .starts(start_valid && start_ready), .active(active),
    .start_primitives(start_patch.primitives), .patch_primitives(patch.primitives), .number(number),
    .out_valid(out_valid), .out_last(out_last), .out_ready(out_ready)
);
