// tess_rows makes one primitive per step, and the patch's last primitive from its last step. It holds those of its two clocks.
ledger ledger (
    .clk, .rst, .came(16'(advance && step_valid)), .left(16'(advance && out_valid)), .held(16'(valid) + 16'(out_valid)),
    .came_last(advance && step_valid && step.last), .left_last(advance && out_valid && out_last),
    .held_last(8'(valid && here.last) + 8'(out_valid && out_last)), .also(1'b1));
port #(.WIDTH(42)) out_port (.clk, .rst, .valid(out_valid), .ready(advance), .data({out_size, out_i0, out_i1, out_i2, out_last}));
