// tess_fork hands each element to each consumer exactly once: a consumer has taken as many elements as have left, and one
// more while `took` is set for it, which is only while an element waits. Proved by induction.
module prove_fork (
    input logic       clk, rst, in_valid, in_ready,
    input logic [2:0] out_valid, out_ready, took
);
    logic [7:0] left, taken_0, taken_1, taken_2;
    logic       waits, has_begun = 1'b0;
    always_ff @(posedge clk) begin
        has_begun <= 1'b1;
        waits     <= !rst && in_valid && !in_ready;
        left      <= rst ? 8'd0 : left + 8'(in_valid && in_ready);
        taken_0   <= rst ? 8'd0 : taken_0 + 8'(out_valid[0] && out_ready[0]);
        taken_1   <= rst ? 8'd0 : taken_1 + 8'(out_valid[1] && out_ready[1]);
        taken_2   <= rst ? 8'd0 : taken_2 + 8'(out_valid[2] && out_ready[2]);
    end
    always_comb begin
        if (!has_begun) assume (rst);
        // The contract of a stream: what is offered stays.
        if (has_begun && waits) assume (in_valid);
        if (has_begun && !rst) begin
            assert (waits || took == 3'd0);
            assert (8'(taken_0 - left) == 8'(took[0]));
            assert (8'(taken_1 - left) == 8'(took[1]));
            assert (8'(taken_2 - left) == 8'(took[2]));
        end
    end
endmodule
