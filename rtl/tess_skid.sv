// A register stage of a stream. `in_ready` and `out_valid` come from registers, so no path leads from one side to the other.
//
//   ENTRIES   elements            multiplexers
//   0         wires               none
//   1         one in two clocks   none: the entry must be free before the next element arrives
//   2         one in each clock   one per bit: `spare` takes the element that arrives while the consumer stalls
//
// With 2 entries, a stall of one clock:
//
//   clock       1   2   3   4   5
//   in          a   b   c   c   d      c waits in clock 3, when `spare` is full
//   out         .   a   a   b   c
//   out_ready   1   0   1   1   1
//   is_full     0   0   1   0   0
module tess_skid #(
    parameter int WIDTH   = 1,
    parameter int ENTRIES = 2
) (
    /* verilator lint_off UNUSEDSIGNAL */ // wires do not use the clock
    input  logic             clk,
    input  logic             rst,
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic             in_valid,
    output logic             in_ready,
    input  logic [WIDTH-1:0] in_data,
    output logic             out_valid,
    input  logic             out_ready,
    output logic [WIDTH-1:0] out_data
);
    /* verilator lint_off UNUSEDSIGNAL */ // used only with two entries
    logic             is_full; // `spare` holds an element
    logic [WIDTH-1:0] spare;
    /* verilator lint_on UNUSEDSIGNAL */
    if (ENTRIES == 0) begin : g_wires
        assign {is_full, spare} = '0;
        assign in_ready  = out_ready;
        assign out_valid = in_valid;
        assign out_data  = in_data;
    end else if (ENTRIES == 1) begin : g_one
        assign {is_full, spare} = '0;
        assign in_ready = !rst && !out_valid;
        always_ff @(posedge clk) begin
            if (rst) begin
                out_valid <= 1'b0;
            end else if (out_valid) begin
                out_valid <= !out_ready;
            end else begin
                out_valid <= in_valid;
            end
            if (!out_valid) begin
                out_data <= in_data;
            end
        end
    end else begin : g_two
        assign in_ready = !rst && !is_full;
        always_ff @(posedge clk) begin
            if (rst) begin
                out_valid <= 1'b0;
                is_full   <= 1'b0;
            end else if (!out_valid || out_ready) begin
                out_valid <= is_full || in_valid;
                is_full   <= 1'b0;
            end else begin
                is_full   <= is_full || in_valid;
            end
            if (!out_valid || out_ready) begin
                out_data <= is_full ? spare : in_data;
            end
            if (!is_full) begin
                spare <= in_data;
            end
        end
    end
endmodule
