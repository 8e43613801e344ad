// tess_top with AXI4-Stream ports: one slave for patches, masters for counts, points and primitives. Only names and
// packing change, so the timing is that of tess_top. Fields fill bytes from the lowest bit; the bits between are 0.
module tess_axis (
    input  logic         aclk,
    input  logic         aresetn, // low: reset, synchronous

    // 0 domain, 2 partitioning, 4 output (2 bits each, numbers of tess_pkg), 6 split order; from 8 the six factors.
    input  logic         s_axis_patch_tvalid,
    output logic         s_axis_patch_tready,
    /* verilator lint_off UNUSEDSIGNAL */ // bit 7
    input  logic [199:0] s_axis_patch_tdata,
    /* verilator lint_on UNUSEDSIGNAL */

    // 0 points (13 bits), 16 primitives (14 bits).
    output logic         m_axis_counts_tvalid,
    input  logic         m_axis_counts_tready,
    output logic [31:0]  m_axis_counts_tdata,

    // 0 u, 24 v (17 bits each, 16.16). tlast: the last point of the patch.
    output logic         m_axis_point_tvalid,
    input  logic         m_axis_point_tready,
    output logic [47:0]  m_axis_point_tdata,
    output logic         m_axis_point_tlast,

    // 0, 16, 32 the indices (13 bits each), 48 how many there are. tlast: the last primitive of the patch.
    output logic         m_axis_primitive_tvalid,
    input  logic         m_axis_primitive_tready,
    output logic [55:0]  m_axis_primitive_tdata,
    output logic         m_axis_primitive_tlast
);
    logic [12:0] points, i0, i1, i2;
    logic [13:0] primitives;
    logic [16:0] u, v;
    logic [1:0]  size;
    tess_top top (
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
    assign m_axis_counts_tdata    = {2'd0, primitives, 3'd0, points};
    assign m_axis_point_tdata     = {7'd0, v, 7'd0, u};
    assign m_axis_primitive_tdata = {6'd0, size, 3'd0, i2, 3'd0, i1, 3'd0, i0};
endmodule
