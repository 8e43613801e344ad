// Stands at the end of tess_rows in the copy that is proved.
prove_rows proof (
    .clk(clk), .rst(rst), .advance(advance), .step_valid(step_valid), .step_last(step.last), .valid(valid),
    .here_last(here.last), .out_valid(out_valid), .out_last(out_last)
);
