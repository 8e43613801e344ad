// reciprocal(n) for n = 1..64, 16 fraction bits, rounded half up: a table (specification, section 2).
// n = 0, which no factor asks for, gives 0.
module tess_reciprocal (
    input  logic [6:0]  n,
    output logic [16:0] value
);
    function automatic logic [64:0][16:0] make_table();
        make_table[0] = '0;
        for (int unsigned i = 1; i <= 64; i++) begin
            make_table[i] = 17'((32'h1_0000 + i / 2) / i);
        end
    endfunction

    localparam logic [64:0][16:0] TABLE = make_table();

    always_comb value = (n <= 7'd64) ? TABLE[n] : '0;
endmodule
