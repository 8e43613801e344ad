// tess_points neither drops nor doubles an element, whatever the patches and however the consumer waits: the points of
// all patches that it has accepted are those that have left, those of edges to be described, of the edge ahead and of the
// walk, and those behind the walk. The same holds for the patches' last points. Proved by induction.
module prove_points (
    input logic        clk, rst,
    input logic        starts, active, ahead_valid, ahead_last, walks, ends_edge, here_last,
    input logic [12:0] start_points, remaining,
    input logic [6:0]  ahead_further, to_come,
    input logic [8:0]  valids, lasts,
    input logic        out_valid, out_last, out_ready
);
    logic        has_begun = 1'b0;
    logic [15:0] held;
    logic [7:0]  held_patches;
    logic [3:0]  behind, behind_patches;
    ledger #(.WIDTH(13)) ledger (
        .clk(clk), .rst(rst), .starts(starts), .elements(start_points), .leaves(out_valid && out_ready),
        .leaves_last(out_last), .held(held), .held_patches(held_patches)
    );
    always_ff @(posedge clk) begin
        has_begun <= 1'b1;
    end
    always_comb begin
        behind = 4'(out_valid);
        behind_patches = 4'(out_valid && out_last);
        for (int i = 0; i < 9; i++) begin
            behind = behind + 4'(valids[i]);
            behind_patches = behind_patches + 4'(valids[i] && lasts[i]);
        end
        if (!has_begun) assume (rst);
        if (has_begun && !rst) begin
            assert (!walks || ends_edge == (to_come == 7'd0));
            assert (held == (active ? 16'(remaining) + 16'd1 : 16'd0) + (ahead_valid ? 16'(ahead_further) + 16'd1 : 16'd0)
                + (walks ? 16'(to_come) + 16'd1 : 16'd0) + 16'(behind));
            assert (held_patches == 8'(active) + 8'(ahead_valid && ahead_last) + 8'(walks && here_last) + 8'(behind_patches));
        end
    end
endmodule
