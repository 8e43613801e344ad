// tess_rows makes one primitive of each step, and the patch's last one of its last: steps that came are primitives that have
// left, and those of its two clocks. Proved by induction.
module prove_rows (
    input logic clk, rst, advance, step_valid, step_last, valid, here_last, out_valid, out_last
);
    logic       has_begun = 1'b0;
    logic [7:0] came, left, came_last, left_last;
    always_ff @(posedge clk) begin
        has_begun <= 1'b1;
        came      <= rst ? 8'd0 : came + 8'(advance && step_valid);
        left      <= rst ? 8'd0 : left + 8'(advance && out_valid);
        came_last <= rst ? 8'd0 : came_last + 8'(advance && step_valid && step_last);
        left_last <= rst ? 8'd0 : left_last + 8'(advance && out_valid && out_last);
    end
    always_comb begin
        if (!has_begun) assume (rst);
        if (has_begun && !rst) begin
            assert (8'(came - left) == 8'(valid) + 8'(out_valid));
            assert (8'(came_last - left_last) == 8'(valid && here_last) + 8'(out_valid && out_last));
        end
    end
endmodule
