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
    logic [15:0] held;
    logic [7:0]  held_patches;
    ledger #(.WIDTH(13)) ledger (
        .clk(clk), .rst(rst), .starts(starts), .elements(start_points), .leaves(out_valid && out_ready),
        .leaves_last(out_last), .held(held), .held_patches(held_patches)
    );
    always_ff @(posedge clk) begin
        has_begun <= 1'b1;
        stalled   <= !rst && out_valid && !out_ready;
    end
    always_comb begin
        if (!has_begun) assume (rst);
        if (has_begun && !rst) begin
            assert (!active || index < patch_points);
            assert (held == (active ? 16'(patch_points - index) : 16'd0)
                + 16'(position_valid) + 16'(blend_valid) + 16'(out_valid));
            assert (held_patches == 8'(active) + 8'(position_valid && position_last)
                + 8'(blend_valid && blend_last) + 8'(out_valid && out_last));
            if (stalled) assert (out_valid);
        end
    end
endmodule
