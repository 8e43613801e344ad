// tess_connect neither drops nor doubles an element, whatever the patches and however the consumer waits: the primitives
// of all patches that it has accepted are those that have left, those to come of the patch in the walk, and the one that
// is offered. The same holds for the patches' last primitives. Proved by induction.
module prove_connect (
    input logic        clk, rst,
    input logic        starts, active,
    input logic [13:0] start_primitives, patch_primitives, number,
    input logic        out_valid, out_last, out_ready
);
    logic        has_begun = 1'b0, stalled;
    logic [15:0] held;
    logic [7:0]  held_patches;
    ledger #(.WIDTH(14)) ledger (
        .clk(clk), .rst(rst), .starts(starts), .elements(start_primitives), .leaves(out_valid && out_ready),
        .leaves_last(out_last), .held(held), .held_patches(held_patches)
    );
    always_ff @(posedge clk) begin
        has_begun <= 1'b1;
        stalled   <= !rst && out_valid && !out_ready;
    end
    always_comb begin
        if (!has_begun) assume (rst);
        if (has_begun && !rst) begin
            assert (!active || number < patch_primitives);
            assert (held == (active ? 16'(patch_primitives - number) : 16'd0) + 16'(out_valid));
            assert (held_patches == 8'(active) + 8'(out_valid && out_last));
            if (stalled) assert (out_valid);
        end
    end
endmodule
