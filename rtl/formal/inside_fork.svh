// Stands at the end of tess_fork when TESS_PROOF is defined.
prove_fork proof (
    .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_valid(out_valid), .out_ready(out_ready),
    .took(took)
);
