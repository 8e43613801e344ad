// Both buffers of tess_skid, with the properties of inside_skid.svh.
module prove_skid (
    input logic       clk, rst, in_valid, out_ready,
    input logic [7:0] in_data
);
    logic [1:0] in_ready, out_valid;
    logic [7:0] out_one, out_two;
    tess_skid #(.WIDTH(8), .ENTRIES(1)) one (
        .clk, .rst, .in_valid, .in_ready(in_ready[0]), .in_data, .out_valid(out_valid[0]), .out_ready, .out_data(out_one));
    tess_skid #(.WIDTH(8), .ENTRIES(2)) two (
        .clk, .rst, .in_valid, .in_ready(in_ready[1]), .in_data, .out_valid(out_valid[1]), .out_ready, .out_data(out_two));
endmodule
