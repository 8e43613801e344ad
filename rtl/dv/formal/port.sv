// The contract of a stream at a port, for the proofs: what waits stays, value and all, and a reset withdraws it.
module port #(
    parameter int WIDTH = 1
) (
    input logic             clk, rst, valid, ready,
    input logic [WIDTH-1:0] data
);
    logic             has_begun = 1'b0, stalled, was_reset;
    logic [WIDTH-1:0] waited;
    always_ff @(posedge clk) {has_begun, was_reset, stalled, waited} <= {1'b1, rst, !rst && valid && !ready, data};
    always_comb begin
        if (!has_begun) assume (rst);
        if (has_begun && was_reset) assert (!valid);
        if (has_begun && !rst && stalled) assert (valid && data == waited);
    end
endmodule
