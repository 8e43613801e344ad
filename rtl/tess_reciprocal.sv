// reciprocal(n) for n = 1..64, 16 fraction bits, rounded half up: a table (specification, section 2).
// n = 0, which no factor needs, gives 0.
module tess_reciprocal (
    input  logic [6:0]  n,
    output logic [16:0] value
);
    always_comb begin
        value = '0;
        for (int unsigned i = 1; i <= 64; i++) begin
            if (n == 7'(i)) begin
                value = 17'((32'h1_0000 + i / 2) / i);
            end
        end
    end
endmodule
