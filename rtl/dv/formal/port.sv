// The contract of a stream at a port, for the proofs: an element that waits stays with its value, and a reset withdraws it. It
// is proved for the stage that outputs the stream, and assumed by the stage that takes it.
module port #(
    parameter int WIDTH = 1,
    parameter bit TAKES = 1'b0
) (
    input logic             clk, rst, valid, ready,
    input logic [WIDTH-1:0] data
);
    logic             has_begun = 1'b0, stalled, was_reset, is_kept;
    logic [WIDTH-1:0] waited;
    always_ff @(posedge clk) {has_begun, was_reset, stalled, waited} <= {1'b1, rst, !rst && valid && !ready, data};
    assign is_kept = !has_begun || (was_reset ? !valid : rst || !stalled || (valid && data == waited));
    always_comb begin
        if (!has_begun) assume (rst);
        if (TAKES) assume (is_kept);
        else assert (is_kept);
        cover (has_begun && !rst && stalled && !ready);
    end
endmodule
