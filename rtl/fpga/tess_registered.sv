// tess_top with a register at every port, so that placement measures the circuit and no pad. For timing alone: the
// registers break the handshakes.
module tess_registered (
    input  logic         clk,
    input  logic         rst,
    input  logic [199:0] patch,      // factors, then domain, partitioning, output, split order and valid
    input  logic [2:0]   ready,      // of counts, points and primitives
    output logic         patch_ready,
    output logic [27:0]  counts,
    output logic [35:0]  point,
    output logic [42:0]  primitive
);
    logic         reset, patch_ready_next;
    logic [199:0] in;
    logic [2:0]   readies;
    logic [27:0]  counts_next;
    logic [35:0]  point_next;
    logic [42:0]  primitive_next;
    tess_top top (
        .clk               (clk),
        .rst               (reset),
        .patch_valid       (in[199]),
        .patch_ready       (patch_ready_next),
        .patch_domain      (in[193:192]),
        .patch_partitioning(in[195:194]),
        .patch_out         (in[197:196]),
        .patch_center      (in[198]),
        .patch_factors     (in[191:0]),
        .counts_valid      (counts_next[27]),
        .counts_ready      (readies[0]),
        .counts_points     (counts_next[12:0]),
        .counts_primitives (counts_next[26:13]),
        .point_valid       (point_next[35]),
        .point_ready       (readies[1]),
        .point_u           (point_next[16:0]),
        .point_v           (point_next[33:17]),
        .point_last        (point_next[34]),
        .primitive_valid   (primitive_next[42]),
        .primitive_ready   (readies[2]),
        .primitive_size    (primitive_next[40:39]),
        .primitive_i0      (primitive_next[12:0]),
        .primitive_i1      (primitive_next[25:13]),
        .primitive_i2      (primitive_next[38:26]),
        .primitive_last    (primitive_next[41])
    );
    always_ff @(posedge clk) begin
        reset       <= rst;
        in          <= patch;
        readies     <= ready;
        patch_ready <= patch_ready_next;
        counts      <= counts_next;
        point       <= point_next;
        primitive   <= primitive_next;
    end
endmodule
