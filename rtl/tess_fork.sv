// Passes each element of a stream to N consumers. Each consumer takes it once, when it is ready. The element leaves in the
// clock in which the last consumer takes it.
module tess_fork #(
    parameter int N = 3
) (
    input  logic         clk,
    input  logic         rst,
    input  logic         in_valid,
    output logic         in_ready,
    output logic [N-1:0] out_valid,
    input  logic [N-1:0] out_ready
);
    logic [N-1:0] took, takes; // the consumers that took it before this clock; that take it in this clock
    assign out_valid = {N{in_valid}} & ~took;
    assign takes     = out_valid & out_ready;
    assign in_ready  = &(took | takes);

    always_ff @(posedge clk) begin
        if (rst || in_ready) begin
            took <= '0;
        end else begin
            took <= took | takes;
        end
    end
endmodule
