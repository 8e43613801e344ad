// Stands at the end of tess_points in the copy that is proved.
prove_points proof (
    .clk(clk), .rst(rst), .starts(start_valid && start_ready), .active(active),
    .start_points(start_patch.points), .patch_points(patch.points), .index(index),
    .position_valid(position.valid), .position_last(position.last), .blend_valid(blend.valid),
    .blend_last(blend.last), .out_valid(out_valid), .out_last(out_last), .out_ready(out_ready)
);
