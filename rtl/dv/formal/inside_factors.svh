// Stands at the end of tess_factors in the copy that is proved.
prove_factors proof (
    .clk(clk), .rst(rst), .starts(in_valid && in_ready), .busy(busy), .context_valid(context_valid),
    .context_last(context_last), .counted_valid(counted_valid), .out_valid(out_valid), .out_ready(out_ready),
    .k(k), .factor_count(factor_count)
);
