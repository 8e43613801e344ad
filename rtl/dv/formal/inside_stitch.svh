// tess_stitch neither drops nor duplicates a step. It holds the remaining steps of the walk, and those after the walk.
ledger ledger (
    .clk, .rst, .came(takes ? 16'(ahead.further) + 16'd1 : 16'd0), .left(16'(advance && step_valid)),
    .came_last(takes && ahead.last), .left_last(advance && step_valid && step.last),
    .held((walks ? 16'(to_come) + 16'd1 : 16'd0) + 16'(made_valid) + 16'(step_valid)),
    .held_last(8'(walks && here.last) + 8'(made_valid && made.last) + 8'(step_valid && step.last)),
    .also(ends == (!walks || to_come == 7'd0)));
port #(.WIDTH(4 + $bits(step_stitch))) out_port (
    .clk, .rst, .valid(step_valid), .ready(advance), .data({step_begins, step, step_stitch}));
// The walk keeps its values while it waits.
hold #(.WIDTH(1 + $bits(here) + 7 + 3 + 7 + 3 + 6 + 64 + 1 + 3 + 1 + $bits(here) + 2 + 32)) walk_hold (
    .clk, .keeps(!advance && !rst),
    .state({walks, here, to_come, ends, is_first, is_odd, pairs, phase, masked, left, made_valid, made, made_begins, made_stitch,
        made_masked, made_back, lowest}));
