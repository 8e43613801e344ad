// Stands at the end of tess_points in the copy that is proved.
prove_points proof (
    .clk(clk), .rst(rst), .starts(start_valid && start_ready), .start_points(start_patch.points),
    .active(active), .remaining(remaining), .ahead_valid(ahead_valid), .ahead_last(ahead.last),
    .ahead_further(ahead_further), .walks(walks), .here_last(here.last), .to_come(to_come), .ends_edge(ends_edge), .valids(valids), .lasts(lasts),
    .out_valid(out_valid), .out_last(out_last), .out_ready(out_ready)
);
port #(.WIDTH(1)) out_port (.clk(clk), .rst(rst), .valid(out_valid), .ready(out_ready), .data(out_last));
