// tess_skid outputs each element that it takes once and in order. `first` and `second` are the elements that it must hold.
if (ENTRIES != 0) begin : g_proof
    logic             has_begun = 1'b0, comes, leaves;
    logic [1:0]       held; // number of elements before this clock
    logic [WIDTH-1:0] first, second;
    assign comes  = in_valid && in_ready;
    assign leaves = out_valid && out_ready;
    always_ff @(posedge clk) begin
        has_begun <= 1'b1;
        held      <= rst ? 2'd0 : held + 2'(comes) - 2'(leaves);
        if (held == 2'd0 || (held == 2'd1 && leaves)) first <= in_data;
        else if (leaves)                              first <= second;
        if (held == 2'd1) second <= in_data;
    end
    always_comb begin
        if (!has_begun) assume (rst);
        if (has_begun && !rst) begin
            assert (out_valid == (held != 2'd0));
            assert (held <= 2'(ENTRIES) && in_ready == (held < 2'(ENTRIES)));
            assert (held == 2'd0 || out_data == first);
            assert (held != 2'd2 || spare == second);
        end
        cover (has_begun && !rst && leaves && held == 2'(ENTRIES));
    end
end
