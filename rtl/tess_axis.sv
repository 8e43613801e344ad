// tess_top with AXI4-Stream ports: one slave for patches, masters for counts, points and primitives. Only names and
// packing change, so the timing is that of tess_top. Fields fill bytes from the lowest bit; the bits between are 0.
//
//   port        bits, packed   PADDED   fields, by their lowest bit
//   patch       200            256      0 domain, 2 partitioning, 4 output (2 bits each, numbers of tess_pkg), 6 split
//                                       order; 8 the six factors, factor 0 lowest; 200 `first`, then the tag
//   counts      32             32       0 points (13 bits), 16 primitives (14 bits); 32 the tag
//   point       48             64       0 u, 24 v (17 bits each, 16.16); 48 the tag. tlast: the last point of the patch
//   primitive   56             64       0, 16, 32 the indices (13 bits each), 48 their number; 56 the tag. tlast: the last
//                                       primitive of the patch
//
// The tag and `first` of tess_top's TAG and BASE take as many bytes as they need, none for 0, and so do the indices of BASE,
// which move what is above them: with BASE 32 they are at 0, 32, 64 and their number at 96. Words have as many bytes more.
//
// With POINTS 2 or 4, the word of `point` is so many words of POINTS 1 with the tag in each, the earlier point in the lower bits.
// tkeep has the bytes of the words that have a point, so a width converter to one word makes the stream of POINTS 1.
//
// PADDED selects widths that DMA engines and width converters accept: powers of two. The added bits are above all fields;
// those of the patch are ignored.
module tess_axis #(
    parameter bit PADDED   = 1'b0,
    parameter bit BUFFERED = 1'b0, // a register stage at each port: tess_skid
    parameter int TAG      = 0,    // bits of a tag
    parameter int BASE     = 0,    // bits of an index that is counted from `first`; 0: 13 bits, counted from 0
    parameter int POINTS   = 1,    // points per clock: 1, 2 or 4
    // Bits in whole bytes: the tag, `first`, an index, and the packed words.
    localparam int TAGS      = (TAG + 7) / 8 * 8,
    localparam int FIRSTS    = (BASE + 7) / 8 * 8,
    localparam int INDICES   = (BASE == 0) ? 16 : FIRSTS,
    localparam int PATCH     = 200 + FIRSTS + TAGS,
    localparam int COUNTS    = 32 + TAGS,
    localparam int POINT     = 48 + TAGS,
    localparam int PRIMITIVE = 3 * INDICES + 8 + TAGS,
    // Bits of the words.
    localparam int PATCH_BITS     = PADDED ? 2**$clog2(PATCH) : PATCH,
    localparam int COUNTS_BITS    = PADDED ? 2**$clog2(COUNTS) : COUNTS,
    localparam int WORD_BITS      = PADDED ? 2**$clog2(POINT) : POINT, // of one point
    localparam int POINT_BITS     = POINTS * WORD_BITS,
    localparam int PRIMITIVE_BITS = PADDED ? 2**$clog2(PRIMITIVE) : PRIMITIVE
) (
    input  logic         aclk,
    input  logic         aresetn, // synchronous reset, active low

    input  logic                      s_axis_patch_tvalid,
    output logic                      s_axis_patch_tready,
    /* verilator lint_off UNUSEDSIGNAL */ // the bits between the fields, and those that PADDED adds
    input  logic [PATCH_BITS-1:0]     s_axis_patch_tdata,
    /* verilator lint_on UNUSEDSIGNAL */

    output logic                      m_axis_counts_tvalid,
    input  logic                      m_axis_counts_tready,
    output logic [COUNTS_BITS-1:0]    m_axis_counts_tdata,

    output logic                      m_axis_point_tvalid,
    input  logic                      m_axis_point_tready,
    output logic [POINT_BITS-1:0]     m_axis_point_tdata,
    output logic [POINT_BITS/8-1:0]   m_axis_point_tkeep, // all 1 with POINTS 1
    output logic                      m_axis_point_tlast,

    output logic                      m_axis_primitive_tvalid,
    input  logic                      m_axis_primitive_tready,
    output logic [PRIMITIVE_BITS-1:0] m_axis_primitive_tdata,
    output logic                      m_axis_primitive_tlast
);
    localparam int TAG_BITS   = (TAG == 0) ? 1 : TAG; // of ports
    localparam int FIRST_BITS = (BASE == 0) ? 1 : BASE;
    localparam int INDEX_BITS = (BASE == 0) ? 13 : BASE;
    logic [12:0]           points;
    logic [13:0]           primitives;
    logic [POINTS-1:0]     keep;
    logic [17*POINTS-1:0]  u, v;
    logic [1:0]            size;
    logic [INDEX_BITS-1:0] i0, i1, i2;
    logic [TAG_BITS-1:0]   counts_tag, point_tag, primitive_tag;
    tess_top #(.BUFFERED(BUFFERED), .TAG(TAG), .BASE(BASE), .POINTS(POINTS)) top (
        .clk               (aclk),
        .rst               (!aresetn),
        .patch_valid       (s_axis_patch_tvalid),
        .patch_ready       (s_axis_patch_tready),
        .patch_domain      (s_axis_patch_tdata[1:0]),
        .patch_partitioning(s_axis_patch_tdata[3:2]),
        .patch_out         (s_axis_patch_tdata[5:4]),
        .patch_center      (s_axis_patch_tdata[6]),
        .patch_factors     (s_axis_patch_tdata[199:8]),
        .patch_tag         (TAG_BITS'(s_axis_patch_tdata >> (200 + FIRSTS))),
        .patch_first       (FIRST_BITS'(s_axis_patch_tdata >> 200)),
        .counts_valid      (m_axis_counts_tvalid),
        .counts_ready      (m_axis_counts_tready),
        .counts_points     (points),
        .counts_primitives (primitives),
        .counts_tag,
        .point_valid       (m_axis_point_tvalid),
        .point_ready       (m_axis_point_tready),
        .point_keep        (keep),
        .point_u           (u),
        .point_v           (v),
        .point_last        (m_axis_point_tlast),
        .point_tag,
        .primitive_valid   (m_axis_primitive_tvalid),
        .primitive_ready   (m_axis_primitive_tready),
        .primitive_size    (size),
        .primitive_i0      (i0),
        .primitive_i1      (i1),
        .primitive_i2      (i2),
        .primitive_last    (m_axis_primitive_tlast),
        .primitive_tag
    );
    // The tag is the highest field, and 0 if there is none.
    assign m_axis_counts_tdata    = COUNTS_BITS'({counts_tag, 2'd0, primitives, 3'd0, points});
    for (genvar k = 0; k < POINTS; k++) begin : g_point
        assign m_axis_point_tdata[WORD_BITS*k +: WORD_BITS] = WORD_BITS'(
            {point_tag, 7'd0, v[17*k +: 17], 7'd0, u[17*k +: 17]});
        assign m_axis_point_tkeep[WORD_BITS/8*k +: WORD_BITS/8] = {(WORD_BITS/8){keep[k]}};
    end
    assign m_axis_primitive_tdata = PRIMITIVE_BITS'({
        primitive_tag, 6'd0, size, INDICES'(i2), INDICES'(i1), INDICES'(i0)});
endmodule
