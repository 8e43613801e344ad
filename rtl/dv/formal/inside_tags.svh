// tess_tags gives each element the tag of its patch: tags leave in the order in which they came, each with its patch's last
// element; the stage and the port see the same transfers; and no element waits for its tag, if the stage makes elements only of
// patches that it has held for a clock.
if (USED) begin : g_proof
    localparam int TAGS = 2**LOG;
    logic                  has_begun = 1'b0, comes, leaves;
    logic [LOG:0]          due, stored; // patches that the stage holds; without one that came in the last clock
    logic [WIDTH*TAGS-1:0] expected, rest; // their tags, the oldest lowest
    assign comes  = to_valid && to_ready && in_count != 14'd0;
    assign leaves = from_valid && from_ready && from_last;
    always_ff @(posedge clk) begin
        has_begun <= 1'b1;
        due       <= rst ? '0 : due + (LOG+1)'(comes) - (LOG+1)'(leaves);
        expected  <= rest;
        for (int i = 0; i < TAGS; i++) if (comes && i == due - (LOG+1)'(leaves)) expected[WIDTH*i +: WIDTH] <= in_tag;
    end
    assign stored = due - (LOG+1)'(g_tags.has_come);
    assign rest   = leaves ? expected >> WIDTH : expected;
    always_comb begin
        if (!has_begun) assume (rst);
        if (has_begun && !rst) begin
            if (from_valid) assume (stored != '0);
            assert (stored == (LOG+1)'(g_tags.is_there) + (LOG+1)'(g_tags.further) && stored <= (LOG+1)'(TAGS));
            assert (due <= (LOG+1)'(TAGS) && (g_tags.is_there || g_tags.further == '0));
            assert (!g_tags.has_come || g_tags.latest == expected[WIDTH*stored +: WIDTH]);
            for (int i = 0; i < TAGS; i++)
                assert (i >= stored || g_tags.tags[LOG'(g_tags.first + LOG'(i))] == expected[WIDTH*i +: WIDTH]);
            assert (out_valid == from_valid && (!out_valid || out_tag == expected[WIDTH-1:0]));
            assert ((in_valid && in_ready) == (to_valid && to_ready));
            assert ((out_valid && out_ready) == (from_valid && from_ready));
        end
        cover (has_begun && !rst && due == (LOG+1)'(TAGS - 1) && in_valid && !in_ready);
        cover (has_begun && !rst && comes && leaves);
    end
end
