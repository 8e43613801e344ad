// Delays a value by CLOCKS clocks, not counting clocks in which `advance` is 0. With CLOCKS 0 it is a wire.
module tess_delay #(
    parameter int WIDTH  = 1,
    parameter int CLOCKS = 1
) (
    /* verilator lint_off UNUSEDSIGNAL */ // a wire does not use the clock
    input  logic             clk,
    input  logic             advance,
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic [WIDTH-1:0] in,
    output logic [WIDTH-1:0] out
);
    if (CLOCKS == 0) begin : g_wire
        assign out = in;
    end else begin : g_registers
        logic [CLOCKS*WIDTH-1:0] values; // the newest value in the lowest bits
        if (CLOCKS == 1) begin : g_one
            always_ff @(posedge clk) begin
                if (advance) begin
                    values <= in;
                end
            end
        end else begin : g_line
            always_ff @(posedge clk) begin
                if (advance) begin
                    values <= {values[(CLOCKS-1)*WIDTH-1:0], in};
                end
            end
        end
        assign out = values[CLOCKS*WIDTH-1 -: WIDTH];
    end
endmodule
