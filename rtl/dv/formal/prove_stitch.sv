// tess_stitch neither drops nor doubles a step: the steps of all stitches that it has taken are those that have left, those to
// come of the walk, and those behind it. The same holds for the patches' last ones. Proved by induction.
module prove_stitch (
    input logic       clk, rst,
    input logic       advance, takes, last, walks, ends, here_last, made_valid, made_last, step_valid, step_last,
    input logic [6:0] further, to_come
);
    logic        has_begun = 1'b0;
    logic [15:0] taken, left;
    logic [7:0]  taken_patches, left_patches;
    always_ff @(posedge clk) begin
        has_begun     <= 1'b1;
        taken         <= rst ? 16'd0 : taken + (takes ? 16'(further) + 16'd1 : 16'd0);
        left          <= rst ? 16'd0 : left + 16'(advance && step_valid);
        taken_patches <= rst ? 8'd0 : taken_patches + 8'(takes && last);
        left_patches  <= rst ? 8'd0 : left_patches + 8'(advance && step_valid && step_last);
    end
    always_comb begin
        if (!has_begun) assume (rst);
        if (has_begun && !rst) begin
            assert (!walks || ends == (to_come == 7'd0));
            assert (16'(taken - left) == (walks ? 16'(to_come) + 16'd1 : 16'd0) + 16'(made_valid) + 16'(step_valid));
            assert (8'(taken_patches - left_patches) == 8'(walks && here_last) + 8'(made_valid && made_last)
                + 8'(step_valid && step_last));
        end
    end
endmodule
