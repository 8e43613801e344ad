// tess_top with a register at every port, so that placement measures the circuit and not the pads. It is only for timing:
// the registers break the handshakes.
module tess_registered #(
    parameter bit BUFFERED = 1'b0 // of tess_top
) (
    input  logic         clk,
    input  logic         rst,
    input  logic         patch_valid,
    input  logic [198:0] patch,      // factors, then domain, partitioning, output and split order
    input  logic         counts_ready,
    input  logic         point_ready,
    input  logic         primitive_ready,
    output logic         patch_ready,
    output logic [27:0]  counts_out, // the fields, then valid
    output logic [35:0]  point_out,
    output logic [42:0]  primitive_out
);
    logic         at_rst, at_patch_valid, at_counts_ready, at_point_ready, at_primitive_ready;
    logic [198:0] at_patch;
    logic         at_patch_ready, patch_ready_next;
    logic [27:0]  at_counts, counts_next;
    logic [35:0]  at_point, point_next;
    logic [42:0]  at_primitive, primitive_next;
    tess_top #(.BUFFERED(BUFFERED)) top (
        .clk               (clk),
        .rst               (at_rst),
        .patch_valid       (at_patch_valid),
        .patch_ready       (patch_ready_next),
        .patch_domain      (at_patch[193:192]),
        .patch_partitioning(at_patch[195:194]),
        .patch_out         (at_patch[197:196]),
        .patch_center      (at_patch[198]),
        .patch_factors     (at_patch[191:0]),
        .counts_valid      (counts_next[27]),
        .counts_ready      (at_counts_ready),
        .counts_points     (counts_next[12:0]),
        .counts_primitives (counts_next[26:13]),
        .point_valid       (point_next[35]),
        .point_ready       (at_point_ready),
        .point_u           (point_next[16:0]),
        .point_v           (point_next[33:17]),
        .point_last        (point_next[34]),
        .primitive_valid   (primitive_next[42]),
        .primitive_ready   (at_primitive_ready),
        .primitive_size    (primitive_next[40:39]),
        .primitive_i0      (primitive_next[12:0]),
        .primitive_i1      (primitive_next[25:13]),
        .primitive_i2      (primitive_next[38:26]),
        .primitive_last    (primitive_next[41])
    );
    always_ff @(posedge clk) begin
        at_rst             <= rst;
        at_patch_valid     <= patch_valid;
        at_patch           <= patch;
        at_counts_ready    <= counts_ready;
        at_point_ready     <= point_ready;
        at_primitive_ready <= primitive_ready;
        at_patch_ready     <= patch_ready_next;
        at_counts          <= counts_next;
        at_point           <= point_next;
        at_primitive       <= primitive_next;
    end
    assign patch_ready   = at_patch_ready;
    assign counts_out    = at_counts;
    assign point_out     = at_point;
    assign primitive_out = at_primitive;
endmodule
