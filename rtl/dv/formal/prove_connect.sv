// tess_connect neither drops nor doubles a primitive where it describes stitches: the primitives of all patches that it has
// accepted are those of the stitches that were taken, of the one ahead, and those to be described. The same holds for
// the patches' last ones. Proved by induction; prove_stitch and prove_rows go on from there.
module prove_connect (
    input logic        clk, rst,
    input logic        starts, active, is_first, edge_valid, ahead_valid, ahead_last, takes,
    input logic [13:0] start_primitives, patch_primitives, remaining,
    input logic [6:0]  ahead_further
);
    logic        has_begun = 1'b0;
    logic [15:0] accepted, taken, to_describe;
    logic [7:0]  accepted_patches, taken_patches;
    always_ff @(posedge clk) begin
        has_begun        <= 1'b1;
        accepted         <= rst ? 16'd0 : accepted + (starts ? 16'(start_primitives) : 16'd0);
        taken            <= rst ? 16'd0 : taken + (takes ? 16'(ahead_further) + 16'd1 : 16'd0);
        accepted_patches <= rst ? 8'd0 : accepted_patches + 8'(starts && start_primitives != 14'd0);
        taken_patches    <= rst ? 8'd0 : taken_patches + 8'(takes && ahead_last);
    end
    always_comb begin
        to_describe = !active ? 16'd0 : is_first ? 16'(patch_primitives) : 16'(remaining) + 16'd1;
        if (!has_begun) assume (rst);
        if (has_begun && !rst) begin
            assert (!edge_valid || (active && !is_first));
            assert (!active || !is_first || patch_primitives != 14'd0);
            assert (16'(accepted - taken) == to_describe + (ahead_valid ? 16'(ahead_further) + 16'd1 : 16'd0));
            assert (8'(accepted_patches - taken_patches) == 8'(active) + 8'(ahead_valid && ahead_last));
        end
    end
endmodule
