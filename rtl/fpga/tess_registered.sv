// tess_top with a register at every port, so that placement measures the circuit and not the pads. It is only for timing:
// the registers break the handshakes.
module tess_registered #(
    parameter bit BUFFERED = 1'b0, // of tess_top
    parameter int TAG      = 0,
    parameter int BASE     = 0,
    localparam int TAGS    = (TAG == 0) ? 1 : TAG,
    localparam int FIRSTS  = (BASE == 0) ? 1 : BASE,
    localparam int INDICES = (BASE == 0) ? 13 : BASE,
    // Bits without valid and tags.
    localparam int PATCH     = 199,
    localparam int COUNTS    = 27,
    localparam int POINT     = 35,
    localparam int PRIMITIVE = 3 * INDICES + 3
) (
    input  logic                      clk,
    input  logic                      rst,
    input  logic                      patch_valid,
    input  logic [PATCH-1:0]          patch, // factors, then domain, partitioning, output and split order
    input  logic [TAGS+FIRSTS-1:0]    label, // number of the first point, then tag
    input  logic                      counts_ready,
    input  logic                      point_ready,
    input  logic                      primitive_ready,
    output logic                      patch_ready,
    output logic [COUNTS+TAGS:0]      counts_out, // the fields, then tag and valid
    output logic [POINT+TAGS:0]       point_out,
    output logic [PRIMITIVE+TAGS:0]   primitive_out
);
    logic                    at_rst, at_patch_valid, at_counts_ready, at_point_ready, at_primitive_ready;
    logic [PATCH-1:0]        at_patch;
    logic [TAGS+FIRSTS-1:0]  at_label;
    logic                    at_patch_ready, patch_ready_next;
    logic [COUNTS+TAGS:0]    at_counts, counts_next;
    logic [POINT+TAGS:0]     at_point, point_next;
    logic [PRIMITIVE+TAGS:0] at_primitive, primitive_next;
    tess_top #(.BUFFERED(BUFFERED), .TAG(TAG), .BASE(BASE)) top (
        .clk               (clk),
        .rst               (at_rst),
        .patch_valid       (at_patch_valid),
        .patch_ready       (patch_ready_next),
        .patch_domain      (at_patch[193:192]),
        .patch_partitioning(at_patch[195:194]),
        .patch_out         (at_patch[197:196]),
        .patch_center      (at_patch[198]),
        .patch_factors     (at_patch[191:0]),
        .patch_tag         (at_label[TAGS+FIRSTS-1:FIRSTS]),
        .patch_first       (at_label[FIRSTS-1:0]),
        .counts_valid      (counts_next[COUNTS+TAGS]),
        .counts_ready      (at_counts_ready),
        .counts_points     (counts_next[12:0]),
        .counts_primitives (counts_next[26:13]),
        .counts_tag        (counts_next[COUNTS+TAGS-1:COUNTS]),
        .point_valid       (point_next[POINT+TAGS]),
        .point_ready       (at_point_ready),
        .point_u           (point_next[16:0]),
        .point_v           (point_next[33:17]),
        .point_last        (point_next[34]),
        .point_tag         (point_next[POINT+TAGS-1:POINT]),
        .primitive_valid   (primitive_next[PRIMITIVE+TAGS]),
        .primitive_ready   (at_primitive_ready),
        .primitive_i0      (primitive_next[INDICES-1:0]),
        .primitive_i1      (primitive_next[2*INDICES-1:INDICES]),
        .primitive_i2      (primitive_next[3*INDICES-1:2*INDICES]),
        .primitive_size    (primitive_next[3*INDICES+1:3*INDICES]),
        .primitive_last    (primitive_next[3*INDICES+2]),
        .primitive_tag     (primitive_next[PRIMITIVE+TAGS-1:PRIMITIVE])
    );
    always_ff @(posedge clk) begin
        at_rst             <= rst;
        at_patch_valid     <= patch_valid;
        at_patch           <= patch;
        at_label           <= label;
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
