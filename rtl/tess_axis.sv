// tess_top with AXI4-Stream ports: one slave for patches, masters for counts, points and primitives. Only names and
// packing change, so the timing is that of tess_top. Fields fill bytes from the lowest bit; the bits between are 0.
//
//   port        bits, packed   PADDED   fields, by their lowest bit
//   patch       200            256      0 domain, 2 partitioning, 4 output (2 bits each, numbers of tess_pkg), 6 split
//                                       order; 8 the six factors, factor 0 lowest
//   counts      32             32       0 points (13 bits), 16 primitives (14 bits)
//   point       48             64       0 u, 24 v (17 bits each, 16.16). tlast: the last point of the patch
//   primitive   56             64       0, 16, 32 the indices (13 bits each), 48 their number. tlast: the last primitive
//                                       of the patch
//
// PADDED selects widths that DMA engines and width converters accept: powers of two. The added bits are above all fields;
// those of the patch are ignored.
module tess_axis #(
    parameter bit PADDED   = 1'b0,
    parameter bit BUFFERED = 1'b0 // a register stage at each port: tess_skid
) (
    input  logic         aclk,
    input  logic         aresetn, // synchronous reset, active low

    input  logic                            s_axis_patch_tvalid,
    output logic                            s_axis_patch_tready,
    /* verilator lint_off UNUSEDSIGNAL */ // bit 7, and the bits that PADDED adds
    input  logic [(PADDED ? 256 : 200)-1:0] s_axis_patch_tdata,
    /* verilator lint_on UNUSEDSIGNAL */

    output logic                            m_axis_counts_tvalid,
    input  logic                            m_axis_counts_tready,
    output logic [31:0]                     m_axis_counts_tdata,

    output logic                            m_axis_point_tvalid,
    input  logic                            m_axis_point_tready,
    output logic [(PADDED ? 64 : 48)-1:0]   m_axis_point_tdata,
    output logic                            m_axis_point_tlast,

    output logic                            m_axis_primitive_tvalid,
    input  logic                            m_axis_primitive_tready,
    output logic [(PADDED ? 64 : 56)-1:0]   m_axis_primitive_tdata,
    output logic                            m_axis_primitive_tlast
);
    logic [12:0] points, i0, i1, i2;
    logic [13:0] primitives;
    logic [16:0] u, v;
    logic [1:0]  size;
    tess_top #(.BUFFERED(BUFFERED)) top (
        .clk               (aclk),
        .rst               (!aresetn),
        .patch_valid       (s_axis_patch_tvalid),
        .patch_ready       (s_axis_patch_tready),
        .patch_domain      (s_axis_patch_tdata[1:0]),
        .patch_partitioning(s_axis_patch_tdata[3:2]),
        .patch_out         (s_axis_patch_tdata[5:4]),
        .patch_center      (s_axis_patch_tdata[6]),
        .patch_factors     (s_axis_patch_tdata[199:8]),
        .counts_valid      (m_axis_counts_tvalid),
        .counts_ready      (m_axis_counts_tready),
        .counts_points     (points),
        .counts_primitives (primitives),
        .point_valid       (m_axis_point_tvalid),
        .point_ready       (m_axis_point_tready),
        .point_u           (u),
        .point_v           (v),
        .point_last        (m_axis_point_tlast),
        .primitive_valid   (m_axis_primitive_tvalid),
        .primitive_ready   (m_axis_primitive_tready),
        .primitive_size    (size),
        .primitive_i0      (i0),
        .primitive_i1      (i1),
        .primitive_i2      (i2),
        .primitive_last    (m_axis_primitive_tlast)
    );
    assign m_axis_counts_tdata = {2'd0, primitives, 3'd0, points};
    always_comb begin
        m_axis_point_tdata           = '0;
        m_axis_point_tdata[16:0]     = u;
        m_axis_point_tdata[40:24]    = v;
        m_axis_primitive_tdata        = '0;
        m_axis_primitive_tdata[12:0]  = i0;
        m_axis_primitive_tdata[28:16] = i1;
        m_axis_primitive_tdata[44:32] = i2;
        m_axis_primitive_tdata[49:48] = size;
    end
endmodule
