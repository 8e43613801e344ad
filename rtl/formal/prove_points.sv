// tess_points neither drops nor doubles an element, whatever the patches and however the consumer waits: the points of
// all patches that it has accepted are those that have left, those to come of the patch in the walk, and those in the
// three stages behind the walk. The same holds for the patches' last points. Proved by induction.
module prove_points (
    input logic        clk, rst,
    input logic        starts, active,
    input logic [12:0] start_points, patch_points, index,
    input logic        position_valid, position_last, blend_valid, blend_last, out_valid, out_last, out_ready
);
    logic        has_begun = 1'b0, stalled;
    logic [15:0] accepted, left;
    logic [7:0]  accepted_patches, left_patches;
    always_ff @(posedge clk) begin
        has_begun <= 1'b1;
        stalled   <= !rst && out_valid && !out_ready;
        accepted  <= rst ? 16'd0 : accepted + (starts ? {3'd0, start_points} : 16'd0);
        left      <= rst ? 16'd0 : left + 16'(out_valid && out_ready);
        accepted_patches <= rst ? 8'd0 : accepted_patches + 8'(starts && start_points != 13'd0);
        left_patches     <= rst ? 8'd0 : left_patches + 8'(out_valid && out_ready && out_last);
    end
    always_comb begin
        if (!has_begun) assume (rst);
        if (has_begun && !rst) begin
            assert (!active || index < patch_points);
            assert (16'(accepted - left) == (active ? 16'(patch_points - index) : 16'd0)
                + 16'(position_valid) + 16'(blend_valid) + 16'(out_valid));
            assert (8'(accepted_patches - left_patches) == 8'(active) + 8'(position_valid && position_last)
                + 8'(blend_valid && blend_last) + 8'(out_valid && out_last));
            if (stalled) assert (out_valid);
        end
    end
endmodule
