// tess_top passes each patch unchanged to each stage, with its tag and first number, and its counts to the consumer. Each stage is a port here; its other
// behaviour is unconstrained.
port #(.WIDTH(462 + LABELS), .TAKES(1'b1)) made_port (.clk, .rst, .valid(made_valid), .ready(made_ready), .data({made, contexts, label}));
port #(.WIDTH(462 + LABELS)) points_port (.clk, .rst, .valid(points_starts), .ready(points_ready), .data({made, contexts, label}));
port #(.WIDTH(462 + LABELS)) connect_port (.clk, .rst, .valid(connect_starts), .ready(connect_ready), .data({made, contexts, label}));
port #(.WIDTH(27 + TAGS)) counts_port (.clk, .rst, .valid(counts_valid), .ready(counts_ready), .data({counts_points, counts_primitives, counts_tag}));
ledger ledger (
    .clk, .rst, .came(16'(counts_starts && counts_free)), .left(16'(counts_valid && counts_ready)), .held(16'(counts_valid)),
    .came_last(1'b0), .left_last(1'b0), .held_last(8'd0), .also(1'b1));
