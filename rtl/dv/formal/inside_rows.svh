// tess_rows makes one primitive per step, and the patch's last primitive from its last step. It holds those of its two clocks.
ledger ledger (
    .clk, .rst, .came(16'(advance && step_valid)), .left(16'(advance && out_valid)), .held(16'(valid) + 16'(out_valid)),
    .came_last(advance && step_valid && step.last), .left_last(advance && out_valid && out_last),
    .held_last(8'(valid && here.last) + 8'(out_valid && out_last)), .also(1'b1));
port #(.WIDTH(42)) out_port (.clk, .rst, .valid(out_valid), .ready(advance), .data({out_size, out_i0, out_i1, out_i2, out_last}));
// The rows keep their entries while they wait.
hold #(.WIDTH(1 + 3 + 4 * 13 + 2 * 7 + 4 + 2 * 13 + 2)) rows_hold (
    .clk, .keeps(!advance && !rst),
    .state({valid, here, outer_now, outer_next, inner_now, inner_next, outer_left, inner_left, outer_closes, inner_closes,
        inner_descends, swaps, outer_close, inner_close, size}));
