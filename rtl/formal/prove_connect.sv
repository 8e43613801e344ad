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
    logic [15:0] accepted, left;
    logic [7:0]  accepted_patches, left_patches;
    always_ff @(posedge clk) begin
        has_begun <= 1'b1;
        stalled   <= !rst && out_valid && !out_ready;
        accepted  <= rst ? 16'd0 : accepted + (starts ? {2'd0, start_primitives} : 16'd0);
        left      <= rst ? 16'd0 : left + 16'(out_valid && out_ready);
        accepted_patches <= rst ? 8'd0 : accepted_patches + 8'(starts && start_primitives != 14'd0);
        left_patches     <= rst ? 8'd0 : left_patches + 8'(out_valid && out_ready && out_last);
    end
    always_comb begin
        if (!has_begun) assume (rst);
        if (has_begun && !rst) begin
            assert (!active || number < patch_primitives);
            assert (16'(accepted - left) == (active ? 16'(patch_primitives - number) : 16'd0) + 16'(out_valid));
            assert (8'(accepted_patches - left_patches) == 8'(active) + 8'(out_valid && out_last));
            if (stalled) assert (out_valid);
        end
    end
endmodule
