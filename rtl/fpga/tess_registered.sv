// tess_top with a register at every port, so that placement measures the circuit and not the pads. It is only for timing:
// the registers break the handshakes.
module tess_registered #(
    parameter bit BUFFERED = 1'b0, // of tess_top
    parameter int TAG      = 0,
    parameter int BASE     = 0,
    parameter int POINTS   = 1,
    localparam int TAGS    = (TAG == 0) ? 1 : TAG,
    localparam int FIRSTS  = (BASE == 0) ? 1 : BASE,
    localparam int INDICES = (BASE == 0) ? 13 : BASE,
    localparam int LABELS  = TAGS + FIRSTS,
    localparam int MORE    = 3 * TAGS + 3 * INDICES + 35 * POINTS // bits of tags, upper parts of indices, lanes
) (
    input  logic         clk,
    input  logic         rst,
    input  logic         patch_valid,
    input  logic [198:0] patch,      // factors, then domain, partitioning, output and split order
    input  logic         label,      // number of the first point and tag, a bit in each clock: there are not enough pads for all
    input  logic         counts_ready,
    input  logic         point_ready,
    input  logic         primitive_ready,
    output logic         patch_ready,
    output logic [27:0]  counts_out, // the fields, then valid
    output logic [35:0]  point_out,
    output logic [42:0]  primitive_out,
    output logic         label_out   // parity of all tags, of the indices' bits from 13, and of the lanes after the first
);
    logic               at_rst, at_patch_valid, at_counts_ready, at_point_ready, at_primitive_ready;
    logic [198:0]       at_patch;
    logic [LABELS-1:0]  at_label;
    logic               at_patch_ready, patch_ready_next, at_label_out;
    logic [27:0]        at_counts, counts_next;
    logic [35:0]        at_point, point_next;
    logic [42:0]        at_primitive, primitive_next;
    logic [MORE-1:0]    at_more, more_next;
    logic [TAGS-1:0]    counts_tag, point_tag, primitive_tag;
    logic [INDICES-1:0] i0, i1, i2;
    logic [POINTS-1:0]    keep;
    logic [17*POINTS-1:0] u, v;
    tess_top #(.BUFFERED(BUFFERED), .TAG(TAG), .BASE(BASE), .POINTS(POINTS)) top (
        .clk               (clk),
        .rst               (at_rst),
        .patch_valid       (at_patch_valid),
        .patch_ready       (patch_ready_next),
        .patch_domain      (at_patch[193:192]),
        .patch_partitioning(at_patch[195:194]),
        .patch_out         (at_patch[197:196]),
        .patch_center      (at_patch[198]),
        .patch_factors     (at_patch[191:0]),
        .patch_tag         (at_label[LABELS-1:FIRSTS]),
        .patch_first       (at_label[FIRSTS-1:0]),
        .counts_valid      (counts_next[27]),
        .counts_ready      (at_counts_ready),
        .counts_points     (counts_next[12:0]),
        .counts_primitives (counts_next[26:13]),
        .counts_tag        (counts_tag),
        .point_valid       (point_next[35]),
        .point_ready       (at_point_ready),
        .point_keep        (keep),
        .point_u           (u),
        .point_v           (v),
        .point_last        (point_next[34]),
        .point_tag         (point_tag),
        .primitive_valid   (primitive_next[42]),
        .primitive_ready   (at_primitive_ready),
        .primitive_size    (primitive_next[40:39]),
        .primitive_i0      (i0),
        .primitive_i1      (i1),
        .primitive_i2      (i2),
        .primitive_last    (primitive_next[41]),
        .primitive_tag     (primitive_tag)
    );
    assign primitive_next[38:0] = {i2[12:0], i1[12:0], i0[12:0]};
    assign point_next[33:0]     = {v[16:0], u[16:0]};
    assign more_next = {keep >> 1, (17*POINTS)'(u >> 17), (17*POINTS)'(v >> 17),
        INDICES'(i2 >> 13), INDICES'(i1 >> 13), INDICES'(i0 >> 13), counts_tag, point_tag, primitive_tag};
    always_ff @(posedge clk) begin
        at_rst             <= rst;
        at_patch_valid     <= patch_valid;
        at_patch           <= patch;
        at_label           <= LABELS'({at_label, label});
        at_counts_ready    <= counts_ready;
        at_point_ready     <= point_ready;
        at_primitive_ready <= primitive_ready;
        at_patch_ready     <= patch_ready_next;
        at_counts          <= counts_next;
        at_point           <= point_next;
        at_primitive       <= primitive_next;
        at_more            <= more_next;
        at_label_out       <= ^at_more;
    end
    assign patch_ready   = at_patch_ready;
    assign counts_out    = at_counts;
    assign point_out     = at_point;
    assign primitive_out = at_primitive;
    assign label_out     = at_label_out;
endmodule
