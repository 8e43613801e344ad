// Stands at the end of tess_factors in the copy that is proved.
prove_factors proof (
    .clk(clk), .rst(rst), .starts(in_valid && in_ready), .busy(busy), .valids(valids), .lasts(lasts),
    .is_complete(is_complete), .product_valid(product_valid), .sum_valid(sum_valid), .out_valid(out_valid),
    .out_ready(out_ready), .k(k), .factor_count(factor_count),
    .is_culled(is_culled), .issues_last(issues_last)
);
port #(.WIDTH(42 + tess_pkg::CONTEXTS_BITS)) out_port (.clk(clk), .rst(rst), .valid(out_valid), .ready(out_ready), .data({out_patch, out_contexts}));
