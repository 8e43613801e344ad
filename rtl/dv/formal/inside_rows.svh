// Stands at the end of tess_rows in the copy that is proved.
prove_rows proof (
    .clk(clk), .rst(rst), .advance(advance), .step_valid(step_valid), .step_last(step.last), .valid(valid),
    .here_last(here.last), .out_valid(out_valid), .out_last(out_last)
);
port #(.WIDTH(42)) out_port (.clk(clk), .rst(rst), .valid(out_valid), .ready(advance), .data({out_size, out_i0, out_i1, out_i2, out_last}));
