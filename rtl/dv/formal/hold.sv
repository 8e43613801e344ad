// State that must not change in a clock in which `keeps` was 1, however many such clocks there are. Proved by induction.
module hold #(
    parameter int WIDTH = 1
) (
    input logic             clk, keeps,
    input logic [WIDTH-1:0] state
);
    logic             has_begun = 1'b0, kept;
    logic [WIDTH-1:0] earlier;
    always_ff @(posedge clk) {has_begun, kept, earlier} <= {1'b1, keeps, state};
    always_comb begin
        assert (!has_begun || !kept || state == earlier);
        cover (has_begun && kept && keeps);
    end
endmodule
