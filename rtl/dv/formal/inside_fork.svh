// Stands at the end of tess_fork in the copy that is proved.
prove_fork proof (
    .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_valid(out_valid), .out_ready(out_ready),
    .took(took)
);
