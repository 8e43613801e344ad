// tess_tags beside a stage that takes patches and makes elements as it likes, with the properties of inside_tags.svh.
module prove_tags (
    input logic        clk, rst, in_valid, to_ready, from_valid, from_last, out_ready,
    input logic [13:0] in_count,
    input logic [3:0]  in_tag
);
    logic       in_ready, to_valid, from_ready, out_valid;
    logic [3:0] out_tag;
    tess_tags #(.WIDTH(4)) tags (.*);
endmodule

// tess_base adds `first` to the indices that a primitive has, with as many bits as BASE.
module prove_base (
    input logic [15:0] first,
    input logic [1:0]  size,
    input logic [12:0] in_i0, in_i1, in_i2
);
    logic [12:0] plain_i0, plain_i1, plain_i2;
    logic [15:0] out_i0, out_i1, out_i2;
    tess_base plain (.first(1'b0), .out_i0(plain_i0), .out_i1(plain_i1), .out_i2(plain_i2), .*);
    tess_base #(.BASE(16)) base (.*);
    logic [63:0] sum_i0, sum_i1, sum_i2;
    always_comb begin
        sum_i0 = 64'(in_i0) + 64'(first);
        sum_i1 = (size > 2'd1) ? 64'(in_i1) + 64'(first) : 64'd0;
        sum_i2 = (size > 2'd2) ? 64'(in_i2) + 64'(first) : 64'd0;
        // An index that a primitive does not have is 0.
        assume (size != 2'd0 && (size > 2'd1 || in_i1 == 13'd0) && (size > 2'd2 || in_i2 == 13'd0));
        assert ({plain_i0, plain_i1, plain_i2} == {in_i0, in_i1, in_i2});
        assert ({out_i0, out_i1, out_i2} == {sum_i0[15:0], sum_i1[15:0], sum_i2[15:0]});
        cover (size == 2'd3 && out_i2 < first);
    end
endmodule
